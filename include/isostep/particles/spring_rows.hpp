// Springs as a step needs them: what pulls, in arrays that lanes load.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/particles/axes.hpp"
#include "isostep/particles/limits.hpp"
#include "isostep/particles/spring.hpp"

namespace isostep {

/// All but stiff ones and those that can move nobody, ascending by slot; made anew every step.
template <class S> struct SpringRows {
  std::vector<std::uint32_t> a, b;  // slots; b: particles + k where the end is the k-th anchor
  std::vector<S> stiffness, damping, rest_length;
  std::vector<S> least_extension;  // [m] beyond which it pulls: a bungee's is 0
  std::vector<InverseMass<S>> of_a, of_b;
  std::vector<Vec3<S>> anchors;
  // Particles and then anchors, four numbers each, so that one load brings a whole end.
  std::vector<S> places, pulls;    // [m] [m/s^2]
  std::vector<Velocity<S>> paces;  // [m/s]
  std::uint32_t count = 0;
  bool damped = false;

  /// Empties the rows, with room for `most`.
  ISO_INLINE void begin(std::size_t most) {
    count = 0;
    damped = false;
    anchors.clear();
    if (most <= a.size()) return;
    a.resize(most);
    b.resize(most);
    stiffness.resize(most);
    damping.resize(most);
    rest_length.resize(most);
    least_extension.resize(most);
    of_a.resize(most);
    of_b.resize(most);
  }
  ISO_INLINE void add(const Spring<S>& spring, std::uint32_t particles, InverseMass<S> mass_a, InverseMass<S> mass_b) {
    a[count] = spring.a.slot;
    b[count] = spring.b ? spring.b.slot : particles + static_cast<std::uint32_t>(anchors.size());
    if (!spring.b) anchors.push_back(spring.anchor);
    stiffness[count] = spring.stiffness;
    damping[count] = spring.damping;
    rest_length[count] = spring.rest_length;
    least_extension[count] = spring.type == SpringType::bungee ? S(0) : -highest<S>();
    of_a[count] = mass_a;
    of_b[count] = mass_b;
    damped = damped || S(0) < spring.damping;
    ++count;
  }
  /// Makes room for the ends; those that are anchors stay as they are set here.
  ISO_INLINE void place_anchors(std::size_t particles) {
    const std::size_t ends = 4 * (particles + anchors.size());
    if (places.size() < ends) {
      places.resize(ends, S(0));
      pulls.resize(ends, S(0));
      paces.resize(ends, Velocity<S>(0));
    }
    for (std::size_t i = 0; i < anchors.size(); ++i) {
      const std::size_t at = 4 * (particles + i);
      places[at] = anchors[i].x;
      places[at + 1] = anchors[i].y;
      places[at + 2] = anchors[i].z;
      for (std::size_t k = 0; k < 3; ++k) {
        pulls[at + k] = S(0);
        paces[at + k] = Velocity<S>(0);
      }
    }
  }
};

/// The inputs of the springs' kernel, and the accelerations to which it adds. They are bare arrays: a kernel's object
/// has no weak symbol, not even the standard library's.
template <class S> struct SpringRun {
  const std::uint32_t *a, *b;  // as SpringRows has them, by row
  const S *stiffness, *damping, *rest_length, *least_extension;
  const InverseMass<S>*of_a, *of_b;
  S *places, *pulls;
  Velocity<S>* paces;
  AxesView<S> now;  // [m] by particle, as those below
  AxesView<Velocity<S>> velocity;
  AxesView<S> acceleration;
  std::uint32_t count, particles;
  bool damped;
};

}  // namespace isostep
