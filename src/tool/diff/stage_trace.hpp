// One frame of a world, played here stage by stage, and the place at which two such frames part.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "isostep/replay/world_kinds.hpp"

namespace isostep::tool {

/// The hashes of a frame's stages, as World::trace_to gives them: for each step a hash before it and one after each
/// stage.
using Trace = std::span<const std::uint64_t>;

/// The place in a frame at which two traces part.
struct StagePlace {
  std::span<const char* const> stages;  // of the world
  std::size_t hashes;                   // for each step
  std::size_t index;                    // of the first hash that differs
  std::size_t steps_a, steps_b;         // in the frame

  StagePlace(Trace a, Trace b, std::span<const char* const> stage_names)
      : stages(stage_names),
        hashes(stage_names.size() + 1),
        index(static_cast<std::size_t>(std::mismatch(a.begin(), a.end(), b.begin(), b.end()).first - a.begin())),
        steps_a(a.size() / hashes),
        steps_b(b.size() / hashes) {}

  /// All that both have agrees: they part in their counts of steps or after the last one.
  bool is_after_both() const { return index == hashes * std::min(steps_a, steps_b); }
  bool is_outside_steps() const { return index % hashes == 0 && (steps_a == steps_b || !is_after_both()); }
  /// "stage prepare", "step 2 of the frame, stage commands", "steps: 1 in A, 2 in B".
  std::string text() const {
    const std::size_t step = index / hashes, stage = index % hashes;
    if (is_after_both()) {
      if (steps_a != steps_b)
        return "steps: " + std::to_string(steps_a) + " in A, " + std::to_string(steps_b) + " in B";
      if (steps_a == 0) return "stage commands";
      return steps_a == 1 ? "stage commands after the step" : "stage commands after the last step";
    }
    const bool one = steps_a == 1 && steps_b == 1;
    const std::string of = one ? "" : "step " + std::to_string(step + 1) + " of the frame, ";
    return of + "stage " + (stage == 0 ? "commands" : stages[stage - 1]);
  }
};

/// The place at which two traces of worlds of one kind part.
template <class W> StagePlace place_of(Trace a, Trace b) { return {a, b, WorldTraits<W>::kStages}; }

template <class W> class PlayedFrame {
 public:
  /// Plays one frame from `world` on.
  PlayedFrame(W&& world, Bytes commands) : world_(std::move(world)), commands_(commands) {
    world_.save(before_);
    world_.trace_to(&trace_);
    playable_ = world_.step_recorded(commands_).ok();
    world_.trace_to(nullptr);
    hash_ = world_.hash();
  }

  bool playable() const { return playable_; }
  std::uint64_t hash() const { return hash_; }
  Trace trace() const { return trace_; }
  /// The state at a place; at the frame's end for a place after both.
  typename W::State state_at(const StagePlace& place) {
    Watch watch{world_, place.index, {}};
    world_.load(before_);
    static_cast<void>(world_.step_recorded(commands_, {&Watch::step, &watch}));
    return place.is_after_both() ? world_.state() : watch.state.value();
  }

 private:
  /// Keeps the state after so many looks.
  struct Watch {
    W& world;
    std::size_t left;
    std::optional<typename W::State> state;

    void look() {
      if (left-- == 0) state = world.state();
    }
    static void step(void* user) {
      Watch& watch = *static_cast<Watch*>(user);
      watch.look();  // before the first stage
      watch.world.step({[](void* of, auto...) { static_cast<Watch*>(of)->look(); }, user});
    }
  };

  W world_;
  typename W::Snapshot before_;
  Bytes commands_;
  std::vector<std::uint64_t> trace_;
  bool playable_ = false;
  std::uint64_t hash_ = 0;
};

}  // namespace isostep::tool
