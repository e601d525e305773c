// The host's figures of every player: measured here, and told to all once a second.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

constexpr Time kTellFigures = kSecond;  // [us] for people to read

}  // namespace

void HostCore::keep_figures(Time now) {
  if (!started_ || now < figures_at_) return;
  figures_at_ = now + kTellFigures;
  for (int p = 0; p < players(); ++p) {
    PlayerStats& figures = stats_.players[p];
    figures.waited = static_cast<std::uint32_t>(seats_[p].lost.spent(now));
    figures.round_trip = figures.jitter = figures.loss = 0;
  }
  for (Guest& guest : guests_) {
    if (!guest.is_live()) continue;
    // Who does not acknowledge is sent no more than it has to be.
    guest.figures_left = !is_unproven(guest) && acknowledges(guest, now) ? players() : 0;
    for (int p = 0; p < players(); ++p) {
      if (!guest.has(p)) continue;
      PlayerStats& figures = stats_.players[p];
      figures.round_trip = static_cast<std::uint32_t>(guest.round_trip);
      figures.jitter = guest.meter.jitter(now);
      figures.loss = guest.meter.loss(now);
    }
  }
}

}  // namespace isostep
