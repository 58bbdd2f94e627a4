/*
 * Chamfer: softens all hard edges of a triangle mesh.
 *
 * - Set struct_size of each struct to its sizeof before handing it over. The bytes past the fields
 *   that the library knows must be zero.
 * - Input is borrowed for the call and never written. Results are freed with
 *   chamfer_result_destroy, and with them the arrays viewed through them.
 * - Functions that return int32_t return a CHAMFER_STATUS_*: 0 ok, 1 cancelled, from 100 the call
 *   is wrong, from 200 the mesh is, from 300 a resource ran out, 900 a fault of the library. After
 *   a failure nothing is written but the error struct, and the result pointer is NULL.
 * - There is no global state: any number of threads may call at once.
 *
 * docs/abi.md tells the rest. Made from src/ffi by cbindgen: do not edit, but update with
 * CHAMFER_UPDATE_HEADER=1 cargo test --test header
 */

#ifndef CHAMFER_H
#define CHAMFER_H

#include <stdint.h>

/*
 * What each function is declared with. On Windows, define CHAMFER_DLL where the library is linked as a
 * DLL, and CHAMFER_EXPORTS where you build a DLL that defines these functions itself, such as a
 * stand-in for tests. Elsewhere the functions are visible, also with -fvisibility=hidden.
 */
#ifndef CHAMFER_API
#if defined(_WIN32) && defined(CHAMFER_EXPORTS)
#define CHAMFER_API __declspec(dllexport)
#elif defined(_WIN32) && defined(CHAMFER_DLL)
#define CHAMFER_API __declspec(dllimport)
#elif !defined(_WIN32) && defined(__GNUC__)
#define CHAMFER_API __attribute__((visibility("default")))
#else
#define CHAMFER_API
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/**
 * The version of this interface that the header describes. A program checks that
 * `chamfer_abi_version` gives the same before it calls anything else.
 */
#define CHAMFER_ABI_VERSION 1

/** The call did what was asked. */
#define CHAMFER_STATUS_OK 0

/** The progress callback asked to stop. */
#define CHAMFER_STATUS_CANCELLED 1

/** A pointer that is needed is NULL. */
#define CHAMFER_STATUS_NULL_POINTER 100

/** A pointer is not aligned for what it points to. */
#define CHAMFER_STATUS_MISALIGNED 101

/** A `struct_size` is no size that this library knows, or fields that it does not know are set. */
#define CHAMFER_STATUS_STRUCT_SIZE 102

/** A count asks for an array that does not fit the address space. */
#define CHAMFER_STATUS_COUNT_OVERFLOW 103

/** The width is negative, infinite or not a number. */
#define CHAMFER_STATUS_BAD_WIDTH 104

/** An option holds none of its constants, or is out of its range. */
#define CHAMFER_STATUS_BAD_OPTION 105

/** The submesh that chamfers are to go to does not exist. Element: that submesh. */
#define CHAMFER_STATUS_SUBMESH_RANGE 106

/** The angle is not between 0 and 180 degrees. */
#define CHAMFER_STATUS_BAD_ANGLE 107

/** The place for the result or for the error lies in the mesh. Neither is written. */
#define CHAMFER_STATUS_OVERLAP 108

/** An object of a scene is of a mesh that does not exist. Element: the object. */
#define CHAMFER_STATUS_OBJECT_MESH 109

/** The transform of an object is infinite or not a number. Element: the object. */
#define CHAMFER_STATUS_BAD_TRANSFORM 110

/** The mesh has no normals. */
#define CHAMFER_STATUS_MISSING_NORMALS 200

/** A stream has another length than the positions. */
#define CHAMFER_STATUS_STREAM_LENGTH 201

/** A UV channel is neither absent nor 2 to 4 wide. Element: the channel. */
#define CHAMFER_STATUS_UV_COMPONENTS 202

/** A value is infinite or not a number. Element: the vertex. */
#define CHAMFER_STATUS_NOT_FINITE 203

/** The submesh index counts do not add up to the index count. */
#define CHAMFER_STATUS_INDEX_TOTAL 204

/** A submesh's index count is not a multiple of three. Element: the submesh. */
#define CHAMFER_STATUS_INDEX_COUNT 205

/** An index points past the last vertex. Element: its place among the indices. */
#define CHAMFER_STATUS_INDEX_RANGE 206

