// WorldEngine: the commands, one function each. A refused command changes nothing and names its fault.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/body_inertia.hpp"
#include "isostep/geometry/mass_properties.hpp"
#include "isostep/world/checks.hpp"
#include "isostep/world/engine.hpp"

namespace isostep {

namespace detail {
/// Forces and impulses have no range of their own: what they would do beyond the scalar's is cut, on exact products, so
/// that nothing wraps, and remembered, so that the step reports it.
template <class S> struct Bounder {
  using V = Velocity<S>;
  bool cut = false;

  S held(S x, S limit) {
    cut = cut || limit < x || x < -limit;
    return clamp(x, -limit, limit);
  }
  template <class Sum> S rounded(Sum sum, S limit) {
    const auto bound = product(limit, S(1));
    cut = cut || bound < sum || sum < -bound;
    return saturate_at<S>(sum, limit);
  }
  S quotient(S x, S divisor, S limit) {
    const auto value = product(x, S(1)), bound = product(limit, divisor);
    if (bound < value || value < -bound) {
      cut = true;
      return S(0) < x ? limit : -limit;
    }
    return held(x / divisor, limit);
  }
  Vec3<S> quotient(Vec3<S> v, S divisor, S limit) {
    return {quotient(v.x, divisor, limit), quotient(v.y, divisor, limit), quotient(v.z, divisor, limit)};
  }
  Vec3<S> times(const Mat3<S>& m, Vec3<S> v, S limit) {
    return {rounded(dot_sum(m.rows[0], v), limit), rounded(dot_sum(m.rows[1], v), limit),
            rounded(dot_sum(m.rows[2], v), limit)};
  }
  Vec3<S> sum(Vec3<S> a, Vec3<S> b, S limit) {  // twice the limit fits
    return {held(a.x + b.x, limit), held(a.y + b.y, limit), held(a.z + b.z, limit)};
  }
  Vec3<V> faster(Vec3<V> a, Vec3<S> b, S limit) {
    const V most = convert<V>(limit);
    const auto part = [&](V x, S y) {
      const V total = x + convert<V>(y);
      cut = cut || most < total || total < -most;
      return clamp(total, -most, most);
    };
    return {part(a.x, b.x), part(a.y, b.y), part(a.z, b.z)};
  }
  /// Turning by a torque or an angular impulse: moments that no format holds end at its highest (saturated_cross()).
  Vec3<S> turning(const Mat3<S>& kappa, Vec3<S> torque, S mass, S limit) {
    cut = cut || max_abs(torque) == highest<S>();
    return times(kappa, quotient(torque, mass, Limits<S>::mass()), limit);
  }
};

/// [rad/s] Twice as fast points of the body leave the range of velocities: overspins(). `box` is the body's.
template <class S> S most_spin(const Aabb<S>& box) {
  return min(Limits<S>::spin(), S(0.5) * Limits<S>::surface_speed() / max(S(1), max_abs(box.high - box.low)));
}
}  // namespace detail

template <class S> ShapeId WorldEngine<S>::execute(const AddShape<S>& command) {
  if (command.children.size() > kMaxChildren) {
    journal_.refuse({Fault::bad_shape, "", "children", "65536 or fewer"});
    return {};
  }
  const ShapeFault fault = validate(std::span<const Child<S>>(command.children));
  if (fault != ShapeFault::none) {
    const bool finite = fault != ShapeFault::not_finite;
    journal_.refuse({finite ? Fault::bad_shape : Fault::not_finite, "", describe(fault), ""});
    return {};
  }
  std::vector<BlobRef> blobs(command.blobs.size());
  if (!find_blobs(command, blobs)) return {};
  const ShapeId id = state_.shape_slots.template take<ShapeId>(state_.settings.id_space);
  std::vector<ShapeRecord>& shapes = state_.shapes.change();
  std::vector<Child<S>>& pool = state_.children.change();
  if (shapes.size() <= id.slot) shapes.resize(id.slot + 1, ShapeRecord{0, 0});
  shapes[id.slot] = {static_cast<std::uint32_t>(pool.size()), static_cast<std::uint32_t>(command.children.size())};
  for (const Child<S>& child : command.children) {
    pool.push_back(normalised(child));
    std::uint32_t& blob = pool.back().primitive.blob;
    if (blob != 0) blob = 1 + state_.geometry.change().take(blobs[blob - 1]);
  }
  return id;
}

/// The content of what a command names, and whether each part names a blob of its type and each blob is named.
template <class S> bool WorldEngine<S>::find_blobs(const AddShape<S>& command, std::vector<BlobRef>& blobs) {
  const GeometryStore& known = *state_.geometry;
  for (std::size_t i = 0; i < blobs.size(); ++i) {
    const BlobMention& mention = command.blobs[i];
    const std::uint32_t there = known.find(mention.id);
    blobs[i] = there != GeometryStore::kNone ? known.content(there)
               : mention.content != nullptr  ? mention.content
                                             : assets_(mention.id);
    if (blobs[i] == nullptr || !(blobs[i]->id() == mention.id))
      return journal_.refuse({Fault::bad_shape, "", "blobs", "content, or a name that the world or its assets know"});
  }
  if (known.names().size() + blobs.size() > kMaxBlobs)
    return journal_.refuse({Fault::bad_shape, "", "blobs", "kMaxBlobs or fewer in a world"});
  std::vector<std::uint8_t> named(blobs.size(), 0);
  for (const Child<S>& child : command.children) {
    const std::uint32_t blob = child.primitive.blob;
    const bool exists = blob != 0 && blob <= blobs.size();
    const ShapeFault fault = validate_blob(child.primitive, exists ? blobs[blob - 1].get() : nullptr);
    if (fault != ShapeFault::none) return journal_.refuse({Fault::bad_shape, "", describe(fault), ""});
    if (exists) named[blob - 1] = 1;
  }
  for (const std::uint8_t is_named : named) {
    if (is_named == 0) return journal_.refuse({Fault::bad_shape, "", "blobs", "each named by a part"});
  }
  return true;
}

template <class S> bool WorldEngine<S>::execute(const RemoveShape& command) {
  if (!known(state_.shape_slots, command.shape, "shape")) return false;
  const std::uint32_t slot = command.shape.slot;
  for (std::uint32_t body = 0; body < locations_.size(); ++body) {
    if (locations_[body].set != Location::kNone && properties_at(locations_[body]).shape == slot) {
      return journal_.refuse({Fault::shape_in_use, "", "shape", "no body with it"});
    }
  }
  std::vector<ShapeRecord>& shapes = state_.shapes.change();
  std::vector<Child<S>>& pool = state_.children.change();
  const ShapeRecord gone = shapes[slot];
  const auto first = pool.begin() + static_cast<std::ptrdiff_t>(gone.first_child);
  for (auto child = first; child != first + static_cast<std::ptrdiff_t>(gone.child_count); ++child) {
    if (child->primitive.blob != 0) state_.geometry.change().give_back(child->primitive.blob - 1);
  }
  pool.erase(first, first + static_cast<std::ptrdiff_t>(gone.child_count));
  for (ShapeRecord& record : shapes) {
    if (record.first_child > gone.first_child) record.first_child -= gone.child_count;
  }
  shapes[slot] = {0, 0};
  state_.shape_slots.give_back(slot);
  return true;
}

/// Everything about a definition that needs no mass.
template <class S> bool WorldEngine<S>::check(const BodyDefinition<S>& d) {
  return known(state_.shape_slots, d.shape, "shape") &&
         journal_.accept(
             detail::Checklist()
                 .finite(d.density, "density")
                 .finite(d.mass, "mass")
                 .finite(d.position, "position")
                 .finite(d.velocity, "velocity")
                 .finite(d.angular_velocity, "angular_velocity")
                 .finite(d.inertia, "inertia")
                 .in_range(detail::within(d.position, Limits<S>::position()), "position", detail::kWithinPosition)
                 .in_range(detail::no_longer(d.velocity, Limits<S>::speed()), "velocity", detail::kWithinSpeed)
                 .in_range(detail::no_longer(d.angular_velocity, Limits<S>::spin()), "angular_velocity",
                           detail::kWithinSpin)
                 .proper(detail::is_unit<S>(d.orientation), "orientation", detail::kUnitLength)
                 .proper(d.type <= BodyType::dynamic, "type", "one of BodyType")
                 .also(detail::fault_of(d.material))
                 .also(detail::fault_of_motion(d.gravity_scale, d.linear_damping, d.angular_damping, d.locks))
                 .report());
}

template <class S> bool WorldEngine<S>::set_mass(const BodyDefinition<S>& d, BodyProperties<S>& body) {
  const S zero = S(0);
  const std::span<const Child<S>> children = children_of(d.shape.slot);
  const MassProperties<S> shape = mass_properties(children, d.density > zero ? d.density : S(1));
  body.local_centre = shape.centre;
  body.principal = shape.principal;
  body.mass = zero;
  body.kappa = Vec3<S>::zero();
  if (d.type != BodyType::dynamic) return true;
  const bool positive = zero <= d.inertia.x && zero <= d.inertia.y && zero <= d.inertia.z;
  if (!journal_.accept(
          detail::Checklist()
              .ask(zero <= d.mass, Fault::bad_mass, "mass", "above 0, or 0 for that of density")
              .ask(zero <= d.density, Fault::bad_mass, "density", "above 0")
              .ask(zero < d.density || zero < d.mass, Fault::bad_mass, "density", "above 0 where mass is 0")
              .ask(positive, Fault::bad_mass, "inertia", "above 0, or 0 for that of the shape")
              .ask(!(shape.mass == zero), Fault::bad_mass, "shape", "one with a volume that the scalar can count")
              .report())) {
    return false;
  }
  MassProperties<S> chosen = d.mass == zero ? shape : with_mass(shape, d.mass);
  if (!(d.inertia == Vec3<S>::zero())) chosen = from_mass_and_inertia(chosen.mass, d.inertia, shape.centre);
  if (!journal_.accept(detail::fault_of_mass(chosen.mass, chosen.kappa))) return false;
  body.mass = chosen.mass;
  body.kappa = chosen.kappa;
  body.principal = chosen.principal;
  const bool even = body.kappa.x == body.kappa.y && body.kappa.y == body.kappa.z;
  if (!even) body.flags |= body_flag::kSpins;
  return true;
}

template <class S> BodyId WorldEngine<S>::execute(const CreateBody<S>& command) {
  const BodyDefinition<S>& d = command.definition;
  if (!check(d)) return {};
  BodyProperties<S> body = {};
  body.type = d.type;
  body.flags = d.locks | (d.sensor ? body_flag::kSensor : 0u) | (d.allow_sleep ? body_flag::kAllowSleep : 0u) |
               (d.collide ? body_flag::kCollide : 0u);
  body.shape = d.shape.slot;
  body.filter = d.filter;
  body.user_data = d.user_data;
  body.material = d.material;
  body.gravity_scale = d.gravity_scale;
  body.linear_damping = d.linear_damping;
  body.angular_damping = d.angular_damping;
  if (!set_mass(d, body)) return {};

  BodyState<S> state = {};
  state.orientation = normalise(d.orientation);
  state.centre = d.position + to_matrix(state.orientation) * body.local_centre;
  if (d.type != BodyType::fixed) {
    state.velocity = convert<Velocity<S>>(d.velocity);
    state.spin = convert<Velocity<S>>(d.angular_velocity);
  }
  if (!journal_.accept(detail::fault_of_place(state.centre, "position"))) return {};
  renew_fat_box(state, body, true);
  if (detail::overspins(state.spin, state.fat)) {
    journal_.refuse(
        {Fault::out_of_range, "", "angular_velocity", "points of the body no faster than Limits::surface_speed()"});
    return {};
  }
  const BodyId id = state_.body_slots.template take<BodyId>(state_.settings.id_space);
  state.slot = id.slot;
  draw_from_here(state);
  const bool fixed = d.type == BodyType::fixed;
  insert_body(fixed ? state_.fixed.change() : state_.awake, fixed ? Location::kFixed : Location::kAwake, state, body);
  proxies_.place(state, body, !fixed);
  if (d.type != BodyType::dynamic) wake_touching(id.slot);
  return id;
}

template <class S> bool WorldEngine<S>::execute(const WakeBody& command) {
  if (!may_change(command.body)) return false;
  wake_for_change(command.body.slot);
  return true;
}

template <class S> bool WorldEngine<S>::execute(const SetPose<S>& command) {
  if (!known(command.body) || !journal_.accept(detail::fault_of_place(command.pose.position, "position"))) return false;
  if (!detail::is_unit<S>(command.pose.orientation))
    return journal_.refuse({Fault::bad_argument, "", "orientation", detail::kUnitLength});
  const std::uint32_t slot = command.body.slot;
  const Location at = locations_[slot];
  const Quat<Unit<S>> orientation = normalise(command.pose.orientation);
  const Vec3<S> centre = command.pose.position + to_matrix(orientation) * properties_at(at).local_centre;
  if (!journal_.accept(detail::fault_of_place(centre, "position"))) return false;
  wake_touching(slot);
  if (properties_at(locations_[slot]).type != BodyType::dynamic) wake_held_by(slot);
  if (at.set != Location::kFixed) wake_for_change(slot);
  const Location now = locations_[slot];
  BodySet<S>& set = now.set == Location::kFixed ? state_.fixed.change() : state_.awake;
  BodyState<S>& state = set.states[now.index];
  const BodyProperties<S>& body = set.properties[now.index];
  state.orientation = orientation;
  state.centre = centre;
  draw_from_here(state);
  renew_fat_box(state, body, true);
  proxies_.place(state, body, now.set == Location::kAwake);
  wake_touching(slot);
  return true;
}

template <class S> bool WorldEngine<S>::execute(const SetVelocity<S>& command) {
  if (!journal_.accept(
          detail::Checklist()
              .finite(command.linear, "linear")
              .finite(command.angular, "angular")
              .in_range(detail::no_longer(command.linear, Limits<S>::speed()), "linear", detail::kWithinSpeed)
              .in_range(detail::no_longer(command.angular, Limits<S>::spin()), "angular", detail::kWithinSpin)
              .report()) ||
      !may_change(command.body)) {
    return false;
  }
  if (command.linear == Vec3<S>::zero() && command.angular == Vec3<S>::zero()) {
    halt(command.body.slot);
    return true;
  }
  wake_for_change(command.body.slot);
  if (properties_at(locations_[command.body.slot]).type == BodyType::kinematic) wake_held_by(command.body.slot);
  BodyState<S>* state = &state_.awake.states[locations_[command.body.slot].index];
  state->velocity = convert<Velocity<S>>(command.linear);
  state->spin = convert<Velocity<S>>(command.angular);
  return true;
}

template <class S> bool WorldEngine<S>::execute(const ApplyForce<S>& command) {
  if (!journal_.accept(detail::Checklist().finite(command.force, "force").finite(command.torque, "torque").report()) ||
      !may_push(command.body)) {
    return false;
  }
  if (command.force == Vec3<S>::zero() && command.torque == Vec3<S>::zero()) return true;
  BodyState<S>* state = wake_for_change(command.body.slot);
  const BodyProperties<S>& body = state_.awake.properties[locations_[state->slot].index];
  const Mat3<S> kappa = detail::world_kappa(body, detail::world_axes(state->orientation, body));
  // From rest to the limit in one step: velocities then stay within their format.
  const std::int32_t hz = state_.settings.hz;
  const S most = detail::most_acceleration(hz, Limits<S>::speed());
  const S most_turning = detail::most_acceleration(hz, detail::most_spin(state->fat));
  PendingForce<S>& force = pending_force(state->slot);
  detail::Bounder<S> bounder;
  const Vec3<S> linear = bounder.quotient(command.force, body.mass, most);
  force.linear = bounder.sum(force.linear, linear, most);
  const Vec3<S> turning = bounder.turning(kappa, command.torque, body.mass, most_turning);
  force.angular = bounder.sum(force.angular, turning, most_turning);
  if (bounder.cut) force.cut = 1;
  return true;
}

template <class S> bool WorldEngine<S>::execute(const ApplyImpulse<S>& command) {
  if (!journal_.accept(
          detail::Checklist().finite(command.linear, "linear").finite(command.angular, "angular").report()) ||
      !may_push(command.body)) {
    return false;
  }
  if (command.linear == Vec3<S>::zero() && command.angular == Vec3<S>::zero()) return true;
  BodyState<S>* state = wake_for_change(command.body.slot);
  const BodyProperties<S>& body = state_.awake.properties[locations_[state->slot].index];
  const Mat3<S> kappa = detail::world_kappa(body, detail::world_axes(state->orientation, body));
  // A quarter above the limit: the step then cuts them again and reports it.
  const S speed = Limits<S>::speed() * S(1.25), spin = Limits<S>::spin() * S(1.25);
  detail::Bounder<S> bounder;
  const Vec3<S> linear = bounder.quotient(command.linear, body.mass, S(2) * speed);
  state->velocity = bounder.faster(state->velocity, linear, speed);
  const Vec3<S> turning = bounder.turning(kappa, command.angular, body.mass, S(2) * spin);
  state->spin = bounder.faster(state->spin, turning, spin);
  if (bounder.cut) pending_force(state->slot).cut = 1;
  return true;
}

/// What is asked of a body until the next step.
template <class S> PendingForce<S>& WorldEngine<S>::pending_force(std::uint32_t slot) {
  std::vector<PendingForce<S>>& forces = state_.forces;
  const std::size_t at = detail::lower_bound(forces.size(), [&](std::size_t i) { return forces[i].slot < slot; });
  if (at == forces.size() || forces[at].slot != slot) {
    forces.insert(forces.begin() + static_cast<std::ptrdiff_t>(at), {slot, 0, Vec3<S>::zero(), Vec3<S>::zero()});
  }
  return forces[at];
}

template <class S> bool WorldEngine<S>::execute(const SetMaterial<S>& command) {
  if (!known(command.body) || !journal_.accept(detail::fault_of(command.material))) return false;
  wake_touching(command.body.slot);
  thaw_body(command.body.slot);
  mutable_properties(command.body.slot).material = command.material;
  return true;
}

template <class S> bool WorldEngine<S>::execute(const SetFilter& command) {
  if (!known(command.body)) return false;
  const std::uint32_t slot = command.body.slot;
  wake_touching(slot);
  thaw_body(slot);
  BodyProperties<S>& body = mutable_properties(slot);
  body.filter = command.filter;
  proxies_.place(state_at(locations_[slot]), body, locations_[slot].set == Location::kAwake);
  return true;
}

template <class S> bool WorldEngine<S>::execute(const SetMotion<S>& command) {
  if (!journal_.accept(detail::fault_of_motion(command.gravity_scale, command.linear_damping, command.angular_damping,
                                               command.locks))) {
    return false;
  }
  if (!may_change(command.body)) return false;
  wake_for_change(command.body.slot);
  BodyProperties<S>& body = mutable_properties(command.body.slot);
  body.gravity_scale = command.gravity_scale;
  body.linear_damping = command.linear_damping;
  body.angular_damping = command.angular_damping;
  body.flags = (body.flags & ~body_flag::kAllLocks) | command.locks;
  return true;
}

template <class S> bool WorldEngine<S>::execute(const SetUserData& command) {
  if (!known(command.body)) return false;
  thaw_body(command.body.slot);
  mutable_properties(command.body.slot).user_data = command.user_data;
  return true;
}

template <class S> bool WorldEngine<S>::execute(const SetGravity<S>& command) {
  if (!journal_.accept(detail::Checklist()
                           .finite(command.gravity, "gravity")
                           .in_range(detail::within(command.gravity, Limits<S>::speed()), "gravity",
                                     "components up to Limits::speed()")
                           .report())) {
    return false;
  }
  state_.settings.gravity = command.gravity;
  while (!state_.frozen.empty()) unlist(static_cast<std::uint32_t>(state_.frozen.size() - 1));
  merge_woken();
  for (BodyState<S>& state : state_.awake.states) state.sleep_clock = 0;
  return true;
}

}  // namespace isostep
