// Replays of particle worlds: recorded from the world's own commands, verified without the game's code; damaged ones
// never are.
// SPDX-License-Identifier: MIT
#include "determinism/particle_mess.hpp"
#include "isostep/particles/recorder.hpp"
#include "isostep/state/verify.hpp"

namespace isostep::test {
namespace particle_replay_test {

template <class S> class ParticleReplay : public ::testing::Test {
 protected:
  static ReplayHeader header_here(const ParticleSettings<S>& settings, std::string_view scene = "mess") {
    return make_replay_header(identity_of_world(settings, scene)).value();
  }
  static std::vector<std::uint8_t> record(const ParticleSettings<S>& settings, std::uint64_t frames,
                                          bool finish = true) {
    std::vector<std::uint8_t> file;
    ParticleWorld<S> w(settings);
    build_particle_mess(w);  // before the recording: its first state is whatever the world is by then
    ParticleRecorder<S> recorder(w, sink_to(file));
    EXPECT_TRUE(recorder.begin("mess").ok());
    for (std::uint64_t frame = 0; frame < frames; ++frame) {
      play(w, frame);
      if (frame % 10 == 5) play(w, 3000 + frame);  // two steps in a frame
      EXPECT_TRUE(recorder.end_frame().ok());
      if (frame % 16 != 3) continue;
      EXPECT_TRUE(recorder.end_frame().ok()) << "a pause";
    }
    EXPECT_TRUE(!finish || recorder.finish().ok());
    EXPECT_TRUE(frames < 40 || w.counts().contacts > 0);
    EXPECT_GT(w.particles().size(), 60u);
    return file;
  }
  static VerifyResult verify_here(Bytes file, const ParticleSettings<S>& settings) {
    const ReplayReader replay(file);
    const ReplayHeader here = header_here(settings);
    ParticleWorld<S> w;
    return verify_replay(replay, w, SameHeader{here});
  }
};
TYPED_TEST_SUITE(ParticleReplay, AllScalars);

TYPED_TEST(ParticleReplay, what_was_recorded_is_verified_whichever_way_it_was_stepped) {
  using S = TypeParam;
  for (const std::uint32_t way : {1u, 4u, 6u, 13u}) {
    const ParticleSettings<S> settings = settings_of_way<S>(way);
    const std::vector<std::uint8_t> file = this->record(settings, 40);
    const VerifyResult result = this->verify_here(file, settings);
    EXPECT_EQ(result.outcome, VerifyOutcome::verified) << describe(result);
    EXPECT_EQ(result.frames, 43u);
  }
}

TYPED_TEST(ParticleReplay, a_file_that_is_cut_is_truncated_and_one_that_is_changed_is_corrupt) {
  using S = TypeParam;
  const ParticleSettings<S> settings = settings_of_way<S>(1);
  const std::vector<std::uint8_t> file = this->record(settings, 12);
  for (std::size_t at = 0; at < file.size(); at += 13) {
    std::vector<std::uint8_t> bad = file;
    bad[at] = static_cast<std::uint8_t>(bad[at] ^ (1u << at % 8));
    const VerifyResult result = this->verify_here(bad, settings);
    ASSERT_EQ(result.outcome, VerifyOutcome::corrupt) << "byte " << at << ": " << describe(result);
    const std::vector<std::uint8_t> cut(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(at));
    ASSERT_EQ(this->verify_here(cut, settings).outcome, VerifyOutcome::truncated) << at;
  }
  EXPECT_EQ(this->verify_here(this->record(settings, 12, false), settings).outcome, VerifyOutcome::truncated);
}

TYPED_TEST(ParticleReplay, the_header_names_a_world_of_particles_and_every_setting_counts) {
  using S = TypeParam;
  const ParticleSettings<S> settings = settings_of_way<S>(1);
  const std::vector<std::uint8_t> file = this->record(settings, 4);
  const ReplayReader replay(file);
  ASSERT_TRUE(replay.has_header());
  ASSERT_NE(replay.header().find(kWorldKey), nullptr);
  EXPECT_EQ(replay.header().find(kWorldKey)->value.view(), "particles");
  const auto outcome = [&](auto&& change) {
    ParticleSettings<S> other = settings;
    change(other);
    return this->verify_here(file, other).outcome;
  };
  EXPECT_EQ(outcome([](auto&) {}), VerifyOutcome::verified);
  EXPECT_EQ(outcome([](auto& s) { s.hz = 61; }), VerifyOutcome::incompatible);
  EXPECT_EQ(outcome([](auto& s) { s.substeps = 9; }), VerifyOutcome::incompatible);
  EXPECT_EQ(outcome([](auto& s) { s.gravity.x = S(1); }), VerifyOutcome::incompatible);
  EXPECT_EQ(outcome([](auto& s) { s.integrator = Integrator::rk4; }), VerifyOutcome::incompatible);
  EXPECT_EQ(outcome([](auto& s) { s.solver = ParticleSolver::worst_first; }), VerifyOutcome::incompatible);
  EXPECT_EQ(outcome([](auto& s) { s.stepping = Stepping::time_division; }), VerifyOutcome::incompatible);
  EXPECT_EQ(outcome([](auto& s) { s.iterations = 7; }), VerifyOutcome::incompatible);
  // The same numbers of a rigid world.
  ReplayIdentity rigid = identity_of_world(settings, "mess");
  rigid.world = {};
  const ReplayHeader here = make_replay_header(rigid).value();
  ParticleWorld<S> w;
  const VerifyResult result = verify_replay(replay, w, SameHeader{here});
  EXPECT_EQ(result.outcome, VerifyOutcome::incompatible);
  EXPECT_EQ(result.mismatch.key.view(), "world");
}

TYPED_TEST(ParticleReplay, loading_a_snapshot_ends_a_recording) {
  using S = TypeParam;
  ParticleWorld<S> w;
  w.create(particle_at<S>({0, 1, 0}));
  typename ParticleWorld<S>::Snapshot saved;
  w.save(saved);
  std::vector<std::uint8_t> file;
  ParticleRecorder<S> recorder(w, sink_to(file));
  ASSERT_TRUE(recorder.begin("none").ok());
  w.step();
  EXPECT_TRUE(recorder.end_frame().ok());
  w.load(saved);
  w.step();
  EXPECT_FALSE(recorder.end_frame().ok());
}

TYPED_TEST(ParticleReplay, command_logs_that_no_world_wrote_are_refused) {
  using S = TypeParam;
  ParticleWorld<S> w;
  const ParticleId id = w.create(particle_at<S>({0, 1, 0}));
  std::vector<std::uint8_t> log;
  w.record_to(&log);
  w.apply_force(id, vec<S>(1, 2, 3));
  w.add(spring_of<S>(id, {}, 4));
  w.step();
  w.record_to(nullptr);
  ASSERT_EQ(log.back(), kStepMarker);
  for (std::size_t length = 1; length + 1 < log.size(); ++length) {
    ParticleWorld<S> other;
    other.create(particle_at<S>({0, 1, 0}));
    const bool whole = other.step_recorded(Bytes(log).first(length)).ok();
    // Between two commands a log may end.
    EXPECT_EQ(whole, length == 1 + 2 + 3 * sizeof(S)) << length;  // the number, a small id, the force
  }
  log[0] = 200;
  EXPECT_FALSE(w.step_recorded(log).ok()) << "no command has this number";
  log.assign(kFrameStepCap + 1, kStepMarker);
  EXPECT_FALSE(w.step_recorded(log).ok()) << "more steps than a frame may have";
  ParticleWorld<S> empty;
  log.clear();
  Writer writer(log);
  write_command<EveryParticleCommand<S>>(writer, DestroyParticle{id});
  EXPECT_FALSE(empty.step_recorded(log).ok()) << "a command that the world refuses";
}

}  // namespace particle_replay_test
}  // namespace isostep::test
