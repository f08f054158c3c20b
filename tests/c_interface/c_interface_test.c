/* The C interface as C99 sees it. c_interface_test FOLDER */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "unsnarl/unsnarl.h"

static int failures = 0;

#define CHECK(condition)                                              \
  do {                                                                \
    if (!(condition)) {                                               \
      printf("%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);  \
      printf("  the last error says: %s\n", unsnarl_error_message()); \
      ++failures;                                                     \
    }                                                                 \
  } while (0)

/* Two triangles, one of them through the other. */
static const double crossing_positions[] = {0, 0, 0, 4, 0, 0, 0, 4, 0, 1, 1, -1, 1, 1, 2, 2, 1, 2};
static const int32_t crossing_corners[] = {0, 1, 2, 3, 4, 5};

static unsnarl_surface crossing(void) {
  unsnarl_surface surface = {.size = sizeof surface,
                             .positions = crossing_positions,
                             .vertex_count = 6,
                             .corners = crossing_corners,
                             .corner_count = 6};
  return surface;
}

static unsnarl_options defaults(void) {
  unsnarl_options options;
  CHECK(unsnarl_options_init(&options, sizeof options) == UNSNARL_OK);
  return options;
}

static unsnarl_array array(const unsnarl_result* result, const char* name) {
  unsnarl_array found = {NULL, 0, 0, UNSNARL_UINT8};
  CHECK(unsnarl_result_array(result, name, &found) == UNSNARL_OK);
  return found;
}

static size_t pairs_of(const unsnarl_surface* surface) {
  unsnarl_result* result = NULL;
  size_t pairs;
  CHECK(unsnarl_find_intersections(surface, NULL, &result) == UNSNARL_OK);
  pairs = array(result, "pairs").rows;
  unsnarl_result_free(result);
  return pairs;
}

static int says(const char* text, const char* part) {
  return strstr(text, part) != NULL;
}

/* Is `part` among the bytes of an array? */
static int holds(unsnarl_array bytes, const char* part) {
  const size_t size = strlen(part);
  for (size_t i = 0; i + size <= bytes.rows; ++i)
    if (memcmp((const char*)bytes.data + i, part, size) == 0) return 1;
  return 0;
}

static void makes_pages(void) {
  static char deep[300000];
  const unsnarl_surface surface = crossing();
  unsnarl_page_content content = {.size = sizeof content, .name = "<a>", .moved_name = "b"};
  unsnarl_result* repaired = NULL;
  unsnarl_result* page = NULL;
  unsnarl_array html;
  CHECK(unsnarl_page(&surface, NULL, NULL, &page) == UNSNARL_OK);
  html = array(page, "html");
  CHECK(html.type == UNSNARL_UINT8 && html.columns == 1 && holds(html, "<!doctype html>"));
  CHECK(holds(html, "\"input\":\"mesh\"") && !holds(html, "id=\"positions_after\""));
  CHECK(says(unsnarl_result_report(page), "\"notes\":[]"));
  unsnarl_result_free(page);

  CHECK(unsnarl_repair(&surface, NULL, NULL, &repaired) == UNSNARL_OK);
  content.moved = array(repaired, "positions").data;
  content.moved_count = 6;
  content.report = unsnarl_result_report(repaired);
  CHECK(unsnarl_page(&surface, &content, NULL, &page) == UNSNARL_OK);
  html = array(page, "html");
  CHECK(holds(html, "\"input\":\"\\u003ca>\"") && holds(html, "\"output\":\"b\""));
  CHECK(holds(html, "id=\"positions_after\"") && holds(html, "\"status\":\"embedded\""));
  unsnarl_result_free(page);

  content.moved_count = 5;
  CHECK(unsnarl_page(&surface, &content, NULL, &page) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "moved has 5 vertices, the surface 6"));
  content.moved_count = 6;
  content.report = "no JSON";
  CHECK(unsnarl_page(&surface, &content, NULL, &page) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "JSON"));
  memset(deep, '[', sizeof deep - 1);
  content.report = deep;
  CHECK(unsnarl_page(&surface, &content, NULL, &page) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "nested too deeply"));
  content.size = 3;
  CHECK(unsnarl_page(&surface, &content, NULL, &page) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "page_content: its size is 3"));
  CHECK(unsnarl_page(NULL, NULL, NULL, &page) == UNSNARL_INVALID_ARGUMENT);
  unsnarl_result_free(repaired);
}

static void refuses_deep_nesting(void) {
  static char plan[300000] = "{\"agents\": ";
  unsnarl_result* result = NULL;
  memset(plan + strlen(plan), '[', sizeof plan - 1 - strlen(plan));
  CHECK(unsnarl_plan_routes(plan, NULL, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "nested too deeply"));
}

