// The host's seats: who may take part, who sits where, who is in the match.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"
#include "isostep/session/siphash.hpp"

namespace isostep {
namespace {

constexpr Frame kNotice = 30;         // [frames] between a seat's opening and its first frame
constexpr Time kRefusalsAtOnce = 32;  // all players of another version; of who comes again and again one a second

}  // namespace

std::uint64_t HostCore::draw(Purpose purpose, std::uint64_t n) const {
  std::uint8_t words[24] = {};
  store_le(words, static_cast<std::uint64_t>(purpose));
  store_le(words + 8, n);
  for (std::uint64_t again = 0;; ++again) {
    store_le(words + 16, again);
    if (const std::uint64_t number = siphash_2_4({config_.seed, 0}, words)) return number;
  }
}

void HostCore::refuse(Guest& guest, std::string_view key, std::string_view theirs, std::string_view ours) {
  send_away(guest, key, theirs, ours);
  ++stats_.refused;
  tell_refusal(guest.refusal);
}

void HostCore::tell_refusal(const Refusal& refusal) {
  if (refusals_until_ > turn_at_ + kRefusalsAtOnce * kSecond) return;
  refusals_until_ = (refusals_until_ > turn_at_ ? refusals_until_ : turn_at_) + kSecond;
  SessionEvent event{.kind = SessionEvent::Kind::refused};
  event.field = refusal;
  tell(event);
}

bool HostCore::is_refused(Guest& guest, const Hello& hello) {
  const HeaderMismatch mismatch = compare_headers(hello.identity, config_.identity);
  if (!mismatch.key.empty()) {
    refuse(guest, mismatch.key.view(), mismatch.in_file.view(), mismatch.here.view());
    return true;
  }
  if (!hello.spectator && hello.migration != config_.migration) {
    ShortText<kReplayValueCap> theirs, ours;
    refuse(guest, "migration", theirs.append_number(hello.migration).view(),
           ours.append_number(config_.migration).view());
    return true;
  }
  const bool is_start = hello.have.frame == 0 && hashes_.has_chain(0);
  if (!started_ && !is_resumed() && (!is_start || hello.have.chain != hashes_.chain(0))) {
    ShortText<kReplayValueCap> theirs, ours;
    refuse(guest, "start", theirs.append_hex(hello.have.chain).view(), ours.append_hex(hashes_.chain(0)).view());
    return true;
  }
  return false;
}

void HostCore::greet(Guest& guest, Bytes message) {
  const Result<Hello> read = read_hello(message);
  if (!read) {
    refuse(guest, read.error().place.view(), "unreadable", read.error().message.view());
    return;
  }
  const Hello& hello = read.value();
  if (is_refused(guest, hello)) return;
  guest.wish = hello;
  guest.address = hello.address;
  // Nobody follows an earlier host than it has known: the others decide anew.
  const int voter = roster_.voter_of(hello.token, hello.life);
  is_over_ = is_over_ || (started_ && voter >= 0 && hello.term > tenure_.term());
  const bool is_member = inherited_.voter_of(hello.token, hello.life) >= 0;
  if (!config_.asks_admission || is_member) {
    let_in(guest);
    return;
  }
  guest.stage = Guest::Stage::applies;
  guest.applicant = ++applicants_;
  guest.credential.assign(hello.credential.begin(), hello.credential.end());
}

bool HostCore::let_in(Guest& guest) {
  if (guest.wish.spectator) {
    if (!has_room_for_spectator()) {
      refuse(guest, "spectators", "one more", "no room");
      return false;
    }
  } else {
    const std::uint32_t seats = find_seats(guest);
    if (seats == 0) return false;
    take_seats(guest, seats);
  }
  guest.must_welcome = true;
  if (!started_ && guest.player >= 0) guest.opens = current();
  const HashReport& has = guest.wish.have;
  const Frame have = has.frame;
  // A client may be ahead of us: what it was sent is final before we have stepped it. It is compared once we have.
  const bool is_ahead = started_ && have > hashes_.settled().frame && have <= known_end();
  bool has_inputs = is_ahead || (hashes_.has_chain(have) && hashes_.chain(have) == has.chain);
  has_inputs = has_inputs && current() - have <= config_.most_replayed;
  for (const InputStream& stream : streams_) has_inputs = has_inputs && stream.begin() <= have;
  if (has_inputs) {
    go_live(guest, have);
    guest.start_chain = has.chain;
  } else {
    guest.stage = Guest::Stage::needs_snapshot;
    guest.partial = guest.wish.partial_size > 0 ? guest.wish.partial : HashReport{};
    guest.partial_size = guest.wish.partial_size;
  }
  return true;
}

void HostCore::go_live(Guest& guest, Frame start) {
  guest.stage = Guest::Stage::live;
  guest.start = start;
  for (int p = 0; p < players(); ++p) guest.acked[p] = guest.burst_end[p] = guest.first_end[p] = guest.due[p] = start;
  guest.due_since = guest.had_all_at = guest.heard;
  guest.acked_at = guest.more_at = 0;
  guest.has_spoken = guest.has_more = false;
  guest.must_enroll = roster_.version > 0;
  guest.must_tell_ballot = ballot_.is_open();
}

void HostCore::open_seats(Guest& guest, Time now) {
  const bool is_shut = guest.player >= 0 && (now < seats_[guest.player].shut_until || guest.is_too_far);
  if (!started_ || is_shut) return;  // later
  guest.is_ready = false;
  if (guest.player < 0 || seats_[guest.player].is_open) return;
  const Frame trip = static_cast<Frame>(2 * guest.round_trip / clock_.period());
  // From the horizon, not from what was granted before: who comes and goes must not push its stream out of the log.
  guest.opens = horizon() + bounded(kNotice + (trip < 10 * kNotice ? trip : 10 * kNotice));
  for (int p = 0; p < players(); ++p) {
    const Frame end = streams_[static_cast<std::size_t>(p)].end();
    if (has(guest, p) && end > guest.opens) guest.opens = end;
  }
  for (int p = 0; p < players(); ++p) {
    if (!has(guest, p)) continue;
    streams_[static_cast<std::size_t>(p)].append_absent_until(guest.opens);
    seats_[p].is_open = true;
  }
  guest.must_open = true;
}

void HostCore::close_seat(int player) {
  if (seats_[player].link >= 0) close_seats(guests_[static_cast<std::size_t>(seats_[player].link)]);
}

void HostCore::close_seats(Guest& guest) {
  for (int p = 0; p < players(); ++p) {
    Seat& seat = seats_[p];
    if (!has(guest, p) || !seat.is_open) continue;
    seat.is_open = false;
    seat.replaced_end = 0;
    seat.is_late = false;
    if (started_) slack_[p] = RecentLeast{};
  }
}

void HostCore::leave_out(Guest& guest, Time now) {
  close_seats(guest);
  for (int p = 0; p < players(); ++p) {
    if (has(guest, p)) seats_[p].shut_until = now + config_.exclusion;
  }
}

void HostCore::unseat(Guest& guest) {
  close_seats(guest);
  for (int p = 0; p < players(); ++p) {
    if (!has(guest, p)) continue;
    seats_[p].link = -1;
    was_repaired(static_cast<std::size_t>(p), kNoFrame);
    inquiry_.differing &= ~(std::uint64_t{1} << p);
    if (!seats_[p].is_kept) free_seat(p);
  }
  guest.players = 0;
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
