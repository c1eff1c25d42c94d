/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef WSCVT_C_H_
#define WSCVT_C_H_

/* The remesher for C, and for all that calls C: MATLAB (loadlibrary), Julia (ccall), R, Python
 * (ctypes). This interface is stable: a later version may add functions and options, and changes
 * none. All texts are UTF-8 and end with a NUL. Different remeshers may be used on different
 * threads at a time. */

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(WSCVT_C_BUILDS)
#define WSCVT_C_API __declspec(dllexport)
#elif defined(__GNUC__) && !defined(_WIN32)
#define WSCVT_C_API __attribute__((visibility("default")))
#else
#define WSCVT_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* A scan, its options and its remesh. */
typedef struct wscvt_remesher wscvt_remesher;

/* Outcomes. wscvt_message tells what is wrong and what to do. */
#define WSCVT_DONE 0
#define WSCVT_INVALID_INPUT 1   /* a mesh, the content of a file or an option is not usable */
#define WSCVT_NOT_STAR_SHAPED 2 /* the method "as-published" cannot remesh the scan */
#define WSCVT_NUMERICAL_FAILURE 3
#define WSCVT_INPUT_OUTPUT 4 /* a file could not be opened, read or written */
#define WSCVT_CANCELLED 5    /* the progress function asked to stop */
#define WSCVT_NO_MEMORY 6
#define WSCVT_OTHER_FAILURE 7 /* a fault of this library */

/* Called with the fraction of the work done, 0 to 1, and the name of the stage, on the thread that
 * called wscvt_run. Returns 0 to cancel. Must not throw or jump out. */
typedef int (*wscvt_progress)(double fraction, const char* stage, void* data);

/* The version of the library, such as "3.0.0". */
WSCVT_C_API const char* wscvt_version(void);

/* A new remesher with the default options; NULL if there is no memory. wscvt_free ends it, and all
 * pointers that it returned; of NULL it does nothing. */
WSCVT_C_API wscvt_remesher* wscvt_new(void);
WSCVT_C_API void wscvt_free(wscvt_remesher* remesher);

/* What went wrong in the last call that returned an outcome; "" if nothing. Valid until the next
 * such call. */
WSCVT_C_API const char* wscvt_message(const wscvt_remesher* remesher);

/* Sets an option, by its name and value as in "wscvt remesh --help-all" without the dashes:
 * "nodes", "500"; "edge-ratio", "1.3"; "distances", "true". wscvt_run checks them. NULL as value:
 * the default again. */
WSCVT_C_API int wscvt_set_option(wscvt_remesher* remesher, const char* name, const char* value);

/* Sets the function that hears of the progress; NULL: none. */
WSCVT_C_API void wscvt_set_progress(wscvt_remesher* remesher, wscvt_progress progress, void* data);

/* Sets the scan: x, y, z of each point, and three indices from 0 per triangle, counter-clockwise
 * seen from outside. Both arrays are copied. */
WSCVT_C_API int wscvt_set_scan(wscvt_remesher* remesher, const double* points, size_t point_count,
                               const int32_t* triangles, size_t triangle_count);

/* Reads the scan from a mesh file: .ply, .stl, .obj, .off and others, also with .gz. */
WSCVT_C_API int wscvt_read_scan(wscvt_remesher* remesher, const char* path);

/* Remeshes the scan on this many threads, 0 for all; the result does not depend on them. The scan
 * stays, so that another run with other options may follow. After a failure there is no result. */
WSCVT_C_API int wscvt_run(wscvt_remesher* remesher, int threads);

/* The result of the last run; 0 and NULL without one. The arrays hold until the next run.
 * Positions are x, y, z per node, areas one number per node, in the scan's units. */
WSCVT_C_API size_t wscvt_node_count(const wscvt_remesher* remesher);
WSCVT_C_API size_t wscvt_triangle_count(const wscvt_remesher* remesher);
WSCVT_C_API const double* wscvt_positions(const wscvt_remesher* remesher);
WSCVT_C_API const int32_t* wscvt_triangles(const wscvt_remesher* remesher);
WSCVT_C_API const double* wscvt_cell_areas(const wscvt_remesher* remesher);

/* The report of the last run as JSON, with options, warnings, errors and quality; "" without a run.
 */
WSCVT_C_API const char* wscvt_report(const wscvt_remesher* remesher);

/* Writes the result to a mesh file, by its ending. */
WSCVT_C_API int wscvt_write_mesh(wscvt_remesher* remesher, const char* path);

#ifdef __cplusplus
}
#endif

#endif
