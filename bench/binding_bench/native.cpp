// The measurements of Bench.cs and bench.py in C++: a frame of 1000 boxes with poses read, and calls through the C
// interface.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "isostep.h"
#include "isostep/world/world.hpp"

namespace iso = isostep;

namespace {

constexpr int kBodies = 1000, kRounds = 5, kFrames = 200, kCalls = 1000000, kReads = 4000;

/// [s] Processor time: other programs take little of that away.
double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// [s] One `work`, the least of several rounds of so many, each after `begin`.
template <class Begin, class Work> double least(int times, Begin&& begin, Work&& work) {
  double least = 1e9;
  for (int round = 0; round < kRounds; ++round) {
    begin();
    const double start = now();
    for (int i = 0; i < times; ++i) work();
    least = std::min(least, (now() - start) / times);
  }
  return least;
}

template <class S> void frames(const char* name) {
  iso::World<S> world;
  const auto ground = world.add_shape(iso::Box{{50, 1, 50}});
  world.create({.shape = ground, .position = {0, -1, 0}});
  const auto crate = world.add_shape(iso::Box{{0.5, 0.5, 0.5}});
  for (int i = 0; i < kBodies; ++i) {
    iso::BodyDefinition<S> definition;
    definition.type = iso::dynamic;
    definition.shape = crate;
    definition.position = {S(i % 10) * S(1.25) - S(6), S(0.75) + S(i / 100) * S(1.5), S(i / 10 % 10) * S(1.25) - S(6)};
    definition.allow_sleep = false;
    world.create(definition);
  }
  double sum = 0;
  const auto read = [&] {
    for (const iso::RenderPose& pose : world.poses_float(0.5f)) sum += static_cast<double>(pose.position[1]);
  };
  typename iso::World<S>::Snapshot start;
  world.save(start);
  const double frame = least(
      kFrames, [&] { world.load(start); },
      [&] {
        world.step();
        read();
      });
  std::printf("%s %.4f ms a frame, sum %.6g\n", name, frame * 1e3, sum);
  // The poses are what a frame has beside its step, which is the same code for all languages.
  const double poses = least(
      kReads, [] {}, read);
  std::printf("%s %.4f us for its poses, sum %.6g\n", name, poses * 1e6, sum);
}

void must(iso_status status) {
  if (status != ISO_OK) std::abort();
}

template <class F> void calls(const char* name, F&& call) {
  std::printf("%s %.1f ns\n", name,
              least(
                  kCalls / kRounds, [] {}, call) *
                  1e9);
}

void all_calls() {
  iso_f32_settings settings;
  iso_f32_sphere sphere;
  iso_f32_body_definition definition;
  iso_f32_body_state state;
  iso_world* world;
  iso_body body;
  must(iso_f32_settings_init(&settings));
  must(iso_f32_world_create(&settings, &world));
  must(iso_f32_sphere_init(&sphere));
  sphere.radius = 1;
  must(iso_f32_body_definition_init(&definition));
  must(iso_f32_body_state_init(&state));
  must(iso_f32_add_sphere(world, &sphere, &definition.shape));
  definition.type = ISO_BODY_TYPE_DYNAMIC;
  must(iso_f32_body_create(world, &definition, &body));
  const iso_f32_vec3 impulse = {0, 0, 0};
  calls("BodyExists", [&] { must(iso_body_exists(world, body) == 1 ? ISO_OK : ISO_NULL); });
  calls("GetBodyState", [&] { must(iso_f32_body_get_state(world, body, &state)); });
  calls("ApplyImpulse", [&] { must(iso_f32_body_apply_impulse(world, body, &impulse, nullptr)); });
  must(iso_world_destroy(world));
}

}  // namespace

int main() {
  frames<float>("F32");
  frames<iso::Q32_32>("Fixed32");
  all_calls();
}
