// SPDX-License-Identifier: GPL-3.0-or-later
// A file of its own, so that a program or plugin that uses none of OpenMesh's meshes does not need
// its library.
#include "wscvt/measures/carried_attributes.h"
#include "wscvt/remesh.h"

namespace wscvt {

RemeshResult remesh(const Mesh& scan, const RemeshOptions& options, const Execution& execution) {
  const IndexedMesh flat = to_indexed(scan);
  const MeshAttributes attributes = attributes_of(scan);
  RemeshResult result = remesh(flat, options, execution);
  if (!attributes.empty()) {
    result.attributes = carried_attributes(flat, attributes, result.mesh, execution);
  }
  return result;
}

Mesh to_mesh(const RemeshResult& result) { return to_mesh(result.mesh, result.attributes); }

}  // namespace wscvt
