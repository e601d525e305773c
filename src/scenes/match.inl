// Match: its rules. Every number is a literal of the scalar or drawn from the state's own random numbers.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/scalar/environment.hpp"
#include "isostep/store/state.hpp"
#include "match.hpp"

namespace isostep::scenes {

/// Ropes count as arena: who shoved a link would spin it.
namespace match_category {
inline constexpr std::uint32_t kArena = 1, kPile = 2, kPuck = 4, kSpawned = 8, kLoose = kPile | kSpawned;
}

/// Speeds and sizes keep what rolls and spins within Q16.16's 64 m/s and 64 rad/s.
template <class S> struct MatchRules {
  static constexpr std::uint16_t kWaits[kMatchActions] = {20, 30, 20, 20, 40, 90, 240};  // [frames]
  static constexpr std::uint64_t kTiltFrames = 120;
  static constexpr S kPush = S(12), kTopSpeed = S(6);                           // [m/s^2], [m/s]
  static constexpr S kJump = S(4.5), kUnderfoot = S(0.6);                       // [m/s], [m] below the centre
  static constexpr S kShoveReach = S(2), kShove = S(3), kShoveUp = S(1.5);      // [m], [m/s]
  static constexpr S kShoved = S(8);                                            // [m/s] and faster: left alone
  static constexpr S kThrow = S(4), kThrowAhead = S(1), kThrowHeight = S(1.8);  // [m/s], [m]
  static constexpr S kRoom = S(0.8);                 // [m] around what is spawned, free of walls and ropes
  static constexpr S kRay = S(8), kStrike = S(2.5);  // [m], [m/s]
  static constexpr S kTetherReach = S(1.5), kTetherLength = S(2.5);         // [m] surfaces, centres
  static constexpr S kLean = S(2.5), kFall = S(-10);                        // [m/s^2]
  static constexpr S kHardHit = S(0.6);                                     // [kg m/s]
  static constexpr S kDepth = S(-3);                                        // [m] fallen
  static constexpr S kAngularDamping = S(1), kAwayDamping = S(4);           // [1/s]
  static constexpr S kByte = S(0.02454369260617026), kPart = S(0.0078125);  // [rad] 1/256 turn, 1/128
};

template <class S> MatchState::Player& Match<S>::player_state(int player) {
  return state_.user.players[static_cast<std::size_t>(player)];
}

template <class S> void Match<S>::step(InputView<MatchInput> inputs) {
  pin_floats([&] {
    MatchState& own = state_.user;
    event_count_ = 0;
    cool_down();
    for (int player = 0; player < settings_.players; ++player) {
      const auto n = static_cast<std::size_t>(player);
      const bool away = n < inputs.statuses.size() && inputs.status(n) == InputStatus::disconnected;
      attend(player, away);
      if (!away && n < inputs.size() && inputs[n].valid()) act(player, inputs[n]);
    }
    if (own.level_at == own.tick) state_.world.set_gravity({S(0), MatchRules<S>::kFall, S(0)});
    report_ = state_.world.step();
    count_touches();
    count_goals();
    put_back_fallen();
    ++own.tick;
  });
}

template <class S> void Match<S>::cool_down() {
  for (MatchState::Player& player : state_.user.players) {
    for (std::uint16_t& wait : player.waits) {
      if (wait > 0) --wait;
    }
  }
}

/// The puck of a player who is gone rolls out.
template <class S> void Match<S>::attend(int player, bool away) {
  const std::uint32_t bit = 1u << player;
  if (((state_.user.away & bit) != 0) == away) return;
  state_.user.away ^= bit;
  const S linear = away ? MatchRules<S>::kAwayDamping : S(0);
  state_.world.set_motion(puck(player), S(1), linear, MatchRules<S>::kAngularDamping, 0);
}

template <class S> bool Match<S>::ready(int player, const MatchInput& input, MatchAction action) {
  const auto n = static_cast<std::size_t>(action);
  std::uint16_t& wait = player_state(player).waits[n];
  if (!input.pressed(action) || wait > 0) return false;
  wait = MatchRules<S>::kWaits[n];
  return true;
}

template <class S> void Match<S>::act(int player, const MatchInput& input) {
  const SinCos<Unit<S>> turn = sin_cos_to<Unit<S>>(S(input.aim) * MatchRules<S>::kByte);
  const Vec3<Unit<S>> aim = {turn.cos, Unit<S>(0), turn.sin};
  push(player, input);
  if (ready(player, input, MatchAction::jump)) jump(player);
  if (ready(player, input, MatchAction::shove)) shove(player);
  if (ready(player, input, MatchAction::spawn)) spawn(player, aim);
  if (ready(player, input, MatchAction::strike)) strike(player, aim);
  if (ready(player, input, MatchAction::tether)) tether(player);
  if (ready(player, input, MatchAction::reverse)) reverse();
  if (ready(player, input, MatchAction::tilt)) tilt(aim);
}

template <class S> void Match<S>::push(int player, const MatchInput& input) {
  if (input.push_x == 0 && input.push_z == 0) return;
  const BodyId body = puck(player);
  const Vec3<S> velocity = state_.world.velocity(body);
  const S most = state_.world.mass(body) * MatchRules<S>::kPush;
  const auto along = [&](std::int8_t wish, S speed) {
    const S part = S(wish) * MatchRules<S>::kPart;
    const bool fast = MatchRules<S>::kTopSpeed < (wish < 0 ? -speed : speed);
    return fast ? S(0) : most * part;
  };
  const S x = along(input.push_x, velocity.x), z = along(input.push_z, velocity.z);
  state_.world.apply_force(body, {x, S(0), z});
}

template <class S> void Match<S>::jump(int player) {
  World<S>& world = state_.world;
  const BodyId body = puck(player);
  const QueryFilter filter = {~match_category::kPuck, false};
  if (!world.cast_ray(world.center_of_mass(body), {S(0), -MatchRules<S>::kUnderfoot, S(0)}, filter)) return;
  world.apply_impulse(body, {S(0), world.mass(body) * MatchRules<S>::kJump, S(0)});
  emit(MatchEventKind::jump, player, body);
}

template <class S> void Match<S>::shove(int player) {
  World<S>& world = state_.world;
  const Vec3<S> from = world.center_of_mass(puck(player));
  found_.clear();
  world.overlap_shape(primitive_of(Sphere<S>{MatchRules<S>::kShoveReach}), {from, Quat<Unit<S>>::identity()}, found_,
                      {match_category::kLoose | match_category::kPuck, false});
  for (const BodyId body : found_) {
    if (body == puck(player) || MatchRules<S>::kShoved < max_abs(world.velocity(body))) continue;
    const Vec3<S> apart = world.center_of_mass(body) - from;
    const Vec3<Unit<S>> direction = normalise(apart);
    const S mass = world.mass(body);
    const Vec3<S> up = {S(0), mass * MatchRules<S>::kShoveUp, S(0)};
    world.apply_impulse(body, direction * (mass * MatchRules<S>::kShove) + up);
  }
  emit(MatchEventKind::shove, player, puck(player));
}

/// One of five kinds, its sizes drawn.
template <class S> ShapeId Match<S>::draw_shape() {
  World<S>& world = state_.world;
  Pcg32& random = state_.user.random;
  const std::uint32_t kind = random_below(random, 5);
  const S a = uniform(random, S(0.25), S(0.4));
  const S b = uniform(random, S(0.22), S(0.4));
  const S c = uniform(random, S(0.22), S(0.4));
  if (kind == 0) return world.add_shape(Sphere<S>{a});
  if (kind == 1) return world.add_shape(Capsule<S>{b, c});
  if (kind == 2) return world.add_shape(Box<S>{{a, b, c}});
  const Pose<S> middle = Pose<S>::identity();
  const auto at = [](S x, S y) { return Pose<S>{{x, y, S(0)}, Quat<Unit<S>>::identity()}; };
  const Primitive<S> bar = primitive_of(Capsule<S>{S(0.1), a}), end = primitive_of(Sphere<S>{b});
  const Primitive<S> plank = primitive_of(Box<S>{{a, S(0.1), b}}), post = primitive_of(Box<S>{{S(0.1), c, b}});
  const Child<S> dumbbell[] = {{bar, middle}, {end, at(S(0), a)}, {end, at(S(0), -a)}};
  const Child<S> bracket[] = {{plank, middle}, {post, at(a, c)}};
  return kind == 3 ? world.add_shape(std::span<const Child<S>>(dumbbell))
                   : world.add_shape(std::span<const Child<S>>(bracket));
}

template <class S> void Match<S>::spawn(int player, Vec3<Unit<S>> aim) {
  World<S>& world = state_.world;
  MatchState& own = state_.user;
  const Vec3<S> above = {S(0), MatchRules<S>::kThrowHeight, S(0)};
  const Vec3<S> from = world.center_of_mass(puck(player)) + above + aim * MatchRules<S>::kThrowAhead;
  found_.clear();
  world.overlap_shape(primitive_of(Sphere<S>{MatchRules<S>::kRoom}), {from, Quat<Unit<S>>::identity()}, found_,
                      {match_category::kArena, false});
  if (!found_.empty()) return;
  const std::uint32_t place = own.spawn_count % kMaxSpawned;
  clear_spawned(static_cast<int>(place));
  BodyDefinition<S> definition;
  definition.type = BodyType::dynamic;
  definition.shape = draw_shape();
  definition.position = from;
  definition.velocity = aim * MatchRules<S>::kThrow;
  definition.material.friction = S(0.5);
  definition.material.restitution = S(0.25);
  definition.filter.category = match_category::kSpawned;
  definition.angular_damping = MatchRules<S>::kAngularDamping;
  definition.report_contacts = true;
  const BodyId body = world.create(definition);
  own.spawned[place] = body;
  own.shapes[place] = definition.shape;
  ++own.spawn_count;
  emit(MatchEventKind::spawn, player, body);
}

template <class S> void Match<S>::strike(int player, Vec3<Unit<S>> aim) {
  World<S>& world = state_.world;
  const Vec3<S> reach = aim * MatchRules<S>::kRay;
  const auto hit = world.cast_ray(world.center_of_mass(puck(player)), reach, {~match_category::kPuck, false});
  if (!hit) return;
  const int place = spawned_place(hit->body);
  if (place >= 0) {
    emit(MatchEventKind::vanish, player, hit->body);
    clear_spawned(place);
  } else if (world.type(hit->body) == BodyType::dynamic) {
    world.apply_impulse(hit->body, aim * (world.mass(hit->body) * MatchRules<S>::kStrike));
  }
}

template <class S> void Match<S>::tether(int player) {
  World<S>& world = state_.world;
  JointId& tether = player_state(player).tether;
  const JointId had = tether;
  tether = JointId{};
  if (world.contains(had)) {
    world.destroy(had);
    return;
  }
  const Pose<S> here = {world.center_of_mass(puck(player)), Quat<Unit<S>>::identity()};
  const auto other = world.closest_point(here.position, MatchRules<S>::kTetherReach, {match_category::kLoose, false});
  if (!other) return;
  JointProperties<S> joint = world.joint_at(JointType::distance, puck(player), other->body, here);
  joint.frame_a = joint.frame_b = Pose<S>::identity();
  joint.flags = joint_flag::kLimit | joint_flag::kCollideConnected;
  const Vec3<S> apart = world.center_of_mass(other->body) - here.position;
  joint.upper = max(MatchRules<S>::kTetherLength, length(apart));
  tether = world.create(joint);
}

template <class S> void Match<S>::reverse() {
  const JointProperties<S>* now = state_.world.joint(mill_);
  if (now == nullptr) return;
  JointProperties<S> joint = *now;
  joint.motor_speed = -joint.motor_speed;
  state_.world.set_joint(mill_, joint);
}

template <class S> void Match<S>::tilt(Vec3<Unit<S>> aim) {
  const Vec3<S> down = {S(0), MatchRules<S>::kFall, S(0)};
  state_.world.set_gravity(down + aim * MatchRules<S>::kLean);
  state_.user.level_at = state_.user.tick + MatchRules<S>::kTiltFrames;
}

/// Pucks that clash score both; a spawned body that a puck hits hard breaks.
template <class S> void Match<S>::count_touches() {
  std::uint32_t broken = 0;
  for (const ContactBegin<S>& touch : state_.world.events().contact_begin) {
    if (touch.impulse < MatchRules<S>::kHardHit) continue;
    const int a = player_of(touch.a), b = player_of(touch.b);
    if (a >= 0 && b >= 0) {
      ++player_state(a).score;
      ++player_state(b).score;
      emit(MatchEventKind::clash, a, touch.b);
    } else if (a >= 0 || b >= 0) {
      const BodyId other = a >= 0 ? touch.b : touch.a;
      const int player = a >= 0 ? a : b, place = spawned_place(other);
      if (place < 0) continue;
      ++player_state(player).score;
      broken |= 1u << place;
      emit(MatchEventKind::vanish, player, other);
    }
  }
  for (int place = 0; broken != 0; ++place, broken >>= 1) {
    if ((broken & 1u) != 0) clear_spawned(place);
  }
}

template <class S> void Match<S>::count_goals() {
  for (const SensorEvent& entry : state_.world.events().sensor_begin) {
    const int player = player_of(entry.other);
    if (entry.sensor != ring_ || player < 0) continue;
    player_state(player).score += 3;
    emit(MatchEventKind::goal, player, entry.other);
  }
}

template <class S> void Match<S>::put_back_fallen() {
  const WorldState<S>& state = state_.world.state();
  found_.clear();
  for (const BodyState<S>& body : state.awake.states) {
    if (body.centre.y < MatchRules<S>::kDepth) found_.push_back(state.body_slots.template id_of<BodyId>(body.slot));
  }
  for (const BodyId body : found_) put_back(body);
}

/// A puck to its start, what was spawned to nowhere, the rest to the top of the pile. Ropes do not stretch that far.
template <class S> void Match<S>::put_back(BodyId body) {
  World<S>& world = state_.world;
  Pcg32& random = state_.user.random;
  const int place = spawned_place(body), player = player_of(body);
  if (place >= 0) {
    clear_spawned(place);
    return;
  }
  untie(body);
  const S inside = half_ * S(0.5);
  const S x = uniform(random, -inside, inside);
  const S y = uniform(random, S(3), S(4.5));
  const S z = uniform(random, -inside, inside);
  Vec3<S> to = {x, y, z};
  if (player >= 0) {
    to = starts_[static_cast<std::size_t>(player)] + Vec3<S>{S(0), S(1), S(0)};
    --player_state(player).score;
    ++player_state(player).falls;
    emit(MatchEventKind::fall, player, body);
  }
  world.set_pose(body, {to, Quat<Unit<S>>::identity()});
  world.set_velocity(body, Vec3<S>::zero(), Vec3<S>::zero());
}

template <class S> void Match<S>::untie(BodyId body) {
  for (MatchState::Player& player : state_.user.players) {
    const JointProperties<S>* joint = state_.world.joint(player.tether);
    if (joint == nullptr || (joint->body_a != body.slot && joint->body_b != body.slot)) continue;
    state_.world.destroy(player.tether);
    player.tether = JointId{};
  }
}

template <class S> int Match<S>::player_of(BodyId body) const {
  for (int player = 0; player < settings_.players; ++player) {
    if (puck(player) == body) return player;
  }
  return -1;
}

template <class S> int Match<S>::spawned_place(BodyId body) const {
  for (std::size_t place = 0; place < kMaxSpawned; ++place) {
    if (body && state_.user.spawned[place] == body) return static_cast<int>(place);
  }
  return -1;
}

template <class S> void Match<S>::clear_spawned(int place) {
  BodyId& body = state_.user.spawned[place];
  ShapeId& shape = state_.user.shapes[place];
  if (!body) return;
  state_.world.destroy(body);
  state_.world.remove_shape(shape);
  body = BodyId{};
  shape = ShapeId{};
}

template <class S> void Match<S>::emit(MatchEventKind kind, int player, BodyId body) {
  if (event_count_ == kMaxMatchEvents) return;
  events_[event_count_++] = {kind, static_cast<std::uint16_t>(player), body.slot};
}

}  // namespace isostep::scenes
