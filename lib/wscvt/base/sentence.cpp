// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/base/sentence.h"

namespace wscvt {

Sentence::Sentence(NamedOption option) : text_("--" + option.key) {
  if (!option.value.empty() && option.value != "true") text_ += " " + option.value;
  places_.push_back({0, text_.size(), std::move(option)});
}

Sentence& Sentence::operator+=(const Sentence& rest) {
  const std::size_t before = text_.size();
  const std::vector<Place> added = rest.places_;  // `rest` may be this
  text_ += rest.text_;
  for (const Place& place : added) {
    places_.push_back({before + place.begin, place.length, place.option});
  }
  return *this;
}

std::string Sentence::in(const OptionWords& words) const {
  std::string text;
  std::size_t at = 0;
  for (const Place& place : places_) {
    text.append(text_, at, place.begin - at).append(words(place.option));
    at = place.begin + place.length;
  }
  return text.append(text_, at, std::string::npos);
}

}  // namespace wscvt
