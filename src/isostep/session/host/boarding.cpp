// How guests come into the match.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/boarding.hpp"

namespace isostep {
namespace {

constexpr Frame kNotice = 30;  // [frames] between a seat's opening and its first frame

}  // namespace

bool Boarding::has_inputs_since(const HashReport& state) const {
  // A client may be ahead of us: what it was sent is final before we have stepped it. It is compared once we have.
  const bool is_ahead = host_.has_begun && state.frame > hashes_.settled().frame && state.frame <= known_end(streams_);
  bool has = is_ahead || (hashes_.has_chain(state.frame) && hashes_.chain(state.frame) == state.chain);
  has = has && host_.timeline.current() - state.frame <= host_.config.most_replayed;
  for (const InputStream& stream : streams_) has = has && stream.begin() <= state.frame;
  return has;
}

void Boarding::enter(Guest& guest) const {
  guest.due.add(Due::welcome);
  if (!host_.has_begun && guest.player >= 0) guest.opens = host_.timeline.current();
  const HashReport& has = guest.wish.have;
  if (has_inputs_since(has)) {
    go_live(guest, has.frame);
    guest.start_chain = has.chain;
  } else {
    guest.stage = Guest::Stage::needs_snapshot;
    guest.partial = guest.wish.partial_size > 0 ? guest.wish.partial : HashReport{};
    guest.partial_size = guest.wish.partial_size;
  }
}

void Boarding::go_live(Guest& guest, Frame start) const {
  guest.stage = Guest::Stage::live;
  guest.start = start;
  for (int p = 0; p < host_.config.players; ++p)
    guest.acked[p] = guest.burst_end[p] = guest.first_end[p] = guest.owes[p] = start;
  guest.owes_since = guest.had_all_at = guest.heard;
  guest.acked_at = guest.more_at = 0;
  guest.has_spoken = guest.has_more = false;
  guest.due.set(Due::roster, roster_.version > 0);
  guest.due.set(Due::ballot, ballot_.is_open());
}

void Boarding::open_seats(Guest& guest, Time now) const {
  const bool is_shut = guest.player >= 0 && (now < host_.seats[guest.player].shut_until || guest.is_too_far);
  if (!host_.has_begun || is_shut) return;  // later
  guest.is_ready = false;
  if (guest.player < 0 || host_.seats[guest.player].is_open) return;
  const Frame trip = static_cast<Frame>(2 * guest.round_trip / clock_.period());
  // From the horizon, not from what was granted before: who comes and goes must not push its stream out of the log.
  guest.opens =
      flow_.horizon(host_.timeline.current()) + flow_.bounded(kNotice + (trip < 10 * kNotice ? trip : 10 * kNotice));
  for (const int p : EachPlayer(guest.players)) {
    const Frame end = streams_[static_cast<std::size_t>(p)].end();
    if (end > guest.opens) guest.opens = end;
  }
  for (const int p : EachPlayer(guest.players)) {
    streams_[static_cast<std::size_t>(p)].append_absent_until(guest.opens);
    host_.seats[p].is_open = true;
  }
  guest.due.add(Due::open);
}

}  // namespace isostep
