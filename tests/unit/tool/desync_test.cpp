// A bit is turned over in one of two peers; from what both wrote the tool names frame, stage, body, field and values.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "isostep/state/value_text.hpp"
#include "isostep/world/desync_bundle.hpp"
#include "isostep/world/session_recorder.hpp"
#include "tool/commands.hpp"
#include "tool/files.hpp"
#include "unit/world/played_session.hpp"

namespace isostep::test {
namespace {

namespace fs = std::filesystem;

constexpr Frame kFault = 37;

template <class T> T with_bit_turned(T value) { return leaf_from_bits<T>(leaf_bits(value) ^ 1u); }

/// The body above everything: its motion is its own.
template <class S> BodyState<S>& far_body(Arena<S>& arena) {
  for (const BodyState<S>& body : arena.world.state().awake.states) {
    if (body.slot == arena.far.slot) return const_cast<BodyState<S>&>(body);
  }
  __builtin_trap();
}

template <class S> struct Peer {
  /// What goes wrong at kFault: before the step, or after a stage of it.
  std::function<void(Arena<S>&)> before;
  std::function<void(Arena<S>&, Stage)> inside;
  std::uint64_t salt = 0;  // into the game's roots from kFault on

  Arena<S> arena;
  FrameHistory<S> history;
  std::vector<std::uint8_t> recording;
  SessionRecorder<S> recorder{history, sink_to(recording), "arena"};

  explicit Peer(bool stages = true) : history(arena.world, {.frames = 32, .stages = stages}) {}

  void play(Frame end) {
    for (Frame frame = 0; frame < end; ++frame) {
      history.before_step(frame);
      recorder.before_step(frame);
      if (frame == kFault && before) before(arena);
      play_frame(arena, frame, input_of(frame), [&] {
        const auto after = [](void* user, Stage stage) {
          Peer& peer = *static_cast<Peer*>(user);
          peer.inside(peer.arena, stage);
        };
        arena.world.step(frame == kFault && inside ? StageObserver{after, this} : StageObserver{});
      });
      history.after_step(frame);
      const std::uint64_t root = arena.world.hash() ^ (frame >= kFault ? salt : 0);
      history.confirmed(frame, root);
      recorder.confirmed(frame, root);
    }
    EXPECT_TRUE(recorder.finish().ok());
  }
};

class Desync : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo& info = *testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("isostep-desync-") + info.name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  template <class S> void bundle(const Peer<S>& peer, const std::string& name, BundleSettings settings) {
    std::vector<std::uint8_t> bytes;
    ASSERT_TRUE(write_bundle(sink_to(bytes), peer.history, "arena", settings).ok());
    tool::write_file(path(name), Bytes(bytes));
  }
  /// After both played beyond the fault, with windows that start at different frames.
  template <class S> void bundles(Peer<S>& a, Peer<S>& b, std::uint32_t states = 16) {
    a.play(45);
    b.play(44);
    bundle(a, "a", {0xff, kFault - 2, states});
    bundle(b, "b", {1, kFault - 1, states});
  }
  std::string diff(const std::string& a, const std::string& b, int status) {
    const std::string first = path(a), second = path(b);
    const char* words[] = {"isostep", "diff", first.c_str(), second.c_str()};
    testing::internal::CaptureStdout();
    const int answer = tool::run_command_line(4, words);
    std::fflush(stdout);
    const std::string out = testing::internal::GetCapturedStdout();
    EXPECT_EQ(answer, status) << out;
    return out;
  }

  fs::path folder_;
};

void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is not in\n" << text;
}

/// ".velocity.x: 1.5 | 1.5000001 (0x3fc00000 | 0x3fc00001), 1 ulp apart [body slot 2]"
template <class T> std::string turned(const char* field, T value, BodyId body) {
  const T other = with_bit_turned(value);
  constexpr LeafFormat format = kLeafFormat<T>;
  return std::string(field) + ": " + value_text(value) + " | " + value_text(other) + " (" +
         bits_text(format, leaf_bits(value)) + " | " + bits_text(format, leaf_bits(other)) + "), 1 " +
         (kIsFixed<T> ? "lsb" : "ulp") + " apart [body slot " + std::to_string(body.slot) + "]\n";
}

template <class Test> void for_all_scalars(Test&& test) {
  test(float());
  test(double());
  test(Q16_16());
  test(Q32_32());
}

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
                "  the commands of this frame agree: something else changed a state before the step\n  ");
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
    expect_part(out, "\nframe 37, stage commands\n  the commands of this frame differ\n");
    expect_part(out, "user_data: 0 | 77 ");
    expect_part(out, "as recorded for both: they had other commands or other states before\n");
  }
}

TEST_F(Desync, OfTheGameBesideItsWorldIsToldApart) {
  Peer<float> a, b;
  b.salt = 5;
  bundles(a, b);
  expect_part(diff("a", "b", 1), "\nframe 37: the worlds agree, what the games keep beside them differs (roots ");
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

}  // namespace
}  // namespace isostep::test
