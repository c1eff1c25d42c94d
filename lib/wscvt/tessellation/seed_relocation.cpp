// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/tessellation/seed_relocation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "wscvt/base/half_edges.h"
#include "wscvt/base/triangle_geometry.h"

namespace wscvt {

namespace {

/// Means over a ring and its middle, one after the other: a reach of some three rings.
constexpr int smoothings = 8;

/// Shares of cells on rough scans and thin rims lie between 0.9 and 1.1, in a jam from 0.2 to 0.6.
constexpr double crowded_share = 0.9;

/// Every seed so that the parts of seeds before it, from half a one on, add up to the next whole
/// one: as many as all parts add up to, and spread like them, since seeds are numbered as levels
/// and subdivisions made them, all over the surface.
std::vector<std::int32_t> spread_by(const std::vector<double>& parts) {
  std::vector<std::int32_t> chosen;
  double sum = 0.5;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    sum += parts[i];
    if (sum < 1.0) continue;
    sum -= 1.0;
    chosen.push_back(static_cast<std::int32_t>(i));
  }
  return chosen;
}

/// Calls visit(h) for every half-edge that starts at a seed, counter-clockwise.
template <class Visit>
void visit_outgoing_of(const SphereTriangulation& triangulation, std::int32_t seed,
                       const Visit& visit) {
  visit_outgoing(triangulation.opposite(), triangulation.first_half_edge()[seed], visit);
}

double too_many(double share) { return share < crowded_share ? 1.0 - share : 0.0; }

/// What takes the place of triangles on the sphere.
struct Patch {
  std::vector<std::int32_t> slots;  ///< triangles that go
  std::vector<Triangle> triangles;
};

class Relocation {
 public:
  Relocation(const SphereSurface& surface, SpaceTessellation& tessellation)
      : surface_(surface),
        seeds_(tessellation.seeds),
        positions_(tessellation.positions),
        triangulation_(tessellation.triangulation) {}

  /// Takes `seed` to the longest edge about `goal`; false, and nothing changed, where a triangle
  /// would not stand.
  bool take(std::int32_t seed, std::int32_t goal) {
    Patch patch;
    if (!leave(seed, patch)) return false;
    const std::int32_t edge = longest_edge(goal);
    const std::int32_t opposite = triangulation_.opposite()[edge];
    for (const std::int32_t h : {edge, opposite}) {
      if (std::find(patch.slots.begin(), patch.slots.end(), h / 3) != patch.slots.end()) {
        return false;
      }
      patch.slots.push_back(h / 3);
    }
    const Vector3 before = seeds_[seed];
    const std::int32_t a = triangulation_.origin(edge);
    const std::int32_t b = triangulation_.origin(opposite);
    seeds_[seed] = halfway_seed(surface_, seeds_[a], seeds_[b]);
    for (const std::int32_t h : {edge, opposite}) {
      const std::int32_t corner = triangulation_.origin(SphereTriangulation::previous(h));
      const std::int32_t from = triangulation_.origin(h);
      const std::int32_t to = from == a ? b : a;
      for (const Triangle& t : {Triangle{from, seed, corner}, Triangle{seed, to, corner}}) {
        if (!(determinant(t) > smallest_seed_determinant)) {
          seeds_[seed] = before;
          return false;
        }
        patch.triangles.push_back(t);
      }
    }
    MeshPlace place;
    positions_[seed] = surface_.position_near(seeds_[seed], place);
    // The fan's triangles become two fewer, and the edge's two become four.
    triangulation_.replace(patch.slots, patch.triangles);
    return true;
  }

 private:
  double determinant(const Triangle& t) const {
    return six_volumes(seeds_[t[0]], seeds_[t[1]], seeds_[t[2]]);
  }

