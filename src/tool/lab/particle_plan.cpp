// The way from a rigid scene to a plan of particles, rods and scenery.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "model_checks.hpp"
#include "models.hpp"

namespace isostep::tool::lab {
namespace {

constexpr double kNear = 1e-3;  // [1] of a length: off by less is there

/// The reason why a scene has no particles; caught where the offer is made.
struct Refusal {
  std::string reason;
};
[[noreturn]] void refuse(const std::string& reason) { throw Refusal{reason}; }
std::string body_named(std::size_t i) { return "body " + std::to_string(i); }

/// A joint's place: a particle, or a fixed point.
struct Pivot {
  int particle = -1;
  Vec3<double> place = {};
};

class Planner {
 public:
  explicit Planner(const scenes::Scene& scene) : scene_(scene), joints_of_(scene.bodies.size()) {
    for (const scenes::SceneBody& body : scene.bodies) facts_.push_back(facts_of(body));
  }

  ParticlePlan plan() {
    if (scene_.script != scenes::Script::none) refuse("its script makes bodies of its own");
    plan_.gravity = value_of(scene_.gravity);
    add_pivots();
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) add_body(i);
    if (plan_.particles.empty()) refuse("nothing in it moves");
    if (!plan_.rods.empty() && !plan_.scenery.empty()) refuse("its chains and its scenery do not go together");
    const std::string overlap = plan_.rods.empty() ? overlap_of_spheres(scene_, facts_) : "";
    if (!overlap.empty()) refuse(overlap);
    return plan_;
  }

 private:
  const scenes::SceneBody& body(std::size_t i) const { return scene_.bodies[i]; }
  bool moves(int i) const { return i >= 0 && body(static_cast<std::size_t>(i)).type == BodyType::dynamic; }

  void add_pivots() {
    for (std::size_t j = 0; j < scene_.joints.size(); ++j) {
      const scenes::SceneJoint& joint = scene_.joints[j];
      if (joint.type != JointType::ball || joint.flags != 0) refuse("its joints are more than balls in sockets");
      Pivot pivot = {-1, value_of(joint.anchor)};
      const int holder = moves(joint.a) ? joint.a : joint.b;
      if (!moves(holder)) continue;
      if (moves(joint.a) && moves(joint.b)) pivot.particle = add_pivot_particle(pivot.place, holder);
      pivots_.push_back(pivot);
      for (const int i : {joint.a, joint.b}) {
        if (moves(i)) joints_of_[static_cast<std::size_t>(i)].push_back(pivots_.size() - 1);
      }
    }
  }
  int add_pivot_particle(Vec3<double> place, int holder) {
    const BodyFacts& facts = facts_[static_cast<std::size_t>(holder)];
    const Vec3<double> velocity = facts.velocity + cross(facts.angular_velocity, place - facts.centre);
    return add_particle(place, velocity, 0, material_of(body(static_cast<std::size_t>(holder)), 0, false));
  }
  int add_particle(Vec3<double> place, Vec3<double> velocity, double mass, std::size_t material) {
    plan_.particles.push_back({place, velocity, mass, material});
    return static_cast<int>(plan_.particles.size()) - 1;
  }
  /// Friction makes a ball roll, which hardly holds it. A particle cannot roll, and would be held: so it slides. With
  /// friction the 4000 balls of S5 stay in the columns in which they fell.
  std::size_t material_of(const scenes::SceneBody& body, double radius, bool collides) {
    const ParticlePlan::Material material = {radius,
                                             is_ball(body) ? 0 : value_of(body.friction),
                                             value_of(body.restitution),
                                             value_of(body.gravity_scale),
                                             std::exp(-value_of(body.linear_damping)),
                                             collides};
    const auto found = std::find(plan_.materials.begin(), plan_.materials.end(), material);
    const auto place = static_cast<std::size_t>(found - plan_.materials.begin());
    if (found == plan_.materials.end()) plan_.materials.push_back(material);
    return place;
  }

