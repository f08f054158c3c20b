// clang-format off
/* The C interface of unsnarl: C99 and C++, one shared library, libunsnarl_c.
 *
 *   double positions[3 * 6] = {0, 0, 0,  4, 0, 0,  0, 4, 0,  1, 1, -1,  1, 1, 2,  2, 2, 2};
 *   int32_t corners[3 * 2] = {0, 1, 2,  3, 4, 5};
 *   unsnarl_surface mesh = {
 *     .size = sizeof mesh, .positions = positions, .vertex_count = 6, .corners = corners, .corner_count = 6};
 *   unsnarl_result* result;
 *   if (unsnarl_repair(&mesh, NULL, NULL, &result) != UNSNARL_OK) {
 *     fprintf(stderr, "%s\n", unsnarl_error_message());
 *     return 1;
 *   }
 *   unsnarl_array moved;
 *   unsnarl_result_array(result, "positions", &moved);
 *   printf("%s: vertex 3 is at z = %g now\n", unsnarl_result_status(result), ((const double*)moved.data)[11]);
 *   unsnarl_result_free(result);
 *
 * How all functions behave:
 *
 * - Functions that return int return UNSNARL_OK or another unsnarl_error, and then write nothing through their
 * pointers; unsnarl_error_message() says what was wrong, where, and what to do. A mesh that could not be untangled is
 * no error: unsnarl_result_status() says so.
 * - What is passed in is not changed, and not kept after the call.
 * - Whatever a function hands out (a text, an array) belongs to the handle that it came from and is gone with it.
 *   Handles are freed by the function named after them; NULL may be freed.
 * - Structs begin with their size, which the caller sets (`.size = sizeof mesh`; unsnarl_options_init does it for
 *   options). Later versions add fields at the end, and take what was compiled for this version as it was meant.
 * - Texts are UTF-8, names of choices those of the command line and of Python; where a name is asked for, NULL is the
 *   default.
 * - Any number of threads may call at the same time, with handles of their own. unsnarl_context_cancel alone may be
 *   called with a handle that another thread is using.
 * - An option that a function does not use must be as unsnarl_options_init sets it; those of a repair may be given to
 *   every function that looks at a surface.
 */
// clang-format on
#ifndef UNSNARL_UNSNARL_H
#define UNSNARL_UNSNARL_H

#include <stddef.h>
#include <stdint.h>

#if !defined(UNSNARL_EXPORT) /* the build of a DLL says how it exports */
#if defined(__ELF__) || defined(__MACH__)
#define UNSNARL_EXPORT __attribute__((visibility("default")))
#else
#define UNSNARL_EXPORT
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- errors and versions ------------------------------------------------------------------------------------ */

typedef enum unsnarl_error {
  UNSNARL_OK = 0,
  UNSNARL_INVALID_ARGUMENT = 1, /* an argument is not valid; the message names face, vertex, curve or option */
  UNSNARL_CANNOT_READ = 2,      /* a file is missing or not valid */
  UNSNARL_CANNOT_WRITE = 3,     /* a file cannot be written; what was there before is still there */
  UNSNARL_OUT_OF_MEMORY = 4,
  UNSNARL_SYSTEM_ERROR = 5,   /* the system failed (no descriptors, a read error); the same call may succeed later */
  UNSNARL_LIMIT_REACHED = 6,  /* a limit of time or memory, before there was any result */
  UNSNARL_INTERNAL_ERROR = 70 /* a defect of the library */
} unsnarl_error;

/* What the last call that failed in this thread complained of; "" if none did. Valid until the next one fails. */
UNSNARL_EXPORT const char* unsnarl_error_message(void);

/* The errno (<errno.h>: ENOENT, EACCES, EMFILE, ...) of the call of the system behind that error; 0: there was none. */
UNSNARL_EXPORT int unsnarl_error_number(void);

/* Version of the library, "major.minor.patch", with ".dev" behind it where it is not released yet. */
UNSNARL_EXPORT const char* unsnarl_version(void);

/* ---- surfaces, curves, options ------------------------------------------------------------------------------ */

typedef struct unsnarl_document unsnarl_document; /* a mesh file, see below */

