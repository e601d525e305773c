// S17: cars that drive, brake and steer on their own.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/world.hpp"
#include "shapes.hpp"

namespace isostep::scenes {

inline constexpr int kCarsASide = 8, kCars = kCarsASide * kCarsASide;
/// A car of 1200 kg on four driven wheels, that looks along z, turned by `heading` [rad] about y.
void add_car(Scene& scene, Point at, double heading = 0);
/// 64 cars, 12 m apart, that look along z.
Scene cars();
/// Their drivers: of every six seconds throttle in the first two and brakes in the last, and steer that swings with a
/// period of four seconds, each in its own phase.
template <class S> void drive_cars(World<S>& world);

#define ISO_EXTERN(S) extern template void drive_cars<S>(World<S>&);
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::scenes
