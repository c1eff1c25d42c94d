// SPDX-License-Identifier: GPL-3.0-or-later
// The library for Python: meshes are NumPy arrays, options are keywords with their command-line
// names, reports are dictionaries. A new subject needs a file NAME_binding.cpp and a line in
// bindings.h and below. conversion.h and work.h have the shared code of the bindings.
#include <pybind11/pybind11.h>

#include "bindings.h"
#include "wscvt/base/version.h"

PYBIND11_MODULE(_wscvt, module) {
  module.attr("__version__") = wscvt::version();
  wscvt::python::bind_error(module);
  wscvt::python::bind_options(module);
  wscvt::python::bind_remesh_object(module);
  wscvt::python::bind_remesh(module);
  wscvt::python::bind_measures(module);
  wscvt::python::bind_distances(module);
  wscvt::python::bind_segment(module);
  wscvt::python::bind_extract(module);
  wscvt::python::bind_attributes(module);
  wscvt::python::bind_convex(module);
  wscvt::python::bind_fabric(module);
  wscvt::python::bind_fragment(module);
  wscvt::python::bind_tetrahedra(module);
  wscvt::python::bind_clump(module);
  wscvt::python::bind_files(module);
  wscvt::python::bind_sample(module);
  wscvt::python::bind_grow(module);
  wscvt::python::bind_job(module);
}
