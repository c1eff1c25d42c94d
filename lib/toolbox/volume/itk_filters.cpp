// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/volume/itk_filters.h"

#include "wscvt/base/error.h"

#ifdef WSCVT_HAS_ITK
#include <itkCommand.h>
#include <itkGrayscaleFillholeImageFilter.h>
#include <itkImage.h>
#include <itkMedianImageFilter.h>
#include <itkMorphologicalWatershedImageFilter.h>
#include <itkMultiThreaderBase.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <new>
#include <string>
#endif

namespace wscvt {

#ifndef WSCVT_HAS_ITK

void require_filters() {
  refuse(
      "This program was built without ITK, which separates grains. Install libinsighttoolkit5-dev, "
      "and build it again.");
}

std::vector<std::uint16_t> median_of(const std::vector<std::uint16_t>&, const FilterCounts&,
                                     const Execution&) {
  require_filters();
  return {};
}

void fill_holes(std::vector<std::uint8_t>&, const FilterCounts&, const Execution&) {
  require_filters();
}

std::vector<float> distances_to_zero(const std::vector<std::uint8_t>&, const FilterCounts&,
                                     const std::array<double, 3>&, const Execution&) {
  require_filters();
  return {};
}

Basins basins_of(const std::vector<std::uint8_t>&, const FilterCounts&,
                 const std::array<double, 3>&, double, const Execution&) {
  require_filters();
  return {};
}

#else

namespace {

template <class Value>
using VoxelImage = itk::Image<Value, 3>;

/// Returns the voxels as an image of ITK that refers to them.
template <class Value>
typename VoxelImage<Value>::Pointer image_of(const Value* voxels, const FilterCounts& counts,
                                             const std::array<double, 3>& spacing = {1.0, 1.0,
                                                                                     1.0}) {
  typename VoxelImage<Value>::SizeType size;
  typename VoxelImage<Value>::SpacingType lengths;
  for (unsigned axis = 0; axis < 3; ++axis) {
    size[axis] = static_cast<itk::SizeValueType>(counts[axis]);
    lengths[axis] = spacing[axis];
  }
  auto image = VoxelImage<Value>::New();
  image->SetRegions(size);
  image->SetSpacing(lengths);
  // No filter here works in place, so nothing is written.
  image->GetPixelContainer()->SetImportPointer(const_cast<Value*>(voxels),
                                               size[0] * size[1] * size[2], false);
  return image;
}

/// Forwards a filter's progress. Filters also report from destructors, which must not throw. So a
/// cancel is stored, and the filter is asked to end.
class Progress : public itk::Command {
 public:
  using Self = Progress;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self)  // a function, with its own braces

      void pass_to(const Execution& execution, const std::string& stage) {
    execution_ = execution;
    stage_ = stage;
  }
  void Execute(itk::Object* caller, const itk::EventObject&) override {
    auto* const filter = dynamic_cast<itk::ProcessObject*>(caller);
    if (filter == nullptr || cancel_) return;
    try {
      execution_.report(std::min(1.0F, filter->GetProgress()), stage_);
    } catch (const Error&) {
      cancel_ = std::current_exception();
      filter->AbortGenerateDataOn();
    }
  }
  void Execute(const itk::Object*, const itk::EventObject&) override {}

  void throw_cancel() const {
    if (cancel_) std::rethrow_exception(cancel_);
  }

 private:
  Execution execution_{1};
  std::string stage_;
  std::exception_ptr cancel_;
};

/// Runs a filter on this thread only. Execution provides the threads and continues with fewer if
/// the machine refuses some. `execution` is null on other threads than the caller's.
template <class Filter>
void run(Filter& filter, const Execution* execution, const std::string& stage) {
  auto progress = Progress::New();
  try {
    itk::Object::SetGlobalWarningDisplay(false);
    if (execution != nullptr) {
      progress->pass_to(*execution, stage);
      filter.AddObserver(itk::ProgressEvent(), progress);
    }
    filter.Update();
  } catch (const itk::MemoryAllocationError&) {
    throw std::bad_alloc();
  } catch (const itk::ExceptionObject& error) {
    progress->throw_cancel();
    throw Error(ErrorCode::NumericalFailure,
                std::string("ITK could not separate the grains: ") + error.GetDescription());
  }
  progress->throw_cancel();
}

/// Call this before making a filter, so that its inner filters follow it too.
void use_one_thread() {
  itk::MultiThreaderBase::SetGlobalDefaultThreader(itk::MultiThreaderBase::ThreaderEnum::Platform);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(1);
}

}  // namespace

void require_filters() {}

