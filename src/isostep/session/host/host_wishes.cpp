// What the host's game and its guests' players ask for, by themselves or by vote: pauses, speeds, and kicks.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/host_core.hpp"

namespace isostep {
namespace {

constexpr Time kOneAsk = kSecond;  // [us] of a guest: a pause is long, and its game shows each to somebody

}  // namespace

bool HostCore::pause(bool on) { return started_ && tempo_desk_.wish_pause(on, 0xff); }

bool HostCore::set_speed(int speed) { return started_ && tempo_desk_.wish_speed(speed, 0xff); }

void HostCore::answer_asks(Guest& guest, Time now) {
  if (now < guest.may_ask_at || (!guest.asks_pause && !guest.asks_speed)) return;
  guest.may_ask_at = now + kOneAsk;
  for (std::optional<Ask>* asks : {&guest.asks_pause, &guest.asks_speed}) {
    if (*asks && seats_.play(guest)) answer(static_cast<std::uint8_t>(guest.player), **asks);
    asks->reset();
  }
}

void HostCore::answer(std::uint8_t player, const Ask& ask) {
  const bool is_speed = ask.speed != 0;
  if (config_.players_set_tempo) {
    const bool is_good =
        is_speed ? tempo_desk_.wish_speed(ask.speed, player) : tempo_desk_.wish_pause(ask.is_paused, player);
    if (!is_good) ++stats_.refused;
    return;
  }
  using Kind = SessionEvent::Kind;
  SessionEvent event{.kind = is_speed ? Kind::asks_speed : ask.is_paused ? Kind::asks_pause : Kind::asks_unpause};
  event.player = player;
  event.frame = current();
  event.speed = ask.speed;
  tell(event);
}

bool HostCore::propose(int player, const Proposal& proposal) {
  return started_ && is_local(player) && voted(ballot_box_.open(player, proposal, turn_at_));
}

bool HostCore::vote(int player, bool yes) {
  const std::uint32_t bit = is_local(player) ? 1u << player : 0;
  const Votes votes{ballot_.number, yes ? bit : 0, yes ? 0 : bit};
  return bit != 0 && voted(ballot_box_.count(votes, seats_.hosted(), turn_at_));
}

bool HostCore::take_vote(const Guest& guest, MessageKind kind, Bytes message) {
  if (kind == MessageKind::vote) {
    const Result<Votes> votes = read_votes(message);
    return votes && voted(ballot_box_.count(votes.value(), guest.players, turn_at_));
  }
  const Result<PlayersProposal> read = read_proposal(message);
  return read && seats_.play(guest) && guest.has(read.value().player) &&
         voted(ballot_box_.open(read.value().player, read.value().proposal, turn_at_));
}

bool HostCore::voted(BallotBox::Effect effect) {
  if (effect != BallotBox::Effect::changed) return effect == BallotBox::Effect::same;
  tell(event_of(ballot_, current()));
  if (ballot_.outcome != Ballot::Outcome::passed) return true;
  const auto subject = static_cast<int>(ballot_.proposal.subject);
  bool is_done = true;
  switch (ballot_.proposal.kind) {
    case Proposal::Kind::pause: is_done = tempo_desk_.wish_pause(true, ballot_.by); break;
    case Proposal::Kind::unpause: is_done = tempo_desk_.wish_pause(false, ballot_.by); break;
    case Proposal::Kind::speed: is_done = tempo_desk_.wish_speed(subject, ballot_.by); break;
    case Proposal::Kind::kick: static_cast<void>(kick(subject, "voted out")); break;
    case Proposal::Kind::other: break;
  }
  if (!is_done) ++stats_.refused;
  return true;
}

}  // namespace isostep