/** A factor is negative, infinite or not a number. Element: its place. */
#define CHAMFER_STATUS_BAD_FACTOR 207

/** A listed edge is of a vertex that does not exist. Element: its place in the list. */
#define CHAMFER_STATUS_EDGE_RANGE 208

/** The result would not fit 32-bit indices. */
#define CHAMFER_STATUS_TOO_LARGE 300

/** Memory for the result could not be had. */
#define CHAMFER_STATUS_OUT_OF_MEMORY 301

/** A fault of this library, caught at its border: please report it. */
#define CHAMFER_STATUS_INTERNAL 900

/** The `element` of an error that concerns no single element. */
#define CHAMFER_NO_ELEMENT UINT32_MAX

/** How many bytes an error message has room for, the final NUL included. */
#define CHAMFER_MESSAGE_SIZE 256

/** How many UV channels a mesh has room for. */
#define CHAMFER_UV_CHANNELS 8

/** `width_unit`: the width is in mesh units. */
#define CHAMFER_WIDTH_MESH_UNITS 0

/** `width_unit`: the width is in percent of the largest side of the mesh's box. */
#define CHAMFER_WIDTH_PERCENT 1

/** `width_mode`: from the old edge to the pulled one, within the face. */
#define CHAMFER_WIDTH_OFFSET 0

/** `width_mode`: across the chamfer, from one pulled edge to the other. */
#define CHAMFER_WIDTH_CHORD 1

/** `width_mode`: from the old edge straight down to the chamfer. */
#define CHAMFER_WIDTH_DEPTH 2

/** `width_mode`: of the circle that touches both faces at the pulled edges. */
#define CHAMFER_WIDTH_RADIUS 3

/** `convexity`: edges of both kinds are chamfered. */
#define CHAMFER_CONVEXITY_BOTH 0

/** `convexity`: only those whose faces meet as those of a cube. */
#define CHAMFER_CONVEXITY_CONVEX 1

/** `convexity`: only those whose faces meet as a wall and the floor of a room. */
#define CHAMFER_CONVEXITY_CONCAVE 2

/** `verify`: nothing opens, flips or degenerates. */
#define CHAMFER_VERIFY_FAST 0

/** `verify`: also, no part of the mesh cuts through itself where it did not before. */
#define CHAMFER_VERIFY_FULL 1

/** `verify`: also, no light shows through the mesh where none did before, seen from many sides. */
#define CHAMFER_VERIFY_SEEN 2

/** `submesh_mode`: new triangles go to the submesh of the face whose texture chart they continue. */
#define CHAMFER_SUBMESH_OWNER 0

/** `submesh_mode`: new triangles go to a new submesh behind all others. */
#define CHAMFER_SUBMESH_OWN 1

/** `submesh_mode`: new triangles go to the submesh that the field `submesh` names. */
#define CHAMFER_SUBMESH_GIVEN 2

/** `outcome`: chamfered at the width asked for. */
#define CHAMFER_OUTCOME_FULL 0

/** `outcome`: chamfered, but narrower somewhere. */
#define CHAMFER_OUTCOME_NARROWED 1

/** `outcome`: left as it was. */
#define CHAMFER_OUTCOME_SKIPPED 2

/** `reason`: the edge has full width. */
#define CHAMFER_REASON_NONE 0

/** `reason`: a face beside the edge has no room, it would fold or lose its area. */
#define CHAMFER_REASON_NO_ROOM 1

/** `reason`: the strip, or the fill at an end, would fold. */
#define CHAMFER_REASON_FOLDS 2

/** `reason`: an end lies in a corner so sharp that the full distance would shoot out as a spike. */
#define CHAMFER_REASON_MITER 3

/** `reason`: the chamfer would cut through the mesh. */
#define CHAMFER_REASON_INTERSECTS 4

/** `reason`: nothing can be pulled at either end, both lie inside smooth areas or on borders. */
#define CHAMFER_REASON_NO_END 5

/** `reason`: the faces beside the edge lie back to back. */
#define CHAMFER_REASON_ZERO_THICKNESS 6

/** `reason`: a triangle beside the edge has no area. */
#define CHAMFER_REASON_NO_AREA 7

