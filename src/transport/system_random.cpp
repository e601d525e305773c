// The source of random bits that each system has for keys.
// SPDX-License-Identifier: MIT
#if defined(_WIN32)
#define _CRT_RAND_S
#include <stdlib.h>
#else
#include <sys/random.h>
#include <unistd.h>
#endif

#include "transport/system_random.hpp"

namespace isostep::transport {

bool draw_secret(std::span<std::uint64_t> words) {
#if defined(_WIN32)
  for (std::uint64_t& word : words) {
    unsigned int low = 0, high = 0;
    if (rand_s(&low) != 0 || rand_s(&high) != 0) return false;
    word = std::uint64_t{high} << 32 | low;
  }
  return true;
#else
  return ::getentropy(words.data(), words.size_bytes()) == 0;  // at most 256 bytes
#endif
}

}  // namespace isostep::transport
