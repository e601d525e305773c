// WheelGround<S>: finds the ground below wheels, by casts among what is near.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/fault_log.hpp"
#include "isostep/query/cast_queries.hpp"
#include "isostep/systems/vehicle/step_wheels.hpp"

namespace isostep {

/// Input:   the wheels of a step and the broad phase; the bodies in sub-steps.
/// Output:  the ground that each run stands on: its plane, its friction, and whether the ground is that plane for all
///          of the step.
/// Keeps:   the bodies near each body with wheels, until the step ends.
template <class S> class WheelGround {
 public:
  using U = Unit<S>;
  using V = Velocity<S>;
  using Run = WheelRun<S>;
  using Group = WheelGroup<S>;

  ISO_INLINE WheelGround(const WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies,
                         StepWheels<S>& wheels)
      : state_(state), map_(map), casts_(state, map, proxies, faults_), wheels_(wheels) {}

  ISO_INLINE void begin_step() { near_.clear(); }
  /// Finds the ground below all wheels of a body, with one query around them.
  void find(Group& group);
  /// Finds the ground at the present place of wheels on uneven ground. Returns true if there are such wheels.
  bool follow();

 private:
  static constexpr std::uint32_t kMostMet = 8;  // bodies that a wheel looks at for ground
  static constexpr int kMostLooks = 8;          // along the way of a step: half a radius apart up to four radii
  static constexpr S kLevel = S(1.0 / 64);      // [1] of the radius: the ground is a plane that differs by no more
  static constexpr S kAround = S(0.125);        // [m] what sub-steps make of a way that velocities do not tell

  /// The pose of a wheel's suspension.
  struct Stance {
    Vec3<S> hard_point;  // [m] world
    Vec3<U> down;        // [1] world
  };
  /// The way of the sphere that searches for ground: from a radius above the highest position of the wheel's middle to
  /// a radius below the lowest.
  struct Search {
    Vec3<S> start, way;  // [m] world
    Aabb<S> box;         // [m] world, around it
  };
  /// The ground below a wheel.
  struct Ground {
    BodyId body = {};         // null: no ground
    std::uint32_t child = 0;  // of its shape
    Vec3<S> point = {};       // [m] world
    Vec3<U> normal = {};
  };

  bool bears(std::uint32_t body, std::uint32_t ground) const;
  template <class Hits> static Ground first_that_bears(const Hits& hits, Vec3<U> down);
  Stance stance_of(const Run& run) const;
  Search search_of(const Run& run, const Stance& at) const;
  void look_around(Group& group, const Aabb<S>& box);
  Ground ground_below(const Run& run, const Stance& at);
  void stand_on(Run& run, const Ground& ground);
  S length_over(const Run& run, const Stance& at, const Ground& ground) const;
  Vec3<S> way_of(const Run& run, const Stance& at) const;
  bool is_uneven(const Run& run, const Stance& at, const Ground& ground);

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  FaultLog faults_;  // of casts that are refused
  CastQueries<S> casts_;
  StepWheels<S>& wheels_;
  std::vector<std::uint32_t> near_;  // slots of what wheels might stand on, body by body
};

}  // namespace isostep
