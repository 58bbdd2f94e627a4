/* Everything that a caller can get wrong and the library can see. Each row is one of the table in
   docs/abi.md, word for word; the test compares what is printed with the page. */

#define _DEFAULT_SOURCE
#include "chamfer.h"

#include <math.h>
#include <pthread.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>

#define VERTICES 24
#define INDICES 36
#define CHANNELS CHAMFER_UV_CHANNELS

static int failures = 0;
static const char *row_of_now = "";

static void check(int condition, int line, const char *text) {
    if (!condition) {
        fprintf(stderr, "misuse.c:%d: not so: %s (%s)\n", line, text, row_of_now);
        ++failures;
    }
}

#define CHECK(condition) check((condition) != 0, __LINE__, #condition)

/* A cube with every stream that there is. */
struct model {
    float positions[VERTICES][3];
    float normals[VERTICES][3];
    float tangents[VERTICES][4];
    float colors[VERTICES][4];
    float uvs[CHANNELS][VERTICES][2];
    uint32_t indices[INDICES];
    uint32_t counts[2];
};

static struct model model;
static chamfer_held held[2];
static float submesh_factors[2], vertex_factors[VERTICES];
static chamfer_edge_factor edge_factors[2];
static chamfer_mesh mesh;
static chamfer_options options;

static void make_vertex(int v, int axis, float side) {
    const int corner = v % 4;
    const float right = corner % 2 ? side : -side, up = corner / 2 ? 1.0f : -1.0f;
    int channel;
    model.positions[v][axis] = model.normals[v][axis] = side;
    model.positions[v][(axis + 1) % 3] = right;
    model.positions[v][(axis + 2) % 3] = up;
    model.tangents[v][(axis + 1) % 3] = model.tangents[v][3] = 1.0f;
    for (channel = 0; channel < CHANNELS; ++channel) {
        model.uvs[channel][v][0] = right;
        model.uvs[channel][v][1] = up;
    }
}

/* Every row starts from a mesh and options without fault. */
static void reset(void) {
    static const uint32_t corners[6] = {0, 1, 2, 2, 1, 3};
    int v, i, channel;
    memset(&model, 0, sizeof model);
    for (v = 0; v < VERTICES; ++v) {
        make_vertex(v, v / 8, v / 4 % 2 ? 1.0f : -1.0f);
    }
    for (i = 0; i < INDICES; ++i) {
        model.indices[i] = (uint32_t)(4 * (i / 6)) + corners[i % 6];
    }
    model.counts[0] = model.counts[1] = INDICES / 2;
    memset(held, 0, sizeof held);
    submesh_factors[0] = submesh_factors[1] = 1.0f;
    for (v = 0; v < VERTICES; ++v) {
        vertex_factors[v] = 1.0f;
    }
    for (i = 0; i < 2; ++i) {
        edge_factors[i].vertices[0] = (uint32_t)i;
        edge_factors[i].vertices[1] = (uint32_t)i + 2;
        edge_factors[i].factor = 1.0f;
    }

    mesh.struct_size = sizeof mesh;
    CHECK(chamfer_mesh_init(&mesh) == CHAMFER_STATUS_OK);
    mesh.vertex_count = VERTICES;
    mesh.positions = &model.positions[0][0];
    mesh.normals = &model.normals[0][0];
    mesh.tangents = &model.tangents[0][0];
    mesh.colors = &model.colors[0][0];
    for (channel = 0; channel < CHANNELS; ++channel) {
        mesh.uvs[channel].components = 2;
        mesh.uvs[channel].values = &model.uvs[channel][0][0];
    }
    mesh.submesh_count = 2;
    mesh.submesh_index_counts = model.counts;
    mesh.index_count = INDICES;
    mesh.indices = model.indices;
    mesh.held_count = 2;
    mesh.held = held;
    options.struct_size = sizeof options;
    CHECK(chamfer_options_init(&options) == CHAMFER_STATUS_OK);
}

/* The same with factors of every kind. */
static void reset_with_factors(void) {
    reset();
    mesh.submesh_factors = submesh_factors;
    mesh.vertex_factors = vertex_factors;
    mesh.edge_factor_count = 2;
    mesh.edge_factors = edge_factors;
}

static chamfer_result *const garbage = (chamfer_result *)0x5A5A5A5A;

/* What every failed call leaves behind: no result, and the reason. */
static void check_told(int32_t status, int32_t expected, chamfer_result *result,
                       const chamfer_error *error) {
    CHECK(status == expected);
    CHECK(error->status == status);
    CHECK((result == NULL) == (status != CHAMFER_STATUS_OK));
    CHECK((error->message[0] == '\0') == (status == CHAMFER_STATUS_OK));
    CHECK(strcmp(chamfer_status_string(status), "unknown status") != 0);
    chamfer_result_destroy(result);
}

static chamfer_object object_of(uint32_t number) {
    chamfer_object object;
    int axis;
    memset(&object, 0, sizeof object);
    object.mesh = number;
    for (axis = 0; axis < 4; ++axis) {
        object.transform[5 * axis] = 1.0f;
    }
    return object;
}

