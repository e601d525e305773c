// Who gets which seat of the host's match, for whom seats are kept, and what the host's game has to say in that.
// SPDX-License-Identifier: MIT
#include <bit>

#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

/// [us] from the connection to the hello, which is one way of the line: a second for it to be sent again, and one more.
constexpr Time kGreeting = 2 * kSecond;

/// [us] for who has a connection to have a state and others who agree with it, before its seat is anybody's.
constexpr Time kJoining = 30 * kSecond;
/// [us] that count of one turn: nobody can come back while our own process stands still.
constexpr Time kLongestTurn = kSecond;

/// 1 when they are equal, without a branch that would tell how.
constexpr std::uint32_t equals(std::uint64_t a, std::uint64_t b) {
  const std::uint64_t difference = a ^ b;
  return static_cast<std::uint32_t>(~(difference | (0 - difference)) >> 63);
}

/// What the other side reads as a reason: see read_refusal.
bool is_reason(std::string_view text) {
  for (const char c : text) {
    if (c < ' ' || c > '~') return false;
  }
  return text.size() <= kReplayValueCap;
}

}  // namespace

void HostCore::tend_places(Time now) {
  const Time turn = now - turn_at_ < kLongestTurn ? now - turn_at_ : kLongestTurn;
  const Time passed = is_paused() ? 0 : turn;
  turn_at_ = now;
  for (Seat& seat : seats_) seat.idle = !started_ || seat.is_open ? 0 : seat.idle + passed;
  for (Guest& guest : guests_) {
    const bool is_silent = guest.is_connected && guest.stage == Guest::Stage::connected && !guest.must_close;
    if (!is_silent || now - guest.heard <= kGreeting) continue;
    guest.must_close = true;  // and not refused: a machine that stood still comes again
    ++stats_.refused;
  }
}

// --- what the game decides ---

HostCore::Guest* HostCore::applicant_of(std::uint64_t number) {
  for (Guest& guest : guests_) {
    if (guest.is_connected && guest.stage == Guest::Stage::applies && guest.applicant == number) return &guest;
  }
  return nullptr;
}

std::optional<Applicant> HostCore::poll_applicant() {
  for (Guest& guest : guests_) {
    if (!guest.is_connected || guest.stage != Guest::Stage::applies || guest.is_shown) continue;
    guest.is_shown = true;
    const Application& wish = guest.wish;
    return Applicant{guest.applicant, guest.peer, wish.spectator,
                     wish.seat,       wish.seats, first_of(players_of(wish.token)),
                     guest.credential};
  }
  return std::nullopt;
}

bool HostCore::admit(std::uint64_t applicant) {
  Guest* guest = applicant_of(applicant);
  return guest != nullptr && let_in(*guest);
}

bool HostCore::refuse(std::uint64_t applicant, std::string_view reason) {
  Guest* guest = applicant_of(applicant);
  if (guest == nullptr || !is_reason(reason)) return false;
  refuse(*guest, "admission", {}, reason);
  return true;
}

bool HostCore::kick(int player, std::string_view reason) {
  if (!is_guests(player) || !seats_[player].is_taken || !is_reason(reason)) return false;
  const int link = seats_[player].link;
  // Of one machine: those who are away are known by their token.
  std::uint32_t machine = 1u << player;
  for (int p = 0; p < players(); ++p) {
    const bool is_away_with = link < 0 && seats_[p].link < 0 && seats_[p].proof == seats_[player].proof;
    if (is_guests(p) && seats_[p].is_taken && is_away_with) machine |= 1u << p;
  }
  if (link >= 0) {
    machine = guests_[static_cast<std::size_t>(link)].players;
    send_away(guests_[static_cast<std::size_t>(link)], "kicked", {}, reason);
  }
  for (int p = 0; p < players(); ++p) {
    if ((machine >> p & 1) != 0) free_seat(p);
  }
  return true;
}

bool HostCore::kick_peer(PeerId peer, std::string_view reason) {
  if (peer >= guests_.size() || !guests_[peer].is_connected) return false;
  if (guests_[peer].player >= 0) return kick(guests_[peer].player, reason);
  if (!is_reason(reason)) return false;
  send_away(guests_[peer], "kicked", {}, reason);
  return true;
}

std::optional<PeerId> HostCore::peer_of(int player) const {
  if (!is_guests(player) || seats_[player].link < 0) return std::nullopt;
  return static_cast<PeerId>(seats_[player].link);
}

// --- seats ---

std::uint32_t HostCore::players_of(std::uint64_t token) const {
  if (token == 0) return 0;
  const std::uint64_t proof = proof_of(token);
  std::uint32_t found = 0;  // a bit for each player: how long it takes tells nothing of the tokens
  for (std::size_t p = 0; p < kMaxPlayers; ++p) {
    found |= (equals(proof, seats_[p].proof) | equals(proof, seats_[p].former_proof)) << p;
  }
  return found;
}

bool HostCore::is_free(int player) const {
  if (!is_guests(player)) return false;
  const Seat& seat = seats_[player];
  if (!seat.is_taken || !started_ || seat.is_open) return !seat.is_taken;
  // Who has a connection and does not play loses the seat as well: else whoever comes first keeps it for nothing.
  return seat.idle >= config_.reservation && (seat.link < 0 || seat.idle >= kJoining);
}

bool HostCore::is_away(int player) const {
  return is_guests(player) && seats_[player].is_taken && seats_[player].link < 0;
}

