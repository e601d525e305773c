// Peers: S9's exchange of bodies, measures.
// SPDX-License-Identifier: MIT
#include "peer.hpp"

#include <algorithm>
#include <cmath>

#include "scenes/build.hpp"
#include "scenes/named.hpp"

namespace isostep::bench {
namespace {

bool is_number(const Motion& m) {
  return is_finite(m.position) && is_finite(m.velocity) && is_finite(m.angular_velocity) &&
         std::isfinite(m.orientation.w);
}

bool follows(scenes::Script script) {
  return script == scenes::Script::none || script == scenes::Script::mixer || script == scenes::Script::hit;
}

/// The rotation from the principal axes to the scene's frame of the body.
Quat<double> body_axes(const PeerBody& body, const Motion& at) {
  return body.frame.is_identity() ? at.orientation : normalise(at.orientation * conjugate(body.frame.orientation));
}

}  // namespace

Peer::Peer(const scenes::Scene& scene) : scene_(scene), gravity_(peer_gravity(scene)) {
  if (!follows(scene.script)) throw scenes::SceneError("", "peers cannot follow this script");
  if (!(scene.restitution_threshold == scenes::Scene{}.restitution_threshold)) {
    throw scenes::SceneError("", "peers are given no threshold of restitution");
  }
  const bool fast = has_fast_bodies(scene);
  for (const scenes::SceneBody& body : scene.bodies) {
    bodies_.push_back(peer_body(body));
    bodies_.back().fast = fast && body.type == BodyType::dynamic;
  }
  for (const scenes::SceneJoint& joint : scene.joints) joints_.push_back(peer_joint(joint, bodies_));
  for (const scenes::SceneRecord& record : scene.records) {
    if (record.kind == "thruster") forces_.push_back(peer_force(record, scene.bodies));
    else gears_.push_back(peer_gear(record, scene.joints));
  }
}

void Peer::before_step(int frame) {
  frames_ = frame + 1;
  drive(frame);
  if (scene_.script == scenes::Script::mixer) exchange(frame);
  if (scene_.script == scenes::Script::hit) hit(frame);
}

/// Exchanges bodies as scenes::before_step does it for a World: the drum is body 0, the others are replaced in turn.
void Peer::exchange(int frame) {
  if (frame < 4 || frame >= scenes::kMixerBirthsEnd || frame % 4 != 0) return;
  const int turn = frame / 4 - 1;
  const std::size_t oldest = 1 + static_cast<std::size_t>(turn) % (bodies_.size() - 1);
  scene_.bodies[oldest] = scenes::mixer_body(static_cast<int>(bodies_.size()) - 1 + turn);
  bodies_[oldest] = peer_body(scene_.bodies[oldest]);
  replace(oldest, bodies_[oldest]);
}
void Peer::hit(int frame) {
  if (frame != 120) return;
  std::size_t last = bodies_.size() - 1;
  while (last > 0 && bodies_[last].type != BodyType::dynamic) --last;
  launch(last, {0, -20, 0});
}

bool Peer::allow_sleep() const {
  const auto may = [](const scenes::SceneBody& body) { return body.type == BodyType::dynamic && body.allow_sleep; };
  return scene_.allow_sleep && std::any_of(scene_.bodies.begin(), scene_.bodies.end(), may);
}
bool Peer::all_asleep() const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].type == BodyType::dynamic && motion(i).awake) return false;
  }
  return true;
}

int Peer::faults() const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (!is_number(motion(i))) return 1;
  }
  return 0;
}

scenes::Sight Peer::sight() const {
  scenes::Sight sight;
  sight.time = frames_ / hz();
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Motion at = motion(i);
    const bool dynamic = bodies_[i].type == BodyType::dynamic;
    sight.bodies.push_back(
        {at.position, body_axes(bodies_[i], at), at.velocity, at.angular_velocity, dynamic, dynamic && at.awake});
  }
  sight.joint_error = joint_error();
  sight.energy = energy();
  sight.faults = faults();
  return sight;
}

PeerEnd Peer::end_now(int body, const PeerEnd& end) const {
  if (body < 0) return end;
  const Motion at = motion(static_cast<std::size_t>(body));
  return {at.position + to_matrix(at.orientation) * end.position, normalise(at.orientation * end.orientation)};
}

/// The error as World::joint_error measures it.
double Peer::joint_error() const {
  double largest = 0;
  for (const PeerJoint& joint : joints_) {
    if (joint.is_spring && joint.type == JointType::distance) continue;
    const PeerEnd on_a = end_now(joint.a, joint.on_a), on_b = end_now(joint.b, joint.on_b);
    Vec3<double> apart = on_b.position - on_a.position;
    const Vec3<double> axis = to_matrix(on_a.orientation).column(2);
    if (joint.type == JointType::slider) apart = apart - axis * dot(apart, axis);
    const double length = std::sqrt(dot(apart, apart));
    const bool distance = joint.type == JointType::distance;
    largest = std::max(largest, distance ? std::max(length - joint.upper, joint.lower - length) : length);
  }
  return largest;
}

scenes::Energy Peer::energy() const {
  scenes::Energy energy;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i].type != BodyType::dynamic) continue;
    const Motion at = motion(i);
    const Vec3<double> angular_velocity = transposed_times(to_matrix(at.orientation), at.angular_velocity);
    energy.kinetic += 0.5 * (bodies_[i].mass * dot(at.velocity, at.velocity) +
                             dot(angular_velocity, scale(bodies_[i].inertia, angular_velocity)));
    energy.potential -= bodies_[i].mass * bodies_[i].gravity_scale * dot(gravity_, at.position);
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
    const Quat<double> q = body_axes(bodies_[i], at);
    const Vec3<double> origin = at.position - to_matrix(q) * bodies_[i].frame.position;
    now.bodies[i].position = {origin.x, origin.y, origin.z};
    now.bodies[i].orientation = {q.x, q.y, q.z, q.w};
    now.bodies[i].velocity = scenes::zero_vector();
    now.bodies[i].angular_velocity = scenes::zero_vector();
  }
  World<double> world(scenes::settings_of<double>(now));
  scenes::build(now, world);
  return scenes::measure_overlap(world);
}

}  // namespace isostep::bench
