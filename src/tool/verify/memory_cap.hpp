// A bound on the memory that this process takes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace isostep::tool {

/// A cap: while it lives, whoever asks for more than so much beyond what the process had gets std::bad_alloc. Where the
/// system has no such bound (it is Linux's RLIMIT_DATA), ToolError 69.
class MemoryCap {
 public:
  explicit MemoryCap(int mebibytes);
  ~MemoryCap();
  MemoryCap(const MemoryCap&) = delete;
  MemoryCap& operator=(const MemoryCap&) = delete;

 private:
  std::uint64_t before_ = 0;  // the limit, in bytes
};

}  // namespace isostep::tool