/* The same in a scene of two such meshes. */
static void run_scene(int32_t expected, const chamfer_mesh *on, const chamfer_options *how) {
    const chamfer_mesh *const meshes[2] = {on, on};
    const chamfer_object objects[2] = {object_of(0), object_of(1)};
    chamfer_error error = {.struct_size = sizeof error};
    chamfer_result *results[3] = {garbage, garbage, garbage};
    const int32_t status =
        chamfer_scene_run(meshes, 2, objects, 2, how, NULL, NULL, results, &error);
    check_told(status, expected, results[0], &error);
    check_told(status, expected, results[1], &error);
    CHECK(results[2] == garbage);
}

static void run(int32_t expected, const chamfer_mesh *on, const chamfer_options *how) {
    static struct model before;
    chamfer_error error = {.struct_size = sizeof error};
    chamfer_result *result = garbage;
    int32_t status;
    memcpy(&before, &model, sizeof model);
    status = chamfer_run(on, how, NULL, NULL, &result, &error);
    check_told(status, expected, result, &error);
    run_scene(expected, on, how);
    CHECK(memcmp(&before, &model, sizeof model) == 0);
}

static void split(int32_t expected, const chamfer_mesh *on, float angle) {
    chamfer_error error = {.struct_size = sizeof error};
    chamfer_result *result = garbage;
    const int32_t status = chamfer_split_by_angle(on, angle, &result, &error);
    check_told(status, expected, result, &error);
}

/* Both functions that make a result. */
static void both(int32_t expected) {
    run(expected, &mesh, &options);
    split(expected, &mesh, 30.0f);
}

static chamfer_result *good_result(void) {
    chamfer_result *result = NULL;
    CHECK(chamfer_run(&mesh, &options, NULL, NULL, &result, NULL) == CHAMFER_STATUS_OK);
    return result;
}

/* All getters, each with all its places or without one; none may write. */
static void getters(int32_t expected, const chamfer_result *result, int shift, int has_place) {
    union {
        chamfer_mesh mesh;
        chamfer_totals totals;
        const void *array;
    } room[2], before[2];
    uint32_t counts[2] = {77, 77};
    char *at = has_place ? (char *)room + shift : NULL;
    memset(room, 0x5A, sizeof room);
    memcpy(before, room, sizeof room);
    CHECK(chamfer_result_mesh(result, (chamfer_mesh *)(void *)at) == expected);
    CHECK(chamfer_result_totals(result, (chamfer_totals *)(void *)at) == expected);
    CHECK(chamfer_result_verdicts(result, (const chamfer_edge_verdict **)(void *)at, counts) ==
          expected);
    CHECK(chamfer_result_vertex_sources(result, (const chamfer_vertex_source **)(void *)at,
                                        counts) == expected);
    CHECK(chamfer_result_triangle_sources(result, (const chamfer_triangle_source **)(void *)at,
                                          counts) == expected);
    CHECK(memcmp(before, room, sizeof room) == 0 && counts[0] == 77);
}

static void null_structs(int32_t expected) {
    chamfer_error error = {.struct_size = sizeof error};
    chamfer_result *result = good_result();
    const chamfer_edge_verdict *verdicts = NULL;
    run(expected, NULL, &options);
    split(expected, NULL, 30.0f);
    CHECK(chamfer_run(&mesh, &options, NULL, NULL, NULL, &error) == expected);
    CHECK(error.status == expected);
    CHECK(chamfer_split_by_angle(&mesh, 30.0f, NULL, NULL) == expected);
    CHECK(chamfer_options_init(NULL) == expected && chamfer_mesh_init(NULL) == expected);
    getters(expected, NULL, 0, 1);
    getters(expected, result, 0, 0);
    CHECK(chamfer_result_verdicts(result, &verdicts, NULL) == expected && verdicts == NULL);
    chamfer_result_destroy(result);
}

static void null_extras(int32_t expected) {
    chamfer_result *result = NULL;
    CHECK(chamfer_run(&mesh, NULL, NULL, NULL, &result, NULL) == expected);
    chamfer_result_destroy(result);
}

static void null_arrays(int32_t expected) {
    int channel;
    mesh.positions = NULL;
    both(expected);
    reset();
    mesh.indices = NULL;
    both(expected);
    reset();
    mesh.submesh_index_counts = NULL;
    both(expected);
    reset();
    mesh.held = NULL;
    both(expected);
    reset_with_factors();
    mesh.edge_factors = NULL;
    both(expected);
    for (channel = 0; channel < CHANNELS; ++channel) {
        reset();
        mesh.uvs[channel].values = NULL;
        both(expected);
    }
}

static void null_of_nothing(int32_t expected) {
    chamfer_mesh empty = {.struct_size = sizeof empty};
    CHECK(chamfer_mesh_init(&empty) == CHAMFER_STATUS_OK);
    run(expected, &empty, &options);
    split(expected, &empty, 30.0f);
    mesh.tangents = mesh.colors = NULL;
    reset_with_factors();
    mesh.edge_factor_count = 0;
    mesh.edge_factors = NULL;
    both(expected);
    reset_with_factors();
    mesh.submesh_factors = mesh.vertex_factors = NULL;
    both(expected);
}

