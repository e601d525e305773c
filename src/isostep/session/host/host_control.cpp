// What the host's game and its guests' players ask for, by themselves or by vote: pauses, speeds, and kicks.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/host_control.hpp"

namespace isostep {
namespace {

constexpr Time kOneAsk = kSecond;  // [us] of a guest: a pause is long, and its game shows each to somebody

}  // namespace

void HostControl::answer_asks(Guest& guest, Time now) {
  if (now < guest.may_ask_at || (!guest.asks_pause && !guest.asks_speed)) return;
  guest.may_ask_at = now + kOneAsk;
  for (std::optional<Ask>* asks : {&guest.asks_pause, &guest.asks_speed}) {
    if (*asks && host_.seats.play(guest)) answer(static_cast<std::uint8_t>(guest.player), **asks);
    asks->reset();
  }
}

void HostControl::answer(std::uint8_t player, const Ask& ask) {
  const bool is_speed = ask.speed != 0;
  if (host_.config.players_set_tempo) {
    const bool is_good =
        is_speed ? tempo_desk_.wish_speed(ask.speed, player) : tempo_desk_.wish_pause(ask.is_paused, player);
    if (!is_good) ++host_.stats.refused;
    return;
  }
  using Kind = SessionEvent::Kind;
  SessionEvent event{.kind = is_speed ? Kind::asks_speed : ask.is_paused ? Kind::asks_pause : Kind::asks_unpause};
  event.player = player;
  event.frame = host_.timeline.current();
  event.speed = ask.speed;
  host_.events.tell(event);
}

bool HostControl::propose(int player, const Proposal& proposal) {
  return host_.has_begun && host_.seats.is_local(player) && voted(ballot_box_.open(player, proposal, host_.now));
}

bool HostControl::vote(int player, bool yes) {
  const std::uint32_t bit = host_.seats.is_local(player) ? 1u << player : 0;
  const Votes votes{ballot_.number, yes ? bit : 0, yes ? 0 : bit};
  return bit != 0 && voted(ballot_box_.count(votes, host_.seats.hosted(), host_.now));
}

bool HostControl::receive(Guest& guest, MessageKind kind, Bytes message) {
  if (kind == MessageKind::vote) {
    const Result<Votes> votes = read_votes(message);
    return votes && voted(ballot_box_.count(votes.value(), guest.players, host_.now));
  }
  if (kind == MessageKind::ask) {
    const Result<Ask> ask = read_ask(message);
    const bool is_good = ask && host_.seats.play(guest);
    if (is_good) (ask.value().speed != 0 ? guest.asks_speed : guest.asks_pause) = ask.value();
    return is_good;
  }
  const Result<PlayersProposal> read = read_proposal(message);
  return read && host_.seats.play(guest) && guest.has(read.value().player) &&
         voted(ballot_box_.open(read.value().player, read.value().proposal, host_.now));
}

void HostControl::tend(Time now) {
  if (ballot_box_.must_tell(now)) {
    for (Guest& guest : host_.guests) guest.due.set(Due::ballot, guest.is_live());
  }
  voted(ballot_box_.tend(now));
}

bool HostControl::voted(BallotBox::Effect effect) {
  if (effect != BallotBox::Effect::changed) return effect == BallotBox::Effect::same;
  host_.events.tell(event_of(ballot_, host_.timeline.current()));
  if (ballot_.outcome != Ballot::Outcome::passed) return true;
  const auto subject = static_cast<int>(ballot_.proposal.subject);
  bool is_done = true;
  switch (ballot_.proposal.kind) {
    case Proposal::Kind::pause: is_done = tempo_desk_.wish_pause(true, ballot_.by); break;
    case Proposal::Kind::unpause: is_done = tempo_desk_.wish_pause(false, ballot_.by); break;
    case Proposal::Kind::speed: is_done = tempo_desk_.wish_speed(subject, ballot_.by); break;
    case Proposal::Kind::kick: static_cast<void>(admission_.kick(subject, "voted out")); break;
    case Proposal::Kind::other: break;
  }
  if (!is_done) ++host_.stats.refused;
  return true;
}

}  // namespace isostep
