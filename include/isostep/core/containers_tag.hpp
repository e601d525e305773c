// A link error, not a crash, where a program and the library have containers of different layouts.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>  // the standard library's own macros

#include "isostep/scalar/platform.hpp"

/// -D_GLIBCXX_DEBUG adds iterators to every std::vector, -D_GLIBCXX_USE_CXX11_ABI=0 brings another std::string: the
/// library and a program share both. Each file that includes this refers to a name that only a library compiled alike
/// defines, and the linker names it. Microsoft's library does the same by `#pragma detect_mismatch`.
#if defined(_GLIBCXX_DEBUG)
#define ISO_CONTAINERS_TAG isostep_must_be_compiled_with_GLIBCXX_DEBUG_as_well
#elif defined(_GLIBCXX_USE_CXX11_ABI) && !_GLIBCXX_USE_CXX11_ABI
#define ISO_CONTAINERS_TAG isostep_must_be_compiled_with_GLIBCXX_USE_CXX11_ABI_0_as_well
#else
#define ISO_CONTAINERS_TAG isostep_must_be_compiled_without_GLIBCXX_DEBUG_as_well
#endif

namespace isostep::detail {
extern const int ISO_CONTAINERS_TAG;
#if defined(__GNUC__)
[[gnu::used, maybe_unused]] static const int* const containers_tag = &ISO_CONTAINERS_TAG;
#endif
}  // namespace isostep::detail
