// The dated figures: CPU ms a step, lowest of several interleaved runs, on a quiet 2-core Zen 5 virtual machine.
// Box3D 30c67b5 (SSE2, 4 sub-steps), Jolt 5.5.1 (cross-platform deterministic, AVX2), Rapier 0.20 (WebAssembly,
// SIMD).
// SPDX-License-Identifier: MIT
#include "dated.hpp"

#include <iterator>

namespace isostep::bench {
namespace {

constexpr const char* kScenes[] = {"S1", "S2", "S3", "S4", "S5", "S6", "S7", "S8"};

struct Line {
  const char* engine;
  Dated figures[std::size(kScenes)];
};
constexpr double kNone = -1;
constexpr Line kLines[] = {
    {kAnchor,
     {{0.026, false, kNone},
      {0.284, false, kNone},
      {2.61, false, kNone},
      {1.69, false, kNone},
      {6.73, false, kNone},
      {0.077, false, kNone},
      {0.954, false, kNone},
      {0.003, false, kNone}}},
    {"box3d",
     {{0.018, false, 0.108},
      {0.238, false, 0.0009},
      {2.49, false, 0.0009},
      {1.72, false, 0.0020},
      {5.79, false, 0.0031},
      {0.042, false, 0.096},
      {0.698, false, 0.098},
      {0.0006, false, kNone}}},
    {"jolt-native",
     {{0.022, true, kNone},
      {0.383, false, kNone},
      {4.50, false, kNone},
      {2.56, false, 0.017},
      {10.8, false, 0.015},
      {0.030, true, kNone},
      {0.747, false, 0.072},
      {0.0006, false, kNone}}},
};

}  // namespace

std::optional<Dated> dated(std::string_view engine, std::string_view scene) {
  for (const Line& line : kLines) {
    if (engine != line.engine) continue;
    for (std::size_t i = 0; i < std::size(kScenes); ++i) {
      if (scene == kScenes[i]) return line.figures[i];
    }
  }
  return std::nullopt;
}

}  // namespace isostep::bench
