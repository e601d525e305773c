// IslandSolver<S>: every island's joints and contacts as one problem, solved by the method that it is made with.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/core/disjoint_sets.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/solvers/body_rows.hpp"
#include "isostep/dynamics/solvers/impacts.hpp"
#include "isostep/dynamics/solvers/island_method.hpp"
#include "isostep/dynamics/solvers/prepared_joints.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"

namespace isostep {

/// Source:  Millington 2010, Game Physics Engine Development, ch. 18; Baraff 1994, Fast contact force computation for
///          nonpenetrating rigid bodies, SIGGRAPH. Differs: velocities and impulses, not accelerations and forces.
/// Method:  each sub-step every island is one IslandSystem: joints are equations, contacts may only push, and the load
///          bounds friction. It is solved twice: once with errors closed at a bounded speed, for positions, and once
///          without, so that none of that speed stays. Each solve begins with the velocities that forces alone give:
///          impulses are those of a whole sub-step, and the last ones are where it begins. Mechanisms and the islands
///          that they push are solved in turn, kMechanismSweeps times in all.
/// Symbols: W = J M^-1/2 over powers of two (LinearSystem), so that K = W W^T is near one whatever the masses.
/// Limits:  an island takes its share of kMostWork (a count), at most some 25 ms a sub-step in double; what its method
///          leaves then, and islands too large for it, are swept by Gauss-Seidel over the same rows. unsolved() counts
///          such islands. Of a drive's two limits the nearer counts. Stored impulses are held within the speed limit.
///          While tension is taken implicitly (joint_tension.hpp) bodies conserve momentum, not angular momentum.
/// Order:   an island's blocks stand in the order of its joints, then of its contacts. Islands have no moving body in
///          common. One thread.
/// Memory:  warm, what the method allocates.
template <class S> class IslandSolver {
 public:
  explicit IslandSolver(IslandMethod method) : method_(method) {}

  void colour_constraints(const StepContext<S>& context);
  void prepare(const StepContext<S>& context);
  void solve_substeps(const StepContext<S>& context);
  void store_impulses(const StepContext<S>& context);
  /// Returns the number of islands that were swept, or whose pivoting did not end, in some solve of the step.
  std::uint32_t unsolved() const;
  template <class Visit> void visit_scratch(const Visit& visit, SolverStage stage, const StepContext<S>& context);

 private:
  using System = LinearSystem<S>;
  using N = typename System::Number;
  using D = IslandNumber<N>;
  using Value = typename System::Value;
  using V = Velocity<S>;
  using Block = ContactBlock<S, 1, kMaxContactPoints>;

  /// The most IslandSystem::work of an island, times the step's sub-steps: some 25 ms each in double. A standing tower
  /// of 400 blocks takes 50 000, a heap that falls into place ten times as much, one in a corner any number. A solve
  /// may take all that is left, but must leave least_work() for each later solve.
  static constexpr std::uint64_t kMostWork = 500'000;

  /// A biased pass closes errors; a relaxed pass leaves them.
  enum class Pass : std::uint32_t { biased, relaxed };

  /// M^-1/2 of a body: for motion root 2^root_exponent; for turning that times turn 2^turn_exponent, lower triangular.
  struct BodyRoot {
    N root;
    int root_exponent, turn_exponent;
    Mat3<N> turn;
  };
  /// The Jacobian of a row, whose speed is linear . (v_b - v_a) + angular_b . w_b - angular_a . w_a  [m/s].
  struct Shape {
    Vec3<S> linear, angular_a, angular_b;
  };
  /// One end of a row; each half has its own exponent.
  struct End {
    IslandMotion<N> part;
    int linear_exponent, angular_exponent;
  };
  /// The bodies of a block of the system.
  struct Ends {
    std::uint32_t a, b;  // rows of SolverBodies
    Value reduced;       // [kg] reduced mass: what impulses are counted in
  };
  struct Island {
    MethodSystem<N> system;
    std::vector<std::uint32_t> joints, contacts, bodies;      // bodies: their rows; numbered 1.. in the system
    std::vector<std::uint32_t> joint_blocks, contact_blocks;  // first block of each
    std::vector<Ends> ends;                                   // of each block
    std::vector<Shape> shapes;                                // of each row
    std::vector<V> asked;                                     // [m/s] of each row: by how much its speed is to change
    int exponent;                                             // of the system's answers
    bool begun;                                               // answers are this step's
    std::uint64_t work_left;                                  // of this step
    std::uint32_t solves_left;
    bool unsolved;  // some solve of this step was swept, or came to no end
    bool pushed;    // mechanisms push some of its bodies
  };
  struct alignas(64) ContactMemory {
    unsigned char bytes[sizeof(RollingBlock<S, 1, kMaxContactPoints>)];
  };

  // island_solver_islands.inl
  void find_islands(const StepContext<S>& context);
  Island& island_of(std::uint32_t row_a, std::uint32_t row_b);
  std::uint32_t add_blocks(Island& island, std::uint32_t row_a, std::uint32_t row_b, std::uint32_t count);
  void add_joint(const JointConstraint<S>& joint, std::uint32_t j);
  void add_contact(const StepContext<S>& context, std::uint32_t c);
  static bool rolls(const StepContext<S>& context, std::uint32_t c);

  // island_solver_rows.inl
  void find_root(std::uint32_t row, const Mat3<S>& kappa);
  static Mat3<N> lower_root(const Mat3<N>& k);
  End end_of(std::uint32_t row, const Shape& shape, bool is_a) const;
  static IslandMotion<N> brought_to(const End& end, int exponent);
  static int scale_of(const End& a, const End& b);
  void place(Island& island, std::uint32_t first, std::uint32_t count, int least_exponent);
  V speed_of(const Island& island, std::uint32_t r, const std::vector<MotionRow<V>>& motion) const;
  Value answer_of(const Island& island, std::uint32_t r, V impulse) const;
  V impulse_of(const Island& island, std::uint32_t r) const;
  void load(Island& island, std::uint32_t r, V impulse) const;

  // island_solver_joints.inl
  JointStep<S> joint_step(const StepContext<S>& context);
  void linearise_joints(const StepContext<S>& context, Island& island);
  void stiffen(Island& island, std::span<const JointConstraint<S>> joints, Step<S> h);
  void place_joint(const JointConstraint<S>& joint, Island& island, std::uint32_t first);
  void ask_joint(const JointConstraint<S>& joint, Island& island, std::uint32_t first, Pass pass);
  void guess_joint(const JointConstraint<S>& joint, Island& island, std::uint32_t first);
  void soften(Island& island, std::uint32_t r, const JointDrive<S>& drive);
  V most_impulse(const JointDrive<S>& drive) const;
  void keep_joint(JointConstraint<S>& joint, const Island& island, std::uint32_t first) const;
  bool tighten(Island& island);

  // island_solver_contacts.inl
  ISO_INLINE Block& block_of(const StepContext<S>& context, std::uint32_t c) {
    return *reinterpret_cast<Block*>(memory_[c].bytes + (rolls(context, c) ? sizeof(RollingRows<S, 1>) : 0));
  }
  void place_contact(const StepContext<S>& context, Island& island, std::uint32_t k);
  void ask_contact(const StepContext<S>& context, Island& island, std::uint32_t k, Pass pass);
  void guess_contact(const StepContext<S>& context, Island& island, std::uint32_t k);
  void keep_contact(const StepContext<S>& context, Island& island, std::uint32_t k);
  void keep(const StepContext<S>& context, Island& island);

  // island_solver.inl
  void place_rows(const StepContext<S>& context, Island& island);
  void follow(const StepContext<S>& context, Island& island);
  void take_back_turns(const StepContext<S>& context, Island& island, std::uint32_t k);
  void solve(const StepContext<S>& context, Island& island, Pass pass);
  void solve_tight(const StepContext<S>& context, Island& island);
  template <class Act> void move_freely(const StepContext<S>& context, const Act& act);
  void begin_mechanisms(const StepContext<S>& context);
  void solve_mechanisms(const StepContext<S>& context);
  void relax_mechanisms(const StepContext<S>& context);
  void scale_right_sides(Island& island);
  void apply(const Island& island);
  MotionRow<V> with_answers(const Island& island, std::uint32_t body, const MotionRow<V>& free) const;

  IslandMethod method_;
  BodyRows<S> bodies_;
  Impacts<S> impacts_;
  PreparedJoints<S> joints_;
  std::int32_t rate_ = 1;  // [1/s] sub-steps
  DisjointSets sets_;
  std::vector<std::uint32_t> island_of_;  // of each set, by its name
  std::vector<std::uint32_t> local_;      // of each row of the bodies: its number in its island
  std::vector<Island> islands_;
  std::uint32_t island_count_ = 0;
  std::vector<BodyRoot> roots_;
  std::vector<Mat3<S>> kappa_, tension_;  // of each row: as joints see it; of those that are taut
  std::vector<std::uint32_t> taut_;
  std::vector<ContactMemory> memory_;
  std::vector<BlockBodies> block_bodies_;
  std::vector<std::uint32_t> order_;
  std::vector<MotionRow<V>> free_velocity_;  // of each row: without this sub-step's impulses
  std::vector<End> ends_;
};

#define ISO_DECLARE(S) extern template class IslandSolver<S>;
ISO_FOR_EACH_SCALAR(ISO_DECLARE)
#undef ISO_DECLARE

}  // namespace isostep