static void no_normals(int32_t expected) {
    mesh.normals = NULL;
    run(expected, &mesh, &options);
}

static void no_normals_yet(int32_t expected) {
    mesh.normals = NULL;
    split(expected, &mesh, 30.0f);
    mesh.normals = &model.normals[0][0];
    model.normals[3][1] = (float)NAN;
    split(expected, &mesh, 30.0f);
}

static void misaligned_arrays(int32_t expected) {
    char *const by_one = (char *)&model + 1;
    const float *const floats = (const float *)(void *)by_one;
    const uint32_t *const numbers = (const uint32_t *)(void *)by_one;
    int channel;
    mesh.positions = floats;
    both(expected);
    reset();
    mesh.normals = floats;
    both(expected);
    reset();
    mesh.tangents = floats;
    both(expected);
    reset();
    mesh.colors = floats;
    both(expected);
    reset();
    mesh.indices = numbers;
    both(expected);
    reset();
    mesh.submesh_index_counts = numbers;
    both(expected);
    reset();
    mesh.held = (const chamfer_held *)(const void *)by_one;
    both(expected);
    reset_with_factors();
    mesh.submesh_factors = floats;
    both(expected);
    reset_with_factors();
    mesh.vertex_factors = floats;
    both(expected);
    reset_with_factors();
    mesh.edge_factors = (const chamfer_edge_factor *)(const void *)by_one;
    both(expected);
    for (channel = 0; channel < CHANNELS; ++channel) {
        reset();
        mesh.uvs[channel].values = floats;
        both(expected);
    }
}

static void misaligned_structs(int32_t expected) {
    char *const mesh_by_four = (char *)&mesh + 4, *const options_by_two = (char *)&options + 2;
    chamfer_result *result = good_result(), *out[2] = {garbage, garbage};
    char *const out_by_one = (char *)out + 1;
    run(expected, (const chamfer_mesh *)(void *)mesh_by_four, &options);
    run(expected, &mesh, (const chamfer_options *)(void *)options_by_two);
    CHECK(chamfer_run(&mesh, &options, NULL, NULL, (chamfer_result **)(void *)out_by_one, NULL) ==
          expected);
    CHECK(out[0] == garbage && out[1] == garbage);
    CHECK(chamfer_options_init((chamfer_options *)(void *)options_by_two) == expected);
    CHECK(chamfer_mesh_init((chamfer_mesh *)(void *)mesh_by_four) == expected);
    getters(expected, result, 1, 1);
    chamfer_result_destroy(result);
}

static void wrong_sizes(int32_t expected) {
    static const uint32_t wrong[] = {0, 1, 4, sizeof(chamfer_options) - 1, 4097, 0xFFFFFFFF};
    chamfer_result *result = good_result();
    chamfer_totals totals = {.struct_size = 3};
    size_t i;
    for (i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        reset();
        mesh.struct_size = wrong[i];
        both(expected);
        CHECK(chamfer_mesh_init(&mesh) == expected);
        CHECK(chamfer_result_mesh(result, &mesh) == expected);
        reset();
        options.struct_size = wrong[i];
        run(expected, &mesh, &options);
        CHECK(chamfer_options_init(&options) == expected);
    }
    CHECK(chamfer_result_totals(result, &totals) == expected && totals.hard_edges == 0);
    chamfer_result_destroy(result);
}

/* Structs of a header to come. */
struct later_options {
    chamfer_options today;
    uint32_t added;
};

struct later_mesh {
    chamfer_mesh today;
    void *added;
};

static void later_structs(int32_t expected, int is_set) {
    struct later_options how;
    struct later_mesh on;
    memset(&how, 0, sizeof how);
    memset(&on, 0, sizeof on);
    how.today = options;
    how.today.struct_size = sizeof how;
    how.added = (uint32_t)is_set;
    run(expected, &mesh, &how.today);
    on.today = mesh;
    on.today.struct_size = sizeof on;
    on.added = is_set ? &on : NULL;
    run(expected, &on.today, &options);
    split(expected, &on.today, 30.0f);
}

static void later_fields_set(int32_t expected) { later_structs(expected, 1); }

static void later_fields_zero(int32_t expected) { later_structs(expected, 0); }

/* Behind the sizes of the first header stands garbage. */
static void earlier_structs(int32_t expected) {
    chamfer_error error;
    chamfer_result *result = garbage;
    mesh.struct_size = offsetof(chamfer_mesh, held_count);
    mesh.held_count = 0xFFFFFFFF;
    mesh.held = (const chamfer_held *)(const void *)garbage;
    both(expected);
    reset();
    mesh.struct_size = offsetof(chamfer_mesh, submesh_factors);
    mesh.submesh_factors = mesh.vertex_factors = (const float *)(const void *)garbage;
    mesh.edge_factor_count = 0xFFFFFFFF;
    both(expected);
    reset();
    options.struct_size = offsetof(chamfer_options, width_mode);
    options.width_mode = options.convexity = 0xFFFFFFFF;
    options.min_angle = options.max_angle = options.hard_angle = options.scale[4] = (float)NAN;
    run(expected, &mesh, &options);
    memset(&error, 0x5A, sizeof error);
    error.struct_size = offsetof(chamfer_error, mesh);
    CHECK(chamfer_run(&mesh, NULL, NULL, NULL, &result, &error) == expected);
    CHECK(error.status == expected && error.mesh == 0x5A5A5A5A);
    chamfer_result_destroy(result);
}