/* A polygon mesh, or several that lie one after another in the same arrays. */
typedef struct unsnarl_surface {
  size_t size;             /* sizeof(unsnarl_surface) */
  const double* positions; /* x y z of each vertex */
  size_t vertex_count;
  const int32_t* corners; /* the vertices of all faces, counted from 0, face after face */
  size_t corner_count;
  const int32_t* offsets;   /* face f has the corners [offsets[f], offsets[f + 1]); NULL: every face is a triangle */
  size_t offset_count;      /* number of faces + 1; 0: every face is a triangle */
  const uint8_t* fixed;     /* one flag a vertex, nonzero: a repair must not move it; NULL: all may move */
  const size_t* mesh_sizes; /* several meshes: vertices and faces of each, two numbers a mesh, which reports then list
                               one by one; NULL: it is one */
  size_t mesh_count;        /* 0: it is one */
  const unsnarl_document* document; /* the file that the arrays are of, set by unsnarl_document_surface: a repair then
                                       holds in the digits that the file will be written with; else NULL */
  const int32_t* rigid;  /* one number a vertex: the rigid part that it belongs to, counted from 0, which a repair turns
                            and shifts as one body; -1: none. NULL: no part is rigid. Not of sequences */
  const int32_t* nested; /* chains of meshes (numbers in mesh_sizes, counted from 0) that are to lie inside each other,
                            from the innermost out, a -1 after each; all but the first of a chain have to be closed.
                            NULL: it does not matter. Not of sequences, nor with rigid, each_component or paper */
  size_t nested_count;   /* of these numbers, -1 included */
  const char* const* rigid_names; /* names of the rigid parts, for reports; NULL: their numbers */
  size_t rigid_name_count;
  const int32_t* nested_surface;   /* one number a vertex: the surface that it belongs to, which `nested` then counts in
                                      place of meshes; -1: none. NULL: `nested` counts meshes */
  const char* const* nested_names; /* names of these surfaces, for messages and reports; NULL: their numbers */
  size_t nested_name_count;
  const int32_t* face_parts; /* one number a face: the part that it belongs to, which `allowed` counts; -1: none. NULL:
                                no pair of faces is allowed to intersect */
  const int32_t* allowed;    /* pairs of these parts, two numbers each: their faces may pass through each other; a part
                                twice: its faces may intersect among themselves. Not with nested or paper */
  size_t allowed_count;      /* of pairs */
} unsnarl_surface;

/* Polylines in the plane, or closed polygons in space (a link). */
typedef struct unsnarl_curves {
  size_t size;            /* sizeof(unsnarl_curves) */
  const double* points;   /* in the plane x y, in space x y z of each point */
  const int32_t* offsets; /* curve c has the points [offsets[c], offsets[c + 1]) */
  size_t curve_count;     /* offsets has one entry more */
  const uint8_t* closed;  /* one flag a curve, nonzero: its last point is joined to its first, which is not repeated;
                             NULL: all are closed. Links always are */
  const uint8_t* fixed;   /* one flag a point, nonzero: must not move; NULL: all may move */
} unsnarl_curves;

/* Options of all functions, by the names that Python gives them; a function leaves alone what does not concern it. NULL
 * in place of options: the defaults. Flags: zero is false. */
