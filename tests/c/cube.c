/* Chamfers a cube through the C interface, reads it back, feeds it in again, and tries the errors.
   The header is included twice, here and in twice.c, as a large program would. */

#include "chamfer.h"
#include "chamfer.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define VERTICES 24
#define INDICES 36
/* 12 faces, two for each of the 12 edges, one for each of the 8 corners. */
#define TRIANGLES_OUT 44
#define SEGMENTS 3

const char *name_from_the_second_unit(void);

static int failures = 0;

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            printf("%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);                         \
            ++failures;                                                                            \
        }                                                                                          \
    } while (0)

struct cube {
    float positions[VERTICES][3];
    float normals[VERTICES][3];
    float uvs[VERTICES][2];
    uint32_t indices[INDICES];
    uint32_t index_count;
};

/* A slanted projection: no face is seen edge-on, and no edge of the cube is a seam. */
static void project(const float position[3], float uv[2]) {
    uv[0] = position[0] + 0.25f * position[2];
    uv[1] = position[1] + 0.5f * position[2];
}

/* Side 2, four vertices a face:  2 3
                                  0 1  */
static void make_cube(struct cube *cube) {
    static const uint32_t corners[6] = {0, 1, 2, 2, 1, 3};
    int face, corner;
    memset(cube, 0, sizeof *cube);
    for (face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const float side = face % 2 ? 1.0f : -1.0f;
        for (corner = 0; corner < 4; ++corner) {
            const int v = 4 * face + corner;
            cube->positions[v][axis] = side;
            cube->positions[v][(axis + 1) % 3] = corner % 2 ? side : -side;
            cube->positions[v][(axis + 2) % 3] = corner / 2 ? 1.0f : -1.0f;
            cube->normals[v][axis] = side;
            project(cube->positions[v], cube->uvs[v]);
        }
        for (corner = 0; corner < 6; ++corner) {
            cube->indices[6 * face + corner] = (uint32_t)(4 * face) + corners[corner];
        }
    }
    cube->index_count = INDICES;
}

static chamfer_mesh view_cube(const struct cube *cube) {
    chamfer_mesh mesh = {.struct_size = sizeof mesh};
    CHECK(chamfer_mesh_init(&mesh) == CHAMFER_STATUS_OK);
    mesh.vertex_count = VERTICES;
    mesh.positions = &cube->positions[0][0];
    mesh.normals = &cube->normals[0][0];
    mesh.uvs[0].components = 2;
    mesh.uvs[0].values = &cube->uvs[0][0];
    mesh.submesh_count = 1;
    mesh.submesh_index_counts = &cube->index_count;
    mesh.index_count = INDICES;
    mesh.indices = cube->indices;
    return mesh;
}

static int same_place(const chamfer_mesh *mesh, uint32_t a, uint32_t b) {
    return memcmp(mesh->positions + 3 * a, mesh->positions + 3 * b, 3 * sizeof(float)) == 0;
}

/* How often the triangles run from one position to another. */
static int uses(const chamfer_mesh *mesh, uint32_t from, uint32_t to) {
    uint32_t i, count = 0;
    for (i = 0; i < mesh->index_count; ++i) {
        const uint32_t next = i % 3 == 2 ? i - 2 : i + 1;
        count += same_place(mesh, mesh->indices[i], from) &&
                 same_place(mesh, mesh->indices[next], to);
    }
    return (int)count;
}

static int is_closed(const chamfer_mesh *mesh) {
    uint32_t i;
    for (i = 0; i < mesh->index_count; ++i) {
        const uint32_t a = mesh->indices[i];
        const uint32_t b = mesh->indices[i % 3 == 2 ? i - 2 : i + 1];
        if (uses(mesh, a, b) != 1 || uses(mesh, b, a) != 1) {
            return 0;
        }
    }
    return 1;
}

/* Each vertex stays on its face, and moves away from the two others by the width. */
static int is_pulled(const chamfer_mesh *mesh, float width) {
    uint32_t v, axis;
    for (v = 0; v < mesh->vertex_count; ++v) {
        for (axis = 0; axis < 3; ++axis) {
            const int on_face = fabsf(mesh->normals[3 * v + axis]) > 0.5f;
            const float expected = on_face ? 1.0f : 1.0f - width;
            if (fabsf(fabsf(mesh->positions[3 * v + axis]) - expected) > 1e-5f) {
                return 0;
            }
        }
    }
    return 1;
}

/* As far apart as rounding may put two floats of this size. */
static int near(const float *found, const float *expected, uint32_t count) {
    uint32_t i;
    for (i = 0; i < count; ++i) {
        if (!(fabsf(found[i] - expected[i]) <= 1e-5f)) {
            return 0;
        }
    }
    return 1;
}

/* A pulled vertex has the texture coordinates of the place where it is now. */
static int uvs_follow(const chamfer_mesh *mesh) {
    uint32_t v;
    float expected[2];
    for (v = 0; v < mesh->vertex_count; ++v) {
        project(mesh->positions + 3 * v, expected);
        if (!near(mesh->uvs[0].values + 2 * v, expected, 2)) {
            return 0;
        }
    }
    return 1;
}

static void check_mesh(const chamfer_mesh *mesh) {
    CHECK(mesh->struct_size == sizeof *mesh);
    CHECK(mesh->vertex_count == VERTICES);
    CHECK(mesh->index_count == 3 * TRIANGLES_OUT);
    CHECK(mesh->submesh_count == 1 && mesh->submesh_index_counts[0] == mesh->index_count);
    CHECK(mesh->uvs[0].components == 2 && uvs_follow(mesh));
    CHECK(mesh->uvs[1].components == 0 && mesh->uvs[1].values == NULL);
    CHECK(mesh->tangents == NULL && mesh->colors == NULL);
    CHECK(is_closed(mesh));
}

static void check_report(const chamfer_result *result, float width) {
    chamfer_totals totals = {.struct_size = sizeof totals};
    const chamfer_edge_verdict *verdicts = NULL;
    const chamfer_vertex_source *vertices = NULL;
    const chamfer_triangle_source *triangles = NULL;
    uint32_t verdict_count = 0, vertex_count = 0, triangle_count = 0, i;

    CHECK(chamfer_result_totals(result, &totals) == CHAMFER_STATUS_OK);
    CHECK(totals.hard_edges == 12 && totals.chamfered == 12);
    CHECK(totals.narrowed == 0 && totals.skipped == 0);
    CHECK(fabsf(totals.width - width) < 1e-6f && fabsf(totals.mean_width - 1.0f) < 1e-4f);

    CHECK(chamfer_result_verdicts(result, &verdicts, &verdict_count) == CHAMFER_STATUS_OK);
    CHECK(verdict_count == 12);
    for (i = 0; i < verdict_count; ++i) {
        CHECK(verdicts[i].outcome == CHAMFER_OUTCOME_FULL);
        CHECK(strcmp(chamfer_reason_string(verdicts[i].reason), "none") == 0);
        CHECK(fabsf(verdicts[i].widths[1] - width) < 1e-5f);
    }

    CHECK(chamfer_result_vertex_sources(result, &vertices, &vertex_count) == CHAMFER_STATUS_OK);
    CHECK(vertex_count == VERTICES && vertices[23].surface.vertices[0] < VERTICES);
    CHECK(chamfer_result_triangle_sources(result, &triangles, &triangle_count) ==
          CHAMFER_STATUS_OK);
    CHECK(triangle_count == TRIANGLES_OUT && triangles[0].kind == CHAMFER_TRIANGLE_SOURCE);
    CHECK(triangle_count > 12 && triangles[12].kind != CHAMFER_TRIANGLE_SOURCE);
}

static int32_t count_calls(void *user, float done) {
    CHECK(done >= 0.0f && done <= 1.0f);
    ++*(int *)user;
    return 0;
}

static int32_t stop(void *user, float done) {
    (void)user;
    (void)done;
    return 1;
}

static void chamfer_twice(const chamfer_mesh *cube) {
    const float width = 0.1f;
    chamfer_options options = {.struct_size = sizeof options};
    chamfer_error error = {.struct_size = sizeof error};
    chamfer_mesh once = {.struct_size = sizeof once}, twice = {.struct_size = sizeof twice};
    chamfer_result *first = NULL, *second = NULL;
    int calls = 0;

    CHECK(chamfer_options_init(&options) == CHAMFER_STATUS_OK);
    CHECK(options.width == 0.5f && options.width_unit == CHAMFER_WIDTH_PERCENT);
    options.width = width;
    options.width_unit = CHAMFER_WIDTH_MESH_UNITS;

    CHECK(chamfer_run(cube, &options, count_calls, &calls, &first, &error) == CHAMFER_STATUS_OK);
    CHECK(calls > 0 && error.message[0] == '\0');
    CHECK(chamfer_result_mesh(first, &once) == CHAMFER_STATUS_OK);
    check_mesh(&once);
    CHECK(is_pulled(&once, width));
    check_report(first, width);

    /* What comes out has no hard edge left, so it comes out again as it is. */
    CHECK(chamfer_run(&once, &options, NULL, NULL, &second, &error) == CHAMFER_STATUS_OK);
    CHECK(chamfer_result_mesh(second, &twice) == CHAMFER_STATUS_OK);
    check_mesh(&twice);
    CHECK(memcmp(once.positions, twice.positions, 3 * VERTICES * sizeof(float)) == 0);

    chamfer_result_destroy(first);
    chamfer_result_destroy(second);
    chamfer_result_destroy(NULL);
}

/* With three segments the cube is closed, has the counts of its grids, and all edges say so. */
static void round_the_cube(const chamfer_mesh *cube) {
    chamfer_options options = {.struct_size = sizeof options};
    chamfer_mesh rounded = {.struct_size = sizeof rounded};
    chamfer_result *result = NULL;
    const chamfer_edge_verdict *verdicts = NULL;
    const chamfer_vertex_source *sources = NULL;
    uint32_t verdict_count = 0, source_count = 0, off_the_faces = 0, i;

    CHECK(chamfer_options_init(&options) == CHAMFER_STATUS_OK);
    CHECK(options.segments == 1 && options.profile == 0.5f);
    options.width = 10.0f;
    options.segments = SEGMENTS;
    CHECK(chamfer_run(cube, &options, NULL, NULL, &result, NULL) == CHAMFER_STATUS_OK);
    CHECK(chamfer_result_mesh(result, &rounded) == CHAMFER_STATUS_OK);
    CHECK(rounded.vertex_count == 24 * SEGMENTS + 4 * (SEGMENTS - 1) * (SEGMENTS - 2));
    CHECK(rounded.index_count == 3 * (12 + 24 * SEGMENTS + 8 * SEGMENTS * SEGMENTS));
    CHECK(is_closed(&rounded));

    CHECK(chamfer_result_verdicts(result, &verdicts, &verdict_count) == CHAMFER_STATUS_OK);
    for (i = 0; i < verdict_count; ++i) {
        CHECK(verdicts[i].segments == SEGMENTS);
    }
    CHECK(chamfer_result_vertex_sources(result, &sources, &source_count) == CHAMFER_STATUS_OK);
    for (i = 0; i < source_count; ++i) {
        off_the_faces += (sources[i].owner_channels & CHAMFER_VERTEX_BETWEEN) != 0;
    }
    CHECK(off_the_faces == rounded.vertex_count - VERTICES);
    chamfer_result_destroy(result);
}

static void smooth_the_cube(const chamfer_mesh *cube) {
    chamfer_mesh bare = *cube, smooth = {.struct_size = sizeof smooth};
    chamfer_result *result = NULL;
    bare.normals = NULL;
    CHECK(chamfer_split_by_angle(&bare, 30.0f, &result, NULL) == CHAMFER_STATUS_OK);
    CHECK(chamfer_result_mesh(result, &smooth) == CHAMFER_STATUS_OK);
    CHECK(smooth.vertex_count == VERTICES);
    CHECK(near(smooth.normals, cube->normals, 3 * VERTICES));
    chamfer_result_destroy(result);
}

/* The call must fail with this status, say why, and leave no result. */
static void expect(int32_t status, uint32_t element, const chamfer_mesh *mesh,
                   const chamfer_options *options, chamfer_progress progress) {
    chamfer_error error = {.struct_size = sizeof error};
    chamfer_result *result = (chamfer_result *)&error;
    CHECK(chamfer_run(mesh, options, progress, NULL, &result, &error) == status);
    CHECK(result == NULL && error.status == status && error.element == element);
    CHECK(error.message[0] != '\0' && chamfer_status_string(status)[0] != '\0');
}

static void try_the_errors(void) {
    struct cube cube;
    chamfer_mesh mesh, changed;
    chamfer_options options = {.struct_size = sizeof options};
    chamfer_result *result = NULL;

    make_cube(&cube);
    mesh = view_cube(&cube);
    CHECK(chamfer_options_init(&options) == CHAMFER_STATUS_OK);

    expect(CHAMFER_STATUS_NULL_POINTER, CHAMFER_NO_ELEMENT, NULL, NULL, NULL);
    expect(CHAMFER_STATUS_CANCELLED, CHAMFER_NO_ELEMENT, &mesh, NULL, stop);
    CHECK(chamfer_run(&mesh, NULL, NULL, NULL, NULL, NULL) == CHAMFER_STATUS_NULL_POINTER);
    CHECK(chamfer_run(&mesh, NULL, NULL, NULL, &result, NULL) == CHAMFER_STATUS_OK);
    CHECK(chamfer_result_mesh(result, NULL) == CHAMFER_STATUS_NULL_POINTER);
    chamfer_result_destroy(result);

    changed = mesh;
    changed.struct_size = 0;
    expect(CHAMFER_STATUS_STRUCT_SIZE, CHAMFER_NO_ELEMENT, &changed, NULL, NULL);
    changed = mesh;
    changed.normals = NULL;
    expect(CHAMFER_STATUS_MISSING_NORMALS, CHAMFER_NO_ELEMENT, &changed, NULL, NULL);
    changed = mesh;
    changed.uvs[3].components = 5;
    expect(CHAMFER_STATUS_UV_COMPONENTS, 3, &changed, NULL, NULL);

    options.verify = 7;
    expect(CHAMFER_STATUS_BAD_OPTION, CHAMFER_NO_ELEMENT, &mesh, &options, NULL);

    cube.indices[35] = VERTICES;
    expect(CHAMFER_STATUS_INDEX_RANGE, 35, &mesh, NULL, NULL);
    cube.indices[35] = 0;
    cube.positions[17][1] = (float)NAN;
    expect(CHAMFER_STATUS_NOT_FINITE, 17, &mesh, NULL, NULL);
}

int main(void) {
    struct cube cube, untouched;
    chamfer_mesh mesh;

    CHECK(chamfer_abi_version() == CHAMFER_ABI_VERSION);
    CHECK(chamfer_version_string()[0] != '\0');
    CHECK(strcmp(name_from_the_second_unit(), "no_room") == 0);

    make_cube(&cube);
    untouched = cube;
    mesh = view_cube(&cube);
    chamfer_twice(&mesh);
    round_the_cube(&mesh);
    smooth_the_cube(&mesh);
    CHECK(memcmp(&cube, &untouched, sizeof cube) == 0);
    try_the_errors();

    printf("%d failures\n", failures);
    return failures != 0;
}
