// SPDX-License-Identifier: GPL-3.0-or-later
#ifdef WSCVT_HAS_TIFF
#include "toolbox/volume/tiff_pages.h"

#include <algorithm>
#include <boost/endian/conversion.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <new>
#include <utility>

#include "toolbox/volume/volume_formats.h"
#include "wscvt/base/text_format.h"
#include "wscvt/mesh_files/text_fields.h"

namespace wscvt {

TiffFile::TiffFile(const std::string& path) : path_(path) {
  // Refuses strips for which a damaged file claims more than they could unpack to.
  most_ = std::min<std::uint64_t>(1U << 30, 1100 * file_size(path) + (1 << 20));
  TIFFOpenOptions* const options = TIFFOpenOptionsAlloc();
  if (options == nullptr) throw std::bad_alloc();
  TIFFOpenOptionsSetMaxSingleMemAlloc(options, static_cast<tmsize_t>(most_));
  TIFFOpenOptionsSetErrorHandlerExtR(options, note_error, this);
  const auto pass_over = [](TIFF*, void*, const char*, const char*, va_list) { return 1; };
  TIFFOpenOptionsSetWarningHandlerExtR(options, pass_over, nullptr);
  // Not mapped to memory: the process would be killed where the file cannot be read.
  tiff_ = TIFFOpenExt(path.c_str(), "rm", options);
  TIFFOpenOptionsFree(options);
  if (tiff_ == nullptr) fail("is not a TIFF file");
}

std::int64_t TiffFile::pages() const {
  const std::int64_t count = TIFFNumberOfDirectories(tiff_);
  if (!said_.empty()) fail("has lost pages");
  return count;
}

std::string TiffFile::description() const {
  char* text = nullptr;
  if (TIFFGetField(tiff_, TIFFTAG_IMAGEDESCRIPTION, &text) == 0 || text == nullptr) return "";
  return text;
}

void TiffFile::fail(const std::string& what) const {
  refuse_volume(path_,
                what + (said_.empty() ? "" : " (" + shown(said_) + ")") + ". Export it again.");
}

int TiffFile::note_error(TIFF*, void* self, const char*, const char* format, va_list arguments) {
  char text[256];
  std::vsnprintf(text, sizeof text, format, arguments);
  auto& said = static_cast<TiffFile*>(self)->said_;
  if (said.empty()) said = text;
  return 1;
}

TiffPage page_of(const TiffFile& file) {
  TIFF* const tiff = file.get();
  TiffPage page;
  std::uint16_t bits = 1;
  std::uint16_t samples = 1;
  std::uint16_t format = SAMPLEFORMAT_UINT;
  std::uint16_t planes = PLANARCONFIG_CONTIG;
  std::uint16_t compression = COMPRESSION_NONE;
  std::uint16_t photometric = PHOTOMETRIC_MINISBLACK;
  std::uint32_t depth = 1;
  if (TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &page.width) == 0 ||
      TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &page.height) == 0) {
    file.fail("does not say how large its pages are");
  }
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &samples);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &format);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &planes);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &compression);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_IMAGEDEPTH, &depth);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &photometric);
  if (compression == COMPRESSION_JPEG || compression == COMPRESSION_OJPEG) {
    file.fail("is packed by JPEG, which changes numbers, so they are not labels any more");
  }
  if (depth != 1) {
    refuse_volume(file.path(),
                  "has pages of " + std::to_string(depth) +
                      " slices. Save one slice a page, in Python by import tifffile; "
                      "tifffile.imwrite(\"pages.tif\", tifffile.imread(" +
                      in_quotes(std::filesystem::path(file.path()).filename().string()) + "))");
  }
  const bool is_float = format == SAMPLEFORMAT_IEEEFP && (bits == 32 || bits == 64);
  const bool has_sign = format == SAMPLEFORMAT_INT;
  const bool is_whole = (format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_VOID || has_sign) &&
                        (bits == 8 || bits == 16 || bits == 32 || bits == 64);
  const bool is_small =
      format == SAMPLEFORMAT_UINT && samples == 1 && (bits == 1 || bits == 2 || bits == 4);
  if (samples < 1 || (!is_whole && !is_small && !is_float)) {
    refuse_volume(file.path(), "has numbers of " + std::to_string(bits) +
                                   " bits of a kind that is not read. Save whole numbers of 8, "
                                   "16, 32 or 64 bits, or grey values of 32 bits.");
  }
  page.bits = bits;
  page.type = {std::max(1, bits / 8), has_sign || is_float, is_float,
               boost::endian::order::native == boost::endian::order::big};
  page.samples = samples;
  page.is_planar = planes == PLANARCONFIG_SEPARATE && samples > 1;
  page.shows_0_as_white = photometric == PHOTOMETRIC_MINISWHITE;
  page.shows_colours = photometric == PHOTOMETRIC_RGB && samples > 2;
  std::uint16_t extra_samples = 0;
  std::uint16_t* kinds = nullptr;
  TIFFGetField(tiff, TIFFTAG_EXTRASAMPLES, &extra_samples, &kinds);
  page.has_alpha = samples == 2 && !page.is_planar && extra_samples == 1 &&
                   (kinds[0] == EXTRASAMPLE_ASSOCALPHA || kinds[0] == EXTRASAMPLE_UNASSALPHA);
  std::uint16_t orientation = ORIENTATION_TOPLEFT;
  TIFFGetField(tiff, TIFFTAG_ORIENTATION, &orientation);
  page.orientation = orientation >= 1 && orientation <= 8 ? orientation : ORIENTATION_TOPLEFT;
  return page;
}

