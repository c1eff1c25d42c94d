// SPDX-License-Identifier: GPL-3.0-or-later
#include "wscvt/mesh_files/byte_source.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace wscvt {

void ByteSource::skip(std::uint64_t count) {
  std::array<char, 4096> passed{};
  while (count > 0) {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(count, passed.size()));
    if (read(passed.data(), wanted) < wanted) return;
    count -= wanted;
  }
}

std::size_t MadeBytes::read(char* bytes, std::size_t count) {
  std::size_t filled = 0;
  while (filled < count) {
    if (next_ == made_.size()) {
      made_.clear();
      next_ = 0;
      if (!make(made_)) break;
    }
    const std::size_t part = std::min(count - filled, made_.size() - next_);
    std::copy_n(made_.data() + next_, part, bytes + filled);
    next_ += part;
    filled += part;
  }
  return filled;
}

Characters::Characters(std::unique_ptr<ByteSource> text)
    : text_(std::move(text)), buffer_(std::size_t{1} << 18) {}

bool Characters::fill() {
  passed_ += end_;
  begin_ = 0;
  end_ = text_->read(buffer_.data(), buffer_.size());
  return end_ > 0;
}

bool Characters::skip_past(char c) {
  while (peek() >= 0) {
    const char* const from = buffer_.data() + begin_;
    const void* const found = std::memchr(from, c, end_ - begin_);
    begin_ = found == nullptr ? end_ : begin_ + (static_cast<const char*>(found) - from) + 1;
    if (found != nullptr) return true;
  }
  return false;
}

}  // namespace wscvt
