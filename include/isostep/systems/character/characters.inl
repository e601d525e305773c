// Bodies of characters.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/query/closest_point.hpp"
#include "isostep/dynamics/checks.hpp"
#include "isostep/geometry/bounds.hpp"
#include "isostep/math/rotations.hpp"
#include "isostep/query/surroundings.inl"
#include "isostep/store/fat_box.hpp"
#include "isostep/store/finite_guard.hpp"
#include "isostep/systems/character/character_walk.inl"
#include "isostep/systems/character/characters.hpp"

namespace isostep {

namespace detail {
/// Returns true if a part of another body carries and stops the character, by its own part: a sensor or a filtered
/// part does not.
template <class S>
bool is_solid_for(const BodyMap<S>& map, const Walker<S>& character, const BodyProperties<S>& other,
                  const Child<S>& part) {
  const BodyProperties<S>& own = *map.properties_of(character.body);
  const bool masked = (part.traits.filter_or(other.filter).category & character.mask) == 0;
  return !masked && parts_collide(part.traits, other.filter, map.shapes.children_of(own.shape)[0].traits, own.filter);
}
/// Returns the part of its ground whose surface is nearest to its foot. The first of equals.
template <class S> std::uint32_t part_under(const BodyMap<S>& map, const Walker<S>& character) {
  const BodyProperties<S>& ground = *map.properties_of(character.ground);
  const std::span<const Child<S>> parts = map.shapes.children_of(ground.shape);
  std::uint32_t nearest = 0;
  S least = highest<S>();
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    if (!is_solid_for(map, character, ground, parts[i])) continue;
    const ShapeView<S> view = map.shapes.contents().view(parts[i].primitive);
    const S gap = abs(closest_point<S>(view, Transform<S>::of(parts[i].pose), character.foot).distance);
    if (!(gap < least)) continue;
    least = gap;
    nearest = i;
  }
  return nearest;
}
/// Returns the surface velocity under its foot: the record of the part, else that of the body, else null.
template <class S>
const SurfaceVelocity<S>* belt_under(const WorldState<S>& state, const BodyMap<S>& map, const Walker<S>& character) {
  const SurfaceVelocity<S>* of_body = nullptr;
  std::uint32_t part = kEveryPart;  // not asked for yet
  for (const SurfaceVelocity<S>& belt : state.records->surface_velocitys.all()) {
    if (!belt.body || belt.body != character.ground) continue;
    if (belt.part == kEveryPart) {
      of_body = &belt;
      continue;
    }
    if (part == kEveryPart) part = part_under(map, character);
    if (belt.part == part) return &belt;
  }
  return of_body;
}
/// [m] The motion of the belt under its foot in a step.
template <class S>
Vec3<S> carried_by_belt(const WorldState<S>& state, const BodyMap<S>& map, const Walker<S>& character) {
  const SurfaceVelocity<S>* const belt = belt_under(state, map, character);
  if (belt == nullptr) return Vec3<S>::zero();
  const Vec3<S> speed = held_within(belt->linear + saturated_cross(belt->angular, character.foot), Limits<S>::speed());
  const Step<S> h = divide_to<Step<S>>(S(1), S(state.settings.hz));
  return to_matrix(map.origin_pose_at(belt->body.slot).orientation) * (speed * h);
}
/// [m] The motion of the ground point under its foot in a step. Static ground moves by its belts only.
template <class S>
Vec3<S> carried_by_ground(const WorldState<S>& state, const BodyMap<S>& map, const Walker<S>& character) {
  if (!state.body_slots.holds(character.ground)) return Vec3<S>::zero();
  const Vec3<S> by_belt = carried_by_belt(state, map, character);
  if (map.location(character.ground.slot).set == Location::kStatic) return by_belt;
  const Pose<S> pose = map.origin_pose_at(character.ground.slot);
  return pose.position + to_matrix(pose.orientation) * character.foot - character.foot_at + by_belt;
}
/// [N] The force that adds the speed `lacks` [m/s] in one step, at most `most`. 0 if it lacks none.
template <class S> S push_on(S mass, S lacks, std::int32_t hz, S most) {
  if (!(S(0) < lacks)) return S(0);
  const S change = lacks * S(hz);  // [m/s^2]
  return product(mass, change) < product(most, S(1)) ? mass * change : most;
}
}  // namespace detail

