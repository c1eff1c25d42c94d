// SPDX-License-Identifier: GPL-3.0-or-later
// Files that claim to be meshes. The first byte names the reader: p PLY, s STL, o OBJ, k and v
// VTK's older files and those in XML, x points as text, c PCD, g Gmsh, a Abaqus, any other OFF.
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

#include "fuzz/promise.h"
#include "wscvt/base/error.h"
#include "wscvt/mesh_files/byte_reader.h"
#include "wscvt/mesh_files/mesh_io.h"
#include "wscvt/mesh_files/readers.h"

namespace {

using namespace wscvt;

void read(char format, ByteReader& reader, MeshFile& file) {
  switch (format) {
    case 'p':
      return read_ply(reader, file);
    case 's':
      return read_stl(reader, file);
    case 'o':
      return read_obj(reader, file);
    case 'g':
      return read_gmsh(reader, file);
    case 'a':
      return read_abaqus(reader, file);
    case 'k':
      return read_legacy_vtk(reader, file);
    case 'v':
      return read_vtp(reader, file);
    case 'x':
      return read_point_text(reader, file);
    case 'c':
      return read_pcd(reader, file);
    default:
      return read_off(reader, file);
  }
}

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string content(reinterpret_cast<const char*>(data) + 1, size - 1);
  std::istringstream stream(content);
  ByteReader reader(stream, content.size(), "file");
  try {
    MeshFile file;
    read(static_cast<char>(data[0]), reader, file);
    const IndexedMesh& mesh = file.mesh;
    for (const Triangle& t : mesh.triangles) {
      for (const std::int32_t v : t) {
        promise(v >= 0 && static_cast<std::size_t>(v) < mesh.points.size(),
                "an index does not fit");
      }
    }
    // A byte holds a coordinate at most, a corner, or a digit of one; packed, up to 1100 of them.
    const std::size_t most = content.size() * (data[0] == 'v' || data[0] == 'c' ? 1100 : 1);
    promise(mesh.points.size() <= most, "more points than bytes");
    promise(mesh.triangles.size() <= most, "more triangles than bytes");
  } catch (const Error& error) {
    promise(error.code() == ErrorCode::InputOutput, error.what());
    promise(std::string(error.what()).size() > 20, "no sentence");
  }
  return 0;
}
