/* Thousands of calls in one process, failed and cancelled ones among them: memory stays as it was
   after the first few. */

#include "chamfer.h"

#include <stdio.h>
#include <unistd.h>

#define VERTICES 24
#define INDICES 36
#define CALLS 10000
/* By then caches of the allocator have their size. */
#define WARM_UP 500
#define MOST_GROWN_KILOBYTES 512

static float positions[VERTICES][3], normals[VERTICES][3];
static uint32_t indices[INDICES];

static void make_cube(void) {
    static const uint32_t corners[6] = {0, 1, 2, 2, 1, 3};
    int v, i;
    for (v = 0; v < VERTICES; ++v) {
        const int axis = v / 8, corner = v % 4;
        const float side = v / 4 % 2 ? 1.0f : -1.0f;
        positions[v][axis] = normals[v][axis] = side;
        positions[v][(axis + 1) % 3] = corner % 2 ? side : -side;
        positions[v][(axis + 2) % 3] = corner / 2 ? 1.0f : -1.0f;
    }
    for (i = 0; i < INDICES; ++i) {
        indices[i] = (uint32_t)(4 * (i / 6)) + corners[i % 6];
    }
}

static int32_t stop_in_the_middle(void *user, float done) {
    (void)user;
    return done > 0.3f;
}

/* One call that succeeds, one that is stopped, one that is refused; all that is there is read. */
static int call(const chamfer_mesh *mesh) {
    chamfer_mesh view = {.struct_size = sizeof view};
    chamfer_mesh wrong = *mesh;
    chamfer_error error = {.struct_size = sizeof error};
    chamfer_result *result = NULL, *smooth = NULL, *none = NULL;
    int is_right = chamfer_run(mesh, NULL, NULL, NULL, &result, &error) == CHAMFER_STATUS_OK;
    is_right &= chamfer_result_mesh(result, &view) == CHAMFER_STATUS_OK;
    is_right &= chamfer_split_by_angle(&view, 30.0f, &smooth, &error) == CHAMFER_STATUS_OK;
    is_right &= chamfer_run(mesh, NULL, stop_in_the_middle, NULL, &none, &error) ==
                CHAMFER_STATUS_CANCELLED;
    wrong.index_count -= 1;
    is_right &= chamfer_run(&wrong, NULL, NULL, NULL, &none, &error) == CHAMFER_STATUS_INDEX_TOTAL;
    chamfer_result_destroy(smooth);
    chamfer_result_destroy(result);
    return is_right && none == NULL;
}

/* Memory that is in use, in kilobytes. */
static long resident(void) {
    long pages = -1;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file != NULL) {
        if (fscanf(file, "%*d %ld", &pages) != 1) {
            pages = -1;
        }
        fclose(file);
    }
    return pages * (sysconf(_SC_PAGESIZE) / 1024);
}

int main(void) {
    const uint32_t count = INDICES;
    chamfer_mesh mesh = {.struct_size = sizeof mesh};
    long before = 0;
    int calls;
    make_cube();
    chamfer_mesh_init(&mesh);
    mesh.vertex_count = VERTICES;
    mesh.positions = &positions[0][0];
    mesh.normals = &normals[0][0];
    mesh.submesh_count = 1;
    mesh.submesh_index_counts = &count;
    mesh.index_count = INDICES;
    mesh.indices = indices;
    for (calls = 0; calls < CALLS; ++calls) {
        if (!call(&mesh)) {
            fprintf(stderr, "call %d went wrong\n", calls);
            return 1;
        }
        if (calls == WARM_UP) {
            before = resident();
        }
    }
    if (before <= 0 || resident() > before + MOST_GROWN_KILOBYTES) {
        fprintf(stderr, "%ld kB after %d calls, %ld kB at the end\n", before, WARM_UP, resident());
        return 1;
    }
    printf("%d calls\n", calls);
    return 0;
}
