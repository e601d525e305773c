// Mathematics for games: its bodies, and the list of what a scalar needs of it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/math/affine.inl"
#include "isostep/math/angles.inl"
#include "isostep/math/curves.inl"
#include "isostep/math/draws.inl"
#include "isostep/math/euler.inl"
#include "isostep/math/frames.inl"
#include "isostep/math/noise.inl"
#include "isostep/math/rotations.inl"
#include "isostep/math/vectors.inl"

#define ISO_MATH_OF(KEYWORD, S) \
  ISO_AFFINE_OF(KEYWORD, S)     \
  ISO_ANGLES_OF(KEYWORD, S)     \
  ISO_CURVES_OF(KEYWORD, S)     \
  ISO_DRAWS_OF(KEYWORD, S)      \
  ISO_EULER_OF(KEYWORD, S)      \
  ISO_FRAMES_OF(KEYWORD, S)     \
  ISO_NOISE_OF(KEYWORD, S)      \
  ISO_ROTATIONS_OF(KEYWORD, S)  \
  ISO_VECTORS_OF(KEYWORD, S)