namespace {

/// What tells slices from previews.
struct PageForm {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint16_t bits = 1;
  std::uint16_t samples = 1;
  std::uint32_t marks = 0;  ///< bits of NewSubfileType

  bool is_like(const PageForm& other) const {
    return width == other.width && height == other.height && bits == other.bits &&
           samples == other.samples;
  }
  bool is_marked() const { return (marks & (FILETYPE_REDUCEDIMAGE | FILETYPE_MASK)) != 0; }

  /// Whether it is smaller than `full` by one factor along both axes, up to rounding.
  bool is_scaled(const PageForm& full) const {
    const double factor = static_cast<double>(full.width) / width;
    return factor > 1.5 && std::abs(full.height - factor * height) <= factor;
  }
};

/// Reads the forms of all pages, and adds the reduced images behind pages (SubIFDs) to `left_out`.
std::vector<PageForm> page_forms(const TiffFile& file, std::int64_t& left_out) {
  std::vector<PageForm> forms;
  const std::int64_t count = file.pages();
  if (TIFFSetDirectory(file.get(), 0) == 0) file.fail("has lost pages");
  for (std::int64_t k = 0; k < count; ++k) {
    if (k > 0 && TIFFReadDirectory(file.get()) == 0) file.fail("has lost pages");
    PageForm form;
    TIFFGetField(file.get(), TIFFTAG_IMAGEWIDTH, &form.width);
    TIFFGetField(file.get(), TIFFTAG_IMAGELENGTH, &form.height);
    TIFFGetFieldDefaulted(file.get(), TIFFTAG_BITSPERSAMPLE, &form.bits);
    TIFFGetFieldDefaulted(file.get(), TIFFTAG_SAMPLESPERPIXEL, &form.samples);
    TIFFGetFieldDefaulted(file.get(), TIFFTAG_SUBFILETYPE, &form.marks);
    std::uint16_t behind = 0;
    std::uint64_t* places = nullptr;
    if (TIFFGetField(file.get(), TIFFTAG_SUBIFD, &behind, &places) != 0) left_out += behind;
    forms.push_back(form);
  }
  return forms;
}

/// Returns the form of which the file has the most voxels in unmarked pages; the first page's if
/// all are marked.
PageForm main_form(const std::vector<PageForm>& forms) {
  std::vector<std::pair<PageForm, double>> kinds;
  for (const PageForm& form : forms) {
    if (form.is_marked()) continue;
    const auto found = std::find_if(kinds.begin(), kinds.end(),
                                    [&](const auto& kind) { return kind.first.is_like(form); });
    const double voxels = static_cast<double>(form.width) * form.height;
    if (found != kinds.end()) {
      found->second += voxels;
    } else {
      kinds.emplace_back(form, voxels);
    }
  }
  if (kinds.empty()) return forms.front();
  return std::max_element(kinds.begin(), kinds.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}
}  // namespace

TiffPageList list_pages(const TiffFile& file) {
  TiffPageList list;
  const std::vector<PageForm> forms = page_forms(file, list.left_out);
  TIFFSetDirectory(file.get(), 0);
  list.text = file.description();
  const PageForm main = main_form(forms);
  const auto is_slice = [&](const PageForm& form) {
    return form.is_like(main) && ((form.marks & FILETYPE_MASK) == 0 || main.is_marked());
  };
  const auto first = std::find_if(forms.begin(), forms.end(), is_slice);
  const auto last = std::find_if(forms.rbegin(), forms.rend(), is_slice).base();
  const auto slices = std::count_if(first, last, is_slice);
  const auto outside = static_cast<std::ptrdiff_t>(forms.size()) - (last - first);
  for (auto form = forms.begin(); form != forms.end(); ++form) {
    const bool is_smaller = form->width < main.width && form->height < main.height;
    const bool is_outside = form < first || form >= last;
    constexpr std::ptrdiff_t most_previews = 2;
    const bool is_preview =
        is_smaller && is_outside &&
        ((outside <= most_previews && outside < slices) || (form >= last && form->is_scaled(main)));
    if (!is_slice(*form) && (form->is_marked() || is_preview)) {
      ++list.left_out;
      continue;
    }
    if (form->is_marked() && !main.is_marked()) ++list.marked;
    list.slices.push_back(static_cast<std::uint32_t>(form - forms.begin()));
  }
  TIFFSetDirectory(file.get(), static_cast<tdir_t>(list.slices.front()));
  const std::string text = file.description();
  if (!text.empty()) list.text = text;
  return list;
}
}  // namespace wscvt

#endif
