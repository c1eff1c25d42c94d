/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Uses the interface for C, as C: c_interface_test SCAN.ply OUTPUT.ply. Exits with 1 and a line per
 * fault. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "wscvt_c.h"

static int faults = 0;

#define EXPECT(condition)                                              \
  do {                                                                 \
    if (!(condition)) {                                                \
      ++faults;                                                        \
      fprintf(stderr, "line %d: %s is false\n", __LINE__, #condition); \
    }                                                                  \
  } while (0)

struct heard {
  int calls;
  double last;
  int stop_at; /* the call that is answered with 0 */
};

static int hear(double fraction, const char* stage, void* data) {
  struct heard* heard = data;
  EXPECT(fraction >= heard->last && fraction <= 1.0);
  EXPECT(stage[0] != '\0');
  heard->last = fraction;
  return ++heard->calls != heard->stop_at;
}

/* A closed surface without handles has 2 N - 4 triangles, and encloses a volume. */
static void expect_closed(const wscvt_remesher* remesher) {
  const size_t count = wscvt_triangle_count(remesher);
  const int32_t* const triangles = wscvt_triangles(remesher);
  const double* const positions = wscvt_positions(remesher);
  double six_volumes = 0.0;
  EXPECT(count == 2 * wscvt_node_count(remesher) - 4);
  for (size_t k = 0; k < count; ++k) {
    const double* const a = positions + 3 * triangles[3 * k];
    const double* const b = positions + 3 * triangles[3 * k + 1];
    const double* const c = positions + 3 * triangles[3 * k + 2];
    six_volumes += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                   a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  EXPECT(six_volumes > 0.0);
}

static void refuses_what_is_wrong(const char* scan) {
  wscvt_remesher* const remesher = wscvt_new();
  const double points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int32_t triangle[3] = {0, 1, 3};
  EXPECT(wscvt_run(remesher, 0) == WSCVT_INVALID_INPUT);
  EXPECT(strstr(wscvt_message(remesher), "There is no scan.") != NULL);
  EXPECT(wscvt_set_scan(remesher, points, 3, triangle, 1) == WSCVT_INVALID_INPUT);
  EXPECT(strstr(wscvt_message(remesher), "point 3") != NULL);
  EXPECT(wscvt_set_scan(remesher, NULL, 3, triangle, 1) == WSCVT_INVALID_INPUT);
  EXPECT(wscvt_read_scan(remesher, "not there.ply") == WSCVT_INPUT_OUTPUT);
  EXPECT(strstr(wscvt_message(remesher), "not there.ply") != NULL);
  EXPECT(wscvt_read_scan(remesher, NULL) == WSCVT_INVALID_INPUT);
  EXPECT(wscvt_read_scan(remesher, scan) == WSCVT_DONE);
  EXPECT(wscvt_message(remesher)[0] == '\0');

  EXPECT(wscvt_set_option(remesher, "nodes", "three") == WSCVT_DONE);
  EXPECT(wscvt_run(remesher, 0) == WSCVT_INVALID_INPUT);
  EXPECT(strstr(wscvt_message(remesher), "three") != NULL);
  EXPECT(wscvt_set_option(remesher, "nodes", NULL) == WSCVT_DONE);
  EXPECT(wscvt_set_option(remesher, "colour", "red") == WSCVT_DONE);
  EXPECT(wscvt_run(remesher, 0) == WSCVT_INVALID_INPUT);
  EXPECT(strstr(wscvt_message(remesher), "\"colour\"") != NULL);
  EXPECT(wscvt_set_option(remesher, "colour", NULL) == WSCVT_DONE);
  EXPECT(wscvt_set_option(remesher, "sampling", "fibonacci") == WSCVT_DONE);
  EXPECT(wscvt_run(remesher, 0) == WSCVT_INVALID_INPUT);
  EXPECT(strstr(wscvt_message(remesher), "as-published") != NULL);
  EXPECT(strstr(wscvt_message(remesher), "--") == NULL);
  EXPECT(wscvt_run(remesher, -1) == WSCVT_INVALID_INPUT);
  EXPECT(wscvt_write_mesh(remesher, "none.ply") == WSCVT_INVALID_INPUT);
  EXPECT(wscvt_positions(remesher) == NULL && wscvt_node_count(remesher) == 0);
  wscvt_free(remesher);

  EXPECT(wscvt_run(NULL, 0) == WSCVT_INVALID_INPUT);
  EXPECT(wscvt_message(NULL)[0] != '\0');
  EXPECT(wscvt_triangles(NULL) == NULL && wscvt_report(NULL)[0] == '\0');
  wscvt_free(NULL);
}

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  refuses_what_is_wrong(argv[1]);

  wscvt_remesher* const remesher = wscvt_new();
  struct heard heard = {0, 0.0, 0};
  EXPECT(wscvt_version()[0] != '\0');
  EXPECT(wscvt_read_scan(remesher, argv[1]) == WSCVT_DONE);
  EXPECT(wscvt_set_option(remesher, "nodes", "300") == WSCVT_DONE);
  EXPECT(wscvt_set_option(remesher, "edge_ratio", "1.3") == WSCVT_DONE);
  EXPECT(wscvt_set_option(remesher, "weighting", "WSCVT-C") == WSCVT_DONE);
  wscvt_set_progress(remesher, hear, &heard);
  EXPECT(wscvt_run(remesher, 1) == WSCVT_DONE);
  EXPECT(heard.calls > 3 && heard.last > 0.9);
  EXPECT(wscvt_node_count(remesher) == 300);
  expect_closed(remesher);
  double area = 0.0;
  for (size_t k = 0; k < 300; ++k) area += wscvt_cell_areas(remesher)[k];
  EXPECT(area > 0.0);
  EXPECT(strstr(wscvt_report(remesher), "\"edge-ratio\": 1.3") != NULL);
  EXPECT(wscvt_write_mesh(remesher, argv[2]) == WSCVT_DONE);

  /* The same arrays again, through this interface, are the same scan. */
  const size_t nodes = wscvt_node_count(remesher);
  const size_t triangles = wscvt_triangle_count(remesher);
  double* const points = malloc(nodes * 3 * sizeof(double));
  int32_t* const corners = malloc(triangles * 3 * sizeof(int32_t));
  memcpy(points, wscvt_positions(remesher), nodes * 3 * sizeof(double));
  memcpy(corners, wscvt_triangles(remesher), triangles * 3 * sizeof(int32_t));
  wscvt_remesher* const other = wscvt_new();
  EXPECT(wscvt_set_scan(other, points, nodes, corners, triangles) == WSCVT_DONE);
  free(points);
  free(corners);
  EXPECT(wscvt_set_option(other, "nodes", "60") == WSCVT_DONE);
  EXPECT(wscvt_run(other, 2) == WSCVT_DONE);
  EXPECT(wscvt_node_count(other) == 60);
  wscvt_free(other);

  /* What was said about reading the scan stands in the report. */
  char tail[4096];
  snprintf(tail, sizeof tail, "%s.tail.stl", argv[2]);
  EXPECT(wscvt_write_mesh(remesher, tail) == WSCVT_DONE);
  FILE* const file = fopen(tail, "ab");
  EXPECT(file != NULL && fwrite("01234567890123456789", 1, 20, file) == 20);
  if (file != NULL) fclose(file);
  wscvt_remesher* const warned = wscvt_new();
  EXPECT(wscvt_read_scan(warned, tail) == WSCVT_DONE);
  EXPECT(wscvt_set_option(warned, "nodes", "60") == WSCVT_DONE);
  EXPECT(wscvt_run(warned, 1) == WSCVT_DONE);
  EXPECT(strstr(wscvt_report(warned), "20 bytes behind its last triangle") != NULL);
  wscvt_free(warned);
  remove(tail);

  heard.calls = 0;
  heard.last = 0.0;
  heard.stop_at = 2;
  EXPECT(wscvt_run(remesher, 1) == WSCVT_CANCELLED);
  EXPECT(heard.calls == 2);
  EXPECT(wscvt_node_count(remesher) == 0);
  wscvt_free(remesher);
  return faults > 0;
}
