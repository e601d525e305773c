// isostep selfcheck: the floating-point environment, and a short golden list in every scalar with every set of lanes.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "commands.hpp"
#include "goldens.hpp"
#include "isostep/core/version.hpp"
#include "isostep/scalar/environment.hpp"
#include "replay_check.hpp"
#include "scene_game.hpp"

namespace isostep::tool {
namespace {

constexpr const char kScene[] = "S1x5";

bool check_environment() {
  const std::uint32_t found = probe_environment() | probe_environment_here();
  if (found == 0) {
    std::printf("arithmetic     as IEEE 754 has it\n");
    return true;
  }
  std::printf("arithmetic     NOT as IEEE 754 has it:");
  for (int i = 0; i < kDeviationCount; ++i) {
    if ((found >> i & 1u) != 0) std::printf(" %s", kDeviationNames[i]);
  }
  std::printf("\n");
  return false;
}

const GoldenText* golden_of(const std::string& name) {
  for (const GoldenText& golden : golden_texts()) {
    if (name == golden.name) return &golden;
  }
  return nullptr;
}

template <class S> bool check_scalar() {
  const std::string name = golden_name(kScene, ScalarTraits<S>::kName);
  const GoldenText* golden = golden_of(name);
  if (golden == nullptr) {
    std::printf("%-14s no golden list in this build\n", ScalarTraits<S>::kName);
    return false;
  }
  bool sound = true;
  for (const char* lanes : {"scalar", "sse2", "avx2", "avx512", "neon", "wasm"}) {
    if (!World<S>().use_simd(simd_named(lanes))) continue;
    const CheckedFile checked = check_golden(name, golden->text, simd_named(lanes));
    std::printf("%-7s %-6s %s: %s\n", ScalarTraits<S>::kName, lanes, kScene, text_of(checked).c_str());
    sound = sound && status_of(checked) == exit_status::kOk;
  }
  return sound;
}

}  // namespace

int command_selfcheck() {
  std::printf("isostep %s, %s, %s, behaviour %s\n", kVersionText, compiler_name(), architecture_name(),
              hex(behaviour_version()).c_str());
  bool sound = check_environment();
  any_scalar([&](auto tag) {
    sound = check_scalar<typename decltype(tag)::Type>() && sound;
    return false;
  });
  std::printf("%s\n", sound ? "sound" : "NOT SOUND");
  return sound ? exit_status::kOk : exit_status::kDifferent;
}

}  // namespace isostep::tool
