// Bodies of debug_draw.hpp: wheels and characters.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/draw/debug_draw_sketch.inl"
#include "isostep/math/quat.hpp"
#include "isostep/scalar/math.hpp"
#include "isostep/store/state.hpp"

namespace isostep::detail {

/// Draws wheels and the like, which move a body but are none, from the records alone, as the last step or command left
/// them.
template <class S> class MoverSketch {
  using D = Vec3<double>;

 public:
  ISO_INLINE MoverSketch(const World<S>& world, DebugDraw& to, const Sketch<S>& sketch)
      : world_(world), records_(*world.state().records), to_(to), sketch_(sketch) {}

  ISO_INLINE void draw_wheels() const {
    for (std::uint32_t slot = 0; slot < records_.wheels.all().size(); ++slot) {
      if (records_.wheels.is_taken(slot)) draw_wheel(slot, records_.wheels.all()[slot]);
    }
  }
  ISO_INLINE void draw_characters() const {
    for (std::uint32_t slot = 0; slot < records_.characters.all().size(); ++slot) {
      if (records_.characters.is_taken(slot)) draw_character(slot, records_.characters.all()[slot]);
    }
  }

 private:
  ISO_INLINE void draw_wheel(std::uint32_t slot, const WheelSettings<S>& wheel) const {
    const WheelState<S>& state = world_.state().parts.wheel_states[slot];
    const BodyView<S> body = world_.view(wheel.body);
    if (body.state == nullptr) return;
    const Quat<double> of_body = real(body.pose.orientation);
    const D up = -real(wheel.suspension), axle = real(wheel.axle_direction);
    const Quat<double> steered = about(up, to_double(state.steered));
    const Quat<double> turn = of_body * steered * about(axle, to_double(state.angle)) * from_y_to(axle);
    DrawnWheel drawn = {};
    drawn.wheel = records_.wheels.slot_map().template id_of<WheelId>(slot);
    drawn.body = wheel.body;
    drawn.awake = world_.is_awake(wheel.body);
    const D origin = real(body.pose.position), hard_point = origin + to_matrix(of_body) * real(wheel.hard_point);
    put(hard_point, drawn.hard_point);
    put(hard_point - to_matrix(of_body) * up * to_double(state.length), drawn.pose.position);
    const double parts[4] = {turn.x, turn.y, turn.z, turn.w};
    for (int i = 0; i < 4; ++i) drawn.pose.orientation[i] = static_cast<float>(parts[i]);
    drawn.radius = sketch_.number(wheel.radius);
    drawn.spin = sketch_.number(state.spin);
    drawn.ground = state.contact_body;
    if (state.contact_body) draw_contact(state, to_matrix(of_body * steered) * axle, drawn);
    to_.wheel(drawn);
  }
  /// `axle` [1] world, steered.
  ISO_INLINE void draw_contact(const WheelState<S>& wheel, D axle, DrawnWheel& drawn) const {
    const D normal = real(wheel.contact_normal), forward = normalise(cross(axle, normal));
    const D grip = forward * to_double(wheel.along) + cross(normal, forward) * to_double(wheel.across);
    sketch_.point(wheel.contact_point, drawn.contact);
    sketch_.vector(wheel.contact_normal, drawn.normal);
    drawn.load = sketch_.number(wheel.load);
    for (int i = 0; i < 3; ++i) drawn.grip[i] = static_cast<float>(grip[i]);
  }

  ISO_INLINE void draw_character(std::uint32_t slot, const CharacterSettings<S>& character) const {
    const CharacterState<S>& state = world_.state().parts.character_states[slot];
    const BodyView<S> body = world_.view(character.body);
    if (body.state == nullptr) return;
    DrawnCharacter drawn = {};
    drawn.character = records_.characters.slot_map().template id_of<CharacterId>(slot);
    drawn.body = character.body;
    drawn.footing = state.footing;
    drawn.ground = state.ground;
    sketch_.point(state.ground ? state.foot_at : body.pose.position, drawn.foot);
    sketch_.vector(state.normal, drawn.normal);
    const double gravity = length(real(world_.settings().gravity)) * to_double(character.gravity_scale);
    drawn.weight = static_cast<float>(to_double(character.mass) * gravity);
    sketch_.vector(state.velocity, drawn.velocity);
    drawn.stuck = state.stuck;
    to_.character(drawn);
  }

  template <class T> static ISO_INLINE D real(Vec3<T> v) { return {to_double(v.x), to_double(v.y), to_double(v.z)}; }
  template <class T> static ISO_INLINE Quat<double> real(const Quat<T>& q) {
    return normalise(Quat<double>{to_double(q.x), to_double(q.y), to_double(q.z), to_double(q.w)});
  }
  ISO_INLINE void put(D point, float (&out)[3]) const {
    for (int i = 0; i < 3; ++i) out[i] = static_cast<float>(point[i] - sketch_.origin()[i]);
  }
  static ISO_INLINE Quat<double> about(D axis, double angle) {
    const SinCos<double> half = sin_cos(0.5 * angle);
    return {axis.x * half.sin, axis.y * half.sin, axis.z * half.sin, half.cos};
  }
  /// Returns the shortest turn that leads y there.
  static ISO_INLINE Quat<double> from_y_to(D axis) {
    constexpr double kOpposite = -0.999999;
    if (axis.y < kOpposite) return {1, 0, 0, 0};
    return normalise(Quat<double>{axis.z, 0, -axis.x, 1 + axis.y});
  }

  const World<S>& world_;
  const RecordStore<S>& records_;
  DebugDraw& to_;
  const Sketch<S>& sketch_;
};

}  // namespace isostep::detail
