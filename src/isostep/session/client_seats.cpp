// The players of a client's machine.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_seats.hpp"

namespace isostep {

bool OwnSeats::open(Frame first, Frame most) {
  bool is_next = !is_open();
  stop_asking();  // where the host has closed the seats again before this came, we ask once more
  for (const int p : EachPlayer(players_)) {
    const Frame end = streams_[static_cast<std::size_t>(p)].end();
    is_next = is_next && first >= end && first <= end + most;
  }
  if (!is_next) return false;
  for (const int p : EachPlayer(players_)) {
    streams_[static_cast<std::size_t>(p)].append_absent_until(first);
    accept_until(p, first);
  }
  go_on_from(first);
  return true;
}

void OwnSeats::go_on_from(Frame first) {
  stage_ = Stage::open;
  opens_ = first;
  for (const int p : EachPlayer(players_)) host_.acked[p] = accepted_[p];
}

void OwnSeats::hear_acks() {
  if (!is_open()) return;
  for (const int p : EachPlayer(players_)) {
    if (host_.acked[p] > accepted_[p]) accepted_[p] = host_.acked[p];
  }
}

void OwnSeats::take(int player, const InputEntry& entry) {
  InputStream& stream = streams_[static_cast<std::size_t>(player)];
  Frame& accepted = accepted_[player];
  if (entry.absent && accepted >= opens_) {
    cut_out();
    return;
  }
  if (accepted == stream.end()) {
    stream.append(entry);
  } else if (!same_input(stream.at(accepted), entry)) {
    stream.replace(accepted, entry);
    timeline_.recheck(player, accepted);
  }
  host_.acked[player] = ++accepted;
}

void OwnSeats::cut_out() {
  for (const int p : EachPlayer(players_)) {
    streams_[static_cast<std::size_t>(p)].truncate(accepted_[p]);
    timeline_.recheck(p, accepted_[p]);
  }
  stage_ = Stage::closed;
}

Frame OwnSeats::limit(Frame most) const {
  if (!is_open()) return most;
  for (const int p : EachPlayer(players_)) most = accepted_[p] < most ? accepted_[p] : most;
  return most;
}

}  // namespace isostep
