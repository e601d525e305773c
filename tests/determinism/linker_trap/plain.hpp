// The trap itself: an ordinary inline function over floats, as a header-only engine would have it.
// SPDX-License-Identifier: MIT
#pragma once

inline float plain_multiply_add(float a, float b, float c) { return a * b + c; }
