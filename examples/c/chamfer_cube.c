/* Chamfers a cube and counts what comes out. */
#include <stdio.h>
#include <string.h>
#include "chamfer.h"

int main(void) {
    static const uint32_t corners[6] = {0, 1, 2, 2, 1, 3};
    float positions[24][3] = {{0}}, normals[24][3] = {{0}};
    uint32_t indices[36], index_count = 36;
    for (int v = 0; v < 24; ++v) { /* Four vertices a face, so its normals are its own. */
        const int axis = v / 8;
        normals[v][axis] = positions[v][axis] = v & 4 ? 1 : -1;
        positions[v][(axis + 1) % 3] = v & 1 ? normals[v][axis] : -normals[v][axis];
        positions[v][(axis + 2) % 3] = v & 2 ? 1 : -1;
    }
    for (uint32_t i = 0; i < 36; ++i) indices[i] = i / 6 * 4 + corners[i % 6];

    chamfer_mesh mesh;
    memset(&mesh, 0, sizeof mesh); /* What is zero is absent. */
    mesh.struct_size = sizeof mesh;
    mesh.vertex_count = 24;
    mesh.positions = positions[0];
    mesh.normals = normals[0];
    mesh.submesh_count = 1;
    mesh.submesh_index_counts = &index_count;
    mesh.index_count = index_count;
    mesh.indices = indices;

    chamfer_error error;
    error.struct_size = sizeof error;
    chamfer_result *result;
    if (chamfer_run(&mesh, NULL, NULL, NULL, &result, &error) != CHAMFER_STATUS_OK) {
        fprintf(stderr, "%s\n", error.message);
        return 1;
    }
    chamfer_result_mesh(result, &mesh); /* What came out, in the struct that went in. */
    printf("%u vertices, %u triangles\n", mesh.vertex_count, mesh.index_count / 3);
    chamfer_result_destroy(result);
}
