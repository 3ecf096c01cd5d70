/** \file
 * The core for programs in C, and for every language that calls C. Link tangent::c, which brings all it needs.
 *
 *   tangent_scene* scene = NULL;
 *   tangent_preset* preset = NULL;
 *   tangent_stepper* stepper = NULL;
 *   if (tangent_load_scene(TANGENT_C_VERSION, "sphere.obj", NULL, &scene) != TANGENT_OK)
 *     puts(tangent_scene_error(scene));
 *   ...
 *   tangent_free_stepper(stepper), tangent_free_preset(preset), tangent_free_scene(scene);
 *
 * Units and frames: SI, right-handed world frame; finger frame +x distal, -z out of the fingerpad.
 *
 * Errors: every call that can fail returns a tangent_status. What happened, where, and what to do about it is told by
 * the handle's error text (tangent_..._error), until the next call with that handle. A call that makes a handle makes
 * it on failure, too, to hold the text; it is freed like any other, once, and not used after that. Only where there is
 * no handle (a null one, no memory) is there no more to be told than tangent_status_text. No call throws, aborts or
 * exits.
 *
 * Structs begin with their size, which the caller sets (TANGENT_..._INIT does): a struct of another version is refused.
 * In an array the first element's size counts for all. Unless said otherwise, pointers may not be null.
 *
 * Threads: calls that take a handle as const may run at once on any number of threads, all others are for one thread at
 * a time. So scenes and presets are shared, and each thread has a stepper of its own: a second thread in the same
 * stepper is told TANGENT_BUSY, and nothing is computed for it.
 *
 * 0.x: the interface may change with the second number of the version, and the SONAME with it.
 */
#ifndef TANGENT_C_H
#define TANGENT_C_H

/* NOLINTBEGIN(readability-identifier-naming, modernize-deprecated-headers): C's */
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** 10000 major + 100 minor + patch. */
#define TANGENT_C_VERSION 100u

typedef enum tangent_status {
  TANGENT_OK = 0,
  TANGENT_FAILED = 1,      /**< a file, a value or an option is wrong: see the handle's error text */
  TANGENT_NULL = 2,        /**< a null handle or pointer */
  TANGENT_BAD_SIZE = 3,    /**< a struct's size is not this library's */
  TANGENT_BAD_VERSION = 4, /**< program and library are of different versions */
  TANGENT_BAD_POSE = 5,    /**< a time, position, orientation or velocity can't be used */
  TANGENT_BUSY = 6,        /**< another thread is using this stepper */
  TANGENT_NO_MEMORY = 7,
  TANGENT_CANCELLED = 8 /**< tangent_cancel was called */
} tangent_status;

/** What a status means and what to do, without knowing more; never null. */
const char* tangent_status_text(tangent_status status);
/** TANGENT_C_VERSION of the library that runs. */
uint32_t tangent_library_version(void);

/* ---- scenes */

typedef struct tangent_scene tangent_scene;

typedef struct tangent_scene_options {
  uint32_t size;
  uint32_t normals;       /**< 0: from the file where every corner has one, else computed; 1: file; 2: computed */
  double metres_per_unit; /**< of the file's coordinates */
  double fit_m;           /**< > 0: bounding-box centre to the origin, longest side to this; 0: as in the file */
  double crease_rad;      /**< edges whose dihedral angle exceeds this are creases (computed normals), 0 to pi */
  uint32_t turn_over;     /**< not 0: closed parts that are inside out are turned over */
  uint32_t reserved;
} tangent_scene_options;
/** Millimetres, size and normals as in the file, creases from 45 degrees. */
#define TANGENT_SCENE_OPTIONS_INIT \
  { sizeof(tangent_scene_options), 0, 1e-3, 0.0, 0.78539816339744831, 0, 0 }

typedef struct tangent_scene_info {
  uint32_t size;
  uint32_t planar; /**< 1: a 2D scene; its mesh is a ribbon along the polygon */
  uint64_t triangles, usable_triangles, vertices;
  uint64_t content_hash; /**< of positions, normals and triangles */
  uint64_t memory_bytes;
  double box_min_m[3], box_max_m[3]; /**< world */
} tangent_scene_info;
#define TANGENT_SCENE_INFO_INIT                              \
  {                                                          \
    sizeof(tangent_scene_info), 0, 0, 0, 0, 0, 0, {0}, { 0 } \
  }

