// The recorder of what is drawn.
// SPDX-License-Identifier: MIT
#include "recorder.hpp"

#include <algorithm>
#include <cmath>

#include "isostep/math/quat.hpp"

namespace isostep::tool::page {
namespace {

constexpr const char* kSpringKinds[] = {"spring", "bungee", "stiff"};
constexpr const char* kLinkKinds[] = {"cable", "rod"};
constexpr float kWheelWidth = 0.3f;  // [1] half of it by the radius: records of wheels have none

std::array<float, 3> array_of(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

Quat<double> quaternion(const float (&q)[4]) { return {q[0], q[1], q[2], q[3]}; }
std::array<float, 3> turned_back(const Quat<double>& q, Vec3<double> v) {
  const Vec3<double> local = transposed_times(to_matrix(normalise(q)), v);
  return {static_cast<float>(local.x), static_cast<float>(local.y), static_cast<float>(local.z)};
}

Pose rounded(const DrawnPose& pose) {
  Pose out;
  for (std::size_t i = 0; i < 3; ++i) {
    const double steps = std::clamp(std::round(pose.position[i] / kGrid), -2147483648.0, 2147483647.0);
    out.at[i] = static_cast<std::int32_t>(steps);
  }
  out.turn = pack_turn(pose.orientation);
  return out;
}

/// The force as ContactPoint::force holds it.
std::uint8_t packed_force(double newtons) {
  return static_cast<std::uint8_t>(std::min(255.0, std::round(16 * std::log2(1 + std::max(0.0, newtons)))));
}

}  // namespace

void Recorder::begin(std::uint64_t tick, std::uint64_t hash, double energy) {
  recording_.frames.push_back({tick, hash, energy, 0, {}, {}, {}, {}});
  recording_.scenery.clear();
}

/// An actor that was not drawn in this frame is gone.
void Recorder::finish() {
  for (std::uint32_t actor = 0; actor < casts_.size(); ++actor) {
    if (casts_[actor].seen == now() || casts_[actor].is == Change::gone) continue;
    casts_[actor].is = Change::gone;
    frame().changed.push_back({actor, Change::gone});
  }
  std::sort(frame().moved.begin(), frame().moved.end(),
            [](const Moved& a, const Moved& b) { return a.actor < b.actor; });
}

/// Finds or adds the actor. Returns whether it is new.
bool Recorder::cast(std::vector<Known>& all, std::uint32_t slot, std::uint32_t generation, std::uint32_t& actor) {
  if (all.size() <= slot) all.resize(slot + 1);
  Known& known = all[slot];
  const bool fresh = known.index == kNone || known.generation != generation;
  if (fresh) {
    known = {generation, static_cast<std::uint32_t>(casts_.size())};
    casts_.emplace_back();
    recording_.actors.push_back({slot, generation, BodyType::dynamic, false, 0, {}, false});
  }
  actor = known.index;
  return fresh;
}

void Recorder::appear(std::uint32_t actor, const DrawnPose& drawn, Change is) {
  Cast& known = casts_[actor];
  const Pose pose = rounded(drawn);
  if (known.seen == kNone || !(pose == known.pose)) frame().moved.push_back({actor, pose});
  if (known.is != is) frame().changed.push_back({actor, is});
  known.pose = pose;
  known.is = is;
  known.seen = now();
  std::copy(drawn.position, drawn.position + 3, known.at);
  std::copy(drawn.orientation, drawn.orientation + 4, known.turn);
}

void Recorder::body(const DrawnBody& body) {
  std::uint32_t actor = 0;
  parts_wanted_ = cast(by_slot_, body.body.slot, body.body.generation, actor);
  recording_.actors[actor].type = body.type;
  recording_.actors[actor].sensor = body.sensor;
  appear(actor, body.pose, body.awake || body.type == BodyType::static_ ? Change::awake : Change::asleep);
}

void Recorder::part(const DrawnBody& body, const DrawnPart& part) {
  if (!parts_wanted_) return;
  const auto actor = actor_of(body.body.slot);
  const Quat<double> q = quaternion(body.pose.orientation);
  const Quat<double> turn = normalise(conjugate(q) * quaternion(part.pose.orientation));
  recording_.actors[static_cast<std::size_t>(actor)].parts.push_back(
      {part.type,
       array_of(part.half),
       part.radius,
       local(actor, part.pose.position),
       {static_cast<float>(turn.x), static_cast<float>(turn.y), static_cast<float>(turn.z), static_cast<float>(turn.w)},
       turned_back(q, {part.normal[0], part.normal[1], part.normal[2]})});
}

/// The part has been told just now: the last of the actor told last.
bool Recorder::wants_triangles(const DrawnPart& part) {
  if (!parts_wanted_) return false;
  std::uint32_t& surface = recording_.actors.back().parts.back().surface;
  surface = recording_.surfaces.find(part.content);
  const bool fresh = surface == Surfaces::kNone;
  if (fresh) surface = recording_.surfaces.begin(part.content);
  return fresh;
}
void Recorder::triangle(const DrawnTriangle& triangle) { recording_.surfaces.add(triangle); }

void Recorder::contact(const DrawnContact& contact) {
  ContactPoint kept = {};
  for (std::size_t i = 0; i < 3; ++i) kept.normal[i] = static_cast<std::int8_t>(std::lround(contact.normal[i] * 127));
  for (std::uint32_t i = 0; i < contact.count; ++i) {
    const DrawnContact::Point& point = contact.points[i];
    frame().depth = std::max(frame().depth, -double{point.separation});
    kept.at = array_of(point.position);
    kept.force = packed_force(double{point.force});
    frame().points.push_back(kept);
  }
}

/// A force at a point, drawn as those of contacts are.
void Recorder::point(const float (&at)[3], const float (&force)[3]) {
  const Vec3<double> newtons = {double{force[0]}, double{force[1]}, double{force[2]}};
  const double size = length(newtons);
  if (!(size > 0)) return;
  ContactPoint kept = {array_of(at), {}, packed_force(size)};
  for (int i = 0; i < 3; ++i)
    kept.normal[static_cast<std::size_t>(i)] = static_cast<std::int8_t>(std::lround(newtons[i] / size * 127));
  frame().points.push_back(kept);
}

/// An actor of its own: a disc, and two forces where it meets the ground.
void Recorder::wheel(const DrawnWheel& wheel) {
  std::uint32_t index = 0;
  if (cast(wheels_, wheel.wheel.slot, wheel.wheel.generation, index)) {
    Actor& actor = recording_.actors[index];
    actor.wheel = true;
    const float half = kWheelWidth * wheel.radius;
    actor.parts.push_back({ShapeType::cylinder, {0, half, 0}, wheel.radius, {0, 0, 0}, {0, 0, 0, 1}, {0, 0, 0}});
  }
  appear(index, wheel.pose, wheel.awake ? Change::awake : Change::asleep);
  if (!wheel.ground) return;
  float load[3];
  for (int i = 0; i < 3; ++i) load[i] = wheel.load * wheel.normal[i];
  point(wheel.contact, load);
  point(wheel.contact, wheel.grip);
}
/// Its weight along the normal of what it stands on.
void Recorder::character(const DrawnCharacter& character) {
  float weight[3];
  for (int i = 0; i < 3; ++i) weight[i] = character.weight * character.normal[i];
  point(character.foot, weight);
}

void Recorder::particle(const DrawnParticle& particle) {
  recording_.particles = true;
  std::uint32_t actor = 0;
  cast(by_slot_, particle.particle.slot, particle.particle.generation, actor);
  recording_.actors[actor].type = particle.pinned ? BodyType::kinematic : BodyType::dynamic;
  recording_.actors[actor].radius = particle.radius;
  DrawnPose pose = {{}, {0, 0, 0, 1}};
  std::copy(particle.position, particle.position + 3, pose.position);
  appear(actor, pose, Change::awake);
}

std::int32_t Recorder::actor_of(std::uint32_t slot) const {
  if (slot >= by_slot_.size() || by_slot_[slot].index == kNone) return Bond::kNobody;
  return static_cast<std::int32_t>(by_slot_[slot].index);
}
std::array<float, 3> Recorder::local(std::int32_t actor, const float (&point)[3]) const {
  if (actor == Bond::kNobody) return array_of(point);
  const Cast& known = casts_[static_cast<std::size_t>(actor)];
  const Vec3<double> from = {double{point[0]} - known.at[0], double{point[1]} - known.at[1],
                             double{point[2]} - known.at[2]};
  return turned_back(quaternion(known.turn), from);
}

/// The bond of that id if it is new, to be filled in; null when it was known. It is there now either way.
template <class IdType> Bond* Recorder::bond(std::vector<Known>& all, IdType id) {
  if (all.size() <= id.slot) all.resize(id.slot + 1);
  Known& known = all[id.slot];
  if (known.index != kNone && known.generation == id.generation) {
    recording_.bonds[known.index].last = now();
    return nullptr;
  }
  known = {id.generation, static_cast<std::uint32_t>(recording_.bonds.size())};
  recording_.bonds.push_back({"", Bond::kNobody, Bond::kNobody, {}, {}, now(), now()});
  return &recording_.bonds.back();
}

void Recorder::joint(const DrawnJoint& joint) {
  Bond* const fresh = bond(joints_, joint.joint);
  if (fresh == nullptr) return;
  fresh->kind = kJointNames[static_cast<std::size_t>(joint.type)];
  if (joint.a) fresh->a = actor_of(joint.a.slot);
  if (joint.b) fresh->b = actor_of(joint.b.slot);
  fresh->at_a = local(fresh->a, joint.frame_a.position);
  fresh->at_b = local(fresh->b, joint.frame_b.position);
}
void Recorder::spring(const DrawnSpring& spring) {
  Bond* const fresh = bond(springs_, spring.spring);
  if (fresh == nullptr) return;
  fresh->kind = kSpringKinds[static_cast<std::size_t>(spring.type)];
  fresh->a = actor_of(spring.a.slot);
  if (spring.b) fresh->b = actor_of(spring.b.slot);
  else fresh->at_b = array_of(spring.to);
}
void Recorder::link(const DrawnLink& link) {
  Bond* const fresh = bond(links_, link.link);
  if (fresh == nullptr) return;
  fresh->kind = kLinkKinds[static_cast<std::size_t>(link.type)];
  fresh->a = actor_of(link.a.slot);
  if (link.b) fresh->b = actor_of(link.b.slot);
  else fresh->at_b = array_of(link.to);
}
void Recorder::collider(const DrawnCollider& collider) {
  recording_.scenery.push_back({collider.type == ColliderType::plane, array_of(collider.normal),
                                array_of(collider.start), array_of(collider.end), collider.radius});
}

void Recorder::effect(std::uint32_t slot, std::uint32_t generation, BodyId body, Effect told) {
  if (body) told.actor = actor_of(body.slot);
  const auto fresh = static_cast<std::uint32_t>(recording_.effects.size());
  const std::uint64_t id = std::uint64_t{generation} << 32 | slot;
  std::uint32_t& index = effects_.try_emplace({told.kind, id}, fresh).first->second;
  if (index != fresh) {
    const Effect& known = recording_.effects[index];
    if (known.numbers != told.numbers || known.actor != told.actor) index = fresh;
  }
  effect_ = index;
  if (index == fresh) {
    told.first = now();
    recording_.effects.push_back(std::move(told));
  }
  recording_.effects[index].last = now();
}
void Recorder::push(Vector force, double control) {
  frame().pushes.push_back({effect_,
                            {static_cast<float>(force.x), static_cast<float>(force.y), static_cast<float>(force.z)},
                            static_cast<float>(control)});
}
/// Worlds of bodies have no other springs.
void Recorder::body_spring(BodySpringId id, BodyId a, BodyId b, Vector at_a, Vector at_b, bool only_pulls) {
  Bond* const fresh = bond(springs_, id);
  if (fresh == nullptr) return;
  const auto array = [](Vector v) {
    return std::array<float, 3>{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
  };
  fresh->kind = kSpringKinds[only_pulls ? 1 : 0];
  fresh->a = actor_of(a.slot);
  if (b) fresh->b = actor_of(b.slot);
  fresh->at_a = array(at_a);
  fresh->at_b = array(at_b);
}

}  // namespace isostep::tool::page
