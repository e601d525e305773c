// A host that follows another, and one that another follows.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/host_core.hpp"
#include "isostep/session/peer/peer_core.hpp"

namespace isostep {
namespace {

constexpr Time kFarewell = kSecond / 4;  // [us] in which all hear why the host gives way

}  // namespace

void HostCore::tend_inquiry(Time now) {
  std::uint64_t differing = 0;
  for (std::size_t p = 0; p < kMaxPlayers; ++p) differing |= (views_[p].differs() ? std::uint64_t{1} : 0) << p;
  if (!inquiry_.tend(guests_, differing, hashes_.settled(), now)) return;
  const Verdict verdict = views_.judge(inquiry_.statements(), events_);
  const bool is_ours = (verdict.minority >> kHostMachine & 1) != 0;
  if (is_ours && config_.repair && leadership_.could_others(verdict.minority)) steps_down_at_ = now + kFarewell;
}

std::unique_ptr<SessionCore> HostCore::succeed(Time now) {
  if (config_.migration == 0) return nullptr;
  const bool is_outvoted = steps_down_at_ != 0 && now >= steps_down_at_;
  const bool is_host = leadership_.turn(known_end(streams_), now);
  if (is_host && !is_outvoted && !is_too_slow_) return nullptr;
  tell_of(SessionEvent::Kind::deposed);
  return become_client(std::move(*this), leadership_.retreat(is_outvoted), now);
}

std::unique_ptr<SessionCore> become_host(PeerCore&& client, Succession&& succession, Time now) {
  return std::make_unique<HostCore>(std::move(client), std::move(succession), now);
}

HostCore::HostCore(PeerCore&& client, Succession&& succession, Time now)
    : PeerCore(std::move(client)),
      numbers_(config_.seed, succession.election.term()),
      seats_(config_, succession.roster.machines[succession.machine].players, slack_),
      guests_(static_cast<std::size_t>(config_.max_peers + config_.max_strangers)),
      match_(numbers_.match()) {
  config_.host = true;
  copy_match_settings(succession.roster.settings, config_);
  leadership_.take_over(succession, known_end(streams_), hashes_.settled().frame, now);
  seats_.take_over(succession.roster);
  for (RecentLeast& slack : slack_) slack = RecentLeast{};
  delay_.keep_to_most();  // no deadline replaces ours
  for (int p = 0; p < players(); ++p) seats_[p].replaced_told = stats_.players[p].replaced;
  for (std::size_t machine = 0; machine < kMachines; ++machine) views_.was_repaired(machine, kNoFrame);
  end_ballot(ballot_, current(), events_);
  tempos_.take_over();
  started_ = true;
  catches_up_to_ = 0;
  turn_at_ = now;
  deadline_.begin(now);
  clock_.forget_lean();
  clock_.start(now);
  go_at_pace_of(0xff, 0);
  tell(news_.goes_on(current()));
  phase_ = SessionPhase::playing;
  for (std::size_t i = 0; i < succession.callers.size(); ++i) {
    const Caller& caller = succession.callers[i];
    Guest* const guest = caller.is_connected ? guests_.place(static_cast<PeerId>(i)) : nullptr;
    if (guest == nullptr) continue;
    guest->connect(now);
    if (caller.hello.empty()) continue;
    const bool supports = succession.election.has_won_with(caller.voter);
    if (supports) guest->enrolled = succession.roster.version;
    admission_.greet(*guest, caller.hello);
    if (supports) guest->lease_from = succession.election.called_at();
    if (!guest->is_live()) continue;
    // Its players go on where their inputs end, and are told those that they do not know to be final.
    for (const int p : EachPlayer(guest->players)) {
      Seat& seat = seats_[p];
      seat.is_open = true;
      seat.replaced = guest->start;
      seat.replaced_end = streams_[static_cast<std::size_t>(p)].end();
      if (seat.replaced_end > guest->opens) guest->opens = seat.replaced_end;
    }
  }
  // It counts us among those who have come to it, for as long as we do not hang up.
  if (Guest* const asked = succession.asked ? guests_.place(*succession.asked) : nullptr) {
    asked->connect(now);
    asked->due.add(Due::close);
  }
  leadership_.reform_with(succession.election);
  tell_of(SessionEvent::Kind::new_host, local_player());
}

}  // namespace isostep
