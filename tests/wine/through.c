/* Loads a chamfer library, sends the meshes of a file of plain numbers through it, and writes all
   that comes out to another: to compare the library of one system with that of another. */

#include "chamfer.h"

#include <stdio.h>
#include <stdlib.h>

#ifdef _WIN32
#include <windows.h>
typedef HMODULE library;
static library open_library(const char *path) { return LoadLibraryA(path); }
static void *symbol(library from, const char *name) { return (void *)GetProcAddress(from, name); }
#else
#include <dlfcn.h>
typedef void *library;
static library open_library(const char *path) { return dlopen(path, RTLD_NOW); }
static void *symbol(library from, const char *name) { return dlsym(from, name); }
#endif

#define WIDTH_PERCENT 1.0f

static struct {
    int32_t (*options_init)(chamfer_options *);
    int32_t (*run)(const chamfer_mesh *, const chamfer_options *, chamfer_progress, void *,
                   chamfer_result **, chamfer_error *);
    int32_t (*result_mesh)(const chamfer_result *, chamfer_mesh *);
    int32_t (*result_totals)(const chamfer_result *, chamfer_totals *);
    int32_t (*result_verdicts)(const chamfer_result *, const chamfer_edge_verdict **, uint32_t *);
    int32_t (*result_vertex_sources)(const chamfer_result *, const chamfer_vertex_source **,
                                     uint32_t *);
    int32_t (*result_triangle_sources)(const chamfer_result *, const chamfer_triangle_source **,
                                       uint32_t *);
    void (*result_destroy)(chamfer_result *);
} api;

static void fail(const char *what) {
    fprintf(stderr, "%s\n", what);
    exit(1);
}

/* Through memory: C has no conversion between pointers to data and to functions. */
#define LOAD(from, name)                                                                           \
    do {                                                                                           \
        void *found = symbol(from, "chamfer_" #name);                                              \
        if (found == NULL) fail("the library lacks chamfer_" #name);                               \
        *(void **)&api.name = found;                                                               \
    } while (0)

static void load(const char *path) {
    library from = open_library(path);
    if (from == NULL) fail("the library cannot be loaded");
    LOAD(from, options_init);
    LOAD(from, run);
    LOAD(from, result_mesh);
    LOAD(from, result_totals);
    LOAD(from, result_verdicts);
    LOAD(from, result_vertex_sources);
    LOAD(from, result_triangle_sources);
    LOAD(from, result_destroy);
}

static uint32_t read_number(FILE *file) {
    uint32_t number;
    if (fread(&number, sizeof number, 1, file) != 1) fail("the file is cut off");
    return number;
}

/* NULL for an empty array. */
static void *read_array(FILE *file, uint32_t *count) {
    void *values = NULL;
    *count = read_number(file);
    if (*count > 0) {
        values = malloc(4 * (size_t)*count);
        if (values == NULL || fread(values, 4, *count, file) != *count) fail("the file is cut off");
    }
    return values;
}

static chamfer_mesh read_mesh(FILE *file) {
    chamfer_mesh mesh = {.struct_size = sizeof mesh};
    uint32_t count, channel;
    mesh.positions = read_array(file, &count);
    mesh.vertex_count = count / 3;
    mesh.normals = read_array(file, &count);
    mesh.tangents = read_array(file, &count);
    mesh.colors = read_array(file, &count);
    for (channel = 0; channel < CHAMFER_UV_CHANNELS; ++channel) {
        mesh.uvs[channel].components = read_number(file);
        mesh.uvs[channel].values = read_array(file, &count);
    }
    mesh.submesh_index_counts = read_array(file, &mesh.submesh_count);
    mesh.indices = read_array(file, &mesh.index_count);
    return mesh;
}

static void free_mesh(const chamfer_mesh *mesh) {
    uint32_t channel;
    for (channel = 0; channel < CHAMFER_UV_CHANNELS; ++channel) {
        free((void *)mesh->uvs[channel].values);
    }
    free((void *)mesh->positions);
    free((void *)mesh->normals);
    free((void *)mesh->tangents);
    free((void *)mesh->colors);
    free((void *)mesh->submesh_index_counts);
    free((void *)mesh->indices);
}

static void write_bytes(FILE *file, const void *bytes, size_t size) {
    if (bytes != NULL && fwrite(bytes, 1, size, file) != size) fail("the result cannot be written");
}

static void write_mesh(FILE *file, const chamfer_mesh *mesh) {
    const size_t vertices = mesh->vertex_count;
    uint32_t channel;
    write_bytes(file, &mesh->vertex_count, sizeof mesh->vertex_count);
    write_bytes(file, mesh->positions, vertices * 12);
    write_bytes(file, mesh->normals, vertices * 12);
    write_bytes(file, mesh->tangents, vertices * 16);
    write_bytes(file, mesh->colors, vertices * 16);
    for (channel = 0; channel < CHAMFER_UV_CHANNELS; ++channel) {
        const chamfer_uv *uv = &mesh->uvs[channel];
        write_bytes(file, uv->values, vertices * 4 * uv->components);
    }
    write_bytes(file, mesh->submesh_index_counts, (size_t)mesh->submesh_count * 4);
    write_bytes(file, mesh->indices, (size_t)mesh->index_count * 4);
}

static void write_result(FILE *file, const chamfer_result *result) {
    chamfer_mesh mesh = {.struct_size = sizeof mesh};
    chamfer_totals totals = {.struct_size = sizeof totals};
    const chamfer_edge_verdict *verdicts;
    const chamfer_vertex_source *vertices;
    const chamfer_triangle_source *triangles;
    uint32_t count;
    if (api.result_mesh(result, &mesh) || api.result_totals(result, &totals)) fail("no result");
    write_mesh(file, &mesh);
    write_bytes(file, &totals, sizeof totals);
    if (api.result_verdicts(result, &verdicts, &count)) fail("no verdicts");
    write_bytes(file, verdicts, count * sizeof *verdicts);
    if (api.result_vertex_sources(result, &vertices, &count)) fail("no vertex sources");
    write_bytes(file, vertices, count * sizeof *vertices);
    if (api.result_triangle_sources(result, &triangles, &count)) fail("no triangle sources");
    write_bytes(file, triangles, count * sizeof *triangles);
}

static void chamfer_one(FILE *from, FILE *to) {
    chamfer_mesh mesh = read_mesh(from);
    chamfer_options options = {.struct_size = sizeof options};
    chamfer_error error = {.struct_size = sizeof error};
    chamfer_result *result;
    if (api.options_init(&options)) fail("no options");
    options.width = WIDTH_PERCENT;
    if (api.run(&mesh, &options, NULL, NULL, &result, &error)) fail(error.message);
    write_result(to, result);
    api.result_destroy(result);
    free_mesh(&mesh);
}

int main(int argc, char **argv) {
    FILE *from, *to;
    uint32_t left;
    if (argc != 4) fail("arguments: LIBRARY SOURCE RESULT");
    load(argv[1]);
    from = fopen(argv[2], "rb");
    to = fopen(argv[3], "wb");
    if (from == NULL || to == NULL) fail("the files cannot be opened");
    for (left = read_number(from); left > 0; --left) chamfer_one(from, to);
    fclose(from);
    return fclose(to);
}
