// The host's roster: who could go on without it, and whether they do.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/leadership.hpp"

namespace isostep {
namespace {

bool same_machine(const Roster::Machine& a, const Roster::Machine& b) {
  return a.players == b.players && a.proof == b.proof && a.life == b.life && a.is_in == b.is_in &&
         a.was_in == b.was_in && a.address == b.address;
}
bool same_roster(const Roster& a, const Roster& b) {
  if (a.term != b.term || a.count != b.count || a.host != b.host || a.settings != b.settings) return false;
  if (a.casting != b.casting || a.was_casting != b.was_casting) return false;
  for (int m = 0; m < a.count; ++m) {
    if (!same_machine(a.machines[m], b.machines[m])) return false;
  }
  return true;
}

}  // namespace

Roster Leadership::drafted() const {
  Roster next;
  next.term = tenure_.term();
  next.version = roster_.version + 1;
  copy_match_settings(config_, next.settings);
  Roster::Machine& own = next.machines[next.count++];
  own = {seats_.hosted(), proof_of(own_token_), own_life_, true, true, config_.address};
  for (int p = 0; p < config_.players; ++p) {
    const Seat& seat = seats_[p];
    const int before = roster_.machine_with(p);
    const bool was_in = before >= 0 && roster_.machines[before].is_in;
    const int with = seat.is_taken ? next.machine_of_proof(seat.proof) : -1;
    if (with >= 0) next.machines[with].players |= 1u << p;
    // A machine whose players have gone is one, as before: it is found with the first of them.
    const bool is_first = before >= 0 && first_of(roster_.machines[before].players) == p;
    if (seats_.is_local(p) || with >= 0 || !(seat.is_taken || (was_in && is_first))) continue;
    Roster::Machine& machine = next.machines[next.count++];
    machine.players = 1u << p;
    machine.proof = seat.proof;
    machine.life = seat.life;
    const Roster::Machine& former = roster_.machines[before < 0 ? 0 : before];
    const bool is_same = before >= 0 && former.proof == seat.proof && former.life == seat.life;
    if (before >= 0 && !is_same && (former.is_in || former.was_in)) {
      // Another process in its place: first it goes, then the other comes, each with a majority of who was there.
      machine.proof = former.proof;
      machine.life = former.life;
      machine.was_in = former.is_in;
      continue;
    }
    const Guest* const guest = guests_.on(seat);
    machine.is_in = guest != nullptr && guest->is_live() && !guest->due.has(Due::close);
    machine.was_in = roster_.version == 0 ? machine.is_in : is_same && was_in;
    if (machine.is_in && seat.is_open) machine.address = guest->address;
  }
  const std::uint64_t caster = roster_.version == 0 ? own.proof : roster_.machines[roster_.casting].proof;
  const int caster_now = caster == 0 ? -1 : next.machine_of_proof(caster);
  next.casting = next.host;
  next.was_casting = caster_now < 0 ? Roster::kNoCasting : static_cast<std::uint8_t>(caster_now);
  return next;
}

int Leadership::voter_of(const Guest& guest) const {
  if (!guest.is_connected || guest.player < 0) return -1;
  const Seat& seat = seats_[guest.player];
  const int machine = roster_.machine_with(guest.player);
  if (machine < 0) return -1;
  const Roster::Machine& its = roster_.machines[machine];
  return its.proof == seat.proof && its.life == seat.life ? machine : -1;
}

Frame Leadership::end_at(const Guest& guest) const {
  Frame end = kLastFrame;
  for (int p = 0; p < config_.players; ++p) {
    // Its own inputs it has, but for those that were replaced and that it has not been told.
    const bool is_its = guest.has(p) && seats_[p].is_open && seats_[p].replaced_end == 0;
    const Frame its = is_its ? streams_[static_cast<std::size_t>(p)].end() : guest.acked[p];
    if (its < end) end = its;
  }
  return end;
}

void Leadership::look_at_followers(Time now) {
  for (Follower& follower : followers_) follower = Follower{};
  for (const Guest& guest : guests_) {
    const int machine = voter_of(guest);
    if (machine < 0 || !guest.is_live()) continue;
    followers_[machine].heard = guest.lease_from;
    followers_[machine].has = end_at(guest);
  }
  for (int m = 0; m < roster_.count; ++m) {
    const int player = first_of(roster_.machines[m].players);
    if (m == roster_.host || player < 0) continue;
    const Seat& seat = seats_[player];
    const bool is_another = seat.link >= 0 && seat.life != roster_.machines[m].life;
    // Who was cut off instead comes back before that, or is heard of as who looks for another host.
    const bool has_left = seat.link < 0 && seat.left_at != 0 && now - seat.left_at >= config_.migration + kSecond;
    followers_[m].is_over = is_another || has_left;
  }
}

template <class Predicate> std::uint64_t Leadership::group(const Predicate& is_counted) const {
  std::uint64_t group = std::uint64_t{1} << roster_.host;
  for (const Guest& guest : guests_) {
    const int machine = voter_of(guest);
    if (machine >= 0 && is_counted(guest)) group |= std::uint64_t{1} << machine;
  }
  return group;
}

std::uint64_t Leadership::here(Time now) const {
  return group([&](const Guest& guest) { return guest.is_live() && now - guest.heard <= config_.migration; });
}

void Leadership::keep_roster() {
  if (config_.migration == 0 || !has_begun()) return;
  const std::uint64_t enrolled = group([&](const Guest& guest) { return guest.enrolled == roster_.version; });
  if (roster_.version > 0 && !tenure_.may_go_on_to_next(roster_, enrolled, followers_)) return;
  const Roster next = drafted();
  if (!same_roster(next, roster_)) replace(next);
}

void Leadership::replace(const Roster& next) {
  roster_ = next;
  for (int m = 0; m < roster_.count; ++m) {
    const int player = std::countr_zero(roster_.machines[m].players);
    const std::uint64_t token = m == roster_.host ? own_token_ : seats_[player].token;
    roster_.machines[m].seal = token == 0 ? 0 : seal_of(roster_, token, scratch_);
  }
  stats_.machines = next.count_in();
  for (Guest& guest : guests_) guest.due.set(Due::roster, guest.is_live());
}

void Leadership::reform(std::uint64_t group) {
  Roster next = drafted();
  for (int m = 0; m < next.count; ++m) {
    Roster::Machine& machine = next.machines[m];
    const int before = roster_.machine_with(first_of(machine.players));
    const bool stays = m == next.host || (before >= 0 && (group >> before & 1) != 0);
    machine.is_in = machine.was_in = stays;
  }
  next.casting = next.was_casting = next.host;
  replace(next);
}

bool Leadership::go_on(Time now) {
  if (roster_.version == 0 || tenure_.is_backed()) return false;
  const std::uint64_t stay = here(now);
  for (Guest& guest : guests_) {
    const int machine = voter_of(guest);
    if (machine < 0 || (stay >> machine & 1) != 0) continue;
    guest.due.add(Due::close);  // it may come again, as one that was away
    seats_.close(guest);
  }
  reform(stay);
  return true;
}

bool Leadership::could_others(std::uint64_t unfit) const {
  std::uint64_t others = 0;
  bool has_candidate = false;
  for (int m = 0; m < roster_.count; ++m) {
    const Roster::Machine& machine = roster_.machines[m];
    if (m == roster_.host || !machine.is_in || machine.players == 0) continue;
    others |= std::uint64_t{1} << m;
    const bool is_right = (unfit >> first_of(machine.players) & 1) == 0;
    has_candidate = has_candidate || (is_right && !machine.address.view().empty());
  }
  return has_candidate && roster_.is_majority(others);
}

bool Leadership::turn(Frame known_end, Time now) {
  look_at_followers(now);
  if (!has_begun()) return !is_over_;
  const Tenure::Duty duty = tenure_.turn(roster_, {followers_, roster_.count}, known_end, now);
  if (duty == Tenure::Duty::reforms) reform(here(now));
  return duty != Tenure::Duty::steps_down && !is_over_;
}

Retreat Leadership::retreat(bool is_outvoted) const {
  Retreat retreat{roster_, seats_.hosted(), own_token_, own_life_, {}, 0, {}, is_outvoted};
  retreat.election.follow(tenure_.term());
  retreat.election.has_log_of(tenure_.term());
  for (int m = 0; m < roster_.count; ++m) {
    if (followers_[m].is_over) retreat.over |= std::uint64_t{1} << m;
  }
  for (const Guest& guest : guests_) {
    if (guest.is_connected) retreat.guests.push_back(guest.peer);
  }
  return retreat;
}

void Leadership::take_over(const Succession& succession, Frame known_end, Frame final_end, Time now) {
  inherited_ = roster_ = succession.roster;
  roster_.host = static_cast<std::uint8_t>(succession.machine);
  roster_.term = succession.election.term();
  know_ourselves(succession.token, succession.life);
  // What is final somewhere ends before that: we have all of it.
  tenure_.begin(roster_.term, config_.migration, known_end, final_end, now);
}

void Leadership::reform_with(const Election& election) {
  if (!election.has_majority(inherited_)) reform(election.supporters());
}

void Leadership::hear(const Application& wish) {
  // Nobody follows an earlier host than it has known: the others decide anew.
  is_over_ = is_over_ || (roster_.voter_of(wish.token, wish.life) >= 0 && wish.term > tenure_.term());
}

}  // namespace isostep
