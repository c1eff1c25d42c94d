// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <common/GLLogStream.h>
#include <wrap/callback.h>

#include <string>

#include "filters.h"
#include "log_text.h"
#include "wscvt/base/execution.h"

namespace wscvt::filter {

// Code for all versions of MeshLab.

/// Wraps the host's callback for the library. It may be null.
inline ProgressCallback progress_to(vcg::CallBackPos* callback) {
  if (callback == nullptr) return {};
  return [callback](double fraction, const std::string& stage) {
    return callback(static_cast<int>(100.0 * fraction), stage.c_str());
  };
}

/// Level of a line of the log. In a window, shown_line marks up warnings itself.
inline GLLogStream::Levels log_level(const LogLine& line) {
  return line.warning && !host_has_window() ? GLLogStream::WARNING : GLLogStream::FILTER;
}

/// Returns the filter's requirements for the current layer, as the host's mask.
template <class Model>
int needed_parts(const Filter& filter) {
  return filter.id == FilterId::Describe ? Model::MM_FACENUMBER : Model::MM_NONE;
}

/// Returns the filter's changes, as the host's mask: mesh, vertex quality and vertex colour, and
/// face quality and face colour if the scan has them.
template <class Model>
int changed_parts(const Filter& filter) {
  if (filter.id == FilterId::Describe) return Model::MM_NONE;
  return Model::MM_VERTCOORD | Model::MM_VERTNORMAL | Model::MM_VERTNUMBER | Model::MM_VERTQUALITY |
         Model::MM_VERTCOLOR | Model::MM_FACEVERT | Model::MM_FACENORMAL | Model::MM_FACENUMBER |
         Model::MM_FACECOLOR | Model::MM_FACEQUALITY;
}

}  // namespace wscvt::filter
