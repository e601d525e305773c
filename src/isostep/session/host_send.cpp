// What the host sends: messages, snapshots for late joiners, datagrams.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"

namespace isostep {

std::optional<Outgoing> HostCore::poll_send(Time now) {
  for (std::size_t i = 0; i < used_; ++i) {
    Guest& guest = guests_[next_guest_];
    next_guest_ = (next_guest_ + 1) % used_;
    if (!guest.is_connected) continue;
    if (std::optional<Outgoing> out = next_message(guest, now)) {
      next_guest_ = guest.peer;  // all of its messages, in order
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
  if (guest.stage == Guest::Stage::refused && !guest.must_close) {
    guest.must_close = true;
    write_refusal(guest.refusal, message_);
    return message();
  }
  if (guest.must_close) {
    const PeerId peer = guest.peer;
    drop(guest);
    return Outgoing{peer, Channel::reliable, {}, true};
  }
  const bool sending = guest.stage == Guest::Stage::receives_snapshot;
  if (sending && awaits_capture()) return std::nullopt;
  if (sending && portable_.empty()) {  // the game has no portable form
    unseat(guest);
    refuse(guest, "snapshot", "needed", "none");
    return next_message(guest, now);
  }
  if (guest.must_welcome && (sending || guest.stage == Guest::Stage::live)) {
    guest.must_welcome = false;
    Welcome welcome;
    welcome.match = match_;
    welcome.players = static_cast<std::uint8_t>(players());
    welcome.hosted = hosted_;
    welcome.player = guest.player < 0 ? 0xff : static_cast<std::uint8_t>(guest.player);
    welcome.others = guest.player < 0 ? 0 : guest.players & (guest.players - 1);  // without the first
    welcome.token = guest.player < 0 ? 0 : seats_[guest.player].token;
    welcome.life = guest.player < 0 ? 0 : seats_[guest.player].life;
    welcome.term = config_.migration > 0 ? (started_ ? tenure_.term() : first_term_) : 0;
    welcome.term_start = config_.migration > 0 ? tenure_.start() : 0;
    welcome.start = sending ? snapshot_ : HashReport{guest.start, guest.start_chain};
    welcome.hash = sending ? snapshot_hash_ : 0;  // it has that state
    if (sending) {
      begin_transfer(guest);
      welcome.snapshot_size = guest.transfer.progress().size;
      welcome.snapshot_from = guest.transfer.progress().arrived;
      if (guest.transfer.is_complete()) go_live(guest, guest.start);
    }
    welcome.opens = guest.opens;
    write_welcome(welcome, message_);
    return message();
  }
  if (sending) {
    if (std::optional<Outgoing> out = next_piece(guest, now)) return out;
  }
  if (guest.must_enroll && guest.stage == Guest::Stage::live) {
    guest.must_enroll = false;
    write_roster(roster_, message_);
    return message();
  }
  if (guest.must_tell_ballot && guest.stage == Guest::Stage::live) {
    guest.must_tell_ballot = false;
    write_ballot(ballot_, message_);
    return message();
  }
  if (std::optional<Outgoing> out = next_repair_message(guest, now)) return out;
  if (guest.must_open) {
    guest.must_open = false;
    write_open(guest.opens, message_);
    return message();
  }
  return std::nullopt;
}

std::optional<Outgoing> HostCore::next_datagram(Guest& guest, Time now) {
  const bool sending = guest.stage == Guest::Stage::receives_snapshot;
  if (guest.stage != Guest::Stage::live && !(sending && guest.transfer.is_answered())) return std::nullopt;
  const Frame most = sending ? 0 : most_frames(guest, now);
  if ((most == 0 && !sending) || !guest.may_send(current(), clock_.period(), now)) return std::nullopt;
  PacketHeader header;
  header.match = match_;
  header.started = started_;
  header.is_far = guest.is_far;
  header.stretch = static_cast<std::uint8_t>(stats_.stretch);
  header.slowest = static_cast<std::uint8_t>(slowest());
  header.waits_for = waits_for();
  header.tempo = announced();
  if (config_.migration > 0) header.final_end = tenure_.final_end();
  // A closed seat acknowledges nothing: its frames are not the player's, who would take its own for accepted.
  for (int p = 0; p < players(); ++p) {
    Seat& seat = seats_[p];
    if (!has(guest, p) || !seat.is_open) continue;
    header.ack_mask |= 1u << p;
    // What took the place of its own inputs it has to know before they count as had.
    if (guest.acked[p] >= seat.replaced_end) seat.replaced_end = 0;
    header.ack[p] = seat.replaced_end > 0 ? seat.replaced : streams_[static_cast<std::size_t>(p)].end();
    header.slack[p] = static_cast<std::int8_t>(told_slack(guest, p));
  }
  // One other machine's word on its states with every datagram, in turns.
  for (std::size_t i = 0; i < used_; ++i) {
    guest.next_reporter = (guest.next_reporter + 1) % used_;
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
  note_held_back(guest);
  const Bytes bytes = compose(guest, header, now, most);
  if (!sending) was_sent(guest, bytes.size(), now);
  return Outgoing{guest.peer, Channel::datagram, bytes};
}

}  // namespace isostep
