// Float environments that a caller may have left behind: other roundings, flushed denormals, unmasked exceptions.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/scalar/environment.hpp"

#if defined(__SSE2__) && defined(__GNUC__)
#define ISOSTEP_HOSTILE_ENVIRONMENTS

namespace isostep::test {

/// Sets the control bits of this thread and puts back what was there.
class Hostile {
 public:
  explicit Hostile(std::uint32_t control) : before_(isostep::detail::FloatState::read()) { set(control); }
  ~Hostile() { isostep::detail::FloatState::write(before_); }
  static void set(std::uint32_t control) {
    constexpr std::uint64_t kOther = ~std::uint64_t{0xffffffff};  // i686: the x87 control word, left as it is
    isostep::detail::FloatState::write((isostep::detail::FloatState::read() & kOther) | control);
  }
  static std::uint32_t control() { return static_cast<std::uint32_t>(isostep::detail::FloatState::read()) & 0xffc0u; }

 private:
  std::uint64_t before_;
};

inline constexpr std::uint32_t kMasks = 0x1f80, kDown = 0x2000, kUp = 0x4000, kTowardsZero = 0x6000, kFlush = 0x8000,
                               kDenormalsAreZero = 0x40;

}  // namespace isostep::test
#endif
