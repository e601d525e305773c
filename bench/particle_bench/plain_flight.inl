// The loop of plain_flight.hpp: the formula, the limit of drag and the sub-steps of the engine's flight.
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "plain_flight.hpp"

namespace isostep::bench {
namespace {

void substep_plainly(const PlainFlight& f, float* __restrict x, float* __restrict y, float* __restrict z,
                     float* __restrict vx, float* __restrict vy, float* __restrict vz, const float* __restrict w) {
  const float h = f.h, rate = 1 / f.h, keep = f.keep, gravity = f.gravity;
  const float linear = f.linear_drag, quadratic = f.quadratic_drag;
  const int count = f.count;
  for (int i = 0; i < count; ++i) {
    const float a = vx[i], b = vy[i], c = vz[i];
    const float wanted = (linear + quadratic * std::sqrt(a * a + b * b + c * c)) * w[i];
    const float drag = wanted < rate ? wanted : rate;
    const float next_a = (a - a * drag * h) * keep, next_b = (b + (gravity - b * drag) * h) * keep;
    const float next_c = (c - c * drag * h) * keep;
    vx[i] = next_a;
    vy[i] = next_b;
    vz[i] = next_c;
    x[i] += next_a * h;
    y[i] += next_b * h;
    z[i] += next_c * h;
  }
}

void step_plainly(const PlainFlight& f) {
  for (int k = 0; k < f.substeps; ++k) substep_plainly(f, f.x, f.y, f.z, f.vx, f.vy, f.vz, f.inverse_mass);
}

}  // namespace
}  // namespace isostep::bench
