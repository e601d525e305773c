// RepairDesk: guests whose states are asked for, or who take a state of the host's again.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/repair.hpp"
#include "isostep/session/host/host_parts.hpp"
#include "isostep/session/host/inquiry.hpp"
#include "isostep/session/peer/machine_views.hpp"

namespace isostep {

/// In: the guests' reports on their states. Out: the stage of each repair, and who learns it. It keeps nothing: Guest,
/// Inquiry and MachineViews do.
class RepairDesk {
 public:
  RepairDesk(const HostParts& parts, Inquiry& inquiry, MachineViews& views, const std::vector<InputStream>& streams)
      : host_(parts), inquiry_(inquiry), views_(views), streams_(streams) {}
  /// Takes a guest's message. Returns false if it is malformed, or not allowed now.
  bool receive(Guest& guest, MessageKind kind, Bytes message);
  /// The guest has the whole snapshot.
  static void has_arrived(Guest& guest, Time now);

 private:
  bool take_repaired(Guest& guest, Bytes message);

  HostParts host_;
  Inquiry& inquiry_;
  MachineViews& views_;
  const std::vector<InputStream>& streams_;
};

}  // namespace isostep
