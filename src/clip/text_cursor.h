#pragma once
// Reads words and numbers from a text, and reports where one of them is wrong; and writes
// numbers as people do. The same on every machine and in every locale.

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"

namespace panache {

// Largest magnitude of numbers in files: too small for the solar system in metres or millimetres,
// and no sum or square of such numbers overflows a float.
inline constexpr double kLargestNumber = 1e9;

// Appends `value` with exactly `decimals` (0 to 9) digits after the point, without an exponent and
// never as negative zero. Numbers are clamped to kLargestNumber; NaN is written as 0.
void append_fixed(std::string& out, double value, int decimals);

// The same as a string.
std::string with_decimals(double value, int decimals);

// Digits after the point of `number`; 0 if it has an exponent.
int decimals_of(std::string_view number);

// A position in a text. Words are separated by spaces (space, tab, vertical tab, form feed) and
// line ends (\n, \r\n, lone \r). Only skip_space() moves to another line.
class TextCursor {
 public:
  // `text` outlives the cursor; messages start with `name`. A UTF-8 byte order mark at the start is
  // skipped.
  TextCursor(std::string_view text, std::string name);

  size_t offset() const { return offset_; }                    // Bytes from the start.
  size_t line_begin() const { return line_begin_; }            // Start of the current line.
  size_t remaining() const { return text_.size() - offset_; }  // Bytes to the end.
  bool at_end() const { return offset_ == text_.size(); }
  bool at_line_end() const { return at_end() || is_line_end(text_[offset_]); }

  void skip_spaces() {
    while (offset_ < text_.size() && is_space(text_[offset_])) ++offset_;
  }
  // Skips spaces and line ends.
  void skip_space();

  // The word here; empty at a space, a line end or the end.
  std::string_view word() const;
  // Whether the word here is `keyword`, in any case.
  bool is_at(std::string_view keyword) const;
  // Skips the word here if it is `keyword`, in any case.
  bool take(std::string_view keyword);
  // Skips `label` and the colon after it, in any case and with any spaces between the words and
  // before the colon ("Frame Time:"); if something else is here, stays and returns false.
  bool take_label(std::string_view label);
  // The rest of the line, trimmed, and without a "{" as its last word.
  std::string_view take_name();
  // Reads the word here if it is a non-negative integer; saturates at 2^64 - 1.
  bool take_count(uint64_t& value);
  // Reads the word here if it is a finite number within kLargestNumber.
  bool take_number(double& value);

  // "NAME:LINE:COLUMN: expected EXPECTED, found ...": the word here, or the end of the line or
  // file.
  Error error(const std::string& expected) const;
  // The same for a missing number, with the cure if there is one.
  Error number_error(const std::string& of_what) const;

  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }

 private:
  std::string found() const;

  std::string_view text_;
  std::string name_;
  size_t start_ = 0;  // 3 with a byte order mark.
  size_t offset_ = 0;
  size_t line_begin_ = 0;
};

// `text` in single quotes for a message: long text is cut, bytes that are not text become \xNN.
std::string quoted(std::string_view text);

}  // namespace panache
