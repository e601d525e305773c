// The host's deadline: inputs that come too late are replaced, and who waits to see what others do waits in vain.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"

namespace isostep {

namespace {

constexpr Time kTellReplaced = kSecond;  // [us] between two words on one player's inputs
constexpr Time kIsHeard = kSecond / 5;   // [us] since its last word: its line is there, and slow

}  // namespace

void HostCore::replace_late(Time now) {
  if (config_.deadline == 0 || now < due_from_ || !leadership_.tenure().is_backed()) return;
  const Frame due = current() + (is_blocked_ ? clock_.overdue(now) : 0);
  // Of a player of whom one input was replaced and nothing came since the next is waited for as long as nobody stands:
  // what a rollback affords in every frame.
  const Frame patient = window() / 2 < config_.deadline ? window() / 2 : config_.deadline;
  for (int p = 0; p < players(); ++p) {
    if (is_local(p)) continue;
    Seat& seat = seats_[p];
    InputStream& stream = streams_[static_cast<std::size_t>(p)];
    while (seat.is_open && due - stream.end() >= (seat.is_late ? patient : config_.deadline)) replace_next(p, due, now);
    tell_replaced(p, now);
  }
}

void HostCore::replace_next(int player, Frame due, Time now) {
  Seat& seat = seats_[player];
  InputStream& stream = streams_[static_cast<std::size_t>(player)];
  std::uint8_t buffer[kInputCap];
  slack_[player].add(stream.end() - due < -127 ? -127 : stream.end() - due);
  if (seat.replaced_end == 0) seat.replaced = stream.end();
  stream.append({false, guess_next(stream, buffer)});
  seat.replaced_end = stream.end();
  seat.is_late = true;
  ++stats_.players[player].replaced;
  // Who is there and whose inputs do not count watches, as who holds all up; who is silent may come back.
  Guest& guest = *guest_of(player);
  if (now - began_ < kFreeStart || now - guest.heard > kIsHeard) return;
  seat.replaced_for.spend(clock_.period(), now);
  if (seat.replaced_for.spent(now) >= config_.patience) seats_.leave_out(guest, now);
}

void HostCore::tell_replaced(int player, Time now) {
  Seat& seat = seats_[player];
  const std::uint32_t count = stats_.players[player].replaced;
  if (count == seat.replaced_told || now < seat.tells_replaced_at) return;
  seat.replaced_told = count;
  seat.tells_replaced_at = now + kTellReplaced;
  tell_of(SessionEvent::Kind::replaced, player);
}

void HostCore::note_replaced(const InputSlice& slice, Time now) {
  Seat& seat = seats_[slice.player];
  const Frame end = slice.first + slice.count;
  if (!seat.is_late || end <= seat.late_end) return;
  seat.late_end = end;
  note_arrival(slice.player, end, now);
}

Frame HostCore::shown_until(const Guest& guest) const {
  if (config_.deadline == 0) return kLastFrame + 1;
  // Who does not play may sit beside one who does.
  if (!seats_.play(guest)) return known_end();
  Frame shown = kLastFrame + 1;  // players on one machine see the same picture
  for (int p = 0; p < players(); ++p) {
    const Frame end = streams_[static_cast<std::size_t>(p)].end();
    if (guest.has(p) && end < shown) shown = end;
  }
  return shown;
}

void HostCore::note_held_back(Guest& guest) {
  for (int p = 0; p < players(); ++p) {
    if (shown_until(guest) < streams_[static_cast<std::size_t>(p)].end()) guest.held_back[p] = current();
  }
}

bool HostCore::was_held_back(const Guest& guest, int player) const {
  return guest.held_back[player] != kNoFrame && current() - guest.held_back[player] < InputDelay::kSettling;
}

Frame HostCore::told_slack(const Guest& guest, int player) const {
  const Frame slack = slack_of(player), here = slack_[player].value();
  if (config_.deadline == 0 || here == RecentLeast::kNothing) return slack;
  // What others do in a frame is sent when its own input is here: that has to come earlier by the way back. The others'
  // words on it are of what came to them.
  const Frame back = here - static_cast<Frame>(guest.round_trip / 2 / clock_.period()) - 1;
  const Frame told = back < slack ? back : slack;
  return told < -127 ? -127 : told;
}

}  // namespace isostep
