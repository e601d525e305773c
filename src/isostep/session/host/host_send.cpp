// What the host sends: messages, snapshots for late joiners, datagrams.
// SPDX-License-Identifier: MIT
#include "isostep/session/host/host_core.hpp"

namespace isostep {

std::optional<Outgoing> HostCore::poll_send(Time now) {
  for (std::size_t i = 0; i < guests_.size(); ++i) {
    Guest& guest = guests_.next_in_turn();
    if (!guest.is_connected) continue;
    if (std::optional<Outgoing> out = next_message(guest, now)) {
      guests_.stay_with(guest);  // all of its messages, in order
      return out;
    }
    if (std::optional<Outgoing> out = next_datagram(guest, now)) return out;
  }
  return std::nullopt;
}

std::optional<Outgoing> HostCore::next_message(Guest& guest, Time now) {
  const auto message = [&] {
    stats_.bytes_out += message_.size();
    return Outgoing{guest.peer, Channel::reliable, message_};
  };
  if (guest.due.has(Due::close)) {
    drop(guest);
    return Outgoing{guest.peer, Channel::reliable, {}, true};
  }
  if (guest.stage == Guest::Stage::receives_snapshot && awaits_capture()) return std::nullopt;
  // The game has no portable form.
  if (guest.stage == Guest::Stage::receives_snapshot && portable_.empty())
    admission_.refuse(guest, {"snapshot", "needed", "none"});
  if (guest.stage == Guest::Stage::refused) {
    guest.due.add(Due::close);
    write_refusal(guest.refusal, message_);
    return message();
  }
  const bool joins = guest.stage == Guest::Stage::receives_snapshot;
  if (!joins && !guest.is_live()) return std::nullopt;
  // Who joins hears nothing else before it is there.
  std::optional<Due> due = joins && !guest.due.has(Due::welcome) ? std::nullopt : guest.due.first();
  if (due == Due::offer && awaits_capture()) {
    due = guest.due.first_but(Due::offer);
  } else if ((!due || due == Due::open) && guest.receives_snapshot()) {
    if (snapshots_.next_piece(guest, now, message_)) return message();
  }
  if (!due) return std::nullopt;
  guest.due.drop(*due);
  switch (*due) {
    case Due::close: break;  // see above
    case Due::welcome: write_welcome(welcome_for(guest), message_); break;
    case Due::roster: write_roster(leadership_.roster(), message_); break;
    case Due::ballot: write_ballot(ballot_, message_); break;
    case Due::inquiry: write_inquiry(inquiry_.statements().frame, message_); break;
    case Due::statements: write_statements(inquiry_.statements(), message_); break;
    case Due::repaired: {
      const int player = first_of(guest.repair.tells);
      guest.repair.tells &= guest.repair.tells - 1;
      guest.due.set(Due::repaired, guest.repair.tells != 0);
      write_repaired({static_cast<std::uint8_t>(player), views_[player].after}, message_);
      break;
    }
    case Due::offer:
      snapshots_.begin_repair(guest);
      write_offer({snapshots_.state(), snapshots_.hash(), guest.transfer.progress().size}, message_);
      break;
    case Due::open: write_open(guest.opens, message_); break;
  }
  return message();
}

Welcome HostCore::welcome_for(Guest& guest) {
  Welcome welcome;
  welcome.match = match_;
  welcome.players = static_cast<std::uint8_t>(players());
  welcome.hosted = seats_.hosted();
  if (guest.player >= 0) {
    welcome.player = static_cast<std::uint8_t>(guest.player);
    welcome.others = guest.players & (guest.players - 1);  // without the first
    welcome.token = seats_[guest.player].token;
    welcome.life = seats_[guest.player].life;
  }
  if (config_.migration > 0) {
    welcome.term = leadership_.term();
    welcome.term_start = leadership_.tenure().start();
  }
  if (guest.is_live()) {
    welcome.start = {guest.start, guest.start_chain};
  } else {
    snapshots_.begin(guest);
    welcome.start = snapshots_.state();
    welcome.hash = snapshots_.hash();
    welcome.snapshot_size = guest.transfer.progress().size;
    welcome.snapshot_from = guest.transfer.progress().arrived;
    if (guest.transfer.is_complete()) boarding_.go_live(guest, guest.start);
  }
  welcome.opens = guest.opens;
  return welcome;
}

std::optional<Outgoing> HostCore::next_datagram(Guest& guest, Time now) {
  const bool sending = guest.stage == Guest::Stage::receives_snapshot;
  if (!guest.is_live() && !(sending && guest.transfer.is_answered())) return std::nullopt;
  const Frame most = sending ? 0 : flow_.most_frames(guest, now);
  if ((most == 0 && !sending) || !guest.may_send(current(), clock_.period(), now)) return std::nullopt;
  PacketHeader header;
  header.match = match_;
  header.started = started_;
  header.is_far = guest.is_far;
  header.stretch = static_cast<std::uint8_t>(stats_.stretch);
  header.slowest = static_cast<std::uint8_t>(news_.slowest());
  header.waits_for = news_.waits_for();
  header.tempo = tempos_.announced();
  if (config_.migration > 0) header.final_end = leadership_.tenure().final_end();
  // A closed seat acknowledges nothing: its frames are not the player's, who would take its own for accepted.
  for (const int p : EachPlayer(guest.players)) {
    Seat& seat = seats_[p];
    if (!seat.is_open) continue;
    header.ack_mask |= 1u << p;
    // What took the place of its own inputs it has to know before they count as had.
    if (guest.acked[p] >= seat.replaced_end) seat.replaced_end = 0;
    header.ack[p] = seat.replaced_end > 0 ? seat.replaced : streams_[static_cast<std::size_t>(p)].end();
    header.slack[p] = static_cast<std::int8_t>(lines_.told_slack(guest, p, current(), stats_.stretch > 0));
  }
  // One other machine's word on its states with every datagram, in turns.
  for (std::size_t i = 0; i < guests_.size(); ++i) {
    guest.next_reporter = (guest.next_reporter + 1) % guests_.size();
    const Guest& other = guests_[guest.next_reporter];
    if (&other == &guest || other.player < 0 || other.report.frame == kNoFrame) continue;
    header.reporter = static_cast<std::uint8_t>(other.player);
    header.passed_on = other.report;
    break;
  }
  if (guest.figures_left > 0 && !sending) {
    header.figured = static_cast<std::uint8_t>(--guest.figures_left);
    header.figures = stats_.players[header.figured];
  }
  flow_.note_held_back(guest, current());
  const Bytes bytes = datagrams_.compose(guest, header, flow_.ends(guest), present(), most, now);
  if (!sending) flow_.was_sent(guest, bytes.size(), now);
  return Outgoing{guest.peer, Channel::datagram, bytes};
}

}  // namespace isostep