/** `reason`: the width, or a face beside it, is too small for the precision of the positions here. */
#define CHAMFER_REASON_TOO_FINE 8

/** `reason`: something rests on the edge, or right beside it; light would show behind a chamfer. */
#define CHAMFER_REASON_CONTACT 9

/** `reason`: the edge is not among those that were asked for, by angle, convexity, factor or list. */
#define CHAMFER_REASON_NOT_SELECTED 10

/**
 * `reason`: a vertex of one side lies in the middle of the other; the surface is open along it,
 * or closed by triangles without area.
 */
#define CHAMFER_REASON_T_JUNCTION 11

/** `reason`: a face beside the edge is wound against the other one, or against its own normals. */
#define CHAMFER_REASON_WINDING 12

/**
 * How many reasons `skipped_by_reason` has room for: more than there are, so that reasons can be
 * added.
 */
#define CHAMFER_REASON_SLOTS 16

/** `kind`: the triangle is the source triangle of that index. */
#define CHAMFER_TRIANGLE_SOURCE 0

/** `kind`: the triangle chamfers the hard edge whose verdict has that index. */
#define CHAMFER_TRIANGLE_EDGE 1

/** `kind`: the triangle fills the corner at the source vertex of that index. */
#define CHAMFER_TRIANGLE_CORNER 2

/** `owner_channels`: the bit of a vertex on a rounded chamfer that lies on no face of the source. */
#define CHAMFER_VERTEX_BETWEEN 2147483648

/**
 * What a call made: a mesh, where each of its elements came from, and a verdict for each hard
 * edge. It never changes, so any number of threads may read it at once.
 */
typedef struct chamfer_result chamfer_result;

/**
 * How to chamfer a mesh. `chamfer_options_init` fills in the defaults. One in which all but the size is
 * zero stands for them too; where anything else is set, all fields count as they are.
 */
typedef struct chamfer_options {
    /** `sizeof(chamfer_options)`. */
    uint32_t struct_size;
    /** The distance between an old edge and the pulled one, in `width_unit`. Default: half a percent. */
    float width;
    /** One of `CHAMFER_WIDTH_MESH_UNITS`, `CHAMFER_WIDTH_PERCENT` (default). */
    uint32_t width_unit;
    /** One of `CHAMFER_VERIFY_FAST`, `CHAMFER_VERIFY_FULL` (default), `CHAMFER_VERIFY_SEEN`. */
    uint32_t verify;
    /** One of `CHAMFER_SUBMESH_OWNER` (default), `CHAMFER_SUBMESH_OWN`, `CHAMFER_SUBMESH_GIVEN`. */
    uint32_t submesh_mode;
    /** With `CHAMFER_SUBMESH_GIVEN`, the submesh that new triangles go to; else ignored. */
    uint32_t submesh;
    /**
     * How many threads may work; 0 for as many as there are cores. Default: 1. The result is the
     * same.
     */
    uint32_t threads;
    /**
     * How much of the breadth of each face has to stay between its chamfers, as a share up to 1.
     * 0 for the default, a fifth; a tiny share for nothing.
     */
    float least_breadth;
    /** One of `CHAMFER_WIDTH_OFFSET` (default), `_CHORD`, `_DEPTH`, `_RADIUS`. */
    uint32_t width_mode;
    /**
     * Edges are chamfered whose faces meet at this angle at least, in degrees: 0 (default) for a
     * flat surface, 180 for one folded back on itself.
     */
    float min_angle;
    /** The same at most. 0 for the default, 180. */
    float max_angle;
    /** One of `CHAMFER_CONVEXITY_BOTH` (default), `_CONVEX`, `_CONCAVE`. */
    uint32_t convexity;
    /** Normals are one that differ by less than this, in degrees up to 90. 0 for the default, 1. */
    float hard_angle;
    /**
     * Where the three axes of the mesh go in the space in which widths, angles and planes are
     * measured, such as that of the scene. It may mirror and shear, but not flatten. All 0 for the
     * default, the mesh as it is.
     */
    float scale[9];
    /**
     * How far the widths of a chamfer are held to each other: up to 1, one width for each edge. 0
     * for the default, a half; a tiny share for not at all.
     */
    float evenness;
    /** How many segments a chamfer has across: 1 (flat) to 32. 0 for the default, 1. */
    uint32_t segments;
    /**
     * How a chamfer of several segments is bent: towards 0 flat, 0.5 a circle, 1 the old edge. 0 for
     * the default, 0.5; a tiny share for a flat one.
     */
    float profile;
} chamfer_options;

