// The scene of hello.cpp through the C interface, in every scalar: what hello_frames.c computes.
// SPDX-License-Identifier: MIT
#pragma once

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif
/* The hash after each of `count` frames; 0, or the line that failed. */
int hello_frames_f32(uint64_t* hashes, int count);
int hello_frames_f64(uint64_t* hashes, int count);
int hello_frames_q16(uint64_t* hashes, int count);
int hello_frames_q32(uint64_t* hashes, int count);
#ifdef __cplusplus
}
#endif
