// SPDX-License-Identifier: GPL-3.0-or-later
#ifdef WSCVT_HAS_TIFF
#include <algorithm>
#include <array>
#include <cmath>

#include "toolbox/volume/tiff_pages.h"
#include "toolbox/volume/volume_formats.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/table_heading.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

std::optional<Vector3> voxel_of_resolution(const TiffFile& file) {
  float across = 0.0F;
  float down = 0.0F;
  std::uint16_t unit = RESUNIT_INCH;
  if (TIFFGetField(file.get(), TIFFTAG_XRESOLUTION, &across) == 0 ||
      TIFFGetField(file.get(), TIFFTAG_YRESOLUTION, &down) == 0 || !(across > 0.0F) ||
      !(down > 0.0F)) {
    return std::nullopt;
  }
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_RESOLUTIONUNIT, &unit);
  // Stored as fractions, which libtiff returns as float; ImageJ's have six digits.
  Vector3 size(1.0 / static_cast<double>(across), 1.0 / static_cast<double>(down), 0.0);
  if (unit == RESUNIT_INCH) size *= 2.54;
  return size;
}

namespace {

/// Whether a resolution is a usual one of screens and printers, in dots per inch, and the distance
/// of slices does not fit it: then a program wrote it that knew no size of voxels.
bool is_of_a_screen(const Vector3& size_cm, const Vector3& size) {
  constexpr std::array<double, 14> usual = {72,  96,  100, 120, 144, 150, 180,
                                            200, 240, 300, 360, 400, 600, 1200};
  const double dots = 2.54 / size_cm.x();
  const bool is_usual = std::any_of(usual.begin(), usual.end(),
                                    [&](double dpi) { return std::abs(dots - dpi) < 2e-3 * dpi; });
  constexpr double far = 5.0;
  return is_usual && (size.z() > far * size.x() || size.x() > far * size.z());
}

/// Sets the directions of the axes by the orientation tag: where the first row and the first column
/// lie (TIFF 6.0, Orientation).
void set_lattice_turned(VolumeGeometry& geometry, const Vector3& size, int orientation,
                        const VolumeChoice& choice, const std::string& path) {
  const bool is_transposed = orientation >= ORIENTATION_LEFTTOP;
  if (is_transposed) geometry.order = {1, 0, 2};
  Eigen::Matrix3d axes = Eigen::Matrix3d::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) {
    const Eigen::Index axis = geometry.order[static_cast<std::size_t>(k)];
    axes(axis, k) = size[axis];
  }
  set_lattice(geometry, axes, 0.5 * size, choice, path);
  const bool is_from_right =
      orientation == ORIENTATION_TOPRIGHT || orientation == ORIENTATION_BOTRIGHT ||
      orientation == ORIENTATION_RIGHTTOP || orientation == ORIENTATION_RIGHTBOT;
  const bool is_from_below =
      orientation == ORIENTATION_BOTRIGHT || orientation == ORIENTATION_BOTLEFT ||
      orientation == ORIENTATION_RIGHTBOT || orientation == ORIENTATION_LEFTBOT;
  for (const Eigen::Index axis : {Eigen::Index{0}, Eigen::Index{1}}) {
    if (!(axis == 0 ? is_from_right : is_from_below)) continue;
    const Eigen::Index k = geometry.order[static_cast<std::size_t>(axis)];  // its own inverse
    geometry.corner += geometry.axes.col(k) * geometry.counts[static_cast<std::size_t>(k)];
    geometry.axes.col(k) = -geometry.axes.col(k);
  }
}

/// Whether the size of voxels is the page's: no text, or one that gives only the shape.
bool is_by_pages(const TiffLayout& layout) {
  return layout.writer.empty() || layout.writer == "tifffile";
}

/// Takes the page's resolution in its own unit where the text's unit would make the voxels flat by
/// the ratio of both: some programs note um, but a resolution per cm. tifffile writes what its
/// caller gave, per inch if nothing else was said: the unit that fits the distance of slices is
/// taken. `per_cm`: the page's lengths.
void take_unit_of_page(const Vector3& per_cm, TiffLayout& layout, Vector3& size) {
  const double unit = nanometres(layout.unit);
  if (unit == 0.0) return;
  constexpr double cm = 1e7;  // nanometres
  constexpr double flat = 100.0;
  constexpr double far = 10.0;
  const Vector3 taken = cm / unit * per_cm;
  const auto ratio = [&](double across) { return std::max(size.z() / across, across / size.z()); };
  const bool is_taken = layout.writer == "tifffile"
                            ? ratio(taken.x()) < ratio(size.x())
                            : size.z() >= flat * size.x() && ratio(taken.x()) < far;
  if (!is_taken) return;
  size.head(2) = taken.head(2);
  layout.notes.push_back(
      "The resolution was taken per cm or inch, as the TIFF says: in " + layout.unit + ", as " +
      layout.writer +
      " notes it, the voxels would be flatter. If this is wrong, give the size by " +
      mention("voxel-size", "X,Y,Z") + ".");
}
}  // namespace

