// AdmissionControl and MatchControl: what the game decides about players, and what players ask for.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

#include "isostep/session/agreement/ballot.hpp"
#include "isostep/session/peer/applicant.hpp"

namespace isostep {

/// The decisions of a host's game about who plays. Session has functions of the same names.
class AdmissionControl {
 public:
  virtual ~AdmissionControl() = default;
  virtual std::optional<Applicant> poll_applicant() = 0;
  virtual bool admit(std::uint64_t applicant) = 0;
  virtual bool refuse(std::uint64_t applicant, std::string_view reason) = 0;
  virtual bool kick(int player, std::string_view reason) = 0;
  virtual bool kick_peer(PeerId peer, std::string_view reason) = 0;
  virtual std::optional<PeerId> peer_of(int player) const = 0;
};

/// The requests of the players of a machine while they play. Session has the same functions.
class MatchControl {
 public:
  virtual ~MatchControl() = default;
  virtual bool pause(bool on) = 0;
  virtual bool set_speed(int speed) = 0;
  virtual bool propose(int player, const Proposal& proposal) = 0;
  virtual bool vote(int player, bool yes) = 0;
};

}  // namespace isostep
