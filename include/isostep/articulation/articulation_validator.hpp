// Checks of an articulation's coordinates, speeds and forces: for commands and for states from files.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/articulation/articulated_tree.hpp"
#include "isostep/articulation/articulation_limits.hpp"
#include "isostep/articulation/articulation_state.hpp"
#include "isostep/dynamics/checks.hpp"
#include "isostep/geometry/limits.hpp"

namespace isostep::detail {

inline constexpr char kMostLoadText[] = "a size up to 2^29 along each axis";

/// Returns true if a joint may have the position.
template <class S> bool fits_position(const ArticulationLink<S>& l, Vec3<S> position) {
  if (!is_finite(position)) return false;
  if (l.type == ArticulationJoint::hinge) return within(position.x, S(0x1p15));
  return within(position, l.type == ArticulationJoint::slider ? Limits<S>::extent() * S(2) : Limits<S>::position());
}
/// Returns true if a joint may have the velocity: within a step the tree as a whole is held within its limits.
template <class S> bool fits_velocity(const JointCoordinates<S>& m) {
  return is_finite(m.velocity) && is_finite(m.angular_velocity) && within(m.velocity, Limits<S>::speed()) &&
         within(m.angular_velocity, S(1024));
}

template <class S> class ArticulationValidator {
 public:
  ArticulationValidator(const ArticulatedTree<S>& tree, const ArticulationState<S>& state)
      : tree_(tree), state_(state) {}

  /// Returns the first rule that does not hold, as a literal, or null.
  const char* broken_rule() const {
    if (state_.coordinates.size() != tree_.coordinates) return "coordinates are not those of the links";
    if (state_.rotations.size() != tree_.rotations) return "rotations are not those of the links";
    if (state_.speeds.size() != tree_.speeds) return "speeds are not those of the links";
    if (state_.drives.size() != tree_.links.size()) return "drives are not one a link";
    if (state_.loads.size() != tree_.links.size()) return "loads are not one a link";
    for (const S speed : state_.speeds) {
      if (!is_finite(speed) || !within(speed, Limits<S>::speed())) return "a speed is out of range";
    }
    for (const Quat<Unit<S>>& rotation : state_.rotations) {
      if (!is_rotation<S>(rotation)) return "a rotation has not length 1";
    }
    for (std::uint32_t i = 0; i < tree_.links.size(); ++i) {
      if (const char* rule = link(i)) return rule;
    }
    return nullptr;
  }

 private:
  const char* link(std::uint32_t i) const {
    const PreparedLink<S>& l = tree_.links[i];
    const S* const q = state_.coordinates.data() + l.coordinate;
    const Vec3<S> position = is_scalar(l.type)                   ? Vec3<S>{q[0], S(0), S(0)}
                             : l.type == ArticulationJoint::free ? Vec3<S>{q[0], q[1], q[2]}
                                                                 : Vec3<S>::zero();
    if (!fits_position(tree_.definition.links[i], position)) return "a coordinate is out of range";
    if (!check_drive(tree_, i, state_.drives[i])) return "a drive breaks its rules";
    const LinkLoad<S>& load = state_.loads[i];
    if (!is_finite(load.force) || !is_finite(load.torque) || !within(load.force, kMostLoad<S>) ||
        !within(load.torque, kMostLoad<S>)) {
      return "a load is out of range";
    }
    return nullptr;
  }

  const ArticulatedTree<S>& tree_;
  const ArticulationState<S>& state_;
};

}  // namespace isostep::detail
