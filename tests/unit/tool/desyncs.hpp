// Two peers that part: sessions played with a fault in one of them, their bundles, and what `isostep diff` says.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "isostep/replay/desync_bundle.hpp"
#include "isostep/replay/session_recorder.hpp"
#include "isostep/state/value_text.hpp"
#include "own_folder.hpp"
#include "tool/command_line.hpp"
#include "tool/common/files.hpp"
#include "unit/world/played_session.hpp"

namespace isostep::test {

inline constexpr Frame kFault = 37;

template <class T> T with_bit_turned(T value) { return field_from_bits<T>(field_bits(value) ^ 1u); }

/// The body above everything: its motion is its own.
template <class S> BodyState<S>& far_body(Arena<S>& arena) {
  for (const BodyState<S>& body : arena.world.state().awake.states) {
    if (body.slot == arena.far.slot) return const_cast<BodyState<S>&>(body);
  }
  __builtin_trap();
}

template <class S> struct Peer {
  /// The fault at kFault: before the commands, before one of its steps, after a stage of that step, or last.
  std::function<void(Arena<S>&)> before, between, at_end;
  std::function<void(Arena<S>&)> outside;  // between the frame before kFault and kFault
  std::function<void(Arena<S>&, Stage)> inside;
  int steps = 1, fault_step = 0;  // of kFault
  std::uint64_t salt = 0;         // into the game's hashes from kFault on

  Arena<S> arena;
  FrameHistory<S> history;
  std::vector<std::uint8_t> recording;
  SessionRecorder<S> recorder{history, sink_to(recording), "arena"};

  explicit Peer(bool stages = true) : history(arena.world, {.frames = 32, .stages = stages}) {}

  void play(Frame end) {
    for (Frame frame = 0; frame < end; ++frame) {
      if (frame == kFault && outside) outside(arena);
      history.before_step(frame);
      recorder.before_step(frame);
      if (frame == kFault && before) before(arena);
      int step = 0;
      play_frame(arena, frame, input_of(frame), frame == kFault ? steps : steps_of(frame), [&] {
        const bool faulty = frame == kFault && step++ == fault_step;
        if (faulty && between) between(arena);
        const auto after = [](void* user, Stage stage, const StageView&) {
          Peer& peer = *static_cast<Peer*>(user);
          peer.inside(peer.arena, stage);
        };
        arena.world.step(faulty && inside ? StageObserver{after, this} : StageObserver{});
      });
      if (frame == kFault && at_end) at_end(arena);
      history.after_step(frame);
      const std::uint64_t hash = arena.world.hash() ^ (frame >= kFault ? salt : 0);
      history.confirmed(frame, hash);
      recorder.confirmed(frame, hash);
    }
    EXPECT_EQ(recorder.finish().ok(), steps <= static_cast<int>(kFrameStepCap));
  }
};

class Desync : public OwnFolder {
 protected:
  template <class S> void bundle(const Peer<S>& peer, const std::string& name, BundleSettings settings) {
    std::vector<std::uint8_t> bytes;
    ASSERT_TRUE(write_bundle(sink_to(bytes), peer.history, "arena", settings).ok());
    tool::write_file(path(name), Bytes(bytes));
  }
  /// Writes bundles after both played beyond the fault, with windows that start at different frames.
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
};

inline void expect_part(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" is not in\n" << text;
}

/// ".velocity.x: 1.5 | 1.5000001 (0x3fc00000 | 0x3fc00001), 1 ulp apart [body slot 2]"
template <class T> std::string turned(const char* field, T value, BodyId body) {
  const T other = with_bit_turned(value);
  constexpr FieldFormat format = kFieldFormat<T>;
  return std::string(field) + ": " + value_text(value) + " | " + value_text(other) + " (" +
         bits_text(format, field_bits(value)) + " | " + bits_text(format, field_bits(other)) + "), 1 " +
         (kIsFixed<T> ? "lsb" : "ulp") + " apart [body slot " + std::to_string(body.slot) + "]\n";
}

template <class Test> void for_all_scalars(Test&& test) {
  test(float());
  test(double());
  test(Q16_16());
  test(Q32_32());
}

}  // namespace isostep::test
