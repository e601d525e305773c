// Bodies of articulated_tree.hpp: checks of a definition, and its preparation.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/articulation/articulated_tree.hpp"
#include "isostep/articulation/articulation_limits.hpp"
#include "isostep/dynamics/checks.hpp"
#include "isostep/geometry/limits.hpp"
#include "isostep/state/hash.hpp"

namespace isostep::detail {

/// Finds the first field that is not as it must be; `ok` if there is none.
class DefinitionCheck {
 public:
  void link(std::uint32_t index) { link_ = index; }
  /// Keeps the error unless `holds`. Returns true if all was well so far.
  bool ask(bool holds, const char* field, const char* expected, ErrorCode code = ErrorCode::invalid) {
    if (holds || !ok_) return ok_;
    also({code, expected, field});
    return false;
  }
  /// Keeps an error that another check found in the same link.
  void also(const Error& error) {
    if (!ok_) return;
    ok_ = false;
    ShortText<64> place;
    if (link_ != kArticulationBase) place.append("links[").append_number(link_).append("].");
    error_ = {error.code, error.message, place.append(error.place.view())};
  }
  Result<void> result() const { return ok_ ? Result<void>() : Result<void>(error_); }
  bool ok() const { return ok_; }

 private:
  bool ok_ = true;
  std::uint32_t link_ = kArticulationBase;
  Error error_ = {};
};

template <class S> bool is_sound(const Pose<S>& pose, S reach) {
  return is_finite(pose.position) && within(pose.position, reach) && is_rotation<S>(pose.orientation);
}
template <class S> bool is_number(S x, S low, S high) { return is_finite(x) && low <= x && x <= high; }

template <class S> void check_settings(const ArticulationSettings<S>& s, DefinitionCheck& checks) {
  checks.ask(kLeastHz <= s.hz && s.hz <= kMostHz, "settings.hz", "10 to 10000");
  checks.ask(1 <= s.substeps && s.substeps <= 64 && s.hz * s.substeps <= kMaxRate, "settings.substeps",
             "1 to 64, and hz * substeps up to 16384");
  checks.ask(is_finite(s.gravity) && within(s.gravity, S(1024)), "settings.gravity",
             "up to 1024 m/s^2 along each axis");
  checks.ask(is_sound(s.base, Limits<S>::position()), "settings.base",
             "a position up to Limits::position() and a quaternion of length 1");
}

template <class S> void check_mass(const LinkMass<S>& m, DefinitionCheck& checks) {
  const S most = Limits<S>::mass();
  checks.ask(is_number(m.mass, resolution<S>(), most), "mass.mass", "above 0, up to Limits::mass()");
  checks.ask(is_finite(m.centre) && within(m.centre, Limits<S>::extent()), "mass.centre",
             "coordinates up to Limits::extent()");
  const Vec3<S> i = m.inertia;
  const bool finite = is_number(i.x, S(0), most) && is_number(i.y, S(0), most) && is_number(i.z, S(0), most);
  checks.ask(finite, "mass.inertia", "0 to Limits::mass() about each axis");
  // A thousandth is left for the rounding of who computed it.
  const auto solid = [](S a, S b, S c) { return a - b - c <= (b + c) * S(0x1p-10) + S(64) * resolution<S>(); };
  checks.ask(!finite || (solid(i.x, i.y, i.z) && solid(i.y, i.z, i.x) && solid(i.z, i.x, i.y)), "mass.inertia",
             "no component larger than the two others together");
  checks.ask(is_rotation<S>(m.principal), "mass.principal", kUnitLength);
}

template <class S> void check_limits(const ArticulationLink<S>& l, DefinitionCheck& checks) {
  const bool ball = l.type == ArticulationJoint::ball;
  if (!l.limited) {
    checks.ask(l.type != ArticulationJoint::slider || l.parent == kArticulationBase, "limited",
               "limits on a slider between two links");
    return;
  }
  checks.ask(is_scalar(l.type) || ball, "limited", "a hinge, a slider or a ball");
  checks.ask(is_finite(l.lower) && is_finite(l.upper), "upper", "finite numbers");
  if (ball) {
    checks.ask(kLeastCone<S> <= l.upper && l.upper <= kMostCone<S>, "upper", "0.05 to 2.8 rad, a cone's half angle");
    checks.ask(l.lower == S(0), "lower", "0 of a ball");
    return;
  }
  const S most = l.type == ArticulationJoint::hinge ? S(0x1p14) : Limits<S>::extent();
  checks.ask(within(l.lower, most) && within(l.upper, most), "upper",
             "a size up to 16384 rad, or Limits::extent() of a slider");
  checks.ask(l.lower < l.upper, "upper", "above lower");
}

template <class S> void check_link(const ArticulationDefinition<S>& d, std::uint32_t index, DefinitionCheck& checks) {
  const ArticulationLink<S>& l = d.links[index];
  const S reach = Limits<S>::extent();
  checks.link(index);
  checks.ask(l.parent == kArticulationBase || l.parent < index, "parent", "an earlier link, or kArticulationBase");
  if (!checks.ask(static_cast<std::uint32_t>(l.type) < kArticulationJoints, "type", "one of ArticulationJoint")) return;
  const bool free = l.type == ArticulationJoint::free;
  checks.ask(!free || index == 0, "type", "a free link only as the first");
  checks.ask(index == 0 || d.links[0].type != ArticulationJoint::free || l.parent != kArticulationBase, "parent",
             "a link: the first one is free, and the base holds no other");
  checks.ask(is_sound(l.frame_a, reach), "frame_a", "a position up to Limits::extent() and a quaternion of length 1");
  checks.ask(is_sound(l.frame_b, reach), "frame_b", "a position up to Limits::extent() and a quaternion of length 1");
  const S length_of_axis = is_finite(l.axis) ? convert<S>(heading_of(l.axis).length) : S(0);
  checks.ask(is_number(length_of_axis, S(0.999), S(1.001)), "axis", "a vector of length 1");
  check_mass(l.mass, checks);
  const S most = Limits<S>::mass();
  checks.ask(is_number(l.armature, S(0), most), "armature", "0 to Limits::mass()");
  checks.ask(is_number(l.damping, S(0), most), "damping", "0 to Limits::mass()");
  checks.ask(is_number(l.stiffness, S(0), most), "stiffness", "0 to Limits::mass()");
  const bool moves = l.type != ArticulationJoint::fixed && !free;
  checks.ask(moves || (l.armature == S(0) && l.damping == S(0) && l.stiffness == S(0)), "type",
             "a joint of one or three coordinates for armature, damping or stiffness");
  const bool round = l.type == ArticulationJoint::hinge && !l.limited;
  checks.ask(is_number(l.rest, -S(0x1p14), S(0x1p14)), "rest", "a size up to 16384");
  checks.ask(!round || within(l.rest, S(6.5)), "rest", "a size up to 6.5 rad of a hinge without limits");
  check_limits(l, checks);
}

template <class S> S ArticulatedTree<S>::over_mass(S x, int lengths, int times) const {
  const auto grown = [&](S y) {
    for (int i = 0; i < lengths; ++i) y = held_product(y, scale);
    return y;
  };
  const auto stepped = [&](S y) {
    for (int i = 0; i < times; ++i) y = y * h;
    return y;
  };
  // A small x grows before it is divided, a large one after it.
  const bool large = S(0x1p12) < abs(x);
  if (large) return grown(with_headroom(divide_to<S>(stepped(x), mass)));
  return stepped(with_headroom(divide_to<S>(grown(x), mass)));
}
template <class S> S ArticulatedTree<S>::coefficient(S x, ArticulationJoint type, int times) const {
  return min(over_mass(x, lengths_of(type), times), kMostCoefficient<S>);
}

template <class S>
Result<void> check_drive(const ArticulatedTree<S>& tree, std::uint32_t link, const ArticulationDrive<S>& drive) {
  const PreparedLink<S>& l = tree.links[link];
  DefinitionCheck checks;
  const S most = Limits<S>::mass();
  checks.ask(is_number(drive.target, -S(0x1p14), S(0x1p14)), "drive.target", "a size up to 16384");
  checks.ask(is_rotation<S>(drive.pose), "drive.pose", kUnitLength);
  checks.ask(is_finite(drive.speed) && within(drive.speed, Limits<S>::speed()), "drive.speed",
             "a size up to Limits::speed() along each axis");
  checks.ask(is_number(drive.stiffness, S(0), most), "drive.stiffness", "0 to Limits::mass()");
  checks.ask(is_number(drive.damping, S(0), most), "drive.damping", "0 to Limits::mass()");
  checks.ask(is_number(drive.max_force, S(0), most), "drive.max_force", "0 to Limits::mass()");
  const bool round = l.type == ArticulationJoint::hinge && !l.limited;
  checks.ask(!round || within(drive.target, S(6.5)), "drive.target", "a size up to 6.5 rad of a hinge without limits");
  checks.ask(is_scalar(l.type) || l.type == ArticulationJoint::ball || drive.max_force == S(0), "drive.max_force",
             "0 where a joint has no coordinates");
  return checks.result();
}

/// [m] Returns the greatest distance of a mass from the anchors of the links before it.
template <class S> S reach_of(const ArticulationDefinition<S>& d) {
  std::vector<S> ways(d.links.size());
  S reach = S(0);
  for (std::size_t i = 0; i < d.links.size(); ++i) {
    const ArticulationLink<S>& l = d.links[i];
    const bool rooted = l.parent == kArticulationBase;
    // Nothing is shifted further from the base on, so a first arm does not count.
    const Vec3<S> from = rooted ? l.frame_a.position : d.links[l.parent].frame_b.position;
    const bool slides = l.type == ArticulationJoint::slider && l.limited && !rooted;
    const S travel = slides ? max(abs(l.lower), abs(l.upper)) : S(0);
    const S most = Limits<S>::extent() * S(4);  // sums of two still fit
    ways[i] = rooted ? S(0) : min(ways[l.parent] + min(distance(from, l.frame_a.position) + travel, most), most);
    const Vec3<S> arm = l.mass.centre - l.frame_b.position;
    const S around = max_abs(l.mass.inertia);
    const S gyration = sqrt(divide_to<S>(around, l.mass.mass));
    reach = max(reach, min(ways[i] + length(arm) + min(gyration, most), most));
  }
  return max(reach, S(0.25));  // a mass at its own joint has none
}

template <class S> void prepare_units(ArticulatedTree<S>& tree, S reach) {
  const ArticulationSettings<S>& s = tree.definition.settings;
  tree.rate = S(s.hz * s.substeps);
  tree.h = divide_to<Step<S>>(S(1), tree.rate);
  tree.spin = min(kMostSpin<S>, tree.rate * S(0.5));
  constexpr int kMostDoublings = 15;  // of Limits<double>::extent()
  for (int i = 0; i < kMostDoublings && reach * tree.scale < S(32); ++i) {
    tree.scale = tree.scale + tree.scale;
    tree.unscale = tree.unscale * S(0.5);
  }
  for (int i = 0; i < kMostDoublings && !(reach * tree.scale < S(64)); ++i) {
    tree.scale = tree.scale * S(0.5);
    tree.unscale = tree.unscale + tree.unscale;
  }
  tree.mass = S(0);
  for (const ArticulationLink<S>& l : tree.definition.links)
    tree.mass = min(tree.mass + l.mass.mass, Limits<S>::mass());
}

/// Inertia of what may turn any way: about no axis less than 2^-18 of what it has about its anchor, a ball of a two
/// hundredth of the arm's length. A point on a rod would turn about the rod by rounding alone.
template <class S> Vec3<S> turnable(const PreparedLink<S>& p) {
  const S whole = p.mass * dot(p.centre, p.centre) + (p.inertia.x + p.inertia.y + p.inertia.z);
  const S least = whole * S(0x1p-18);
  return max(p.inertia, Vec3<S>{least, least, least});
}

template <class S> PreparedLink<S> prepared(const ArticulatedTree<S>& tree, const ArticulationLink<S>& l) {
  const auto units = [&](Vec3<S> v) { return v * tree.scale; };
  const bool rooted = l.parent == kArticulationBase;
  const Vec3<S> from = rooted ? Vec3<S>::zero() : tree.definition.links[l.parent].frame_b.position;
  const bool free = l.type == ArticulationJoint::free;
  const S of_length = l.type == ArticulationJoint::slider ? tree.scale : S(1);
  PreparedLink<S> p = {};
  p.parent = l.parent + 1;  // of the base 0
  p.type = l.type;
  p.limited = l.limited;
  p.offset = free ? Vec3<S>::zero() : units(l.frame_a.position - from);
  p.before = normalise(l.frame_a.orientation);
  p.after = conjugate(normalise(l.frame_b.orientation));
  p.axis = heading_of(l.axis).direction;
  p.mass = divide_to<S>(l.mass.mass, tree.mass);
  p.centre = units(l.mass.centre - l.frame_b.position);
  const Vec3<S> i = l.mass.inertia;
  p.inertia = {tree.over_mass(i.x, 2), tree.over_mass(i.y, 2), tree.over_mass(i.z, 2)};
  p.principal = normalise(l.mass.principal);
  if (has_rotation(l.type)) p.inertia = turnable(p);
  p.armature = tree.coefficient(l.armature, l.type, 0);
  p.damping = tree.coefficient(l.damping, l.type, 1);
  p.stiffness = tree.coefficient(l.stiffness, l.type, 2);
  p.rest = l.rest * of_length;
  p.lower = l.lower * of_length;
  p.upper = l.upper * of_length;
  return p;
}

/// Adds the next link, with its places among the state's numbers.
template <class S> void add_link(ArticulatedTree<S>& tree, std::uint32_t index, DefinitionCheck& checks) {
  const ArticulationLink<S>& l = tree.definition.links[index];
  PreparedLink<S> p = prepared(tree, l);
  const bool free = l.type == ArticulationJoint::free;
  p.coordinate = tree.coordinates;
  p.rotation = tree.rotations;
  p.speed = tree.speeds;
  tree.coordinates += is_scalar(l.type) ? 1 : free ? 3 : 0;
  tree.rotations += has_rotation(l.type) ? 1 : 0;
  tree.speeds += is_scalar(l.type) ? 1 : free ? 6 : has_rotation(l.type) ? 3 : 0;
  tree.links.push_back(p);
  checks.link(index);
  checks.ask(S(0) < p.mass, "mass.mass", "more beside the mass of the tree", ErrorCode::limit);
  if (const Result<void> drive = check_drive(tree, index, l.drive); !drive) checks.also(drive.error());
}

template <class S>
Result<std::shared_ptr<const ArticulatedTree<S>>> make_tree(const ArticulationDefinition<S>& definition) {
  DefinitionCheck checks;
  check_settings(definition.settings, checks);
  checks.ask(!definition.links.empty() && definition.links.size() <= kMostArticulationLinks, "links",
             "1 to 4096 of them");
  const auto count = static_cast<std::uint32_t>(checks.ok() ? definition.links.size() : 0);
  for (std::uint32_t i = 0; i < count && checks.ok(); ++i) check_link(definition, i, checks);
  if (!checks.ok()) return checks.result().error();
  auto tree = std::make_shared<ArticulatedTree<S>>();
  tree->definition = definition;
  const S reach = reach_of(definition);
  checks.link(kArticulationBase);
  if (!checks.ask(reach <= Limits<S>::extent(), "links", "a tree that reaches no further than Limits::extent()",
                  ErrorCode::limit)) {
    return checks.result().error();
  }
  prepare_units(*tree, reach);
  tree->free = definition.links[0].type == ArticulationJoint::free;
  for (std::uint32_t i = 0; i < count; ++i) add_link(*tree, i, checks);
  if (!checks.ok()) return checks.result().error();
  HashCombiner hash;
  hash.add(hash_records_by_fields(&tree->definition.settings, 1));
  hash.add(hash_records_by_fields(tree->definition.links.data(), tree->definition.links.size()));
  tree->hash = hash.value();
  return std::shared_ptr<const ArticulatedTree<S>>(std::move(tree));
}

template <class S> void write_definition(Writer& writer, const ArticulationDefinition<S>& definition) {
  writer.write(definition.settings);
  writer.write_array(definition.links);
}
template <class S> ArticulationDefinition<S> read_definition(Reader& reader) {
  ArticulationDefinition<S> definition;
  reader.read(definition.settings);
  reader.read_array(definition.links, kMostArticulationLinks);
  return definition;
}

}  // namespace isostep::detail
