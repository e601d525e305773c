// The host's seats: who may take part, who sits where, who is in the match.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

constexpr Frame kNotice = 30;  // [frames] between a seat's opening and its first frame

}  // namespace

std::uint64_t HostCore::secret() {
  HashCombiner number;
  number.add(config_.seed);
  number.add(secrets_++);
  return number.value();
}

void HostCore::refuse(Guest& guest, std::string_view key, std::string_view theirs, std::string_view ours) {
  guest.stage = Guest::Stage::refused;
  guest.refusal = {ShortText<kReplayKeyCap>(key), ShortText<kReplayValueCap>(theirs), ShortText<kReplayValueCap>(ours)};
  ++stats_.refused;
  SessionEvent event{.kind = SessionEvent::Kind::refused};
  event.field = guest.refusal;
  tell(event);
}

bool HostCore::is_refused(Guest& guest, const Hello& hello) {
  const HeaderMismatch mismatch = compare_headers(hello.identity, config_.identity);
  if (!mismatch.key.empty()) {
    refuse(guest, mismatch.key.view(), mismatch.in_file.view(), mismatch.here.view());
    return true;
  }
  const bool is_start = hello.have.frame == 0 && hashes_.has_chain(0);
  if (!started_ && (!is_start || hello.have.chain != hashes_.chain(0))) {
    ShortText<kReplayValueCap> theirs, ours;
    refuse(guest, "start", theirs.append_hex(hello.have.chain).view(), ours.append_hex(hashes_.chain(0)).view());
    return true;
  }
  if (!hello.spectator && find_seat(hello) < 0) {
    refuse(guest, "seats", "one more", "all taken");
    return true;
  }
  return false;
}

int HostCore::find_seat(const Hello& hello) const {
  for (int p = config_.local_players; p < players(); ++p) {
    if (hello.token != 0 && seats_[p].is_taken && seats_[p].token == hello.token) return p;
  }
  for (int p = config_.local_players; p < players(); ++p) {
    if (!seats_[p].is_taken) return p;
  }
  for (int p = config_.local_players; p < players(); ++p) {
    if (seats_[p].link < 0) return p;  // its player is away
  }
  return -1;
}

void HostCore::greet(Guest& guest, Bytes message) {
  const Result<Hello> read = read_hello(message);
  if (!read) {
    refuse(guest, read.error().place.view(), "unreadable", read.error().message.view());
    return;
  }
  const Hello& hello = read.value();
  if (is_refused(guest, hello)) return;
  if (!hello.spectator) {
    const int player = find_seat(hello);
    Seat& seat = seats_[player];
    if (seat.link >= 0) {  // the same player, from a new address
      Guest& old = guests_[static_cast<std::size_t>(seat.link)];
      unseat(old);
      old.must_close = true;
    }
    seat.is_taken = true;
    seat.link = static_cast<int>(guest.peer);
    seat.token = secret() | 1u;
    guest.player = player;
  }
  guest.must_welcome = true;
  const Frame have = hello.have.frame;
  // A client may be ahead of us: what it was sent is final before we have stepped it. It is compared once we have.
  const bool is_ahead = started_ && have > hashes_.settled().frame && have <= known_end();
  bool has_inputs = is_ahead || (hashes_.has_chain(have) && hashes_.chain(have) == hello.have.chain);
  has_inputs = has_inputs && current() - have <= config_.most_replayed;
  for (const InputStream& stream : streams_) has_inputs = has_inputs && stream.begin() <= have;
  if (has_inputs) {
    go_live(guest, have);
    guest.start_chain = hello.have.chain;
    if (!started_ && guest.player >= 0) guest.opens = 0;
  } else {
    guest.stage = Guest::Stage::needs_snapshot;
    guest.partial = hello.partial_size > 0 ? hello.partial : HashReport{};
    guest.partial_size = hello.partial_size;
  }
}

void HostCore::go_live(Guest& guest, Frame start) {
  guest.stage = Guest::Stage::live;
  guest.start = start;
  for (int p = 0; p < players(); ++p) guest.acked[p] = guest.burst_end[p] = guest.first_end[p] = guest.due[p] = start;
  guest.due_since = guest.had_all_at = guest.heard;
  guest.acked_at = guest.more_at = 0;
  guest.has_spoken = guest.has_more = false;
}

void HostCore::open_seat(Guest& guest, Time now) {
  if (!started_ || (guest.player >= 0 && now < seats_[guest.player].shut_until)) return;  // later
  guest.is_ready = false;
  if (guest.player < 0 || seats_[guest.player].is_open) return;
  InputStream& stream = streams_[static_cast<std::size_t>(guest.player)];
  const Frame trip = static_cast<Frame>(2 * guest.round_trip / clock_.period());
  // From the horizon, not from what was granted before: who comes and goes must not push its stream out of the log.
  const Frame earliest = horizon() + bounded(kNotice + (trip < 10 * kNotice ? trip : 10 * kNotice));
  guest.opens = stream.end() > earliest ? stream.end() : earliest;
  stream.append_absent_until(guest.opens);
  guest.must_open = true;
  seats_[guest.player].is_open = true;
}

void HostCore::close_seat(int player) {
  Seat& seat = seats_[player];
  if (!seat.is_open) return;
  seat.is_open = false;
  seat.replaced_end = 0;
  seat.is_late = false;
  if (!started_) return;
  slack_[player] = RecentLeast{};
}

void HostCore::unseat(Guest& guest) {
  if (guest.player < 0) return;
  close_seat(guest.player);
  seats_[guest.player].link = -1;
  views_[guest.player] = View{};
  if (!started_) seats_[guest.player] = Seat{};
  guest.player = -1;
}

void HostCore::drop(Guest& guest) {
  unseat(guest);
  if (guest.stage == Guest::Stage::receives_snapshot) {
    held_until_ = current() + static_cast<Frame>(config_.silence / clock_.period());
  }
  clear(guest);
}

}  // namespace isostep
