// Whom the host lets in and sends away, and what its game has to say in that.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/admission.hpp"

namespace isostep {
namespace {

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

std::optional<Applicant> Admission::poll_applicant() {
  for (Guest& guest : host_.guests) {
    if (!guest.applies() || guest.is_shown) continue;
    guest.is_shown = true;
    const Application& wish = guest.wish;
    return Applicant{guest.applicant, guest.peer, wish.spectator,
                     wish.seat,       wish.seats, first_of(host_.seats.players_of(wish.token)),
                     guest.credential};
  }
  return std::nullopt;
}

bool Admission::admit(std::uint64_t applicant) {
  Guest* guest = host_.guests.applicant(applicant);
  return guest != nullptr && let_in(*guest);
}

bool Admission::refuse(std::uint64_t applicant, std::string_view reason) {
  Guest* guest = host_.guests.applicant(applicant);
  if (guest == nullptr || !is_reason(reason)) return false;
  refuse(*guest, {"admission", {}, reason});
  return true;
}

bool Admission::kick(int player, std::string_view reason) {
  if (!host_.seats.is_guests(player) || !host_.seats[player].is_taken || !is_reason(reason)) return false;
  Guest* guest = host_.guests.on(host_.seats[player]);
  const std::uint32_t machine = guest != nullptr ? guest->players : host_.seats.away_with(player);
  if (guest != nullptr) departures_.send_away(*guest, {"kicked", {}, reason});
  for (const int p : EachPlayer(machine)) host_.seats.free(p);
  return true;
}

bool Admission::kick_peer(PeerId peer, std::string_view reason) {
  Guest* guest = host_.guests.find(peer);
  if (guest == nullptr) return false;
  if (guest->player >= 0) return kick(guest->player, reason);
  if (!is_reason(reason)) return false;
  departures_.send_away(*guest, {"kicked", {}, reason});
  return true;
}

std::optional<PeerId> Admission::peer_of(int player) const {
  if (!host_.seats.is_guests(player) || host_.seats[player].link < 0) return std::nullopt;
  return static_cast<PeerId>(host_.seats[player].link);
}

// --- who comes ---

void Admission::greet(Guest& guest, Bytes message) {
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
  if (!host_.config.asks_admission || leadership_.is_member(hello)) {
    let_in(guest);
    return;
  }
  guest.stage = Guest::Stage::applies;
  guest.applicant = std::uint64_t{leadership_.term()} << 32 | ++applicants_;
  guest.credential.assign(hello.credential.begin(), hello.credential.end());
}

Refusal Admission::mismatch_of(const Hello& hello) const {
  Refusal why = compare_headers(hello.identity, host_.config.identity);
  if (!why.key.empty()) return why;
  if (!hello.spectator && hello.migration != host_.config.migration) {
    why.key.append("migration");
    why.in_file.append_number(hello.migration);
    why.here.append_number(host_.config.migration);
    return why;
  }
  const bool is_start = hello.have.frame == 0 && hashes_.has_chain(0);
  if (!host_.has_begun && resumed_.frame == kNoFrame && (!is_start || hello.have.chain != hashes_.chain(0))) {
    why.key.append("start");
    why.in_file.append_hex(hello.have.chain);
    why.here.append_hex(hashes_.chain(0));
  }
  return why;
}

bool Admission::let_in(Guest& guest) {
  Refusal why;
  if (guest.wish.spectator) {
    // Spectators leave room for the players.
    const int room = host_.config.max_peers - (host_.config.players - std::popcount(host_.seats.hosted()));
    if (host_.guests.spectators() >= room) why = {"spectators", "one more", "no room"};
  } else {
    // A token that is nobody's any more may come from a player who was away for too long: new, but not refused.
    if (guest.wish.token != 0 && host_.seats.players_of(guest.wish.token) == 0) ++host_.stats.refused;
    if (const std::uint32_t wanted = host_.seats.find(guest.wish, why)) seat(guest, wanted);
  }
  if (!why.key.empty()) {
    refuse(guest, why);
    return false;
  }
  boarding_.enter(guest);
  return true;
}

void Admission::seat(Guest& guest, std::uint32_t wanted) {
  const Seats::Claim claim = host_.seats.claim(guest.wish, wanted, numbers_);
  for (const int p : EachPlayer(claim.wanted | claim.own)) {
    const bool is_owner = (claim.own >> p & 1) != 0;
    Guest* const other = host_.guests.on(host_.seats[p]);
    const char* const why = is_owner ? "taken over from another address" : "not played on for too long";
    if (other != nullptr) departures_.send_away(*other, {"seat", {}, why});
  }
  host_.seats.take(guest, claim);
}

// --- who goes ---

void Admission::refuse(Guest& guest, const Refusal& refusal) {
  departures_.send_away(guest, refusal);
  ++host_.stats.refused;
  if (refusals_until_ > host_.now + kRefusalsAtOnce * kSecond) return;
  refusals_until_ = (refusals_until_ > host_.now ? refusals_until_ : host_.now) + kSecond;
  SessionEvent event{.kind = SessionEvent::Kind::refused};
  event.field = refusal;
  host_.events.tell(event);
}

}  // namespace isostep
