// Tenure: how long a host is the host, and which frames it may tell as final. It knows no network: times and what the
// others have go in, a decision comes out. See AGREEMENT.md.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/session/agreement/roster.hpp"

namespace isostep {

/// Holds what a host knows of one machine of its roster.
struct Follower {
  Time heard = 0;  // [us] when we said the newest that we know it has heard, in this term; 0: nothing
  Frame has = 0;   // all inputs before this frame are there
  /// Its process has left, or another one has taken its place. It remembers nothing, so it has no vote.
  bool is_over = false;
};

/// Raft's leader. An input is final when a majority has it and still follows this host, so whoever is elected later
/// knows it. A lease is how long the others certainly wait for us. It is shorter than their patience, because it begins
/// when we sent what they heard, and their patience when they heard it.
class Tenure {
 public:
  enum class Duty : std::uint8_t {
    serves,     // a majority follows us
    stands,     // it may not: no absence is fixed
    reforms,    // of the others nobody remembers the match, but those with us: they are all of it from now on
    steps_down  // the others may have another host, or soon will
  };

  /// `start`: we took over all inputs before this frame. `final_end`: the end of those that were final already.
  void begin(std::uint32_t term, Time patience, Frame start, Frame final_end, Time now);
  /// Call it once per turn, before any step. `followers`: by index in the roster. `own_end`: the end of our inputs.
  Duty turn(const Roster& roster, std::span<const Follower> followers, Frame own_end, Time now);

  std::uint32_t term() const { return term_; }
  Frame start() const { return start_; }
  /// Inputs before this frame are final.
  Frame final_end() const { return final_end_; }
  bool is_backed() const { return is_backed_; }
  /// [us] A machine that heard us waits for us at least so long, by our clock.
  Time lease() const { return patience_ / 4 * 3; }
  /// Returns true if the next roster may replace this one: a majority has this roster and all final inputs, so whoever
  /// is elected by the next one knows them.
  bool may_go_on_to_next(const Roster& roster, std::uint64_t enrolled, std::span<const Follower> followers) const;

 private:
  std::uint64_t group_with(const Roster& roster, std::span<const Follower> followers, Frame end) const;

  std::uint32_t term_ = 0;
  Time patience_ = 0;
  Frame start_ = 0, final_end_ = 0;
  bool is_backed_ = true;
  Time backed_at_ = 0, turn_at_ = 0;  // [us]
};

}  // namespace isostep
