// Messages of the reliable channel, written and read with the archive.
// SPDX-License-Identifier: MIT
#include "isostep/session/protocol/message.hpp"

#include "isostep/state/replay_format.hpp"
#include "message_format.hpp"

namespace isostep {
namespace {

constexpr std::uint32_t kMagic = 0x504f5349;  // "ISOP"

void write_report(Writer& writer, const HashReport& report) {
  writer.write(report.frame);
  writer.write(report.chain);
}
HashReport read_report(Reader& reader) {
  HashReport report;
  report.frame = read_frame(reader);
  reader.read(report.chain);
  return report;
}

void read_ends(Reader& reader, Frame (&ends)[kMaxPlayers]) {
  reader.read(ends);
  for (const Frame end : ends) {
    if (end < 0 || end > kLastFrame) reader.fail(ErrorCode::invalid, "a frame out of range");
  }
}

Result<std::uint32_t> read_number(Bytes message, const char* what) {
  Reader reader = after_kind(message);
  const std::uint32_t number = reader.read<std::uint32_t>();
  return finish_message(reader, what, number);
}

}  // namespace

void write_hello(const Hello& hello, std::vector<std::uint8_t>& out) {
  std::vector<std::uint8_t> identity;
  write_replay_header(hello.identity, identity);
  Writer writer = begin_message(MessageKind::hello, out);
  writer.write(kMagic);
  writer.write(kSessionProtocol);
  writer.write(hello.spectator);
  writer.write(static_cast<std::int8_t>(hello.seat));
  writer.write(static_cast<std::uint8_t>(hello.seats));
  writer.write(hello.token);
  writer.write(hello.life);
  writer.write(hello.term);
  write_report(writer, hello.have);
  write_report(writer, hello.partial);
  writer.write(hello.partial_size);
  writer.write_bytes(hello.credential);
  writer.write_text(hello.address.view());
  writer.write(hello.migration);
  writer.write_bytes(identity);
}

Result<Hello> read_hello(Bytes message) {
  Reader reader = after_kind(message);
  Hello hello;
  const std::uint32_t magic = reader.read<std::uint32_t>();
  const std::uint16_t protocol = reader.read<std::uint16_t>();
  if (!reader.ok() || magic != kMagic) return Error{ErrorCode::corrupt, "no greeting of a session", "hello"};
  if (protocol != kSessionProtocol) return Error{ErrorCode::incompatible, "another session protocol", "protocol"};
  reader.read(hello.spectator);
  hello.seat = reader.read<std::int8_t>();
  if (hello.seat < -1 || hello.seat >= static_cast<int>(kMaxPlayers)) {
    reader.fail(ErrorCode::invalid, "a seat out of range");
  }
  hello.seats = reader.read<std::uint8_t>();
  if (hello.seats < 1 || hello.seats > static_cast<int>(kMaxPlayers)) {
    reader.fail(ErrorCode::invalid, "seats out of range");
  }
  reader.read(hello.token);
  reader.read(hello.life);
  reader.read(hello.term);
  hello.have = read_report(reader);
  hello.partial = read_report(reader);
  reader.read(hello.partial_size);
  hello.credential = reader.read_bytes(kCredentialCap);
  hello.address = read_address(reader);
  reader.read(hello.migration);
  const Bytes identity = reader.read_bytes(kReplayHeadCap);
  const Result<Hello> whole = finish_message(reader, "hello", hello);
  if (!whole) return whole;
  const Result<ReplayHeader> header = read_replay_header(identity);
  if (!header) return header.error();
  hello.identity = header.value();
  return hello;
}

void write_welcome(const Welcome& welcome, std::vector<std::uint8_t>& out) {
  Writer writer = begin_message(MessageKind::welcome, out);
  writer.write(welcome.match);
  writer.write(welcome.players);
  writer.write(welcome.hosted);
  writer.write(welcome.player);
  writer.write(welcome.others);
  writer.write(welcome.token);
  writer.write(welcome.life);
  writer.write(welcome.term);
  writer.write(welcome.term_start);
  write_report(writer, welcome.start);
  writer.write(welcome.hash);
  writer.write(welcome.snapshot_size);
  writer.write(welcome.snapshot_from);
  writer.write(welcome.opens);
}

Result<Welcome> read_welcome(Bytes message) {
  Reader reader = after_kind(message);
  Welcome welcome;
  reader.read(welcome.match);
  reader.read(welcome.players);
  reader.read(welcome.hosted);
  reader.read(welcome.player);
  reader.read(welcome.others);
  reader.read(welcome.token);
  reader.read(welcome.life);
  reader.read(welcome.term);
  welcome.term_start = read_frame(reader);
  welcome.start = read_report(reader);
  reader.read(welcome.hash);
  reader.read(welcome.snapshot_size);
  reader.read(welcome.snapshot_from);
  reader.read(welcome.opens);
  if (welcome.players < 1 || welcome.players > kMaxPlayers || (std::uint64_t{welcome.hosted} >> welcome.players) != 0 ||
      (welcome.player >= welcome.players && welcome.player != 0xff)) {
    reader.fail(ErrorCode::invalid, "players out of range");
    return finish_message(reader, "welcome", welcome);
  }
  // The others come after the first, and a spectator has none.
  const int before = welcome.player == 0xff ? 0 : welcome.player + 1;
  const std::uint64_t seats = std::uint64_t{welcome.others} >> before << before;
  const bool are_seats = welcome.player == 0xff ? welcome.others == 0 : seats == welcome.others;
  if (!are_seats || (std::uint64_t{welcome.others} >> welcome.players) != 0) {
    reader.fail(ErrorCode::invalid, "others out of range");
  }
  if (welcome.snapshot_from > welcome.snapshot_size) reader.fail(ErrorCode::invalid, "snapshot_from out of range");
  const bool plays = welcome.player != 0xff;
  if (welcome.opens < kNoFrame || welcome.opens > kLastFrame || (welcome.opens != kNoFrame && !plays)) {
    reader.fail(ErrorCode::invalid, "opens out of range");
  }
  return finish_message(reader, "welcome", welcome);
}

void write_refusal(const Refusal& refusal, std::vector<std::uint8_t>& out) {
  Writer writer = begin_message(MessageKind::refuse, out);
  writer.write_text(refusal.key.view());
  writer.write_text(refusal.in_file.view());
  writer.write_text(refusal.here.view());
}

Result<Refusal> read_refusal(Bytes message) {
  Reader reader = after_kind(message);
  Refusal refusal;
  const std::string_view key = reader.read_text(kReplayKeyCap);
  const std::string_view in_file = reader.read_text(kReplayValueCap);
  const std::string_view here = reader.read_text(kReplayValueCap);
  // It will be shown to people: no control sequences of a terminal.
  for (const std::string_view text : {key, in_file, here}) {
    for (const char c : text) {
      if (c < ' ' || c > '~') reader.fail(ErrorCode::invalid, "a text that is not printable ASCII");
    }
  }
  refusal = {ShortText<kReplayKeyCap>(key), ShortText<kReplayValueCap>(in_file), ShortText<kReplayValueCap>(here)};
  return finish_message(reader, "refusal", refusal);
}

void write_piece(const Piece& piece, std::vector<std::uint8_t>& out) {
  Writer writer = begin_message(MessageKind::piece, out);
  writer.write(piece.offset);
  writer.write_bytes(piece.bytes);
}

Result<Piece> read_piece(Bytes message) {
  Reader reader = after_kind(message);
  Piece piece{};
  reader.read(piece.offset);
  piece.bytes = reader.read_bytes(kReliableCap);
  return finish_message(reader, "piece", piece);
}

void write_progress(std::uint32_t arrived, std::vector<std::uint8_t>& out) {
  begin_message(MessageKind::progress, out).write(arrived);
}

Result<std::uint32_t> read_progress(Bytes message) { return read_number(message, "progress"); }

void write_ready(std::vector<std::uint8_t>& out) { begin_message(MessageKind::ready, out); }

void write_open(Frame first, std::vector<std::uint8_t>& out) { begin_message(MessageKind::open, out).write(first); }

Result<Frame> read_open(Bytes message) {
  Reader reader = after_kind(message);
  const Frame first = reader.read<Frame>();
  if (first < 0 || first > kLastFrame) reader.fail(ErrorCode::invalid, "a frame out of range");
  return finish_message(reader, "open", first);
}

void write_enrolled(std::uint32_t version, std::vector<std::uint8_t>& out) {
  begin_message(MessageKind::enrolled, out).write(version);
}

Result<std::uint32_t> read_enrolled(Bytes message) { return read_number(message, "enrolled"); }

void write_candidate(const Candidate& candidate, std::vector<std::uint8_t>& out) {
  Writer writer = begin_message(MessageKind::candidate, out);
  writer.write(candidate.term);
  writer.write(candidate.log_term);
  writer.write(candidate.roster_term);
  writer.write(candidate.version);
  writer.write(candidate.ends);
}

Result<Candidate> read_candidate(Bytes message) {
  Reader reader = after_kind(message);
  Candidate candidate;
  reader.read(candidate.term);
  reader.read(candidate.log_term);
  reader.read(candidate.roster_term);
  reader.read(candidate.version);
  read_ends(reader, candidate.ends);
  return finish_message(reader, "candidate", candidate);
}

void write_known(Bytes packet, std::vector<std::uint8_t>& out) {
  begin_message(MessageKind::known, out);
  out.insert(out.end(), packet.begin(), packet.end());
}

Result<Packet> read_known(Bytes message) { return read_packet(message.subspan(message.empty() ? 0 : 1)); }

void write_support(const Support& support, std::vector<std::uint8_t>& out) {
  Writer writer = begin_message(MessageKind::support, out);
  writer.write(support.term);
  writer.write(support.ends);
}

Result<Support> read_support(Bytes message) {
  Reader reader = after_kind(message);
  Support support;
  reader.read(support.term);
  read_ends(reader, support.ends);
  return finish_message(reader, "support", support);
}

void write_redirect(const Address& address, std::vector<std::uint8_t>& out) {
  begin_message(MessageKind::redirect, out).write_text(address.view());
}

void write_farewell(std::vector<std::uint8_t>& out) { begin_message(MessageKind::farewell, out); }

Result<Address> read_redirect(Bytes message) {
  Reader reader = after_kind(message);
  const Address address = read_address(reader);
  return finish_message(reader, "redirect", address);
}

void write_ask(const Ask& ask, std::vector<std::uint8_t>& out) {
  Writer writer = begin_message(MessageKind::ask, out);
  writer.write(ask.is_paused);
  writer.write(ask.speed);
}

Result<Ask> read_ask(Bytes message) {
  Reader reader = after_kind(message);
  Ask ask;
  reader.read(ask.is_paused);
  reader.read(ask.speed);
  if (ask.speed != 0 && (!Tempo::is_speed(ask.speed) || ask.is_paused)) reader.fail(ErrorCode::invalid, "no speed");
  return finish_message(reader, "ask", ask);
}

Result<MessageKind> message_kind(Bytes message) {
  constexpr auto kLast = static_cast<std::uint8_t>(MessageKind::farewell);
  if (message.empty() || message.size() > kReliableCap || message[0] < 1 || message[0] > kLast) {
    return Error{ErrorCode::corrupt, "no message of a session", "message"};
  }
  return static_cast<MessageKind>(message[0]);
}

Address read_address(Reader& reader) {
  const std::string_view text = reader.read_text(kAddressCap);
  for (const char c : text) {
    if (c < ' ' || c > '~') reader.fail(ErrorCode::invalid, "an address that is not printable ASCII");
  }
  return Address(text);
}

}  // namespace isostep