typedef struct unsnarl_options {
  size_t size; /* set by unsnarl_options_init, as is everything else */

  /* what counts as an intersection, of surfaces */
  const char* weld; /* which vertices are one: "none"; "seams": ends of open edges at equal positions; "all": any at
                       equal positions. Default "seams" */
  double weld_tolerance;  /* length, >= 0: vertices this close count as equal. Default 0 */
  int32_t both_diagonals; /* faces intersect where they do for any choice of the diagonals of quads. Default 0 */
  int32_t threads;        /* >= 0; 0: as many as the machine has (default). Results do not depend on it */

  /* unsnarl_repair and unsnarl_repair_sequence */
  const char* goal;        /* "all": no intersecting pair (default); "disjoint": none of faces that share no vertex */
  const char* precision;   /* numbers the result must hold in: "float32", "float64", "auto": float32 where the
                              coordinates allow it (default) */
  double min_gap;          /* wanted gap between sheets, a fraction of the diagonal of the bounding box, >= 0 and no
                              more than 8 mean widths of the faces: smaller ones are opened; 0: just enough to be safe
                              where faces intersect (default) */
  double max_displacement; /* how far any vertex may move, a fraction of the diagonal, >= 0; 0: any distance. Default
                              0 */
  int32_t absolute;        /* min_gap and max_displacement are lengths in the units of the positions. Default 0 */
  double min_dihedral;     /* degrees, [0, 90): faces that are folded together closer are opened. Default 0; not of
                              sequences */
  double memory_limit;    /* MB (10^6 bytes) that the process may hold, >= 0; 0: no limit (default); not of sequences */
  int32_t each_component; /* repair every component as if alone. Default 0; not of sequences */
  int32_t paper;          /* the configuration of the paper, for research. Default 0; not of sequences */

  /* all that takes long */
  double time_limit; /* seconds, >= 0, of sequences for each frame; 0: none (default) */
  int32_t recover; /* 0: stop after untangling, without moving back toward the input, for research. Default 1; surfaces
                      and curves, not sequences */

  /* unsnarl_repair_sequence */
  size_t first_frame; /* the frames wanted, the last one excluded: all by default */
  size_t last_frame;  /* SIZE_MAX: to the end */

  /* unsnarl_untangle_curves */
  double gap; /* distance to keep where a crossing was opened, a fraction of the diagonal, (0, 0.1]. Default 4e-3 */
  double junction;  /* an open curve that ends this close to another one ends on it and stays there, a fraction of the
                       diagonal, [0, 0.1]. Default 1e-9 */
  int32_t fix_ends; /* the ends of open curves must not move. Default 0 */

  /* unsnarl_seifert_surface, unsnarl_untangled_seifert_surface; `views` also unsnarl_check_seifert_surface */
  double edge; /* edge length inside the surface, a fraction of the diagonal, [0, 0.5]; 0: that of the link (default) */
  int32_t views; /* from how many sides to look for the simplest diagram, [3, 10000]. Default 60 */
  int32_t fair;  /* 0: the surface as Seifert's algorithm builds it. Default 1 */

  /* unsnarl_planar_isotopy, unsnarl_knot_isotopy */
  int32_t points; /* of every curve on the way, 0 or [16, 100000] (of knots 2000); 0: as many as the longer, 200 at
                     least (default). Curves in the plane have as many in the middle of their way */

  /* unsnarl_repair with `paper`: the settings of unsnarl::PaperOptions (paper.h), which names their sources */
  const char* paper_bandwidth;   /* "global", "independent" or "symmetric" (default) */
  int32_t paper_adaptive;        /* bandwidths follow the surface. Default 1 */
  double paper_bandwidth_scale;  /* times the bandwidths found, > 0. Default 1 */
  double paper_neighbourhood;    /* bandwidths beyond which vertices do not repel each other, > 0. Default 1.5 */
  double paper_gaussian;         /* weight of the Gaussian energy, >= 0. Default 1 */
  double paper_mesh;             /* weight of the mesh energy, in mean edges, >= 0. Default 0.3 */
  const char* paper_mesh_energy; /* "depth" (default) or "length" */
  int32_t paper_whole_polygons;  /* penetration between polygons as they are, not their triangles. Default 1 */
  double paper_arap;             /* weight of the regularisation, >= 0. Default 0.5 */
  int32_t paper_memory;          /* steps that L-BFGS keeps, >= 1. Default 8 */
  int32_t paper_iterations;      /* at most, >= 0. Default 3000 */

  /* unsnarl_plan_routes */
  double spacing; /* distance of the points of a route / its radius, (0, 2]. Default 0.5 */

  /* unsnarl_seifert_surface, unsnarl_check_seifert_surface */
  int32_t handles; /* added to the surface, each of which raises its genus by one, [0, 100]. Default 0 */

  /* unsnarl_document_repair */
  int32_t keep_partial; /* write an unfinished result to its place. Default 0 */
  int32_t no_partial;   /* do not keep an unfinished result beside its place. Default 0 */

  /* unsnarl_repair, unsnarl_repair_sequence, unsnarl_document_repair */
  int32_t gap_near_conflicts; /* open gaps to min_gap only around what intersects, and promise none. Default 0 */

  /* unsnarl_untangle_curves */
  int32_t move_strands; /* every curve keeps its points, in their order, and strands are moved past each other; else
                           curves are joined in another way at crossings, so that the drawing stays. Default 0 */

  /* unsnarl_planar_isotopy */
  const char* pairs; /* which curve of the start becomes which of the end: "0=1,1=0", numbers from 0. The others are
                        paired so that curves lie in each other alike on both sides and are near: with "" all are.
                        Default NULL: curve k becomes curve k */
} unsnarl_options;

/* Sets all options to their defaults. size: sizeof(unsnarl_options). */
UNSNARL_EXPORT int unsnarl_options_init(unsnarl_options* options, size_t size);

/* ---- progress and cancellation ------------------------------------------------------------------------------ */

