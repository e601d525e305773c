// Bodies of character_walk.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/systems/character/character_slide.inl"

namespace isostep {

template <class S>
CharacterWalk<S>::CharacterWalk(Surroundings<S>& around, const Place& place, std::span<const std::uint8_t> walks,
                                WalkMemory<S>& memory, Walker<S>& character)
    : around_(around),
      place_(place),
      walks_(walks),
      memory_(memory),
      character_(character),
      start_(place.at),
      at_(place.at),
      contacts_at_(place.at),
      foot_(place.at),
      up_(place.up),
      h_(divide_to<Step<S>>(S(1), S(place.hz))) {}

template <class S> void CharacterWalk<S>::run(Vec3<S> carried) {
  const bool stood = character_.footing == Footing::floor;
  if (stood) at_ += carried;
  const bool was_put = stood && !character_.ground;  // by a command
  floor_ = was_put ? dot(at_, up_) - place_.below : dot(character_.foot_at + carried, up_);
  look_around(carried);
  leave_overlaps(detail::kMostWayOut<S> + max_abs(carried));
  const bool jumps = stood && S(0) < character_.jump, walks = stood && !jumps;
  if (jumps) take_off(carried);
  if (walks) {
    walk();
  } else {
    fall();
    fly();
  }
  find_ground(walks, carried);
}

/// Gathers the surroundings that, as a rule, hold all casts of the step.
template <class S> void CharacterWalk<S>::look_around(Vec3<S> carried) {
  const S out = detail::kMostWayOut<S> + S(4) * character_.skin;
  const bool stood = character_.footing == Footing::floor;
  const S over = stood ? character_.step_height + character_.skin : S(0);
  const Vec3<S> way = abs(stood ? character_.move : character_.velocity) * h_;
  const Vec3<S> reach = way + abs(carried) + convert<S>(abs(up_)) * over + Vec3<S>{out, out, out};
  around_.gather(reach);
}

template <class S> void CharacterWalk<S>::look_for_contacts() {
  around_.find_contacts(at_, character_.skin * detail::kTouchingSkins<S>, memory_.contacts);
  contacts_at_ = at_;
}

/// Pushes the character out of the planes of near contacts, the deepest first. Returns false if it is not out of all. A
/// convex obstacle stays behind its plane wherever the character goes. Another character moves too, so half is enough.
template <class S> bool CharacterWalk<S>::push_out(std::uint8_t least_firm) {
  for (int way = 0; way < detail::kMostWaysOut; ++way) {
    const NearContact<S>* deepest = nullptr;
    for (const NearContact<S>& contact : memory_.contacts) {
      if (least_firm < walks_[contact.body.slot]) continue;
      if (deepest == nullptr || separation_of(contact) < separation_of(*deepest)) deepest = &contact;
    }
    if (deepest == nullptr || character_.skin * S(0.5) <= separation_of(*deepest)) return true;
    const S missing = character_.skin - separation_of(*deepest);
    const bool gives_way = walks_[deepest->body.slot] == detail::obstacle::kWalks;
    at_ += convert<S>(deepest->normal) * (gives_way ? missing * S(0.5) : missing);
  }
  return false;
}

/// Returns true once the character overlaps no obstacle of that firmness. Needs the contacts of the first look.
template <class S> bool CharacterWalk<S>::move_out(std::uint8_t least_firm, S most) {
  const Vec3<S> begin = at_;
  for (int look = 0;;) {
    const Vec3<S> before = at_;
    const bool is_out = push_out(least_firm);
    if (is_out && at_ == before) return true;
    const Direction<S> gone = detail::heading<S>(at_ - begin);
    if (most < gone.length) {
      at_ = begin + detail::along<S>(gone, most);
      return false;
    }
    if (++look == detail::kMostLooks) return false;
    look_for_contacts();
  }
}

/// Leaves overlaps. If there is no room beside dynamic bodies, ignores them: the character's body pushes them out as
/// well. If there is none beside other characters either, leaves at least the fixed bodies.
template <class S> void CharacterWalk<S>::leave_overlaps(S most) {
  const Vec3<S> begin = at_;
  look_for_contacts();
  memory_.first = memory_.contacts;
  if (move_out(detail::obstacle::kDynamic, most)) {
    character_.stuck = 0;
    return;
  }
  ++character_.stuck;
  at_ = contacts_at_ = begin;
  memory_.contacts = memory_.first;
  if (move_out(detail::obstacle::kWalks, most)) return;
  look_for_contacts();
  move_out(detail::obstacle::kFixed, most);
}

/// [m/s] The velocity of a motion [m] in one step, within its limit: a command may move the ground by any distance.
template <class S> Vec3<S> CharacterWalk<S>::speed_of(Vec3<S> way) const {
  const S hz = S(place_.hz);
  return held_within(way, Limits<S>::speed() / hz) * hz;
}
template <class S> void CharacterWalk<S>::set_velocity(Vec3<S> velocity) {
  character_.velocity = held_within(velocity, Limits<S>::speed());
}

/// Jumps, and keeps the velocity of the ground.
template <class S> void CharacterWalk<S>::take_off(Vec3<S> carried) {
  set_velocity(flat(character_.move) + speed_of(carried) + convert<S>(up_) * character_.jump);
  character_.jump = S(0);
  character_.footing = Footing::airborne;
}

template <class S> void CharacterWalk<S>::fall() {
  Vec3<S>& velocity = character_.velocity;
  velocity += place_.gravity * character_.gravity_scale * h_;
  const Vec3<S> wanted = flat(character_.move);
  // Nobody steers up a slope that is too steep, and to stand still is no way to hold on to it.
  const bool steers = character_.footing != Footing::steep || S(0) < dot(wanted, character_.normal);
  const Direction<S> lacks = detail::heading<S>(wanted - flat(velocity));
  if (steers) velocity += detail::along<S>(lacks, min(lacks.length, character_.air_acceleration * h_));
  velocity = held_within(velocity, Limits<S>::speed() * S(0.5));
}

template <class S> void CharacterWalk<S>::fly() {
  const Planes planes = slide(character_.velocity * h_,
                              dot(character_.velocity, up_) < S(0) ? Gait::falls : Gait::rises, memory_.contacts);
  character_.velocity = clipped(character_.velocity, planes);
}

/// Walks along the ground with the horizontal speed that is asked for. Steps up if a step blocks it.
template <class S> void CharacterWalk<S>::walk() {
  const Vec3<S> ahead = flat(character_.move) * h_, from = at_;
  const Planes planes = slide(along_floor(ahead, character_.normal), Gait::walks, memory_.contacts);
  if (S(0) < character_.step_height && is_blocked_by_steps(planes, from)) step_up(from, ahead);
}

/// [m] The height that a step up lifts it. The lowest point of a round shape on an edge is below the edge.
template <class S> S CharacterWalk<S>::rise_of(Vec3<S> from) const {
  const S sunk = max(floor_ - dot(from, up_) + place_.below, S(0));
  return character_.step_height + sunk + character_.skin;
}

/// Returns true if a steep obstacle would be further away one step higher. A wall or another character would not: where
/// it was met it is in the way up there too and, since both shapes are convex, at every height between.
template <class S> bool CharacterWalk<S>::is_blocked_by_steps(const Planes& planes, Vec3<S> from) const {
  const Vec3<S> lift = convert<S>(up_) * rise_of(from);
  for (int i = 0; i < planes.count; ++i) {
    if (!is_steep(planes.normals[i])) continue;
    const S here = around_.distance(at_, planes.points[i]), higher = around_.distance(at_ + lift, planes.points[i]);
    if (here + detail::kWorthAStep<S> < higher) return true;
  }
  return false;
}

/// Steps up, forward and down. Keeps the step if it ends on a floor, no higher than a step, and further on.
template <class S> bool CharacterWalk<S>::step_up(Vec3<S> from, Vec3<S> way) {
  const Vec3<S> reached = at_;
  const std::size_t touched = touch_count_;
  const auto take_back = [&] {
    at_ = reached;
    touch_count_ = touched;
    return false;
  };
  const auto move_along_up = [&](S by) {
    const Vec3<S> lift = convert<S>(up_) * by;
    const std::optional<Hit> hit = cast(lift);
    const Direction<S> d = detail::heading<S>(lift);
    at_ += hit ? detail::along<S>(d, travel(*hit, d)) : lift;
    return hit;
  };
  at_ = from;
  move_along_up(rise_of(from));
  const S risen = dot(at_ - from, up_);
  // A skin away from the riser, a short step would end before its edge.
  const Direction<S> ahead = detail::heading<S>(way);
  slide(detail::along<S>(ahead, max(ahead.length, S(2) * character_.skin)), Gait::walks, {});
  const S farther = dot(at_ - reached, detail::unit_of<S>(ahead));
  if (!(detail::kWorthAStep<S> < farther)) return take_back();
  const std::optional<Hit> floor = move_along_up(-(risen + character_.skin));
  const S higher = floor ? dot(floor->point, up_) - floor_ : S(0);
  if (!floor || !is_walkable(*floor) || character_.step_height + detail::kStepSlack<S> < higher) return take_back();
  touch_count_ = touched;
  return true;
}

/// Finds the ground. A walking character follows it down by up to a step.
template <class S> void CharacterWalk<S>::find_ground(bool walks, Vec3<S> carried) {
  const bool rises = !walks && character_.skin < dot(character_.velocity, up_);
  const S reach = (walks ? character_.step_height : character_.skin) + character_.skin;
  const Vec3<S> down = convert<S>(up_) * -reach;
  const std::optional<Hit> hit = rises ? std::nullopt : cast(down);
  if (hit && is_walkable(*hit)) return stand_on(*hit, reach * hit->fraction);
  const bool nearby = hit && reach * hit->fraction < S(2) * character_.skin;
  if (!rises && (nearby || has_supports()) && stand_between()) return;
  if (walks) set_velocity(flat(character_.move) + speed_of(carried));
  character_.footing = nearby ? Footing::steep : Footing::airborne;
  character_.ground = nearby ? hit->body : BodyId{};
  character_.normal = nearby ? hit->normal : Vec3<Unit<S>>::zero();
  if (nearby) foot_ = hit->point;
}

/// Returns true if the body is fixed and within two skins.
template <class S> bool CharacterWalk<S>::supports(const NearContact<S>& contact) const {
  return walks_[contact.body.slot] == detail::obstacle::kFixed && separation_of(contact) < character_.skin * S(2);
}
/// Returns true if several near contacts of the start of the step support the character.
template <class S> bool CharacterWalk<S>::has_supports() const {
  int count = 0;
  for (const NearContact<S>& contact : memory_.contacts) count += supports(contact) ? 1 : 0;
  return 1 < count;
}

/// [1] The steepest way down that the planes allow, as long as the sine of its slope. Zero where they hold.
/// It is the way nearest to straight down of all that lead into no plane. So it is down itself, or down less its part
/// into one plane, or its part along the edge of two planes.
template <class S> Vec3<S> CharacterWalk<S>::slide_of(const Planes& planes) const {
  const Vec3<S> down = -convert<S>(up_);
  Vec3<S> steepest = Vec3<S>::zero();
  const auto try_way = [&](Vec3<S> way) {
    for (int i = 0; i < planes.count; ++i) {
      if (dot(way, planes.normals[i]) < -detail::kPlaneSlack<S>) return;
    }
    if (dot(steepest, down) < dot(way, down)) steepest = way;
  };
  try_way(down);
  for (int i = 0; i < planes.count; ++i) {
    const Vec3<Unit<S>> n = planes.normals[i];
    try_way(down - convert<S>(n) * dot(down, n));
    for (int j = i + 1; j < planes.count; ++j) {
      const Direction<S> edge = detail::heading<S>(convert<S>(cross(n, planes.normals[j])));
      if (!(detail::kLeastEdge<S> < edge.length)) continue;
      const Vec3<Unit<S>> along = detail::unit_of<S>(edge);
      try_way(convert<S>(along) * dot(down, along));
    }
  }
  return steepest;
}

/// Stands the character on several planes that are too steep one by one: between two slopes, in a pit, on a slope
/// against a wall. They bear it like one plane on which it would slide as steeply. Its ground is the flattest of them.
template <class S> bool CharacterWalk<S>::stand_between() {
  around_.find_contacts(at_, character_.skin * S(2), memory_.contacts);
  contacts_at_ = at_;
  Planes planes;
  const NearContact<S>* flattest = nullptr;
  for (const NearContact<S>& contact : memory_.contacts) {
    if (!supports(contact) || planes.count == detail::kMostPlanes) continue;
    if (flattest == nullptr || dot(flattest->normal, up_) < dot(contact.normal, up_)) flattest = &contact;
    bool known = false;
    for (int i = 0; i < planes.count; ++i)
      known = known || detail::kOnePlane<S> < dot(convert<S>(contact.normal), planes.normals[i]);
    if (!known) planes.normals[planes.count++] = contact.normal;
  }
  const Vec3<S> slides = slide_of(planes);
  const S least = character_.least_up;
  if (flattest == nullptr || S(1) - least * least < dot(slides, slides)) return false;
  const Direction<S> normal = detail::heading<S>(convert<S>(up_) + slides);
  character_.footing = Footing::floor;
  character_.ground = flattest->body;
  character_.normal = detail::unit_of<S>(normal);
  set_velocity(speed_of(way()));
  foot_ = flattest->point;
  return true;
}

/// Stands the character on a hit, which is `gap` [m] below it.
template <class S> void CharacterWalk<S>::stand_on(const Hit& hit, S gap) {
  const S rise = dot(convert<S>(hit.normal), up_);
  at_ += convert<S>(up_) * (character_.skin / max(rise, S(0.5)) - gap);
  character_.footing = Footing::floor;
  character_.ground = hit.body;
  character_.normal = character_.least_up <= rise ? hit.normal : up_;
  set_velocity(speed_of(way()));
  foot_ = hit.point;
}

}  // namespace isostep
