// Bodies, joints and contacts without a world around them: what the tests of the direct solver step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/dynamics/solvers/island_solver.hpp"
#include "unit/dynamics/joint_world.hpp"

namespace isostep {
inline namespace direct_world {

/// Boxes on flat ground or on one another, and joints. Gravity may lean: a floor is then a slope.
template <class S> class DirectWorld {
 public:
  using V = Velocity<S>;
  D3 gravity = {0, -10, 0};
  std::int32_t hz = 60, substeps = 2;

  static S number(double x) { return from_double<S>(x); }
  static Vec3<S> vector(D3 a) { return {number(a.x), number(a.y), number(a.z)}; }

  std::uint32_t add_box(D3 centre, double mass, D3 half) {
    BodyState<S> state = {};
    state.slot = static_cast<std::uint32_t>(states.size());
    state.centre = vector(centre);
    state.orientation = Quat<Unit<S>>::identity();
    BodyProperties<S> body = {};
    body.type = BodyType::dynamic;
    body.mass = number(mass);
    const auto kappa = [](double a, double b) { return number(3 / (a * a + b * b)); };
    body.kappa = {kappa(half.y, half.z), kappa(half.x, half.z), kappa(half.x, half.y)};
    body.principal = Quat<Unit<S>>::identity();
    body.gravity_scale = S(1);
    states.push_back(state);
    properties.push_back(body);
    halves.push_back(half);
    return state.slot;
  }
  JointProperties<S>& join(JointType type, std::uint32_t a, std::uint32_t b, D3 at) {
    JointProperties<S> p;
    p.type = type;
    p.body_a = a;
    p.body_b = b;
    p.frame_a.position = a == kNoBody ? vector(at) : vector(at) - states[a].centre;
    p.frame_b.position = b == kNoBody ? vector(at) : vector(at) - states[b].centre;
    joints.push_back(p);
    impulses.push_back({});
    return joints.back();
  }
  /// Four points under box b, on the top of box a or, kNoBody, on the ground at y = 0. They stay where they are on b.
  void rest(std::uint32_t a, std::uint32_t b, double friction) {
    Contact<S> contact = {};
    contact.count = 4;
    contacts.push_back(contact);
    ContactGeometry<S> g = {};
    g.row_a = a == kNoBody ? 0 : a + 1;
    g.row_b = b + 1;
    g.normal = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};
    g.ratio = Unit<S>(1);
    g.material.friction = number(friction);
    geometry.push_back(g);
    step_impulses.push_back(V(0));
  }

  void step() {
    for (ContactGeometry<S>& g : geometry) place(g);
    const auto end_at = [&](std::uint32_t body) {
      if (body == kNoBody) return JointEnd<S>{0, Pose<S>::identity()};
      return JointEnd<S>{body + 1, {states[body].centre, states[body].orientation}};
    };
    std::vector<JointEnds<S>> ends;
    for (const JointProperties<S>& joint : joints) ends.push_back({end_at(joint.body_a), end_at(joint.body_b)});
    const StepContext<S> context = {.states = states,
                                    .properties = properties,
                                    .contacts = contacts,
                                    .geometry = geometry,
                                    .step_impulses = step_impulses,
                                    .joint_properties = joints,
                                    .joint_states = impulses,
                                    .joint_ends = ends,
                                    .gravity = vector(gravity),
                                    .hz = hz,
                                    .substeps = substeps,
                                    .contact_kernels = contact_kernels<S>(Simd::scalar),
                                    .tree_kernels = tree_kernels<S>(Simd::scalar),
                                    .body_kernels = body_kernels<S>(Simd::scalar)};
    solver.colour_constraints(context);
    solver.prepare(context);
    solver.solve_substeps(context);
    solver.store_impulses(context);
  }

  D3 centre(std::uint32_t b) const {
    const Vec3<S>& c = states[b].centre;
    return {to_double(c.x), to_double(c.y), to_double(c.z)};
  }
  /// [N] The force of an impulse a sub-step between two bodies.
  double force(V impulse, std::uint32_t a, std::uint32_t b) const {
    const auto inverse = [&](std::uint32_t body) { return body == kNoBody ? 0 : 1 / to_double(properties[body].mass); };
    return to_double(impulse) * hz * substeps / (inverse(a) + inverse(b));
  }
  double separation(std::size_t j) const {
    const auto end = [&](std::uint32_t body, Vec3<S> local) {
      const Vec3<S> p = body == kNoBody ? local : states[body].centre + to_matrix(states[body].orientation) * local;
      return D3{to_double(p.x), to_double(p.y), to_double(p.z)};
    };
    return norm(end(joints[j].body_b, joints[j].frame_b.position) - end(joints[j].body_a, joints[j].frame_a.position));
  }

  std::vector<BodyState<S>> states;
  std::vector<BodyProperties<S>> properties;
  std::vector<D3> halves;
  std::vector<JointProperties<S>> joints;
  std::vector<JointState<S>> impulses;
  std::vector<Contact<S>> contacts;
  std::vector<ContactGeometry<S>> geometry;
  std::vector<V> step_impulses;
  IslandSolver<S> solver = IslandSolver<S>(IslandMethod::pivoting);

 private:
  void place(ContactGeometry<S>& g) {
    const std::uint32_t b = g.row_b - 1;
    const D3 half = halves[b], at = centre(b);
    const bool ground = g.row_a == 0;
    const D3 below = ground ? D3{0, 0, 0} : centre(g.row_a - 1);
    const double top = ground ? 0 : halves[g.row_a - 1].y;
    for (int i = 0; i < 4; ++i) {
      const D3 corner = {(i & 1) != 0 ? half.x : -half.x, -half.y, (i & 2) != 0 ? half.z : -half.z};
      auto& point = g.points[i];
      point.arm_b = vector(corner);
      point.arm_a = vector({at.x + corner.x - below.x, at.y + corner.y - below.y, at.z + corner.z - below.z});
      point.separation = number(at.y + corner.y - below.y - top);
    }
  }
};

}  // namespace direct_world
}  // namespace isostep