typedef struct unsnarl_progress {
  size_t size;             /* of this struct in the library that calls */
  double fraction;         /* [0, 1], never decreases */
  const char* phase;       /* "diagnose", "untangle", "recover", "certify", "frames", ... */
  size_t pairs_left;       /* intersecting pairs of faces, or of segments, at this moment */
  double displacement_rel; /* largest displacement at this moment / diagonal of the bounding box */
} unsnarl_progress;

/* Called in the thread that called the function at work, a few times a second at most. Nonzero: cancel. */
typedef int (*unsnarl_progress_function)(const unsnarl_progress* progress, void* data);

typedef struct unsnarl_context unsnarl_context;

/* For one call at a time. on_progress: may be NULL. data: handed to it. NULL: there is not enough memory. */
UNSNARL_EXPORT unsnarl_context* unsnarl_context_new(unsnarl_progress_function on_progress, void* data);
/* Ends the call that works with this context soon, with status "cancelled"; those to come at once. Safe from any thread
 * and from a signal handler. */
UNSNARL_EXPORT void unsnarl_context_cancel(unsnarl_context* context);
UNSNARL_EXPORT void unsnarl_context_free(unsnarl_context* context);

/* ---- results ------------------------------------------------------------------------------------------------ */

typedef struct unsnarl_result unsnarl_result;

typedef enum unsnarl_type { UNSNARL_FLOAT64 = 0, UNSNARL_INT32 = 1, UNSNARL_UINT8 = 2 } unsnarl_type;

/* Row after row, without gaps. */
typedef struct unsnarl_array {
  const void* data;
  size_t rows;
  size_t columns;
  unsnarl_type type;
} unsnarl_array;

/* How the work ended: "embedded", "reduced", "no_progress", "obstructed", "allowed", "not_nested", "time_limit",
 * "memory_limit", "displacement_exceeded", "gap_not_met" or "cancelled"; only "embedded" promises that nothing
 * intersects, gaps are as min_gap asks and meshes lie inside each other as `nested` asks; "allowed" promises that
 * nothing intersects but pairs of `allowed`; of "not_nested" and "gap_not_met" it holds that nothing intersects. ""
 * where nothing was to be moved. */
UNSNARL_EXPORT const char* unsnarl_result_status(const unsnarl_result* result);
/* What was found, as JSON: an object, or for sequences an array of them. */
UNSNARL_EXPORT const char* unsnarl_result_report(const unsnarl_result* result);
/* The array of this name; each function below says which there are. */
UNSNARL_EXPORT int unsnarl_result_array(const unsnarl_result* result, const char* name, unsnarl_array* array);
UNSNARL_EXPORT void unsnarl_result_free(unsnarl_result* result);

/* ---- surfaces ----------------------------------------------------------------------------------------------- */

/* All pairs of faces that meet anywhere but in the hull of the vertices they share, decided exactly. Touching counts;
 * pairs of surface->allowed do not.
 *
 * Arrays: "pairs" (k, 2) int32, faces a < b, or a == b where a polygon meets itself, sorted; "kinds" (k, 1) uint8, how
 * the two are related, see unsnarl_pair_kind. Report: their number by kind. */
UNSNARL_EXPORT int unsnarl_find_intersections(const unsnarl_surface* surface, const unsnarl_options* options,
                                              unsnarl_result** result);

/* Name of a kind of pair: 0 "disjoint" (the faces share no vertex), 1 "one_vertex" (they share one and meet elsewhere
 * too), 2 "folded" (they share an edge and overlap flat), 3 "duplicate" (they have the same three vertices), 4
 * "degenerate" (one of them has no area). NULL for any other number. */
UNSNARL_EXPORT const char* unsnarl_pair_kind(int kind);

/* What `unsnarl check` finds: pairs, where they are, the components, and what the surface's document names.
 *
 * Arrays: "pairs" and "kinds" as of unsnarl_find_intersections. Report: that of `unsnarl check --json`
 * (docs/schemas/check.schema.json). */
UNSNARL_EXPORT int unsnarl_check(const unsnarl_surface* surface, const unsnarl_options* options,
                                 unsnarl_result** result);

/* Decides exactly whether the faces are embedded with their vertices at `moved` (x y z of each, moved_count vertices).
 * Vertices are welded as on the positions of `surface`; polygons are split as there, and as a program splits them that
 * reads `moved`.
 *
 * Report: "embedded", "float32_embedded" (after rounding to float32), "pairs" and "pairs_float32" by kind, "allowed"
 * (the pairs of surface->allowed that intersect, which the others leave out) by kind, "resolved" (embedded but for
 * these), "new_zero_area_faces", "seams_closed". */
