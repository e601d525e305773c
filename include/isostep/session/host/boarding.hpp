// Boarding: how a guest comes into the match: from which state, and from which frame on its players play.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/host/host_parts.hpp"
#include "isostep/session/host/input_flow.hpp"
#include "isostep/session/host/inquiry.hpp"
#include "isostep/session/pace/frame_clock.hpp"
#include "isostep/session/peer/machine_views.hpp"
#include "isostep/session/timeline/hash_log.hpp"

namespace isostep {

/// In: guests that are let in, have their snapshot, or may play. Out: the stage of each, and absent inputs until its
/// players play. It keeps nothing: Guest and Seats do.
class Boarding {
 public:
  Boarding(const HostParts& parts, const InputFlow& flow, const HashLog& hashes, std::vector<InputStream>& streams,
           const FrameClock& clock, const Roster& roster, const Ballot& ballot)
      : host_(parts),
        flow_(flow),
        hashes_(hashes),
        streams_(streams),
        clock_(clock),
        roster_(roster),
        ballot_(ballot) {}
  /// Lets the guest go on from the state that it has, or marks that it needs a snapshot.
  void enter(Guest& guest) const;
  void go_live(Guest& guest, Frame start) const;
  /// Opens the seats of a guest that has caught up and asked to play.
  void open_seats(Guest& guest, Time now) const;

 private:
  bool has_inputs_since(const HashReport& state) const;

  HostParts host_;
  const InputFlow& flow_;
  const HashLog& hashes_;
  std::vector<InputStream>& streams_;
  const FrameClock& clock_;
  const Roster& roster_;
  const Ballot& ballot_;
};

/// In: guests that go. Out: their seats are vacated, and what they said of their states is forgotten.
class Departures {
 public:
  Departures(Seats& seats, Inquiry& inquiry, MachineViews& views) : seats_(seats), inquiry_(inquiry), views_(views) {}
  void unseat(Guest& guest) {
    for (const int p : EachPlayer(guest.players)) {
      views_.was_repaired(static_cast<std::size_t>(p), kNoFrame);
      inquiry_.forget(p);
    }
    seats_.leave(guest);
  }
  /// Ignores the guest from now on, tells it why, and ends its connection.
  void send_away(Guest& guest, const Refusal& refusal) {
    unseat(guest);
    guest.stage = Guest::Stage::refused;
    guest.repair = RepairService{};
    guest.refusal = refusal;
  }

 private:
  Seats& seats_;
  Inquiry& inquiry_;
  MachineViews& views_;
};

}  // namespace isostep
