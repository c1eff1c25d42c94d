// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the module. Each is in a file of its name.
#ifndef WSCVT_PYTHON_BINDINGS_H_
#define WSCVT_PYTHON_BINDINGS_H_

#include <pybind11/pybind11.h>

namespace wscvt::python {

void bind_error(pybind11::module_& module);
void bind_options(pybind11::module_& module);
void bind_remesh_object(pybind11::module_& module);
void bind_remesh(pybind11::module_& module);
void bind_measures(pybind11::module_& module);
void bind_distances(pybind11::module_& module);
void bind_extract(pybind11::module_& module);
void bind_attributes(pybind11::module_& module);
void bind_convex(pybind11::module_& module);
void bind_fabric(pybind11::module_& module);
void bind_segment(pybind11::module_& module);
void bind_fragment(pybind11::module_& module);
void bind_tetrahedra(pybind11::module_& module);
void bind_clump(pybind11::module_& module);
void bind_files(pybind11::module_& module);
void bind_sample(pybind11::module_& module);
void bind_grow(pybind11::module_& module);
void bind_job(pybind11::module_& module);

}  // namespace wscvt::python

#endif  // WSCVT_PYTHON_BINDINGS_H_
