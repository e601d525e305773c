// CharacterWalk<S>: where a character goes in one step, by casts of its shape among bodies that stand still.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "isostep/dynamics/records/character.hpp"
#include "isostep/query/surroundings.hpp"

namespace isostep {

namespace detail {
inline constexpr int kMostSlides = 5;   // casts of a move
inline constexpr int kMostPlanes = 8;   // that a move runs along
inline constexpr int kMostWaysOut = 8;  // moves out of an overlap, of each look at what is near
inline constexpr int kMostLooks = 3;    // at what is near, on a way out
/// [m] The most that a step moves a character out of overlaps, beside the motion of its ground.
template <class S> inline constexpr S kMostWayOut = S(0.125);
/// [m] The shortest way that is more than rounding.
template <class S> inline constexpr S kLeastWay = S(0x1p-16);
/// [1] The cosine between a way and a normal below which the way grazes the plane.
template <class S> inline constexpr S kGrazing = S(0.125);
/// [1] The distance in skins within which a contact touches.
template <class S> inline constexpr S kTouchingSkins = S(1.0625);
/// [m] The least progress for which a character takes a step up.
template <class S> inline constexpr S kWorthAStep = S(0x1p-10);
/// [1] The least sine of the angle between two planes that form an edge.
template <class S> inline constexpr S kLeastEdge = S(1.0 / 64);
/// [1] The part of a unit way into a plane that counts as rounding.
template <class S> inline constexpr S kPlaneSlack = S(0x1p-10);
/// [1] The cosine above which two normals belong to one plane.
template <class S> inline constexpr S kOnePlane = S(1 - 0x1p-12);
/// [m] The excess over step_height that counts as rounding.
template <class S> inline constexpr S kStepSlack = S(0x1p-11);

/// Returns the direction as a unit vector [1], and the vector of length `size` [m] along it.
template <class S> ISO_INLINE Vec3<Unit<S>> unit_of(const Direction<S>& d) { return {d.x, d.y, d.z}; }
template <class S> ISO_INLINE Vec3<S> along(const Direction<S>& d, S size) {
  return {size * d.x, size * d.y, size * d.z};
}
template <class S> ISO_INLINE Direction<S> heading(Vec3<S> v) { return direction_of(v.x, v.y, v.z); }
}  // namespace detail

/// A character during a step: its settings, its input and its state. The walk writes the last two.
template <class S> struct Walker : CharacterSettings<S>, CharacterInput<S>, CharacterState<S> {};

/// A body that a character touched and may push.
template <class S> struct CharacterTouch {
  BodyId body;
  Vec3<S> point;         // [m] world
  Vec3<Unit<S>> normal;  // [1] towards the character
};

/// Scratch memory, which walks use one after another.
template <class S> struct WalkMemory {
  std::vector<NearContact<S>> contacts, first;  // as they are now, and as they were at the first look
};

/// Input:   a character, its body's pose, its surroundings. Output: the character as the step leaves it, way(), the
///          bodies that it touched on its way.
template <class S> class CharacterWalk {
 public:
  struct Place {
    Vec3<S> at;  // [m] of the body's origin
    S below;     // [m] from there down to the lowest point of the shape
    Vec3<Unit<S>> up;
    Vec3<S> gravity;
    std::int32_t hz;
  };
  CharacterWalk(Surroundings<S>& around, const Place& place, std::span<const std::uint8_t> walks, WalkMemory<S>& memory,
                Walker<S>& character);

  /// `carried` [m]: the motion of the ground under its foot in the step.
  void run(Vec3<S> carried);

  ISO_INLINE Vec3<S> way() const { return at_ - start_; }
  ISO_INLINE std::span<const CharacterTouch<S>> touches() const { return {touches_, touch_count_}; }
  /// [m] The point of the ground below the foot, world.
  ISO_INLINE Vec3<S> foot() const { return foot_; }

 private:
  using Hit = ObstacleHit<S>;
  /// The planes that a move has met.
  struct Planes {
    Vec3<Unit<S>> normals[detail::kMostPlanes];
    Vec3<S> points[detail::kMostPlanes];  // [m] of what was met, world
    int count = 0;
  };
  // character_walk.inl
  void look_around(Vec3<S> carried);
  void leave_overlaps(S most);
  bool move_out(std::uint8_t least_firm, S most);
  bool push_out(std::uint8_t least_firm);
  void look_for_contacts();
  S separation_of(const NearContact<S>& contact) const {
    return contact.separation + dot(at_ - contacts_at_, contact.normal);
  }
  Vec3<S> speed_of(Vec3<S> way) const;
  void set_velocity(Vec3<S> velocity);
  void take_off(Vec3<S> carried);
  void fall();
  void fly();
  void walk();
  S rise_of(Vec3<S> from) const;
  bool is_blocked_by_steps(const Planes& planes, Vec3<S> from) const;
  bool step_up(Vec3<S> from, Vec3<S> way);
  void find_ground(bool walks, Vec3<S> carried);
  void stand_on(const Hit& hit, S gap);
  bool supports(const NearContact<S>& contact) const;
  bool has_supports() const;
  Vec3<S> slide_of(const Planes& planes) const;
  bool stand_between();

  // character_slide.inl
  std::optional<Hit> cast(Vec3<S> way) { return around_.cast(at_, way); }
  S travel(const Hit& hit, const Direction<S>& along) const;
  /// Moves along `way` as far as possible. Unless a character falls, steep slopes act as vertical walls. A walking one
  /// keeps its horizontal speed on all other slopes.
  enum class Gait { falls, rises, walks };
  Planes slide(Vec3<S> way, Gait gait, std::span<const NearContact<S>> touching);
  Vec3<S> turned_by(std::span<const NearContact<S>> touching, Vec3<S> way, Gait gait, Planes& planes);
  Vec3<S> turned(Vec3<S> way, Vec3<S> point, Vec3<Unit<S>> normal, Gait gait, Planes& planes) const;
  bool is_steep(Vec3<Unit<S>> normal) const { return dot(convert<S>(normal), up_) < character_.least_up; }
  Vec3<S> along_floor(Vec3<S> way, Vec3<Unit<S>> normal) const;
  void touch(BodyId body, Vec3<S> point, Vec3<Unit<S>> normal);
  bool is_walkable(const Hit& hit);
  Vec3<S> flat(Vec3<S> v) const { return v - convert<S>(up_) * dot(v, up_); }
  Vec3<Unit<S>> upright(Vec3<Unit<S>> normal) const;
  static Vec3<S> clipped(Vec3<S> way, const Planes& planes);

  Surroundings<S>& around_;
  Place place_;
  std::span<const std::uint8_t> walks_;  // by body slot: of obstacle
  WalkMemory<S>& memory_;
  Walker<S>& character_;
  Vec3<S> start_, at_;   // [m] of the body's origin
  Vec3<S> contacts_at_;  // [m] likewise, where memory_.contacts were found
  Vec3<S> foot_;
  S floor_ = S(0);  // [m] height of what it stands on, as the step begins
  Vec3<Unit<S>> up_;
  Step<S> h_;
  CharacterTouch<S> touches_[detail::kMostPlanes];
  std::size_t touch_count_ = 0;
};

}  // namespace isostep
