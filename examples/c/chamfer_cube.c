/* Chamfers a cube and counts what comes out. */
#include <stdio.h>
#include "chamfer.h"

int main(void) {
    float positions[24][3] = {{0}}, normals[24][3] = {{0}};
    uint32_t indices[36], index_count = 36;
    for (int v = 0; v < 24; ++v) { /* Four vertices a face: hard edges are where they differ. */
        const int axis = v / 8;
        normals[v][axis] = positions[v][axis] = v & 4 ? 1 : -1;
        positions[v][(axis + 1) % 3] = (v & 1 ? 1 : -1) * normals[v][axis];
        positions[v][(axis + 2) % 3] = v & 2 ? 1 : -1;
    }
    for (uint32_t i = 0; i < 36; ++i) indices[i] = i / 6 * 4 + (uint32_t[]){0, 1, 2, 2, 1, 3}[i % 6];

    chamfer_mesh mesh = {.struct_size = sizeof mesh, .vertex_count = 24, .submesh_count = 1};
    mesh.positions = positions[0], mesh.normals = normals[0], mesh.indices = indices;
    mesh.submesh_index_counts = &index_count, mesh.index_count = index_count;

    chamfer_error error = {.struct_size = sizeof error};
    chamfer_result *result;
    if (chamfer_run(&mesh, NULL, NULL, NULL, &result, &error)) return puts(error.message), 1;
    chamfer_result_mesh(result, &mesh); /* What came out, in the struct that went in. */
    printf("%u vertices, %u triangles\n", mesh.vertex_count, mesh.index_count / 3);
    chamfer_result_destroy(result);
}
