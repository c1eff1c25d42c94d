// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/remesh_options.h"

#include <algorithm>
#include <iterator>
#include <type_traits>
#include <utility>

#include "wscvt/base/error.h"
#include "wscvt/base/text.h"
#include "wscvt/tessellation/weights.h"

namespace wscvt {

namespace {

/// Options without effect on a surface that is known exactly; see remesh.
constexpr std::string_view of_a_scan[] = {
    points_option.key,          shrink_wrap_option.key,  repaired_area_limit_option.key,
    harmonic_degree_option.key, max_overhang_option.key, EnumerationTable<HandleAction>::key,
    max_handle_loop_option.key,
};

/// Options of the remesh on which convex parts are cut.
constexpr std::string_view of_parts[] = {
    node_count_option.key,
    points_option.key,
    shrink_wrap_option.key,
    repaired_area_limit_option.key,
    EnumerationTable<HandleAction>::key,
    max_handle_loop_option.key,
};

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

bool is_option_of(std::string_view key, Remeshed remeshed) {
  const auto is_in = [&](const auto& keys) {
    return std::find(std::begin(keys), std::end(keys), key) != std::end(keys);
  };
  if (remeshed == Remeshed::Parts) return is_in(of_parts);
  return remeshed == Remeshed::Scan || !is_in(of_a_scan);
}

void check_options(const RemeshOptions& options) {
  CheckOption check;
  for_each_option(options, check);
  require_in_range(options.target.largest_node_count, node_count_option);
  check_shrink_wrap_options(options.shrink_wrap);
  const auto* published = std::get_if<AsPublishedOptions>(&options.method);
  if (published != nullptr && options.target.percent > 0.0 &&
      !takes_any_count(published->sampling)) {
    refuse("The sampling " + key_of(published->sampling) +
           " exists only for some numbers of nodes, so the "
           "smallest number cannot be searched. Use --" +
           std::string(EnumerationTable<Sampling>::key) + " weighted or fibonacci, or --" +
           std::string(error_target_option.key) + " 0.");
  }
}

namespace {

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

/// Reads typed options.
class ReadTyped {
 public:
  ReadTyped(TypedOptions typed, const RefuseOption& refuse)
      : typed_(std::move(typed)), refuse_(refuse) {}

  template <class Number>
  void operator()(Number& value, const NumberOption<Number>& option) {
    take(option.key, [&](const std::string& text) { value = from_typed(text, option); });
  }
  void operator()(bool& value, const FlagOption& option) {
    take(option.key, [&](const std::string& text) {
      if (text != "true" && text != "false") {
        refuse("The option " + std::string(option.key) + " is \"" + text +
               "\". Give true or false.");
      }
      value = text == "true";
    });
  }
  template <class Enumeration>
  void operator()(Enumeration& value) {
    constexpr std::string_view key = EnumerationTable<Enumeration>::key;
    take(key, [&](const std::string& text) {
      const std::string name = lower_case(text);
      const Sentence refusal = refusal_of_value(key, name, method_);
      if (!refusal.empty()) refuse(refusal);
      value = from_key<Enumeration>(name);
      if constexpr (std::is_same_v<Enumeration, Method>) method_ = value;
    });
  }

  /// Refuses texts that no option has read.
  void finish() const {
    for (const auto& [key, text] : typed_) refuse_(key, refusal_of_option(key, method_));
  }

 private:
  template <class Read>
  void take(std::string_view key, const Read& read) {
    const auto found = typed_.find(key);
    if (found == typed_.end()) return;
    try {
      read(found->second);
    } catch (const Error& error) {
      refuse_(key, error.sentence());
    }
    typed_.erase(found);
  }

  TypedOptions typed_;
  const RefuseOption& refuse_;
  Method method_ = Method::OnScan;
};

}  // namespace

Sentence refusal_of_option(std::string_view key, Method method) {
  if (known_to(method, key, "").has_key || !known_to(other(method), key, "").has_key) return "";
  return "This option belongs to the method " + key_of(other(method)) + ", but the method is " +
         key_of(method) + ". Leave it out, or use " + mention(other(method)) + ".";
}

Sentence refusal_of_value(std::string_view key, std::string_view value, Method method) {
  if (key == EnumerationTable<CellWeighting>::key && value == "error-adaptive") {
    return Sentence("Version 3 has no value \"error-adaptive\". Use ") +
           key_of(CellWeighting::Area) + " with " +
           mention(std::string(edge_ratio_option.key), "1.4") + ", which is closer.";
  }
  if (known_to(method, key, value).has_value || !known_to(other(method), key, value).has_value) {
    return "";
  }
  return Sentence("\"") + std::string(value) + "\" belongs to the method " + key_of(other(method)) +
         ", but the method is " + key_of(method) + ".";
}

void limit_search_to_given_nodes(RemeshOptions& options) {
  if (options.target.percent == 0.0) return;
  options.target.largest_node_count = options.node_count;
  options.node_count = std::min(options.node_count, RemeshOptions().node_count);
}

RemeshOptions as_given(RemeshOptions options) {
  if (options.target.percent > 0.0) options.node_count = options.target.largest_node_count;
  return options;
}

void read_options(const TypedOptions& typed, RemeshOptions& options, const RefuseOption& refuse) {
  ReadTyped read(typed, refuse);
  for_each_option(options, read);
  read.finish();
  if (typed.count(node_count_option.key) > 0) limit_search_to_given_nodes(options);
}

}  // namespace wscvt
