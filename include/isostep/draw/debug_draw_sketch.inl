// Drawing: a world's numbers as floats.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/draw/debug_draw.hpp"

namespace isostep::detail {

/// Numbers of a world over S as floats, positions less an origin.
template <class S> class Sketch {
 public:
  ISO_INLINE explicit Sketch(const DrawOptions& options) : options_(options) {}

  template <class T> static ISO_INLINE float number(T x) { return static_cast<float>(to_double(x)); }
  template <class T> static ISO_INLINE void vector(Vec3<T> v, float (&out)[3]) {
    for (int i = 0; i < 3; ++i) out[i] = number(v[i]);
  }
  ISO_INLINE void point(Vec3<S> p, float (&out)[3]) const {
    for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(to_double(p[i]) - options_.origin[i]);
  }
  ISO_INLINE DrawnPose pose(const Pose<S>& pose) const {
    DrawnPose out;
    point(pose.position, out.position);
    const Quat<Unit<S>>& q = pose.orientation;
    const Unit<S> parts[4] = {q.x, q.y, q.z, q.w};
    for (int i = 0; i < 4; ++i) out.orientation[i] = number(parts[i]);
    return out;
  }
  ISO_INLINE const double* origin() const { return options_.origin; }

 private:
  const DrawOptions& options_;
};

}  // namespace isostep::detail
