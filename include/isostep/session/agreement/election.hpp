// Election: how machines without a host find the next one. It knows no network: who came and what was said go in, whom
// to ask and who is elected come out. See AGREEMENT.md.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/roster.hpp"
#include "isostep/session/protocol/message.hpp"

namespace isostep {

/// Raft's candidate and voter. All machines have the same roster, so they ask the same machines in the same order, each
/// for a while: the lowest player first, the lost host last. A machine to which a majority has connected asks it for
/// support in a new term. A machine supports one candidate in a term, and none in an earlier one.
class Election {
 public:
  enum class Step : std::uint8_t {
    waits,
    goes_on,  // to the next machine: see target()
    calls,    // who has come is asked for its support, in term()
    wins,
    gives_up  // nobody is asked any more; but who comes may still make a majority
  };

  /// `knocks`: the host was heard until the connection ended, so it is asked first if it still lives.
  void begin(Time now, bool knocks);
  void end();
  bool is_under_way() const { return is_under_way_; }
  bool has_given_up() const { return has_given_up_; }
  /// The connection to the asked machine has ended: goes on to the next one soon.
  void was_turned_away(Time now);
  /// We were redirected: gives the other machine time to answer, and withdraws our own call.
  void was_sent_on(Time now);
  /// Returns the roster's index of the machine that is asked now. Our own: the others ask us. -1: nobody.
  int target(const Roster& roster, int own) const;

  // Machines connect to us; `voter` is their place in the roster.
  void came(int voter) { came_ |= bit(voter); }
  void went(int voter) { came_ &= ~bit(voter), supports_ &= ~bit(voter); }
  /// The machine came back without its memory, or has left: it has no vote.
  void is_over(int machine) { over_ |= bit(machine); }
  /// The indices have changed: all machines count as gone until they come again.
  void has_new_roster();
  /// Notes the term of a voter. A term that no election can have reached is ignored.
  void hear_term(std::uint32_t term) { heard_ = term > heard_ && can_be(term) ? term : heard_; }
  void supported(int voter, std::uint32_t term) {
    if (term == called_ && called_ != 0) supports_ |= bit(voter);
  }
  /// The game decides that the machines that are here are all.
  void force() { is_forced_ = true; }

  /// Call it once per turn. `own`: our index in the roster. `may_stand`: we are in the match, and our states are right.
  Step turn(const Roster& roster, int own, bool may_stand, Time now);

  /// The newest term to which we are bound, because we follow its host or support its candidate.
  std::uint32_t term() const { return promised_; }
  bool has_called() const { return called_ != 0; }
  Time called_at() const { return called_at_; }
  /// Returns true if a majority elected us. False: the game forced it, or nobody else remembers the match.
  bool has_majority(const Roster& roster) const { return roster.is_majority(won_with_); }
  /// Returns true if the voter elected us. It is bound to us even if its connection has ended since.
  bool has_won_with(int voter) const { return (won_with_ & bit(voter)) != 0; }
  std::uint64_t supporters() const { return won_with_; }

  /// Returns true if the candidate may be the host; then we are bound to its term.
  bool give_support(const Candidate& candidate);
  /// Returns true if we may follow a host of this term; false: the term is over.
  bool may_follow(std::uint32_t term) const { return term >= promised_ && can_be(term); }
  void follow(std::uint32_t term) { promised_ = term > promised_ ? term : promised_; }
  std::uint32_t log_term() const { return log_term_; }
  void has_log_of(std::uint32_t term) { log_term_ = term; }

 private:
  /// Returns true if the term is plausible: one far ahead would use up terms, and after the last nobody could call.
  bool can_be(std::uint32_t term) const {
    constexpr std::uint32_t kMostAhead = 1u << 16, kLast = 1u << 31;
    return term <= kLast && (promised_ == 0 || term <= promised_ + kMostAhead);
  }
  static std::uint64_t bit(int machine) { return machine < 0 ? 0 : std::uint64_t{1} << machine; }
  static bool is_eligible(const Roster& roster, int machine);
  Step go_on(const Roster& roster, int own, Time now);
  void withdraw() { called_ = 0, quorum_at_ = 0; }

  std::uint32_t promised_ = 0, log_term_ = 0, heard_ = 0;
  bool is_under_way_ = false, has_given_up_ = false, is_forced_ = false, knocks_ = false;
  Time since_ = 0, until_ = 0;  // [us] of all of it; of this attempt
  std::uint32_t attempt_ = 0;
  std::uint64_t came_ = 0, over_ = 0, supports_ = 0, won_with_ = 0;  // machines, a bit each
  Time quorum_at_ = 0;                                               // [us] when enough had come; 0: they have not
  std::uint32_t called_ = 0;                                         // the term for which we ask; 0: we do not
  Time called_at_ = 0;                                               // [us]
};

}  // namespace isostep
