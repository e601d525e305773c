// Comparison: what the host asks and tells of states, and whether ours are to be repaired.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/client/client_parts.hpp"
#include "isostep/session/client/repair.hpp"
#include "isostep/session/peer/machine_views.hpp"

namespace isostep {

/// In: the host's questions, verdicts and offers. Out: events, and a Repair that begins or goes on. It keeps nothing:
/// Repair and MachineViews do.
class Comparison {
 public:
  Comparison(const ClientParts& parts, const HashLog& hashes, MachineViews& views, Repair& repair)
      : client_(parts), hashes_(hashes), views_(views), repair_(repair) {}
  /// Takes a message of the host. Returns false if it is of another kind, or invalid.
  bool receive(MessageKind kind, Bytes bytes);
  /// See Session.
  bool resync();

 private:
  bool take_statements(const Statements& statements);
  bool take_offer(const RepairOffer& offer);
  bool take_repaired(const Repaired& repaired);

  ClientParts client_;
  const HashLog& hashes_;
  MachineViews& views_;
  Repair& repair_;
};

}  // namespace isostep
