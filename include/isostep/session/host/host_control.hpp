// HostControl: pauses, speeds and votes at the host: what its game and the players on all machines ask for.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/admission.hpp"
#include "isostep/session/host/ballot_box.hpp"
#include "isostep/session/host/tempo_desk.hpp"
#include "isostep/session/peer/controls.hpp"

namespace isostep {

/// In: wishes and votes of this machine and of guests. Out: the tempo to announce, the vote as it stands, and the
/// effects of a vote that passed. Keeps: the two desks.
class HostControl : public MatchControl {
 public:
  /// `announced`: the newest announced tempo.
  HostControl(const HostParts& parts, Ballot& ballot, const Tempo& announced, Admission& admission)
      : host_(parts),
        ballot_(ballot),
        admission_(admission),
        ballot_box_(parts.config, parts.seats, ballot),
        tempo_desk_(parts.config, announced) {}

  bool pause(bool on) override { return host_.has_begun && tempo_desk_.wish_pause(on, 0xff); }
  bool set_speed(int speed) override { return host_.has_begun && tempo_desk_.wish_speed(speed, 0xff); }
  bool propose(int player, const Proposal& proposal) override;
  bool vote(int player, bool yes) override;

  /// Takes a guest's message. Returns false if it is malformed, or not allowed now.
  bool receive(Guest& guest, MessageKind kind, Bytes message);
  /// Answers a guest's requests, once a second.
  void answer_asks(Guest& guest, Time now);
  void tend(Time now);
  TempoDesk& tempo_desk() { return tempo_desk_; }

 private:
  void answer(std::uint8_t player, const Ask& ask);
  /// Carries out what has passed. Returns false if the vote or proposal was refused.
  bool voted(BallotBox::Effect effect);

  HostParts host_;
  Ballot& ballot_;
  Admission& admission_;
  BallotBox ballot_box_;
  TempoDesk tempo_desk_;
};

}  // namespace isostep
