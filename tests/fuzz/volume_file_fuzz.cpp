// SPDX-License-Identifier: GPL-3.0-or-later
// Files that claim to be volumes of labels. The first byte names the format; the second what is
// chosen: bit 0 a channel, bit 1 a frame, bit 2 an array.
#include <unistd.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include "fuzz/promise.h"
#include "toolbox/volume/open_volume.h"
#include "wscvt/base/error.h"

namespace {

using namespace wscvt;

std::string ending_for(char format) {
  switch (format) {
    case 'a':
      return ".am";
    case 'n':
      return ".nrrd";
    case 'm':
      return ".mha";
    case 'v':
      return ".vti";
    case 'k':
      return ".vtk";
    case 't':
      return ".tif";
    case 'p':
      return ".png";
    case 'i':
      return ".nii";
    case 'z':
      return ".nii.gz";
    case 'y':
      return ".npy";
    case 'q':
      return ".npz";
    case 'h':
      return ".h5";
    default:
      return ".json";
  }
}

/// A file of this process, gone at the end of its scope.
class ScratchFile {
 public:
  ScratchFile(const std::string& content, const std::string& ending)
      : path_((std::filesystem::temp_directory_path() /
               ("wscvt_fuzz_" + std::to_string(getpid()) + ending))
                  .string()) {
    std::ofstream(path_, std::ios::binary) << content;
  }
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;
  ~ScratchFile() { std::remove(path_.c_str()); }

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace

// NOLINTNEXTLINE(readability-identifier-naming): the name that libFuzzer calls
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  const std::string content(reinterpret_cast<const char*>(data) + 2, size - 2);
  const ScratchFile file(content, ending_for(static_cast<char>(data[0])));
  VolumeChoice choice;
  if ((data[1] & 1U) != 0) choice.channel = 2;
  if ((data[1] & 2U) != 0) choice.frame = 2;
  if ((data[1] & 4U) != 0) choice.array = "labels";
  try {
    const std::unique_ptr<LabelVolume> volume = open_volume(file.path(), choice);
    const VoxelCounts& counts = volume->geometry().counts;
    for (const std::int32_t count : counts) promise(count > 1, "a volume of no extent");
    promise(volume->geometry().voxel_volume() > 0.0, "voxels of no volume");
    // A file of some bytes may unpack to much; its beginning, twice.
    const std::int64_t rows = std::min<std::int64_t>(2000, std::int64_t{counts[1]} * counts[2]);
    std::uint64_t sums[2] = {0, 0};
    for (std::uint64_t& sum : sums) {
      volume->rewind();
      for (std::int64_t row = 0; row < rows; ++row) {
        const std::vector<Label>& labels = volume->next_row();
        promise(labels.size() == static_cast<std::size_t>(counts[0]), "a row of another length");
        for (const Label label : labels) sum = sum * 31 + label;
      }
    }
    promise(sums[0] == sums[1], "a volume reads otherwise the second time");
  } catch (const Error& error) {
    promise(error.code() == ErrorCode::InputOutput, error.what());
    promise(std::string(error.what()).size() > 20, "no sentence");
  }
  return 0;
}
