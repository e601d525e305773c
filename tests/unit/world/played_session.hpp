// A session played by hand: a small game with commands on both sides of its step, and predictions that fail.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/timeline/frame.hpp"
#include "worlds.hpp"

namespace isostep::test {

/// Ground, a crate to push, and a ball far above everything, which meets nothing.
template <class S> struct Arena {
  World<S> world{settings<S>(-10, 60, 4)};
  ShapeId ball;
  BodyId crate, far;

  Arena() {
    add_ground(world);
    ball = add_ball(world, 0.25);
    crate = world.create(moving<S>(add_box(world, 0.5, 0.5, 0.5), {0, 0.5, 0}));
    far = world.create(moving<S>(ball, {20, 100, 0}, {1.5, 0, 0}));
  }
};

inline int input_of(Frame frame) { return frame * 7 % 5 - 2; }
/// The game pauses in some frames and runs twice as fast in others.
inline int steps_of(Frame frame) { return frame % 5 == 3 ? 0 : frame % 7 == 4 ? 2 : 1; }

/// One frame of the game: push the crate, drop a ball now and then, step, and take away the balls that began to touch.
template <class S, class Step> void play_frame(Arena<S>& arena, Frame frame, int input, int steps, Step&& step) {
  World<S>& world = arena.world;
  world.apply_impulse(arena.crate, vec<S>(0.25 * input, 0, 0));
  if (frame % 8 == 0) {
    BodyDefinition<S> drop = moving<S>(arena.ball, {0.125 * input, 2, 0});
    drop.user_data = 7;
    world.create(drop);
  }
  for (int i = 0; i < steps; ++i) {
    step();
    for (const ContactBegin<S>& begin : world.events().contact_begin) {
      for (const BodyId body : {begin.a, begin.b}) {
        if (world.user_data(body) == 7) world.destroy(body);
      }
    }
  }
}
template <class S> void play_frame(Arena<S>& arena, Frame frame, int input) {
  play_frame(arena, frame, input, steps_of(frame), [&] { arena.world.step(); });
}

/// Frames first to end - 1. Every frame is predicted wrongly, and six at a time are stepped again with the true inputs
/// and then confirmed.
template <class S, class... Observers>
void play_session(Arena<S>& arena, Frame first, Frame end, Observers&... observers) {
  constexpr Frame batch = 6;
  typename World<S>::Snapshot start;
  const auto step = [&](Frame frame, int input) {
    (observers.before_step(frame), ...);
    play_frame(arena, frame, input);
    (observers.after_step(frame), ...);
  };
  std::vector<std::uint64_t> hashes;
  for (Frame from = first; from < end; from += batch) {
    const Frame to = std::min(from + batch, end);
    arena.world.save(start);
    for (Frame frame = from; frame < to; ++frame) step(frame, input_of(frame) + 1);
    arena.world.load(start);
    (observers.rolled_back(from), ...);
    hashes.clear();
    for (Frame frame = from; frame < to; ++frame) {
      step(frame, input_of(frame));
      hashes.push_back(~arena.world.hash());
    }
    for (Frame frame = from; frame < to; ++frame) {
      (observers.confirmed(frame, hashes[static_cast<std::size_t>(frame - from)]), ...);
    }
  }
}

}  // namespace isostep::test