static void error_struct(int32_t expected, uint32_t size, int shift) {
    union {
        chamfer_error error;
        char bytes[sizeof(chamfer_error) + 8];
    } room, before;
    chamfer_result *result = garbage;
    memset(&room, 0x5A, sizeof room);
    room.error.struct_size = size;
    memcpy(&before, &room, sizeof room);
    CHECK(chamfer_run(&mesh, &options, NULL, NULL, &result,
                      (chamfer_error *)(void *)(room.bytes + shift)) == expected);
    CHECK(result == NULL && memcmp(&room, &before, sizeof room) == 0);
}

static void misaligned_error(int32_t expected) { error_struct(expected, sizeof(chamfer_error), 1); }

static void wrong_error_size(int32_t expected) {
    error_struct(expected, 0, 0);
    error_struct(expected, sizeof(chamfer_error) - 1, 0);
    error_struct(expected, 0xFFFFFFFF, 0);
}

static void past_the_address_space(int32_t expected) {
    const float *const near_the_end = (const float *)(UINTPTR_MAX - 15);
    mesh.positions = near_the_end;
    both(expected);
    reset();
    mesh.uvs[3].values = near_the_end;
    both(expected);
    reset();
    mesh.indices = (const uint32_t *)near_the_end;
    both(expected);
    reset();
    mesh.held = (const chamfer_held *)near_the_end;
    both(expected);
    reset();
    mesh.vertex_factors = near_the_end;
    both(expected);
    reset_with_factors();
    mesh.edge_factors = (const chamfer_edge_factor *)near_the_end;
    both(expected);
}

static void unknown_choices(int32_t expected) {
    options.width_unit = 2;
    run(expected, &mesh, &options);
    reset();
    options.verify = 0xFFFFFFFF;
    run(expected, &mesh, &options);
    reset();
    options.submesh_mode = 3;
    run(expected, &mesh, &options);
}

static void wrong_breadths(int32_t expected) {
    const float wrong[] = {-1e-30f, 1.001f, (float)NAN, (float)INFINITY, (float)-INFINITY};
    size_t i;
    for (i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        options.least_breadth = wrong[i];
        run(expected, &mesh, &options);
        reset();
        options.evenness = wrong[i];
        run(expected, &mesh, &options);
        reset();
    }
}

static void unknown_modes(int32_t expected) {
    options.width_mode = 4;
    run(expected, &mesh, &options);
    reset();
    options.convexity = 3;
    run(expected, &mesh, &options);
}

static void wrong_ranges(int32_t expected) {
    const float wrong[] = {-1e-30f, 180.001f, (float)NAN, (float)INFINITY, (float)-INFINITY};
    size_t i;
    for (i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        reset();
        options.min_angle = wrong[i];
        run(expected, &mesh, &options);
        reset();
        options.max_angle = wrong[i];
        run(expected, &mesh, &options);
        reset();
        options.hard_angle = wrong[i];
        run(expected, &mesh, &options);
    }
    reset();
    options.hard_angle = 90.001f;
    run(expected, &mesh, &options);
    reset();
    options.min_angle = 60.0f;
    options.max_angle = 59.0f;
    run(expected, &mesh, &options);
}

static void wrong_scales(int32_t expected) {
    const float wrong[] = {0.0f, (float)NAN, (float)INFINITY};
    size_t i;
    for (i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        options.scale[4] = wrong[i];
        run(expected, &mesh, &options);
    }
}

static void wrong_rounding(int32_t expected) {
    const float wrong[] = {-0.1f, 1.1f, (float)NAN};
    size_t i;
    for (i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        options.profile = wrong[i];
        run(expected, &mesh, &options);
    }
    reset();
    options.segments = 33;
    run(expected, &mesh, &options);
    options.segments = 0xFFFFFFFF;
    run(expected, &mesh, &options);
}

static void wrong_factors(int32_t expected) {
    const float wrong[] = {-1e-30f, (float)NAN, (float)INFINITY};
    size_t i;
    for (i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        reset_with_factors();
        submesh_factors[1] = wrong[i];
        run(expected, &mesh, &options);
        reset_with_factors();
        vertex_factors[VERTICES - 1] = wrong[i];
        run(expected, &mesh, &options);
        reset_with_factors();
        edge_factors[1].factor = wrong[i];
        run(expected, &mesh, &options);
    }
}

static void edges_past_the_end(int32_t expected) {
    reset_with_factors();
    edge_factors[1].vertices[0] = VERTICES;
    run(expected, &mesh, &options);
    edge_factors[1].vertices[0] = 0;
    edge_factors[0].vertices[1] = 0xFFFFFFFF;
    run(expected, &mesh, &options);
}

