// Wishes: what the players of a client ask the host and the others for: a pause, a speed, a vote.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/client/own_seats.hpp"
#include "isostep/session/peer/controls.hpp"
#include "isostep/session/protocol/message.hpp"
#include "isostep/session/protocol/outbox.hpp"

namespace isostep {

/// In: wishes. Out: messages to the host. Keeps: the last wish of each kind that the host has not been told.
class Wishes : public MatchControl {
 public:
  Wishes(const OwnSeats& own, const PeerLink& host, const Ballot& ballot) : own_(own), host_(host), ballot_(ballot) {}

  bool pause(bool on) override { return ask({on, 0}); }
  bool set_speed(int speed) override {
    return Tempo::is_speed(speed) && ask({false, static_cast<std::uint8_t>(speed)});
  }
  bool propose(int player, const Proposal& proposal) override {
    if (!may_speak(player) || !proposal.is_sound() || ballot_.is_open()) return false;
    proposal_ = {static_cast<std::uint8_t>(player), proposal};
    due_.add(MessageKind::propose);
    return true;
  }
  bool vote(int player, bool yes) override {
    const std::uint32_t bit = may_speak(player) ? 1u << player : 0;
    if (!ballot_.is_open() || (ballot_.voters & bit) == 0) return false;
    if (votes_.number != ballot_.number) votes_ = {ballot_.number, 0, 0};
    votes_.yes = yes ? votes_.yes | bit : votes_.yes & ~bit;
    votes_.no = yes ? votes_.no & ~bit : votes_.no | bit;
    due_.add(MessageKind::vote);
    return true;
  }
  /// The host or the connection has changed: drops what was asked, for nobody waits for it.
  void forget() {
    due_ = Outbox<MessageKind>{};
    votes_ = Votes{};
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
  bool may_speak(int player) const { return own_.is_open() && own_.has(player) && host_.is_connected; }
  bool ask(const Ask& ask) {
    if (!own_.is_open() || !host_.is_connected) return false;
    ask_ = ask;
    due_.add(MessageKind::ask);
    return true;
  }

  const OwnSeats& own_;
  const PeerLink& host_;
  const Ballot& ballot_;
  Outbox<MessageKind> due_;
  Ask ask_;
  PlayersProposal proposal_;
  Votes votes_;
};

}  // namespace isostep
