// AdmissionControl: what a host's game decides about who plays.
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

#include "isostep/session/peer/applicant.hpp"

namespace isostep {

/// See Session, where the functions have the same names.
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

}  // namespace isostep
