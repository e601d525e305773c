// What the host's game and its guests' players ask for, by themselves or by vote: pauses, speeds, and kicks.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

constexpr Time kOneAsk = kSecond;  // [us] of a guest: a pause is long, and its game shows each to somebody

}  // namespace

bool HostCore::pause(bool on) {
  Tempo tempo = tempo_desk_.latest(announced());
  tempo.is_paused = on;
  tempo.by = 0xff;
  return started_ && tempo_desk_.wish(tempo);
}

bool HostCore::set_speed(int speed) {
  if (!started_ || !Tempo::is_speed(speed)) return false;
  Tempo tempo = tempo_desk_.latest(announced());
  tempo.speed = static_cast<std::uint8_t>(speed);
  tempo.by = 0xff;
  return tempo_desk_.wish(tempo);
}

void HostCore::answer_asks(Guest& guest, Time now) {
  if (now < guest.may_ask_at || (!guest.asks_pause && !guest.asks_speed)) return;
  guest.may_ask_at = now + kOneAsk;
  for (std::optional<Ask>* asks : {&guest.asks_pause, &guest.asks_speed}) {
    if (*asks && seats_.play(guest)) answer(guest, **asks);
    asks->reset();
  }
}

void HostCore::answer(const Guest& guest, const Ask& ask) {
  Tempo tempo = tempo_desk_.latest(announced());
  tempo.by = static_cast<std::uint8_t>(guest.player);
  if (ask.speed != 0) tempo.speed = ask.speed;
  else tempo.is_paused = ask.is_paused;
  if (config_.players_set_tempo) {
    if (!tempo_desk_.wish(tempo)) ++stats_.refused;
    return;
  }
  SessionEvent event{.kind = ask.speed != 0  ? SessionEvent::Kind::asks_speed
                             : ask.is_paused ? SessionEvent::Kind::asks_pause
                                             : SessionEvent::Kind::asks_unpause,
                     .player = tempo.by,
                     .frame = current()};
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
  tell_ballot();
  if (ballot_.outcome != Ballot::Outcome::passed) return true;
  const auto subject = static_cast<int>(ballot_.proposal.subject);
  Tempo tempo = tempo_desk_.latest(announced());
  tempo.by = ballot_.by;
  switch (ballot_.proposal.kind) {
    case Proposal::Kind::pause: tempo.is_paused = true; break;
    case Proposal::Kind::unpause: tempo.is_paused = false; break;
    case Proposal::Kind::speed: tempo.speed = static_cast<std::uint8_t>(subject); break;
    case Proposal::Kind::kick: static_cast<void>(kick(subject, "voted out")); return true;
    case Proposal::Kind::other: return true;
  }
  if (!tempo_desk_.wish(tempo)) ++stats_.refused;
  return true;
}

}  // namespace isostep
