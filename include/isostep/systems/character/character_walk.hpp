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
/// [m] The way a step by which it leaves an overlap, besides that of its ground.
template <class S> inline constexpr S kMostWayOut = S(0.125);
/// [m] A shorter way is rounding.
template <class S> inline constexpr S kLeastWay = S(0x1p-16);
/// [1] The least cosine by which a skin counts along a way.
template <class S> inline constexpr S kGrazing = S(0.125);
/// [1] The part of a skin within which contacts touch.
template <class S> inline constexpr S kTouchingSkins = S(1.0625);
/// [m] The gain of way on from which a step up is worth taking.
template <class S> inline constexpr S kWorthAStep = S(0x1p-10);
/// [1] The least sine of the angle between two planes that have an edge.
template <class S> inline constexpr S kLeastEdge = S(1.0 / 64);
/// [1] The part of a way of one metre into a plane that is rounding.
template <class S> inline constexpr S kPlaneSlack = S(0x1p-10);
/// [1] The cosine of the angle between normals of one plane.
template <class S> inline constexpr S kOnePlane = S(1 - 0x1p-12);
/// [m] The height above step_height that is rounding.
template <class S> inline constexpr S kStepSlack = S(0x1p-11);

/// The direction [1], and `size` [m] along it.
template <class S> ISO_INLINE Vec3<Unit<S>> unit_of(const Direction<S>& d) { return {d.x, d.y, d.z}; }
template <class S> ISO_INLINE Vec3<S> along(const Direction<S>& d, S size) {
  return {size * d.x, size * d.y, size * d.z};
}
template <class S> ISO_INLINE Direction<S> heading(Vec3<S> v) { return direction_of(v.x, v.y, v.z); }
}  // namespace detail

/// A character as a step moves it: what it is, what it is to do, how it was left. The walk writes the last two.
template <class S> struct Walker : CharacterSettings<S>, CharacterInput<S>, CharacterState<S> {};

/// A body that a character met and may push.
template <class S> struct CharacterTouch {
  BodyId body;
  Vec3<S> point;         // [m] world
  Vec3<Unit<S>> normal;  // [1] towards the character
};

/// The memory that walks use again, one after the other.
template <class S> struct WalkMemory {
  std::vector<NearContact<S>> contacts, first;  // as they are now, and as they were at the first look
};

/// Input:   a character, its body's pose, what is around it. Output: the character as the step leaves it, way(), what
///          it touched on its way.
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

  /// `carried` [m]: how far the ground under its foot has moved.
  void run(Vec3<S> carried);

  ISO_INLINE Vec3<S> way() const { return at_ - start_; }
  ISO_INLINE std::span<const CharacterTouch<S>> touches() const { return {touches_, touch_count_}; }
  /// [m] The foot's point on the ground, world.
  ISO_INLINE Vec3<S> foot() const { return foot_; }

 private:
  using Hit = ObstacleHit<S>;
  /// Planes that a move has met.
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
  /// Moves along `way` as far as it goes. A character that does not fall finds slopes upright that are too steep; one
  /// that walks goes up the others as fast as on the level.
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
