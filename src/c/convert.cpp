// The sizes with which structs begin.
// SPDX-License-Identifier: MIT
#include "convert.hpp"

namespace isostep::c {

iso_status check_size(const void* from, std::size_t known, const char* call, std::size_t& size) {
  if (from == nullptr) return refuse(ISO_NULL, call);
  std::uint32_t given = 0;
  std::memcpy(&given, from, sizeof given);
  size = given;
  if (size < kHeadSize || size > known + kMostUnknown) return refuse(ISO_WRONG_SIZE, call, "size", "what _init sets");
  const auto* const bytes = static_cast<const std::uint8_t*>(from);
  for (std::size_t i = known; i < size; ++i) {
    if (bytes[i] != 0) return refuse(ISO_WRONG_SIZE, call, "size", "no members that this library does not know");
  }
  return kOk;
}

}  // namespace isostep::c