void set_lattice_of_tiff(VolumeGeometry& geometry, const TiffFile& file, const TiffPage& page,
                         TiffLayout& layout, const VolumeChoice& choice) {
  const std::optional<Vector3> resolution = voxel_of_resolution(file);
  Vector3 size = layout.voxel_size;
  std::uint16_t unit = RESUNIT_INCH;
  TIFFGetFieldDefaulted(file.get(), TIFFTAG_RESOLUTIONUNIT, &unit);
  geometry.size_source = layout.writer + "'s text";
  if (!layout.other_unit.empty() && !choice.voxel_size) {
    refuse_volume(file.path(), "has axes in " + in_quotes(layout.unit) + " and in " +
                                   in_quotes(layout.other_unit) +
                                   ". Give the size in one unit by " + mention("voxel-size") + ".");
  }
  // Screens and printers have up to 1200 dots per inch, 0.021 mm; a finer one is an instrument's.
  constexpr double finest_dot_cm = 0.999 * 2.54 / 1200.0;
  const bool is_fine = resolution && unit != RESUNIT_NONE && resolution->x() < finest_dot_cm &&
                       resolution->y() < finest_dot_cm;
  const bool is_by_imagej = layout.writer == "ImageJ";
  // Their texts have the size along z only. OME's has all.
  if (size.z() > 0.0 && resolution &&
      (is_by_imagej || (is_by_pages(layout) && !(is_fine && layout.unit.empty())))) {
    // In ImageJ's unit, not the page's.
    size.x() = unit == RESUNIT_INCH ? resolution->x() / 2.54 : resolution->x();
    size.y() = unit == RESUNIT_INCH ? resolution->y() / 2.54 : resolution->y();
    if (unit != RESUNIT_NONE) take_unit_of_page(*resolution, layout, size);
    const double cm = layout.unit == "inch" ? 2.54 : layout.unit == "cm" ? 1.0 : 0.1;
    const bool has_coarse_unit = cm >= 1.0 || layout.unit == "mm";
    if (has_coarse_unit && is_of_a_screen(cm * size, size)) {
      layout.notes.push_back(layout.writer + " noted voxels of " + format_number(size.x(), 4) +
                             " x " + format_number(size.y(), 4) + " x " +
                             format_number(size.z(), 4) + " " + layout.unit + ", " +
                             format_number(2.54 / (cm * size.x())) +
                             " per inch: the resolution of a screen, not of a scan. It was not "
                             "used.");
      size = Vector3::Zero();
    }
    if (layout.unit.empty() && size == Vector3::Ones()) size = Vector3::Zero();  // of no scan
    if (layout.unit.empty() && size.minCoeff() > 0.0) {
      layout.notes.push_back(layout.writer +
                             "'s text has a distance of slices, but no unit: the unit is unknown. "
                             "Give it by " +
                             mention("voxel-size", "X,Y,Z") + ".");
    }
  } else if (is_by_pages(layout) && is_fine) {
    size = 10.0 * Vector3(resolution->x(), resolution->y(), resolution->x());
    layout.unit = "mm";
    geometry.size_source = "the TIFF's resolution";
    layout.notes.push_back(
        "Voxel size from the TIFF's resolution, along z as along x: " + format_number(size.x()) +
        " mm. Give another by " + mention("voxel-size", "X,Y,Z") + ".");
  } else if (layout.writer != "OME") {
    size = Vector3::Zero();
  }
  if (!layout.differing.empty()) {
    size = Vector3::Zero();
    layout.notes = {in_quotes(layout.differing) +
                    " says another size of voxels than the slices before it. None was used."};
  }
  geometry.has_size = size.minCoeff() > 0.0;
  if (!geometry.has_size) {
    size = Vector3::Ones();
  } else {
    geometry.unit = layout.unit;
  }
  set_lattice_turned(geometry, size, page.orientation, choice, file.path());
  if (page.orientation != ORIENTATION_TOPLEFT) {
    layout.more_notes.push_back("The pages were turned as their orientation tag, " +
                                std::to_string(page.orientation) + ", says.");
  }
}
}  // namespace wscvt

#endif
