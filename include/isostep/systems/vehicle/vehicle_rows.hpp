// VehicleRows<S>: rows of the wheels of vehicles, between their bodies and the ground, which solvers solve.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/fault_log.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"
#include "isostep/dynamics/wheel_rows.hpp"
#include "isostep/math/softness.hpp"
#include "isostep/query/queries.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"

namespace isostep {

/// Input:   wheels and vehicles, the bodies in every sub-step; the broad phase, for the ground below each wheel: once a
///          step, and in every sub-step where it is no plane as far as the wheel gets in the step.
/// Output:  velocities of awake bodies and their ground; the states of wheels and vehicles.
/// Keeps:   nothing from step to step but memory: what rows bore is in the states.
/// Order:   bodies ascending by slot, the wheels of each ascending by slot. Each sweep solves all of them once, so
///          that wheels of bodies which stand on one another agree too: the first wheels of all bodies, then the
///          second, and so on, for wheels of one body wait for each other's results, and those of two bodies do not.
template <class S> class VehicleRows {
 public:
  using U = Unit<S>;
  using V = Velocity<S>;

  ISO_INLINE VehicleRows(WorldState<S>& state, const BodyMap<S>& map, const Proxies<S>& proxies)
      : state_(state), map_(map), queries_(state, map, proxies, faults_) {}

  /// Finds the ground.
  void begin_step();
  /// Since then: whether there are wheels of awake bodies.
  ISO_INLINE bool any() const { return !runs_.empty(); }
  /// visit(row) of bodies with wheels and of those that they stand on.
  template <class Visit> ISO_INLINE void for_each_row(const Visit& visit) const {
    for (const Run& run : runs_) {
      visit(run.row);
      visit(run.ground);
    }
  }
  // As MechanismCalls has them.
  void place(SolverBodies<S>& bodies, std::int32_t rate);
  void solve(int sweeps);
  void relax();
  void end();
  /// Writes the records.
  void end_step();

 private:
  using Row = detail::WheelRow<S>;
  static constexpr V kSettled = V(0x1p-7);      // [1] of the load: what changes an impulse by less is the last sweep
  static constexpr std::uint32_t kMostMet = 8;  // bodies that a wheel looks at for ground
  static constexpr std::uint32_t kNone = ~0u;
  static constexpr int kMostLooks = 8;        // along the way of a step: half a radius apart up to four radii
  static constexpr S kLevel = S(1.0 / 64);    // [1] of the radius: the ground is a plane that differs by no more
  static constexpr S kAround = S(0.125);      // [m] what sub-steps make of a way that velocities do not tell
  static constexpr U kLeastFacing = U(0.25);  // [1] cosine of the plane's tilt, seen from the suspension

  /// The place of a wheel's suspension.
  struct Stance {
    Vec3<S> hard_point;  // [m] world
    Vec3<U> down;        // [1] world
  };
  /// The way of the sphere that looks for ground: from a radius above the highest to a radius below the lowest that the
  /// wheel's middle gets.
  struct Search {
    Vec3<S> start, way;  // [m] world
    Aabb<S> box;         // [m] world, around it
  };
  /// The ground that a wheel stands on.
  struct Ground {
    BodyId body = {};         // null: no ground
    std::uint32_t child = 0;  // of its shape
    Vec3<S> point = {};       // [m] world
    Vec3<U> normal = {};
  };
  /// A wheel in this step.
  struct Run {
    std::uint32_t slot, row, ground;  // of its record; of SolverBodies
    std::uint32_t partner;            // of the anti-roll bar, by run; kNone
    std::uint32_t vehicle;            // slot of its record; kNone
    std::uint32_t group;              // that it is of
    BodyId met;                       // null: no ground
    bool uneven;                      // no plane for the whole step: it is looked for in every sub-step
    Vec3<S> point;                    // [m] of the ground as the step began, world
    Vec3<S> ground_arm;               // [m] that from the ground's centre of mass
    Vec3<U> normal;                   // [1]
    Vec3<U> axle;                     // [1] body frame, steered
    S mu_along, mu_across;            // [1] of tyre and ground, at no slip
    S anti_roll;                      // [N/m]
    std::uint32_t leader, next;       // of its track, by run: itself without one; kNone
    S to_leader;                      // [1] turns of the leader's axle by its own: 1 without a track
    detail::WheelSpin<S> spin;        // of the leader: what all of them share
    S inertia;                        // [kg m^2] likewise, about the leader's axle
    S drive;                          // [1] likewise: turns of the engine's shaft by one of that axle
    S side;                           // [1] likewise: what steering makes of that: 1, or VehicleSettings::track_steer
    bool driven;                      // likewise
    S angle, steered, length;         // [rad], [rad], [m]
    // As the sub-step finds it.
    bool touches;
    Vec3<S> at;  // [m] world
    Row up, along, across;
    S lean;  // [1] length by distance from the ground: 1 or more
    detail::Strut<S> strut;
    S grip_along, grip_across;  // [1] mu at the slip of the sub-step before
    S slip;                     // [1] WheelState::slip
    V load, push_along, push_across;
  };
  /// An engine behind a clutch, in this sub-step.
  struct Engine {
    S inertia;  // [kg m^2] 0: there is none
    S most;     // [N m] that the clutch can bear
    S free;     // [rad/s] the engine's speed without what the clutch bears
    S spin;     // [rad/s] with it
    S clutch;   // [N m] that it bears, on the gears
  };
  /// What the wheels turn: the shaft of the engine, or the clutch's disc.
  struct Shaft {
    S speed;  // [rad/s]
    S give;   // [1/(kg m^2)] its change by a unit of angular impulse
  };
  /// The wheels of one body.
  struct Group {
    std::uint32_t row, first, end, vehicle;
    Aabb<S> region;                      // [m] world, of which all ground is known
    std::uint32_t first_near, end_near;  // of near_
    bool geared;                         // some wheel is driven, and the gear is not neutral
    Engine engine;
    bool ends_early;  // nothing but its own wheels changes what they find
    bool changed;     // by the last sweep
    bool done;        // in this pass
  };

  // wheel_ground.inl
  void list_runs();
  void list_groups();
  Group* group_of(std::uint32_t row);
  void find_who_ends_early();
  void join_bars(const Group& group);
  void steer(const Group& group);
  void find_ground(Group& group);
  void follow_ground();
  template <class Hits> static Ground first_that_bears(const Hits& hits, Vec3<U> down);
  Stance stance_of(const Run& run) const;
  Search search_of(const Run& run, const Stance& at) const;
  void look_around(Group& group, const Aabb<S>& box);
  Ground ground_below(const Run& run, const Stance& at);
  void stand_on(Run& run, const Ground& ground);
  S length_over(const Run& run, const Stance& at, const Ground& ground) const;
  Vec3<S> way_of(const Run& run, const Stance& at) const;
  bool is_uneven(const Run& run, const Stance& at, const Ground& ground);
  bool bears(std::uint32_t body, std::uint32_t ground) const;
  // vehicle_rows.inl
  const WheelSettings<S>& wheel(const Run& run) const { return state_.records->wheels.all()[run.slot]; }
  // Of a group that has one.
  const VehicleSettings<S>& vehicle(const Group& group) const { return state_.records->vehicles.all()[group.vehicle]; }
  const VehicleInput<S>& input(const Group& group) const { return state_.parts.vehicle_inputs[group.vehicle]; }
  bool leads(const Run& run) const { return &runs_[run.leader] == &run; }
  static ISO_INLINE S times(S a, S b) { return saturate_to<S>(product(a, b)); }
  void place(Run& run, const Mat3<U>& turn);
  void compress(Run& run, S length) const;
  V speed_of(const Run& run, const Row& row, const MotionRow<V>& body) const;
  V without(const Run& run, const Row& row, V impulse, const MotionRow<V>& body) const;
  void move(const Run& run, const Row& row, MotionRow<V>& body, V impulse);
  V least_push(const Run& run) const;
  void press(Run& run, MotionRow<V>& body);
  void grip(Run& run, MotionRow<V>& body);
  bool closes_errors(const Group& group) const;
  void sweep();
  bool sweep(Run& run);
  void turn_wheel(Run& run) const;
  S slip_of(const Run& run) const;
  // wheel_tracks.inl
  void join_tracks(const Group& group);
  void join(Run& leader, Run& run) const;
  detail::WheelSpin<S> spin_of(const Run& run) const;
  V end_of(const Run& run) const;
  S side_of(const Run& run, const Group& group) const;
  void gear_up(Group& group);
  // wheel_drive.inl
  void drive(Group& group);
  void set_brakes(const Group& group);
  template <class Rim> Shaft shaft_of(const Group& group, const Rim& rim_of) const;
  S engine_torque(const Group& group, const Shaft& shaft) const;
  void push_shaft(const Group& group, S torque);
  void lock(const Group& group);
  void turn(const Run& run, V& rim, S torque) const;
  // wheel_clutch.inl
  void begin_engine(Group& group) const;
  void turn_engine(Group& group);
  S spun(const Engine& engine, S speed, S torque) const;
  void bear(Group& group, S torque);
  void engage(Group& group);
  void end_engines();

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  FaultLog faults_;  // of queries that are refused
  Queries<S> queries_;
  std::vector<Run> runs_;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> first_;  // by row: where its wheels begin
  std::vector<std::uint32_t> order_;  // of runs: the first wheels of all bodies, then the second, and so on
  std::vector<std::uint32_t> near_;   // slots of what wheels might stand on, body by body
  SolverBodies<S>* bodies_ = nullptr;
  bool relaxes_ = false;  // and pushes nothing out of the end of its travel
  std::int32_t rate_ = 1;
  Step<S> h_ = {};
  Softness<S> stop_softness_ = Softness<S>::rigid();  // of a strut beyond the end of its travel
};

#define ISO_VEHICLE_ROWS_OF(extern, S) extern template class VehicleRows<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_VEHICLE_ROWS_OF)

}  // namespace isostep
