// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <CLI/App.hpp>
#include <functional>
#include <string>
#include <vector>

#include "toolbox/tetrahedra/tetrahedra.h"
#include "work.h"

namespace wscvt::program {

/// Files of tetrahedra.
struct TetrahedraArguments {
  std::vector<std::string> files;  ///< the ending selects the format
  double edge = 0.0;               ///< longest wanted, length; 0: as the surface's
};

/// Adds the arguments. Parsing changes `arguments`, which must outlive `app`. `filled`: what is
/// filled.
void add_tetrahedra_arguments(CLI::App& app, TetrahedraArguments& arguments,
                              const std::string& filled);

/// Throws wscvt::Error for names with unknown endings, and if Gmsh is needed and not there.
void check_tetrahedra_arguments(const TetrahedraArguments& arguments);

/// Makes and writes the tetrahedra that the call asks for. Returns lines for the log.
std::vector<std::string> write_all_tetrahedra(const TetrahedraArguments& arguments, Work& work,
                                              const std::function<TetrahedralMesh()>& make);

}  // namespace wscvt::program
