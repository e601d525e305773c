// Bodies of debug_draw.hpp: worlds of bodies.
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>

#include "isostep/collision/narrowphase/collide.hpp"
#include "isostep/draw/debug_draw_movers.inl"
#include "isostep/draw/debug_draw_particles.inl"
#include "isostep/geometry/surfaces.hpp"
#include "isostep/scalar/environment.hpp"
#include "isostep/store/body_frames.hpp"
#include "isostep/store/state.hpp"
#include "isostep/store/view_manifold.hpp"

namespace isostep {

namespace detail {

/// Returns the content id of a blob drawn with a radius around it; for 0 the id of the blob.
ISO_INLINE ContentId drawn_content(ContentId blob, float radius) {
  constexpr std::uint64_t kSpread = 0x9e3779b97f4a7c15u;
  if (radius != 0) blob.low ^= std::bit_cast<std::uint32_t>(radius) * kSpread;
  return blob;
}

/// One call of draw on a world of bodies.
template <class S> class BodySketch {
 public:
  ISO_INLINE BodySketch(const World<S>& world, DebugDraw& to, const DrawOptions& options)
      : world_(world), state_(world.state()), to_(to), options_(options), sketch_(options) {}

  ISO_INLINE void draw_all() const {
    const bool any = options_.bodies || options_.masses || options_.boxes;
    if (any) {
      for (std::size_t p = 0; p < state_.static_bodies.pages(); ++p)
        draw_set(state_.static_bodies.page(p), false, DrawnBody::kNoIsland);
      draw_set(state_.awake, true, DrawnBody::kNoIsland);
      for (std::uint32_t i = 0; i < state_.sleeping.size(); ++i) draw_set(state_.sleeping[i]->bodies, false, i);
    }
    for (std::uint32_t i = 0; options_.islands && i < state_.sleeping.size(); ++i) draw_island(*state_.sleeping[i], i);
    if (options_.contacts) {
      for (const Contact<S>& contact : state_.contacts) draw_contact(contact, false);
      for (const auto& island : state_.sleeping) {
        for (const Contact<S>& contact : island->contacts) draw_contact(contact, true);
      }
    }
    if (options_.joints) {
      draw_joints(state_.joints, false);
      for (const auto& island : state_.sleeping) draw_joints(island->joints, true);
    }
    const MoverSketch<S> movers(world_, to_, sketch_);
    if (options_.wheels) movers.draw_wheels();
    if (options_.characters) movers.draw_characters();
  }

 private:
  ISO_INLINE BodyId id_of(std::uint32_t slot) const {
    return slot == kNoBody ? BodyId{} : state_.body_slots.template id_of<BodyId>(slot);
  }

  ISO_INLINE void draw_set(const BodySet<S>& set, bool awake, std::uint32_t island) const {
    for (std::size_t i = 0; i < set.states.size(); ++i) {
      const BodyState<S>& state = set.states[i];
      const BodyProperties<S>& properties = set.properties[i];
      if (options_.bodies) draw_body(state, properties, awake, island);
      if (options_.masses && properties.type == BodyType::dynamic) draw_mass(state, properties);
      if (options_.boxes) {
        DrawnBox box = {id_of(state.slot), {}, {}};
        sketch_.point(state.fat.low, box.low);
        sketch_.point(state.fat.high, box.high);
        to_.box(box);
      }
    }
  }

  ISO_INLINE void draw_body(const BodyState<S>& state, const BodyProperties<S>& properties, bool awake,
                            std::uint32_t island) const {
    const BodyView<S> view = world_.view(id_of(state.slot));
    DrawnBody body = {};
    body.body = id_of(state.slot);
    body.type = properties.type;
    body.awake = awake;
    body.sensor = (properties.flags & body_flag::kSensor) != 0;
    body.island = island;
    body.user_data = properties.user_data;
    body.pose = sketch_.pose(view.pose);
    sketch_.vector(state.velocity, body.velocity);
    sketch_.vector(state.angular_velocity, body.angular_velocity);
    to_.body(body);
    for (std::uint32_t child = 0; child < view.children.size(); ++child) draw_part(body, view, child);
  }

  ISO_INLINE void draw_part(const DrawnBody& body, const BodyView<S>& view, std::uint32_t index) const {
    const Child<S>& child = view.children[index];
    const Primitive<S>& primitive = child.primitive;
    const ShapeView<S> shape_view = view.contents.view(primitive);
    const Pose<S> pose = child.pose.is_identity() ? view.pose : compose(view.pose, child.pose);
    DrawnPart part = {};
    part.type = primitive.type;
    part.child = index;
    part.sensor = body.sensor || child.traits.has(part_flag::kSensor);
    part.pose = sketch_.pose(
        visit_shape(shape_view, [&](const auto& shape) ISO_INLINE_LAMBDA { return shape.drawn_at(view.pose, pose); }));
    sketch_.vector(primitive.half, part.half);
    part.radius = sketch_.number(primitive.radius);
    sketch_.vector(rotate(pose.orientation, primitive.normal), part.normal);
    if (primitive.blob != 0) part.content = drawn_content(state_.geometry->names()[primitive.blob - 1].id, part.radius);
    to_.part(body, part);
    if (primitive.blob != 0 && to_.wants_triangles(part)) draw_triangles(shape_view);
    if (options_.lines) draw_lines(body, shape_view, Transform<S>::of(pose));
  }
  ISO_INLINE void draw_triangles(ShapeView<S> view) const {
    visit_shape(view, [&](const auto& shape) ISO_INLINE_LAMBDA {
      shape.visit_triangles([&](Vec3<S> a, Vec3<S> b, Vec3<S> c) ISO_INLINE_LAMBDA {
        DrawnTriangle triangle;
        sketch_.vector(a, triangle.corners[0]);
        sketch_.vector(b, triangle.corners[1]);
        sketch_.vector(c, triangle.corners[2]);
        to_.triangle(triangle);
      });
    });
  }
  ISO_INLINE void draw_lines(const DrawnBody& body, ShapeView<S> view, const Transform<S>& at) const {
    visit_shape(view, [&](const auto& shape) ISO_INLINE_LAMBDA {
      shape.visit_lines([&](Vec3<S> from, Vec3<S> to) ISO_INLINE_LAMBDA {
        DrawnLine line = {body.body, {}, {}};
        sketch_.point(to_world(at, from), line.from);
        sketch_.point(to_world(at, to), line.to);
        to_.line(line);
      });
    });
  }

  /// Draws a mass. kappa is mass times inverse inertia.
  ISO_INLINE void draw_mass(const BodyState<S>& state, const BodyProperties<S>& properties) const {
    DrawnMass mass = {};
    mass.body = id_of(state.slot);
    mass.frame = sketch_.pose({state.centre, state.orientation * properties.principal});
    mass.mass = sketch_.number(properties.mass);
    for (int i = 0; i < 3; ++i) {
      const double kappa = to_double(properties.kappa[i]);
      mass.inertia[i] = kappa > 0 ? static_cast<float>(to_double(properties.mass) / kappa) : 0;
    }
    to_.mass(mass);
  }

  ISO_INLINE void draw_island(const SleepingIsland<S>& island, std::uint32_t index) const {
    Aabb<S> bounds = island.bodies.states[0].fat;
    for (const BodyState<S>& state : island.bodies.states) bounds = merge(bounds, state.fat);
    DrawnIsland drawn = {index,
                         static_cast<std::uint32_t>(island.bodies.states.size()),
                         static_cast<std::uint32_t>(island.contacts.size()),
                         static_cast<std::uint32_t>(island.joints.states.size()),
                         {},
                         {}};
    sketch_.point(bounds.low, drawn.low);
    sketch_.point(bounds.high, drawn.high);
    to_.island(drawn);
  }

  ISO_INLINE void draw_contact(const Contact<S>& contact, bool asleep) const {
    const ContactKey& key = contact.key;
    const BodyView<S> a = world_.view(id_of(key.body_a)), b = world_.view(id_of(key.body_b));
    if (a.state == nullptr || b.state == nullptr) return;
    const Vec3<S> centre = a.state->centre;
    const Leaf leaf_a = leaf_at(a.children, a.contents, key.child_a);
    const Leaf leaf_b = leaf_at(b.children, b.contents, key.child_b);
    const Manifold<S> manifold = manifold_of(a, leaf_a, b, leaf_b);
    if (manifold.count == 0) return;
    DrawnContact drawn = {};
    drawn.a = id_of(key.body_a);
    drawn.b = id_of(key.body_b);
    drawn.child_a = leaf_a.child;
    drawn.child_b = leaf_b.child;
    drawn.asleep = asleep;
    drawn.count = static_cast<std::uint32_t>(manifold.count);
    sketch_.vector(manifold.normal, drawn.normal);
    const double newtons = newtons_of(*a.properties, *b.properties);
    for (std::uint32_t i = 0; i < drawn.count; ++i) {
      const ManifoldPoint<S>& point = manifold.points[i];
      sketch_.point(centre + point.position, drawn.points[i].position);
      drawn.points[i].separation = sketch_.number(point.separation);
      drawn.points[i].feature = point.feature;
      for (std::uint32_t j = 0; j < contact.count; ++j) {
        if (contact.features[j] != point.feature) continue;
        drawn.points[i].force = static_cast<float>(to_double(contact.normal_impulse[j]) * newtons);
        break;
      }
    }
    to_.contact(drawn);
  }

  /// [kg/s] Returns the pair's reduced mass times the rate of integration, by which an impulse becomes a force.
  ISO_INLINE double newtons_of(const BodyProperties<S>& a, const BodyProperties<S>& b) const {
    const Settings<S>& settings = world_.settings();
    const double rate = integration_rate(settings.solver, settings.hz, settings.substeps);
    const double mass_a = to_double(a.mass), mass_b = to_double(b.mass);
    if (a.type != BodyType::dynamic) return b.type == BodyType::dynamic ? mass_b * rate : 0;
    return b.type == BodyType::dynamic ? mass_a * (mass_b / (mass_a + mass_b)) * rate : mass_a * rate;
  }

  ISO_INLINE void draw_joints(const JointSet<S>& set, bool asleep) const {
    for (std::size_t i = 0; i < set.states.size(); ++i) {
      const JointProperties<S>& properties = set.properties[i];
      DrawnJoint drawn = {};
      drawn.joint = state_.joint_slots.template id_of<JointId>(set.states[i].slot);
      drawn.type = properties.type;
      drawn.a = id_of(properties.body_a);
      drawn.b = id_of(properties.body_b);
      drawn.asleep = asleep;
      drawn.user_data = properties.user_data;
      draw_end(drawn.a, properties.frame_a, drawn.frame_a, drawn.centre_a);
      draw_end(drawn.b, properties.frame_b, drawn.frame_b, drawn.centre_b);
      drawn.error = sketch_.number(world_.joint_error(drawn.joint));
      to_.joint(drawn);
    }
  }
  ISO_INLINE void draw_end(BodyId body, const Pose<S>& frame, DrawnPose& anchor, float (&centre)[3]) const {
    const BodyView<S> view = world_.view(body);
    if (view.state == nullptr) {
      anchor = sketch_.pose(frame);
      sketch_.point(frame.position, centre);
      return;
    }
    anchor = sketch_.pose(compose(Pose<S>{view.state->centre, view.state->orientation}, frame));
    sketch_.point(view.state->centre, centre);
  }

  const World<S>& world_;
  const WorldState<S>& state_;
  DebugDraw& to_;
  const DrawOptions& options_;
  Sketch<S> sketch_;
};

}  // namespace detail

template <class S> void draw(const World<S>& world, DebugDraw& to, const DrawOptions& options) {
  pin_floats([&] { detail::BodySketch<S>(world, to, options).draw_all(); });
}
template <class S> void draw(const ParticleWorld<S>& world, DebugDraw& to, const DrawOptions& options) {
  pin_floats([&] {
    const detail::ParticleSketch<S> sketch(world, to, options);
    if (options.particles) sketch.draw_particles();
    if (options.springs) sketch.draw_springs();
    if (options.links) sketch.draw_links();
    if (options.colliders) sketch.draw_colliders();
  });
}

}  // namespace isostep