UNSNARL_EXPORT int unsnarl_certify(const unsnarl_surface* surface, const double* moved, size_t moved_count,
                                   const unsnarl_options* options, unsnarl_result** result);

/* Moves the vertices as little as possible so that no two faces intersect; connectivity is kept. The same input and
 * options give the same bytes at any number of threads (time limits and cancellation aside).
 *
 * Arrays: "positions" (n, 3) float64; what did not have to move is bit-identical. Report: that of `unsnarl fix
 * --report` (docs/report.md). */
UNSNARL_EXPORT int unsnarl_repair(const unsnarl_surface* surface, const unsnarl_options* options,
                                  unsnarl_context* context, unsnarl_result** result);

/* Repairs the frames of a moving surface so that corrections go on smoothly in time; each frame is certified by itself
 * (docs/sequences.md). surface->positions holds frame_count times vertex_count positions, one frame after another.
 *
 * Arrays: "positions" (frames wanted * n, 3) float64. Report: an array of one object a frame, as the list of the report
 * of `unsnarl fix --sequence` has it. Status: that of the first frame that is none of "embedded", "allowed" and
 * "gap_not_met"; where all are, "allowed" if one is, else "gap_not_met" if one is. */
UNSNARL_EXPORT int unsnarl_repair_sequence(const unsnarl_surface* surface, size_t frame_count,
                                           const unsnarl_options* options, unsnarl_context* context,
                                           unsnarl_result** result);

/* Array "components" (m, 1) int32: the component of each face (faces joined by a vertex that they share, welded),
 * counted from 0 in the order of their first faces; -1 for a face without corners. */
UNSNARL_EXPORT int unsnarl_component_of_faces(const unsnarl_surface* surface, const unsnarl_options* options,
                                              unsnarl_result** result);
/* Array "vertices" (n, 1) uint8, flags: on an edge of one face only, after welding. */
UNSNARL_EXPORT int unsnarl_boundary_vertices(const unsnarl_surface* surface, const unsnarl_options* options,
                                             unsnarl_result** result);
/* Array "vertices" (n, 1) uint8, flags: used by one of the faces that are flagged. faces: face_count flags, one a face.
 */
UNSNARL_EXPORT int unsnarl_vertices_of_faces(const unsnarl_surface* surface, const uint8_t* faces, size_t face_count,
                                             unsnarl_result** result);

/* A picture for looking at: the surface, and beside it the same with its vertices at `moved` (x y z of each,
 * moved_count vertices), if moved is not NULL; intersecting faces in red. width: pixels, [128, 8192].
 *
 * Array: "png" (k, 1) uint8, the bytes of a PNG file. */
UNSNARL_EXPORT int unsnarl_picture(const unsnarl_surface* surface, const double* moved, size_t moved_count,
                                   int32_t width, const unsnarl_options* options, unsnarl_result** result);

/* What unsnarl_page shows besides the surface. */
typedef struct unsnarl_page_content {
  size_t size; /* sizeof(unsnarl_page_content) */
  const double*
      moved;          /* x y z of each vertex after a repair, to be shown beside the surface; NULL: it is shown alone */
  size_t moved_count; /* vertices */
  const char* name;   /* of the surface, for the reader; NULL: that of its file, or "mesh" */
  const char* moved_name; /* likewise of what was moved; NULL: none */
  const char* report;     /* what unsnarl_result_report gave for the repair, to be shown too; NULL: none */
} unsnarl_page_content;

/* The page of `unsnarl view` (docs/viewer.md), to turn and look at in a browser: one HTML file that needs no network.
 * Of a surface of unsnarl_document_surface it has the colours and images of the file too; several meshes have a colour
 * each. content: NULL: the surface alone.
 *
 * Array: "html" (k, 1) uint8, the bytes of the file. Report: "notes" (what could not be shown, sentences). */
UNSNARL_EXPORT int unsnarl_page(const unsnarl_surface* surface, const unsnarl_page_content* content,
                                const unsnarl_options* options, unsnarl_result** result);

/* ---- mesh files --------------------------------------------------------------------------------------------- */