static void wrong_widths(int32_t expected) {
    const float wrong[] = {-1.0f, -1e-30f, (float)NAN, (float)INFINITY, (float)-INFINITY};
    size_t i;
    for (i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        options.width = wrong[i];
        options.width_unit = i % 2 ? CHAMFER_WIDTH_PERCENT : CHAMFER_WIDTH_MESH_UNITS;
        run(expected, &mesh, &options);
    }
}

static void huge_widths(int32_t expected) {
    const float huge[] = {1e9f, 3e38f};
    size_t i;
    for (i = 0; i < sizeof huge / sizeof *huge; ++i) {
        options.width = huge[i];
        options.width_unit = CHAMFER_WIDTH_MESH_UNITS;
        run(expected, &mesh, &options);
        options.width_unit = CHAMFER_WIDTH_PERCENT;
        run(expected, &mesh, &options);
    }
}

static void no_such_submesh(int32_t expected) {
    options.submesh_mode = CHAMFER_SUBMESH_GIVEN;
    options.submesh = 2;
    run(expected, &mesh, &options);
    options.submesh = 0xFFFFFFFF;
    run(expected, &mesh, &options);
}

static void wrong_angles(int32_t expected) {
    split(expected, &mesh, -0.5f);
    split(expected, &mesh, 180.5f);
    split(expected, &mesh, (float)NAN);
    split(expected, &mesh, (float)INFINITY);
}

/* NaN and both infinities in the last place of each stream; smoothing does not read normals. */
static void not_finite(int32_t expected) {
    const float wrong[] = {(float)NAN, (float)INFINITY, (float)-INFINITY};
    float *const places[] = {
        &model.positions[23][2], &model.normals[23][2], &model.tangents[23][3],
        &model.colors[23][3],    &model.uvs[0][23][1],  &model.uvs[7][23][1],
        &held[1].from[2],        &held[1].to[0],        &held[1].radius,
    };
    size_t i, place;
    for (place = 0; place < sizeof places / sizeof *places; ++place) {
        for (i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
            reset();
            *places[place] = wrong[i];
            run(expected, &mesh, &options);
            if (place != 1) {
                split(expected, &mesh, 30.0f);
            }
        }
    }
}

static void indices_past_the_end(int32_t expected) {
    model.indices[35] = VERTICES;
    both(expected);
    model.indices[35] = 0xFFFFFFFF;
    both(expected);
    reset();
    mesh.vertex_count = 23;
    both(expected);
}

static void no_triangles(int32_t expected) {
    model.counts[0] = 17;
    model.counts[1] = 19;
    both(expected);
}

static void wrong_totals(int32_t expected) {
    model.counts[1] = 15;
    both(expected);
    model.counts[0] = model.counts[1] = 0xFFFFFFFF;
    both(expected);
    reset();
    mesh.submesh_count = 0;
    both(expected);
    reset();
    mesh.index_count = 33;
    both(expected);
}

static void wrong_uv_widths(int32_t expected) {
    mesh.uvs[5].components = 1;
    both(expected);
    mesh.uvs[5].components = 5;
    both(expected);
    mesh.uvs[5].components = 0xFFFFFFFF;
    both(expected);
}

/* Read only, so nothing is lost. */
static void shared_arrays(int32_t expected) {
    int channel;
    for (channel = 0; channel < CHANNELS; ++channel) {
        mesh.uvs[channel].values = mesh.uvs[0].values + channel;
        mesh.vertex_count = VERTICES;
    }
    mesh.colors = mesh.tangents;
    run(expected, &mesh, &options);
}

/* At the start and in the middle of an array, and in the mesh struct: nothing is written. */
static void overlapping_places(int32_t expected) {
    static struct model before;
    static struct {
        chamfer_mesh mesh;
        char room[sizeof(chamfer_error)];
    } own;
    char *const places[] = {(char *)model.positions, (char *)model.uvs[7], (char *)model.indices,
                            (char *)&own.mesh};
    chamfer_error error = {.struct_size = sizeof error}, *within;
    chamfer_result *result = garbage, **out;
    size_t i;
    memset(&own, 0, sizeof own);
    own.mesh = mesh;
    memcpy(&before, &model, sizeof model);
    for (i = 0; i < sizeof places / sizeof *places; ++i) {
        within = (chamfer_error *)(void *)places[i];
        out = (chamfer_result **)(void *)(places[i] + (8 - (size_t)places[i] % 8) % 8);
        CHECK(chamfer_run(&own.mesh, &options, NULL, NULL, out, &error) == expected);
        CHECK(chamfer_run(&own.mesh, &options, NULL, NULL, &result, within) == expected);
        CHECK(chamfer_split_by_angle(&own.mesh, 30.0f, out, NULL) == expected);
    }
    out = (chamfer_result **)(void *)((char *)&error + 8);
    CHECK(chamfer_run(&mesh, &options, NULL, NULL, out, &error) == expected);
    CHECK(result == garbage && error.status == 0);
    CHECK(memcmp(&before, &model, sizeof model) == 0);
    /* Not all of its bytes, as some are padding. */
    CHECK(own.mesh.struct_size == sizeof mesh && own.mesh.vertex_count == VERTICES);
    CHECK(own.mesh.positions == mesh.positions && own.mesh.normals == mesh.normals);
}

