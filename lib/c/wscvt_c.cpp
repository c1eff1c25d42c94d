// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt_c.h"

#include <algorithm>
#include <cstring>
#include <exception>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "wscvt/base/error.h"
#include "wscvt/base/option.h"
#include "wscvt/base/text.h"
#include "wscvt/base/version.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/remesh.h"
#include "wscvt/remesh/remesh_options.h"
#include "wscvt/report/report.h"

struct wscvt_remesher {
  wscvt::TypedOptions options;
  wscvt_progress progress = nullptr;
  void* data = nullptr;
  std::optional<wscvt::IndexedMesh> scan;
  std::vector<std::string> warnings;  ///< about reading it
  std::optional<wscvt::RemeshResult> result;
  std::string report;
  std::string message;
};

namespace {

using namespace wscvt;

static_assert(sizeof(Vector3) == 3 * sizeof(double) && sizeof(Triangle) == 3 * sizeof(int32_t),
              "Arrays of points and triangles are arrays of numbers.");

/// An option as this interface writes it: edge-ratio = 1.4.
std::string in_words_of_c(const Sentence& sentence) {
  return sentence.in([](const NamedOption& option) {
    return option.value.empty() ? option.key : option.key + " = " + option.value;
  });
}

RemeshOptions options_of(const TypedOptions& given) {
  RemeshOptions options;
  read_options(given, options, [](std::string_view key, const Sentence& refusal) {
    if (!refusal.empty()) refuse(refusal);
    refuse("There is no option \"" + std::string(key) +
           "\". \"wscvt remesh --help-all\" lists the options.");
  });
  return options;
}

int outcome_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::InvalidInput:
      return WSCVT_INVALID_INPUT;
    case ErrorCode::NotStarShaped:
      return WSCVT_NOT_STAR_SHAPED;
    case ErrorCode::NumericalFailure:
      return WSCVT_NUMERICAL_FAILURE;
    case ErrorCode::InputOutput:
      return WSCVT_INPUT_OUTPUT;
    case ErrorCode::Cancelled:
      break;
  }
  return WSCVT_CANCELLED;
}

/// Runs the work, and keeps the message of its exception. No exception leaves this interface.
template <class Work>
int outcome_of_work(wscvt_remesher* remesher, const Work& work) {
  if (remesher == nullptr) return WSCVT_INVALID_INPUT;
  try {
    remesher->message.clear();
    try {
      work();
      return WSCVT_DONE;
    } catch (const Error& error) {
      remesher->message = readable(in_words_of_c(error.sentence()));
      return outcome_of(error.code());
    } catch (const std::bad_alloc&) {
      remesher->message =
          "There is not enough memory for this. Simplify the mesh or use fewer nodes.";
      return WSCVT_NO_MEMORY;
    } catch (const std::exception& error) {
      remesher->message = readable(error.what());
      return WSCVT_OTHER_FAILURE;
    }
  } catch (...) {  // no memory for a message
    return WSCVT_NO_MEMORY;
  }
}

void require_text(const char* text, const char* what) {
  if (text == nullptr) refuse(std::string("The ") + what + " is NULL. Give a text.");
}

const RemeshResult* result_of(const wscvt_remesher* remesher) {
  return remesher == nullptr || !remesher->result ? nullptr : &*remesher->result;
}

}  // namespace

const char* wscvt_version(void) { return wscvt::version(); }

wscvt_remesher* wscvt_new(void) { return new (std::nothrow) wscvt_remesher; }

void wscvt_free(wscvt_remesher* remesher) { delete remesher; }

const char* wscvt_message(const wscvt_remesher* remesher) {
  return remesher == nullptr ? "The remesher is NULL. wscvt_new makes one."
                             : remesher->message.c_str();
}

int wscvt_set_option(wscvt_remesher* remesher, const char* name, const char* value) {
  return outcome_of_work(remesher, [&] {
    require_text(name, "name of an option");
    std::string key(name);
    std::replace(key.begin(), key.end(), '_', '-');
    if (value == nullptr) {
      remesher->options.erase(key);
    } else {
      remesher->options[key] = value;
    }
  });
}

