// One frame of a world, played here stage by stage, and the place at which two such frames part.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isostep/world/command_codec.hpp"
#include "isostep/world/world.hpp"
#include "state_diff.hpp"

namespace isostep::tool {

/// Of a frame's stages: kTraceHashes a step, as World::trace_to gives them.
using Trace = std::span<const std::uint64_t>;

/// Where in a frame two traces part.
struct StagePlace {
  std::size_t index;             // of the first hash that differs
  std::size_t steps_a, steps_b;  // in the frame

  StagePlace(Trace a, Trace b)
      : index(static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin())),
        steps_a(a.size() / kTraceHashes),
        steps_b(b.size() / kTraceHashes) {}

  /// All that both have agrees: they part in their counts of steps or after the last one.
  bool is_after_both() const { return index == kTraceHashes * std::min(steps_a, steps_b); }
  bool is_outside_steps() const { return index % kTraceHashes == 0 && (steps_a == steps_b || !is_after_both()); }
  /// "stage prepare", "step 2 of the frame, stage commands", "steps: 1 in A, 2 in B".
  std::string text() const {
    const std::size_t step = index / kTraceHashes, stage = index % kTraceHashes;
    if (is_after_both()) {
      if (steps_a != steps_b)
        return "steps: " + std::to_string(steps_a) + " in A, " + std::to_string(steps_b) + " in B";
      if (steps_a == 0) return "stage commands";
      return steps_a == 1 ? "stage commands after the step" : "stage commands after the last step";
    }
    const bool one = steps_a == 1 && steps_b == 1;
    const std::string of = one ? "" : "step " + std::to_string(step + 1) + " of the frame, ";
    return of + "stage " + (stage == 0 ? "commands" : kStageNames[stage - 1]);
  }
};

template <class S> class PlayedFrame {
 public:
  /// From `world` on.
  PlayedFrame(World<S>&& world, Bytes tape) : world_(std::move(world)), tape_(tape) {
    world_.save(before_);
    world_.trace_to(&trace_);
    playable_ = world_.step_recorded(tape_).ok();
    world_.trace_to(nullptr);
    hash_ = world_.hash();
  }

  bool playable() const { return playable_; }
  std::uint64_t hash() const { return hash_; }
  Trace trace() const { return trace_; }
  /// At the frame's end for a place after both.
  WorldState<S> state_at(const StagePlace& place) {
    struct Watch {
      const World<S>& world;
      std::size_t left;
      std::optional<WorldState<S>> state;
    } watch{world_, place.index, {}};
    const auto look = [](void* user, Stage) {
      Watch& w = *static_cast<Watch*>(user);
      if (w.left-- == 0) w.state = w.world.state();
    };
    world_.load(before_);
    static_cast<void>(play_tape<S>(
        tape_, [&](const Command<S>& command) { return world_.apply(command); },
        [&] {
          look(&watch, {});
          world_.step({look, &watch});
        }));
    return place.is_after_both() ? world_.state() : watch.state.value();
  }

 private:
  World<S> world_;
  typename World<S>::Snapshot before_;
  Bytes tape_;
  std::vector<std::uint64_t> trace_;
  bool playable_ = false;
  std::uint64_t hash_ = 0;
};

}  // namespace isostep::tool
