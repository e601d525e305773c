// A client that would follow its host: what its supporters tell it.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_core.hpp"

namespace isostep {

bool ClientCore::take_support(Caller& caller, MessageKind kind, Bytes bytes, Time now) {
  if (kind == MessageKind::known) {
    const Result<Packet> packet = read_known(bytes);
    if (!packet) return false;
    bool is_good = true;
    for (std::uint8_t i = 0; i < packet.value().slice_count; ++i) {
      is_good = take_known(packet.value().slices[i], caller.machine) && is_good;
    }
    return is_good;
  }
  if (kind == MessageKind::support) {
    const Result<Support> support = read_support(bytes);
    if (!support) return false;
    for (int p = 0; p < players(); ++p) {
      if (streams_[static_cast<std::size_t>(p)].end() < support.value().ends[p]) return false;
    }
    if (caller.voter >= 0) failover_.election.supported(caller.voter, support.value().term);
    return true;
  }
  if (kind == MessageKind::redirect) {
    const Result<Address> address = read_redirect(bytes);
    if (!address || address.value().view().empty()) return false;
    yield_to(caller, address.value(), now);
    return true;
  }
  if (kind != MessageKind::roster) return false;
  // A newer one: whose place is where, and what a majority is, may be otherwise there.
  const Result<Roster> roster = read_roster(bytes);
  if (!roster || !roster.value().is_newer_than(failover_.roster)) return roster.ok();
  if (!is_sealed_for(roster.value(), token_, message_)) {
    // This machine does not support us, whether its roster is true or not.
    if (caller.voter >= 0) failover_.election.went(caller.voter);
    return false;
  }
  failover_.roster = roster.value();
  has_new_roster();
  return true;
}

void ClientCore::yield_to(const Caller& caller, const Address& address, Time now) {
  failover_.better = address;
  for (Caller& other : failover_.callers) other.must_redirect = other.is_connected && &other != &caller;
  go_to(address, now);
}

bool ClientCore::take_known(const InputSlice& slice, int machine) {
  if (slice.player >= players()) return false;
  InputStream& stream = streams_[slice.player];
  if (slice.first > stream.end()) return true;  // what is missing before it did not arrive: see write_missing
  const bool is_own = is_local(slice.player);
  const bool is_its = owns_inputs() && (failover_.roster.machines[machine].players >> slice.player & 1) != 0;
  // A host steps no frame without its inputs, and clients are ahead of it by their delay and guesses; it has lived
  // without us for as long as we waited.
  const Frame waited = static_cast<Frame>(config_.migration / clock_.period());
  const Frame most = present() + waited + 2 * config_.most_delay + config_.window;
  Frame& told = failover_.told[slice.player];
  SliceReader reader(slice);
  InputEntry entry;
  for (Frame frame = slice.first; reader.next(entry); ++frame) {
    if (frame >= most || (!entry.absent && !rules_.valid(entry.bytes))) return false;
    // Others know better than we where the host went on without us.
    if (is_own && is_open_ && frame == accepted_[slice.player] && (!owns_inputs() || entry.absent)) {
      take_own(slice.player, entry);
    }
    if (is_own && is_open_) continue;
    if (frame == stream.end()) {
      stream.append(entry);
    } else if (is_its && frame >= failover_.ends[slice.player] && stream.contains(frame)) {
      stream.replace(frame, entry);
      timeline_.recheck(slice.player, frame);
    }
    if (is_its && frame >= told) told = frame + 1;
  }
  return !reader.failed();
}

void ClientCore::forget_untold() {
  if (!owns_inputs()) return;
  for (const Caller& caller : failover_.callers) {
    if (!caller.is_connected || !failover_.election.has_won_with(caller.voter)) continue;
    for (int p = 0; p < players(); ++p) {
      InputStream& stream = streams_[static_cast<std::size_t>(p)];
      const bool is_its = (failover_.roster.machines[caller.machine].players >> p & 1) != 0;
      if (!is_its || stream.end() <= failover_.told[p]) continue;
      stream.truncate(failover_.told[p]);
      timeline_.recheck(p, failover_.told[p]);
    }
  }
}

}  // namespace isostep
