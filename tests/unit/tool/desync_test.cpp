// A bit is turned over in one of two peers; from what both wrote the tool names frame, stage, body, field and values.
// SPDX-License-Identifier: MIT
#include "desyncs.hpp"

namespace isostep::test {
namespace desync_test {

TEST_F(Desync, OfABitBeforeTheStepIsNamedByFrameStageBodyFieldAndValues) {
  for_all_scalars([&](auto scalar) {
    using S = decltype(scalar);
    Peer<S> a, b;
    b.before = [](Arena<S>& arena) { far_body(arena).velocity.x = with_bit_turned(far_body(arena).velocity.x); };
    bundles(a, b);
    const std::string out = diff("a", "b", 1);
    expect_part(out,
                "A: the host, agreed before frame 35, frames 35 to 44\nB: player 1, agreed before frame 36, "
                "frames 36 to 43\nframe 37, stage commands\n"
                "  the commands of this frame agree: something else changed a state outside its steps\n  ");
    expect_part(out, turned(".velocity.x", Velocity<S>(1.5), a.arena.far));
    expect_part(out, "the frame comes out as A recorded it, not as B did\n");
    expect_part(diff("b", "a", 1), "the frame comes out as B recorded it, not as A did\n");
    expect_part(diff("a", "a", 0), "the same: frames 35 to 44\n");
  });
}

TEST_F(Desync, OfABitInsideAStageIsNamedByTheStage) {
  for_all_scalars([&](auto scalar) {
    using S = decltype(scalar);
    for (const Stage stage : {Stage::apply_forces, Stage::finalise_bodies, Stage::update_sleep}) {
      Peer<S> a, b;
      b.inside = [stage](Arena<S>& arena, Stage now) {
        if (now == stage) far_body(arena).centre.z = with_bit_turned(far_body(arena).centre.z);
      };
      bundles(a, b);
      const std::string out = diff("a", "b", 1);
      expect_part(out, "\nframe 37, stage " + std::string(kStageNames[static_cast<std::uint32_t>(stage)]) + "\n");
      if (stage != Stage::apply_forces) expect_part(out, turned(".centre.z", S(0), a.arena.far));
      expect_part(out, "as A recorded it, not as B did\n");
    }
  });
}

TEST_F(Desync, OfAContactIsNamedByItsBodies) {
  Peer<float> a, b;
  float before = 0;
  b.inside = [&before](Arena<float>& arena, Stage now) {
    if (now != Stage::store_impulses) return;
    auto& contact = const_cast<Contact<float>&>(arena.world.state().contacts.front());
    before = contact.normal_impulse[2];
    contact.normal_impulse[2] = with_bit_turned(before);
  };
  bundles(a, b);
  const std::string out = diff("a", "b", 1);
  expect_part(out, "\nframe 37, stage store_impulses\n  contacts[0].normal_impulse[2]: " + value_text(before) + " | " +
                       value_text(with_bit_turned(before)) + " (");
  expect_part(out, ", 1 ulp apart [body slots 0 and 1]\n");
}

TEST_F(Desync, WithoutATraceIsNamedByFrameBodyAndField) {
  using S = Q16_16;
  Peer<S> a(false), b(false);
  b.before = [](Arena<S>& arena) { far_body(arena).velocity.x = with_bit_turned(far_body(arena).velocity.x); };
  bundles(a, b);
  const std::string out = diff("a", "b", 1);
  expect_part(out, "\nwithin frame 37 (trace was off)\n");
  expect_part(out, turned(".velocity.x", Velocity<S>(1.5), a.arena.far));
}

TEST_F(Desync, OfCommandsIsFoundByPlayingBothAgain) {
  for (const bool stages : {false, true}) {
    Peer<float> a(stages), b(stages);
    b.before = [](Arena<float>& arena) { arena.world.set_user_data(arena.far, 77); };
    bundles(a, b, stages ? 16 : 0);
    const std::string out = diff("a", "b", 1);
    expect_part(out, "\nframe 37, stage commands\n  the commands or steps of this frame differ\n");
    expect_part(out, "user_data: 0 | 77 ");
    expect_part(out, "as recorded for both: they had other commands or other states before\n");
  }
}

/// On a busy machine; isostep peer writes as many states as the event spans.
TEST_F(Desync, WhoseReportsCameFarApartNeedsTheStatesOfTheirSpan) {
  constexpr Frame agreed = kFault - 20, differ = kFault + 3;
  Peer<float> a, b;
  b.before = [](Arena<float>& arena) { far_body(arena).velocity.x = with_bit_turned(far_body(arena).velocity.x); };
  a.play(45);
  b.play(44);
  bundle(a, "a", {0xff, agreed, 16});
  bundle(b, "b", {1, agreed, 16});
  expect_part(diff("a", "b", 1), "the state that B had is not in its file and does not come out here\n");
  bundle(b, "b", {1, agreed, static_cast<std::uint32_t>(differ - agreed)});
  expect_part(diff("a", "b", 1), turned(".velocity.x", 1.5f, a.arena.far));
}

TEST_F(Desync, OfACommandOutsideItsFrameIsNamedAsThat) {
  Peer<float> a, b;
  b.outside = [](Arena<float>& arena) { arena.world.set_velocity(arena.far, {2, 0, 0}, {0, 0, 0}); };
  bundles(a, b);
  const std::string out = diff("a", "b", 1);
  expect_part(
      out,
      "\nframe 37, stage commands\n  the world of B was changed between frames 36 and 37: a command outside its "
      "frame, which no rollback repeats\n");
  expect_part(out, ".velocity.x: 1.5 | 2 ");
  expect_part(diff("a", "a", 0), "the same: frames 35 to 44\n");
}

TEST_F(Desync, OfDifferentAwakeSetsComparesEachBodyWithItself) {
  Peer<float> a, b;
  b.before = [](Arena<float>& arena) { arena.world.destroy(arena.crate); };  // the rows behind it move up
  bundles(a, b);
  const std::string out = diff("a", "b", 1);
  expect_part(out, "\nframe 37, stage commands\n");
  expect_part(out, "bodies.slot_" + std::to_string(a.arena.crate.slot) + ".present: 1 | 0 ");
  EXPECT_EQ(out.find("[body slot " + std::to_string(a.arena.far.slot) + "]"), std::string::npos) << out;
  EXPECT_EQ(out.find(".slot: "), std::string::npos) << out;
}

TEST_F(Desync, OfTheGameBesideItsWorldIsToldApart) {
  Peer<float> a, b;
  b.salt = 5;
  bundles(a, b);
  expect_part(diff("a", "b", 1), "\nframe 37: the worlds agree, what the games keep beside them differs (hashes ");
}

TEST_F(Desync, IsFoundBetweenABundleAndTheRecordingOfTheWholeMatch) {
  Peer<double> a, b;
  b.before = [](Arena<double>& arena) { far_body(arena).velocity.x = with_bit_turned(far_body(arena).velocity.x); };
  bundles(a, b);
  tool::write_file(path("match"), Bytes(a.recording));
  const std::string out = diff("match", "b", 1);
  expect_part(out, "A: frames 0 to 44\nB: player 1, ");
  expect_part(out, "\nwithin frame 37 (trace was off)\n");
  expect_part(out, turned(".velocity.x", 1.5, a.arena.far));
  expect_part(out, "as A recorded it, not as B did\n");
  expect_part(diff("match", "a", 0), "the same: frames 35 to 44\n");
}

TEST_F(Desync, BeforeTheFirstFrameThatBothFilesHoldIsSaid) {
  Peer<float> a, b;
  b.before = [](Arena<float>& arena) { far_body(arena).velocity.x = with_bit_turned(far_body(arena).velocity.x); };
  a.play(45);
  b.play(45);
  bundle(a, "a", {0, 40, 16});
  bundle(b, "b", {1, 41, 16});
  const std::string out = diff("a", "b", 1);
  expect_part(out, "\nbefore frame 41, the first that is in both\n");
  expect_part(out, turned(".velocity.x", 1.5f, a.arena.far));
}

TEST_F(Desync, OfOtherSettingsIsToldByTheHeadersField) {
  Peer<float> a, b;
  b.before = [](Arena<float>& arena) { arena.world.set_gravity({0, -9, 0}); };
  a.play(45);
  b.play(45);
  bundle(a, "a", {0, 40, 16});
  bundle(b, "b", {1, 41, 16});
  const std::string out = diff("a", "b", 1);
  EXPECT_EQ(out.rfind("settings: ", 0), 0u) << out;
  expect_part(out, "settings.gravity.y: -10 | -9 ");
}

TEST_F(Desync, OfFilesThatShareNoFrameIsRefused) {
  Peer<float> a, b;
  a.play(45);
  b.play(20);
  bundle(a, "a", {0, 37, 16});
  bundle(b, "b", {1, 11, 16});
  expect_part(diff("a", "b", 1), "no frame is in both\n");
}

TEST_F(Desync, BundleOfTheSoundPeerVerifiesAndTheOtherDivergesThere) {
  Peer<Q32_32> a, b;
  b.before = [](Arena<Q32_32>& arena) { far_body(arena).velocity.x = with_bit_turned(far_body(arena).velocity.x); };
  bundles(a, b);
  const auto verify = [&](const char* name) {
    const std::string file = path(name);
    const char* words[] = {"isostep", "verify", file.c_str()};
    testing::internal::CaptureStdout();
    const int status = tool::run_command_line(3, words);
    std::fflush(stdout);
    const std::string out = testing::internal::GetCapturedStdout();
    EXPECT_EQ(status, name[0] == 'a' ? 0 : 1) << out;
    return out;
  };
  expect_part(verify("a"), "VERIFIED 10 frames");
  expect_part(verify("b"), "DIVERGED at frame 1");
}

}  // namespace desync_test
}  // namespace isostep::test
