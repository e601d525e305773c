// Who gets which seat of the host's match, and for whom seats are kept.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/seats.hpp"

namespace isostep {
namespace {

/// [us] for who has a connection to have a state and others who agree with it, before its seat is anybody's.
constexpr Time kJoining = 30 * kSecond;

/// 1 when they are equal, without a branch that would tell how.
constexpr std::uint32_t equals(std::uint64_t a, std::uint64_t b) {
  const std::uint64_t difference = a ^ b;
  return static_cast<std::uint32_t>(~(difference | (0 - difference)) >> 63);
}

}  // namespace

Seats::Seats(const SessionConfig& config, std::uint32_t hosted, RecentLeast (&slack)[kMaxPlayers])
    : config_(config), hosted_(hosted), slack_(slack) {
  for (const int p : EachPlayer(hosted)) seats_[p].is_taken = seats_[p].is_open = true;
}

void Seats::resume(const SavedMatch& saved) {
  hosted_ = saved.hosted;
  for (int p = 0; p < config_.players; ++p) {
    seats_[p] = Seat{};
    seats_[p].proof = saved.proofs[p];
    seats_[p].is_kept = saved.proofs[p] != 0;
    seats_[p].is_taken = is_local(p) || seats_[p].is_kept;
    seats_[p].is_open = is_local(p);
  }
}

void Seats::take_over(const Roster& roster) {
  has_begun_ = true;
  for (int m = 0; m < roster.count; ++m) {
    for (const int p : EachPlayer(roster.machines[m].players)) {
      seats_[p].is_taken = seats_[p].is_kept = true;
      seats_[p].proof = roster.machines[m].proof;
      seats_[p].life = roster.machines[m].life;
      seats_[p].is_open = is_local(p);
    }
  }
}

void Seats::begin() {
  has_begun_ = true;
  for (int p = 0; p < config_.players; ++p) {
    if (seats_[p].is_taken && (is_local(p) || seats_[p].link >= 0)) seats_[p].is_open = true;
  }
}

std::uint32_t Seats::open() const {
  std::uint32_t players = 0;
  for (int p = 0; p < config_.players; ++p) players |= (seats_[p].is_open ? 1u : 0u) << p;
  return players;
}

std::uint32_t Seats::players_of(std::uint64_t token) const {
  if (token == 0) return 0;
  const std::uint64_t proof = proof_of(token);
  std::uint32_t found = 0;  // a bit for each player: how long it takes tells nothing of the tokens
  for (std::size_t p = 0; p < kMaxPlayers; ++p) {
    found |= (equals(proof, seats_[p].proof) | equals(proof, seats_[p].former_proof)) << p;
  }
  return found;
}

std::uint32_t Seats::away_with(int player) const {
  std::uint32_t machine = 1u << player;
  for (int p = 0; p < config_.players; ++p) {
    if (is_away(p) && seats_[p].proof == seats_[player].proof) machine |= 1u << p;
  }
  return machine;
}

bool Seats::is_free(int player) const {
  if (!is_guests(player)) return false;
  const Seat& seat = seats_[player];
  if (!seat.is_taken || !has_begun_ || seat.is_open) return !seat.is_taken;
  // Who has a connection and does not play loses the seat as well: else whoever comes first keeps it for nothing.
  return seat.idle >= config_.reservation && (seat.link < 0 || seat.idle >= kJoining);
}

std::uint32_t Seats::find(const Application& wish, Refusal& why) const {
  const std::uint32_t own = players_of(wish.token);
  return wish.seat >= 0 ? find_wanted(wish, own, why) : find_any(wish, own, why);
}

std::uint32_t Seats::find_wanted(const Application& wish, std::uint32_t own, Refusal& why) const {
  const int first = wish.seat, end = first + wish.seats;
  const auto wanted = static_cast<std::uint32_t>(((std::uint64_t{1} << end) - 1) >> first << first);
  const bool is_other = own != 0 && (own & wanted) == 0;
  for (int p = first; p < end; ++p) {
    if (p < config_.players && ((own >> p & 1) != 0 || (!is_other && is_free(p)))) continue;
    why = {"seat", {}, is_other ? "another is yours" : is_away(p) ? "reserved" : "taken"};
    why.in_file.append_number(static_cast<std::uint64_t>(p));
    return 0;
  }
  return wanted;
}

std::uint32_t Seats::find_any(const Application& wish, std::uint32_t own, Refusal& why) const {
  std::uint32_t found = 0, away = 0;
  int left = wish.seats;
  const auto take_those = [&](auto&& is_ours) {
    for (int p = 0; p < config_.players && left > 0; ++p) {
      if ((found >> p & 1) != 0 || !is_guests(p) || !is_ours(p)) continue;
      found |= 1u << p;
      --left;
    }
  };
  take_those([&](int p) { return (own >> p & 1) != 0; });
  take_those([&](int p) { return !seats_[p].is_taken; });
  take_those([&](int p) { return is_free(p); });
  if (left == 0) return found;
  for (int p = 0; p < config_.players; ++p) away |= (is_away(p) ? 1u : 0u) << p;
  why = {"seats", {}, away != 0 ? "reserved" : "all taken"};
  if (left == 1) why.in_file.append("one more");
  else why.in_file.append_number(static_cast<std::uint64_t>(left)).append(" more");
  return 0;
}

Seats::Claim Seats::claim(const Application& wish, std::uint32_t wanted, SecretNumbers& numbers) const {
  Claim claim{wanted, players_of(wish.token)};
  // A host that follows another knows the tokens of the roster alone: where there may be one they stay the same.
  claim.keeps_token = claim.own != 0 && config_.migration > 0;
  claim.token = claim.keeps_token ? wish.token : numbers.next_token();
  // A process that the former host numbered after its last roster is as good as a new one: both are voters later.
  for (const int p : EachPlayer(claim.own)) {
    if (wish.life != 0 && seats_[p].life == wish.life) claim.life = wish.life;
  }
  if (claim.life == 0) claim.life = numbers.next_life();
  return claim;
}

void Seats::take(Guest& guest, const Claim& claim) {
  for (const int p : EachPlayer(claim.wanted | claim.own)) {
    const bool is_kept = seats_[p].is_kept, is_owner = (claim.own >> p & 1) != 0;
    free(p);
    if ((claim.wanted >> p & 1) == 0) continue;  // it comes back with fewer players
    Seat& seat = seats_[p];
    seat.is_taken = true;
    seat.link = static_cast<int>(guest.peer);
    seat.token = claim.token;
    seat.life = claim.life;
    seat.proof = proof_of(claim.token);
    seat.former_proof = is_owner && !claim.keeps_token ? proof_of(guest.wish.token) : 0;
    seat.is_kept = is_owner && is_kept;
  }
  guest.players = claim.wanted;
  guest.player = first_of(claim.wanted);
}

void Seats::keep(const Guest& guest) {
  for (const int p : EachPlayer(guest.players)) {
    if (!seats_[p].is_open) continue;
    seats_[p].is_kept = true;
    seats_[p].former_proof = 0;
  }
}

void Seats::free(int player) {
  // What the seat cost the others stays with it: who leaves and comes again has spent it.
  Seat empty;
  empty.lost = seats_[player].lost;
  empty.shut_until = seats_[player].shut_until;
  seats_[player] = empty;
}

void Seats::close(const Guest& guest) {
  for (const int p : EachPlayer(guest.players)) {
    Seat& seat = seats_[p];
    if (!seat.is_open) continue;
    seat.is_open = false;
    seat.replaced_end = 0;
    seat.is_late = false;
    slack_[p] = RecentLeast{};
  }
}

void Seats::leave_out(const Guest& guest, Time now) {
  close(guest);
  const Time until = now + config_.exclusion;
  for (const int p : EachPlayer(guest.players)) seats_[p].shut_until = until < now ? ~Time{0} : until;  // for ever
}

void Seats::leave(Guest& guest) {
  close(guest);
  for (const int p : EachPlayer(guest.players)) {
    seats_[p].link = -1;
    if (!seats_[p].is_kept) free(p);
  }
  guest.players = 0;
  guest.player = -1;
}

void Seats::pass(Time time) {
  for (Seat& seat : seats_) seat.idle = !has_begun_ || seat.is_open ? 0 : seat.idle + time;
}

}  // namespace isostep