void wscvt_set_progress(wscvt_remesher* remesher, wscvt_progress progress, void* data) {
  if (remesher == nullptr) return;
  remesher->progress = progress;
  remesher->data = data;
}

int wscvt_set_scan(wscvt_remesher* remesher, const double* points, size_t point_count,
                   const int32_t* triangles, size_t triangle_count) {
  return outcome_of_work(remesher, [&] {
    if ((points == nullptr && point_count > 0) || (triangles == nullptr && triangle_count > 0)) {
      refuse("An array of the scan is NULL. Give its numbers, or the count 0.");
    }
    IndexedMesh scan;
    scan.points.resize(point_count);
    scan.triangles.resize(triangle_count);
    if (point_count > 0) {
      std::memcpy(scan.points.data()->data(), points, point_count * sizeof(Vector3));
    }
    if (triangle_count > 0) {
      std::memcpy(scan.triangles.data()->data(), triangles, triangle_count * sizeof(Triangle));
    }
    for (const Triangle& triangle : scan.triangles) {
      for (const int32_t corner : triangle) {
        if (corner >= 0 && static_cast<std::size_t>(corner) < point_count) continue;
        refuse("A triangle has the point " + std::to_string(corner) + ", but there are " +
               std::to_string(point_count) + " points. Count them from 0.");
      }
    }
    remesher->scan = std::move(scan);
    remesher->warnings.clear();
  });
}

int wscvt_read_scan(wscvt_remesher* remesher, const char* path) {
  return outcome_of_work(remesher, [&] {
    require_text(path, "name of the file");
    MeshFile file = wscvt::read_mesh_file(path);
    remesher->scan = std::move(file.mesh);
    remesher->warnings = std::move(file.warnings);
  });
}

int wscvt_run(wscvt_remesher* remesher, int threads) {
  return outcome_of_work(remesher, [&] {
    remesher->result.reset();
    remesher->report.clear();
    if (!remesher->scan) refuse("There is no scan. wscvt_set_scan or wscvt_read_scan gives one.");
    require_in_range(threads, threads_option);
    const RemeshOptions options = options_of(remesher->options);
    ProgressCallback callback;
    if (remesher->progress != nullptr) {
      callback = [remesher](double fraction, const std::string& stage) {
        return remesher->progress(fraction, stage.c_str(), remesher->data) != 0;
      };
    }
    remesher->result = wscvt::remesh(*remesher->scan, options, Execution(threads, callback));
    std::vector<wscvt::Sentence>& warnings = remesher->result->warnings;
    warnings.insert(warnings.begin(), remesher->warnings.begin(), remesher->warnings.end());
    remesher->report = wscvt::report_json(*remesher->result);
  });
}

size_t wscvt_node_count(const wscvt_remesher* remesher) {
  const RemeshResult* const result = result_of(remesher);
  return result == nullptr ? 0 : result->mesh.points.size();
}

size_t wscvt_triangle_count(const wscvt_remesher* remesher) {
  const RemeshResult* const result = result_of(remesher);
  return result == nullptr ? 0 : result->mesh.triangles.size();
}

const double* wscvt_positions(const wscvt_remesher* remesher) {
  const RemeshResult* const result = result_of(remesher);
  return result == nullptr ? nullptr : result->mesh.points.data()->data();
}

const int32_t* wscvt_triangles(const wscvt_remesher* remesher) {
  const RemeshResult* const result = result_of(remesher);
  return result == nullptr ? nullptr : result->mesh.triangles.data()->data();
}

const double* wscvt_cell_areas(const wscvt_remesher* remesher) {
  const RemeshResult* const result = result_of(remesher);
  return result == nullptr ? nullptr : result->cell_areas.data();
}

const char* wscvt_report(const wscvt_remesher* remesher) {
  return remesher == nullptr ? "" : remesher->report.c_str();
}

int wscvt_write_mesh(wscvt_remesher* remesher, const char* path) {
  return outcome_of_work(remesher, [&] {
    require_text(path, "name of the file");
    if (!remesher->result) refuse("There is no remesh. wscvt_run makes one.");
    wscvt::write_mesh(remesher->result->mesh, path);
  });
}