template <class S> void Characters<S>::update() {
  const auto& records = state_.records->characters;
  if (records.all().empty()) return;
  walks_.assign(state_.body_slots.entries().size(), detail::obstacle::kFixed);
  for (std::size_t i = 0; i < state_.awake.states.size(); ++i) {
    const bool moves = state_.awake.properties[i].type == BodyType::dynamic;
    if (moves) walks_[state_.awake.states[i].slot] = detail::obstacle::kDynamic;
  }
  for (std::uint32_t slot = 0; slot < records.all().size(); ++slot) {
    if (records.is_taken(slot)) walks_[records.all()[slot].body.slot] = detail::obstacle::kWalks;
  }
  moves_.clear();
  pushes_.clear();
  around_.begin_step();
  for (std::uint32_t slot = 0; slot < records.all().size(); ++slot) {
    if (records.is_taken(slot) && map_.is_enabled(records.all()[slot].body.slot)) walk(slot);
  }
  if (moves_.empty()) return;
  for (const Move& move : moves_) {
    CharacterInput<S>& input = state_.parts.character_inputs[move.record] = move.character;
    CharacterState<S>& state = state_.parts.character_states[move.record] = move.character;
    detail::keep_finite(input);
    detail::keep_finite(state);
    put(move);
  }
  for (const Push& each : pushes_) push(each);
}

template <class S> void Characters<S>::walk(std::uint32_t slot) {
  Walker<S> character = {state_.records->characters.all()[slot], state_.parts.character_inputs[slot],
                         state_.parts.character_states[slot]};
  const Settings<S>& settings = state_.settings;
  const Asking asking = {state_.shape_slots.template id_of<ShapeId>(map_.properties_of(character.body)->shape),
                         map_.origin_pose_at(character.body.slot)};
  const Direction<S> against = detail::heading<S>(-settings.gravity);
  const Vec3<Unit<S>> up =
      against.length > S(0) ? detail::unit_of<S>(against) : Vec3<Unit<S>>{Unit<S>(0), Unit<S>(1), Unit<S>(0)};
  find_passed(character, asking);
  QueryFilter filter = seen_by(character);
  filter.ignore_all = passed_;
  around_.begin(asking.shape, asking.pose, filter, map_.properties_of(character.body)->filter, passed_kinds_);
  const Place place = {asking.pose.position, detail::reach_of(map_, asking.shape, asking.pose.orientation, -up), up,
                       settings.gravity, settings.hz};
  CharacterWalk<S> walk(around_, place, walks_, memory_, character);
  walk.run(detail::carried_by_ground(state_, map_, character));
  character.foot_at = walk.foot();
  character.foot = local_to(character.ground, walk.foot());
  push_touched(walk, character);
  bear(character);
  moves_.push_back({slot, character, walk.way()});
}

/// Returns a filter that sees the bodies which the character meets.
template <class S> QueryFilter Characters<S>::seen_by(const Walker<S>& character) {
  QueryFilter filter;
  filter.mask = character.mask;
  filter.ignore = character.body;
  return filter;
}

/// Lists its ghosts, the kinds that its own kind passes, and the one-way bodies that it is not above.
template <class S> void Characters<S>::find_passed(const Walker<S>& character, const Asking& asking) {
  passed_.clear();
  passed_kinds_.clear();
  const std::uint32_t kind = map_.properties_of(character.body)->material.kind;
  for (const KindGhost<S>& ghost : state_.records->kind_ghosts.all()) {
    if (kind != 0 && ghost.kind_a == kind) passed_kinds_.push_back(ghost.kind_b);
    if (kind != 0 && ghost.kind_b == kind) passed_kinds_.push_back(ghost.kind_a);
  }
  for (const Ghost<S>& ghost : state_.records->ghosts.all()) {
    if (ghost.a && ghost.a == character.body) passed_.push_back(ghost.b);
    if (ghost.b && ghost.b == character.body) passed_.push_back(ghost.a);
  }
  knows_contacts_ = false;
  for (const OneWay<S>& way : state_.records->one_ways.all()) {
    if (way.body && way.body != character.body && !is_above(character, asking, way)) passed_.push_back(way.body);
  }
}

/// Returns true if the character is above the highest point of the body along its axis or, at a body that is not flat,
/// in front of its contacts. A rising body may have overtaken the character's lowest point in this step.
template <class S>
bool Characters<S>::is_above(const Walker<S>& character, const Asking& asking, const OneWay<S>& way) {
  if (character.footing == Footing::floor && character.ground == way.body) return true;
  const S hz = S(state_.settings.hz);
  const Pose<S> pose = map_.origin_pose_at(way.body.slot);
  const Vec3<Unit<S>> axis = to_matrix(pose.orientation) * way.axis;
  const BodyState<S>& state = map_.state_at(map_.location(way.body.slot));
  const S rises = max(convert<S>(saturate_to<Velocity<S>>(dot_sum(state.velocity, axis))), S(0)) / hz;
  const S slack = character.skin * S(0.5) + rises;
  const S lowest = dot(asking.pose.position - pose.position, axis) -
                   detail::reach_of(map_, asking.shape, asking.pose.orientation, -axis);
  if (!(lowest < highest_of(character, way.body, way.axis) - slack)) return true;
  if (!knows_contacts_) {
    const S way_of_step = (max_abs(character.velocity) + max_abs(character.move)) / hz;
    around_.begin(asking.shape, asking.pose, seen_by(character), map_.properties_of(character.body)->filter);
    around_.find_contacts(asking.pose.position, character.skin * S(2) + way_of_step, memory_.contacts);
    knows_contacts_ = true;
  }
  bool in_front = false;
  for (const NearContact<S>& contact : memory_.contacts) {
    if (contact.body != way.body) continue;
    if (contact.separation < -slack) return false;
    in_front = in_front || !(convert<S>(dot(contact.normal, axis)) < way.least_cosine);
  }
  return in_front;
}

