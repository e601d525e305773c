// RepairDesk: guests whose states are asked for, or who take a state of the host's again.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/agreement/repair.hpp"
#include "isostep/session/host/host_parts.hpp"
#include "isostep/session/host/inquiry.hpp"
#include "isostep/session/peer/machine_views.hpp"

namespace isostep {

/// In: what guests say of their states. Out: the stage of each repair, and who is told of it. It keeps nothing: that
/// stands in Guest, in the Inquiry and in MachineViews.
class RepairDesk {
 public:
  RepairDesk(const HostParts& parts, Inquiry& inquiry, MachineViews& views, const std::vector<InputStream>& streams)
      : host_(parts), inquiry_(inquiry), views_(views), streams_(streams) {}
  /// False: it is malformed, or not to be said now.
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
