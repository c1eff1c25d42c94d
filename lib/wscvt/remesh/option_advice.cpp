// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/option_advice.h"

namespace wscvt {

namespace {

/// A key, or a value of a key, of version 2, and its replacement in version 3.
struct Replaced {
  std::string_view key;
  std::string_view value;  ///< empty: any value
  std::string_view instead;
};

constexpr Replaced replaced[] = {
    {"refine", "", "Use --edge-ratio 1.4 or larger. The remesh is then closer to the scan."},
    {"refine-angle", "", "Use --edge-ratio. The angles stay near 30 degrees or above."},
    {"refine-tolerance", "", "Leave it out: the fit stops by itself."},
    {"metric", "",
     "Leave it out: --method on-scan has its cells on the surface, --method as-published on the "
     "sphere."},
    {"parametrization", "",
     "Leave it out: --method on-scan accepts any closed grain, --method as-published star-shaped "
     "grains."},
    {"target", "", "Use --max-error."},
    {"target-measure", "", "Use --error-measure."},
    {"largest", "", "Use --max-nodes."},
    {"mend-limit", "", "Use --max-repaired-area."},
    {"envelope", "", "Use --shrink-wrap."},
    {"fold-limit", "", "Use --max-overhang."},
    {"handle-length", "", "Use --max-handle-loop."},
    {"advice", "", "Use --suggestions, or --no-suggestions."},
    {"no-advice", "", "Use --no-suggestions."},
    {"seed-start", "", "Leave it out: the best initial seeds are always used."},
    {"seed", "", "Leave it out: nothing is random. A scan always gives the same mesh."},
    {"iterations", "", "Leave it out: the relaxation stops by itself."},
    {"tolerance", "", "Leave it out: the relaxation stops by itself."},
    {"area-tolerance", "", "Leave it out: the relaxation stops by itself."},
    {"acceleration", "", "Leave it out: the relaxation is always accelerated."},
    {"no-acceleration", "", "Leave it out: the relaxation is always accelerated."},
    {"over-relaxation", "", "Leave it out: the method chooses the step."},
    {"coarsest-seeds", "", "Leave it out: the method chooses the levels."},
    {"coarsest-tolerance", "", "Leave it out: the method chooses the levels."},
    {"middle-tolerance", "", "Leave it out: the method chooses the levels."},
    {"curvature-source", "",
     "Leave it out: --method as-published uses the curvature of the SH series, --method on-scan "
     "the curvature of the scan."},
    {"adaptive-exponent", "", "Use --edge-ratio 1.4, which is closer to the scan."},
    {"distance-samples", "", "Leave it out: 400,000 sample points are used."},
    {"weld-tolerance", "", "Leave it out: it is 1e-12 of the scan's size."},
    {"dropped-volume", "", "Leave it out: it is 25 % of the volume."},
    {"refuse-self-intersections", "",
     "Leave it out: the report and a warning give the number of intersecting triangle pairs."},
    {"sdf-margin", "", "Leave it out: the margin is 4 cells."},
    {"input-unit", "", "Use --scale with the factor between the two units."},
    {"output-unit", "", "Use --scale with the factor between the two units."},
    {"weighting", "radial-distance", "Use wscvt-d."},
    {"weighting", "curvature", "Use wscvt-c."},
    {"weighting", "error-adaptive", "Use wscvt-d with --edge-ratio 1.4, which is closer."},
    {"placement", "series", "Use --method as-published, with --placement sh-surface."},
    {"placement", "scan", "Use on-surface."},
    {"placement", "least-squares", "Use fitted, with --method on-scan."},
    {"placement", "contact", "Use contact-fit, with --method on-scan."},
};

/// The keys of a method's own options, with a test for a value of one of them.
class KnownOptions {
 public:
  KnownOptions(std::string_view key, std::string_view value) : key_(key), value_(value) {}

  template <class Number>
  void operator()(const Number& /*value*/, const NumberOption<Number>& option) {
    has_key = has_key || option.key == key_;
  }
  template <class Enumeration>
  void operator()(const Enumeration& /*value*/) {
    if (EnumerationTable<Enumeration>::key != key_) return;
    has_key = true;
    for (const auto& row : enumerators<Enumeration>()) has_value = has_value || row.key == value_;
  }

  bool has_key = false;
  bool has_value = false;

 private:
  std::string_view key_;
  std::string_view value_;
};

KnownOptions known_to(Method method, std::string_view key, std::string_view value) {
  KnownOptions known(key, value);
  if (method == Method::OnScan) {
    const OnScanOptions options;
    for_each_method_option(options, known);
  } else {
    const AsPublishedOptions options;
    for_each_method_option(options, known);
  }
  return known;
}

Method other(Method method) {
  return method == Method::OnScan ? Method::AsPublished : Method::OnScan;
}

std::string instead_of(std::string_view key, std::string_view value) {
  for (const Replaced& one : replaced) {
    if (one.key == key && one.value == value) return std::string(one.instead);
  }
  return "";
}

}  // namespace

std::string advice_for_option(std::string_view key, Method method) {
  if (known_to(method, key, "").has_key) return "";
  if (known_to(other(method), key, "").has_key) {
    return "This option belongs to the method " + key_of(other(method)) + ", but the method is " +
           key_of(method) + ". Leave it out, or use --method " + key_of(other(method)) + ".";
  }
  const std::string instead = instead_of(key, "");
  return instead.empty() ? "" : "Version 3 has no such option. " + instead;
}

std::string advice_for_value(std::string_view key, std::string_view value, Method method) {
  if (known_to(method, key, value).has_value) return "";
  if (known_to(other(method), key, value).has_value) {
    return "\"" + std::string(value) + "\" belongs to the method " + key_of(other(method)) +
           ", but the method is " + key_of(method) + ".";
  }
  const std::string instead = instead_of(key, value);
  return instead.empty() ? "" : "Version 3 has no value \"" + std::string(value) + "\". " + instead;
}

std::vector<std::string_view> replaced_options() {
  std::vector<std::string_view> keys;
  for (const Replaced& one : replaced) {
    if (one.value.empty()) keys.push_back(one.key);
  }
  return keys;
}

}  // namespace wscvt