/* Reads a mesh file with all that it holds. format: "obj", "ply", ... (docs/formats.md); NULL: by the extension. */
UNSNARL_EXPORT int unsnarl_document_read(const char* path, const char* format, unsnarl_document** document);
/* Reads several mesh files of one coordinate system as one scene (docs/scenes.md), to be repaired together. All need
 * names of their own. format: of all of them. */
UNSNARL_EXPORT int unsnarl_document_read_scene(const char* const* paths, size_t path_count, const char* format,
                                               unsnarl_document** document);
/* The mesh of the file, for the functions above; of several files all meshes, with mesh_sizes. surface->size is to be
 * set. The arrays are the document's. */
UNSNARL_EXPORT int unsnarl_document_surface(const unsnarl_document* document, unsnarl_surface* surface);
/* JSON: "format", "vertices", "faces", "notes" (sentences worth telling the user). */
UNSNARL_EXPORT const char* unsnarl_document_report(const unsnarl_document* document);
/* The faces of a part that the document names. kind: "object", "group", "material", "component" (name: its number, as
 * unsnarl_check lists them) or, of several files, "file". UNSNARL_INVALID_ARGUMENT where there is no such part; the
 * message lists those that there are.
 *
 * Array "faces" (m, 1) uint8, flags. */
UNSNARL_EXPORT int unsnarl_document_faces(const unsnarl_document* document, const char* kind, const char* name,
                                          const unsnarl_options* options, unsnarl_result** result);
/* What surface->face_parts and surface->allowed are to be so that parts which the document names may pass through each
 * other. rules: "A:B" for two parts, "A" for one and itself, as `unsnarl fix --allow` takes them
 * (docs/command_line.md). UNSNARL_INVALID_ARGUMENT where there is no such part, or a name is of several kinds.
 *
 * Arrays "face_parts" (m, 1) int32 and "allowed" (k, 2) int32. */
UNSNARL_EXPORT int unsnarl_document_allowed(const unsnarl_document* document, const char* const* rules,
                                            size_t rule_count, const unsnarl_options* options, unsnarl_result** result);
/* From now on unsnarl_document_write turns stored vertex normals (OBJ vn, PLY nx ny nz, glTF) with the faces that
 * moved. *is_any: 0: there are none that could be updated. */
UNSNARL_EXPORT int unsnarl_document_recompute_normals(unsnarl_document* document, int32_t* is_any);
/* From file to certified file, as `unsnarl fix` does it: repairs the document's mesh, writes the result to a temporary
 * folder beside path, reads it back, certifies it as it was read back, and puts it in place. The old files or the whole
 * new ones are there at any time, never a part.
 *
 * path: the file, which gets the format of the input; of several files the folder where all go under their names, made
 * where it is missing; NULL: the input is overwritten (not of several files). surface: of unsnarl_document_surface,
 * with what must not move, is rigid, nested or may pass. An embedded result is written (also with "gap_not_met"), an
 * allowed one, and one that is obstructed, where it is not the input; any other goes beside path where it is better
 * than the input, in out.partial.obj for out.obj (unless options->no_partial; with options->keep_partial to path).
 * Places are checked before the work. A file to be overwritten that somebody has changed since it was read is left as
 * it is, the result is kept beside it, and the error says so.
 *
 * Array and report as of unsnarl_repair; the report's "output" tells what was written. See unsnarl_document_partial. */
UNSNARL_EXPORT int unsnarl_document_repair(unsnarl_document* document, const unsnarl_surface* surface, const char* path,
                                           const unsnarl_options* options, unsnarl_context* context,
                                           unsnarl_result** result);

/* The same in two steps, for programs that decide in between: unsnarl_repair of the document's surface, then these. */

/* Whether unsnarl_document_write may write there, to be asked before a repair: the format is that of the file, the
 * folder exists, nothing is write-protected, and nothing else would be overwritten. */
UNSNARL_EXPORT int unsnarl_document_check_output(const unsnarl_document* document, const char* path);
/* Writes the file with the positions of a repair of unsnarl_document_surface, everything else as it was. It is read
 * back and certified to hold what the status says before anything is in place. path may be that of the file that was
 * read; where somebody has changed that since, it is left as it is, the result is written as of
 * unsnarl_document_write_partial, and the error says so. The old files or the whole new ones are there, never a part.
 * Of several files path is the folder where all go under their names. */
UNSNARL_EXPORT int unsnarl_document_write(const unsnarl_document* document, const unsnarl_result* repaired,
                                          const char* path);
/* Keeps what an unfinished repair has reached beside path, which is left as it is: in out.partial.obj for out.obj, with
 * buffers of such names for a glTF. Of several files path is the folder; each is kept under such a name. */
