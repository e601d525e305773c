// The worst-first resolver with other queues than its own: the same bits, whatever finds the worst row.
// SPDX-License-Identifier: MIT

#include "isostep/book/linear_search.hpp"
#include "isostep/book/sorted_order.hpp"
#include "isostep/book/worst_first.inl"
#include "isostep/state/hash.hpp"
#include "isostep/systems/contacts/narrow_phase.hpp"
#include "isostep/world/step_solver.hpp"
#include "unit/world/systems.hpp"

namespace isostep::test {
namespace worst_first_queue_test {

/// The hash of a world's bodies and contacts after a step's solver.
template <class S, class Queue> std::uint64_t hash_of_step(const World<S>& world) {
  Systems<S> systems(world);
  StepTools<S> tools = {};
  tools.use_simd(Simd::scalar);
  systems.find_pairs();
  NarrowPhase<S> phase(systems.state, systems.map);
  phase.update(systems.proxies.pairs(), tools);
  StepSolver<S> steps(systems.state, systems.map, systems.proxies);
  steps.take_forces();
  const StepContext<S> context = steps.context(phase.geometry(), {}, {}, {}, tools, false);
  WorstFirstResolver<S, Queue> solver;
  solver.colour_constraints(context);
  solver.prepare(context);
  solver.solve_substeps(context);
  solver.store_impulses(context);
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  for (const BodyState<S>& state : context.states) writer.write(state);
  for (const Contact<S>& contact : context.contacts) writer.write(contact);
  writer.write(solver.unsolved());
  return hash_bytes(bytes.data(), bytes.size());
}

template <class S> class WorstFirstQueues : public ::testing::Test {};
TYPED_TEST_SUITE(WorstFirstQueues, SystemScalars);

/// Boxes fall in a heap, chained balls among them.
TYPED_TEST(WorstFirstQueues, change_no_bit_of_a_heap_in_any_projection) {
  using S = TypeParam;
  for (std::uint32_t projection = 0; projection < kProjections; ++projection) {
    SCOPED_TRACE(kProjectionNames[projection]);
    Settings<S> s = settings<S>(-10, 60, 4);
    s.solver = SolverName::worst_first;
    s.projection = static_cast<Projection>(projection);
    World<S> w(s);
    add_ground(w);
    const ShapeId box = add_box(w, 0.5, 0.375, 0.25), ball = add_ball(w, 0.25);
    BodyId last;
    for (int i = 0; i < 36; ++i) {
      const D3 at = {0.25 * (i % 3), 0.5 + 0.625 * (i / 2), 0.25 * (i % 4)};
      const BodyId id = w.create(moving<S>(i % 4 == 3 ? ball : box, at, {0, -2, 0}));
      if (i % 8 == 7) w.create(w.joint_at(JointType::ball, last, id, {vec<S>(at), Quat<Unit<S>>::identity()}));
      last = id;
    }
    for (int frame = 0; frame < 90; ++frame) {
      w.step();
      if (frame % 6 != 0) continue;
      const std::uint64_t expected = hash_of_step<S, TournamentTree>(w);
      ASSERT_EQ((hash_of_step<S, SortedOrder>(w)), expected) << frame;
      ASSERT_EQ((hash_of_step<S, LinearSearch>(w)), expected) << frame;
    }
    EXPECT_GE(w.counts().contacts, 14u);
  }
}

}  // namespace worst_first_queue_test
}  // namespace isostep::test
