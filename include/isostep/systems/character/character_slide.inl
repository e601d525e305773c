// CharacterWalk: one move among planes.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/character/character_walk.hpp"

namespace isostep {

/// The obstacles of a character, the firmest first: fixed bodies, other characters, bodies that it pushes aside.
namespace detail::obstacle {
inline constexpr std::uint8_t kFixed = 0, kWalks = 1, kDynamic = 2;
}

/// [m] Returns the travel along a direction to one skin before the hit, half of it towards another character.
template <class S> S CharacterWalk<S>::travel(const Hit& hit, const Direction<S>& along) const {
  const S cosine = -dot(convert<S>(detail::unit_of<S>(along)), hit.normal);
  const S room = along.length * hit.fraction - character_.skin / max(cosine, detail::kGrazing<S>);
  return max(walks_[hit.body.slot] == detail::obstacle::kWalks ? room * S(0.5) : room, S(0));
}

template <class S> void CharacterWalk<S>::touch(BodyId body, Vec3<S> point, Vec3<Unit<S>> normal) {
  for (const CharacterTouch<S>& known : touches()) {
    if (known.body == body) return;
  }
  if (touch_count_ < detail::kMostPlanes) touches_[touch_count_++] = {body, point, normal};
}

/// Returns the normal without its vertical part, as of a vertical wall. A nearly vertical normal stays as it is.
template <class S> Vec3<Unit<S>> CharacterWalk<S>::upright(Vec3<Unit<S>> normal) const {
  const Vec3<S> across = flat(convert<S>(normal));
  const Direction<S> d = detail::heading<S>(across);
  return d.length > detail::kGrazing<S> ? detail::unit_of<S>(d) : normal;
}

/// Clips a way to one plane, or to the edge of two. Returns zero in a corner of three, and for a way that leads back.
template <class S> Vec3<S> CharacterWalk<S>::clipped(Vec3<S> way, const Planes& planes) {
  const auto against = [&](Vec3<S> v) {
    for (int i = 0; i < planes.count; ++i) {
      if (dot(v, planes.normals[i]) < -resolution<S>() * S(4)) return true;
    }
    return false;
  };
  const auto forward = [&](Vec3<S> v) { return S(0) < dot(v, way) ? v : Vec3<S>::zero(); };
  if (!against(way)) return way;
  for (int i = 0; i < planes.count; ++i) {
    const Vec3<Unit<S>> n = planes.normals[i];
    const Vec3<S> along = way - convert<S>(n) * dot(way, n);
    if (!against(along)) return forward(along);
  }
  for (int i = 0; i < planes.count; ++i) {
    for (int j = i + 1; j < planes.count; ++j) {
      const Vec3<S> edge = convert<S>(cross(planes.normals[i], planes.normals[j]));
      const Direction<S> d = detail::heading<S>(edge);
      if (!(detail::kGrazing<S> < d.length)) continue;
      const Vec3<Unit<S>> crease = detail::unit_of<S>(d);
      const Vec3<S> along = convert<S>(crease) * dot(way, crease);
      if (!against(along)) return forward(along);
    }
  }
  return Vec3<S>::zero();
}

/// Returns a way up or down a floor that has the same horizontal part.
template <class S> Vec3<S> CharacterWalk<S>::along_floor(Vec3<S> way, Vec3<Unit<S>> normal) const {
  const S slope = dot(convert<S>(normal), up_);
  return slope < detail::kGrazing<S> ? way : way - convert<S>(up_) * (dot(way, normal) / slope);
}

/// Adds a plane to those that the move has met. Returns the way, clipped to all of them.
template <class S>
Vec3<S> CharacterWalk<S>::turned(Vec3<S> way, Vec3<S> point, Vec3<Unit<S>> normal, Gait gait, Planes& planes) const {
  const bool steep = is_steep(normal);
  planes.points[planes.count] = point;
  planes.normals[planes.count++] = steep && gait != Gait::falls ? upright(normal) : normal;
  return clipped(steep || gait != Gait::walks ? way : along_floor(way, normal), planes);
}

/// Clips a way to the planes that the character touches, without a cast, the most opposed plane first. A walking
/// character ignores floors: the edge of the next tile is near, but not in the way.
template <class S>
Vec3<S> CharacterWalk<S>::turned_by(std::span<const NearContact<S>> touching, Vec3<S> way, Gait gait, Planes& planes) {
  const Vec3<S> asked = way;
  while (planes.count < detail::kMostPlanes) {
    const NearContact<S>* first = nullptr;
    S least = -max(detail::heading<S>(way).length * detail::kGrazing<S>, detail::kLeastWay<S>);
    for (const NearContact<S>& contact : touching) {
      if (character_.skin * detail::kTouchingSkins<S> < separation_of(contact)) continue;
      const bool steep = is_steep(contact.normal);
      if (gait == Gait::walks && !steep) continue;
      S into = dot(way, contact.normal);
      if (steep && gait != Gait::falls) into = max(into, dot(way, upright(contact.normal)));
      if (into < least) least = into, first = &contact;
    }
    if (first == nullptr) return way;
    touch(first->body, first->point, first->normal);
    way = turned(way, first->point, first->normal, gait, planes);
    if (!(S(0) < dot(way, asked))) return Vec3<S>::zero();
  }
  return Vec3<S>::zero();
}

template <class S>
auto CharacterWalk<S>::slide(Vec3<S> way, Gait gait, std::span<const NearContact<S>> touching) -> Planes {
  Planes planes;
  const Vec3<S> asked = way;
  way = turned_by(touching, way, gait, planes);
  for (int casts = 0; casts < detail::kMostSlides && planes.count < detail::kMostPlanes; ++casts) {
    const Direction<S> along = detail::heading<S>(way);
    if (!(detail::kLeastWay<S> < along.length)) break;
    // The cast reaches two skins beyond the way's end: an obstacle is met a skin before.
    const Direction<S> reach = {along.x, along.y, along.z, along.length + S(2) * character_.skin};
    const std::optional<Hit> hit = cast(detail::along<S>(reach, reach.length));
    const S gone = hit ? min(travel(*hit, reach), along.length) : along.length;
    at_ += detail::along<S>(along, gone);
    if (!(gone < along.length)) break;
    touch(hit->body, hit->point, hit->normal);
    way = turned(detail::along<S>(along, along.length - gone), hit->point, hit->normal, gait, planes);
    if (!(S(0) < dot(way, asked))) break;  // it would come back: corners do not shiver
  }
  return planes;
}

/// Returns true if the hit is walkable. An edge looks steep to a round shape: then the face a little further in counts.
template <class S> bool CharacterWalk<S>::is_walkable(const Hit& hit) {
  if (!is_steep(hit.normal)) return true;
  const Vec3<S> across = flat(convert<S>(hit.normal));
  const Direction<S> out = detail::heading<S>(across);
  const S in = S(2) * character_.skin;
  const Vec3<S> lift = convert<S>(up_) * in;
  const Vec3<S> above = hit.point - detail::along<S>(out, in) + lift;
  const std::optional<Vec3<Unit<S>>> face = around_.cast_ray(above, lift * S(-2));
  return face && !is_steep(*face);
}

}  // namespace isostep
