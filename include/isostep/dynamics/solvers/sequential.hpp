// Sequential impulses on SIMD lanes: soft step, the default solver, and projected Gauss-Seidel by another schedule.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/aligned_bytes.hpp"
#include "isostep/dynamics/colouring.hpp"
#include "isostep/dynamics/joints/joint_tree.hpp"
#include "isostep/dynamics/solvers/body_rows.hpp"
#include "isostep/dynamics/solvers/impacts.hpp"
#include "isostep/dynamics/solvers/pass_plan.hpp"
#include "isostep/dynamics/solvers/prepared_joints.hpp"
#include "isostep/dynamics/solvers/schedule.hpp"
#include "isostep/dynamics/solvers/step_context.hpp"

namespace isostep {

namespace detail {
/// The depth of a contact as a step begins: it rests or touches (shallow); it overlaps by more than kDeepOverlap
/// (deep); it does so with a body that nothing moves (pressed).
inline constexpr std::uint32_t kShallow = 0, kDeep = 1, kPressed = 2, kDepths = 3;

/// The shape of a kernel's contacts, from its index.
struct Variant {
  std::int32_t points;
  bool rolling;
  static ISO_INLINE constexpr Variant of(std::uint32_t index) {
    return {static_cast<std::int32_t>(index) % kMaxContactPoints + 1, index >= kMaxContactPoints};
  }
};
}  // namespace detail

/// The default solver. Contacts are found once a step. Those that share no moving body get one colour and are solved
/// side by side. Joints are solved before them, in trees or one by one, and mechanisms before joints: see Schedule.
/// Order:   that of rigid_solver.hpp. Calls from `prepare` on note what is to be done; the last one does all of it,
///          unless the context is watched.
template <class S> class Sequential {
 public:
  using ScheduleOf = Schedule<S> (*)(const StepContext<S>&);
  explicit Sequential(ScheduleOf schedule_of) : schedule_of_(schedule_of) {}

  void colour_constraints(const StepContext<S>& context);
  void prepare(const StepContext<S>& context);
  void solve_substeps(const StepContext<S>& context);
  void store_impulses(const StepContext<S>& context);
  ISO_INLINE std::uint32_t unsolved() const { return 0; }  // it does what it does to all alike
  template <class Visit> void visit_scratch(const Visit& visit, SolverStage stage, const StepContext<S>& context);

 private:
  static constexpr std::uint32_t kGroupers = 2;  // pieces of Work::group that prepare no joints

  /// Consecutive entries of order_ that one kernel solves.
  struct Run {
    const ContactKernels<S>* kernels;
    std::uint32_t variant, colour;
    std::uint32_t depth;         // of each of its contacts: detail::depth_of()
    std::uint32_t first, count;  // in order_
    std::uint32_t first_block, blocks;
    std::size_t offset;  // [bytes] in memory_
  };
  /// A range of order_.
  struct Contacts {
    std::uint32_t first;
    std::int32_t count;
  };
  /// The place where the kernels read a contact.
  struct Lane {
    unsigned char* words;
    std::size_t width;
    detail::Variant shape;
  };
  /// The work of the pieces of a stage.
  enum class Work : std::uint32_t {
    gather,
    group,
    prepare,
    respond,
    renew_forces,
    bounce,
    integrate_velocities,
    place_mechanisms,
    warm_start_joints,
    warm_start,
    solve_mechanisms,
    solve_joints,
    solve,
    relieve,
    close_mechanisms,
    integrate_positions,
    begin_contacts,
    follow,
    relax_mechanisms,
    relax_joints,
    relax,
    end_mechanisms,
    store_joints,
    add_joint_impulses,
    store,
    store_bodies,
    hold_energy,
  };
  struct Stage {
    Work work;
    const PassPlan* plan;   // of contacts; null: bodies or joints
    std::uint32_t of_plan;  // its stage
  };
  /// The data that every piece reads.
  struct Job {
    Sequential* solver;
    const StepContext<S>& context;
    ContactPass<S> pass;
    JointStep<S> joints;
  };

  // sequential.inl
  void gather(const StepContext<S>& context);
  void colour_contacts(const StepContext<S>& context);
  void add_run(const ContactKernels<S>& kernels, std::uint32_t bucket, std::uint32_t first, std::uint32_t count);
  void share(const TaskRunner& runner, std::uint32_t work);
  void plan_passes(const TaskRunner& runner);
  ISO_INLINE bool any_followed() const {
    bool any = false;
    for (const std::uint8_t some : any_followed_) any = any || some != 0;
    return any;
  }
  std::size_t place_of(const Run& run, std::uint32_t block) const;
  static Contacts contacts_of(const Run& run, const PassPlan::Slice& slice);
  BlockRun<S> blocks_of(const PassPlan::Slice& slice);
  void prepare_slice(const StepContext<S>& context, const PassPlan::Slice& slice);
  void store_slice(const StepContext<S>& context, const PassPlan::Slice& slice);
  void find_lanes(const StepContext<S>& context);
  Lane lane_of(std::uint32_t contact);
  void respond(const StepContext<S>& context);
  void relieve(const StepContext<S>& context);
  void carry(const StepContext<S>& context);
  template <class Act> void each_followed(const StepContext<S>& context, const Act& act);
  void forget_impulses(const StepContext<S>& context);
  void follow(const StepContext<S>& context);

  // sequential_stages.inl
  void run(const StepContext<S>& context);
  void add_stage(Work work, std::uint32_t pieces, const PassPlan* plan = nullptr, std::uint32_t of_plan = 0);
  void add_stages(Work work, const PassPlan& plan);
  void add_pass(Work work, const PassPlan& plan, const StepContext<S>& context);
  void add_mechanisms(Work work, const StepContext<S>& context);
  std::int32_t rounds_of(const StepContext<S>& context) const;
  void add_substep(const StepContext<S>& context, std::uint32_t joints);
  static void do_piece(void* job, std::uint32_t stage, std::uint32_t piece);
  void do_slice(const Job& job, Work work, const PassPlan::Slice& slice);
  void do_joints(const Job& job, Work work, std::uint32_t piece);
  void group(const StepContext<S>& context, std::uint32_t piece);
  void do_bodies(const Job& job, Work work, std::uint32_t piece);
  void do_mechanisms(const StepContext<S>& context, Work work);

  ScheduleOf schedule_of_;
  Schedule<S> schedule_ = {};
  BodyRows<S> bodies_;
  Impacts<S> impacts_;
  PreparedJoints<S> joints_;
  JointTrees<S> joint_trees_;
  Colouring colouring_;
  std::vector<std::uint32_t> bucket_;  // of each contact: (colour * depths + depth) * variants + variant
  std::vector<std::uint32_t> bucket_ends_;
  std::vector<std::uint32_t> order_;  // contacts, grouped
  std::vector<Run> runs_;
  AlignedBytes memory_;
  std::vector<BlockBodies> block_bodies_;
  std::vector<Lane> carried_, responding_;  // as the context's; the former without RollingRows
  std::vector<Velocity<S>> most_;           // [m/s] of the latter, in a sub-step
  std::vector<std::uint32_t> places_;       // of contacts in order_, where any of them is either
  std::uint32_t block_count_ = 0;
  std::size_t memory_bytes_ = 0;
  TaskRunner runner_;                  // the context's, or none where the work is too little to share
  PassPlan colours_[detail::kDepths];  // colour after colour, of contacts of this depth and beyond
  PassPlan all_;                       // every block at once, for what touches no body
  std::uint32_t threads_ = 1, body_pieces_ = 1, joint_pieces_ = 1;
  std::vector<std::uint8_t> any_followed_;  // of each piece of bodies: whether contacts are to follow any
  std::vector<Stage> stages_;
  std::vector<std::uint32_t> pieces_;  // of each stage
};

}  // namespace isostep
