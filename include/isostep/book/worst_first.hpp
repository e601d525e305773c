// The book's resolver for rigid bodies: contact points and joints one at a time, the worst first.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/book/worst_first_rows.hpp"
#include "isostep/core/fields.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/core/island_budgets.hpp"
#include "isostep/core/tournament_tree.hpp"
#include "isostep/dynamics/solvers/body_rows.hpp"
#include "isostep/dynamics/solvers/impacts.hpp"
#include "isostep/dynamics/solvers/prepared_joints.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"

namespace isostep {

/// Every sub-step: what meets fast bounces (impacts.hpp), velocities are integrated and resolved, then positions.
/// Source:  Millington 2007, ch. 14-15: impulses (306-321), nonlinear projection, relaxation, rotation limit (322-330),
///          worst first (338-346), micro-collisions (351-358), friction (359-361).
/// Symbols: v = speed of b against a along the normal, C = separation.
/// Order:   a pass takes the row that is furthest from its aim, and looks again at all that share a moving body with
///          it; ties go to the lowest index: contact points in canonical order, then joints.
/// Differs: a pass begins with the impulses that the last one came to, adds to them, and lets them give way again. From
///          nothing, as in the book, its iterations carry a weight through few bodies: at 4 sub-steps a stack of twenty
///          boxes falls within two seconds and S6, a chain of fifty links, comes 1.4 m apart, where now the stack is
///          0.7 mm deep in itself and the chain comes 0.08 m apart. Friction is a vector within the cone of all that
///          its point bears, and as urgent as any speed. A gap that would close within the sub-step is hit at once:
///          nothing gets through. Geometry is the step's: each gap follows the displacements, nothing is measured anew.
///          A row that cannot be bettered waits until a neighbour moves.
/// Projection: of projection.hpp. All aim at the same, a quarter of an overlap a sub-step, at 3 m/s at most. Joints'
///          errors are projected as nonlinear has it, whatever the setting.
///          relaxed: a resolution takes half of what its row lacks, and a pass may have eight times as many: contacts
///          that press a body against each other share what none can take.
///          velocity_based: before its first sub-step a step takes bodies that overlap back along the motion that they
///          came with, to where they touched. What no motion can take back is moved as linear has it.
///          worst_first_take_back.inl.
/// Mechanisms: theirs are swept before the passes over velocities, of which there are then kMechanismSweeps.
/// Queue:   finds the worst row: core/tournament_tree.hpp, sorted_order.hpp, linear_search.hpp. Changes no bit.
/// Cost:    O(log rows) for each row that shares a moving body with the resolved one. No allocation once warm. Serial.
/// Limits:  speeds and gaps beyond the ends of Velocity<S> count as those ends, velocities are held at eight times the
///          published limits while a pass lasts.
template <class S, class Queue = TournamentTree> class WorstFirstResolver {
  using V = Velocity<S>;

 public:
  /// The most resolutions of an island's rows in a pass: as many as the book allows, times
  /// `turns`.
  static ISO_INLINE std::uint32_t most_iterations(std::uint32_t rows, std::uint32_t turns = 1) {
    return rows > 0x7fffffffu / turns ? ~0u : 2u * turns * rows;
  }
  /// The most looks at an island's rows in a pass: 64 a row and a hundredth of a second of them. A falling wall (S2)
  /// takes 60 a row; a crowd in one place would take the cube of its number.
  static ISO_INLINE std::uint64_t most_looks(std::uint32_t rows, std::uint32_t turns = 1) {
    return (1u << 17) + std::uint64_t{64} * turns * rows;
  }

  void colour_constraints(const StepContext<S>& context);
  void prepare(const StepContext<S>& context);
  void solve_substeps(const StepContext<S>& context);
  void store_impulses(const StepContext<S>& context);
  /// Returns the number of islands that passes of this step left unsolved, counted at every pass.
  ISO_INLINE std::uint32_t unsolved() const { return islands_left_; }
  template <class Visit> void visit_scratch(const Visit& visit, SolverStage stage, const StepContext<S>& context);

 private:
  using Motion = MotionRow<V>;
  using Point = PointRow<S>;
  struct Ends {
    std::uint32_t a, b;  // of SolverBodies, 0 for what does not move

    ISO_FIELDS(a, b)
  };

  /// The masses of a contact's two bodies, with the inertia that the contact sees.
  struct Masses {
    SolverMass<S> a, b;
  };

  // worst_first.inl
  void add_point(const StepContext<S>& context, std::uint32_t contact, std::uint32_t point);
  void load_impulses(const Contact<S>& contact, std::uint32_t point, Point& row);
  void add_rolling(const ContactGeometry<S>& geometry, std::uint32_t point, const SolverMass<S>& a,
                   const SolverMass<S>& b, Point& row);
  void add_spinning(const ContactGeometry<S>& geometry, const SolverMass<S>& a, const SolverMass<S>& b, Point& row);
  Masses masses_of(const StepContext<S>& context, const Point& row) const;
  void list_neighbours();
  void follow(const StepContext<S>& context);
  template <class Look, class Apply> void resolve(const Look& look, const Apply& apply, std::uint32_t turns);
  void leave_island(std::uint32_t row);
  template <class Look>
  void look_again(const Look& look, std::uint32_t index, std::uint32_t body, std::uint32_t not_of);
  ISO_INLINE auto before() const {
    return [this](std::uint32_t i, std::uint32_t j) ISO_INLINE_LAMBDA {
      if (!(urgency_[i] == urgency_[j])) return urgency_[j] < urgency_[i];
      return i < j && V(0) < urgency_[i];  // rows with nothing to do are in any order: a list need not sort them
    };
  }

  // worst_first_velocity.inl
  void begin_velocities(const StepContext<S>& context, const JointStep<S>& step);
  void carry(const StepContext<S>& context);
  void warm_start(const Point& row);
  void hold(JointConstraint<S>& joint);
  void forget_impulses(Point& row);
  V most_beside(std::size_t index, const Point& row) const;
  ISO_INLINE V most_of(const Point& row) const {
    return most_beside(static_cast<std::size_t>(&row - points_.data()), row);
  }
  V motion_urgency(const Point& row) const;
  V motion_urgency(const JointConstraint<S>& joint, const JointStep<S>& step) const;
  void resolve_motion(Point& row);
  void resolve_motion(JointConstraint<S>& joint, const JointStep<S>& step);
  void resolve_normal(Point& row, Motion& a, Motion& b);

  // worst_first_position.inl
  void begin_positions(const JointStep<S>& step);
  V gap(const Point& row) const;
  bool gives_way(const Point& row) const;
  V overlap_urgency(const Point& row) const;
  V error_urgency(JointConstraint<S>& joint, const JointStep<S>& step) const;
  void end_overlap(const StepContext<S>& context, const Point& row);
  void project(const StepContext<S>& context, const Point& row, V missing);
  void shift(const StepContext<S>& context, const Point& row, V missing);
  void project(const StepContext<S>& context, const JointConstraint<S>& joint, const JointStep<S>& step);
  void move(const StepContext<S>& context, std::uint32_t body, const Motion& asked);

  // worst_first_take_back.inl
  void take_back(const StepContext<S>& context);
  void recall_motion(const StepContext<S>& context);
  V recalled(const Point& row) const;
  V recall_urgency(const Point& row) const;
  void recall(const StepContext<S>& context, const Point& row);
  void undo(const StepContext<S>& context, std::uint32_t body, S share);

  BodyRows<S> bodies_;
  Impacts<S> impacts_;
  PreparedJoints<S> joints_;
  std::vector<Motion> moved_;  // by row of the bodies: of velocity_based, the last step's motion, less what went back
  std::vector<Point> points_;
  std::vector<TangentPair<S>> rolling_;
  std::vector<std::uint32_t> held_;        // of joints_: those that hold something
  std::vector<Ends> ends_;                 // of points, then of joints
  std::vector<std::uint32_t> first_;       // by row of the bodies, and more: its rows in neighbours_
  std::vector<std::uint32_t> neighbours_;  // rows that can move a body, ascending
  IslandBudgets budgets_;                  // of a pass
  std::vector<V> urgency_;                 // [m/s] or [m], by row; 0: nothing is to be done
  Queue worst_;                            // of urgency_
  bool any_followed_ = false;
  std::uint32_t islands_left_ = 0;  // by the passes of this step, with something still to be done
};

#define ISO_EXTERN_WORST_FIRST_RESOLVER(S) extern template class WorstFirstResolver<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN_WORST_FIRST_RESOLVER)
#undef ISO_EXTERN_WORST_FIRST_RESOLVER

}  // namespace isostep