/* A scene that lacks one of its arrays. */
static void null_scene(int32_t expected) {
    const chamfer_mesh *const meshes[1] = {&mesh};
    const chamfer_object objects[1] = {object_of(0)};
    chamfer_error error = {.struct_size = sizeof error};
    chamfer_result *results[2] = {garbage, garbage};
    int32_t status = chamfer_scene_run(NULL, 1, objects, 1, NULL, NULL, NULL, results, &error);
    check_told(status, expected, results[0], &error);
    status = chamfer_scene_run(meshes, 1, NULL, 1, NULL, NULL, NULL, results, &error);
    check_told(status, expected, results[0], &error);
    CHECK(chamfer_scene_run(meshes, 1, objects, 1, NULL, NULL, NULL, NULL, &error) == expected);
    CHECK(error.status == expected && error.mesh == CHAMFER_NO_ELEMENT && results[1] == garbage);
}

static void scene_of_nothing(int32_t expected) {
    const chamfer_mesh *const meshes[1] = {&mesh};
    chamfer_result *results[2] = {garbage, garbage};
    CHECK(chamfer_scene_run(NULL, 0, NULL, 0, NULL, NULL, NULL, NULL, NULL) == expected);
    CHECK(chamfer_scene_run(meshes, 0, NULL, 0, NULL, NULL, NULL, results, NULL) == expected);
    CHECK(results[0] == garbage);
    CHECK(chamfer_scene_run(meshes, 1, NULL, 0, NULL, NULL, NULL, results, NULL) == expected);
    CHECK(results[0] != NULL && results[0] != garbage && results[1] == garbage);
    chamfer_result_destroy(results[0]);
}

static void wrong_object(int32_t expected, chamfer_object object) {
    const chamfer_mesh *const meshes[1] = {&mesh};
    const chamfer_object objects[2] = {object_of(0), object};
    chamfer_error error = {.struct_size = sizeof error};
    chamfer_result *results[1] = {garbage};
    const int32_t status =
        chamfer_scene_run(meshes, 1, objects, 2, &options, NULL, NULL, results, &error);
    check_told(status, expected, results[0], &error);
    CHECK(error.element == 1);
}

static void no_such_mesh(int32_t expected) {
    wrong_object(expected, object_of(1));
    wrong_object(expected, object_of(0xFFFFFFFF));
}

static void wrong_transforms(int32_t expected) {
    const float wrong[] = {(float)NAN, (float)INFINITY, (float)-INFINITY};
    size_t i, place;
    for (place = 0; place < 16; ++place) {
        for (i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
            chamfer_object object = object_of(0);
            object.transform[place] = wrong[i];
            wrong_object(expected, object);
        }
    }
}

/* In each array that a scene reads, and in its options: nothing is written. */
static void overlapping_scene(int32_t expected) {
    static struct model before;
    static union {
        const chamfer_mesh *meshes[sizeof(chamfer_error) / sizeof(void *)];
        chamfer_object objects[4];
        chamfer_options options;
        chamfer_held held[10];
        chamfer_result *results[sizeof(chamfer_error) / sizeof(void *)];
    } room, untouched;
    const chamfer_mesh *meshes[2] = {&mesh, &mesh}, *const *these = meshes;
    chamfer_object two[2] = {object_of(0), object_of(1)}, *objects = two;
    chamfer_options *how = &options;
    chamfer_error error = {.struct_size = sizeof error};
    chamfer_result *results[2] = {garbage, garbage};
    int which;
    memcpy(&before, &model, sizeof model);
    for (which = 0; which < 5; ++which) {
        memset(&room, 0, sizeof room);
        these = which == 0 ? room.meshes : meshes;
        objects = which == 1 ? room.objects : two;
        how = which == 2 ? &room.options : &options;
        mesh.held = which == 3 ? room.held : held;
        room.meshes[0] = which == 0 ? &mesh : NULL;
        room.meshes[1] = which == 0 ? &mesh : NULL;
        if (which == 2) {
            room.options = options;
        }
        memcpy(&untouched, &room, sizeof room);
        CHECK(chamfer_scene_run(these, 2, objects, 2, how, NULL, NULL,
                                which == 4 ? (chamfer_result **)(void *)model.positions
                                           : room.results,
                                &error) == expected);
        CHECK(chamfer_scene_run(these, 2, objects, 2, how, NULL, NULL, results,
                                which == 4 ? (chamfer_error *)(void *)model.positions
                                           : (chamfer_error *)(void *)&room) == expected);
        CHECK(memcmp(&untouched, &room, sizeof room) == 0);
    }
    CHECK(chamfer_scene_run(meshes, 2, two, 2, &options, NULL, NULL,
                            (chamfer_result **)(void *)((char *)&error + 8), &error) == expected);
    CHECK(results[0] == garbage && error.status == 0);
    CHECK(memcmp(&before, &model, sizeof model) == 0);
}