/* Parts that may pass through each other: found, checked and repaired apart. */
static void lets_parts_pass(void) {
  static const int32_t parts[] = {0, 1}, allowed[] = {1, 0}, wrong[] = {0, -1};
  unsnarl_surface surface = crossing();
  unsnarl_result* result = NULL;
  surface.face_parts = parts;
  surface.allowed = allowed;
  surface.allowed_count = 1;
  CHECK(pairs_of(&surface) == 0);
  CHECK(unsnarl_check(&surface, NULL, &result) == UNSNARL_OK);
  CHECK(array(result, "pairs").rows == 0);
  unsnarl_result_free(result);
  CHECK(unsnarl_certify(&surface, crossing_positions, 6, NULL, &result) == UNSNARL_OK);
  CHECK(says(unsnarl_result_report(result), "\"embedded\":false"));
  CHECK(says(unsnarl_result_report(result), "\"resolved\":true"));
  unsnarl_result_free(result);
  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "allowed") == 0);
  CHECK(memcmp(array(result, "positions").data, crossing_positions, sizeof crossing_positions) == 0);
  unsnarl_result_free(result);
  CHECK(unsnarl_repair_sequence(&surface, 1, NULL, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "allowed") == 0);
  unsnarl_result_free(result);
  surface.allowed = wrong;
  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  surface.allowed = allowed;
  surface.face_parts = NULL;
  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "face_parts"));
}

static void finds_and_repairs(void) {
  const unsnarl_surface surface = crossing();
  unsnarl_surface moved = surface;
  unsnarl_result* result = NULL;
  unsnarl_result* certificate = NULL;
  unsnarl_array pairs, kinds, positions;

  CHECK(unsnarl_find_intersections(&surface, NULL, &result) == UNSNARL_OK);
  pairs = array(result, "pairs");
  kinds = array(result, "kinds");
  CHECK(pairs.rows == 1 && pairs.columns == 2 && pairs.type == UNSNARL_INT32);
  CHECK(((const int32_t*)pairs.data)[0] == 0 && ((const int32_t*)pairs.data)[1] == 1);
  CHECK(kinds.rows == 1 && kinds.type == UNSNARL_UINT8);
  CHECK(strcmp(unsnarl_pair_kind(((const uint8_t*)kinds.data)[0]), "disjoint") == 0);
  CHECK(unsnarl_pair_kind(5) == NULL && unsnarl_pair_kind(-1) == NULL);
  CHECK(says(unsnarl_result_report(result), "\"disjoint\":1"));
  CHECK(strcmp(unsnarl_result_status(result), "") == 0);
  unsnarl_result_free(result);

  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "embedded") == 0);
  CHECK(says(unsnarl_result_report(result), "unsnarl-report"));
  positions = array(result, "positions");
  CHECK(positions.rows == 6 && positions.columns == 3 && positions.type == UNSNARL_FLOAT64);
  moved.positions = positions.data;
  CHECK(pairs_of(&moved) == 0);
  CHECK(unsnarl_certify(&surface, positions.data, 6, NULL, &certificate) == UNSNARL_OK);
  CHECK(says(unsnarl_result_report(certificate), "\"embedded\":true"));
  unsnarl_result_free(certificate);
  unsnarl_result_free(result);
}

static void heeds_options(void) {
  const uint8_t all[] = {1, 1, 1, 1, 1, 1};
  const size_t sizes[] = {3, 1, 3, 1};
  const int32_t offsets[] = {0, 3, 6};
  unsnarl_surface surface = crossing();
  unsnarl_options options = defaults();
  unsnarl_result* result = NULL;

  CHECK(strcmp(options.weld, "seams") == 0 && strcmp(options.goal, "all") == 0);
  CHECK(strcmp(options.precision, "auto") == 0 && options.recover == 1 && options.views == 60);

  surface.fixed = all;
  CHECK(unsnarl_repair(&surface, &options, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "obstructed") == 0);
  unsnarl_result_free(result);

  surface.fixed = NULL;
  surface.mesh_sizes = sizes;
  surface.mesh_count = 2;
  surface.offsets = offsets;
  surface.offset_count = 3;
  options.precision = "float64";
  options.min_gap = 0.1;
  options.absolute = 1;
  CHECK(unsnarl_repair(&surface, &options, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "embedded") == 0);
  CHECK(says(unsnarl_result_report(result), "between_files"));
  CHECK(says(unsnarl_result_report(result), "\"precision\": \"float64\""));
  unsnarl_result_free(result);
}

static void keeps_gaps(void) {
  const double positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0.001, 1, 0, 0.001, 0, 1, 0.001};
  const int32_t corners[] = {0, 1, 2, 3, 4, 5};
  const uint8_t all[] = {1, 1, 1, 1, 1, 1};
  unsnarl_surface surface = crossing();
  surface.positions = positions;
  surface.vertex_count = 6;
  surface.corners = corners;
  surface.corner_count = 6;
  unsnarl_options options = defaults();
  options.min_gap = 0.02;
  unsnarl_result* result = NULL;
  CHECK(unsnarl_repair(&surface, &options, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "embedded") == 0);
  CHECK(says(unsnarl_result_report(result), "\"met\": true"));
  unsnarl_result_free(result);
  surface.fixed = all;
  CHECK(unsnarl_repair(&surface, &options, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "gap_not_met") == 0);
  unsnarl_result_free(result);
  options.gap_near_conflicts = 1;
  CHECK(unsnarl_repair(&surface, &options, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "embedded") == 0);
  unsnarl_result_free(result);
}

