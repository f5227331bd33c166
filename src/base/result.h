#pragma once
// Errors in user input, and their messages.

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace panache {

// The kind of an error, for callers that react to it. The same as panache_error_kind of the C
// interface, in the same order.
enum class ErrorKind {
  other,
  file_exists,         // A file would be overwritten.
  rate_needed,         // A file has no frame rate, or an impossible one.
  not_humanoid,        // A skeleton that is not recognised as a humanoid.
  unknown_style,       // A model has styles, but not this one; the message names the nearest.
  no_styles,           // A model has no styles yet.
  style_exists,        // A model has a style of that name.
  is_model,            // A model instead of a style file.
  is_style_file,       // A style file instead of a model.
  style_of_another,    // A style file made with another model.
  not_safetensors,     // Neither a model nor a style file.
  model_cannot_learn,  // A model without the statistics that learning needs.
  other_skeletons,     // A pair of clips whose skeletons differ.
  loop_open,           // A clip whose last pose is not its first.
  loop_strengths,      // Strengths that differ at the ends of a loop.
  bad_style_name,      // A style name of a manifest that people cannot type.
};

// A message for people only: where, what was expected, what was found and, if there is one, the
// cure.
struct Error {
  std::string message;
  ErrorKind kind = ErrorKind::other;
};

// The error with its location in front: "WHERE: MESSAGE", of the same kind.
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

// Success, or an error.
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
