// ContinuousCollision<S>: fast bodies do not pass what a step would carry them through.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/collision/continuous/core_motion.hpp"
#include "isostep/collision/continuous/shape_impact.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/kind_table.hpp"
#include "isostep/dynamics/records/one_way.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/systems/continuous/joined_bodies.hpp"

namespace isostep {

/// The rules of a step that a fast body heeds. Null tables are empty ones.
template <class S> struct ImpactRules {
  const Ways<S>* ways = nullptr;                // what they let pass they do not stop
  const ResponseTable<S>* responses = nullptr;  // what does not push back, or no harder than it may, does not stop
  const GhostTable<S>* ghosts = nullptr;        // kinds that pass each other
};

/// Input:   the state after the solver, with fat boxes; the centres' poses as the step began; the pairs of bodies that
///          joints keep from colliding.
/// Output:  poses of fast bodies that would have passed something, put back to where they first touch it, with their
///          fat boxes; the broad phase knows of them. Velocities stay: the next step finds the contact.
/// Keeps:   nothing but memory.
/// Method:  1. Dynamic bodies that move by more than half of the inner radii of their part and of the other one (which
///             counts as 1 m at most) are swept against static and kinematic bodies, turns included; so is what
///             a fast kinematic body meets. Who moves less is pushed out the way that it came, so it is swept only if
///             it ends deep inside of what is fixed: by more than kTooDeep.
///          2. Bullets are swept against the motions that all this left of other dynamic bodies but bullets, if they
///             move against each other by more than half the bullet's inner radius. What one stops goes on with it to
///             the end of the step, up to what is fixed. Nobody reads what another writes, so the order is free.
///          Of all impacts of a body the earliest counts; ties go to the lowest slot, then part. What hits a kinematic
///          body is swept in that one's frame and goes on with it to the end of the step.
///          3. Mechanisms of which a body was stopped stop as a whole (continuous_joined.inl): each joint goes from how
///             it was to how it would be as far as that body did of its way, and bodies are where joints have them,
///             from the heaviest outwards, but none further from its own way than that is long.
///             Points that joints hold together are closed.
/// Touch:   a body that touches at the start is swept as a smaller one, deeper inside of it: an impact at time 0 is no
///          reason to let the rest of it pass. Touching less deep than that of the first of them is not cut. What slips
///          deeper where it was stopped goes on: see free_way().
/// Limits:  two bodies may squeeze a third.
template <class S> class ContinuousCollision {
 public:
  ISO_INLINE ContinuousCollision(WorldState<S>& state, const BodyMap<S>& map, Proxies<S>& proxies)
      : state_(state), map_(map), proxies_(proxies), joined_bodies_(state, map) {}

  void update(std::span<const Pose<S>> start, std::span<const std::uint64_t> joined, const ImpactRules<S>& rules = {});

 private:
  /// A body's way: that of its centre at constant speed, its turns in pieces of less than half a turn each.
  struct Path {
    static constexpr std::uint32_t kMostPieces = 4;
    std::uint32_t pieces;
    Pose<S> poses[kMostPieces + 1];
  };
  /// A fast body.
  struct Mover : Path {
    std::uint32_t index;  // among the awake ones
    S inner;              // [m] least inner radius of its parts
    S reach;              // [m] no point of it is further from its centre of mass
    S motion;             // [m] no point of it has moved further
    Aabb<S> around;       // [m] from its centre, all of it wherever it is on its way
    Unit<S> fraction;     // [1] what it was cut to
    Vec3<S> centre;       // [m] in its frame: what goes straight in the first piece, where it touches at the start
    bool closely;         // swept at what is thin however little it moves
    bool deep;            // ends deep in something fixed: swept at that, however thick both are
    Pose<S> stopped;      // where it is at that fraction, if something stopped it, with what stopped it

    ISO_INLINE CoreMotion<S> motion_of(std::uint32_t piece) const {
      return {this->poses[piece], this->poses[piece + 1], piece == 0 ? centre : Vec3<S>::zero()};
    }
    ISO_INLINE const Pose<S>& from() const { return this->poses[0]; }
    ISO_INLINE const Pose<S>& to() const { return this->poses[this->pieces]; }
    ISO_INLINE Aabb<S> swept() const {
      return {min(from().position, to().position) + around.low, max(from().position, to().position) + around.high};
    }
  };
  /// The end of a motion.
  struct Cut {
    Unit<S> fraction;  // [1]
    Pose<S> pose;      // of the centre of mass
    // The end of a part's middle, which is stopped alone.
    Unit<S> fraction_of_middle;  // [1]
    Vec3<S> middle, place;       // [m] in the body's frame, and in the world where it is stopped
    Vec3<Unit<S>> normal;        // [1] where it may not go on; zero: where a kinematic body stops it

    ISO_INLINE bool is_before(Unit<S> other) const { return fraction < other || fraction_of_middle < other; }
    void add(const FreeWay<S>& way, Unit<S> all, const Pose<S>& there, bool at_rest);
  };
  /// The body that another is swept against, in a frame that is the world's or a kinematic body's.
  struct Obstacle {
    std::uint32_t slot;
    CoreMotion<S> motion;  // of the piece; its start is its end: at rest
    S moved;               // [m] no point of it moves further, in the frame
    S relative_motion;     // [m] no two points of the body and of it move further against each other
    const Pose<S>* end;    // at the end of the step, in the world: what it stops goes on with it; null: it stays

    /// The pose in the world, at the end of the step, of what was at `there`, in the frame, after the fraction.
    ISO_INLINE Pose<S> carried(const Pose<S>& there, Unit<S> fraction) const;
  };
  /// A part of the step as pieces count it.
  struct Piece {
    std::uint32_t index, count;
  };
  /// A fast kinematic body.
  struct Carrier {
    std::uint32_t slot;
    Aabb<S> swept;
  };
  /// The least of all values that the filter of bodies has to know.
  struct Survey {
    S thinnest;  // [m] inner radius of what stops a body, up to kThick
    bool bullets, kinematic;
  };

  ISO_INLINE Pose<S> now(std::size_t index) const {
    return {state_.awake.states[index].centre, state_.awake.states[index].orientation};
  }
  ISO_INLINE bool is_bullet(std::size_t index) const {
    return (state_.awake.properties[index].flags & body_flag::kBullet) != 0;
  }
  static constexpr std::uint32_t kAsked = 1, kDeepInside = 2;  // of mover_of_, before there are movers
  // continuous_movers.inl
  Path path_of(std::size_t index) const;
  Survey survey() const;
  S thinnest_static() const;
  std::uint64_t thinnest_of_page(std::size_t page) const;
  void find_movers(const Survey& survey);
  void leave_out_joined();
  void mark_deep(std::span<const std::uint32_t> asked);
  bool is_deep_in(std::uint32_t index, std::uint32_t slot, const Aabb<S>& box) const;
  bool may_move(std::size_t index) const;
  void add_if_fast(std::size_t index, S thinnest);
  Mover measure(std::size_t index) const { return measure(index, path_of(index)); }
  Mover measure(std::size_t index, const Path& path) const;
  void find_met_by_kinematic(S least);
  void find_bullets();
  void find_comers();
  // continuous_rules.inl
  bool may_stop(const Mover& mover, std::uint32_t slot, bool moving) const;
  bool is_let_out(const Mover& mover, std::uint32_t slot) const;
  bool is_pushed_back(const Mover& mover, std::uint32_t own, std::uint32_t slot, std::uint32_t other) const;
  bool are_ghosts(const Mover& mover, std::uint32_t slot) const;
  bool is_passed(const Mover& mover, const PlacedShape<S>& part, const Pose<S>& there, const PlacedShape<S>& obstacle,
                 const Obstacle& body, Unit<S> fraction) const;
  // continuous_collision.inl
  void cut(Mover& mover, bool moving);
  void cut_bullet(Mover& mover);
  void stop_at_what_is_fixed(std::uint32_t index, const Pose<S>& from);
  Cut first_impact(Mover& mover, bool moving);
  Pose<S> way_of(const Mover& mover, Unit<S> fraction) const;
  Pose<S> pose_on(const Path& path, Vec3<S> centre, Unit<S> fraction) const;
  CoreMotion<S> motion_in(const Path& path, Piece piece, Vec3<S> centre) const;
  Cut sweep(const Mover& mover) const;
  bool find_touch(Mover& mover) const;
  void put_at(std::uint32_t index, const Pose<S>& pose);
  void place(std::uint32_t index);
  void stop_middle(BodyState<S>& state, const Cut& cut, bool moving) const;
  void find_obstacles(const Mover& mover, bool moving);
  // continuous_sweeps.inl
  void sweep_against(const Mover& mover, std::uint32_t slot, Cut& cut) const;
  void sweep_against_moving(const Mover& mover, std::uint32_t slot, std::size_t index, Cut& cut) const;
  void sweep_against_kinematic(const Mover& mover, std::uint32_t slot, std::size_t index, Cut& cut) const;
  template <class Visit>
  void visit_parts(const Mover& mover, const CoreMotion<S>& motion, const Obstacle& obstacle, const Visit& visit) const;
  bool ends_deep(const PlacedShape<S>& part, const CoreMotion<S>& motion, const PlacedShape<S>& obstacle,
                 const Obstacle& body) const;
  void sweep_piece(const Mover& mover, Piece piece, const CoreMotion<S>& motion, const Obstacle& obstacle,
                   Cut& cut) const;
  // continuous_joined.inl
  using Link = typename JoinedBodies<S>::Link;
  /// The body of a mechanism that says how far all of it goes.
  struct Leader {
    std::uint32_t body;
    Unit<S> fraction;  // [1] of the step
  };
  /// The poses of an end of a joint: as the step began, where the solver left it, and now.
  struct Carriage {
    Pose<S> start, end, now;
  };
  struct Obstruction {
    std::uint32_t body;
    Unit<S> part;  // [1] of its way to where it was placed
  };
  void stop_joined();
  void stop_mechanism(std::span<const std::uint32_t> mechanism);
  void keep_ends(std::span<const std::uint32_t> mechanism);
  Leader leader_of(std::span<const std::uint32_t> mechanism) const;
  bool meets_carrier(std::span<const std::uint32_t> mechanism) const;
  void place_tree(std::span<const Link> tree, Unit<S> fraction, bool closes);
  Pose<S> own_way(std::uint32_t body, Unit<S> fraction);
  Pose<S> joined_pose(const Link& link, Unit<S> fraction, bool closes);
  bool turns_far(std::uint32_t slot) const;
  Carriage carriage_of(std::uint32_t slot, const Pose<S>& frame) const;
  Pose<S> held_by_locks(std::uint32_t index, const Pose<S>& there, const Pose<S>& frame) const;
  Unit<S> free_part(std::uint32_t body);
  Obstruction worst_of(std::span<const Link> tree);

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  Proxies<S>& proxies_;
  std::span<const Pose<S>> start_;  // for one update
  std::span<const std::uint64_t> joined_;
  ImpactRules<S> rules_;  // null: none
  std::vector<Mover> movers_;
  std::vector<Carrier> carriers_;
  AabbTree<S> comers_;              // who may meet a bullet where its fat box is not: boxes around their ways, by slot
  std::vector<std::uint32_t> met_;  // by fast kinematic bodies: indices among the awake ones
  std::vector<std::uint32_t> obstacles_, sort_scratch_;  // slots, ascending
  JoinedBodies<S> joined_bodies_;
  // These go by index among the awake bodies.
  std::vector<std::uint32_t> mover_of_;  // in movers_, plus 1; 0: none
  std::vector<Pose<S>> ends_;            // of a mechanism's bodies: where the solver left them
};

#define ISO_CONTINUOUS_COLLISION_OF(extern, S) extern template class ContinuousCollision<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_CONTINUOUS_COLLISION_OF)

}  // namespace isostep
