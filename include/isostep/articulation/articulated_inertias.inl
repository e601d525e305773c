// ArticulatedDynamics: the inertias of subtrees as their joints let them through (table 7.1, second pass, left half).
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/articulation/articulated_dynamics.hpp"

namespace isostep::detail {

/// A pivot below this is rounding, or a mass at its own joint.
template <class S> S least_pivot(const Mat3<S>& m) { return S(16) * rounding_at(trace(m)); }

template <class S>
void ArticulatedDynamics<S>::resist_scalar(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, LinkWork<S>& w) {
  const bool turns = l.type == ArticulationJoint::hinge;
  const ArticulatedInertia<S>& i = w.whole;
  w.column = turns ? Wrench<S>{i.angular * w.axis, transposed_times(i.coupling, w.axis)}
                   : Wrench<S>{i.coupling * w.axis, i.linear * w.axis};
  const S own = dot(w.axis, turns ? w.column.torque : w.column.force);
  w.joint.linearise(tree, l, own + l.armature);
  const S pivot = own + w.joint.pivot;
  w.pivot = least_pivot(turns ? i.angular : i.linear) < pivot ? pivot : S(0);
  w.passed = i;
  if (w.joint.stop != Stop::none || w.pivot == S(0)) return;
  const auto over = [&](Vec3<S> v) {
    return Vec3<S>{divide_to<S>(v.x, w.pivot), divide_to<S>(v.y, w.pivot), divide_to<S>(v.z, w.pivot)};
  };
  const Vec3<S> torque = over(w.column.torque), force = over(w.column.force);
  w.passed.angular = mirrored(minus_outer(i.angular, w.column.torque, torque));
  w.passed.coupling = minus_outer(i.coupling, w.column.torque, force);
  w.passed.linear = mirrored(minus_outer(i.linear, w.column.force, force));
}

/// D = A + pivot 1; with B = D^-1 A, C = D^-1 H:  A - A B = pivot B,  H - A C = pivot C,  M - H^T C pass on. The form
/// that does not subtract like from like is taken.
template <class S>
void ArticulatedDynamics<S>::resist_ball(const ArticulatedTree<S>& tree, const PreparedLink<S>& l, LinkWork<S>& w) {
  const ArticulatedInertia<S>& i = w.whole;
  const S size = trace(i.angular) * S(1.0 / 3);
  w.joint.linearise(tree, l, size + l.armature);
  const S law = w.joint.pivot;
  w.pivots = Symmetric3<S>::of(plus_diagonal(i.angular, law), least_pivot(i.angular));
  const Mat3<S> b = w.pivots.solve(i.angular), c = w.pivots.solve(i.coupling);
  const bool stiff = size < law;
  w.passed.angular = mirrored(stiff ? i.angular - i.angular * b : b * law);
  w.passed.coupling = stiff ? i.coupling - i.angular * c : c * law;
  w.passed.linear = mirrored(i.linear - transpose(i.coupling) * c);
  if (w.joint.stop != Stop::none) stop_ball(w);
}

/// Along the stopped axis n nothing moves: D^-1 loses y y^T / (n y), y = D^-1 n, and what passes gains it.
template <class S> void ArticulatedDynamics<S>::stop_ball(LinkWork<S>& w) {
  w.stop_axis = convert<S>(w.frame * w.joint.cone);
  w.stop_answer = w.pivots.solve(w.stop_axis);
  w.stop_pivot = dot(w.stop_axis, w.stop_answer);
  const Vec3<S> torque = w.whole.angular * w.stop_answer;
  const Vec3<S> force = transposed_times(w.whole.coupling, w.stop_answer);
  const auto over = [&](Vec3<S> v) {
    const auto part = [&](S x) { return Symmetric3<S>::quotient(-x, w.stop_pivot); };
    return Vec3<S>{part(v.x), part(v.y), part(v.z)};
  };
  w.passed.angular = mirrored(minus_outer(w.passed.angular, torque, over(torque)));
  w.passed.coupling = minus_outer(w.passed.coupling, torque, over(force));
  w.passed.linear = mirrored(minus_outer(w.passed.linear, force, over(force)));
}

template <class S> void ArticulatedDynamics<S>::resist_free(LinkWork<S>& w) {
  const ArticulatedInertia<S>& i = w.whole;
  w.pivots = Symmetric3<S>::of(i.linear, least_pivot(i.linear));
  const Mat3<S> rest = i.angular - i.coupling * w.pivots.solve(transpose(i.coupling));
  w.turn_pivots = Symmetric3<S>::of(mirrored(rest), least_pivot(i.angular));
}

template <class S> void ArticulatedDynamics<S>::factor(const ArticulatedTree<S>& tree) {
  for (std::size_t i = 0; i < tree.links.size(); ++i) {
    LinkWork<S>& w = work_[i + 1];
    w.whole = inertia_of_body(tree.links[i].mass, w.centre, w.inertia);
  }
  for (std::size_t i = tree.links.size(); i-- > 0;) {
    const PreparedLink<S>& l = tree.links[i];
    LinkWork<S>& w = work_[i + 1];
    switch (l.type) {
      case ArticulationJoint::fixed: w.passed = w.whole; break;
      case ArticulationJoint::hinge:
      case ArticulationJoint::slider: resist_scalar(tree, l, w); break;
      case ArticulationJoint::ball: resist_ball(tree, l, w); break;
      case ArticulationJoint::free: resist_free(w); break;
    }
    if (l.parent != 0) add(work_[l.parent].whole, shifted(w.passed, w.arm));
  }
}

}  // namespace isostep::detail
