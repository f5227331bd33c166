#include "clip/text_cursor.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <fast_float/fast_float.h>
#include <limits>
#include <system_error>
#include <utility>

#include "base/text.h"

namespace panache {

void append_fixed(std::string& out, double value, int decimals) {
  assert(decimals >= 0 && decimals <= 9);
  if (std::isnan(value)) value = 0;
  value = std::clamp(value, -kLargestNumber, kLargestNumber);
  double scale = 1;
  for (int i = 0; i < decimals; ++i) scale *= 10;
  // At most 1e18, which an int64_t holds.
  const int64_t scaled = std::llround(value * scale);
  uint64_t digits = static_cast<uint64_t>(scaled < 0 ? -scaled : scaled);

  char buffer[24];
  char* const end = buffer + sizeof buffer;
  char* p = end;
  for (int i = 0; i < decimals; ++i, digits /= 10) *--p = static_cast<char>('0' + digits % 10);
  if (decimals > 0) *--p = '.';
  do {
    *--p = static_cast<char>('0' + digits % 10);
    digits /= 10;
  } while (digits > 0);
  if (scaled < 0) *--p = '-';
  out.append(p, static_cast<size_t>(end - p));
}

std::string with_decimals(double value, int decimals) {
  std::string text;
  append_fixed(text, value, decimals);
  return text;
}

int decimals_of(std::string_view number) {
  const size_t point = number.find('.');
  if (point == std::string_view::npos) return 0;
  if (number.find_first_of("eE") != std::string_view::npos) return 0;
  return static_cast<int>(number.size() - point - 1);
}

namespace {

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower_case(x) == lower_case(y); });
}

// Parses a number at the start of [p, end); null if there is none. Infinite if it exceeds a double.
const char* parse_number(const char* p, const char* end, double& value) {
  if (p != end && *p == '+') {
    ++p;
    if (p != end && *p == '-') return nullptr;
  }
  const auto [after, failure] = fast_float::from_chars(p, end, value);
  return failure == std::errc::invalid_argument ? nullptr : after;
}

}  // namespace

std::string quoted(std::string_view text) {
  constexpr size_t kLongest = 40;
  constexpr char kHex[] = "0123456789abcdef";
  std::string out = "'";
  size_t i = 0;
  while (i < text.size() && i < kLongest) {
    const unsigned char c = static_cast<unsigned char>(text[i]);
    const size_t length = utf8_length(text.substr(i));
    if (length == 0 || c < 0x20 || c == 0x7f) {
      out += {'\\', 'x', kHex[c >> 4], kHex[c & 15]};
      ++i;
    } else {
      out += text.substr(i, length);
      i += length;
    }
  }
  if (i < text.size()) out += "...";
  return out + "'";
}

TextCursor::TextCursor(std::string_view text, std::string name)
    : text_(text), name_(std::move(name)) {
  if (text_.substr(0, 3) == "\xef\xbb\xbf") start_ = 3;
  offset_ = line_begin_ = start_;
}

void TextCursor::skip_space() {
  for (; offset_ < text_.size(); ++offset_) {
    if (is_line_end(text_[offset_])) {
      line_begin_ = offset_ + 1;
    } else if (!is_space(text_[offset_])) {
      return;
    }
  }
}

std::string_view TextCursor::word() const {
  size_t end = offset_;
  while (end < text_.size() && !is_space(text_[end]) && !is_line_end(text_[end])) ++end;
  return text_.substr(offset_, end - offset_);
}

bool TextCursor::is_at(std::string_view keyword) const { return same_letters(word(), keyword); }

bool TextCursor::take(std::string_view keyword) {
  if (!is_at(keyword)) return false;
  offset_ += keyword.size();
  return true;
}

bool TextCursor::take_label(std::string_view label) {
  const size_t before = offset_;
  for (const char wanted : label) {
    if (wanted == ' ') {
      skip_spaces();
    } else if (!at_end() && lower_case(text_[offset_]) == lower_case(wanted)) {
      ++offset_;
    } else {
      offset_ = before;
      return false;
    }
  }
  skip_spaces();
  if (at_end() || text_[offset_] != ':') {
    offset_ = before;
    return false;
  }
  ++offset_;
  return true;
}

std::string_view TextCursor::take_name() {
  skip_spaces();
  size_t end = offset_;
  while (end < text_.size() && !is_line_end(text_[end])) ++end;
  const auto trim = [&] {
    while (end > offset_ && is_space(text_[end - 1])) --end;
  };
  trim();
  const bool brace = end > offset_ && text_[end - 1] == '{';
  if (brace && (end - 1 == offset_ || is_space(text_[end - 2]))) {
    --end;
    trim();
  }
  const std::string_view name = text_.substr(offset_, end - offset_);
  offset_ = end;
  return name;
}

bool TextCursor::take_count(uint64_t& value) {
  const std::string_view digits = word();
  if (digits.empty()) return false;
  uint64_t sum = 0;
  for (const char c : digits) {
    if (c < '0' || c > '9') return false;
    const uint64_t digit = static_cast<uint64_t>(c - '0');
    constexpr uint64_t kMax = std::numeric_limits<uint64_t>::max();
    sum = sum > (kMax - digit) / 10 ? kMax : sum * 10 + digit;
  }
  value = sum;
  offset_ += digits.size();
  return true;
}

bool TextCursor::take_number(double& value) {
  const char* const begin = text_.data() + offset_;
  const char* const end = text_.data() + text_.size();
  const char* const after = parse_number(begin, end, value);
  if (!after || (after != end && !is_space(*after) && !is_line_end(*after))) return false;
  if (!(std::abs(value) <= kLargestNumber)) return false;  // Also true for NaN.
  offset_ += static_cast<size_t>(after - begin);
  return true;
}

std::string TextCursor::found() const {
  if (at_end()) return "the end of the file";
  if (at_line_end()) return "the end of the line";
  return quoted(word());
}

Error TextCursor::error(const std::string& expected) const {
  size_t line = 1, begin = start_;
  for (size_t i = start_; i < offset_; ++i) {
    const bool crlf = text_[i] == '\r' && i + 1 < text_.size() && text_[i + 1] == '\n';
    if (!is_line_end(text_[i]) || crlf) continue;
    ++line;
    begin = i + 1;
  }
  return {name_ + ":" + std::to_string(line) + ":" + std::to_string(offset_ - begin + 1) +
          ": expected " + expected + ", found " + found()};
}

Error TextCursor::number_error(const std::string& of_what) const {
  const std::string_view here = word();
  const char* const end = here.data() + here.size();
  double value = 0;
  if (parse_number(here.data(), end, value) == end && std::abs(value) > kLargestNumber) {
    // A spelt-out infinity is not a number; 1e400 is one, although it exceeds a double.
    const bool spelt_out = here.find_first_of("nN") != std::string_view::npos;
    if (!spelt_out) return error("a number between -1e9 and 1e9 for " + of_what);
  }
  Error failure = error("a number for " + of_what);
  if (here.find(',') != std::string_view::npos) {
    failure.message += "; write decimals with a point and separate numbers by spaces";
  }
  return failure;
}

}  // namespace panache