/** One UV channel of a mesh. */
typedef struct chamfer_uv {
    /** Floats per vertex: 2 to 4, or 0 where the channel is absent. */
    uint32_t components;
    /** `#vertices by components`; ignored where the channel is absent. */
    const float *values;
} chamfer_uv;

/**
 * A place where the surface of a mesh is not to be cut away: all within a radius of a segment.
 *
 * With radius 0 it is a line that rests on the surface, such as the open rim of another object of
 * the scene: chamfers are narrowed to leave what it lies on. With a larger one, hard edges stay
 * as they are where they come nearer.
 */
typedef struct chamfer_held {
    /** Where the segment begins, in mesh units. */
    float from[3];
    /** Where it ends; the same for a point. */
    float to[3];
    /** In mesh units. */
    float radius;
} chamfer_held;

/** How wide the chamfer of one edge is. */
typedef struct chamfer_edge_factor {
    /** Vertices at its ends, on either side of the edge and in either order. */
    uint32_t vertices[2];
    /** How many times the width asked for; 0 leaves the edge as it is. */
    float factor;
} chamfer_edge_factor;

/**
 * A triangle mesh, vertex streams first, as the engines hold it. An absent stream is NULL. The
 * library reads the arrays during the call only, and never writes them.
 */
typedef struct chamfer_mesh {
    /** `sizeof(chamfer_mesh)`. */
    uint32_t struct_size;
    /** How many vertices each stream has. */
    uint32_t vertex_count;
    /** `#vertices by 3`, in mesh units. */
    const float *positions;
    /** `#vertices by 3`, unit length. Hard edges are found by them. */
    const float *normals;
    /** `#vertices by 4` or NULL: a unit vector and the handedness, +1 or -1. */
    const float *tangents;
    /** `#vertices by 4` or NULL: red, green, blue, alpha. */
    const float *colors;
    /** The UV channels. */
    struct chamfer_uv uvs[CHAMFER_UV_CHANNELS];
    /** How many submeshes the triangles are divided into. */
    uint32_t submesh_count;
    /** How many indices there are in all submeshes together. */
    uint32_t index_count;
    /** `#submeshes`: how many of the indices belong to each, a multiple of three. */
    const uint32_t *submesh_index_counts;
    /** `#triangles by 3`: the triangles of all submeshes, one submesh after the other. */
    const uint32_t *indices;
    /** How many places are held. */
    uint32_t held_count;
    /** `#held`, or NULL: where something outside of the mesh rests on it. Results hold none. */
    const struct chamfer_held *held;
    /**
     * `#submeshes` or NULL: how many times the width the chamfers of each get; 0 leaves its edges
     * as they are. An edge between two submeshes has the smaller of their factors. Results have no
     * factors.
     */
    const float *submesh_factors;
    /**
     * `#vertices` or NULL: a mask. An end of an edge has the mean over its two sides, and at least a
     * sixteenth of the other end.
     */
    const float *vertex_factors;
    /** How many edges are listed. */
    uint32_t edge_factor_count;
    /**
     * `#listed`, or NULL. Where some are, only these are chamfered. All factors that concern one
     * end of an edge multiply.
     */
    const struct chamfer_edge_factor *edge_factors;
} chamfer_mesh;

/**
 * Called on the calling thread with the share done (0 to 1). A result other than 0 cancels. It
 * must return to its caller: no exception, no `longjmp`.
 */
typedef int32_t (*chamfer_progress)(void *user, float done);

/**
 * What went wrong, in detail. Callers set `struct_size`; a call fills in the rest, also when it
 * succeeds.
 */
typedef struct chamfer_error {
    /** `sizeof(chamfer_error)`. */
    uint32_t struct_size;
    /** The status that the call returned. */
    int32_t status;
    /** The element at fault; the status says what it counts. `CHAMFER_NO_ELEMENT` if none. */
    uint32_t element;
    /**
     * One English sentence in UTF-8, ended by NUL: the element, the rule, what to do. Empty on
     * success.
     */
    char message[CHAMFER_MESSAGE_SIZE];
    /** The mesh at fault, where there are several. `CHAMFER_NO_ELEMENT` if none. */
    uint32_t mesh;
} chamfer_error;

