// The host as judge of lines: whose fault a late input is, and whose line is worse.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/line_judge.hpp"

#include "isostep/core/stable_sort.hpp"
#include "isostep/session/host/input_flow.hpp"

namespace isostep {
namespace {

constexpr Frame kLateBeyond = 2;       // [frames] that an input is late beyond its way: two losses, or jitter
constexpr Frame kLateWhenSlow = 3;     // [frames] while a machine is at its limit, and sends less evenly
constexpr Frame kMostSpread = 8;       // [frames] more, of who comes in bursts itself
constexpr Time kTooFar = 2 * kSecond;  // [us] on a line that no delay covers, until its players watch
constexpr Time kAsGood = 2;            // [frames] by which round trips differ on lines that are as good

/// [frames] by which half of a round trip is longer when all go at full speed again: what comes in time in a match that
/// is slow for its rollbacks comes late, and makes it slow, once it is not.
Frame lengthened(Time round_trip, const FrameClock& clock) {
  if (clock.period() == clock.nominal()) return 0;
  const Time way = round_trip / 2;
  return static_cast<Frame>((way + clock.nominal() - 1) / clock.nominal() - way / clock.period());
}

}  // namespace

void LineJudge::judge() {
  // The middle one of all lines: the better half of the players does not wait for the worse.
  Time trips[kMaxPlayers] = {};
  std::uint32_t count = 0;
  for (const Guest& guest : guests_) {
    if (seats_.play(guest)) trips[count++] = guest.round_trip;
  }
  insertion_sort(trips, count, OwnKey{});
  farthest_ = count == 0 ? 0 : trips[(count - 1) / 2] + kAsGood * clock_.period();
  for (Guest& guest : guests_) {
    // A period less on the way back, so that jitter does not change it again and again.
    guest.is_far = seats_.play(guest) && guest.round_trip > farthest_ - (guest.is_far ? clock_.period() : 0);
  }
}

bool LineJudge::loses(Guest& guest, bool is_covered, Time now) {
  if (is_covered || guest.player < 0) {
    guest.covered_at = now;
    guest.is_too_far = false;
  }
  if (guest.is_too_far || now - guest.covered_at < kTooFar) return false;
  guest.is_too_far = true;
  return true;
}

Frame LineJudge::slack_of(int player, Frame current, bool is_slow) const {
  const bool is_local = seats_.is_local(player);
  const Frame here = is_local ? delay_.frames() + 1 : slack_[player].value();
  const bool is_known = here != RecentLeast::kNothing;
  const Guest* const its = guests_.on(seats_[player]);
  const Frame longer = its == nullptr ? 0 : lengthened(its->round_trip, clock_);
  const Frame spared = thrift_.frames() > 0 ? thrift_.frames() + longer : 0;
  Frame least = is_local ? RecentLeast::kNothing : is_known ? here - spared : here;
  if (!is_known || !reports_count_) return least;
  const Frame beyond = is_slow ? kLateWhenSlow : kLateBeyond;
  for (const Guest& guest : guests_) {
    if (!seats_.play(guest) || guest.has(player) || (guest.reported_mask >> player & 1) == 0) continue;
    if (InputFlow::was_held_back(guest, player, current) || guest.slack[player] == RecentLeast::kNothing) continue;
    // What was early here is not later there than the way explains and lines that lose as much as its own do, whatever
    // is said.
    const Time trip = guest.round_trip < farthest_ ? guest.round_trip : farthest_;
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

Frame LineJudge::told_slack(const Guest& guest, int player, Frame current, bool is_slow) const {
  const Frame slack = slack_of(player, current, is_slow), here = slack_[player].value();
  if (config_.deadline == 0 || here == RecentLeast::kNothing) return slack;
  // What others do in a frame is sent when its own input is here: that has to come earlier by the way back. The others'
  // words on it are of what came to them.
  const Frame back = here - static_cast<Frame>(guest.round_trip / 2 / clock_.period()) - 1;
  const Frame told = back < slack ? back : slack;
  return told < -127 ? -127 : told;
}

Time LineJudge::longest_round_trip() const {
  Time longest = 0;
  for (const Guest& guest : guests_) {
    if (seats_.play(guest) && guest.round_trip > longest) longest = guest.round_trip;
  }
  return longest;
}

}  // namespace isostep
