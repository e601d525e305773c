// All go as fast as the slowest machine can, if that is fast enough.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/match_pace.hpp"

namespace isostep {
namespace {

constexpr int kCatchingUp = 16;         // [1/256 period] that a client adds to what it needs
constexpr int kAsSlow = 8;              // [1/256 period] by which machines differ that are as slow
constexpr Time kTooSlow = 2 * kSecond;  // [us] at less than the least pace, until a player watches

}  // namespace

MatchPace::Choice MatchPace::choose(const Choice& present, Time now) {
  // Of two that are as slow the one that was named stays it.
  const auto weight = [&](int player, int stretch) {
    return stretch > 0 && player == present.player && present.stretch > 0 ? stretch + kAsSlow : stretch;
  };
  Choice choice{seats_.hosted() == 0 ? 0xff : first_of(seats_.hosted()), own()};
  int most = weight(choice.player, choice.stretch);
  for (Guest& guest : guests_) {
    const bool is_too_slow = seats_.play(guest) && guest.stretch > most_ + kCatchingUp;
    if (!is_too_slow) guest.too_slow_since = now;
    if (now - guest.too_slow_since >= kTooSlow) seats_.close(guest);
    if (!seats_.play(guest)) continue;
    const int stretch = guest.stretch < most_ ? guest.stretch : most_;
    if (stretch > choice.stretch) choice.stretch = stretch;
    if (weight(guest.player, stretch) <= most) continue;
    most = weight(guest.player, stretch);
    choice.player = guest.player;
  }
  return choice;
}

bool MatchPace::is_too_slow(Time now) {
  if (steps_.stretch() <= most_) dear_since_ = now;
  return (turns_.stretch() >= most_ && now - turns_.slow_since() >= kTooSlow) || now - dear_since_ >= kTooSlow;
}

std::uint64_t MatchPace::unfit(const InputFlow& flow, Time now) const {
  std::uint64_t unfit = 0;
  for (const Guest& guest : guests_) {
    const bool is_sound = seats_.play(guest) && guest.stretch < most_ && flow.acknowledges(guest, now);
    if (guest.player >= 0 && !is_sound) unfit |= std::uint64_t{1} << guest.player;
  }
  return unfit;
}

}  // namespace isostep
