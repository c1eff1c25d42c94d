// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/remesh_options.h"

#include "wscvt/base/error.h"
#include "wscvt/tessellation/seeding.h"

namespace wscvt {

namespace {

/// Checks every option by itself.
struct CheckOption {
  template <class Number>
  void operator()(const Number& value, const NumberOption<Number>& option) const {
    require_in_range(value, option);
  }
  void operator()(const bool& /*value*/, const FlagOption& /*option*/) const {}
  template <class Enumeration>
  void operator()(const Enumeration& value) const {
    require_valid(value);
  }
};

}  // namespace

void check_options(const RemeshOptions& options) {
  CheckOption check;
  for_each_option(options, check);
  check_shrink_wrap_options(options.shrink_wrap);
  const auto* published = std::get_if<AsPublishedOptions>(&options.method);
  if (published != nullptr && options.target.percent > 0.0 &&
      !takes_any_count(published->sampling)) {
    throw Error(ErrorCode::InvalidInput, "The sampling " + key_of(published->sampling) +
                                             " exists only for some numbers of nodes, so the "
                                             "smallest number cannot be searched. Use --" +
                                             std::string(EnumerationTable<Sampling>::key) +
                                             " weighted or fibonacci, or --" +
                                             std::string(error_target_option.key) + " 0.");
  }
}

}  // namespace wscvt
