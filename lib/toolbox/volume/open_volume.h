// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "toolbox/volume/label_volume.h"
#include "toolbox/volume/volume_choice.h"

namespace wscvt {

/// Returns whether a name is a volume's: it has an ending of the formats below, or is a folder with
/// slices and no meshes; or it is DICOM, Zarr, AmiraMesh or a raw file, which open_volume refuses
/// with the way to one of these formats.
bool is_volume(const std::string& path);

/// Throws Error for a volume that exists, where a mesh or a table is needed: InvalidInput with
/// `ways`, sentences that say what to do with a volume, or InputOutput with the way to a format
/// that is read.
void refuse_volume_input(const std::string& path, const std::string& ways);

/// Opens a volume of labels: whole numbers of 1 to 64 bits, or floats that are whole. The ending
/// gives the format; lib/doc/files.md has the table of what is read of each. `choice` selects a
/// part of the file, and may replace its voxel size.
///
/// Throws Error: InputOutput if the file cannot be read, is cut short, has an unknown form, or
/// contains more than one volume and none was chosen; InvalidInput for sizes that are not above 0.
std::unique_ptr<LabelVolume> open_volume(const std::string& path, const VolumeChoice& choice = {});

/// Numbers in memory, the last dimension fastest, as in a .npy file.
struct VolumeArray {
  const void* numbers = nullptr;     ///< must outlive the volume
  std::string type;                  ///< NumPy's name: "<u2", "|b1", ">f8"
  std::vector<std::int64_t> counts;  ///< the slowest first
};

/// Opens an array exactly as open_volume opens a .npy file of it. `name` is the array's, for
/// messages. Throws as open_volume, but always Error(InvalidInput).
std::unique_ptr<LabelVolume> open_array(const VolumeArray& array, const VolumeChoice& choice,
                                        const std::string& name);

}  // namespace wscvt
