// Whom the host lets in and sends away, and what its game has to say in that.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/host_core.hpp"

namespace isostep {
namespace {

constexpr Frame kNotice = 30;         // [frames] between a seat's opening and its first frame
constexpr Time kRefusalsAtOnce = 32;  // all players of another version; of who comes again and again one a second

/// What the other side reads as a reason: see read_refusal.
bool is_reason(std::string_view text) {
  for (const char c : text) {
    if (c < ' ' || c > '~') return false;
  }
  return text.size() <= kReplayValueCap;
}

}  // namespace

// --- what the game decides ---

std::optional<Applicant> HostCore::poll_applicant() {
  for (Guest& guest : guests_) {
    if (!guest.applies() || guest.is_shown) continue;
    guest.is_shown = true;
    const Application& wish = guest.wish;
    return Applicant{guest.applicant, guest.peer, wish.spectator,
                     wish.seat,       wish.seats, first_of(seats_.players_of(wish.token)),
                     guest.credential};
  }
  return std::nullopt;
}

bool HostCore::admit(std::uint64_t applicant) {
  Guest* guest = guests_.applicant(applicant);
  return guest != nullptr && let_in(*guest);
}

bool HostCore::refuse(std::uint64_t applicant, std::string_view reason) {
  Guest* guest = guests_.applicant(applicant);
  if (guest == nullptr || !is_reason(reason)) return false;
  refuse(*guest, {"admission", {}, reason});
  return true;
}

bool HostCore::kick(int player, std::string_view reason) {
  if (!seats_.is_guests(player) || !seats_[player].is_taken || !is_reason(reason)) return false;
  Guest* guest = guests_.on(seats_[player]);
  const std::uint32_t machine = guest != nullptr ? guest->players : seats_.away_with(player);
  if (guest != nullptr) send_away(*guest, {"kicked", {}, reason});
  for (const int p : EachPlayer(machine)) seats_.free(p);
  return true;
}

bool HostCore::kick_peer(PeerId peer, std::string_view reason) {
  Guest* guest = guests_.find(peer);
  if (guest == nullptr) return false;
  if (guest->player >= 0) return kick(guest->player, reason);
  if (!is_reason(reason)) return false;
  send_away(*guest, {"kicked", {}, reason});
  return true;
}

std::optional<PeerId> HostCore::peer_of(int player) const {
  if (!seats_.is_guests(player) || seats_[player].link < 0) return std::nullopt;
  return static_cast<PeerId>(seats_[player].link);
}

// --- who comes ---

void HostCore::greet(Guest& guest, Bytes message) {
  const Result<Hello> read = read_hello(message);
  if (!read) {
    refuse(guest, {read.error().place.view(), "unreadable", read.error().message.view()});
    return;
  }
  const Hello& hello = read.value();
  if (const Refusal why = mismatch_of(hello); !why.key.empty()) {
    refuse(guest, why);
    return;
  }
  guest.wish = hello;
  guest.address = hello.address;
  leadership_.hear(hello);
  if (!config_.asks_admission || leadership_.is_member(hello)) {
    let_in(guest);
    return;
  }
  guest.stage = Guest::Stage::applies;
  guest.applicant = ++applicants_;
  guest.credential.assign(hello.credential.begin(), hello.credential.end());
}

Refusal HostCore::mismatch_of(const Hello& hello) const {
  Refusal why = compare_headers(hello.identity, config_.identity);
  if (!why.key.empty()) return why;
  if (!hello.spectator && hello.migration != config_.migration) {
    why.key.append("migration");
    why.in_file.append_number(hello.migration);
    why.here.append_number(config_.migration);
    return why;
  }
  const bool is_start = hello.have.frame == 0 && hashes_.has_chain(0);
  if (!started_ && !is_resumed() && (!is_start || hello.have.chain != hashes_.chain(0))) {
    why.key.append("start");
    why.in_file.append_hex(hello.have.chain);
    why.here.append_hex(hashes_.chain(0));
  }
  return why;
}

bool HostCore::let_in(Guest& guest) {
  Refusal why;
  if (guest.wish.spectator) {
    // Spectators leave room for the players.
    const int room = config_.max_peers - (players() - std::popcount(seats_.hosted()));
    if (guests_.spectators() >= room) why = {"spectators", "one more", "no room"};
  } else {
    // A token that is nobody's any more may come from a player who was away for too long: new, but not refused.
    if (guest.wish.token != 0 && seats_.players_of(guest.wish.token) == 0) ++stats_.refused;
    if (const std::uint32_t wanted = seats_.find(guest.wish, why)) seat(guest, wanted);
  }
  if (!why.key.empty()) {
    refuse(guest, why);
    return false;
  }
  guest.due.add(Due::welcome);
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

void HostCore::seat(Guest& guest, std::uint32_t wanted) {
  const Seats::Claim claim = seats_.claim(guest.wish, wanted, numbers_);
  for (const int p : EachPlayer(claim.wanted | claim.own)) {
    const bool is_owner = (claim.own >> p & 1) != 0;
    Guest* const other = guests_.on(seats_[p]);
    const char* const why = is_owner ? "taken over from another address" : "not played on for too long";
    if (other != nullptr) send_away(*other, {"seat", {}, why});
  }
  seats_.take(guest, claim);
}

void HostCore::go_live(Guest& guest, Frame start) {
  guest.stage = Guest::Stage::live;
  guest.start = start;
  for (int p = 0; p < players(); ++p) guest.acked[p] = guest.burst_end[p] = guest.first_end[p] = guest.owes[p] = start;
  guest.owes_since = guest.had_all_at = guest.heard;
  guest.acked_at = guest.more_at = 0;
  guest.has_spoken = guest.has_more = false;
  guest.due.set(Due::roster, leadership_.roster().version > 0);
  guest.due.set(Due::ballot, ballot_.is_open());
}

void HostCore::open_seats(Guest& guest, Time now) {
  const bool is_shut = guest.player >= 0 && (now < seats_[guest.player].shut_until || guest.is_too_far);
  if (!started_ || is_shut) return;  // later
  guest.is_ready = false;
  if (guest.player < 0 || seats_[guest.player].is_open) return;
  const Frame trip = static_cast<Frame>(2 * guest.round_trip / clock_.period());
  // From the horizon, not from what was granted before: who comes and goes must not push its stream out of the log.
  guest.opens = horizon() + flow_.bounded(kNotice + (trip < 10 * kNotice ? trip : 10 * kNotice));
  for (const int p : EachPlayer(guest.players)) {
    const Frame end = streams_[static_cast<std::size_t>(p)].end();
    if (end > guest.opens) guest.opens = end;
  }
  for (const int p : EachPlayer(guest.players)) {
    streams_[static_cast<std::size_t>(p)].append_absent_until(guest.opens);
    seats_[p].is_open = true;
  }
  guest.due.add(Due::open);
}

// --- who goes ---

void HostCore::refuse(Guest& guest, const Refusal& refusal) {
  send_away(guest, refusal);
  ++stats_.refused;
  if (refusals_until_ > turn_at_ + kRefusalsAtOnce * kSecond) return;
  refusals_until_ = (refusals_until_ > turn_at_ ? refusals_until_ : turn_at_) + kSecond;
  SessionEvent event{.kind = SessionEvent::Kind::refused};
  event.field = refusal;
  tell(event);
}

void HostCore::send_away(Guest& guest, const Refusal& refusal) {
  unseat(guest);
  guest.stage = Guest::Stage::refused;
  guest.refusal = refusal;
}

void HostCore::unseat(Guest& guest) {
  for (const int p : EachPlayer(guest.players)) {
    views_.was_repaired(static_cast<std::size_t>(p), kNoFrame);
    inquiry_.forget(p);
  }
  seats_.leave(guest);
}

void HostCore::drop(Guest& guest) {
  unseat(guest);
  if (guest.stage == Guest::Stage::receives_snapshot) {
    snapshots_.hold_until(current() + static_cast<Frame>(config_.silence / clock_.period()));
  }
  guest.clear();
}

}  // namespace isostep
