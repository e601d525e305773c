// Bodies of characters.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/character_walk.inl"
#include "isostep/world/characters.hpp"
#include "isostep/world/checks.hpp"
#include "isostep/world/fat_box.hpp"

namespace isostep {

namespace detail {
/// [m] how far the point of the ground has moved that the character stands on. What is fixed does not.
template <class S>
Vec3<S> carried_by_ground(const WorldState<S>& state, const BodyMap<S>& map, const Character<S>& character) {
  if (!state.body_slots.holds(character.ground)) return Vec3<S>::zero();
  if (map.location(character.ground.slot).set == Location::kStatic) return Vec3<S>::zero();
  const Pose<S> pose = map.origin_pose_at(character.ground.slot);
  return pose.position + to_matrix(pose.orientation) * character.foot - character.foot_at;
}
/// [N] from a push that ends at a speed: no more than `most`, and than the body then has after a step.
template <class S> S push_on(S mass, S lacks, std::int32_t hz, S most) {
  if (!(S(0) < lacks)) return S(0);
  const S change = lacks * S(hz);  // [m/s^2]
  return product(mass, change) < product(most, S(1)) ? mass * change : most;
}
}  // namespace detail

template <class S> void Characters<S>::update() {
  const auto& records = state_.force_records->characters;
  if (records.all().empty()) return;
  walks_.assign(state_.body_slots.entries().size(), 0);
  for (std::uint32_t slot = 0; slot < records.all().size(); ++slot) {
    if (records.is_taken(slot)) walks_[records.all()[slot].body.slot] = 1;
  }
  moves_.clear();
  pushes_.clear();
  for (std::uint32_t slot = 0; slot < records.all().size(); ++slot) {
    if (records.is_taken(slot)) walk(slot);
  }
  if (moves_.empty()) return;
  std::vector<Character<S>>& changed = state_.force_records.change().characters.change_all();
  for (const Move& move : moves_) {
    changed[move.record] = move.character;
    put(move);
  }
  for (const Push& each : pushes_) push(each);
}

template <class S> void Characters<S>::walk(std::uint32_t slot) {
  Character<S> character = state_.force_records->characters.all()[slot];
  const Settings<S>& settings = state_.settings;
  const Pose<S> pose = map_.origin_pose_at(character.body.slot);
  const ShapeId shape =
      state_.shape_slots.template id_of<ShapeId>(map_.properties_at(map_.location(character.body.slot)).shape);
  const Direction<S> against = detail::heading<S>(-settings.gravity);
  const Vec3<Unit<S>> up =
      against.length > S(0) ? detail::unit_of<S>(against) : Vec3<Unit<S>>{Unit<S>(0), Unit<S>(1), Unit<S>(0)};
  const S below = queries_.reach_of(shape, pose.orientation, -up);
  CharacterWalk<S> walk(queries_, {shape, pose, below, up, settings.gravity, settings.hz}, walks_, near_, character);
  walk.run(detail::carried_by_ground(state_, map_, character));
  character.foot_at = walk.foot();
  character.foot = local_to(character.ground, walk.foot());
  push_touched(walk, character);
  bear(character);
  moves_.push_back({slot, character, walk.way()});
}

template <class S> Vec3<S> Characters<S>::local_to(BodyId body, Vec3<S> point) const {
  if (!body) return Vec3<S>::zero();
  const Pose<S> pose = map_.origin_pose_at(body.slot);
  return transposed_times(to_matrix(pose.orientation), point - pose.position);
}

/// Against what is in its way, until that is as fast as the character wants to be.
template <class S> void Characters<S>::push_touched(const CharacterWalk<S>& walk, const Character<S>& character) {
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

/// Dynamic ground has its weight.
template <class S> void Characters<S>::bear(const Character<S>& character) {
  if (character.footing != Footing::floor) return;
  if (map_.properties_at(map_.location(character.ground.slot)).type != BodyType::dynamic) return;
  const S weight =
      saturate_to<S>(product(character.mass, max(character.gravity_scale, S(0)) * length(state_.settings.gravity)));
  if (!(S(0) < weight)) return;
  const Direction<S> down = detail::heading<S>(state_.settings.gravity);
  pushes_.push_back({character.ground, detail::along<S>(down, weight), character.foot_at});
}

/// As a command that sets its pose, but drawn on its way: it goes there, it does not appear.
template <class S> void Characters<S>::put(const Move& move) {
  if (move.way == Vec3<S>::zero()) return;
  const std::uint32_t slot = move.character.body.slot;
  wake_.wake_touching(slot);
  wake_.wake_held_by(slot);
  wake_.wake_for_change(slot);
  const Location at = map_.location(slot);
  BodyState<S>& state = state_.awake.states[at.index];
  const S edge = Limits<S>::position();
  const Vec3<S> to = state.centre + move.way;
  state.centre = {clamp(to.x, -edge, edge), clamp(to.y, -edge, edge), clamp(to.z, -edge, edge)};
  detail::renew_fat_box(map_, state, state_.awake.properties[at.index], true);
  proxies_.place(state, state_.awake.properties[at.index], true);
  wake_.wake_touching(slot);
}

template <class S> void Characters<S>::push(const Push& push) {
  const Vec3<S> arm = push.point - map_.state_at(map_.location(push.body.slot)).centre;
  commands_.execute(ApplyForce<S>{push.body, push.force, detail::saturated_cross(arm, push.force)});
}

}  // namespace isostep