  /// The triangles about a seed joined to that of its ring for which the smallest determinant is
  /// largest; false where none stands. That they stand suffices: see join_fan in
  /// refinement_relocations.cpp.
  bool leave(std::int32_t seed, Patch& patch) const {
    std::vector<std::int32_t> ring;
    visit_outgoing_of(triangulation_, seed, [&](std::int32_t h) {
      ring.push_back(triangulation_.origin(SphereTriangulation::next(h)));
      patch.slots.push_back(h / 3);
    });
    // Three neighbours leave one triangle, whichever they are joined to: not worth a case.
    if (ring.size() < 4) return false;
    double largest = smallest_seed_determinant;
    for (std::size_t j = 0; j < ring.size(); ++j) {
      std::vector<Triangle> joined;
      double smallest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
        joined.push_back({ring[j], ring[(j + k) % ring.size()], ring[(j + k + 1) % ring.size()]});
        smallest = std::min(smallest, determinant(joined.back()));
      }
      if (!(smallest > largest)) continue;
      largest = smallest;
      patch.triangles = std::move(joined);
    }
    return !patch.triangles.empty();
  }

  std::int32_t longest_edge(std::int32_t seed) const {
    double longest = 0.0;
    std::int32_t edge = triangulation_.first_half_edge()[seed];
    visit_outgoing_of(triangulation_, seed, [&](std::int32_t h) {
      const std::int32_t other = triangulation_.origin(SphereTriangulation::next(h));
      const double length = (positions_[other] - positions_[seed]).norm();
      if (!(length > longest)) return;
      longest = length;
      edge = h;
    });
    return edge;
  }

  const SphereSurface& surface_;
  std::vector<Vector3>& seeds_;
  std::vector<Vector3>& positions_;
  SphereTriangulation& triangulation_;
};

}  // namespace

std::vector<double> cell_shares(const SphereSurface& surface, const SiteDensity& density,
                                const SpaceTessellation& tessellation) {
  const std::size_t count = tessellation.seeds.size();
  std::vector<double> wanted(count, 1.0);
  double area = 0.0;
  double all_wanted = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    if (density) {
      MeshPlace place;
      surface.position_near(tessellation.seeds[i], place);
      wanted[i] = 1.0 / density(tessellation.seeds[i], place);
    }
    area += tessellation.cell_areas[i];
    all_wanted += wanted[i];
  }
  std::vector<double> shares(count);
  for (std::size_t i = 0; i < count; ++i) {
    shares[i] = tessellation.cell_areas[i] * all_wanted / (area * wanted[i]);
  }
  const SphereTriangulation& triangulation = tessellation.triangulation;
  for (int k = 0; k < smoothings; ++k) {
    const std::vector<double> before = shares;
    for (std::size_t i = 0; i < count; ++i) {
      double sum = before[i];
      int seeds = 1;
      visit_outgoing_of(triangulation, static_cast<std::int32_t>(i), [&](std::int32_t h) {
        sum += before[triangulation.origin(SphereTriangulation::next(h))];
        ++seeds;
      });
      shares[i] = sum / seeds;
    }
  }
  return shares;
}

double crowded_seeds(const std::vector<double>& shares) {
  double sum = 0.0;
  for (const double share : shares) sum += too_many(share);
  return sum;
}

int relocate_seeds(const SphereSurface& surface, const std::vector<double>& shares,
                   SpaceTessellation& tessellation) {
  double room = 0.0;
  for (const double share : shares) room += std::max(0.0, share - 1.0);
  if (!(room > 0.0)) return 0;
  const double filled = crowded_seeds(shares) / room;
  std::vector<double> crowded;
  std::vector<double> wanting;
  for (const double share : shares) {
    crowded.push_back(too_many(share));
    wanting.push_back(filled * std::max(0.0, share - 1.0));
  }
  const std::vector<std::int32_t> from = spread_by(crowded);
  const std::vector<std::int32_t> to = spread_by(wanting);
  Relocation relocation(surface, tessellation);
  int taken = 0;
  for (std::size_t k = 0; k < std::min(from.size(), to.size()); ++k) {
    taken += relocation.take(from[k], to[k]) ? 1 : 0;
  }
  return taken;
}

}  // namespace wscvt
