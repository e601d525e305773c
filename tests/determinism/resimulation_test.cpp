// A step from memory is the whole step, bit for bit: state, events and report, whatever comes late.
// SPDX-License-Identifier: MIT

#include "random/late_inputs.hpp"
#include "sample.hpp"

namespace isostep::test {
namespace resimulation_test {

template <class S> class Resimulated : public ::testing::Test {
 protected:
  void play(LateWorld kind, SolverName solver, int first, int seeds, int frames, int side) {
    for (int seed = first; seed < first + seeds; ++seed) {
      LateInputs<S> both(kind, static_cast<std::uint64_t>(seed), solver, side);
      EXPECT_EQ(both.play(frames), "") << kSolverNames[static_cast<int>(solver)];
      const Resimulation r = both.totals();
      sum = {sum.parts + r.parts, sum.whole + r.whole, sum.bodies + r.bodies, sum.stepped + r.stepped};
    }
  }
  Resimulation sum;
};
TYPED_TEST_SUITE(Resimulated, AllScalars);

TYPED_TEST(Resimulated, fields_step_what_differs) {
  this->play(LateWorld::field, SolverName::soft_step, 0, sampled(200, 6), 120, 6);
  EXPECT_GT(this->sum.parts, 4 * this->sum.whole);
  EXPECT_GT(this->sum.whole, 0u);
  EXPECT_LT(20 * this->sum.stepped, this->sum.bodies);
}
/// Records that see bodies far away lead to whole steps in most of these worlds; in the named ones few come so early.
TYPED_TEST(Resimulated, worlds_of_everything) {
  this->play(LateWorld::everything, SolverName::soft_step, 0, sampled(200, 5), 120, 0);
  for (const int seed : {8, 28, 30}) this->play(LateWorld::both, SolverName::soft_step, seed, 1, 120, 5);
  if (wants_whole()) this->play(LateWorld::both, SolverName::soft_step, 31, 200, 120, 5);
  EXPECT_GT(this->sum.parts, 100u);
  EXPECT_GT(this->sum.whole, 100u);
}
TYPED_TEST(Resimulated, by_every_solver) {
  for (int solver = 0; solver < kSolvers; ++solver) {
    const auto name = static_cast<SolverName>(solver);
    if (left_out(name) == nullptr) this->play(LateWorld::field, name, 1, sampled(20, 1), 60, 4);
  }
  EXPECT_GT(this->sum.parts, 0u);
}

TEST(Resimulation, takes_what_was_right_from_memory) {
  World<double> w(settings<double>());
  add_field(w, 3, 4, 0);
  w.remember_steps(8);
  World<double>::Snapshot first;
  w.save(first);
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 8; ++i) {
    w.step();
    hashes.push_back(w.hash());
  }
  w.load(first);
  for (const std::uint64_t hash : hashes) {
    w.step();
    EXPECT_EQ(w.hash(), hash);
  }
  EXPECT_EQ(w.resimulation().parts, 8u);
  EXPECT_EQ(w.resimulation().stepped, 0u);
  w.remember_steps(0);
  w.load(first);
  w.step();
  EXPECT_EQ(w.hash(), hashes[0]);
  EXPECT_EQ(w.resimulation().parts, 0u);
}

/// A body that is thrown at another cluster wakes it: sleepers that a step reaches are stepped, too.
TEST(Resimulation, a_late_throw_wakes_what_it_meets) {
  const auto make = [] {
    auto w = std::make_unique<World<float>>(settings<float>());
    w->create(still<float>(add_box(*w, 40, 1, 40), {0, -1, 0}));
    const ShapeId box = add_box(*w, 0.5, 0.5, 0.5);
    for (int i = 0; i < 20; ++i) w->create(moving<float>(box, {2.0 * i, 0.5, 0}));
    return w;
  };
  const auto plain = make(), remembering = make();
  remembering->remember_steps(16);
  World<float>::Snapshot asleep;
  for (int i = 0; i < 60; ++i) {
    if (i == 50) plain->save(asleep);
    for (World<float>* w : {plain.get(), remembering.get()}) w->step();
  }
  ASSERT_GT(plain->counts().asleep, 10u);
  const BodyId first = plain->bodies()[1];
  for (World<float>* w : {plain.get(), remembering.get()}) {
    w->load(asleep);
    w->set_velocity(first, vec<float>(8, 0, 0), vec<float>(0, 0, 0));
  }
  for (int i = 0; i < 60; ++i) {
    EXPECT_EQ(plain->step().clean(), remembering->step().clean());
    EXPECT_EQ(plain->hash(), remembering->hash()) << i;
    EXPECT_EQ(bytes_of_events(plain->events()), bytes_of_events(remembering->events())) << i;
  }
}

}  // namespace resimulation_test
}  // namespace isostep::test