/** Sums over the verdicts of a result. */
typedef struct chamfer_totals {
    /** `sizeof(chamfer_totals)`. */
    uint32_t struct_size;
    /** Hard edges, with those whose two sides share no edge. */
    uint32_t hard_edges;
    /** Those at full width. */
    uint32_t chamfered;
    /** Those chamfered, but narrower somewhere. */
    uint32_t narrowed;
    /** Those left as they were. */
    uint32_t skipped;
    /** The width asked for, in mesh units. */
    float width;
    /**
     * Mean width of the hard edges, as a share (0 to 1) of the width asked for, weighted by edge
     * length; 0 without hard edges. Skipped edges have none; ends at which both sides stay put
     * at any width do not count: where the edge runs out in a smooth area, at a T-junction, or
     * where several creases hold the vertex.
     */
    float mean_width;
    /** The skipped edges by reason; places past the last reason are 0. */
    uint32_t skipped_by_reason[CHAMFER_REASON_SLOTS];
} chamfer_totals;

/** What became of one hard edge. */
typedef struct chamfer_edge_verdict {
    /** The source vertices at its ends, on the side of the first triangle that uses it. */
    uint32_t vertices[2];
    /** One of `CHAMFER_OUTCOME_*`. */
    uint32_t outcome;
    /** Why it is not at full width: one of `CHAMFER_REASON_*`. */
    uint32_t reason;
    /**
     * At each end, the mean of the distances from the old edge to its two pulled sides, in mesh
     * units.
     */
    float widths[2];
    /** How many segments it has across, at the end that has fewer; 0 where it is skipped. */
    uint32_t segments;
} chamfer_edge_verdict;

/** A weighted mean of up to three source vertices. */
typedef struct chamfer_blend {
    /** Source vertex indices. */
    uint32_t vertices[3];
    /** Their weights, of sum 1; 0 in unused places, negative where a vertex moved past a triangle. */
    float weights[3];
} chamfer_blend;

/** What an output vertex was re-sampled from. With it, callers carry streams of their own. */
typedef struct chamfer_vertex_source {
    /** For what belongs to the surface: position, normal, skin weights, morph targets. */
    struct chamfer_blend surface;
    /**
     * For what belongs to the vertex's own texture chart: colour, and the UV channels and tangent
     * that `owner_channels` does not name.
     */
    struct chamfer_blend chart;
    /**
     * A place in the chart that the chamfer continues over a seam; the same as `chart` where
     * `owner_channels` is 0.
     */
    struct chamfer_blend owner;
    /**
     * The UV channels that follow `owner`: channel `k` where bit `k` is set. The tangent goes with
     * channel 0. With `CHAMFER_VERTEX_BETWEEN` the vertex is on a rounded chamfer and on no face:
     * its blends do not rebuild its position and normal.
     */
    uint32_t owner_channels;
} chamfer_vertex_source;

/** What an output triangle came from. */
typedef struct chamfer_triangle_source {
    /** What `index` counts: one of `CHAMFER_TRIANGLE_*`. */
    uint32_t kind;
    /** A source triangle, a verdict, or a source vertex. */
    uint32_t index;
} chamfer_triangle_source;

/** A mesh that stands somewhere in a scene. One mesh may stand there several times. */
typedef struct chamfer_object {
    /** Its number among the meshes of the scene. */
    uint32_t mesh;
    /**
     * From mesh to scene, column by column; the last row is taken for 0, 0, 0, 1. It may mirror.
     * An object that it flattens is not there for the others.
     */
    float transform[16];
} chamfer_object;

/**
 * The version of this interface that the library was built with: `CHAMFER_ABI_VERSION` of its
 * header.
 */
CHAMFER_API uint32_t chamfer_abi_version(void);

/** The version of the library, such as "1.2.3". It lives as long as the library. */
CHAMFER_API const char *chamfer_version_string(void);

/** What a status means, in a few English words. It lives as long as the library; never NULL. */
CHAMFER_API const char *chamfer_status_string(int32_t status);

/**
 * The short name of a `CHAMFER_REASON_*`, in lower case with underscores. It lives as long as the
 * library; never NULL.
 */
