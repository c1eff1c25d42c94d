// SPDX-License-Identifier: GPL-3.0-or-later
#include <wscvt/mesh_files/mesh_io.h>
#include <wscvt/remesh.h>
#include <wscvt/report/report.h>

#include <iostream>

int main(int /*argc*/, char** argv) try {
  wscvt::RemeshOptions options;
  options.node_count = 500;
  const auto result = wscvt::remesh(wscvt::read_mesh(argv[1]), options);
  wscvt::write_mesh(result.mesh, argv[2]);
  for (const std::string& line : wscvt::report_lines(result)) std::cout << line << '\n';
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
