// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>
#include <string>

#include "support/expect_error.h"
#include "wscvt/base/error.h"
#include "wscvt/base/indexed_mesh.h"
#include "wscvt/mesh_files/byte_reader.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt::test {

using Reader = void (*)(ByteReader&, MeshFile&);

/// What a reader makes of a file with this content.
inline MeshFile read_file(Reader read, const std::string& content) {
  std::istringstream stream(content);
  ByteReader reader(stream, content.size(), "a file");
  MeshFile file;
  read(reader, file);
  return file;
}
inline IndexedMesh read_content(Reader read, const std::string& content) {
  return read_file(read, content).mesh;
}

/// The sentence with which a reader refuses a content; empty, and a failure, when it does not.
inline std::string refusal(Reader read, const std::string& content) {
  const std::string sentence =
      refusal(ErrorCode::InputOutput, [&] { read_content(read, content); });
  EXPECT_NE(sentence, "") << "was read: " << content.substr(0, 200);
  return sentence;
}

/// Bytes of a number; the machines this is tested on are little-endian.
template <class Value>
std::string bytes(Value value, bool big_endian = false) {
  std::string result(sizeof value, '\0');
  std::memcpy(result.data(), &value, sizeof value);
  return big_endian ? std::string(result.rbegin(), result.rend()) : result;
}

}  // namespace wscvt::test
