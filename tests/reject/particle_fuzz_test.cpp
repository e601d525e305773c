// Thousands of random commands, tame and wild: whatever is accepted or refused, the state obeys its rules, a refused
// command changes nothing, and what is saved comes back.
// SPDX-License-Identifier: MIT
#include <array>

#include "unit/particles/random_commands.hpp"

namespace isostep::test {
namespace particle_fuzz_test {

constexpr std::size_t kKinds = EveryParticleCommand<float>::kCount;
constexpr std::size_t kFaults = static_cast<std::size_t>(Fault::not_dynamic) + 1;

struct Tally {
  std::array<std::uint32_t, kKinds> accepted{}, refused{};
  std::array<std::uint32_t, kFaults> faults{};
  std::uint32_t contacts = 0, unclean = 0, expired = 0, yielded = 0, touched = 0;
};

/// One of 15: every integrator with every way of resolving.
template <class S> ParticleSettings<S> settings_of(std::uint32_t way) {
  constexpr std::int32_t rates[4][2] = {{60, 4}, {10, 1}, {1000, 4}, {30, 2}};
  ParticleSettings<S> s = particle_settings<S>();
  s.hz = rates[way % 4][0];
  s.substeps = rates[way % 4][1];
  s.integrator = static_cast<Integrator>(way % 5);
  s.solver = way / 5 > 0 ? ParticleSolver::worst_first : ParticleSolver::soft_step;
  s.stepping = way / 5 == 2 ? Stepping::time_division : Stepping::fixed;
  return s;
}

/// A frame: commands and a step.
template <class S> void play(ParticleWorld<S>& w, std::uint64_t seed, std::uint32_t wild, Tally& tally) {
  RandomCommands<S> random(w, seed, wild);
  const std::uint32_t count = random.chance().below(16) + (w.tick() < 8 ? 8 : 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const ParticleCommand<S> command = random.next();
    const bool looks = i % 4 == 0;
    const std::uint64_t before = looks ? w.hash() : 0;
    const bool taken = apply_any(w, command);
    ++(taken ? tally.accepted : tally.refused)[command.index()];
    ++tally.faults[static_cast<std::size_t>(w.fault().fault)];
    ASSERT_EQ(taken, w.fault() == Fault::none) << describe(w.fault());
    if (!looks || taken) continue;
    ASSERT_EQ(w.hash(), before) << "refused command " << command.index() << " changed something";
  }
  const ParticleReport report = w.step();
  tally.unclean += report.clean() ? 0u : 1u;
  tally.contacts += w.counts().contacts;
  tally.expired += static_cast<std::uint32_t>(w.events().expired.size());
  tally.yielded += static_cast<std::uint32_t>(w.events().yielded.size());
  tally.touched += static_cast<std::uint32_t>(w.events().touch_impulses.size());
}

template <class S> class ParticleFuzz : public ::testing::Test {};
TYPED_TEST_SUITE(ParticleFuzz, AllScalars);

TYPED_TEST(ParticleFuzz, states_obey_their_rules_and_come_back_whatever_is_commanded) {
  using S = TypeParam;
  Tally tally;
  for (std::uint32_t way = 0; way < 15; ++way) {
    for (const std::uint32_t wild : {0u, 30u, 250u}) {
      SCOPED_TRACE(::testing::Message() << "way " << way << " wild " << wild);
      ParticleWorld<S> w(settings_of<S>(way));
      typename ParticleWorld<S>::Snapshot saved;
      Tally again;
      std::uint64_t expected = 0;
      for (std::uint64_t frame = 0; frame < 80; ++frame) {
        const std::uint64_t seed = frame * 4096 + way * 256 + wild;
        ASSERT_NO_FATAL_FAILURE(play(w, seed, wild, tally)) << "frame " << frame;
        ASSERT_EQ(broken_rule(w), "") << "frame " << frame;
        if (frame % 20 == 10) {
          w.save(saved);
          expected = w.hash();
        }
        if (frame % 20 != 13) continue;
        // Back to the save, and the same three frames again.
        const std::uint64_t reached = w.hash();
        w.load(saved);
        ASSERT_EQ(w.hash(), expected);
        for (std::uint64_t f = frame - 2; f <= frame; ++f) play(w, f * 4096 + way * 256 + wild, wild, again);
        ASSERT_EQ(w.hash(), reached) << "frame " << frame;
      }
      const std::vector<std::uint8_t> bytes = bytes_of(w);
      ParticleWorld<S> rebuilt;
      Reader reader(bytes);
      ASSERT_TRUE(rebuilt.read_portable(reader).ok());
      ASSERT_EQ(rebuilt.hash(), w.hash());
      ASSERT_EQ(bytes_of(rebuilt), bytes);
      for (std::uint64_t f = 9000; f < 9010; ++f) {
        play(w, f, wild, again);
        play(rebuilt, f, wild, again);
        ASSERT_EQ(rebuilt.hash(), w.hash());
      }
    }
  }
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    EXPECT_GT(tally.accepted[kind], 0u) << "command " << kind;
    EXPECT_GT(tally.refused[kind], 0u) << "command " << kind;
  }
  for (std::size_t fault = 0; fault < kFaults; ++fault) {
    if (kIsFixed<S> && static_cast<Fault>(fault) == Fault::not_finite) continue;
    EXPECT_GT(tally.faults[fault], 0u) << fault_text(static_cast<Fault>(fault));
  }
  EXPECT_GT(tally.contacts, 1000u);
  EXPECT_GT(tally.unclean, 100u);
  EXPECT_GT(tally.expired, 500u);
  EXPECT_GT(tally.yielded, 10u);
  EXPECT_GT(tally.touched, 500u);
}

}  // namespace particle_fuzz_test
}  // namespace isostep::test