/** Mesh (.obj, .ply, .stl, .off) or polygon (.csv, .obj with a line element). `options` null: as TANGENT_..._INIT. */
tangent_status tangent_load_scene(uint32_t version, const char* path, const tangent_scene_options* options,
                                  tangent_scene** scene);
tangent_status tangent_get_scene_info(const tangent_scene* scene, tangent_scene_info* info);
/** The mesh as OBJ, positions divided by metres_per_unit. Atomic. */
tangent_status tangent_write_mesh(tangent_scene* scene, const char* path, double metres_per_unit);
const char* tangent_scene_error(const tangent_scene* scene);
/** Null is allowed. Steppers of the scene live on. */
void tangent_free_scene(tangent_scene* scene);

/* ---- presets: everything a person tunes; names, units and ranges as in presets/default.toml, SI */

typedef struct tangent_preset tangent_preset;

/** The built-in values. */
tangent_status tangent_make_preset(uint32_t version, tangent_preset** preset);
tangent_status tangent_read_preset(uint32_t version, const char* path, tangent_preset** preset);
/** Every key with unit and range; numbers read back as the same double. Atomic. */
tangent_status tangent_write_preset(tangent_preset* preset, const char* path);
/** "solver.gain_overall", in the file's order; null past the last. */
const char* tangent_preset_key(size_t index);
/** The words that a key chooses from, in the order of its values; null past the last, and for a key that is a number.
 */
const char* tangent_preset_choice(const char* key, size_t index);
/** Of a key that chooses among words the value is the word's index, from 0. */
tangent_status tangent_get_value(tangent_preset* preset, const char* key, double* value);
/** Fails, and changes nothing, on an unknown key or a value out of range; the text names the range. */
tangent_status tangent_set_value(tangent_preset* preset, const char* key, double value);
const char* tangent_preset_error(const tangent_preset* preset);
void tangent_free_preset(tangent_preset* preset);

/* ---- ticks */

/** Follows one finger on one scene: the state that one tick hands to the next, and what it keeps to be fast. */
typedef struct tangent_stepper tangent_stepper;

typedef struct tangent_input {
  uint32_t size;
  uint32_t has_velocity; /**< 0: found from the positions */
  double t_s;
  double position_m[3];       /**< centre of the finger, world */
  double orientation_wxyz[4]; /**< unit quaternion, finger frame to world; all 0: not turned */
  double velocity_m_per_s[3]; /**< of the finger, world */
} tangent_input;
#define TANGENT_INPUT_INIT                                          \
  {                                                                 \
    sizeof(tangent_input), 0, 0.0, {0}, {1.0, 0.0, 0.0, 0.0}, { 0 } \
  }

enum { TANGENT_FREE, TANGENT_FACE, TANGENT_EDGE, TANGENT_VERTEX, TANGENT_UNCONVERGED, TANGENT_FACING };
enum { TANGENT_NO_EVENT, TANGENT_FIRST, TANGENT_RESEED, TANGENT_SWITCH, TANGENT_BRANCH };

/** The columns of ticks.csv (workbench/README.md, Files), without the time it took. */
typedef struct tangent_output {
  uint32_t size;
  int32_t status; /**< TANGENT_FREE ... */
  uint64_t tick;  /**< of this stepper, from 0 */
  double t_s;
  int32_t triangle; /**< -1: nothing is tracked */
  int32_t event;    /**< TANGENT_NO_EVENT ... */
  double u, v;
  double contact_m[3], normal[3]; /**< world */
  double penetration_m;           /**< negative: above the surface */
  double force_n[3];              /**< on the finger, world */
  double cld_m;                   /**< position of the contact location display */
  double error_m;
  int32_t iterations, triangle_changes;
  double decided_force_n[3], decided_cld_m; /**< before the fade */
  int32_t searching; /**< 1: the search for deeper places goes on at the next tick, so there may be one */
  int32_t reserved;  /**< 0 */
} tangent_output;
#define TANGENT_OUTPUT_INIT \
  { sizeof(tangent_output), 0, 0, 0.0, -1, 0, 0.0, 0.0, {0}, {0}, 0.0, {0}, 0.0, 0.0, 0, 0, {0}, 0.0, 0, 0 }

