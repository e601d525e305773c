// The self-check finds this build sound, and names the recording, scalar, lanes and frame of whatever is not.
// SPDX-License-Identifier: MIT
#include "isostep/replay/selfcheck.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "built.hpp"
#include "hostile_environment.hpp"
#include "isostep/core/scalars.hpp"
#include "isostep/core/simd_choice.hpp"
#include "isostep/particles/settings.hpp"
#include "isostep/replay/replay_check.hpp"
#include "isostep/replay/world_kinds.hpp"
#include "isostep/state/replay_format.hpp"

namespace isostep {
namespace selfcheck_test {

using Buffer = std::vector<std::uint8_t>;

std::span<const SelfcheckRecording> builtin() { return detail::selfcheck_recordings(); }

/// The built-in set with one file replaced.
class Altered {
 public:
  Altered(const std::string& name, const std::string& scalar) : set_(builtin().begin(), builtin().end()) {
    for (SelfcheckRecording& recording : set_) {
      if (name == recording.name && scalar == recording.scalar) place_ = &recording;
    }
    EXPECT_NE(place_, nullptr) << "no recording " << name << '.' << scalar;
  }
  Bytes original() const { return place_->file; }
  SelfcheckResult with(const Buffer& file) const {
    place_->file = file;
    return detail::selfcheck(set_, 0);
  }

