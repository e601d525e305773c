// Admission: whom a host lets in and sends away, and what its game has to say in that.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/boarding.hpp"
#include "isostep/session/host/leadership.hpp"
#include "isostep/session/peer/controls.hpp"

namespace isostep {

/// In: hellos, and the game's decisions. Out: guests that are seated, boarded or refused, and refusals as events.
/// Keeps: the number of applicants, and until when refusals are reported.
class Admission : public AdmissionControl {
 public:
  /// `resumed`: the state from which a saved match goes on; kNoFrame: there is none.
  Admission(const HostParts& parts, SecretNumbers& numbers, Leadership& leadership, const HashLog& hashes,
            const HashReport& resumed, const Boarding& boarding, Departures& departures)
      : host_(parts),
        numbers_(numbers),
        leadership_(leadership),
        hashes_(hashes),
        resumed_(resumed),
        boarding_(boarding),
        departures_(departures) {}

  std::optional<Applicant> poll_applicant() override;
  bool admit(std::uint64_t applicant) override;
  bool refuse(std::uint64_t applicant, std::string_view reason) override;
  bool kick(int player, std::string_view reason) override;
  bool kick_peer(PeerId peer, std::string_view reason) override;
  std::optional<PeerId> peer_of(int player) const override;

  void greet(Guest& guest, Bytes message);
  void refuse(Guest& guest, const Refusal& refusal);

 private:
  /// Returns why the client cannot take part at all. Its key is empty if it can.
  Refusal mismatch_of(const Hello& hello) const;
  /// Lets the guest in, as a spectator or to a seat. If there is no room, refuses it and returns false.
  bool let_in(Guest& guest);
  void seat(Guest& guest, std::uint32_t wanted);

  HostParts host_;
  SecretNumbers& numbers_;
  Leadership& leadership_;
  const HashLog& hashes_;
  const HashReport& resumed_;
  const Boarding& boarding_;
  Departures& departures_;
  std::uint32_t applicants_ = 0;  // how many there were in this term
  Time refusals_until_ = 0;       // [us] when all those are over that were told, at one a second
};

}  // namespace isostep