std::vector<std::uint16_t> median_of(const std::vector<std::uint16_t>& grey,
                                     const FilterCounts& counts, const Execution& execution) {
  use_one_thread();
  const auto slice = static_cast<std::size_t>(counts[0]) * static_cast<std::size_t>(counts[1]);
  const auto slices = static_cast<std::size_t>(counts[2]);
  std::vector<std::uint16_t> result(grey.size());
  // A block of slices with its neighbouring slices is an image of its own.
  const auto smooth = [&](std::size_t begin, std::size_t end) {
    const std::size_t first = begin - std::min<std::size_t>(begin, 1);
    const std::size_t last = std::min(slices, end + 1);
    const FilterCounts part = {counts[0], counts[1], static_cast<std::int32_t>(last - first)};
    using Image = VoxelImage<std::uint16_t>;
    auto filter = itk::MedianImageFilter<Image, Image>::New();
    filter->SetInput(image_of(grey.data() + first * slice, part));
    filter->UpdateOutputInformation();
    Image::RegionType wanted = filter->GetOutput()->GetLargestPossibleRegion();
    wanted.SetIndex(2, static_cast<itk::IndexValueType>(begin - first));
    wanted.SetSize(2, end - begin);
    filter->GetOutput()->SetRequestedRegion(wanted);
    run(*filter, nullptr, "");
    std::copy_n(filter->GetOutput()->GetBufferPointer(), (end - begin) * slice,
                result.begin() + static_cast<std::ptrdiff_t>(begin * slice));
  };
  constexpr std::size_t block = 4;
  constexpr std::size_t blocks_at_once = 16;
  for (std::size_t begin = 0; begin < slices; begin += block * blocks_at_once) {
    execution.report(static_cast<double>(begin) / static_cast<double>(slices),
                     "Smoothing grey values");
    const std::size_t count = std::min(slices - begin, block * blocks_at_once);
    execution.parallel_for(count, block, [&](std::size_t first, std::size_t last) {
      smooth(begin + first, begin + last);
    });
  }
  return result;
}

void fill_holes(std::vector<std::uint8_t>& mask, const FilterCounts& counts,
                const Execution& execution) {
  use_one_thread();
  auto filter =
      itk::GrayscaleFillholeImageFilter<VoxelImage<std::uint8_t>, VoxelImage<std::uint8_t>>::New();
  filter->SetInput(image_of(mask.data(), counts));
  filter->SetFullyConnected(false);
  run(*filter, &execution, "Filling holes");
  std::copy_n(filter->GetOutput()->GetBufferPointer(), mask.size(), mask.begin());
}

std::vector<float> distances_to_zero(const std::vector<std::uint8_t>& mask,
                                     const FilterCounts& counts,
                                     const std::array<double, 3>& spacing,
                                     const Execution& execution) {
  use_one_thread();
  auto filter =
      itk::SignedMaurerDistanceMapImageFilter<VoxelImage<std::uint8_t>, VoxelImage<float>>::New();
  filter->SetInput(image_of(mask.data(), counts, spacing));
  filter->SetBackgroundValue(1);  // distances are measured from voxels of 0
  filter->SetUseImageSpacing(true);
  filter->SetSquaredDistance(false);
  filter->SetInsideIsPositive(false);
  run(*filter, &execution, "Measuring distances");
  const float* const distances = filter->GetOutput()->GetBufferPointer();
  return {distances, distances + mask.size()};
}

Basins basins_of(const std::vector<std::uint8_t>& mask, const FilterCounts& counts,
                 const std::array<double, 3>& spacing, double depth, const Execution& execution) {
  // Without material or without void there is no distance.
  const auto one_basin = [&] {
    return Basins{{mask.begin(), mask.end()}, std::vector<std::uint16_t>(mask.size(), 0), 0.0};
  };
  if (std::find(mask.begin(), mask.end(), 0) == mask.end()) return one_basin();
  if (std::find(mask.begin(), mask.end(), 1) == mask.end()) return one_basin();
  use_one_thread();
  // Depths below the highest maximum, in steps of a small fraction of `depth`. They fit in 16 bits,
  // and ITK's watershed copies them several times.
  double step = depth / 100.0;
  std::vector<std::uint16_t> heights(mask.size(), std::numeric_limits<std::uint16_t>::max());
  {
    const std::vector<float> distances = distances_to_zero(mask, counts, spacing, execution);
    const double largest = *std::max_element(distances.begin(), distances.end());
    step = std::max(step, largest / std::numeric_limits<std::uint16_t>::max());
    for (std::size_t k = 0; k < mask.size(); ++k) {
      if (mask[k] != 0) heights[k] -= static_cast<std::uint16_t>(distances[k] / step);
    }
  }
  using Heights = VoxelImage<std::uint16_t>;
  auto filter = itk::MorphologicalWatershedImageFilter<Heights, VoxelImage<std::uint32_t>>::New();
  filter->SetInput(image_of(heights.data(), counts));
  filter->SetLevel(static_cast<std::uint16_t>(
      std::clamp(depth / step, 1.0, double{std::numeric_limits<std::uint16_t>::max()})));
  filter->SetMarkWatershedLine(false);
  filter->SetFullyConnected(false);
  run(*filter, &execution, "Separating grains");
  const std::uint32_t* const found = filter->GetOutput()->GetBufferPointer();
  Basins basins;
  basins.labels.resize(mask.size());
  for (std::size_t k = 0; k < mask.size(); ++k) basins.labels[k] = mask[k] == 0 ? 0 : found[k];
  for (std::uint16_t& height : heights) height = std::numeric_limits<std::uint16_t>::max() - height;
  basins.distances = std::move(heights);
  basins.step = step;
  return basins;
}

#endif

}  // namespace wscvt
