// The host measures every player's figures.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/figures.hpp"

namespace isostep {
namespace {

constexpr Time kTellFigures = kSecond;  // [us] for people to read

}  // namespace

void Figures::keep(int players, Time now) {
  if (now < told_again_at_) return;
  told_again_at_ = now + kTellFigures;
  for (int p = 0; p < players; ++p) {
    PlayerStats& figures = stats_.players[p];
    figures.waited = static_cast<std::uint32_t>(seats_[p].lost.spent(now));
    figures.round_trip = figures.jitter = figures.loss = 0;
  }
  for (Guest& guest : guests_) {
    if (!guest.is_live()) continue;
    // Who does not acknowledge is sent no more than it has to be.
    guest.figures_left = !guest.is_unproven() && flow_.acknowledges(guest, now) ? players : 0;
    for (const int p : EachPlayer(guest.players)) {
      PlayerStats& figures = stats_.players[p];
      figures.round_trip = static_cast<std::uint32_t>(guest.round_trip);
      figures.jitter = guest.meter.jitter(now);
      figures.loss = guest.meter.loss(now);
    }
  }
}

}  // namespace isostep
