// The host decides about pauses and speeds, for its game and for players who ask.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

constexpr Time kOneAsk = kSecond;  // [us] of a guest: a pause is long, and its game shows each to somebody

}  // namespace

bool HostCore::wish_tempo(const Tempo& tempo) {
  // Peers count datagrams against their allowance: twice the match's rate goes through.
  const std::int64_t most = std::int64_t{config_.hz} * 2 * tempo.speed / Tempo::kNormal;
  if (!started_ || !Tempo::is_speed(tempo.speed) || most > std::int64_t{config_.most_packets}) return false;
  wished_ = tempo;
  has_wish_ = true;
  return true;
}

bool HostCore::pause(bool on) {
  Tempo tempo = latest_wish();
  tempo.is_paused = on;
  tempo.by = 0xff;
  return wish_tempo(tempo);
}

bool HostCore::set_speed(int speed) {
  if (!Tempo::is_speed(speed)) return false;
  Tempo tempo = latest_wish();
  tempo.speed = static_cast<std::uint8_t>(speed);
  tempo.by = 0xff;
  return wish_tempo(tempo);
}

void HostCore::grant_tempo() {
  // One after the other: what was announced is taken up first, by us.
  if (!has_wish_ || announced().number != tempo().number) return;
  has_wish_ = false;
  if (!wished_.same_as(tempo())) announce(wished_);
}

void HostCore::take_ask(Guest& guest, Bytes message) {
  const Result<Ask> read = read_ask(message);
  if (!read || !is_in_match(guest)) {
    ++stats_.refused;
    return;
  }
  const Ask ask = read.value();
  (ask.speed != 0 ? guest.asks_speed : guest.asks_pause) = ask;
}

void HostCore::answer_asks(Guest& guest, Time now) {
  if (now < guest.may_ask_at || (!guest.asks_pause && !guest.asks_speed)) return;
  guest.may_ask_at = now + kOneAsk;
  if (is_in_match(guest) && guest.asks_pause) answer(guest, *guest.asks_pause);
  if (is_in_match(guest) && guest.asks_speed) answer(guest, *guest.asks_speed);
  guest.asks_pause.reset();
  guest.asks_speed.reset();
}

void HostCore::answer(const Guest& guest, const Ask& ask) {
  Tempo tempo = latest_wish();
  tempo.by = static_cast<std::uint8_t>(guest.player);
  if (ask.speed != 0) tempo.speed = ask.speed;
  else tempo.is_paused = ask.is_paused;
  if (config_.players_set_tempo) {
    if (!wish_tempo(tempo)) ++stats_.refused;
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

}  // namespace isostep