 private:
  std::vector<SelfcheckRecording> set_;
  SelfcheckRecording* place_ = nullptr;
};

/// The replay again with the right checksums: edit(header), then edit(frame, input, hash) for each frame.
template <class EditHeader, class EditFrame>
Buffer rewritten(Bytes file, const EditHeader& edit_header, const EditFrame& edit_frame) {
  const ReplayReader replay(file);
  ReplayHeader header = replay.header();
  edit_header(header);
  Buffer out;
  ReplayWriter writer(sink_to(out));
  bool ok = writer.begin(header, replay.state(), replay.state_hash()).ok();
  for (std::uint64_t i = 0; i < replay.frame_count(); ++i) {
    Buffer input(replay.frame(i).input.begin(), replay.frame(i).input.end());
    std::uint64_t hash = replay.frame(i).hash;
    edit_frame(i, input, hash);
    ok = writer.frame(input, hash).ok() && ok;
  }
  EXPECT_TRUE(writer.finish().ok() && ok);
  return out;
}
const auto kSameHeader = [](ReplayHeader&) {};
const auto kSameFrame = [](std::uint64_t, Buffer&, std::uint64_t&) {};

std::uint32_t failed_of(const SelfcheckResult& result, const std::string& scalar) {
  std::uint32_t failed = 0;
  for (const SelfcheckPart& part : result.parts) failed += part.scalar == scalar ? part.failed : 0;
  return failed;
}
std::uint32_t lanes_of(const SelfcheckResult& result, const std::string& scalar) {
  return static_cast<std::uint32_t>(std::count_if(result.parts.begin(), result.parts.end(),
                                                  [&](const SelfcheckPart& part) { return part.scalar == scalar; }));
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Expects each set of lanes that a world of that scalar has. Returns how many.
template <class S> std::size_t expect_lanes(const SelfcheckResult& result) {
  std::size_t sets = 0;
  for (std::uint32_t i = 1; i < kSimds; ++i) {
    World<S> world;
    if (!world.use_simd(static_cast<Simd>(i))) continue;
    ++sets;
    const auto found = std::find_if(result.parts.begin(), result.parts.end(), [&](const SelfcheckPart& part) {
      return std::string(part.scalar) == ScalarTraits<S>::kName && std::string(part.lanes) == kSimdNames[i];
    });
    EXPECT_NE(found, result.parts.end()) << ScalarTraits<S>::kName << ' ' << kSimdNames[i];
    if (found == result.parts.end()) continue;
    EXPECT_GE(found->recordings, 8u);
    EXPECT_GT(found->frames, 500u);
    EXPECT_EQ(found->failed, 0u);
    EXPECT_TRUE(has(describe(result), ScalarTraits<S>::kName) && has(describe(result), kSimdNames[i]));
  }
  return sets;
}

TEST(Selfcheck, FindsThisBuildSoundInEveryScalarWithEverySetOfLanes) {
  const SelfcheckResult result = selfcheck();
  ASSERT_TRUE(result.sound()) << describe(result)
                              << "\nrecordings of another behaviour version are renewed by ./isostep regenerate";
  EXPECT_EQ(result.caller, 0u) << deviation_names(result.caller);
  std::size_t sets = 0;
  any_scalar([&](auto tag) {
    sets += expect_lanes<typename decltype(tag)::Type>(result);
    return false;
  });
  EXPECT_EQ(result.parts.size(), sets);
  EXPECT_EQ(describe(result).rfind("sound: isostep ", 0), 0u) << describe(result);
  EXPECT_FALSE(has(describe(result), "\n"));
}

/// The methods with which the recordings of a scalar begin.
template <class S> struct Methods {
  std::set<SolverName> solvers;
  std::set<ParticleSolver> particle_solvers;
  std::set<Integrator> integrators;
  std::set<Stepping> steppings;

  void look_at(const SelfcheckRecording& recording) {
    if (check_replay(recording.file).left_out != nullptr) return;
    const ReplayReader replay(recording.file);
    EXPECT_EQ(replay.header().find("compiler"), nullptr) << "regenerating elsewhere would give other bytes";
    World<S> bodies;
    if (read_whole(bodies, replay.state())) {
      EXPECT_EQ(bodies.tick() + bodies.counts().bodies + bodies.counts().shapes, 0u) << recording.name;
      solvers.insert(bodies.settings().solver);
      return;
    }
    ParticleWorld<S> particles;
    EXPECT_TRUE(read_whole(particles, replay.state())) << recording.name;
    EXPECT_EQ(particles.tick() + particles.counts().particles, 0u) << recording.name;
    particle_solvers.insert(particles.settings().solver);
    integrators.insert(particles.settings().integrator);
    steppings.insert(particles.settings().stepping);
  }
};

TEST(Selfcheck, CarriesEveryMethodFromTheEmptyWorldOnInHalfAMegabyte) {
  std::size_t bytes = 0;
  for (const SelfcheckRecording& recording : builtin()) bytes += recording.file.size();
  EXPECT_LT(bytes, (1u << 20) / 2);
  any_scalar([&](auto tag) {
    using S = typename decltype(tag)::Type;
    Methods<S> methods;
    for (const SelfcheckRecording& recording : builtin()) {
      if (std::string(recording.scalar) == ScalarTraits<S>::kName) methods.look_at(recording);
    }
    EXPECT_EQ(methods.solvers.size(), std::size(test::kBuiltSolvers));
    EXPECT_EQ(methods.particle_solvers.size(), kParticleSolvers);
    EXPECT_EQ(methods.steppings.size(), kSteppings);
    EXPECT_EQ(methods.integrators.count(Integrator::implicit_euler), 1u);
    return false;
  });
}

TEST(Selfcheck, NamesTheScalarAndTheFrameOfAHashThatIsAnother) {
  constexpr std::uint64_t kFrame = 17, kBit = 1u << 9;
  any_scalar([&](auto tag) {
    const std::string scalar = ScalarTraits<typename decltype(tag)::Type>::kName;
    const Altered set("medley_direct", scalar);
    const SelfcheckResult result =
        set.with(rewritten(set.original(), kSameHeader, [&](std::uint64_t frame, Buffer&, std::uint64_t& hash) {
          if (frame == kFrame) hash ^= kBit;
        }));
    EXPECT_FALSE(result.sound());
    EXPECT_TRUE(result.failure.has_value());
    if (!result.failure) return false;
    EXPECT_EQ(result.failure->recording, "medley_direct");
    EXPECT_EQ(result.failure->scalar, scalar);
    EXPECT_EQ(result.failure->lanes, "scalar");
    EXPECT_EQ(result.failure->result.outcome, VerifyOutcome::diverged);
    EXPECT_EQ(result.failure->result.frames, kFrame);
    EXPECT_EQ(result.failure->result.expected ^ result.failure->result.actual, kBit);
    std::uint32_t failed = 0;
    for (const SelfcheckPart& part : result.parts) failed += part.failed;
    EXPECT_EQ(failed, lanes_of(result, scalar)) << "once with each set of lanes, and nothing else";
    EXPECT_EQ(failed_of(result, scalar), failed);
    const std::string line = describe(result);
    EXPECT_EQ(line.rfind("NOT SOUND: ", 0), 0u) << line;
    EXPECT_TRUE(has(line, "medley_direct in " + scalar + " by scalar: DIVERGED at frame 17: ")) << line;
    return false;
  });
}

TEST(Selfcheck, FindsOneBitOfACommandInTheFrameThatItActsIn) {
  constexpr std::uint64_t kPush = 12;  // of the medley's script: an impulse, whose x is 9 bytes into the command log
  const Altered set("medley", "float");
  const SelfcheckResult result =
      set.with(rewritten(set.original(), kSameHeader, [&](std::uint64_t frame, Buffer& input, std::uint64_t&) {
        if (frame == kPush) input.at(9) ^= 1;
      }));
  ASSERT_TRUE(result.failure.has_value());
  EXPECT_EQ(result.failure->result.outcome, VerifyOutcome::diverged) << describe(result);
  EXPECT_EQ(result.failure->result.frames, kPush);
  EXPECT_EQ(result.failure->scalar, "float");
}

TEST(Selfcheck, ReportsADamagedFileAndOneOfAnotherBehaviour) {
  const Altered set("springs", "q16.16");
  Buffer bytes(set.original().begin(), set.original().end());
  bytes[bytes.size() / 2] ^= 4;
  const Buffer foreign = rewritten(
      set.original(), [](ReplayHeader& header) { header.set("behaviour", "0123456789abcdef", true); }, kSameFrame);
  const SelfcheckResult damaged = set.with(bytes), other = set.with(foreign);
  for (const SelfcheckResult* result : {&damaged, &other}) {
    EXPECT_FALSE(result->sound());
    ASSERT_TRUE(result->failure.has_value());
    EXPECT_EQ(result->failure->scalar, "q16.16");
    EXPECT_EQ(failed_of(*result, "q16.16"), lanes_of(*result, "q16.16"));
  }
  EXPECT_EQ(damaged.failure->result.outcome, VerifyOutcome::corrupt);
  EXPECT_EQ(other.failure->result.outcome, VerifyOutcome::incompatible);
  EXPECT_TRUE(has(describe(other), "INCOMPATIBLE: behaviour is \"0123456789abcdef\"")) << describe(other);
}

TEST(Selfcheck, IsNotSoundWhereOneScalarHasNoRecordings) {
  any_scalar([&](auto tag) {
    const std::string scalar = ScalarTraits<typename decltype(tag)::Type>::kName;
    std::vector<SelfcheckRecording> others;
    for (const SelfcheckRecording& recording : builtin()) {
      if (recording.name == std::string("springs") && recording.scalar != scalar) others.push_back(recording);
    }
    const SelfcheckResult result = detail::selfcheck(others, 0);
    EXPECT_FALSE(result.failure.has_value()) << describe(result);
    EXPECT_GT(result.frames(), 0u);
    EXPECT_GT(lanes_of(result, scalar), 0u);
    for (const SelfcheckPart& part : result.parts) EXPECT_EQ(part.recordings, part.scalar == scalar ? 0u : 1u);
    EXPECT_FALSE(result.sound());
    EXPECT_TRUE(has(describe(result), "; no replays of " + scalar)) << describe(result);
    return false;
  });
}

TEST(Selfcheck, IsNotSoundWithoutRecordingsOrWithAnEngineThatDeviates) {
  EXPECT_FALSE(detail::selfcheck({}, 0).sound());
  SelfcheckResult result = selfcheck();
  result.engine = bit_of(Deviation::contract_float) | bit_of(Deviation::rounding);
  EXPECT_FALSE(result.sound());
  EXPECT_TRUE(has(describe(result), "the engine's arithmetic: rounding contract-float")) << describe(result);
}

#if defined(ISOSTEP_HOSTILE_ENVIRONMENTS)
/// What the caller left behind reaches no step, but is told: arithmetic of the game's own has no guard.
TEST(Selfcheck, IsSoundInAHostileEnvironmentAndNamesIt) {
  struct Case {
    std::uint32_t control;
    Deviation deviation;
    const char* name;
  };
  using namespace test;
  for (const Case& hostile : {Case{kMasks | kUp, Deviation::rounding, "rounding"},
                              Case{kMasks | kTowardsZero, Deviation::rounding, "rounding"},
                              Case{kMasks | kFlush, Deviation::flush_float, "flush-float"},
                              Case{kMasks | kDenormalsAreZero, Deviation::zero_double, "zero-double"}}) {
    SelfcheckResult result;
    std::uint32_t after = 0;
    {
      const Hostile environment(hostile.control);
      result = selfcheck();
      after = Hostile::control();
    }
    EXPECT_EQ(after, hostile.control) << hostile.name;
    EXPECT_TRUE(result.sound()) << describe(result);
    EXPECT_EQ(result.engine, 0u) << deviation_names(result.engine);
    EXPECT_NE(result.caller & bit_of(hostile.deviation), 0u) << deviation_names(result.caller);
    EXPECT_TRUE(has(describe(result), "; the caller's own arithmetic: ")) << describe(result);
    EXPECT_TRUE(has(describe(result), hostile.name)) << describe(result);
  }
}
#endif

}  // namespace selfcheck_test
}  // namespace isostep
