// The host's roster: who could go on without it, whether they do, and a host that follows another.
// SPDX-License-Identifier: MIT
#include "isostep/session/client_core.hpp"
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

constexpr Time kDeposed = kSecond;  // [us] beyond `migration`, in which who was silent may be heard again

bool same_machine(const Roster::Machine& a, const Roster::Machine& b) {
  return a.players == b.players && a.proof == b.proof && a.is_in == b.is_in && a.was_in == b.was_in &&
         a.address == b.address;
}
bool same_roster(const Roster& a, const Roster& b) {
  if (a.count != b.count || a.host != b.host) return false;
  for (int m = 0; m < a.count; ++m) {
    if (!same_machine(a.machines[m], b.machines[m])) return false;
  }
  return true;
}

}  // namespace

Roster HostCore::drafted() const {
  Roster next;
  next.version = roster_.version + 1;
  Roster::Machine& own = next.machines[next.count++];
  own = {hosted_, proof_of(own_token_), true, true, config_.address};
  for (int p = 0; p < players(); ++p) {
    const Seat& seat = seats_[p];
    const int before = roster_.machine_with(p);
    const bool was_in = before >= 0 && roster_.machines[before].is_in;
    const int with = seat.is_taken ? next.machine_of_proof(seat.proof) : -1;
    if (with >= 0) next.machines[with].players |= 1u << p;
    // A machine whose players have gone is one, as before: it is found with the first of them.
    const bool is_first = before >= 0 && first_of(roster_.machines[before].players) == p;
    if (is_local(p) || with >= 0 || !(seat.is_taken || (was_in && is_first))) continue;
    Roster::Machine& machine = next.machines[next.count++];
    machine.players = 1u << p;
    machine.proof = seat.proof;
    const Guest* guest = seat.link < 0 ? nullptr : &guests_[static_cast<std::size_t>(seat.link)];
    machine.is_in = guest != nullptr && guest->stage == Guest::Stage::live;
    machine.was_in = roster_.version == 0 ? machine.is_in : was_in;
    if (machine.is_in && seat.is_open) machine.address = guest->address;
  }
  return next;
}

template <class Predicate> std::uint64_t HostCore::group(Predicate&& is_counted) const {
  std::uint64_t group = std::uint64_t{1} << roster_.host;
  for (const Guest& guest : guests_) {
    const int machine = guest.is_connected ? roster_.machine_with(guest.player) : -1;
    if (machine >= 0 && is_counted(guest)) group |= std::uint64_t{1} << machine;
  }
  return group;
}

void HostCore::keep_roster() {
  if (config_.migration == 0 || !started_) return;
  const auto has_it = [&](const Guest& guest) { return guest.enrolled == roster_.version; };
  if (roster_.version > 0 && !roster_.is_majority(group(has_it))) return;
  const Roster next = drafted();
  if (same_roster(next, roster_)) return;
  roster_ = next;
  for (int m = 0; m < roster_.count; ++m) {
    const int player = std::countr_zero(roster_.machines[m].players);
    const std::uint64_t token = m == roster_.host ? own_token_ : seats_[player].token;
    roster_.machines[m].seal = token == 0 ? 0 : seal_of(roster_, token, message_);
  }
  stats_.machines = next.count_in();
  for (Guest& guest : guests_) guest.must_enroll = guest.stage == Guest::Stage::live;
}

void HostCore::count_backers(Time now) {
  const auto is_heard = [&](const Guest& guest) { return now - guest.heard <= config_.migration; };
  is_backed_ = roster_.version == 0 || roster_.is_majority(group(is_heard));
  if (is_backed_) backed_at_ = now;
}

std::unique_ptr<SessionCore> HostCore::succeed(Time now) {
  const bool steps_down = steps_down_at_ != 0 && now >= steps_down_at_;
  if (!steps_down && (is_backed_ || now - backed_at_ <= config_.migration + kDeposed)) return nullptr;
  Retreat retreat{roster_, hosted_, own_token_, {}, steps_down};
  for (const Guest& guest : guests_) {
    if (guest.is_connected) retreat.guests.push_back(guest.peer);
  }
  SessionEvent event{.kind = SessionEvent::Kind::deposed, .frame = current()};
  tell(event);
  return std::make_unique<ClientCore>(std::move(*this), std::move(retreat), now);
}

HostCore::HostCore(PeerCore&& client, Succession&& succession, Time now)
    : PeerCore(std::move(client)),
      hosted_(succession.roster.machines[succession.machine].players),
      guests_(static_cast<std::size_t>(config_.max_peers + config_.max_strangers)),
      match_(draw(Purpose::match, 0)) {
  config_.host = true;
  roster_ = succession.roster;
  roster_.host = static_cast<std::uint8_t>(succession.machine);
  own_token_ = succession.token;
  for (std::size_t i = 0; i < guests_.size(); ++i) guests_[i].peer = static_cast<PeerId>(i);
  for (int m = 0; m < roster_.count; ++m) {
    for (int p = 0; p < players(); ++p) {
      if ((roster_.machines[m].players >> p & 1) == 0) continue;
      seats_[p].is_taken = seats_[p].is_kept = true;
      seats_[p].proof = roster_.machines[m].proof;
      seats_[p].is_open = is_local(p);
    }
  }
  for (RecentLeast& slack : slack_) slack = RecentLeast{};
  delay_.keep_to_most();  // no deadline replaces ours
  for (int p = 0; p < players(); ++p) seats_[p].replaced_told = stats_.players[p].replaced;
  for (std::size_t machine = 0; machine < kMachines; ++machine) was_repaired(machine, kNoFrame);
  end_ballot();
  started_ = true;
  began_ = turn_at_ = backed_at_ = now;
  clock_.forget_lean();
  clock_.start(now);
  go_at_pace_of(0xff, 0);
  goes_on();
  phase_ = SessionPhase::playing;
  for (std::size_t i = 0; i < succession.callers.size() && i < guests_.size(); ++i) {
    const Caller& caller = succession.callers[i];
    if (!caller.is_connected) continue;
    guests_[i].connect(now);
    used_ = i + 1;
    if (caller.hello.empty()) continue;
    if (caller.supports) guests_[i].enrolled = roster_.version;
    greet(guests_[i], caller.hello);
    if (guests_[i].stage == Guest::Stage::applies && caller.supports) let_in(guests_[i]);
    resume(guests_[i]);
  }
  SessionEvent event{.kind = SessionEvent::Kind::new_host, .player = static_cast<std::uint8_t>(local_player())};
  event.frame = current();
  tell(event);
}

void HostCore::resume(Guest& guest) {
  if (guest.stage != Guest::Stage::live) return;
  for (int p = 0; p < players(); ++p) {
    if (!has(guest, p)) continue;
    Seat& seat = seats_[p];
    seat.is_open = true;
    seat.replaced = guest.start;
    seat.replaced_end = streams_[static_cast<std::size_t>(p)].end();
    if (seat.replaced_end > guest.opens) guest.opens = seat.replaced_end;
  }
}

}  // namespace isostep
