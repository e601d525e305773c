// The engine's side of the linker trap: compiled with the exact flags at -O0, where nothing is inlined of itself.
// SPDX-License-Identifier: MIT
#include "engine.hpp"

#include "plain.hpp"

float engine_plain(float a, float b, float c) { return plain_multiply_add(a, b, c); }
Sums engine_ours(float a, float b, float c) { return sums_of(a, b, c); }
