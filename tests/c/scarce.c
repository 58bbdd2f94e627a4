/* A process that may have only so much memory, less of it each time: a call ends with a result or
   with an error, and never ends the process. */

#define _DEFAULT_SOURCE
#include "chamfer.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#define CELLS 40
#define VERTICES (CELLS * CELLS * 6)

#define STEP ((rlim_t)1 << 20)
/* Far more than the mesh asks for: by then there must have been a result. */
#define STEPS 400

static float positions[VERTICES][3], normals[VERTICES][3];
static uint32_t indices[VERTICES];

/* Every cell of a rough ground is two triangles of their own, so that all edges are hard. */
static void make_ground(void) {
    static const int corners[6][2] = {{0, 0}, {0, 1}, {1, 1}, {0, 0}, {1, 1}, {1, 0}};
    uint32_t v;
    for (v = 0; v < VERTICES; ++v) {
        const int cell = (int)(v / 6), corner = (int)(v % 6);
        const int x = cell % CELLS + corners[corner][0], z = cell / CELLS + corners[corner][1];
        positions[v][0] = (float)x;
        positions[v][1] = (float)((x * 7 + z * 13) % 5) / 3.0f;
        positions[v][2] = (float)z;
        /* Not of their faces, but different: that is all that makes an edge hard. */
        normals[v][0] = v / 3 % 2 ? 0.6f : -0.6f;
        normals[v][1] = 0.8f;
        indices[v] = v;
    }
}

static int32_t chamfer(void) {
    const uint32_t count = VERTICES;
    chamfer_mesh mesh = {.struct_size = sizeof mesh};
    chamfer_error error = {.struct_size = sizeof error};
    chamfer_result *result = NULL;
    int32_t status;
    chamfer_mesh_init(&mesh);
    mesh.vertex_count = mesh.index_count = VERTICES;
    mesh.positions = &positions[0][0];
    mesh.normals = &normals[0][0];
    mesh.indices = indices;
    mesh.submesh_count = 1;
    mesh.submesh_index_counts = &count;
    status = chamfer_run(&mesh, NULL, NULL, NULL, &result, &error);
    if (error.status != status || (result == NULL) != (status != CHAMFER_STATUS_OK)) {
        return -1;
    }
    chamfer_result_destroy(result);
    return status;
}

/* How much address space this process has. */
static rlim_t used(void) {
    unsigned long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (file == NULL || fscanf(file, "%lu", &pages) != 1) {
        exit(2);
    }
    fclose(file);
    return (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE);
}

/* What the call says in a process of its own with so much more memory. */
static int32_t chamfer_within(rlim_t spare) {
    int how = 0;
    const pid_t child = fork();
    if (child == 0) {
        const struct rlimit limit = {used() + spare, RLIM_INFINITY};
        int32_t status;
        setrlimit(RLIMIT_AS, &limit);
        status = chamfer();
        _exit(status == CHAMFER_STATUS_OK ? 0 : status == CHAMFER_STATUS_OUT_OF_MEMORY ? 1 : 2);
    }
    if (child < 0 || waitpid(child, &how, 0) != child || !WIFEXITED(how) || WEXITSTATUS(how) == 2) {
        fprintf(stderr, "with %lu more bytes the process did not live\n", (unsigned long)spare);
        exit(1);
    }
    return WEXITSTATUS(how) ? CHAMFER_STATUS_OUT_OF_MEMORY : CHAMFER_STATUS_OK;
}

int main(void) {
    int step, refused = 0, made = 0;
    make_ground();
    /* From nothing to spare on; once there are results, a few more steps are enough. */
    for (step = 0; step < STEPS && made < 20; ++step) {
        const int is_made = chamfer_within((rlim_t)step * STEP) == CHAMFER_STATUS_OK;
        refused += !is_made;
        made += is_made;
    }
    if (refused == 0 || made < 20) {
        fprintf(stderr, "%d times refused, %d times made\n", refused, made);
        return 1;
    }
    printf("less memory than the mesh asks for | `OUT_OF_MEMORY`\n");
    return 0;
}
