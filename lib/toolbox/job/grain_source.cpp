// SPDX-License-Identifier: GPL-3.0-or-later
#include "toolbox/job/grain_source.h"

#include <algorithm>

#include "wscvt/base/error.h"
#include "wscvt/mesh_files/mesh_io.h"

namespace wscvt {

MeshGrains::MeshGrains(std::string path, const Execution& execution) : path_(std::move(path)) {
  try {
    MeshFile file = read_mesh_file(path_, execution);
    bodies_ = split_bodies(std::move(file.mesh), std::move(file.named_faces), execution);
  } catch (const MachineRefused&) {
    throw;
  } catch (const Error& error) {
    if (error.code() == ErrorCode::Cancelled) throw;
    refused_ = error.sentence();
  }
  if (bodies_.list.size() < 2) bodies_ = MeshBodies();
}

std::string MeshGrains::name(std::size_t grain) const {
  return is_file() ? path_ : path_ + "/" + std::to_string(grain + 1);
}

void MeshGrains::want(const std::vector<std::size_t>& grains) {
  for (std::size_t k = 0; k < bodies_.list.size(); ++k) {
    if (!std::binary_search(grains.begin(), grains.end(), k)) bodies_.list[k].mesh = {};
  }
}

GrainScan MeshGrains::read(std::size_t grain, bool with_pictures, const Execution& execution) {
  if (!refused_.empty()) refuse(refused_);
  if (!is_file()) return {bodies_.list[grain].mesh};
  MeshFile file = read_mesh_file(path_, execution);
  if (with_pictures) read_pictures(file, path_, execution);
  return {std::move(file.mesh), std::move(file.attributes), std::move(file.warnings)};
}

NamedGrains::NamedGrains(std::string prefix, std::size_t count, std::size_t digits, Read read)
    : prefix_(std::move(prefix)),
      count_(count),
      digits_(std::max(digits, std::to_string(count).size())),
      read_(std::move(read)) {}

std::string NamedGrains::name(std::size_t grain) const {
  const std::string number = std::to_string(grain + 1);
  return prefix_ + std::string(digits_ - number.size(), '0') + number;
}

GrainScan NamedGrains::read(std::size_t grain, bool /*with_pictures*/, const Execution& execution) {
  GrainScan scan;
  if (read_) scan.mesh = read_(grain, execution);
  scan.place = grain;
  return scan;
}

void JoinedGrains::add(std::unique_ptr<GrainSource> source) {
  const std::string own = source->unit();
  const auto other = std::find_if(sources_.begin(), sources_.end(), [&](const auto& one) {
    return !own.empty() && !one->unit().empty() && one->unit() != own;
  });
  if (other != sources_.end()) {
    refuse("Lengths of \"" + (*other)->file(0) + "\" are in " + (*other)->unit() + ", and of \"" +
           source->file(0) + "\" in " + own +
           ". One table has one unit: use one call for each, or convert one.");
  }
  for (std::size_t grain = 0; grain < source->size(); ++grain) {
    if (is_of(shard_, source->name(grain))) places_.push_back({sources_.size(), grain});
  }
  sources_.push_back(std::move(source));
}

std::string JoinedGrains::name(std::size_t grain) const {
  return sources_[places_[grain].source]->name(places_[grain].grain);
}

std::string JoinedGrains::file(std::size_t grain) const {
  return sources_[places_[grain].source]->file(places_[grain].grain);
}

void JoinedGrains::want(const std::vector<std::size_t>& grains) {
  std::vector<std::vector<std::size_t>> wanted(sources_.size());
  for (const std::size_t grain : grains) {
    wanted[places_[grain].source].push_back(places_[grain].grain);
  }
  for (std::size_t k = 0; k < sources_.size(); ++k) sources_[k]->want(wanted[k]);
}

GrainScan JoinedGrains::read(std::size_t grain, bool with_pictures, const Execution& execution) {
  const Place& place = places_[grain];
  return sources_[place.source]->read(place.grain, with_pictures, execution);
}

std::string JoinedGrains::census(const MadeOf& made_of) const {
  std::string joined;
  for (const auto& source : sources_) {
    const std::string table = source->census(made_of);
    // One header for all.
    joined += joined.empty() || table.empty() ? table : table.substr(table.find("\r\n") + 2);
  }
  return joined;
}

std::string JoinedGrains::unit() const {
  for (const auto& source : sources_) {
    std::string known = source->unit();
    if (!known.empty()) return known;
  }
  return {};
}

double JoinedGrains::left_out() const {
  double largest = 0.0;
  for (const auto& source : sources_) largest = std::max(largest, source->left_out());
  return largest;
}

std::size_t JoinedGrains::volumes() const {
  std::size_t count = 0;
  for (const auto& source : sources_) count += source->volumes();
  return count;
}

}  // namespace wscvt
