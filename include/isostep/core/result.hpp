// Result<T>: a value or an Error that says what, where and why; how bad data from outside is refused.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "isostep/core/short_text.hpp"
#include "isostep/scalar/platform.hpp"

namespace isostep {

enum class ErrorCode : std::uint8_t {
  invalid,       // a value outside its meaning: a type that does not exist, an index past the end, not a number
  truncated,     // the data end too early
  corrupt,       // the data contradict themselves
  incompatible,  // well formed, but made for something else
  limit,         // well formed, but larger than a published cap
  sink           // the caller's output refused the bytes
};

/// `place` names the field or the byte; `message` says what was found and what was expected.
struct Error {
  ErrorCode code;
  ShortText<112> message;
  ShortText<64> place;
};

/// A read of the side that is not there is the caller's bug and stops the program.
template <class T> class [[nodiscard]] Result {
 public:
  ISO_INLINE Result(T value) : value_(std::move(value)), error_{} {}
  ISO_INLINE Result(const Error& error) : value_(), error_(error) {}

  ISO_INLINE bool ok() const { return value_.has_value(); }
  ISO_INLINE explicit operator bool() const { return ok(); }
  ISO_INLINE const T& value() const {
    if (!ok()) ISO_TRAP();
    return *value_;
  }
  ISO_INLINE T& value() {
    if (!ok()) ISO_TRAP();
    return *value_;
  }
  ISO_INLINE const Error& error() const {
    if (ok()) ISO_TRAP();
    return error_;
  }

 private:
  std::optional<T> value_;
  Error error_;
};

template <> class [[nodiscard]] Result<void> {
 public:
  ISO_INLINE Result() : error_{}, ok_(true) {}
  ISO_INLINE Result(const Error& error) : error_(error), ok_(false) {}

  ISO_INLINE bool ok() const { return ok_; }
  ISO_INLINE explicit operator bool() const { return ok_; }
  ISO_INLINE const Error& error() const {
    if (ok_) ISO_TRAP();
    return error_;
  }

 private:
  Error error_;
  bool ok_;
};

}  // namespace isostep
