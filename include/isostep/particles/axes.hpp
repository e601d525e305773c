// Axes<T>: one vector a particle, kept as three arrays so that neighbours fill lanes.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "isostep/math/vec3.hpp"

namespace isostep {

template <class T> struct Axes {
  std::vector<T> x, y, z;

  // These are what the compiler would make, but without weak functions in each of the files that copy them.
  ISO_INLINE Axes() = default;
  ISO_INLINE Axes(const Axes&) = default;
  ISO_INLINE Axes(Axes&&) = default;
  ISO_INLINE Axes& operator=(const Axes&) = default;
  ISO_INLINE Axes& operator=(Axes&&) = default;
  ISO_INLINE ~Axes() = default;

  ISO_INLINE std::size_t size() const { return x.size(); }
  ISO_INLINE Vec3<T> operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  ISO_INLINE void set(std::size_t i, Vec3<T> value) {
    x[i] = value.x;
    y[i] = value.y;
    z[i] = value.z;
  }
  ISO_INLINE void add(std::size_t i, Vec3<T> value) {
    x[i] += value.x;
    y[i] += value.y;
    z[i] += value.z;
  }
  ISO_INLINE void push_back(Vec3<T> value) {
    x.push_back(value.x);
    y.push_back(value.y);
    z.push_back(value.z);
  }
  ISO_INLINE void assign(std::size_t count, T value) {
    x.assign(count, value);
    y.assign(count, value);
    z.assign(count, value);
  }
  ISO_INLINE void resize(std::size_t count, T value = T(0)) {
    x.resize(count, value);
    y.resize(count, value);
    z.resize(count, value);
  }
};

/// The arrays of Axes<T>, for kernels.
template <class T> struct AxesView { T *x, *y, *z; };
template <class T> ISO_INLINE AxesView<T> view_of(Axes<T>& axes) {
  return {axes.x.data(), axes.y.data(), axes.z.data()};
}

}  // namespace isostep