static void refuses_options_that_it_does_not_use(void) {
  unsnarl_surface surface = crossing();
  unsnarl_options options = defaults();
  unsnarl_result* result = NULL;

  options.views = 61;
  CHECK(unsnarl_repair(&surface, &options, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "does not use 'views'"));
  options = defaults();
  options.first_frame = 1;
  CHECK(unsnarl_find_intersections(&surface, &options, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "does not use 'first_frame'"));

  /* What is meant for the repair of a surface may be given to what looks at it; texts count as texts. */
  options = defaults();
  options.min_gap = 0.01;
  char weld[] = "seams";
  options.weld = weld;
  options.paper_mesh_energy = NULL;
  CHECK(unsnarl_find_intersections(&surface, &options, &result) == UNSNARL_OK);
  unsnarl_result_free(result);
}

static void takes_structs_of_older_callers(void) {
  unsnarl_options options = defaults();
  unsnarl_surface surface = crossing();
  unsnarl_result* result = NULL;

  /* Nothing behind `threads` is known to this caller, whatever lies there. */
  options.size = offsetof(unsnarl_options, goal);
  options.goal = "nonsense";
  CHECK(unsnarl_repair(&surface, &options, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "embedded") == 0);
  unsnarl_result_free(result);

  surface.size = offsetof(unsnarl_surface, fixed);
  surface.fixed = (const uint8_t*)"nonsense";
  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "embedded") == 0);
  unsnarl_result_free(result);

  options.size = sizeof options + 8;
  CHECK(unsnarl_find_intersections(&surface, &options, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "options: its size is"));
  options.size = 0;
  CHECK(unsnarl_find_intersections(&surface, &options, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(unsnarl_options_init(&options, 3) == UNSNARL_INVALID_ARGUMENT);
}

static void says_what_is_wrong(void) {
  const int32_t no_vertex[] = {0, 1, 2, 3, 4, 6};
  const int32_t back[] = {0, 4, 3, 6};
  const double no_number[] = {0, 0, 0, 1, 0, 0, NAN, 1, 0};
  unsnarl_surface surface = crossing();
  unsnarl_options options = defaults();
  unsnarl_result* result = NULL;
  unsnarl_array found;

  surface.corners = no_vertex;
  CHECK(unsnarl_find_intersections(&surface, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "face 1 uses vertex 6, but there are 6"));
  surface = crossing();
  surface.offsets = back;
  surface.offset_count = 4;
  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "face 1 runs from offset 4 to 3"));
  surface = crossing();
  surface.corner_count = 5;
  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "5 corners are no triangles"));
  surface = crossing();
  surface.positions = no_number;
  surface.vertex_count = 3;
  surface.corner_count = 3;
  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "vertex 2"));
  surface.positions = NULL;
  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "positions is NULL"));
  CHECK(unsnarl_repair(NULL, NULL, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  surface = crossing();
  CHECK(unsnarl_repair(&surface, NULL, NULL, NULL) == UNSNARL_INVALID_ARGUMENT);
  options.weld = "some";
  CHECK(unsnarl_find_intersections(&surface, &options, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "weld is 'some'; choose one of 'none', 'seams', 'all'"));
  CHECK(unsnarl_certify(&surface, crossing_positions, 5, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(unsnarl_certify(&surface, NULL, 6, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  surface.mesh_sizes = (const size_t[]){3, 1};
  surface.mesh_count = 1;
  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "mesh_sizes count 3 vertices and 1 faces; there are 6 and 2"));
  CHECK(result == NULL);

  surface = crossing();
  CHECK(unsnarl_find_intersections(&surface, NULL, &result) == UNSNARL_OK);
  CHECK(unsnarl_result_array(result, "positions", &found) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "it has 'kinds', 'pairs'"));
  unsnarl_result_free(result);
  unsnarl_result_free(NULL);
  unsnarl_context_free(NULL);
  unsnarl_document_free(NULL);
}

struct Watch {
  int calls, cancel_at;
  double fraction;
};

static int watch(const unsnarl_progress* progress, void* data) {
  struct Watch* const seen = data;
  CHECK(progress->size == sizeof *progress);
  CHECK(progress->fraction >= seen->fraction && progress->fraction <= 1);
  CHECK(strlen(progress->phase) > 0);
  seen->fraction = progress->fraction;
  return ++seen->calls == seen->cancel_at;
}

static void tells_progress_and_cancels(void) {
  const unsnarl_surface surface = crossing();
  struct Watch seen = {0, 0, 0}, stopping = {0, 1, 0};
  unsnarl_context* context = unsnarl_context_new(watch, &seen);
  unsnarl_result* result = NULL;

  CHECK(unsnarl_repair(&surface, NULL, context, &result) == UNSNARL_OK);
  CHECK(seen.calls > 0 && seen.fraction == 1);
  unsnarl_result_free(result);
  unsnarl_context_free(context);

  context = unsnarl_context_new(watch, &stopping);
  CHECK(unsnarl_repair(&surface, NULL, context, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "cancelled") == 0);
  unsnarl_result_free(result);
  unsnarl_context_free(context);

  context = unsnarl_context_new(NULL, NULL);
  unsnarl_context_cancel(context);
  CHECK(unsnarl_repair(&surface, NULL, context, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "cancelled") == 0);
  CHECK(memcmp(array(result, "positions").data, crossing_positions, sizeof crossing_positions) == 0);
  unsnarl_result_free(result);
  unsnarl_context_free(context);
}

/* Two tetrahedra, the small one mostly outside of the large one. */
static void nests_meshes(void) {
  static const double positions[] = {0,   0,   0,   4,   0,   0, 0,   4,   0,   0,   0,   4,
                                     1.2, 1.2, 1.1, 2.6, 2.5, 2, 2.5, 2.6, 2.2, 2.4, 2.4, 2.7};
  static const int32_t corners[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2, 4, 5, 7, 4, 6, 5, 5, 6, 7, 4, 7, 6};
  static const size_t sizes[] = {4, 4, 4, 4};
  const int32_t chain[] = {1, 0}, itself[] = {1, 0, -1, 0, 1, -1}, unknown[] = {2, 0};
  unsnarl_surface surface = {.size = sizeof surface,
                             .positions = positions,
                             .vertex_count = 8,
                             .corners = corners,
                             .corner_count = 24,
                             .mesh_sizes = sizes,
                             .mesh_count = 2,
                             .nested = chain,
                             .nested_count = 2};
  unsnarl_result* result = NULL;

  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "embedded") == 0);
  CHECK(says(unsnarl_result_report(result), "\"wrong_before\": 3"));
  CHECK(says(unsnarl_result_report(result), "\"wrong_after\": 0"));
  CHECK(says(unsnarl_result_report(result), "\"nested\": true"));
  unsnarl_result_free(result);

  surface.nested = itself;
  surface.nested_count = 6;
  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "inside itself"));
  surface.nested = unknown;
  surface.nested_count = 2;
  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "there is no mesh 2"));
  CHECK(unsnarl_repair_sequence(&surface, 1, NULL, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
}

static void moves_rigid_parts(void) {
  const int32_t both[] = {0, 0, 0, 1, 1, 1}, one[] = {0, 0, 0, 0, 0, 0};
  const uint8_t first[] = {1, 0, 0, 0, 0, 0};
  unsnarl_surface surface = crossing();
  unsnarl_options options = defaults();
  unsnarl_result* result = NULL;

  surface.rigid = both;
  CHECK(unsnarl_repair(&surface, &options, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "embedded") == 0);
  CHECK(says(unsnarl_result_report(result), "\"rigid_vertices\": 6"));
  CHECK(says(unsnarl_result_report(result), "\"name\": \"1\""));
  unsnarl_result_free(result);
  surface.rigid = one;
  CHECK(unsnarl_repair(&surface, &options, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "obstructed") == 0);
  CHECK(says(unsnarl_result_report(result), "\"rigid_faces\""));
  unsnarl_result_free(result);
  CHECK(unsnarl_repair_sequence(&surface, 1, &options, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  surface.fixed = first;
  CHECK(unsnarl_repair(&surface, &options, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  surface.fixed = NULL;
  options.each_component = 1;
  CHECK(unsnarl_repair(&surface, &options, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
}

static void repairs_sequences(void) {
  double frames[3 * 18];
  unsnarl_surface surface = crossing();
  unsnarl_options options = defaults();
  unsnarl_result* result = NULL;
  int t;

  for (t = 0; t < 3; ++t) {
    memcpy(frames + (size_t)t * 18, crossing_positions, sizeof crossing_positions);
    frames[t * 18] = 0.01 * t;
  }
  surface.positions = frames;
  options.first_frame = 1;
  CHECK(unsnarl_repair_sequence(&surface, 3, &options, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "embedded") == 0);
  CHECK(array(result, "positions").rows == 12);
  CHECK(says(unsnarl_result_report(result), "\"frame\":1") && !says(unsnarl_result_report(result), "\"frame\":0"));
  surface.positions = array(result, "positions").data;
  CHECK(pairs_of(&surface) == 0);
  unsnarl_result_free(result);
  options.first_frame = 4;
  CHECK(unsnarl_repair_sequence(&surface, 2, &options, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
}

static void knows_parts(void) {
  const uint8_t second[] = {0, 1};
  unsnarl_surface surface = crossing();
  unsnarl_result* result = NULL;

  CHECK(unsnarl_component_of_faces(&surface, NULL, &result) == UNSNARL_OK);
  CHECK(((const int32_t*)array(result, "components").data)[1] == 1);
  unsnarl_result_free(result);
  CHECK(unsnarl_boundary_vertices(&surface, NULL, &result) == UNSNARL_OK);
  CHECK(array(result, "vertices").rows == 6 && ((const uint8_t*)array(result, "vertices").data)[0] == 1);
  unsnarl_result_free(result);
  CHECK(unsnarl_vertices_of_faces(&surface, second, 2, &result) == UNSNARL_OK);
  CHECK(((const uint8_t*)array(result, "vertices").data)[0] == 0);
  CHECK(((const uint8_t*)array(result, "vertices").data)[5] == 1);
  unsnarl_result_free(result);
  CHECK(unsnarl_vertices_of_faces(&surface, second, 1, &result) == UNSNARL_INVALID_ARGUMENT);
  surface.vertex_count = 5;
  CHECK(unsnarl_vertices_of_faces(&surface, second, 2, &result) == UNSNARL_INVALID_ARGUMENT);
}

static void untangles_curves(void) {
  const double bow[] = {0, 0, 1, 1, 2, 2, 2, 0, 1, 0.9, 0, 2}; /* closed, crosses itself */
  const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, ell[] = {0, 0, 5, 0, 5, 1, 1, 1, 1, 5, 0, 5};
  const int32_t offsets[] = {0, 6}, square_offsets[] = {0, 4};
  unsnarl_curves curves = {.size = sizeof curves, .points = bow, .offsets = offsets, .curve_count = 1};
  unsnarl_curves start = {.size = sizeof start, .points = square, .offsets = square_offsets, .curve_count = 1};
  const char* const bad_pairs[] = {"0", "0=", "0=0,", "=0", "0=-1", "0 = 0", "0=1", "0=0,0=0", "0=0;0=0"};
  unsnarl_options options = defaults();
  unsnarl_result* result = NULL;
  unsnarl_result* found = NULL;

  CHECK(unsnarl_find_crossings(&curves, &found) == UNSNARL_OK);
  CHECK(array(found, "crossings").rows == 1 && array(found, "crossings").columns == 4);
  unsnarl_result_free(found);
  CHECK(unsnarl_untangle_curves(&curves, NULL, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "embedded") == 0);
  curves.points = array(result, "points").data;
  curves.offsets = array(result, "offsets").data;
  CHECK(unsnarl_find_crossings(&curves, &found) == UNSNARL_OK);
  CHECK(array(found, "crossings").rows == 0);
  unsnarl_result_free(found);
  unsnarl_result_free(result);

  curves.points = ell;
  curves.offsets = offsets;
  CHECK(unsnarl_planar_isotopy(&start, &curves, NULL, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "embedded") == 0);
  CHECK(array(result, "offsets").rows == array(result, "times").rows + 1);
  CHECK(memcmp(array(result, "points").data, square, sizeof square) == 0);
  CHECK(says(unsnarl_result_report(result), "\"becomes\": [0]"));
  unsnarl_result_free(result);

  options.pairs = "0=0";
  CHECK(unsnarl_planar_isotopy(&start, &curves, &options, NULL, &result) == UNSNARL_OK);
  unsnarl_result_free(result);
  for (size_t k = 0; k < sizeof bad_pairs / sizeof *bad_pairs; ++k) {
    options.pairs = bad_pairs[k];
    CHECK(unsnarl_planar_isotopy(&start, &curves, &options, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
    CHECK(says(unsnarl_error_message(), "pair"));
  }
}

static void spans_links(void) {
  unsnarl_result* knot = NULL;
  unsnarl_result* spanned = NULL;
  unsnarl_result* checked = NULL;
  unsnarl_curves link = {.size = sizeof link};
  unsnarl_surface surface = {.size = sizeof surface};
  unsnarl_options options = defaults();

  CHECK(unsnarl_knot_of_table("no knot", &knot) == UNSNARL_INVALID_ARGUMENT);
  CHECK(unsnarl_knot_of_table("hopf", &knot) == UNSNARL_OK);
  link.points = array(knot, "points").data;
  link.offsets = array(knot, "offsets").data;
  link.curve_count = array(knot, "offsets").rows - 1;
  CHECK(link.curve_count == 2);
  options.fair = 0;
  CHECK(unsnarl_seifert_surface(&link, &options, NULL, &spanned) == UNSNARL_OK);
  CHECK(says(unsnarl_result_report(spanned), "\"hold\":true"));
  surface.positions = array(spanned, "positions").data;
  surface.vertex_count = array(spanned, "positions").rows;
  surface.corners = array(spanned, "corners").data;
  surface.corner_count = 3 * array(spanned, "corners").rows;
  CHECK(unsnarl_check_seifert_surface(&surface, &link, NULL, &checked) == UNSNARL_OK);
  CHECK(says(unsnarl_result_report(checked), "\"hold\":true"));
  unsnarl_result_free(checked);
  checked = NULL;
  CHECK(unsnarl_untangled_seifert_surface(&surface, &options, NULL, &checked) == UNSNARL_OK);
  CHECK(says(unsnarl_result_report(checked), "\"hold\":true"));
  CHECK(array(checked, "positions").rows == surface.vertex_count);
  unsnarl_result_free(checked);
  checked = NULL;
  CHECK(unsnarl_knot_tube(&link, &surface, &checked) == UNSNARL_OK);
  CHECK(says(unsnarl_result_report(checked), "\"radius\":") && !says(unsnarl_result_report(checked), "\"radius\":0}"));
  CHECK(array(checked, "positions").rows > 0 && 2 * array(checked, "positions").rows == array(checked, "corners").rows);
  unsnarl_result_free(checked);
  checked = NULL;
  CHECK(unsnarl_relaxed_wire(&link, NULL, NULL, &checked) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "component"));
  options.handles = 1;
  CHECK(unsnarl_untangled_seifert_surface(&surface, &options, NULL, &checked) == UNSNARL_INVALID_ARGUMENT);
  unsnarl_result_free(spanned);
  unsnarl_result_free(knot);
}

static void moves_knots(void) {
  unsnarl_result* circle = NULL;
  unsnarl_result* knot = NULL;
  unsnarl_result* way = NULL;
  unsnarl_curves start = {.size = sizeof start};
  unsnarl_curves end = {.size = sizeof end};
  unsnarl_options options = defaults();

  CHECK(unsnarl_knot_of_table("kinks_1", &knot) == UNSNARL_OK);
  CHECK(unsnarl_knot_of_table("circle", &circle) == UNSNARL_OK);
  start.points = array(knot, "points").data;
  start.offsets = array(knot, "offsets").data;
  end.points = array(circle, "points").data;
  end.offsets = array(circle, "offsets").data;
  start.curve_count = end.curve_count = 1;
  options.pairs = "0=0";
  CHECK(unsnarl_knot_isotopy(&start, &end, &options, NULL, &way) == UNSNARL_INVALID_ARGUMENT);
  CHECK(unsnarl_knot_isotopy(&start, &end, NULL, NULL, &way) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(way), "embedded") == 0);
  CHECK(says(unsnarl_result_report(way), "\"hold\":true"));
  CHECK(array(way, "offsets").rows == array(way, "times").rows + 1);
  CHECK(memcmp(array(way, "points").data, start.points, 3 * sizeof(double) * array(knot, "points").rows) == 0);
  unsnarl_result_free(way);
  way = NULL;
  CHECK(unsnarl_relaxed_wire(&end, &options, NULL, &way) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "'pairs'"));
  options = defaults();
  CHECK(unsnarl_relaxed_wire(&end, &options, NULL, &way) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(way), "embedded") == 0);
  CHECK(says(unsnarl_result_report(way), "\"at_rest\":true"));
  CHECK(array(way, "points").rows >= 200 && array(way, "offsets").rows == 2);
  unsnarl_result_free(way);
  unsnarl_result_free(circle);
  unsnarl_result_free(knot);
}

static void write_text(const char* path, const char* text) {
  FILE* const file = fopen(path, "wb");
  CHECK(file != NULL && fputs(text, file) >= 0 && fclose(file) == 0);
}

static void reads_and_writes_files(const char* folder) {
  char in[4096], out[4096], other[4096];
  unsnarl_document* document = NULL;
  unsnarl_surface surface = {.size = sizeof surface};
  unsnarl_result* result = NULL;
  FILE* file;
  const char* partial = NULL;
  char line[64] = "";

  snprintf(in, sizeof in, "%s/c_in.obj", folder);
  snprintf(out, sizeof out, "%s/c_out.obj", folder);
  snprintf(other, sizeof other, "%s/c_out.ply", folder);
  write_text(in, "# kept\nv 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 2\nv 2 1 2\nf 1 2 3\nf 4 5 6\n");
  remove(out);
  CHECK(unsnarl_document_read(in, NULL, &document) == UNSNARL_OK);
  CHECK(says(unsnarl_document_report(document), "\"format\":\"obj\""));
  CHECK(unsnarl_document_surface(document, &surface) == UNSNARL_OK);
  CHECK(surface.vertex_count == 6 && surface.document == document);
  CHECK(pairs_of(&surface) == 1);

  CHECK(unsnarl_document_check_output(document, other) == UNSNARL_INVALID_ARGUMENT);
  CHECK(unsnarl_document_check_output(document, "/no/such/folder/a.obj") == UNSNARL_CANNOT_WRITE);
  CHECK(unsnarl_document_check_output(document, out) == UNSNARL_OK);
  CHECK(unsnarl_find_intersections(&surface, NULL, &result) == UNSNARL_OK);
  CHECK(unsnarl_document_write(document, result, out) == UNSNARL_INVALID_ARGUMENT);
  unsnarl_result_free(result);
  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_OK);
  CHECK(unsnarl_document_write(document, result, other) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "keeps the format of the input, obj"));
  CHECK(unsnarl_document_write(document, result, "/no/such/folder/a.obj") == UNSNARL_CANNOT_WRITE);
  CHECK(unsnarl_document_write(document, result, out) == UNSNARL_OK);
  CHECK(unsnarl_document_write_partial(document, result, "/no/such/folder/a.obj") == UNSNARL_CANNOT_WRITE);
  CHECK(unsnarl_document_partial(document, 0) == NULL);
  CHECK(unsnarl_document_write_partial(document, result, out) == UNSNARL_OK);
  partial = unsnarl_document_partial(document, 0);
  CHECK(says(partial, ".partial.obj"));
  file = fopen(partial, "rb");
  CHECK(file != NULL && fgets(line, sizeof line, file) != NULL && strcmp(line, "# kept\n") == 0);
  if (file != NULL) fclose(file);
  CHECK(remove(partial) == 0);
  unsnarl_result_free(result);
  unsnarl_document_free(document);

  file = fopen(out, "rb");
  CHECK(file != NULL && fgets(line, sizeof line, file) != NULL && strcmp(line, "# kept\n") == 0);
  if (file != NULL) fclose(file);
  CHECK(unsnarl_document_read(out, "obj", &document) == UNSNARL_OK);
  CHECK(unsnarl_document_surface(document, &surface) == UNSNARL_OK);
  CHECK(pairs_of(&surface) == 0);
  unsnarl_document_free(document);

  CHECK(unsnarl_document_read("/no/such/file.obj", NULL, &document) == UNSNARL_CANNOT_READ);
  CHECK(unsnarl_error_number() == ENOENT);
  CHECK(unsnarl_document_read("/no/such/\x1b[31m\n.obj", NULL, &document) == UNSNARL_CANNOT_READ);
  CHECK(says(unsnarl_error_message(), "/no/such/\\x1b[31m\\x0a.obj"));
  CHECK(unsnarl_document_read(in, "no format", &document) == UNSNARL_INVALID_ARGUMENT);
  CHECK(unsnarl_document_read(in, "ply", &document) == UNSNARL_CANNOT_READ);
  CHECK(unsnarl_error_number() == 0);
  CHECK(strlen(unsnarl_version()) >= 5);
}

static void repairs_files(const char* folder) {
  char in[4096], out[4096];
  unsnarl_document* document = NULL;
  unsnarl_surface surface = {.size = sizeof surface}, other = {.size = sizeof other};
  unsnarl_options options;
  unsnarl_result* result = NULL;
  uint8_t fixed[6] = {1, 1, 1, 1, 1, 1};

  snprintf(in, sizeof in, "%s/c_repair_in.obj", folder);
  snprintf(out, sizeof out, "%s/c_repair_out.obj", folder);
  write_text(in, "# kept\nv 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 2\nv 2 1 2\nf 1 2 3\nf 4 5 6\n");
  remove(out);
  CHECK(unsnarl_document_read(in, NULL, &document) == UNSNARL_OK);
  CHECK(unsnarl_document_surface(document, &surface) == UNSNARL_OK);
  CHECK(unsnarl_options_init(&options, sizeof options) == UNSNARL_OK);
  CHECK(options.keep_partial == 0 && options.no_partial == 0);
  CHECK(unsnarl_document_repair(document, &other, out, NULL, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(unsnarl_document_repair(document, &surface, "/no/such/folder/a.obj", NULL, NULL, &result) ==
        UNSNARL_CANNOT_WRITE);

  surface.fixed = fixed;
  CHECK(unsnarl_document_repair(document, &surface, out, &options, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "obstructed") == 0);
  CHECK(says(unsnarl_result_report(result), "\"written\": false"));
  unsnarl_result_free(result);
  CHECK(remove(out) != 0 && unsnarl_document_partial(document, 0) == NULL);

  surface.fixed = NULL;
  CHECK(unsnarl_document_repair(document, &surface, out, &options, NULL, &result) == UNSNARL_OK);
  CHECK(strcmp(unsnarl_result_status(result), "embedded") == 0);
  CHECK(says(unsnarl_result_report(result), "\"written\": true"));
  unsnarl_result_free(result);
  unsnarl_document_free(document);
  CHECK(unsnarl_document_read(out, NULL, &document) == UNSNARL_OK);
  CHECK(unsnarl_document_surface(document, &surface) == UNSNARL_OK);
  CHECK(pairs_of(&surface) == 0);
  unsnarl_document_free(document);

  CHECK(unsnarl_document_read(in, NULL, &document) == UNSNARL_OK);
  CHECK(unsnarl_document_surface(document, &surface) == UNSNARL_OK);
  CHECK(unsnarl_document_repair(document, &surface, NULL, NULL, NULL, &result) == UNSNARL_OK);
  unsnarl_result_free(result);
  unsnarl_document_free(document);
  CHECK(unsnarl_document_read(in, NULL, &document) == UNSNARL_OK);
  CHECK(unsnarl_document_surface(document, &surface) == UNSNARL_OK);
  CHECK(pairs_of(&surface) == 0);
  unsnarl_document_free(document);
}

/* Faces of a part by its name, a character each: "10" the first of two. */
static const char* faces_of(const unsnarl_document* document, const char* kind, const char* name) {
  static char text[8];
  unsnarl_result* result = NULL;
  unsnarl_array flags;
  CHECK(unsnarl_document_faces(document, kind, name, NULL, &result) == UNSNARL_OK);
  flags = array(result, "faces");
  snprintf(text, sizeof text, "%d%d", ((const uint8_t*)flags.data)[0], ((const uint8_t*)flags.data)[1]);
  unsnarl_result_free(result);
  return text;
}

static void knows_what_files_name(const char* folder) {
  char in[4096];
  unsnarl_document* document = NULL;
  unsnarl_surface surface = {.size = sizeof surface};
  unsnarl_result* result = NULL;
  int32_t is_any = 1;
  snprintf(in, sizeof in, "%s/c_named.obj", folder);
  write_text(
      in, "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 1 1 -1\nv 1 1 2\nv 2 1 2\no floor\ng low\nf 1 2 3\no blade\ng high\nf 4 5 6\n");
  CHECK(unsnarl_document_read(in, NULL, &document) == UNSNARL_OK);
  CHECK(unsnarl_document_surface(document, &surface) == UNSNARL_OK);
  CHECK(strcmp(faces_of(document, "object", "floor"), "10") == 0);
  CHECK(strcmp(faces_of(document, "group", "high"), "01") == 0);
  CHECK(strcmp(faces_of(document, "component", "1"), "01") == 0);
  CHECK(unsnarl_document_faces(document, "object", "roof", NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "'floor', 'blade'"));
  CHECK(unsnarl_document_faces(document, "component", "x", NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(unsnarl_document_faces(document, "colour", "red", NULL, &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(unsnarl_document_recompute_normals(document, &is_any) == UNSNARL_OK && is_any == 0);

  CHECK(unsnarl_check(&surface, NULL, &result) == UNSNARL_OK);
  CHECK(array(result, "pairs").rows == 1 && array(result, "kinds").rows == 1);
  CHECK(says(unsnarl_result_report(result), "\"unsnarl-check\""));
  CHECK(says(unsnarl_result_report(result), "\"name\": \"blade\""));
  unsnarl_result_free(result);
  unsnarl_document_free(document);
}

static void repairs_scenes_of_files(const char* folder) {
  char first[4096], second[4096], out[4096];
  const char* paths[2];
  unsnarl_document* document = NULL;
  unsnarl_surface surface = {.size = sizeof surface};
  unsnarl_result* result = NULL;
  snprintf(first, sizeof first, "%s/c_first.obj", folder);
  snprintf(second, sizeof second, "%s/c_second.off", folder);
  snprintf(out, sizeof out, "%s/CMakeFiles", folder); /* a folder that is there */
  paths[0] = first;
  paths[1] = second;
  write_text(first, "v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\n");
  write_text(second, "OFF\n3 1 0\n1 1 -1\n1 1 2\n2 1 2\n3 0 1 2\n");
  CHECK(unsnarl_document_read_scene(paths, 2, NULL, &document) == UNSNARL_OK);
  CHECK(unsnarl_document_surface(document, &surface) == UNSNARL_OK);
  CHECK(surface.vertex_count == 6 && surface.mesh_count == 2 && surface.mesh_sizes[2] == 3);
  CHECK(pairs_of(&surface) == 1);
  CHECK(strcmp(faces_of(document, "file", "c_second.off"), "01") == 0);
  CHECK(unsnarl_repair(&surface, NULL, NULL, &result) == UNSNARL_OK);
  CHECK(says(unsnarl_result_report(result), "\"name\": \"c_second.off\""));
  CHECK(unsnarl_document_check_output(document, folder) == UNSNARL_INVALID_ARGUMENT);
  CHECK(says(unsnarl_error_message(), "part of the input"));
  CHECK(unsnarl_document_check_output(document, "/no/such/folder") == UNSNARL_CANNOT_WRITE);
  CHECK(unsnarl_document_write(document, result, out) == UNSNARL_OK);
  unsnarl_result_free(result);
  unsnarl_document_free(document);

  snprintf(first, sizeof first, "%s/CMakeFiles/c_first.obj", folder);
  snprintf(second, sizeof second, "%s/CMakeFiles/c_second.off", folder);
  CHECK(unsnarl_document_read_scene(paths, 2, NULL, &document) == UNSNARL_OK);
  CHECK(unsnarl_document_surface(document, &surface) == UNSNARL_OK);
  CHECK(pairs_of(&surface) == 0);
  unsnarl_document_free(document);
  paths[1] = first;
  CHECK(unsnarl_document_read_scene(paths, 2, NULL, &document) == UNSNARL_INVALID_ARGUMENT);
  CHECK(unsnarl_document_read_scene(paths, 0, NULL, &document) == UNSNARL_INVALID_ARGUMENT);
}

static void makes_samples(void) {
  unsnarl_result* result = NULL;
  unsnarl_array corners;
  CHECK(unsnarl_list_samples(&result) == UNSNARL_OK);
  CHECK(says(unsnarl_result_report(result), "\"name\":\"crossing_tubes\""));
  unsnarl_result_free(result);
  CHECK(unsnarl_sample("crossing_tubes", 12, "{\"radius\": 0.3}", &result) == UNSNARL_OK);
  corners = array(result, "corners");
  CHECK(corners.rows > 0 && array(result, "positions").columns == 3);
  unsnarl_result_free(result);
  CHECK(unsnarl_sample("crossing_tubes", 12, "[]", &result) == UNSNARL_INVALID_ARGUMENT);
  CHECK(unsnarl_sample("no sample", 0, NULL, &result) == UNSNARL_INVALID_ARGUMENT);
}

int main(int count, char** arguments) {
  if (count != 2) return 2;
  finds_and_repairs();
  lets_parts_pass();
  refuses_deep_nesting();
  makes_pages();
  heeds_options();
  keeps_gaps();
  refuses_options_that_it_does_not_use();
  takes_structs_of_older_callers();
  says_what_is_wrong();
  tells_progress_and_cancels();
  nests_meshes();
  moves_rigid_parts();
  repairs_sequences();
  knows_parts();
  untangles_curves();
  spans_links();
  moves_knots();
  reads_and_writes_files(arguments[1]);
  repairs_files(arguments[1]);
  knows_what_files_name(arguments[1]);
  repairs_scenes_of_files(arguments[1]);
  makes_samples();
  printf("%d failures\n", failures);
  return failures == 0 ? 0 : 1;
}