UNSNARL_EXPORT int unsnarl_document_write_partial(unsnarl_document* document, const unsnarl_result* repaired,
                                                  const char* path);
/* The path that unsnarl_document_write_partial or unsnarl_document_repair has kept an unfinished result of file number
 * `file` in (0 where it is one file); NULL: it has not. It is the document's, until the next call. */
UNSNARL_EXPORT const char* unsnarl_document_partial(const unsnarl_document* document, size_t file);
UNSNARL_EXPORT void unsnarl_document_free(unsnarl_document* document);

/* ---- samples ------------------------------------------------------------------------------------------------ */

/* A self-intersecting test surface (`unsnarl sample`). resolution: steps along its longest direction,
 * [8, 2000]; 0: its own. parameters: JSON, an object of numbers by their names; NULL: the defaults.
 *
 * Arrays: "positions" (n, 3) float64, "corners" (c, 1) int32 and "offsets" (m + 1, 1) int32 as in unsnarl_surface
 * (offsets is empty where all faces are triangles). */
UNSNARL_EXPORT int unsnarl_sample(const char* name, int32_t resolution, const char* parameters,
                                  unsnarl_result** result);
/* Report: an array of all samples: "name", "description", "embeddable" (false: no motion of vertices can embed it) and
 * "parameters", each with "name", "value" (the default), "minimum", "maximum", "description". */
UNSNARL_EXPORT int unsnarl_list_samples(unsnarl_result** result);

/* ---- curves in the plane ------------------------------------------------------------------------------------ */

/* All pairs of segments that meet anywhere but in an end that they share along one curve, decided exactly.
 *
 * Array "crossings" (k, 4) int32: curve, segment, curve, segment, sorted; segment k starts at point k. */
UNSNARL_EXPORT int unsnarl_find_crossings(const unsnarl_curves* curves, unsnarl_result** result);

/* Moves the points as little as possible until no two segments cross or touch (docs/curves.md). Where an open curve
 * ends on a segment of another one, that gets a point more.
 *
 * Arrays: "points" (p, 2) float64 and "offsets" (curves + 1, 1) int32 as in unsnarl_curves; "obstructions" and "left",
 * crossings (k, 4) int32 as of unsnarl_find_crossings, in terms of the result: those of segments that must not move,
 * and all. Report: counts, displacement, distance, "joints" (docs/curves.md). */
UNSNARL_EXPORT int unsnarl_untangle_curves(const unsnarl_curves* curves, const unsnarl_options* options,
                                           unsnarl_context* context, unsnarl_result** result);

/* Moves closed curves to others so that at no time one crosses itself or another (docs/isotopy.md). Curve k of the
 * start becomes curve k of the end, or as the option `pairs` says; curves must lie in each other alike on both sides.
 *
 * Report: "method" ("annulus", "untangled annulus", "shortening"), "shortened", "length_kept", "area_kept"
 * (docs/isotopy.md); "becomes", the number of the curve of the end that each of the start becomes. Arrays: "times"
 * (r, 1) float64 from 0 to 1; the curves at these times, those of the first, then those of the second, ..., in the
 * order of the start: "points" (p, 2) float64 and "offsets" (r * curves + 1, 1) int32; the surface that they sweep:
 * "positions" (n, 3) float64, z being time times the diagonal of both sides' bounding box, and "corners" (m, 3) int32.
 */
UNSNARL_EXPORT int unsnarl_planar_isotopy(const unsnarl_curves* start, const unsnarl_curves* end,
                                          const unsnarl_options* options, unsnarl_context* context,
                                          unsnarl_result** result);

/* ---- routes in space ---------------------------------------------------------------------------------------- */

/* Routes for agents with radii, past each other and past obstacles, whose tubes keep clear of each other
 * (docs/routes.md). plan: JSON as of `unsnarl routes`, with obstacles as "vertices" and "faces", or as files relative
 * to the working directory; with "timed": true, agents keep clear of where the others are at the same time.
 *
 * Arrays: "points" (p, 3) float64 and "offsets" (agents + 1, 1) int32. Report: what is certified of them, "messages",
 * "seconds". */
UNSNARL_EXPORT int unsnarl_plan_routes(const char* plan, const unsnarl_options* options, unsnarl_context* context,
                                       unsnarl_result** result);

/* Certifies routes, one an agent, as they are. Report: "hold", "clearance", ... as of unsnarl_plan_routes, and
 * "faults", one line each of what does not hold. */