tangent_status tangent_make_stepper(const tangent_scene* scene, tangent_stepper** stepper);
/** One tick. Allocates nothing, nor where a pose can't be used. On an error neither the state nor `output` changes. */
tangent_status tangent_step(tangent_stepper* stepper, const tangent_preset* preset, const tangent_input* input,
                            tangent_output* output);
/** `count` ticks in turn, the same bits as one by one. An unusable pose is an error before the first is computed.
 * outputs[0].size counts for all outputs, and is written to all. */
tangent_status tangent_step_many(tangent_stepper* stepper, const tangent_preset* preset, const tangent_input* inputs,
                                 tangent_output* outputs, size_t count);
/** From any thread, or a signal's handler: what this stepper computes ends after the ticks that are under way, and says
 * TANGENT_CANCELLED; where it computes nothing its next call does. Outputs up to there are whole, others as they were.
 */
void tangent_cancel(tangent_stepper* stepper);
/** Forgets the contact, and counts ticks from 0 again. */
tangent_status tangent_reset(tangent_stepper* stepper);
const char* tangent_stepper_error(const tangent_stepper* stepper);
void tangent_free_stepper(tangent_stepper* stepper);

/** Many fingers at once on the stepper's scene, on `threads` threads (0: one per core): finger f has the poses
 * inputs[f * ticks] and on, each from the start of its own path. The same bits as by a stepper per finger, whatever the
 * number of threads; but with ticks 1, poses that have nothing to do with each other, no tick leaves a part of its
 * search to the next (`searching`). The stepper's own finger stays as it is. */
tangent_status tangent_solve_fingers(tangent_stepper* stepper, const tangent_preset* preset,
                                     const tangent_input* inputs, tangent_output* outputs, size_t fingers, size_t ticks,
                                     uint32_t threads);

/* ---- meshes */

typedef struct tangent_mesh_audit {
  uint32_t size;
  uint32_t reserved;
  uint64_t file_vertices, file_faces, triangles, usable_triangles, vertices, edges, components;
  uint64_t boundary_edges, boundary_loops, non_manifold_edges, non_manifold_vertices, inconsistent_edges;
  uint64_t crease_edges, sliver_triangles, flipped_normals, wild_normals;
  double area_m2, max_normal_to_face_deg;
  double edge_length_m[3], dihedral_deg[3], aspect[3]; /**< least, median, largest */
} tangent_mesh_audit;
#define TANGENT_MESH_AUDIT_INIT                                                                              \
  {                                                                                                          \
    sizeof(tangent_mesh_audit), 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.0, 0.0, {0}, {0}, { 0 } \
  }

/** Properties and defects of a 3D scene's mesh (core/lab/audit/mesh_audit.h). */
tangent_status tangent_audit(tangent_scene* scene, tangent_mesh_audit* audit);

typedef struct tangent_decimate_options {
  uint32_t size;
  uint32_t reserved;
  double angle_deg;   /**< largest angle between facets across a smooth edge that is left */
  double deviation_m; /**< largest distance of the new smooth surface from the old, at samples; 0: 1/1000 of the size */
  double aspect;      /**< of a new triangle: longest side over smallest height */
} tangent_decimate_options;
/** 14.8 degrees is the paper's pilot threshold for smooth force and display (P1). */
#define TANGENT_DECIMATE_OPTIONS_INIT \
  { sizeof(tangent_decimate_options), 0, 14.8, 0.0, 12.0 }

/** A scene with the fewest triangles that a finger can't tell from `scene`'s (core/lab/measure/decimate.h). */
tangent_status tangent_decimate(const tangent_scene* scene, const tangent_decimate_options* options,
                                tangent_scene** coarse);

#ifdef __cplusplus
}
#endif
/* NOLINTEND(readability-identifier-naming, modernize-deprecated-headers) */

#endif
