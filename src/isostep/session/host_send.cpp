// What the host sends: messages, snapshots for late joiners, datagrams.
// SPDX-License-Identifier: MIT
#include "isostep/session/host_core.hpp"

namespace isostep {
namespace {

constexpr std::size_t kPiece = kReliableCap - 64;  // [bytes] of a snapshot in one message

}  // namespace

void HostCore::serve_snapshots() {
  bool wanted = false, in_use = false;
  for (const Guest& guest : guests_) {
    wanted = wanted || guest.stage == Guest::Stage::needs_snapshot;
    in_use = in_use || guest.stage == Guest::Stage::receives_snapshot;
  }
  if (!wanted) return;
  // One of this second serves everybody: who comes again and again costs no more than that.
  const HashReport now = hashes_.settled();
  if (snapshot_.frame == kNoFrame || now.frame - snapshot_.frame > bounded(config_.hz)) {
    if (in_use) return;
    // A state that is final: the present one may rest on guesses.
    snapshot_ = now;
    snapshot_hash_ = hashes_.hash(now.frame);
    act(RequestKind::capture, now.frame);
  }
  for (Guest& guest : guests_) {
    if (guest.stage != Guest::Stage::needs_snapshot) continue;
    guest.stage = Guest::Stage::receives_snapshot;
    guest.start = snapshot_.frame;
    guest.sent = guest.arrived = 0;
  }
}

std::optional<Outgoing> HostCore::poll_send(Time now) {
  for (std::size_t i = 0; i < guests_.size(); ++i) {
    Guest& guest = guests_[next_guest_];
    next_guest_ = (next_guest_ + 1) % guests_.size();
    if (!guest.is_connected) continue;
    if (std::optional<Outgoing> out = next_message(guest)) {
      next_guest_ = guest.peer;  // all of its messages, in order
      return out;
    }
    if (std::optional<Outgoing> out = next_datagram(guest, now)) return out;
  }
  return std::nullopt;
}

std::optional<Outgoing> HostCore::next_message(Guest& guest) {
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
  if (sending && portable_.empty()) {  // the game has no portable form
    unseat(guest);
    refuse(guest, "snapshot", "needed", "none");
    return next_message(guest);
  }
  if (guest.must_welcome && (sending || guest.stage == Guest::Stage::live)) {
    guest.must_welcome = false;
    Welcome welcome;
    welcome.match = match_;
    welcome.players = static_cast<std::uint8_t>(players());
    welcome.host_players = static_cast<std::uint8_t>(config_.local_players);
    welcome.player = guest.player < 0 ? 0xff : static_cast<std::uint8_t>(guest.player);
    welcome.token = guest.player < 0 ? 0 : seats_[guest.player].token;
    welcome.start = sending ? snapshot_ : HashReport{guest.start, guest.start_chain};
    welcome.hash = sending ? snapshot_hash_ : 0;  // it has that state
    guest.size = welcome.snapshot_size = sending ? static_cast<std::uint32_t>(portable_.size()) : 0;
    welcome.opens = guest.opens;
    write_welcome(welcome, message_);
    return message();
  }
  if (sending && guest.sent < guest.size && guest.sent - guest.arrived < kSnapshotFlight) {
    const std::size_t rest = guest.size - guest.sent;
    const Bytes bytes = Bytes(portable_).subspan(guest.sent, rest < kPiece ? rest : kPiece);
    write_piece({guest.sent, bytes}, message_);
    guest.sent += static_cast<std::uint32_t>(bytes.size());
    if (guest.sent == guest.size) go_live(guest, guest.start);
    return message();
  }
  if (guest.must_open) {
    guest.must_open = false;
    write_open(guest.opens, message_);
    return message();
  }
  return std::nullopt;
}

std::optional<Outgoing> HostCore::next_datagram(Guest& guest, Time now) {
  if (guest.stage != Guest::Stage::live) return std::nullopt;
  if (!guest.may_send(current(), clock_.period(), now)) return std::nullopt;
  PacketHeader header;
  header.match = match_;
  header.started = started_;
  header.is_far = guest.is_far;
  header.stretch = static_cast<std::uint8_t>(stats_.stretch);
  header.slowest = static_cast<std::uint8_t>(slowest());
  header.waits_for = waits_for();
  // A closed seat acknowledges nothing: its frames are not the player's, who would take its own for accepted.
  if (guest.player >= 0 && seats_[guest.player].is_open) {
    const auto p = static_cast<std::size_t>(guest.player);
    header.ack_mask = static_cast<std::uint8_t>(1u << p);
    Seat& seat = seats_[p];
    // What took the place of its own inputs it has to know before they count as had.
    if (guest.acked[p] >= seat.replaced_end) seat.replaced_end = 0;
    header.ack[p] = seat.replaced_end > 0 ? seat.replaced : streams_[p].end();
    header.slack[p] = static_cast<std::int8_t>(told_slack(guest));
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
  note_held_back(guest);
  return Outgoing{guest.peer, Channel::datagram, compose(guest, header, now)};
}

}  // namespace isostep
