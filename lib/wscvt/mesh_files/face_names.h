// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "wscvt/base/mesh_attributes.h"

namespace wscvt {

/// Collects the names of faces while a file is read.
class FaceNames {
 public:
  /// The faces from now on have this name. A name may come again.
  void begin(const std::string& name) {
    const auto [known, is_new] =
        numbers_.emplace(name, static_cast<std::int32_t>(names_.names.size()));
    if (is_new) names_.names.push_back(name);
    current_ = known->second;
  }

  /// The faces from now on are a set of their own, also if another has the same name.
  void begin_new(const std::string& name) {
    current_ = static_cast<std::int32_t>(names_.names.size());
    names_.names.push_back(name);
  }

  /// Gives the current name to all faces up to this number of them.
  void add_to(std::size_t faces) {
    if (names_.names.empty()) {
      unnamed_ = faces;
      return;
    }
    if (names_.of_face.empty()) names_.of_face.resize(unnamed_, -1);
    names_.of_face.resize(faces, current_);
  }

  /// Appends the names if there are at least two.
  void append_to(std::vector<NamedFaces>& lists) {
    if (names_.names.size() > 1 && !names_.of_face.empty()) lists.push_back(std::move(names_));
  }

 private:
  NamedFaces names_;
  std::map<std::string, std::int32_t, std::less<>> numbers_;
  std::int32_t current_ = -1;
  std::size_t unnamed_ = 0;  ///< faces before the first name
};

}  // namespace wscvt
