// The host replaces inputs that come too late, and leaves out whose time is spent.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/deadline.hpp"

namespace isostep {
namespace {

constexpr Time kTellReplaced = kSecond;   // [us] between two words on one player's inputs
constexpr Time kIsHeard = kSecond / 5;    // [us] since its last word: its line is there, and slow
constexpr Time kFreeStart = 5 * kSecond;  // [us] of a match, in which delays find out how long the lines are

}  // namespace

bool Deadline::is_over(int player, Frame due, Frame window) const {
  const Seat& seat = seats_[player];
  const Frame patient = window / 2 < config_.deadline ? window / 2 : config_.deadline;
  const Frame late = due - streams_[static_cast<std::size_t>(player)].end();
  return seat.is_open && late >= (seat.is_late ? patient : config_.deadline);
}

void Deadline::replace(int player, Bytes guess, Frame due, Time now) {
  Seat& seat = seats_[player];
  InputStream& stream = streams_[static_cast<std::size_t>(player)];
  slack_[player].add(stream.end() - due < -127 ? -127 : stream.end() - due);
  if (seat.replaced_end == 0) seat.replaced = stream.end();
  stream.append({false, guess});
  seat.replaced_end = stream.end();
  seat.is_late = true;
  ++stats_.players[player].replaced;
  // Who is there and whose inputs do not count watches, as who holds all up; who is silent may come back.
  const Guest& guest = guests_[static_cast<std::size_t>(seat.link)];
  if (now - began_ < kFreeStart || now - guest.heard > kIsHeard) return;
  seat.replaced_for.spend(clock_.period(), now);
  if (seat.replaced_for.spent(now) >= config_.patience) seats_.leave_out(guest, now);
}

bool Deadline::must_tell(int player, Time now) {
  Seat& seat = seats_[player];
  const std::uint32_t count = stats_.players[player].replaced;
  if (count == seat.replaced_told || now < seat.tells_replaced_at) return false;
  seat.replaced_told = count;
  seat.tells_replaced_at = now + kTellReplaced;
  return true;
}

bool Deadline::is_news(int player, Frame end) {
  Seat& seat = seats_[player];
  if (!seat.is_late || end <= seat.late_end) return false;
  seat.late_end = end;
  return true;
}

bool Deadline::stands(Time now, Time worth_telling) {
  if (blocked_since_ == 0) blocked_since_ = charged_at_ = now;
  return now - blocked_since_ >= worth_telling;
}

void Deadline::charge(Frame current, bool may_leave_out, Time now) {
  const Time passed = now - charged_at_;
  charged_at_ = now;
  if (now - began_ < kFreeStart || !may_leave_out) return;
  for (int p = 0; p < config_.players; ++p) {
    Seat& seat = seats_[p];
    if (seats_.is_local(p) || !seat.is_open || streams_[static_cast<std::size_t>(p)].end() > current) continue;
    seat.lost.spend(passed, now);  // each in full: several who are silent at once cost the time of one
    if (seat.lost.spent(now) < config_.patience) continue;
    seats_.leave_out(guests_[static_cast<std::size_t>(seat.link)], now);
  }
}

}  // namespace isostep
