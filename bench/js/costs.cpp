// The scene of costs.mjs natively, timed. Its arguments are a scalar and the kernels to use.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <ctime>
#include <string_view>

#include "isostep/world/world.hpp"

namespace iso = isostep;

namespace {

/// [us] The cost of one `work()`, the least of the rounds, in CPU time.
template <class Work> double cost(int times, int rounds, const Work& work) {
  double least = 1e9;
  for (int round = 0; round < rounds; ++round) {
    const std::clock_t before = std::clock();
    for (int i = 0; i < times; ++i) work();
    const double passed = static_cast<double>(std::clock() - before) * 1e6 / CLOCKS_PER_SEC / times;
    if (passed < least) least = passed;
  }
  return least;
}

template <class S> int run(iso::Simd simd) {
  iso::World<S> world({.allow_sleep = false});
  if (!world.use_simd(simd)) return 1;
  const auto box = world.add_shape(iso::Box{{0.5, 0.5, 0.5}});
  world.create({.shape = world.add_shape(iso::Box{{50, 1, 50}}), .position = {0, -1, 0}});
  for (int i = 0; i < 1000; ++i) {
    const int x = i % 10, y = i / 100, z = i / 10 % 10;
    world.create({.type = iso::dynamic,
                  .shape = box,
                  .position = {S(1.25) * S(x) - S(5), S(0.5) + S(1.0625) * S(y), S(1.25) * S(z) - S(5)}});
  }
  for (int i = 0; i < 60; ++i) world.step();
  std::printf("hash %.3g of 2^32\n", static_cast<double>(world.hash() >> 32));
  double sum = 0;
  const auto read_poses = [&] {
    for (const iso::RenderPose& pose : world.poses_float(0.5f)) sum += pose.position[1];
  };
  std::printf("step_%s %.4g us\n", world.simd_name(), cost(20, 10, [&] { world.step(); }));
  std::printf("poses_read %.3g us\n", cost(1000, 10, read_poses));
  std::printf("frame %.4g us\n", cost(20, 10, [&] {
                world.step();
                read_poses();
              }));
  return sum > 0 ? 0 : 1;
}

}  // namespace

int main(int count, char** words) {
  const std::string_view scalar = count > 1 ? words[1] : "", lanes = count > 2 ? words[2] : "best";
  const iso::Simd simd = lanes == "sse2" ? iso::Simd::sse2 : lanes == "scalar" ? iso::Simd::scalar : iso::Simd::best;
  if (scalar == "f32") return run<float>(simd);
  if (scalar == "f64") return run<double>(simd);
  if (scalar == "q16") return run<iso::Q16_16>(simd);
  if (scalar == "q32") return run<iso::Q32_32>(simd);
  std::fprintf(stderr, "usage: costs f32|f64|q16|q32 [best|sse2|scalar]\n");
  return 64;
}
