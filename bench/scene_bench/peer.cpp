// Peers: scene to doubles, S9's exchange of bodies, measures.
// SPDX-License-Identifier: MIT
#include "peer.hpp"

#include <algorithm>
#include <cmath>

#include "isostep/geometry/mass_properties.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"

namespace isostep::bench {
namespace {

double real(const scenes::Number& number) { return scenes::value_of<double>(number, "peer"); }
Vec3<double> real(const scenes::Vector& v) { return {real(v[0]), real(v[1]), real(v[2])}; }
Quat<double> real(const scenes::Rotation& q) { return {real(q[0]), real(q[1]), real(q[2]), real(q[3])}; }

PeerPart peer_part(const scenes::ScenePart& part) {
  if (part.type == ShapeType::half_space) throw scenes::SceneError("", "peers are not given half-spaces");
  return {part.type,           real(part.half_extents), real(part.radius), real(part.half_height),
          real(part.position), real(part.orientation)};
}

Primitive<double> primitive(const PeerPart& part) {
  switch (part.type) {
    case ShapeType::sphere: return primitive_of(Sphere<double>{part.radius});
    case ShapeType::capsule: return primitive_of(Capsule<double>{part.radius, part.half_height});
    default: return primitive_of(Box<double>{part.half_extents});
  }
}

/// The mass and inertia that World<double> would give the body.
void set_mass(PeerBody& body, const scenes::SceneBody& of) {
  const PeerPart& part = body.parts.front();
  if (body.parts.size() != 1 || !(part.position == Vec3<double>::zero())) {
    throw scenes::SceneError("", "peers are not given dynamic compounds");
  }
  const Child<double> child = {primitive(part), Pose<double>::identity()};
  MassProperties<double> p = mass_properties<double>(std::span<const Child<double>>(&child, 1), real(of.density));
  if (real(of.mass) > 0) p = with_mass(p, real(of.mass));
  body.mass = p.mass;
  body.inertia = {p.mass / p.kappa.x, p.mass / p.kappa.y, p.mass / p.kappa.z};
}

bool is_number(const Motion& m) {
  return is_finite(m.position) && is_finite(m.velocity) && is_finite(m.spin) && std::isfinite(m.orientation.w);
}

}  // namespace

PeerBody peer_body(const scenes::SceneBody& of) {
  PeerBody body = {};
  body.type = of.type;
  for (const scenes::ScenePart& part : of.parts) body.parts.push_back(peer_part(part));
  body.position = real(of.position);
  body.velocity = real(of.velocity);
  body.spin = real(of.angular_velocity);
  body.orientation = normalise(real(of.orientation));
  body.friction = real(of.friction);
  body.collide = of.collide;
  if (body.type == BodyType::dynamic) set_mass(body, of);
  return body;
}

Peer::Peer(const scenes::Scene& scene) : scene_(scene), gravity_(real(scene.gravity)) {
  if (scene.script == scenes::Script::mixed) throw scenes::SceneError("", "peers cannot follow this script");
  for (const scenes::SceneBody& body : scene.bodies) bodies_.push_back(peer_body(body));
  const auto local = [&](int body, Vec3<double> anchor) {
    if (body < 0) return anchor;
    const PeerBody& at = bodies_[static_cast<std::size_t>(body)];
    return transposed_times(to_matrix(at.orientation), anchor - at.position);
  };
  for (const scenes::SceneJoint& joint : scene.joints) {
    if (joint.type != JointType::ball || joint.flags != 0)
      throw scenes::SceneError("", "peers are given plain ball joints");
    const Vec3<double> anchor = real(joint.anchor);
    joints_.push_back({joint.a, joint.b, anchor});
    anchors_.push_back({local(joint.a, anchor), local(joint.b, anchor)});
  }
}

/// As scenes::before_step does it for a World: the drum is body 0, the others are replaced in turn.
void Peer::before_step(int frame, bool script) {
  drive(frame);
  if (!script || scene_.script != scenes::Script::mixer || frame < 4 || frame % 4 != 0) return;
  const int turn = frame / 4 - 1;
  const std::size_t oldest = 1 + static_cast<std::size_t>(turn) % (bodies_.size() - 1);
  scene_.bodies[oldest] = scenes::mixer_body(static_cast<int>(bodies_.size()) - 1 + turn);
  bodies_[oldest] = peer_body(scene_.bodies[oldest]);
  replace(oldest, bodies_[oldest]);
}

int Peer::faults() const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!is_number(motion(i))) return 1;
  }
  return 0;
}

std::vector<Place> Peer::places() const {
  std::vector<Place> places;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    places.push_back({motion(i).position, bodies_[i].type == BodyType::dynamic});
  }
  return places;
}

Vec3<double> Peer::anchor_now(int body, Vec3<double> local) const {
  if (body < 0) return local;
  const Motion at = motion(static_cast<std::size_t>(body));
  return at.position + to_matrix(at.orientation) * local;
}

double Peer::joint_error() const {
  double largest = 0;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const Vec3<double> apart = anchor_now(joints_[i].b, anchors_[i].on_b) - anchor_now(joints_[i].a, anchors_[i].on_a);
    largest = std::max(largest, std::sqrt(dot(apart, apart)));
  }
  return largest;
}

scenes::Energy Peer::energy() const {
  scenes::Energy energy;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].type != BodyType::dynamic) continue;
    const Motion at = motion(i);
    const Vec3<double> spin = transposed_times(to_matrix(at.orientation), at.spin);
    energy.kinetic +=
        0.5 * (bodies_[i].mass * dot(at.velocity, at.velocity) + dot(spin, scale(bodies_[i].inertia, spin)));
    energy.potential -= bodies_[i].mass * dot(gravity_, at.position);
    energy.mass += bodies_[i].mass;
  }
  return energy;
}

/// The scene as the peer left it becomes a world of doubles, which is measured as ours are.
scenes::Overlap Peer::overlap() const {
  if (faults() != 0) return {};
  scenes::Scene now = scene_;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Motion at = motion(i);
    const Quat<double> q = at.orientation;
    now.bodies[i].position = {at.position.x, at.position.y, at.position.z};
    now.bodies[i].orientation = {q.x, q.y, q.z, q.w};
  }
  World<double> world(scenes::settings_of<double>(now));
  scenes::build(now, world);
  return scenes::measure_overlap(world);
}

}  // namespace isostep::bench
