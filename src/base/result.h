#pragma once
// Errors of a user's input, and their messages.

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace panache {

// What kind of mistake an error is, where a caller can help with it or decides by it. The C
// interface has the same, in the same order: panache_error_kind.
enum class ErrorKind {
  other,
  file_exists,         // A file would be overwritten.
  rate_needed,         // A file has no frame rate, or one that cannot be.
  not_humanoid,        // A skeleton in which no person was found.
  unknown_style,       // A model has many styles, but not this one; the message names the nearest.
  no_styles,           // A model has no styles yet.
  style_exists,        // A model has a style of that name.
  is_model,            // A model in the place of a style file.
  is_style_file,       // A style file in the place of a model.
  style_of_another,    // A style file that was made with another model.
  not_safetensors,     // Neither a model nor a style file.
  model_cannot_learn,  // A model without the statistics that learning needs.
  other_skeletons,     // A pair of clips whose skeletons differ.
  loop_open,           // A clip whose last pose is not its first.
  loop_strengths,      // Strengths that differ at the ends of a loop.
  bad_style_name,      // A style name of a manifest that people cannot type.
};

// One message for a person: where, what was expected, what was found and, if there is one, the
// cure. Nothing reads it but people.
struct Error {
  std::string message;
  ErrorKind kind = ErrorKind::other;
};

// The error with its place in front: "WHERE: MESSAGE", of the same kind.
inline Error located(const std::string& where, Error error) {
  error.message.insert(0, where + ": ");
  return error;
}

// A T, or an error. Reading the wrong one is a programming error.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() & { return assert(ok()), *std::get_if<0>(&state_); }
  const T& value() const& { return assert(ok()), *std::get_if<0>(&state_); }
  T&& value() && { return assert(ok()), std::move(*std::get_if<0>(&state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T&& operator*() && { return std::move(*this).value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const { return assert(!ok()), *std::get_if<1>(&state_); }

 private:
  std::variant<T, Error> state_;
};

// Done, or the message that says why not.
template <>
class [[nodiscard]] Result<void> {
 public:
  Result() = default;
  Result(Error error) : error_(std::move(error)) {}

  bool ok() const { return !error_; }
  explicit operator bool() const { return ok(); }
  const Error& error() const { return assert(!ok()), *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace panache
