// The numbers of W trees of one shape side by side, as the tree kernel keeps them for a step.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "isostep/dynamics/joints/joint_drive.hpp"
#include "isostep/dynamics/joints/tree_shape.hpp"
#include "isostep/math/quat.hpp"
#include "isostep/scalar/scalar.hpp"

namespace isostep {

/// The bodies of W trees. Symmetric matrices are stored as xx, xy, xz, yy, yz, zz, others as nine entries by rows.
template <class S, int W> struct TreeBodyLanes {
  Velocity<S> linear[3][W], angular[3][W];              // [m/s], [rad/s] for the length of a pass
  Velocity<S> start_linear[3][W], start_angular[3][W];  // when the pass began, of trees with drives
  S centre[3][W];                                       // [m] now
  Unit<S> orientation[4][W];                            // now, of trees with stops or with joints that follow
  Velocity<S> turned[3][W];                             // [rad] since the last sub-step, of the latter
  Unit<S> rotation[9][W];                               // body to world, now
  S kappa[6][W];                                        // [1/m^2] now
  S felt[6][W];                                         // [1/m^2] as the joints see it, tension in it
  S tension[6][W];  // [m^2] geometric stiffness h^2 / mass, where there is enough of it
  S pull[W];        // [m^2] sum of the joints' h^2 f.r / mass
  S calm[W];        // [m^2] up to this such a sum changes nothing
};
template <class S, int W> struct TreeJointLanes {
  S frame_a[3][W], frame_b[3][W];  // [m] where the joint is, body axes
  S share_a[W], share_b[W];        // [1] MassShare
  S arm_a[3][W], arm_b[3][W];      // [m] the same, world axes, now
  S pull_a[W], pull_b[W];          // [m^2]
  S turn_a[9][W], turn_b[9][W];    // [1/m] of a point: angular velocity per impulse, before the mass share: column i
                                   // for axis i
  Velocity<S> curve[3][W];         // [m/s] of what the arms' turning adds to the speed of a point
  Velocity<S> turned[W];           // [rad] that the bodies of a joint that follows turned against each other since it
                                   // was measured
};
template <class S, int W> struct TreeNodeLanes {
  S inverse[6][W];            // [1] of D; until then what earlier eliminations have left of K
  Velocity<S> error[3][W];    // [m] of equalities
  Velocity<S> impulse[3][W];  // [m/s] accumulated
  Velocity<S> start[3][W];    // [m/s] the same when the pass began, of trees with drives
  Velocity<S> right[3][W];    // [m/s] right-hand sides, then solutions
};
/// Three rows that are no point, like JointRow: row i in entries 3 i to 3 i + 2.
template <class S, int W> struct TreeRowLanes {
  S linear[9][W];                      // [1] of places; [m] of angles that follow: angular_a in a's frame
  S angular_a[9][W], angular_b[9][W];  // [m]
  S turn_a[9][W], turn_b[9][W];        // [1/m]
};
template <class S, int W> struct TreeLinkLanes {
  S down[9][W];  // [1] K_ji, i = the node that has the link, j = `to`
  S up[9][W];    // [1] K_ij, then D_i^-1 K_ij
};
/// Holds a drive of W trees: what its law asks for, and what the pass gave.
template <class S, int W> struct TreeDriveLanes {
  Velocity<S> speed[W];    // [m/s] along the row
  Velocity<S> impulse[W];  // [m/s] accumulated
  Velocity<S> right[W];    // [m/s] right-hand side
  Velocity<S> low[W];      // [m/s] the speeds between which limits leave it in a pass
  Velocity<S> high[W];     // [m/s]
  Unit<S> scale[W];        // [1] of the row: 1 a fixed speed, less a spring, 0 a constant impulse
  S give[W];               // [1] added to the row's entry of K: springs yield
  S above_lower[W];        // [m] how far from its limits it is; the highest number where it has none
  S below_upper[W];        // [m]
};

/// Holds what a drive's motor, spring or sway asks for in a sub-step: joint_drive.hpp, joint_sway.hpp.
template <class S, int W> struct TreeLawLanes {
  Velocity<S> asked[W];              // [m/s] of the motor
  Velocity<S> most[W];               // [m/s] impulse of the motor or servo in the sub-step
  Velocity<S> back[W];               // [m/s] with which it returns from beyond a limit
  Velocity<S> spring_push[W];        // [m/s]
  S spring[W];                       // [1] w
  S ratio[W];                        // [1] 1 / sqrt(1 + w^2) / w; 0 without a spring
  Unit<S> row_full[W], row_part[W];  // [1] 1 / sqrt(1 + w^2), w / sqrt(1 + w^2)
  S sway[W], sway_left[W];           // [s/m], [1]
  Velocity<S> way[W];                // [m] from the spring's target
  S rate[W];                         // [1/s] speed that the spring asks for per metre
  S lag[W];                          // [1] part of the last sub-step's way that the spring does not feel
};

/// A joint with rows only of a twist and a swing, each bounded or held: tree_stops.inl.
template <class S, int W> struct TreeStopLanes {
  Unit<S> frame_a[4][W], frame_b[4][W];  // rotations of the frames in their bodies
  Unit<S> middle[2][W];                  // cosine and sine of half the angle in the middle of the twist's range
  S twist[W], twist_slope[W];            // [1] cosine of a quarter of that range; no limit: below any. [rad] per cosine
  S swing[W], swing_slope[W];            // [1] cosine of the cone; no limit: below any. [rad] per cosine
  S lower[W], upper[W], cone[W];         // [rad]
  S radius[W];                           // [m] of equalities
  S twist_radius[W], swing_radius[W];    // [m] of drives
  Velocity<S> reach[W];                  // [rad] a quarter of what it may turn by without reaching a limit
};

/// [1] A value below any cosine.
template <class S> inline constexpr S kNoCosine = S(-2);

template <class S, int W> struct TreeMemory {
  TreeBodyLanes<S, W>* bodies;
  TreeJointLanes<S, W>* joints;
  TreeNodeLanes<S, W>* nodes;
  TreeRowLanes<S, W>* rows;
  TreeLinkLanes<S, W>* links;
  TreeDriveLanes<S, W>* drives;
  TreeLawLanes<S, W>* laws;
  TreeStopLanes<S, W>* stops;

  static ISO_INLINE TreeMemory of(void* memory, const TreeShape& shape) {
    TreeMemory m;
    m.bodies = static_cast<TreeBodyLanes<S, W>*>(memory);
    m.joints = reinterpret_cast<TreeJointLanes<S, W>*>(m.bodies + shape.bodies.size());
    m.nodes = reinterpret_cast<TreeNodeLanes<S, W>*>(m.joints + shape.joints.size());
    m.rows = reinterpret_cast<TreeRowLanes<S, W>*>(m.nodes + shape.nodes.size());
    m.links = reinterpret_cast<TreeLinkLanes<S, W>*>(m.rows + shape.row_blocks);
    m.drives = reinterpret_cast<TreeDriveLanes<S, W>*>(m.links + shape.links.size());
    m.laws = reinterpret_cast<TreeLawLanes<S, W>*>(m.drives + shape.drives.size());
    m.stops = reinterpret_cast<TreeStopLanes<S, W>*>(m.laws + shape.laws);
    return m;
  }
};
/// Returns the bytes before the drives of one tree. Lanes have no padding: W trees take W times the bytes.
template <class S> ISO_INLINE std::size_t tree_bytes_before_drives(const TreeShape& shape) {
  return shape.bodies.size() * sizeof(TreeBodyLanes<S, 1>) + shape.joints.size() * sizeof(TreeJointLanes<S, 1>) +
         shape.nodes.size() * sizeof(TreeNodeLanes<S, 1>) + shape.row_blocks * sizeof(TreeRowLanes<S, 1>) +
         shape.links.size() * sizeof(TreeLinkLanes<S, 1>);
}
template <class S> ISO_INLINE std::size_t tree_bytes_before_laws(const TreeShape& shape) {
  return tree_bytes_before_drives<S>(shape) + shape.drives.size() * sizeof(TreeDriveLanes<S, 1>);
}
template <class S> ISO_INLINE std::size_t tree_bytes_before_stops(const TreeShape& shape) {
  return tree_bytes_before_laws<S>(shape) + shape.laws * sizeof(TreeLawLanes<S, 1>);
}
template <class S> ISO_INLINE std::size_t tree_bytes(const TreeShape& shape) {
  return tree_bytes_before_stops<S>(shape) + shape.stops * sizeof(TreeStopLanes<S, 1>);
}

/// The drives of W trees, for any W: for code that is compiled for no special instruction set.
template <class S> class TreeDriveView {
 public:
  /// `memory` is a TreeMemory<S, width>.
  ISO_INLINE TreeDriveView(unsigned char* memory, const TreeShape& shape, std::size_t width)
      : drives_(memory + tree_bytes_before_drives<S>(shape) * width),
        laws_(memory + tree_bytes_before_laws<S>(shape) * width),
        width_(width) {}

  ISO_INLINE Velocity<S>& impulse(std::size_t drive, std::size_t lane) const {
    return of_drive<Velocity<S>>(drive, 1, lane);
  }
  ISO_INLINE Velocity<S>& right(std::size_t drive, std::size_t lane) const {
    return of_drive<Velocity<S>>(drive, 2, lane);
  }
  ISO_INLINE S& give(std::size_t drive, std::size_t lane) const { return of_drive<S>(drive, 6, lane); }
  ISO_INLINE S& above_lower(std::size_t drive, std::size_t lane) const { return of_drive<S>(drive, 7, lane); }
  ISO_INLINE S& below_upper(std::size_t drive, std::size_t lane) const { return of_drive<S>(drive, 8, lane); }

  ISO_INLINE void set_law(std::size_t law, std::size_t lane, const JointDrive<S>& drive, Velocity<S> most) const {
    const Velocity<S> speeds[4] = {drive.speed, most, drive.push_speed, drive.spring_push};
    for (std::size_t i = 0; i < 4; ++i) of_law<Velocity<S>>(law, i, lane) = speeds[i];
    of_law<S>(law, 4, lane) = drive.spring;
    of_law<S>(law, 5, lane) = drive.spring > S(0) ? convert<S>(drive.spring_row.x) / drive.spring : S(0);
    of_law<Unit<S>>(law, 6, lane) = drive.spring_row.x;
    of_law<Unit<S>>(law, 7, lane) = drive.spring_row.y;
    of_law<S>(law, 8, lane) = drive.sway;
    of_law<S>(law, 9, lane) = drive.sway_left;
    of_law<Velocity<S>>(law, 10, lane) = detail::spring_way(drive);
    of_law<S>(law, 11, lane) = drive.spring_rate;
    of_law<S>(law, 12, lane) = drive.spring_lag;
  }

 private:
  static constexpr std::size_t kWords = 9, kLawWords = 13;
  static_assert(sizeof(Velocity<S>) == sizeof(S) && sizeof(Unit<S>) == sizeof(S));
  static_assert(sizeof(TreeDriveLanes<S, 1>) == kWords * sizeof(S));
  static_assert(sizeof(TreeLawLanes<S, 1>) == kLawWords * sizeof(S));
  template <class T> ISO_INLINE T& of_drive(std::size_t drive, std::size_t word, std::size_t lane) const {
    return *reinterpret_cast<T*>(drives_ + ((drive * kWords + word) * width_ + lane) * sizeof(S));
  }
  template <class T> ISO_INLINE T& of_law(std::size_t law, std::size_t word, std::size_t lane) const {
    return *reinterpret_cast<T*>(laws_ + ((law * kLawWords + word) * width_ + lane) * sizeof(S));
  }
  unsigned char* drives_;
  unsigned char* laws_;
  std::size_t width_;
};

/// The impulses of the nodes of W trees, for any W.
template <class S> class TreeNodeView {
 public:
  ISO_INLINE TreeNodeView(unsigned char* memory, const TreeShape& shape, std::size_t width)
      : first_(memory + (shape.bodies.size() * sizeof(TreeBodyLanes<S, 1>) +
                         shape.joints.size() * sizeof(TreeJointLanes<S, 1>)) *
                            width),
        width_(width) {}

  ISO_INLINE Velocity<S> impulse(std::size_t node, std::size_t row, std::size_t lane) const {
    using Node = TreeNodeLanes<S, 1>;
    constexpr std::size_t kBefore = offsetof(Node, impulse);
    const std::size_t word = node * sizeof(Node) + kBefore;
    return *reinterpret_cast<const Velocity<S>*>(first_ + (word + row * sizeof(S)) * width_ + lane * sizeof(S));
  }

 private:
  const unsigned char* first_;
  std::size_t width_;
};

/// The arms, pulls and bodies of loose joints, W trees of one joint, for any W.
template <class S> class LooseJointView {
 public:
  ISO_INLINE LooseJointView(unsigned char* memory, const TreeShape& shape, std::size_t width)
      : bodies_(memory), joint_(memory + shape.bodies.size() * sizeof(Body) * width), width_(width) {}

  /// [m] Returns the arm of a, or of b.
  ISO_INLINE Vec3<S> arm(bool of_a, std::size_t lane) const {
    const std::size_t first = of_a ? offsetof(Joint, arm_a) : offsetof(Joint, arm_b);
    return {of_joint(first, lane), of_joint(first + sizeof(S), lane), of_joint(first + 2 * sizeof(S), lane)};
  }
  /// [m^2] Returns the joint's pull at that end.
  ISO_INLINE S pull(bool of_a, std::size_t lane) const {
    return of_joint(of_a ? offsetof(Joint, pull_a) : offsetof(Joint, pull_b), lane);
  }
  ISO_INLINE void set_felt(std::size_t body, std::size_t lane, const Mat3<S>& felt) const {
    const S words[6] = {felt.rows[0].x, felt.rows[0].y, felt.rows[0].z, felt.rows[1].y, felt.rows[1].z, felt.rows[2].z};
    for (std::size_t i = 0; i < 6; ++i) {
      const std::size_t word = body * sizeof(Body) + offsetof(Body, felt) + i * sizeof(S);
      *reinterpret_cast<S*>(bodies_ + word * width_ + lane * sizeof(S)) = words[i];
    }
  }

 private:
  using Body = TreeBodyLanes<S, 1>;
  using Joint = TreeJointLanes<S, 1>;
  ISO_INLINE S of_joint(std::size_t word, std::size_t lane) const {
    return *reinterpret_cast<const S*>(joint_ + word * width_ + lane * sizeof(S));
  }
  unsigned char* bodies_;
  const unsigned char* joint_;
  std::size_t width_;
};

/// The limits of one joint with stops: the fields of TreeStopLanes.
template <class S> struct TreeStopLimits {
  SinCos<Unit<S>> middle;
  S twist, twist_slope, swing, swing_slope, lower, upper, cone, radius, twist_radius, swing_radius;
};
/// The stops of W trees, for any W.
template <class S> class TreeStopView {
 public:
  ISO_INLINE TreeStopView(unsigned char* memory, const TreeShape& shape, std::size_t width)
      : first_(memory + tree_bytes_before_stops<S>(shape) * width), width_(width) {}

  ISO_INLINE void set_frames(std::size_t stop, std::size_t lane, Quat<Unit<S>> a, Quat<Unit<S>> b) const {
    const Unit<S> words[8] = {a.x, a.y, a.z, a.w, b.x, b.y, b.z, b.w};
    for (std::size_t i = 0; i < 8; ++i) at<Unit<S>>(stop, i, lane) = words[i];
  }
  ISO_INLINE void set_limits(std::size_t stop, std::size_t lane, const TreeStopLimits<S>& limits) const {
    at<Unit<S>>(stop, 8, lane) = limits.middle.cos;
    at<Unit<S>>(stop, 9, lane) = limits.middle.sin;
    const S words[10] = {limits.twist, limits.twist_slope, limits.swing,  limits.swing_slope,  limits.lower,
                         limits.upper, limits.cone,        limits.radius, limits.twist_radius, limits.swing_radius};
    for (std::size_t i = 0; i < 10; ++i) at<S>(stop, 10 + i, lane) = words[i];
  }

 private:
  static constexpr std::size_t kWords = 21;
  static_assert(sizeof(TreeStopLanes<S, 1>) == kWords * sizeof(S));
  template <class T> ISO_INLINE T& at(std::size_t stop, std::size_t word, std::size_t lane) const {
    return *reinterpret_cast<T*>(first_ + ((stop * kWords + word) * width_ + lane) * sizeof(S));
  }
  unsigned char* first_;
  std::size_t width_;
};

}  // namespace isostep
