// The players of a client's machine.
// SPDX-License-Identifier: MIT
#include "isostep/session/client/own_seats.hpp"

#include "isostep/session/agreement/verdict.hpp"

namespace isostep {
namespace {
/// [us] for the other machines to vouch for our states: some reports of each, with losses on the longest lines.
constexpr Time kVouching = 5 * kSecond;
}  // namespace

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

bool OwnSeats::are_vouched_for(std::uint64_t agreeing, std::uint64_t differing, std::uint32_t with_host,
                               Time now) const {
  // Until the host says that nobody plays for us, inputs of ours from before are still on their way.
  for (const int p : EachPlayer(players_)) {
    const InputStream& stream = streams_[static_cast<std::size_t>(p)];
    if (stream.end() == stream.begin() || !stream.last().absent) return false;
  }
  std::uint64_t counted = std::uint64_t{1} << kHostMachine;
  int needed = 1;
  for (std::size_t p = 0; p < streams_.size(); ++p) {
    if (((with_host | players_) >> p & 1) != 0) continue;
    counted |= std::uint64_t{1} << p;
    if (!streams_[p].last().absent) needed = 2;
  }
  const int agree = std::popcount(agreeing & counted);
  if (agree >= needed && agree > std::popcount(differing & counted)) return true;
  // Who says nothing, or what is not so, does not keep us out for ever: then the host's word alone counts.
  return near_since_ != 0 && now - near_since_ > kVouching && (agreeing >> kHostMachine & 1) != 0;
}

}  // namespace isostep
