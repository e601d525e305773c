// The host as judge of time: whose fault a late input is, whose line is worse, and how fast all go.
// SPDX-License-Identifier: MIT
#include "isostep/core/stable_sort.hpp"
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

constexpr Frame kLateBeyond = 2;        // [frames] that an input is late beyond its way: two losses, or jitter
constexpr Frame kLateWhenSlow = 3;      // [frames] while a machine is at its limit, and sends less evenly
constexpr Frame kMostSpread = 8;        // [frames] more, of who comes in bursts itself
constexpr int kCatchingUp = 16;         // [1/256 period] that a client adds to what it needs
constexpr int kAsSlow = 8;              // [1/256 period] by which machines differ that are as slow
constexpr Time kTooSlow = 2 * kSecond;  // [us] at less than the least pace, until a player watches
constexpr Time kTooFar = 2 * kSecond;   // [us] on a line that no delay covers, likewise
constexpr Time kAsGood = 2;             // [frames] by which round trips differ on lines that are as good

/// [frames] by which half of a round trip is longer when all go at full speed again: what comes in time in a match that
/// is slow for its rollbacks comes late, and makes it slow, once it is not.
Frame lengthened(Time round_trip, const FrameClock& clock) {
  if (clock.period() == clock.nominal()) return 0;
  const Time way = round_trip / 2;
  return static_cast<Frame>((way + clock.nominal() - 1) / clock.nominal() - way / clock.period());
}

}  // namespace

void HostCore::paused(Time now) {
  // What passes through us was late for everybody, whoever said it.
  reports_from_ = now + InputDelay::kSettling * clock_.period();
  due_from_ = now + static_cast<Time>(config_.deadline) * clock_.period();
  forgive_own_pause(now);
}

Time HostCore::judge_farthest() const {
  // The middle one of all lines: the better half of the players does not wait for the worse.
  Time trips[kMaxPlayers] = {};
  std::uint32_t count = 0;
  for (const Guest& guest : guests_) {
    if (seats_.play(guest)) trips[count++] = guest.round_trip;
  }
  if (count == 0) return 0;
  insertion_sort(trips, count, OwnKey{});
  return trips[(count - 1) / 2] + kAsGood * clock_.period();
}

void HostCore::judge_lines(Time now) {
  farthest_ = judge_farthest();
  for (Guest& guest : guests_) {
    // A period less on the way back, so that jitter does not change it again and again.
    guest.is_far = seats_.play(guest) && guest.round_trip > farthest_ - (guest.is_far ? clock_.period() : 0);
    judge_distance(guest, now);
  }
}

void HostCore::judge_distance(Guest& guest, Time now) {
  const bool is_covered = guest.is_too_far ? !is_still_beyond(guest.round_trip) : !is_beyond(guest.round_trip);
  if (is_covered || guest.player < 0) {
    guest.covered_at = now;
    guest.is_too_far = false;
  }
  if (guest.is_too_far || now - guest.covered_at < kTooFar) return;
  guest.is_too_far = true;
  seats_.close(guest);
  tell_of(SessionEvent::Kind::too_far, guest.player);
}

Frame HostCore::slack_of(int player) const {
  const Frame here = is_local(player) ? delay_.frames() + 1 : slack_[player].value();
  const bool is_known = here != RecentLeast::kNothing;
  const Guest* const its = guest_of(player);
  const Frame longer = its == nullptr ? 0 : lengthened(its->round_trip, clock_);
  const Frame spared = thrift_.frames() > 0 ? thrift_.frames() + longer : 0;
  Frame least = is_local(player) ? RecentLeast::kNothing : is_known ? here - spared : here;
  if (!is_known || !reports_count_) return least;
  const Time farthest = farthest_that_counts();
  const Frame beyond = stats_.stretch > 0 ? kLateWhenSlow : kLateBeyond;
  for (const Guest& guest : guests_) {
    if (!seats_.play(guest) || guest.has(player) || (guest.reported_mask >> player & 1) == 0) continue;
    if (was_held_back(guest, player) || guest.slack[player] == RecentLeast::kNothing) continue;
    // What was early here is not later there than the way explains and lines that lose as much as its own do, whatever
    // is said.
    const Time trip = guest.round_trip < farthest ? guest.round_trip : farthest;
    const Frame way = static_cast<Frame>(trip / 2 / clock_.period());
    const Frame spread = guest.is_far ? 0 : slack_[guest.player].spread();
    const Frame plausible = here - way - beyond - (spread < kMostSpread ? spread : kMostSpread);
    // Who has no time for rollbacks needs inputs earlier than it says that they come.
    const Frame spares = guest.spares > 0 ? guest.spares + longer + lengthened(guest.round_trip, clock_) : 0;
    const Frame said = (guest.slack[player] < plausible ? plausible : guest.slack[player]) - spares;
    if (said < least) least = said;
  }
  return least;
}

void HostCore::observe_delay() {
  stats_.round_trip = 0;
  for (const Guest& guest : guests_) {
    if (seats_.play(guest) && guest.round_trip > stats_.round_trip) stats_.round_trip = guest.round_trip;
  }
  Frame least = RecentLeast::kNothing;
  for (int p = 0; p < players(); ++p) {
    if (!is_local(p)) continue;
    const Frame slack = slack_of(p);
    if (slack < least) least = slack;
  }
  if (least != RecentLeast::kNothing) delay_.observe(least);
}

void HostCore::choose_pace(Time now) {
  // Of two that are as slow the one that was named stays it.
  const auto weight = [&](int player, int stretch) {
    return stretch > 0 && player == slowest() && stats_.stretch > 0 ? stretch + kAsSlow : stretch;
  };
  int whose = seats_.hosted() == 0 ? 0xff : local_player();
  int stretch = own_stretch(), most = weight(whose, stretch);
  int needed = stretch;
  for (Guest& guest : guests_) {
    const bool is_too_slow = seats_.play(guest) && guest.stretch > kMostStretch + kCatchingUp;
    if (!is_too_slow) guest.too_slow_since = now;
    if (now - guest.too_slow_since >= kTooSlow) seats_.close(guest);
    if (!seats_.play(guest)) continue;
    stretch = guest.stretch < kMostStretch ? guest.stretch : kMostStretch;
    if (stretch > needed) needed = stretch;
    if (weight(guest.player, stretch) <= most) continue;
    most = weight(guest.player, stretch);
    whose = guest.player;
  }
  go_at_pace_of(whose, needed);
  judge_own_pace(now);
}

void HostCore::judge_own_pace(Time now) {
  if (pace_.stretch() <= kMostStretch) own_slow_since_ = now;
  const bool is_loop = turn_rate_.stretch() >= kMostStretch && now - turn_rate_.slow_since() >= kTooSlow;
  if (!is_loop && now - own_slow_since_ < kTooSlow) return;
  std::uint64_t unfit = 0;
  for (const Guest& guest : guests_) {
    const bool is_sound = seats_.play(guest) && guest.stretch < kMostStretch && acknowledges(guest, now);
    if (guest.player >= 0 && !is_sound) unfit |= std::uint64_t{1} << guest.player;
  }
  is_too_slow_ = leadership_.tenure().is_backed() && leadership_.could_others(unfit);
}

}  // namespace isostep