UNSNARL_EXPORT int unsnarl_check_routes(const char* plan, const unsnarl_curves* routes, unsnarl_result** result);

/* ---- surfaces of links -------------------------------------------------------------------------------------- */

/* An oriented surface without self-intersections whose boundary is the link (docs/seifert.md).
 *
 * Arrays: "positions" (n, 3) float64, the points of the link first, and "corners" (m, 3) int32. Report: what
 * unsnarl_check_seifert_surface finds; "crossings" and "circles" of the diagram, "area", "seconds". Status
 * "no_progress": strands are too close to each other for double precision, the arrays are empty and "message" says why;
 * with another status "message" is there where the surface was left as it was built. */
UNSNARL_EXPORT int unsnarl_seifert_surface(const unsnarl_curves* link, const unsnarl_options* options,
                                           unsnarl_context* context, unsnarl_result** result);

/* The same from a surface of your own, of triangles, oriented, with a boundary, which may run through itself: it is
 * untangled with its boundary held bit for bit, and then smoothed (`fair`). Arrays and report as above; the points of
 * the boundary come first, "expected_euler_characteristic" is that of the start, "crossings" and "circles" are 0.
 * Status "no_progress": pairs of faces are left; the arrays are empty and "message" says how many. `handles` must be
 * 0. */
UNSNARL_EXPORT int unsnarl_untangled_seifert_surface(const unsnarl_surface* start, const unsnarl_options* options,
                                                     unsnarl_context* context, unsnarl_result** result);

/* Checks a Seifert surface, of triangles, from the mesh and the link alone.
 *
 * Report: "intersecting_pairs", "oriented", "spans_link", "components", "genus", "euler_characteristic",
 * "expected_euler_characteristic", "alexander_of_surface" and "alexander_of_link" (coefficients from the constant up,
 * as decimal texts, which may have any number of digits), "hold": all that a Seifert surface promises. */
UNSNARL_EXPORT int unsnarl_check_seifert_surface(const unsnarl_surface* surface, const unsnarl_curves* link,
                                                 const unsnarl_options* options, unsnarl_result** result);

/* Moves a knot to another polygon of the same knot without ever passing through itself (docs/knot_isotopy.md). Start
 * and end have one curve each. Status "no_progress": none was found, which does not prove that there is none.
 *
 * Arrays: "times" (r, 1) float64 from 0 to 1; the knot at these times, "points" (p, 3) float64 and "offsets" (r + 1, 1)
 * int32. Report: what is certified of it, "found", the double points of the cylinders that were not embedded. */
UNSNARL_EXPORT int unsnarl_knot_isotopy(const unsnarl_curves* start, const unsnarl_curves* end,
                                        const unsnarl_options* options, unsnarl_context* context,
                                        unsnarl_result** result);

/* Lets a knot repel itself until it comes to rest; every step is proven to be an isotopy, and its length stays
 * (docs/seifert.md). Of the options it uses `threads` and `time_limit`. Status "time_limit" or "cancelled": stopped; it
 * is the same knot then too.
 *
 * Arrays: "points" (p, 3) float64 and "offsets" (2, 1) int32; p is 200 at least, 2000 at most. Report: "at_rest" (0:
 * stopped, or no further step could be proven), "energy", "seconds". */
UNSNARL_EXPORT int unsnarl_relaxed_wire(const unsnarl_curves* knot, const unsnarl_options* options,
                                        unsnarl_context* context, unsnarl_result** result);

/* A tube around each component of a link, which does not run through itself and meets a surface of triangles that spans
 * the link in one connected set of pairs of faces a component.
 *
 * Arrays: "positions" (n, 3) float64 and "corners" (m, 3) int32. Report: "radius"; 0: no tube of some radii down to 5
 * millionths of the diagonal does, and the arrays are empty. */
UNSNARL_EXPORT int unsnarl_knot_tube(const unsnarl_curves* link, const unsnarl_surface* spanning,
                                     unsnarl_result** result);

/* A knot or link by its name: "3_1" to "10_165" as in Rolfsen's table, "hopf", "borromean", "circle", "goeritz", ...
 * Arrays "points" (p, 3) float64 and "offsets" (curves + 1, 1) int32 as in unsnarl_curves. */
UNSNARL_EXPORT int unsnarl_knot_of_table(const char* name, unsnarl_result** result);

#ifdef __cplusplus
}
#endif

#endif