/* What lies behind a struct that states a size too small is not a part of it. */
static void mesh_behind_a_short_error(int32_t expected) {
    static struct {
        uint32_t struct_size;
        uint32_t apart;
        float positions[3 * VERTICES];
    } memory;
    chamfer_result *result = garbage;
    memory.struct_size = 4;
    memcpy(memory.positions, model.positions, sizeof memory.positions);
    mesh.positions = memory.positions;
    CHECK(chamfer_run(&mesh, &options, NULL, NULL, &result, (chamfer_error *)(void *)&memory) ==
          expected);
    CHECK(result == NULL);
}

/* Address space without memory: whoever looks there is ended by the system. */
static void *out_of_bounds(size_t bytes) {
    void *space = mmap(NULL, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    CHECK(space != MAP_FAILED);
    return space;
}

static void past_32_bits(int32_t expected) {
    const uint32_t counts[] = {0x20000001, 0xFFFFFFFF};
    /* Far less than the counts say, as valgrind does not give so much address space. */
    const size_t bytes = (size_t)1 << 30;
    void *space = out_of_bounds(bytes);
    size_t i;
    for (i = 0; i < sizeof counts / sizeof *counts; ++i) {
        reset();
        mesh.indices = space;
        mesh.index_count = counts[i] / 3 * 3;
        model.counts[0] = mesh.index_count;
        model.counts[1] = 0;
        both(expected);
        reset();
        mesh.vertex_count = counts[i];
        mesh.positions = mesh.normals = mesh.tangents = mesh.colors = space;
        memset(mesh.uvs, 0, sizeof mesh.uvs);
        both(expected);
    }
    munmap(space, bytes);
}

struct stopper {
    int calls, stop_at;
};

static int32_t stop(void *user, float done) {
    struct stopper *stopper = user;
    CHECK(done >= 0.0f && done <= 1.0f);
    return ++stopper->calls == stopper->stop_at ? -1 : 0;
}

/* Stopped at the first call, at the second, and so on, until it comes to an end. */
static void cancelled(int32_t expected) {
    struct stopper stopper = {0, 0};
    int32_t status = expected;
    while (status == expected) {
        chamfer_error error = {.struct_size = sizeof error};
        chamfer_result *result = garbage;
        ++stopper.stop_at;
        stopper.calls = 0;
        status = chamfer_run(&mesh, &options, stop, &stopper, &result, &error);
        check_told(status, status, result, &error);
        CHECK(status == expected ? stopper.calls == stopper.stop_at : status == CHAMFER_STATUS_OK);
    }
    CHECK(stopper.stop_at > 3);
}

static void *look(void *user) {
    const chamfer_result *result = user;
    const chamfer_edge_verdict *verdicts = NULL;
    chamfer_mesh view = {.struct_size = sizeof view};
    chamfer_result *again = NULL;
    uint32_t count = 0;
    int round;
    for (round = 0; round < 20; ++round) {
        CHECK(chamfer_result_mesh(result, &view) == CHAMFER_STATUS_OK);
        CHECK(chamfer_result_verdicts(result, &verdicts, &count) == CHAMFER_STATUS_OK);
        CHECK(count == 12 && view.vertex_count >= VERTICES);
        CHECK(chamfer_run(&view, NULL, NULL, NULL, &again, NULL) == CHAMFER_STATUS_OK);
        chamfer_result_destroy(again);
    }
    return NULL;
}

static void many_threads(int32_t expected) {
    pthread_t threads[4];
    chamfer_result *result = good_result();
    size_t i;
    for (i = 0; i < 4; ++i) {
        CHECK(pthread_create(&threads[i], NULL, look, result) == 0);
    }
    for (i = 0; i < 4; ++i) {
        CHECK(pthread_join(threads[i], NULL) == expected);
    }
    chamfer_result_destroy(result);
}

static void unknown_numbers(int32_t expected) {
    CHECK(strcmp(chamfer_status_string(-5), "unknown status") == expected);
    CHECK(strcmp(chamfer_status_string(0x7FFFFFFF), "unknown status") == expected);
    CHECK(strcmp(chamfer_reason_string(0xFFFFFFFF), "unknown_reason") == expected);
}

static void destroyed_twice(int32_t expected) {
    chamfer_result *result = good_result();
    (void)expected;
    chamfer_result_destroy(result);
    result = NULL;
    chamfer_result_destroy(result);
    chamfer_result_destroy(result);
}

struct row {
    const char *misuse, *name;
    int32_t status;
    void (*try_it)(int32_t expected);
};

#define ROW(misuse, name, try_it) {misuse, #name, CHAMFER_STATUS_##name, try_it}

static void zeroed_options(int32_t expected) {
    chamfer_options blank;
    chamfer_totals found;
    chamfer_result *result = NULL;
    memset(&blank, 0, sizeof blank);
    blank.struct_size = sizeof blank;
    run(expected, &mesh, &blank);
    CHECK(chamfer_run(&mesh, &blank, NULL, NULL, &result, NULL) == expected);
    found.struct_size = sizeof found;
    CHECK(chamfer_result_totals(result, &found) == expected && found.hard_edges > 0);
    chamfer_result_destroy(result);
}

static const struct row rows[] = {
    ROW("`mesh`, `out`, a getter's `result` or a place to write to is NULL", NULL_POINTER,
        null_structs),
    ROW("`options`, `progress`, `error` is NULL", OK, null_extras),
    ROW("`positions`, `indices`, `submesh_index_counts`, `held`, `edge_factors`, or the "
        "values of a UV channel with components, is NULL while its count is not 0",
        NULL_POINTER, null_arrays),
    ROW("a NULL array whose count is 0, or a stream that may be absent", OK, null_of_nothing),
    ROW("`normals` is NULL", MISSING_NORMALS, no_normals),
    ROW("`normals` is NULL or not finite in `chamfer_split_by_angle`", OK, no_normals_yet),
    ROW("an array that is not aligned for its type", MISALIGNED, misaligned_arrays),
    ROW("a struct or a place to write to that is not aligned for its type", MISALIGNED,
        misaligned_structs),
    ROW("`struct_size` is 0, garbage, or between two versions", STRUCT_SIZE, wrong_sizes),
    ROW("a field of a newer header is set", STRUCT_SIZE, later_fields_set),
    ROW("a struct of a newer header whose new fields are zero", OK, later_fields_zero),
    ROW("a struct of an older header, whatever stands behind it", OK, earlier_structs),
    ROW("the `error` struct itself is misaligned", MISALIGNED, misaligned_error),
    ROW("the `error` struct itself is of unknown size", STRUCT_SIZE, wrong_error_size),
    ROW("a count so large that the array would wrap around the address space", COUNT_OVERFLOW,
        past_the_address_space),
    ROW("a zeroed `chamfer_options` that states its size", OK, zeroed_options),
    ROW("`width_unit`, `verify` or `submesh_mode` is none of its constants", BAD_OPTION,
        unknown_choices),
    ROW("`least_breadth` or `evenness` is negative, above 1 or NaN", BAD_OPTION, wrong_breadths),
    ROW("`width_mode` or `convexity` is none of its constants", BAD_OPTION, unknown_modes),
    ROW("`min_angle`, `max_angle` or `hard_angle` is out of its range, or the first above the "
        "second",
        BAD_OPTION, wrong_ranges),
    ROW("`scale` is not finite, or flattens the mesh", BAD_OPTION, wrong_scales),
    ROW("`segments` is above 32, or `profile` is negative, above 1 or NaN", BAD_OPTION,
        wrong_rounding),
    ROW("a factor of `submesh_factors`, `vertex_factors` or `edge_factors` is negative, infinite "
        "or NaN",
        BAD_FACTOR, wrong_factors),
    ROW("an edge of `edge_factors` is of a vertex that does not exist", EDGE_RANGE,
        edges_past_the_end),
    ROW("a negative, infinite or NaN width", BAD_WIDTH, wrong_widths),
    ROW("a width larger than the mesh, however large", OK, huge_widths),
    ROW("`CHAMFER_SUBMESH_GIVEN` with a submesh that the mesh lacks", SUBMESH_RANGE,
        no_such_submesh),
    ROW("an angle below 0, above 180 or NaN", BAD_ANGLE, wrong_angles),
    ROW("NaN or infinity in any stream or held place", NOT_FINITE, not_finite),
    ROW("an index past the last vertex", INDEX_RANGE, indices_past_the_end),
    ROW("a submesh whose index count is not a multiple of three", INDEX_COUNT, no_triangles),
    ROW("submesh index counts that add up to something else than `index_count`", INDEX_TOTAL,
        wrong_totals),
    ROW("a UV channel of 1 or more than 4 components", UV_COMPONENTS, wrong_uv_widths),
    ROW("arrays of the mesh that overlap each other", OK, shared_arrays),
    ROW("`out` or `error` within the mesh struct, one of its arrays, or each other", OVERLAP,
        overlapping_places),
    ROW("`meshes`, `objects` or `results` of a scene is NULL while its count is not 0",
        NULL_POINTER, null_scene),
    ROW("a scene without meshes or without objects", OK, scene_of_nothing),
    ROW("an object of a mesh that the scene does not have", OBJECT_MESH, no_such_mesh),
    ROW("NaN or infinity in the transform of an object", BAD_TRANSFORM, wrong_transforms),
    ROW("`results` or `error` of a scene within what it reads, or each other", OVERLAP,
        overlapping_scene),
    ROW("an error struct that states too small a size, right before an array", STRUCT_SIZE,
        mesh_behind_a_short_error),
    ROW("more than 2^29 vertices or indices", TOO_LARGE, past_32_bits),
    ROW("a progress callback that stops, at any of its calls", CANCELLED, cancelled),
    ROW("one result looked at by several threads at once", OK, many_threads),
    ROW("an unknown number for `chamfer_status_string`, `chamfer_reason_string`", OK,
        unknown_numbers),
    ROW("`chamfer_result_destroy(NULL)`, any number of times", OK, destroyed_twice),
};

int main(void) {
    size_t i;
    for (i = 0; i < sizeof rows / sizeof *rows; ++i) {
        row_of_now = rows[i].misuse;
        reset();
        rows[i].try_it(rows[i].status);
        printf("%s | `%s`\n", rows[i].misuse, rows[i].name);
    }
    return failures != 0;
}
