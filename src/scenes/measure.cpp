// Measures: the world's records read as doubles.
// SPDX-License-Identifier: MIT
#include "measure.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "distance.hpp"
#include "isostep/store/state.hpp"

namespace isostep::scenes {
namespace {

template <class U> Quat<double> unit_in_double(const Quat<U>& q) { return normalise(in_double(q)); }

template <class S, class Visit> void each_body(const WorldState<S>& state, Visit&& visit) {
  const auto each = [&](const BodySet<S>& set) {
    for (std::size_t i = 0; i < set.states.size(); ++i) visit(set.states[i], set.properties[i]);
  };
  state.static_bodies.each(visit);
  each(state.awake);
  for (const auto& island : state.sleeping) each(island->bodies);
}

/// A part of a body, with its bounds.
struct Part {
  Solid solid;
  std::uint32_t slot;
  bool dynamic;
  Filter filter;
  Vec3<double> low, high;
};

Part part_of(const Solid& solid) {
  Part part = {};
  part.solid = solid;
  if (solid.type == ShapeType::half_space) {
    const double far = std::numeric_limits<double>::infinity();
    part.low = {-far, -far, -far};
    part.high = {far, far, far};
    return part;
  }
  if (solid.type == ShapeType::hull) {
    part.low = part.high = solid.centre + solid.axes * solid.hull->vertices[0];
    for (const Vec3<double> vertex : solid.hull->vertices) {
      const Vec3<double> p = solid.centre + solid.axes * vertex;
      part.low = min(part.low, p);
      part.high = max(part.high, p);
    }
    const Vec3<double> skin = {solid.radius, solid.radius, solid.radius};
    part.low = part.low - skin;
    part.high = part.high + skin;
    return part;
  }
  if (solid.surface != nullptr) {
    const double far = std::numeric_limits<double>::infinity();
    part.low = {far, far, far};
    part.high = {-far, -far, -far};
    for (const auto& triangle : solid.surface->triangles) {
      for (const Vec3<double> vertex : triangle) {
        const Vec3<double> p = solid.centre + solid.axes * vertex;
        part.low = min(part.low, p);
        part.high = max(part.high, p);
      }
    }
    part.low = part.low - Vec3<double>{1, 1, 1};  // what lies under it
    return part;
  }
  const Mat3<double>& m = solid.axes;
  Vec3<double> reach = {0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    const Vec3<double> unit = {i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0};
    const Vec3<double> local = abs(transposed_times(m, unit));
    reach[i] = dot(local, solid.half) + solid.radius;
  }
  part.low = solid.centre - reach;
  part.high = solid.centre + reach;
  return part;
}

template <class S> std::vector<Part> parts_of(const WorldState<S>& state) {
  std::vector<Part> parts;
  std::vector<std::shared_ptr<const SolidHull>> hulls;        // by place
  std::vector<std::shared_ptr<const SolidSurface>> surfaces;  // likewise
  for (const BlobRef& blob : state.geometry->contents()) {
    const bool is_hull = blob != nullptr && blob->type() == ShapeType::hull;
    hulls.push_back(is_hull ? solid_hull(*blob) : nullptr);
    surfaces.push_back(blob != nullptr && !is_hull ? solid_surface(*blob) : nullptr);
  }
  each_body(state, [&](const BodyState<S>& body, const BodyProperties<S>& properties) {
    if (!is_enabled(properties) || (properties.flags & body_flag::kCollide) == 0 ||
        (properties.flags & body_flag::kSensor) != 0)
      return;
    const Mat3<double> axes = to_matrix(unit_in_double(body.orientation));
    const Vec3<double> origin = in_double(body.centre) - axes * in_double(properties.local_centre);
    for (const Child<S>& child : state.shapes[properties.shape]->children) {
      Solid solid = {};
      solid.type = child.primitive.type;
      solid.axes = axes * to_matrix(unit_in_double(child.pose.orientation));
      solid.centre = origin + axes * in_double(child.pose.position);
      solid.half = in_double(child.primitive.half);
      solid.radius = to_double(child.primitive.radius);
      solid.normal = solid.axes * in_double(child.primitive.normal);
      solid.offset = to_double(child.primitive.offset) + dot(solid.normal, solid.centre);
      if (child.primitive.blob != 0) {
        solid.hull = hulls[child.primitive.blob - 1];
        solid.surface = surfaces[child.primitive.blob - 1];
      }
      Part part = part_of(solid);
      part.slot = body.slot;
      part.dynamic = properties.type == BodyType::dynamic;
      part.filter = properties.filter;
      parts.push_back(part);
    }
  });
  return parts;
}

/// Pairs that joints keep from colliding.
template <class S> std::set<std::pair<std::uint32_t, std::uint32_t>> joined_pairs(const WorldState<S>& state) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const auto each = [&](const JointSet<S>& set) {
    for (const JointProperties<S>& joint : set.properties) {
      if ((joint.flags & joint_flag::kCollideConnected) == 0) pairs.insert(std::minmax(joint.body_a, joint.body_b));
    }
  };
  each(state.joints);
  for (const auto& island : state.sleeping) each(island->joints);
  return pairs;
}

bool close(const Part& a, const Part& b, double margin) {
  return a.low.y <= b.high.y + margin && b.low.y <= a.high.y + margin && a.low.z <= b.high.z + margin &&
         b.low.z <= a.high.z + margin;
}

Overlap summary(std::vector<double> depths) {
  Overlap overlap;
  overlap.pairs = static_cast<std::uint32_t>(depths.size());
  if (depths.empty()) return overlap;
  std::sort(depths.begin(), depths.end());
  for (const double depth : depths) {
    overlap.mean += depth / static_cast<double>(depths.size());
    overlap.deep += depth > 0.05 ? 1u : 0u;
  }
  overlap.worst = depths.back() + 0.0;  // no minus zero
  overlap.p99 = depths[(depths.size() * 99 + 99) / 100 - 1];
  return overlap;
}

}  // namespace