CHAMFER_API const char *chamfer_reason_string(uint32_t reason);

/** Fills in the default options. Set `struct_size` first. */
CHAMFER_API int32_t chamfer_options_init(struct chamfer_options *options);

/** Makes the mesh empty, with every stream absent. Set `struct_size` first. */
CHAMFER_API int32_t chamfer_mesh_init(struct chamfer_mesh *mesh);

/**
 * Chamfers all hard edges of a mesh.
 *
 * `mesh` is borrowed for the call. `options` may be NULL for the defaults, `progress` for none
 * (`user` is handed to it unchanged), `error` for no details. On success `*out` is a new result,
 * to be freed with `chamfer_result_destroy`; on failure it is NULL.
 */
CHAMFER_API
int32_t chamfer_run(const struct chamfer_mesh *mesh,
                    const struct chamfer_options *options,
                    chamfer_progress progress,
                    void *user,
                    struct chamfer_result **out,
                    struct chamfer_error *error);

/**
 * Gives a mesh normals by smoothing angle: faces joined by edges of at most `angle_degrees` (0 to
 * 180) shade as one surface, and vertices are split where normals differ.
 *
 * The mesh's own normals are ignored and may be NULL; all other streams are copied along. The
 * result has no verdicts; `mesh`, `out` and `error` are as for `chamfer_run`.
 */
CHAMFER_API
int32_t chamfer_split_by_angle(const struct chamfer_mesh *mesh,
                               float angle_degrees,
                               struct chamfer_result **out,
                               struct chamfer_error *error);

/**
 * Views the result's mesh. Set `struct_size` of `mesh` first.
 *
 * Its arrays belong to the result and live until that is destroyed. The view can be given to
 * `chamfer_run` as it is.
 */
CHAMFER_API
int32_t chamfer_result_mesh(const struct chamfer_result *result,
                            struct chamfer_mesh *mesh);

/** Copies the sums over the result's verdicts. Set `struct_size` of `totals` first. */
CHAMFER_API
int32_t chamfer_result_totals(const struct chamfer_result *result,
                              struct chamfer_totals *totals);

/**
 * Views the verdicts: `#hard edges`, those whose sides share no edge last. The array lives as long as the result; NULL
 * if there are none.
 */
CHAMFER_API
int32_t chamfer_result_verdicts(const struct chamfer_result *result,
                                const struct chamfer_edge_verdict **verdicts,
                                uint32_t *count);

/**
 * Views what each vertex of the result's mesh came from: `#vertices`. The array is made by the
 * first call, if there is memory for it, and lives as long as the result; NULL if there are none.
 */
CHAMFER_API
int32_t chamfer_result_vertex_sources(const struct chamfer_result *result,
                                      const struct chamfer_vertex_source **sources,
                                      uint32_t *count);

/**
 * Views what each triangle of the result's mesh came from: `#triangles`. The array lives as long
 * as the result; NULL if there are none.
 */
CHAMFER_API
int32_t chamfer_result_triangle_sources(const struct chamfer_result *result,
                                        const struct chamfer_triangle_source **sources,
                                        uint32_t *count);

/** Frees a result and every array viewed through it. NULL is allowed. */
CHAMFER_API void chamfer_result_destroy(struct chamfer_result *result);

/**
 * Chamfers meshes that stand together: of each, the edges are held that the open border of
 * another object rests on. With `CHAMFER_VERIFY_SEEN` the scene is looked at as a whole, and what
 * lets light through is held too.
 *
 * `meshes` holds `mesh_count` pointers, and `objects` says where the meshes stand. A mesh that no
 * object names is chamfered as `chamfer_run` would. On success each of the `mesh_count` places of
 * `results` is a new result, to be freed with `chamfer_result_destroy`; on failure all are NULL,
 * and `mesh` of the error is the number of the mesh at fault. All else is as for `chamfer_run`.
 */
CHAMFER_API
int32_t chamfer_scene_run(const struct chamfer_mesh *const *meshes,
                          uint32_t mesh_count,
                          const struct chamfer_object *objects,
                          uint32_t object_count,
                          const struct chamfer_options *options,
                          chamfer_progress progress,
                          void *user,
                          struct chamfer_result **results,
                          struct chamfer_error *error);

#ifdef __cplusplus
}
#endif

#endif /* CHAMFER_H */
