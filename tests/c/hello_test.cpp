// The scene of hello.cpp gives in C the hashes that it gives in C++, in every scalar and every frame.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include "hello_frames.h"
#include "isostep/core/scalars.hpp"
#include "isostep/world/world.hpp"

namespace isostep::test {
namespace hello_test {

constexpr int kFrames = 120;

template <class S> std::vector<std::uint64_t> frames_in_cpp() {
  World<S> world;
  const ShapeId ground = world.add_shape(Box{{50, 1, 50}}), crate = world.add_shape(Box{{0.5, 0.5, 0.5}});
  world.create({.shape = ground, .position = {S(0), S(-1), S(0)}});
  const BodyId body = world.create({.type = dynamic, .shape = crate, .position = {S(0), S(2), S(0)}, .user_data = 42});
  world.apply_impulse(body, {S(0), S(3), S(0)});
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < kFrames; ++i) {
    world.step();
    hashes.push_back(world.hash());
  }
  return hashes;
}

void expect_same(int (*frames)(std::uint64_t*, int), const std::vector<std::uint64_t>& expected) {
  std::vector<std::uint64_t> hashes(kFrames);
  ASSERT_EQ(frames(hashes.data(), kFrames), 0) << "the line of hello_frames.c that failed";
  EXPECT_EQ(hashes, expected);
  EXPECT_NE(hashes.front(), hashes.back());
}

TEST(HelloInC, HasTheHashesOfCppInFloat) { expect_same(hello_frames_f32, frames_in_cpp<float>()); }
TEST(HelloInC, HasTheHashesOfCppInDouble) { expect_same(hello_frames_f64, frames_in_cpp<double>()); }
TEST(HelloInC, HasTheHashesOfCppInQ16) { expect_same(hello_frames_q16, frames_in_cpp<Q16_16>()); }
TEST(HelloInC, HasTheHashesOfCppInQ32) { expect_same(hello_frames_q32, frames_in_cpp<Q32_32>()); }

}  // namespace hello_test
}  // namespace isostep::test
