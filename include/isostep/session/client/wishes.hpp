// Wishes: what the players of a client ask the host and the others for: a pause, a speed, a vote.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/ballot.hpp"
#include "isostep/session/protocol/message.hpp"
#include "isostep/session/protocol/outbox.hpp"

namespace isostep {

/// In: wishes. Out: messages to the host. Keeps: of each kind the last that it has not been told.
class Wishes {
 public:
  void ask(const Ask& ask) {
    ask_ = ask;
    due_.add(MessageKind::ask);
  }
  void propose(const PlayersProposal& proposal) {
    proposal_ = proposal;
    due_.add(MessageKind::propose);
  }
  /// False: the player has no vote.
  bool vote(const Ballot& ballot, int player, bool yes) {
    const std::uint32_t own = 1u << player;
    if (!ballot.is_open() || (ballot.voters & own) == 0) return false;
    if (votes_.number != ballot.number) votes_ = {ballot.number, 0, 0};
    votes_.yes = yes ? votes_.yes | own : votes_.yes & ~own;
    votes_.no = yes ? votes_.no & ~own : votes_.no | own;
    due_.add(MessageKind::vote);
    return true;
  }
  bool write_next(std::vector<std::uint8_t>& message) {
    if (due_.take(MessageKind::propose)) {
      write_proposal(proposal_, message);
    } else if (due_.take(MessageKind::vote)) {
      write_votes(votes_, message);
      votes_ = Votes{};
    } else if (due_.take(MessageKind::ask)) {
      write_ask(ask_, message);
    } else {
      return false;
    }
    return true;
  }

 private:
  Outbox<MessageKind> due_;
  Ask ask_;
  PlayersProposal proposal_;
  Votes votes_;
};

}  // namespace isostep