/// [m] The highest point of the body along an axis, both in its frame, over the parts that are solid for the character.
template <class S> S Characters<S>::highest_of(const Walker<S>& character, BodyId body, Vec3<Unit<S>> axis) const {
  const Vec3<Unit<S>> y = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};
  const Transform<S> upright = Transform<S>::of({Vec3<S>::zero(), rotation_between(axis, y)});
  S highest = -Limits<S>::position();
  const BodyProperties<S>& properties = map_.properties_at(map_.location(body.slot));
  for (const Child<S>& child : map_.shapes.children_of(properties.shape)) {
    if (!detail::is_solid_for(map_, character, properties, child)) continue;
    const Transform<S> at = compose(upright, Transform<S>::of(child.pose));
    highest = max(highest, bounds(map_.shapes.contents().view(child.primitive), at).high.y);
  }
  return highest;
}

template <class S> Vec3<S> Characters<S>::local_to(BodyId body, Vec3<S> point) const {
  if (!body) return Vec3<S>::zero();
  const Pose<S> pose = map_.origin_pose_at(body.slot);
  return transposed_times(to_matrix(pose.orientation), point - pose.position);
}

/// Pushes bodies in its way, up to the speed that the character wants.
template <class S> void Characters<S>::push_touched(const CharacterWalk<S>& walk, const Walker<S>& character) {
  const Vec3<S> wanted = character.footing == Footing::floor ? character.move : character.velocity;
  for (const CharacterTouch<S>& touch : walk.touches()) {
    const Location at = map_.location(touch.body.slot);
    const BodyProperties<S>& body = map_.properties_at(at);
    if (body.type != BodyType::dynamic || touch.body == character.ground) continue;
    const Vec3<Unit<S>> into = -touch.normal;
    const S lacks = dot(wanted - convert<S>(map_.state_at(at).velocity), into);
    const S force = detail::push_on(body.mass, lacks, state_.settings.hz, character.push_force);
    if (S(0) < force) pushes_.push_back({touch.body, convert<S>(into) * force, touch.point});
  }
}

/// Puts the character's weight on dynamic ground.
template <class S> void Characters<S>::bear(const Walker<S>& character) {
  if (character.footing != Footing::floor) return;
  if (map_.properties_at(map_.location(character.ground.slot)).type != BodyType::dynamic) return;
  const S weight =
      saturate_to<S>(product(character.mass, max(character.gravity_scale, S(0)) * length(state_.settings.gravity)));
  if (!(S(0) < weight)) return;
  const Direction<S> down = detail::heading<S>(state_.settings.gravity);
  pushes_.push_back({character.ground, detail::along<S>(down, weight), character.foot_at});
}

/// Moves the body like a command that sets its pose, but drawing interpolates the motion. So its fat box stays as long
/// as it contains the body.
template <class S> void Characters<S>::put(const Move& move) {
  if (move.way == Vec3<S>::zero()) return;
  const std::uint32_t slot = move.character.body.slot;
  wake_.wake_touching(slot);
  wake_.wake_held_by(slot);
  BodyState<S>& state = wake_.wake_for_change(slot);
  const BodyProperties<S>& body = map_.properties_at(map_.location(slot));
  const S edge = Limits<S>::position();
  const Vec3<S> to = state.centre + move.way;
  state.centre = {clamp(to.x, -edge, edge), clamp(to.y, -edge, edge), clamp(to.z, -edge, edge)};
  const Aabb<S> before = state.fat;
  detail::renew_fat_box(map_, state, body, false);
  if (state.fat == before) return;
  proxies_.place(state, body, true);
  wake_.wake_touching(slot);
}

template <class S> void Characters<S>::push(const Push& push) {
  const Vec3<S> arm = push.point - map_.state_at(map_.location(push.body.slot)).centre;
  commands_.execute(ApplyForce<S>{push.body, push.force, detail::saturated_cross(arm, push.force)});
}

}  // namespace isostep
