// SPDX-License-Identifier: GPL-3.0-or-later
#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>
#include <ostream>

#include "toolbox/volume/label_volume.h"
#include "wscvt/base/error.h"
#include "wscvt/base/output_file.h"
#include "wscvt/base/text.h"
#include "wscvt/mesh_files/text_writers.h"

namespace wscvt {

namespace {

/// Packs its input as gzip or zlib.
class LabelPacker {
 public:
  explicit LabelPacker(bool is_gzip) {
    constexpr int gzip_bits = 31;
    constexpr int zlib_bits = 15;
    if (deflateInit2(&stream_, Z_BEST_SPEED, Z_DEFLATED, is_gzip ? gzip_bits : zlib_bits, 8,
                     Z_DEFAULT_STRATEGY) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  LabelPacker(const LabelPacker&) = delete;
  LabelPacker& operator=(const LabelPacker&) = delete;
  ~LabelPacker() { deflateEnd(&stream_); }

  void add(const std::string& bytes, bool is_last) {
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream_.avail_in = static_cast<uInt>(bytes.size());
    do {
      std::string room(1U << 16U, '\0');
      stream_.next_out = reinterpret_cast<Bytef*>(room.data());
      stream_.avail_out = static_cast<uInt>(room.size());
      deflate(&stream_, is_last ? Z_FINISH : Z_NO_FLUSH);
      packed_.append(room, 0, room.size() - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }

  const std::string& packed() const { return packed_; }

 private:
  z_stream stream_{};
  std::string packed_;
};

std::string count_text(const VoxelCounts& counts) {
  return std::to_string(counts[0]) + " " + std::to_string(counts[1]) + " " +
         std::to_string(counts[2]);
}

Vector3 place_of_first(const VolumeGeometry& geometry) {
  return geometry.point(Vector3::Constant(0.5));
}

std::string nrrd_header(const VolumeGeometry& geometry, bool is_short) {
  std::string text = std::string("NRRD0004\ntype: ") + (is_short ? "uint16" : "uint32") +
                     "\ndimension: 3\nsizes: " + count_text(geometry.counts) +
                     "\nencoding: gzip\nendian: little\nspace dimension: 3\nspace directions:";
  for (Eigen::Index k = 0; k < 3; ++k) text += " (" + vector_text(geometry.axes.col(k), ",") + ")";
  text += "\nspace origin: (" + vector_text(place_of_first(geometry), ",") + ")\n";
  if (!geometry.unit.empty()) {
    const std::string quoted = '"' + geometry.unit + '"';
    text += "space units: " + quoted + " " + quoted + " " + quoted + "\n";
  }
  return text + "\n";
}

std::string meta_image_header(const VolumeGeometry& geometry, bool is_short, std::size_t packed) {
  const Vector3 lengths = geometry.axes.colwise().norm();
  std::string matrix;
  for (Eigen::Index k = 0; k < 3; ++k) {
    matrix += " " + vector_text(geometry.axes.col(k) / lengths[k]);
  }
  return "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
         "CompressedData = True\nCompressedDataSize = " +
         std::to_string(packed) + "\nTransformMatrix =" + matrix +
         "\nOffset = " + vector_text(place_of_first(geometry)) +
         (geometry.unit.empty() ? "" : "\nDistanceUnits = " + geometry.unit) +
         "\nElementSpacing = " + vector_text(lengths) +
         "\nDimSize = " + count_text(geometry.counts) +
         "\nElementType = " + (is_short ? "MET_USHORT" : "MET_UINT") +
         "\nElementDataFile = LOCAL\n";
}

}  // namespace

void check_label_file(const std::string& path) {
  const std::string ending = ending_of(path);
  if (ending == ".nrrd" || ending == ".mha") return;
  refuse("\"" + path +
         "\" does not have the ending of a format for labels. Give a name that ends in .nrrd or "
         ".mha.");
}

void write_labels(const std::string& path, LabelVolume& volume, Label largest,
                  const Execution& execution) {
  check_label_file(path);
  const bool is_nrrd = ending_of(path) == ".nrrd";
  const bool is_short = largest <= std::numeric_limits<std::uint16_t>::max();
  const VolumeGeometry& geometry = volume.geometry();
  const int bytes = is_short ? 2 : 4;
  LabelPacker packer(is_nrrd);
  const auto add = [&](const std::vector<Label>& row, std::int32_t y, std::int32_t z) {
    std::string text;
    for (const Label found : row) {
      const Label label = found > largest ? 0 : found;
      for (int k = 0; k < bytes; ++k) text += static_cast<char>(label >> (8 * k) & 0xffU);
    }
    packer.add(text, z + 1 == geometry.counts[2] && y + 1 == geometry.counts[1]);
  };
  for_each_row(volume, execution, "Writing labels", add);
  const std::string header = is_nrrd
                                 ? nrrd_header(geometry, is_short)
                                 : meta_image_header(geometry, is_short, packer.packed().size());
  write_file(path, [&](std::ostream& stream) { stream << header << packer.packed(); });
}

}  // namespace wscvt
