// Leadership: the host as Raft's leader: its roster, which machines of it follow, and whether it still is the host.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/failover.hpp"
#include "isostep/session/agreement/tenure.hpp"
#include "isostep/session/host/guests.hpp"
#include "isostep/session/host/seats.hpp"
#include "isostep/session/peer/session_core.hpp"
#include "isostep/session/timeline/input_stream.hpp"

namespace isostep {

/// In: guests and seats, as they are in a turn. Out: rosters for the guests, and whether we go on as the host. Groups
/// of machines are a bit for each index in the roster. See AGREEMENT.md.
class Leadership {
 public:
  static constexpr std::uint32_t kFirstTerm = 1;  // of a match that begins

  /// Overwrites `scratch`, and updates stats.machines.
  Leadership(const SessionConfig& config, Seats& seats, Guests& guests, const std::vector<InputStream>& streams,
             SessionStats& stats, std::vector<std::uint8_t>& scratch)
      : config_(config), seats_(seats), guests_(guests), streams_(streams), stats_(stats), scratch_(scratch) {}
  /// `token`: our players come back with it to the next host. `life`: the number of our process.
  void know_ourselves(std::uint64_t token, std::uint64_t life) { own_token_ = token, own_life_ = life; }
  /// Sets the first term of a saved match, which has had other hosts.
  void resume(std::uint32_t term) { first_term_ = term; }
  void begin(Frame final_end, Time now) { tenure_.begin(first_term_, config_.migration, 0, final_end, now); }
  /// Takes over as the elected host. The guests that have connected to us come after that.
  void take_over(const Succession& succession, Frame known_end, Frame final_end, Time now);
  void reform_with(const Election& election);

  /// Call it first in a turn. `known_end`: the end of the inputs that we have. False: we are no longer the host.
  bool turn(Frame known_end, Time now);
  /// Replaces the roster by the next one, once a majority has this one.
  void keep_roster();
  /// Goes on without the machines that are not here, although they may go on without us.
  bool go_on(Time now);
  /// Hears from a guest whether there is a host after us.
  void hear(const Application& wish);
  /// Returns true if it was let in by the host before us.
  bool is_member(const Application& wish) const { return inherited_.voter_of(wish.token, wish.life) >= 0; }
  /// Returns true if the others can go on without us, at a machine that is not in `unfit` (bits as in a Verdict).
  bool could_others(std::uint64_t unfit) const;
  /// Returns what the client takes over that this host becomes.
  Retreat retreat(bool is_outvoted) const;

  const Roster& roster() const { return roster_; }
  const Tenure& tenure() const { return tenure_; }
  std::uint32_t term() const { return has_begun() ? tenure_.term() : first_term_; }
  std::uint64_t own_token() const { return own_token_; }

 private:
  bool has_begun() const { return tenure_.term() != 0; }
  Roster drafted() const;
  void replace(const Roster& next);
  /// Makes the machines that are with us the whole match from now on.
  void reform(std::uint64_t group);
  /// The guest's index in the roster, as a voter; -1: it has no vote.
  int voter_of(const Guest& guest) const;
  /// The guest has all inputs before this frame.
  Frame end_at(const Guest& guest) const;
  /// Fills followers_ for each machine of the roster.
  void look_at_followers(Time now);
  /// We, and the voters for which `is_counted` is true.
  template <class Predicate> std::uint64_t group(const Predicate& is_counted) const;
  std::uint64_t here(Time now) const;

  const SessionConfig& config_;
  Seats& seats_;
  Guests& guests_;
  const std::vector<InputStream>& streams_;
  SessionStats& stats_;
  std::vector<std::uint8_t>& scratch_;
  Roster roster_;
  Roster inherited_;  // that we took over
  std::uint64_t own_token_ = 0, own_life_ = 0;
  std::uint32_t first_term_ = kFirstTerm;
  Tenure tenure_;
  Follower followers_[kMaxPlayers + 1];  // by their places in the roster
  bool is_over_ = false;                 // somebody knows of a later host
};

}  // namespace isostep