std::uint32_t HostCore::find_seats(Guest& guest) {
  const std::uint32_t own = players_of(guest.wish.token);
  // A token that is nobody's any more may come from a player who was away for too long: new, but not refused.
  if (own == 0 && guest.wish.token != 0) ++stats_.refused;
  return guest.wish.seat >= 0 ? wanted_seats(guest, own) : any_seats(guest, own);
}

std::uint32_t HostCore::wanted_seats(Guest& guest, std::uint32_t own) {
  const int first = guest.wish.seat, end = first + guest.wish.seats;
  const auto wanted = static_cast<std::uint32_t>(((std::uint64_t{1} << end) - 1) >> first << first);
  const bool is_other = own != 0 && (own & wanted) == 0;
  for (int p = first; p < end; ++p) {
    if (p < players() && ((own >> p & 1) != 0 || (!is_other && is_free(p)))) continue;
    ShortText<kReplayValueCap> number;
    number.append_number(static_cast<std::uint64_t>(p));
    refuse(guest, "seat", number.view(), is_other ? "another is yours" : is_away(p) ? "reserved" : "taken");
    return 0;
  }
  return wanted;
}

std::uint32_t HostCore::any_seats(Guest& guest, std::uint32_t own) {
  std::uint32_t found = 0;
  int left = guest.wish.seats;
  const auto take_those = [&](auto&& is_ours) {
    for (int p = 0; p < players() && left > 0; ++p) {
      if ((found >> p & 1) != 0 || !is_guests(p) || !is_ours(p)) continue;
      found |= 1u << p;
      --left;
    }
  };
  take_those([&](int p) { return (own >> p & 1) != 0; });
  take_those([&](int p) { return !seats_[p].is_taken; });
  take_those([&](int p) { return is_free(p); });
  if (left == 0) return found;
  bool is_reserved = false;
  for (int p = 0; p < players(); ++p) is_reserved = is_reserved || is_away(p);
  ShortText<kReplayValueCap> number;
  number.append_number(static_cast<std::uint64_t>(left));
  refuse(guest, "seats", left == 1 ? std::string_view("one more") : number.append(" more").view(),
         is_reserved ? "reserved" : "all taken");
  return 0;
}

void HostCore::take_seats(Guest& guest, std::uint32_t wanted) {
  const std::uint32_t own = players_of(guest.wish.token);
  // A host that follows another knows the tokens that the roster told of: where there may be one they stay the same.
  const bool keeps_token = own != 0 && config_.migration > 0;
  const std::uint64_t token = keeps_token ? guest.wish.token : draw(Purpose::token, tokens_++);
  // A process that the former host numbered after its last roster is as good as a new one: both are voters later.
  std::uint64_t life = 0;
  for (int p = 0; p < players(); ++p) {
    if ((own >> p & 1) != 0 && guest.wish.life != 0 && seats_[p].life == guest.wish.life) life = guest.wish.life;
  }
  if (life == 0) life = draw(Purpose::life, lives_++);
  for (int p = 0; p < players(); ++p) {
    const int link = seats_[p].link;
    const bool is_owner = (own >> p & 1) != 0;
    if (link < 0 || ((wanted | own) >> p & 1) == 0) continue;
    send_away(guests_[static_cast<std::size_t>(link)], "seat", {},
              is_owner ? "taken over from another address" : "not played on for too long");
  }
  for (int p = 0; p < players(); ++p) {
    if (((wanted | own) >> p & 1) == 0) continue;
    const bool is_kept = seats_[p].is_kept, is_owner = (own >> p & 1) != 0;
    free_seat(p);
    if ((wanted >> p & 1) == 0) continue;  // it comes back with fewer players
    Seat& seat = seats_[p];
    seat.is_taken = true;
    seat.link = static_cast<int>(guest.peer);
    seat.token = token;
    seat.life = life;
    seat.proof = proof_of(token);
    seat.former_proof = is_owner && !keeps_token ? proof_of(guest.wish.token) : 0;
    seat.is_kept = is_owner && is_kept;
  }
  guest.players = wanted;
  guest.player = first_of(wanted);
}

void HostCore::keep_seats(Guest& guest) {
  for (int p = 0; p < players(); ++p) {
    if (!has(guest, p) || !seats_[p].is_open) continue;
    seats_[p].is_kept = true;
    seats_[p].former_proof = 0;
  }
}

void HostCore::free_seat(int player) {
  // What the seat cost the others stays with it: who leaves and comes again has spent it.
  Seat empty;
  empty.lost = seats_[player].lost;
  empty.shut_until = seats_[player].shut_until;
  seats_[player] = empty;
}

void HostCore::send_away(Guest& guest, std::string_view key, std::string_view theirs, std::string_view ours) {
  unseat(guest);
  guest.stage = Guest::Stage::refused;
  guest.refusal = {ShortText<kReplayKeyCap>(key), ShortText<kReplayValueCap>(theirs), ShortText<kReplayValueCap>(ours)};
}

bool HostCore::has_room_for_spectator() const {
  int spectators = 0;
  for (const Guest& guest : guests_) {
    const bool is_served = guest.stage != Guest::Stage::connected && guest.stage != Guest::Stage::applies &&
                           guest.stage != Guest::Stage::refused;
    spectators += guest.is_connected && is_served && guest.player < 0 ? 1 : 0;
  }
  return spectators < config_.max_peers - (players() - std::popcount(hosted_));
}

}  // namespace isostep
