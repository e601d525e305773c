// What the host spends on who does not acknowledge, and when it puts it out.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

/// [us] without anything new acknowledged, longer than a round trip and some losses in a row on any line on which one
/// plays: then less is sent.
constexpr Time kStalled = kSecond / 2;
constexpr std::uint64_t kStalledRate = 8000;  // [bytes/s] six full datagrams: enough to get it going again
constexpr Time kToRecover = kSecond;          // [us] in which who was silent for long must have acknowledged something

}  // namespace

bool HostCore::lacks_inputs(const Guest& guest) const {
  for (int p = 0; p < players(); ++p) {
    if (guest.acked[p] < sends_until(p, guest)) return true;
  }
  return false;
}

bool HostCore::acknowledges(const Guest& guest, Time now) const {
  const Time last = guest.acked_at > guest.had_all_at ? guest.acked_at : guest.had_all_at;
  return now - last <= kStalled;
}

void HostCore::judge_acknowledgements(Guest& guest, Time now) {
  if (!guest.is_live()) return;
  const bool lacks = lacks_inputs(guest);
  if (!lacks) guest.had_all_at = now;
  bool is_due = lacks && is_unproven(guest);
  for (int p = 0; p < players(); ++p) is_due = is_due || (sends(p, guest) && guest.acked[p] < guest.owes[p]);
  if (!is_due) {
    guest.owes_since = now;
    // A second of the match: who needs the whole silence for that falls behind for ever. Who steps slowly may.
    for (int p = 0; p < players(); ++p) {
      const Frame second = guest.acked[p] + config_.hz;
      guest.owes[p] = guest.burst_end[p] < second ? guest.burst_end[p] : second;
    }
  }
  // After a pause of its own, or of its line, it has what was sent before, and must be given the time to say so.
  const bool is_back = !is_unproven(guest) && guest.back_at != 0 && now - guest.back_at <= kToRecover;
  if (now - guest.owes_since <= config_.silence || is_back) return;
  ++stats_.put_out;
  guest.due.set(Due::close);
  seats_.close(guest);
}

Frame HostCore::most_frames(const Guest& guest, Time now) const {
  if (is_unproven(guest) && lacks_inputs(guest)) return guest.has_spoken && now >= guest.more_at ? 1 : 0;
  const bool is_far_behind = guest.player < 0 && guest.has_more;
  if (is_far_behind && guest.continues_burst(now)) return guest.takes_bursts ? kSliceFrames : 0;
  const bool is_free = acknowledges(guest, now) && (!is_far_behind || has_first(guest));
  return is_free || now >= guest.more_at ? kSliceFrames : 0;
}

bool HostCore::has_first(const Guest& guest) const {
  for (int p = 0; p < players(); ++p) {
    if (sends(p, guest) && guest.acked[p] < guest.first_end[p]) return false;
  }
  return true;
}

void HostCore::was_sent(Guest& guest, std::size_t bytes, Time now) {
  if (is_unproven(guest)) {
    if (!lacks_inputs(guest)) return;
    guest.more_at = now + guest.probe_every;
    // Twice within the silence at least: one may be lost.
    const Time twice = 2 * guest.probe_every;
    guest.probe_every = twice < config_.silence / 2 ? twice : config_.silence / 2;
    return;
  }
  guest.probe_every = Guest::kFirstProbe;
  if (guest.burst > 1) return;
  guest.takes_bursts = has_first(guest);
  for (int p = 0; p < players(); ++p) guest.first_end[p] = guest.burst_end[p];
  guest.more_at = now + bytes * kSecond / kStalledRate;
}

}  // namespace isostep