/// The parts are sorted along x and swept.
template <class S> Overlap measure_overlap(const World<S>& world) {
  constexpr double kNear = 0.01;  // [m]
  std::vector<Part> parts = parts_of(world.state());
  const auto joined = joined_pairs(world.state());
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.low.x < b.low.x; });
  std::vector<double> depths;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Part& a = parts[i];
    for (std::size_t j = i + 1; j < parts.size() && parts[j].low.x <= a.high.x + kNear; ++j) {
      const Part& b = parts[j];
      if (a.slot == b.slot || !(a.dynamic || b.dynamic) || !close(a, b, kNear)) continue;
      if (!should_collide(a.filter, b.filter) || joined.count(std::minmax(a.slot, b.slot)) != 0) continue;
      const double distance = signed_distance(a.solid, b.solid);
      if (distance < kNear) depths.push_back(max(-distance, 0.0));
    }
  }
  return summary(std::move(depths));
}

/// kappa is mass times inverse inertia about the principal axes.
template <class S> Energy measure_energy(const World<S>& world) {
  Energy energy;
  const Vec3<double> gravity = in_double(world.settings().gravity);
  each_body(world.state(), [&](const BodyState<S>& body, const BodyProperties<S>& properties) {
    if (properties.type != BodyType::dynamic) return;
    const double mass = to_double(properties.mass);
    const Vec3<double> velocity = in_double(body.velocity);
    const Mat3<double> axes =
        to_matrix(unit_in_double(body.orientation)) * to_matrix(unit_in_double(properties.principal));
    const Vec3<double> angular_velocity = transposed_times(axes, in_double(body.angular_velocity)),
                       kappa = in_double(properties.kappa);
    double square = dot(velocity, velocity);
    for (int i = 0; i < 3; ++i) square += kappa[i] > 0 ? angular_velocity[i] * angular_velocity[i] / kappa[i] : 0.0;
    energy.kinetic += 0.5 * mass * square;
    energy.potential -= mass * to_double(properties.gravity_scale) * dot(gravity, in_double(body.centre));
    energy.mass += mass;
  });
  return energy;
}

template <class S> double largest_joint_error(const World<S>& world) {
  double largest = 0;
  for (const JointId joint : world.joints()) largest = max(largest, to_double(world.joint_error(joint)));
  return largest;
}

#define ISO_INSTANTIATE(S)                              \
  template Overlap measure_overlap<S>(const World<S>&); \
  template Energy measure_energy<S>(const World<S>&);   \
  template double largest_joint_error<S>(const World<S>&);
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE)
#undef ISO_INSTANTIATE

}  // namespace isostep::scenes
