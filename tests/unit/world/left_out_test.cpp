// A method that this build leaves out is refused by name; where nothing is left out, nothing is.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include "built.hpp"
#include "isostep/replay/replay_check.hpp"
#include "isostep/replay/selfcheck.hpp"
#include "isostep/state/members.hpp"
#include "unit/world/refusing_world.hpp"

namespace isostep::test {
namespace left_out_test {

const char* const kWhy = left_out(SolverName::worst_first);
const std::string kSentence = "this build leaves out worst_first: ISOSTEP_BOOK is off";

template <class S> class LeftOut : public RefusingWorld<S> {};
using TwoScalars = ::testing::Types<double, Q32_32>;  // of the build without the book that tests make
TYPED_TEST_SUITE(LeftOut, TwoScalars);

TEST(LeftOutMethods, are_the_books_and_all_of_them_or_none) {
  EXPECT_EQ(std::size(kBuiltSolvers), kHasBook ? kSolvers : kSolvers - 1);
  EXPECT_EQ(std::size(kBuiltBroadPhases), kHasBook ? kBroadPhases : 1u);
  for (const SolverName solver : kBuiltSolvers) EXPECT_EQ(left_out(solver), nullptr);
  for (const BroadPhaseName name : kBuiltBroadPhases) EXPECT_EQ(left_out(name), nullptr);
  EXPECT_EQ(left_out(static_cast<SolverName>(kSolvers)), nullptr) << "no method at all";
  EXPECT_EQ(left_out(static_cast<BroadPhaseName>(kBroadPhases)), nullptr);
  if (!kHasBook) {
    EXPECT_EQ(kWhy, kSentence);
  }
}

TYPED_TEST(LeftOut, a_solver_of_the_settings_is_a_fault) {
  using S = TypeParam;
  Settings<S> s = settings<S>();
  s.solver = SolverName::worst_first;
  const World<S> w(s);
  if (kHasBook) {
    EXPECT_EQ(w.settings().solver, SolverName::worst_first);
    EXPECT_EQ(w.fault(), Fault::none);
    return;
  }
  EXPECT_EQ(w.fault(), Fault::bad_argument);
  EXPECT_EQ(describe(w.fault()), "World: solver: not a valid value; expected another: " + kSentence);
}

TYPED_TEST(LeftOut, a_broad_phase_is_refused_and_the_one_of_before_stays) {
  World<TypeParam>& w = this->world;
  for (std::uint32_t i = 0; i < kBroadPhases; ++i) {
    const BroadPhaseName name{i};
    const char* const why = left_out(name);
    EXPECT_EQ(w.use_broad_phase(name), why == nullptr);
    if (why == nullptr) continue;
    EXPECT_EQ(w.broad_phase(), BroadPhaseName::box_tree);
    EXPECT_NE(
        describe(w.fault()).find(std::string("use_broad_phase: name: not a valid value; expected another: ") + why),
        std::string::npos);
  }
}

TYPED_TEST(LeftOut, a_solver_of_a_state_is_incompatible) {
  using S = TypeParam;
  WorldState<S> state = this->world.state();
  state.settings.solver = SolverName::worst_first;
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  writer.write(ScalarTraits<S>::kId);
  WorldState<S>::members(detail::StateWriter(writer), state);
  const std::uint64_t before = this->world.hash();
  Reader reader(bytes);
  const Result<void> read = this->world.read_portable(reader);
  EXPECT_EQ(static_cast<bool>(read), kHasBook);
  if (read) return;
  EXPECT_EQ(read.error().code, ErrorCode::incompatible);
  EXPECT_EQ(read.error().message.view(), kSentence);
  EXPECT_EQ(this->world.hash(), before);
}

TEST(LeftOutMethods, make_a_recording_incompatible_and_the_self_check_skip_it_and_say_so) {
  std::uint32_t skipped = 0;
  for (const SelfcheckRecording& recording : detail::selfcheck_recordings()) {
    if (std::string(recording.name) != "medley_worst_first") continue;
    const CheckedReplay checked = check_replay(recording.file);
    EXPECT_EQ(checked.result.outcome, kHasBook ? VerifyOutcome::verified : VerifyOutcome::incompatible);
    EXPECT_STREQ(checked.left_out, kWhy);
    ++skipped;
    if (!kHasBook) {
      EXPECT_EQ(describe(checked.result), "INCOMPATIBLE: " + kSentence + " (solver)");
    }
  }
  EXPECT_GE(skipped, 1u);
  const SelfcheckResult result = selfcheck();
  EXPECT_TRUE(result.sound()) << describe(result);
  EXPECT_STREQ(result.left_out, kWhy);
  for (const SelfcheckPart& part : result.parts) EXPECT_EQ(part.skipped, kHasBook ? 0u : 1u);
  EXPECT_EQ(describe(result).find("replays skipped: " + kSentence) != std::string::npos, !kHasBook);
}

}  // namespace left_out_test
}  // namespace isostep::test
