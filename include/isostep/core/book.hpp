// ISO_IF_BOOK: code that a build has with the book's own methods, which the default does not use (CMake: ISOSTEP_BOOK).
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/platform.hpp"

/// A list of methods tells those of every build, X(name), from the book's, BOOK(name). ISO_BUILT_BOOK(X) is the BOOK of
/// who visits what this build holds. ISO_NOT_LEFT_OUT and ISO_LEFT_OUT make a list of what a fault expects instead of
/// each, null for what the build holds. Names are the same in every build.
#if !defined(ISOSTEP_NO_BOOK)
#define ISO_IF_BOOK(...) __VA_ARGS__
#define ISO_BUILT_BOOK(X) X
#define ISO_LEFT_OUT(name, ...) nullptr,
#else
#define ISO_IF_BOOK(...)
#define ISO_BUILT_BOOK(X) ISO_IF_BOOK
#define ISO_LEFT_OUT(name, ...) "another: this build leaves out " #name ": ISOSTEP_BOOK is off",
#endif
#define ISO_NOT_LEFT_OUT(name, ...) nullptr,

namespace isostep {

/// Returns null, or why the build lacks `method`, by name. An overload of `expected_instead_of` knows its list.
template <class Name> ISO_INLINE constexpr const char* left_out(Name method) {
  const char* const expected = expected_instead_of(method);
  return expected == nullptr ? nullptr : expected + sizeof "another: " - 1;
}

}  // namespace isostep
