// Which inputs travel to a guest, what the host spends on who does not acknowledge, and when it puts it out.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/input_flow.hpp"

namespace isostep {
namespace {

/// [us] without anything new acknowledged, longer than a round trip and some losses in a row on any line on which one
/// plays: then less is sent.
constexpr Time kStalled = kSecond / 2;
constexpr std::uint64_t kStalledRate = 8000;  // [bytes/s] six full datagrams: enough to get it going again
constexpr Time kToRecover = kSecond;          // [us] in which who was silent for long must have acknowledged something

}  // namespace

Frame InputFlow::shown_until(const Guest& guest) const {
  Frame shown = kLastFrame + 1;
  if (config_.deadline == 0) return shown;
  // Players on one machine see the same picture. Who does not play may sit beside one who does.
  const bool plays = seats_.play(guest);
  for (int p = 0; p < config_.players; ++p) {
    if ((!plays || guest.has(p)) && end(p) < shown) shown = end(p);
  }
  return shown;
}

Frame InputFlow::until(int player, const Guest& guest) const {
  if (guest.has(player)) return seats_[player].is_open ? seats_[player].replaced_end : end(player);
  const Frame shown = shown_until(guest);
  return shown < end(player) ? shown : end(player);
}

void InputFlow::note_held_back(Guest& guest, Frame current) const {
  const Frame shown = shown_until(guest);
  for (int p = 0; p < config_.players; ++p) {
    if (shown < end(p)) guest.held_back_until[p] = current + InputDelay::kSettling;
  }
}

bool InputFlow::lacks_inputs(const Guest& guest) const {
  for (int p = 0; p < config_.players; ++p) {
    if (guest.acked[p] < until(p, guest)) return true;
  }
  return false;
}

bool InputFlow::acknowledges(const Guest& guest, Time now) const {
  const Time last = guest.acked_at > guest.had_all_at ? guest.acked_at : guest.had_all_at;
  return now - last <= kStalled;
}

bool InputFlow::tend(Guest& guest, Time now) const {
  const bool lacks = lacks_inputs(guest);
  if (!lacks) guest.had_all_at = now;
  bool owes = lacks && guest.is_unproven();
  for (int p = 0; p < config_.players; ++p) owes = owes || (until(p, guest) > 0 && guest.acked[p] < guest.owes[p]);
  if (!owes) {
    guest.owes_since = now;
    // A second of the match: who needs the whole silence for that falls behind for ever. Who steps slowly may.
    for (int p = 0; p < config_.players; ++p) {
      const Frame second = guest.acked[p] + config_.hz;
      guest.owes[p] = guest.burst_end[p] < second ? guest.burst_end[p] : second;
    }
  }
  // After a pause of its own, or of its line, it has what was sent before, and must be given the time to say so.
  const bool is_back = !guest.is_unproven() && guest.back_at != 0 && now - guest.back_at <= kToRecover;
  return now - guest.owes_since <= config_.silence || is_back;
}

Frame InputFlow::most_frames(const Guest& guest, Time now) const {
  if (guest.is_unproven() && lacks_inputs(guest)) return guest.has_spoken && now >= guest.more_at ? 1 : 0;
  const bool is_far_behind = guest.player < 0 && guest.has_more;
  if (is_far_behind && guest.continues_burst(now)) return guest.takes_bursts ? kSliceFrames : 0;
  const bool is_free = acknowledges(guest, now) && (!is_far_behind || has_first(guest));
  return is_free || now >= guest.more_at ? kSliceFrames : 0;
}

bool InputFlow::has_first(const Guest& guest) const {
  for (int p = 0; p < config_.players; ++p) {
    if (until(p, guest) > 0 && guest.acked[p] < guest.first_end[p]) return false;
  }
  return true;
}

void InputFlow::was_sent(Guest& guest, std::size_t bytes, Time now) const {
  if (guest.is_unproven()) {
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
  for (int p = 0; p < config_.players; ++p) guest.first_end[p] = guest.burst_end[p];
  guest.more_at = now + bytes * kSecond / kStalledRate;
}

}  // namespace isostep
