// Recordings in which every stage of `isostep diff --stages` has something to leave behind.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "determinism/particle_mess.hpp"
#include "determinism/solver_scene.hpp"
#include "isostep/particles/recorder.hpp"
#include "isostep/replay/recorder.hpp"
#include "own_folder.hpp"
#include "tool/command_line.hpp"

namespace isostep::test {

class Recorded : public OwnFolder {
 protected:
  static std::string output(int expected, const std::vector<std::string>& words) {
    std::vector<const char*> pointers = {"isostep", "diff", "--stages"};
    for (const std::string& word : words) pointers.push_back(word.c_str());
    testing::internal::CaptureStdout();
    EXPECT_EQ(tool::run_command_line(static_cast<int>(pointers.size()), pointers.data()), expected);
    std::fflush(stdout);
    return testing::internal::GetCapturedStdout();
  }
};

/// The solvers' scene; a ball that flies through a sensor, a box that falls asleep and is woken.
template <class S> std::vector<std::uint8_t> rigid_recording(SolverName solver, int frames) {
  World<S> w(solver_settings<S>(solver));
  SolverScene<S> scene(w);
  BodyDefinition<S> d = still<S>(add_box(w, 0.5, 0.5, 0.5), {10, 1, 1.5});
  d.sensor = true;
  w.create(d);
  w.create(moving<S>(add_ball(w, 0.25), {10, 1, 0}, {0, 1, 6}));
  const BodyId sleeper = w.create(moving<S>(add_box(w, 0.5, 0.25, 0.5), {14, 0.25, 0}));
  std::vector<std::uint8_t> bytes;
  WorldRecorder<S> recorder(w, sink_to(bytes));
  EXPECT_TRUE(recorder.begin("stages").ok());
  for (int frame = 0; frame < frames; ++frame) {
    if (frame == frames - 4) w.wake(sleeper);
    scene.play(w, static_cast<std::uint64_t>(frame));
    EXPECT_TRUE(recorder.end_frame().ok());
  }
  EXPECT_TRUE(recorder.finish().ok());
  return bytes;
}
template <class S> std::vector<std::uint8_t> particle_recording(std::uint32_t way, int frames) {
  ParticleWorld<S> w(settings_of_way<S>(way));
  build_particle_mess(w);
  std::vector<std::uint8_t> bytes;
  ParticleRecorder<S> recorder(w, sink_to(bytes));
  EXPECT_TRUE(recorder.begin("stages").ok());
  for (int frame = 0; frame < frames; ++frame) {
    play(w, static_cast<std::uint64_t>(frame));
    EXPECT_TRUE(recorder.end_frame().ok());
  }
  EXPECT_TRUE(recorder.finish().ok());
  return bytes;
}

}  // namespace isostep::test
