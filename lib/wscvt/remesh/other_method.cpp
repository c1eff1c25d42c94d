// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/remesh/other_method.h"

namespace wscvt {

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

}  // namespace wscvt