  void add_body(std::size_t i) {
    if (body(i).sensor) refuse(body_named(i) + " is a sensor");
    if (body(i).type == BodyType::kinematic) refuse(body_named(i) + " is moved by hand");
    if (body(i).type == BodyType::static_) return add_scenery(i);
    switch (joints_of_[i].size()) {
      case 0: return add_ball(i);
      case 1: return add_end(i);
      case 2: return add_link(i);
      default: refuse(body_named(i) + " has more than two joints: it is no link of a chain");
    }
  }
  void add_place(Pivot a, Pivot b, double share) {
    plan_.places.push_back({{a.particle, b.particle}, {a.place, b.place}, share, true});
  }
  void add_ball(std::size_t i) {
    const BodyFacts& facts = facts_[i];
    if (!body(i).collide) refuse(body_named(i) + " passes through others");
    const int particle =
        add_particle(facts.centre, facts.velocity, facts.mass, material_of(body(i), facts.radius, true));
    add_place({particle, {}}, {particle, {}}, 0);
  }
  /// A rod from the joint to the centre, where all the mass is.
  void add_end(std::size_t i) {
    require_ghost(i);
    const BodyFacts& facts = facts_[i];
    const Pivot pivot = pivots_[joints_of_[i][0]];
    const double length = length_of(facts.centre - pivot.place);
    if (length < kNear * facts.radius) refuse(body_named(i) + " hangs at its centre: it would only turn");
    const int end = add_particle(facts.centre, facts.velocity, facts.mass, material_of(body(i), 0, false));
    add_rod(pivot, {end, facts.centre}, length);
    add_place(pivot, {end, {}}, 1);
  }
  void add_link(std::size_t i) {
    require_ghost(i);
    const BodyFacts& facts = facts_[i];
    const Pivot a = pivots_[joints_of_[i][0]], b = pivots_[joints_of_[i][1]];
    const Vec3<double> span = b.place - a.place, arm = facts.centre - a.place;
    const double length = length_of(span);
    if (length < kNear * facts.radius) refuse(body_named(i) + " has two joints in one place");
    const double share = dot(arm, span) / (length * length);
    if (share < 0 || share > 1 || length_of(arm - span * share) > kNear * length)
      refuse("the centre of " + body_named(i) + " is not between its joints");
    if (a.particle >= 0) plan_.particles[static_cast<std::size_t>(a.particle)].mass += (1 - share) * facts.mass;
    if (b.particle >= 0) plan_.particles[static_cast<std::size_t>(b.particle)].mass += share * facts.mass;
    add_rod(a, b, length);
    add_place(a, b, share);
  }
  void require_ghost(std::size_t i) {
    if (body(i).collide) refuse(body_named(i) + " is joined and has a shape that others touch");
  }
  void add_rod(Pivot a, Pivot b, double length) {
    if (a.particle < 0) std::swap(a, b);
    if (a.particle < 0) refuse("a body is held by two fixed points");
    plan_.rods.push_back({a.particle, b.particle, b.place, length});
  }

  void add_scenery(std::size_t i) {
    const Vec3<double> centre = facts_[i].centre;
    plan_.places.push_back({{-1, -1}, {centre, centre}, 0, false});
    if (!body(i).collide) return;
    for (const scenes::Solid& solid : facts_[i].solids) {
      ParticlePlan::Scenery scenery = {};
      scenery.is_plane = true;
      if (solid.type == ShapeType::box) {
        if (!find_face(solid, scenery)) refuse(body_named(i) + " is a box with bodies on more than one side");
      } else if (solid.type == ShapeType::half_space) {
        scenery.normal = solid.normal;
        scenery.offset = solid.offset;
      } else if (solid.type == ShapeType::capsule) {
        const Vec3<double> half = solid.axes.column(1) * solid.half.y;
        scenery = {false, {}, 0, solid.centre - half, solid.centre + half, solid.radius};
      } else {
        refuse(body_named(i) + " is a fixed " + kShapeNames[static_cast<std::size_t>(solid.type)]);
      }
      plan_.scenery.push_back(scenery);
    }
  }
  /// The widest face that the centres of all that moves are in front of.
  bool find_face(const scenes::Solid& box, ParticlePlan::Scenery& plane) const {
    double widest = 0;
    for (int side = 0; side < 6; ++side) {
      const int axis = side / 2;
      const Vec3<double> normal = box.axes.column(axis) * (side % 2 == 0 ? 1.0 : -1.0);
      const double offset = dot(normal, box.centre) + box.half[axis];
      const double area = box.half[(axis + 1) % 3] * box.half[(axis + 2) % 3];
      bool clear = area > widest;
      for (std::size_t i = 0; clear && i < facts_.size(); ++i)
        clear = !moves(static_cast<int>(i)) || dot(normal, facts_[i].centre) >= offset;
      if (!clear) continue;
      widest = area;
      plane.normal = normal;
      plane.offset = offset;
    }
    return widest > 0;
  }

  const scenes::Scene& scene_;
  std::vector<BodyFacts> facts_;
  std::vector<std::vector<std::size_t>> joints_of_;  // a body's, as places in pivots_
  std::vector<Pivot> pivots_;
  ParticlePlan plan_;
};

}  // namespace

Offer<ParticlePlan> particle_model(const scenes::Scene& scene) {
  try {
    return {Planner(scene).plan(), ""};
  } catch (const Refusal& refusal) {
    return {{}, refusal.reason};
  }
}

}  // namespace isostep::tool::lab
