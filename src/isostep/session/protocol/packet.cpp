// Datagrams: how they are laid out, and everything that is checked before one is believed.
// SPDX-License-Identifier: MIT
//
// Layout: kind u8 | match u64 | number u16 | time u16 | flags varint | [echo u16, waited u8] | [stretch u8, slowest u8]
//         | [spares u8] | [waits for varint] | frame varint | [final end: difference to frame]
//         | [tempo: number varint, frame difference, speed and pause u8, by u8]
//         | [report: frame difference, chain u64] | [passed on: player u8, frame difference, chain u64]
//         | [figures: player u8, replaced, waited, round trip, jitter, loss varint]
//         | ack mask varint | {difference to frame, slack i8}...
//         | slices {player u8, difference to frame, count varint, tokens: size varint, bytes}... to the end.
// Tokens: 00nnnnnn  n + 1 times the previous input      01nnnnnn  n + 1 frames with nobody there
//         10000000  size varint, the input              10000001  as long as the previous: masks of 8, changed bytes
//         11mmmmmm  as long as the previous, at most 6 bytes: mask of the changed ones, which follow
#include "isostep/session/protocol/packet.hpp"

#include "isostep/session/protocol/wire.hpp"
#include "isostep/session/timeline/input_codec.hpp"

namespace isostep {
namespace {

constexpr std::uint8_t kKind = 0xd1;
constexpr std::uint32_t kHasEcho = 1, kStarted = 2, kHasReport = 4, kPassesOn = 8, kIsFar = 16, kIsSlow = 32,
                        kWaits = 64, kHasTempo = 128, kHasFigures = 256, kHasFinal = 512, kSpares = 1024,
                        kKnownFlags = 2047;
constexpr std::uint8_t kRepeat = 0x00, kAbsentRun = 0x40, kLiteral = 0x80, kDelta = 0x81, kShortDelta = 0xc0;
constexpr std::size_t kShortInput = 6;  // [bytes] whose mask fits the token
constexpr Frame kRun = 64;

bool is_frame(Frame frame) { return frame >= 0 && frame <= kLastFrame; }

void write_report(WireWriter& writer, Frame base, const HashReport& report) {
  writer.difference(report.frame - base);
  writer.fixed(report.chain);
}
HashReport read_report(WireReader& reader, Frame base) {
  HashReport report;
  const std::int32_t difference = reader.difference();
  const std::int64_t frame = std::int64_t{base} + difference;
  report.chain = reader.fixed<std::uint64_t>();
  if (frame < 0 || frame > kLastFrame) reader.fail();
  report.frame = reader.failed() ? kNoFrame : static_cast<Frame>(frame);
  return report;
}
void write_figures(WireWriter& writer, const PacketHeader& header) {
  const PlayerStats& figures = header.figures;
  writer.byte(header.figured);
  for (const std::uint32_t value :
       {figures.replaced, figures.waited, figures.round_trip, figures.jitter, figures.loss}) {
    writer.number(value);
  }
}
void read_figures(WireReader& reader, PacketHeader& header) {
  PlayerStats& figures = header.figures;
  header.figured = reader.byte();
  for (std::uint32_t* value :
       {&figures.replaced, &figures.waited, &figures.round_trip, &figures.jitter, &figures.loss}) {
    *value = reader.number();
  }
  if (header.figured >= kMaxPlayers || figures.loss > 1000) reader.fail();
}
Frame read_frame_near(WireReader& reader, Frame base) {
  const std::int64_t frame = std::int64_t{base} + reader.difference();
  if (frame < 0 || frame > kLastFrame) reader.fail();
  return reader.failed() ? 0 : static_cast<Frame>(frame);
}

/// Would what changed take less than all of it?
bool is_worth_delta(Bytes previous, Bytes input) {
  if (previous.size() != input.size() || input.empty()) return false;
  if (input.size() <= kShortInput) return true;
  std::size_t changed = 0;
  for (std::size_t k = 0; k < input.size(); ++k) changed += previous[k] != input[k] ? 1 : 0;
  return changed + (input.size() + 7) / 8 <= input.size();
}

constexpr std::uint8_t kPaused = 128;
void write_tempo(WireWriter& writer, Frame base, const Tempo& tempo) {
  writer.number(tempo.number);
  writer.difference(tempo.from - base);
  writer.byte(static_cast<std::uint8_t>(tempo.speed | (tempo.is_paused ? kPaused : 0)));
  writer.byte(tempo.by);
}
bool read_tempo(WireReader& reader, Frame base, Tempo& tempo) {
  tempo.number = reader.number();
  tempo.from = read_frame_near(reader, base);
  const std::uint8_t speed = reader.byte();
  tempo.speed = speed & (kPaused - 1);
  tempo.is_paused = (speed & kPaused) != 0;
  tempo.by = reader.byte();
  const bool is_player = tempo.by < kMaxPlayers || tempo.by == 0xff;
  return !reader.failed() && tempo.number != 0 && Tempo::is_speed(tempo.speed) && is_player;
}

void write_input(WireWriter& writer, Bytes previous, Bytes input) {
  if (!is_worth_delta(previous, input)) {
    writer.byte(kLiteral);
    writer.number(static_cast<std::uint32_t>(input.size()));
    writer.raw(input);
    return;
  }
  if (input.size() <= kShortInput) {
    unsigned mask = 0;
    for (std::size_t k = 0; k < input.size(); ++k) mask |= (previous[k] != input[k] ? 1u : 0u) << k;
    writer.byte(static_cast<std::uint8_t>(kShortDelta | mask));
    for (std::size_t k = 0; k < input.size(); ++k) {
      if (previous[k] != input[k]) writer.byte(input[k]);
    }
    return;
  }
  writer.byte(kDelta);
  for (std::size_t i = 0; i < input.size(); i += 8) {
    const std::size_t end = i + 8 < input.size() ? i + 8 : input.size();
    unsigned mask = 0;
    for (std::size_t k = i; k < end; ++k) mask |= (previous[k] != input[k] ? 1u : 0u) << (k - i);
    writer.byte(static_cast<std::uint8_t>(mask));
    for (std::size_t k = i; k < end; ++k) {
      if (previous[k] != input[k]) writer.byte(input[k]);
    }
  }
}

}  // namespace

bool is_of(const PacketHeader& header, int players) {
  const auto is_player = [&](std::uint8_t player) { return player == 0xff || player < players; };
  return is_player(header.slowest) && is_player(header.tempo.by) && std::uint64_t{header.waits_for} >> players == 0;
}

PacketWriter::PacketWriter(const PacketHeader& header, std::uint8_t* buffer)
    : buffer_(buffer), size_(0), frame_(header.frame) {
  WireWriter writer(buffer, kDatagramCap);
  const bool has_report = header.report.frame != kNoFrame, passes_on = header.reporter < kMaxPlayers;
  const bool tells_figures = header.figured < kMaxPlayers;
  writer.byte(kKind);
  writer.fixed(header.match);
  writer.fixed(header.number);
  writer.fixed(header.time);
  writer.number((header.has_echo ? kHasEcho : 0) | (header.started ? kStarted : 0) | (has_report ? kHasReport : 0) |
                (passes_on ? kPassesOn : 0) | (header.is_far ? kIsFar : 0) | (header.stretch > 0 ? kIsSlow : 0) |
                (header.waits_for != 0 ? kWaits : 0) | (header.tempo.number != 0 ? kHasTempo : 0) |
                (tells_figures ? kHasFigures : 0) | (header.final_end != kNoFrame ? kHasFinal : 0) |
                (header.spares > 0 ? kSpares : 0));
  if (header.has_echo) {
    writer.fixed(header.echo);
    writer.byte(header.waited);
  }
  if (header.stretch > 0) {
    writer.byte(header.stretch);
    writer.byte(header.slowest);
  }
  if (header.spares > 0) writer.byte(header.spares);
  if (header.waits_for != 0) writer.number(header.waits_for);
  writer.number(static_cast<std::uint32_t>(header.frame));
  if (header.final_end != kNoFrame) writer.difference(header.final_end - header.frame);
  if (header.tempo.number != 0) write_tempo(writer, header.frame, header.tempo);
  if (has_report) write_report(writer, header.frame, header.report);
  if (passes_on) {
    writer.byte(header.reporter);
    write_report(writer, header.frame, header.passed_on);
  }
  if (tells_figures) write_figures(writer, header);
  writer.number(header.ack_mask);
  for (std::size_t p = 0; p < kMaxPlayers; ++p) {
    if ((header.ack_mask >> p & 1) == 0) continue;
    writer.difference(header.ack[p] - header.frame);
    writer.byte(static_cast<std::uint8_t>(header.slack[p]));
  }
  size_ = writer.size();
}

Frame PacketWriter::add_slice(std::uint8_t player, const InputStream& stream, Frame first, Frame most) {
  if (!stream.contains(first)) return 0;
  // The slice's own header is written last, for it holds the tokens' size: 12 bytes are its most.
  constexpr std::size_t kSliceHeader = 12;
  if (size_ + kSliceHeader >= kDatagramCap) return 0;
  std::uint8_t tokens[kDatagramCap];
  WireWriter writer(tokens, kDatagramCap - size_ - kSliceHeader);
  std::size_t whole = 0;
  Frame count = 0;
  Bytes previous;
  const Frame end = stream.end() - first < most ? stream.end() : first + most;
  for (Frame frame = first; frame < end;) {
    const InputEntry entry = stream.at(frame);
    const bool repeats = !entry.absent && frame > first && stream.repeats(frame);
    Frame run = 1;
    while (run < kRun && frame + run < end && stream.repeats(frame + run)) ++run;
    if (entry.absent) {
      writer.byte(static_cast<std::uint8_t>(kAbsentRun | (run - 1)));
    } else if (repeats) {
      writer.byte(static_cast<std::uint8_t>(kRepeat | (run - 1)));
    } else {
      run = 1;  // its repetitions come after it
      write_input(writer, previous, entry.bytes);
      previous = entry.bytes;
    }
    if (writer.full()) break;
    whole = writer.size();
    count += run;
    frame += run;
  }
  if (count == 0) return 0;
  WireWriter head(buffer_ + size_, kDatagramCap - size_);
  head.byte(player);
  head.difference(first - frame_);
  head.number(static_cast<std::uint32_t>(count));
  head.number(static_cast<std::uint32_t>(whole));
  head.raw({tokens, whole});
  size_ += head.size();
  return count;
}

Result<Packet> read_packet(Bytes bytes) {
  const auto refuse = [](const char* message) { return Error{ErrorCode::corrupt, message, "datagram"}; };
  if (bytes.size() > kDatagramCap) return refuse("longer than a datagram may be");
  WireReader reader(bytes);
  Packet packet;
  PacketHeader& header = packet.header;
  if (reader.byte() != kKind) return refuse("no datagram of a session");
  header.match = reader.fixed<std::uint64_t>();
  header.number = reader.fixed<std::uint16_t>();
  header.time = reader.fixed<std::uint16_t>();
  const std::uint32_t flags = reader.number();
  if ((flags & ~kKnownFlags) != 0) return refuse("unknown flags");
  header.has_echo = (flags & kHasEcho) != 0;
  header.started = (flags & kStarted) != 0;
  header.is_far = (flags & kIsFar) != 0;
  if (header.has_echo) {
    header.echo = reader.fixed<std::uint16_t>();
    header.waited = reader.byte();
  }
  if ((flags & kIsSlow) != 0) {
    header.stretch = reader.byte();
    header.slowest = reader.byte();
    if (header.stretch == 0) return refuse("slow by nothing");
    if (header.slowest >= kMaxPlayers && header.slowest != 0xff) return refuse("slowed by no player");
  }
  if ((flags & kSpares) != 0) {
    header.spares = reader.byte();
    if (header.spares == 0) return refuse("spares nothing");
  }
  if ((flags & kWaits) != 0) {
    header.waits_for = reader.number();
    if (header.waits_for == 0) return refuse("waits for nobody");
  }
  const std::uint32_t frame = reader.number();
  if (frame > static_cast<std::uint32_t>(kLastFrame)) return refuse("a frame beyond the last");
  header.frame = static_cast<Frame>(frame);
  if ((flags & kHasFinal) != 0) header.final_end = read_frame_near(reader, header.frame);
  if ((flags & kHasTempo) != 0 && !read_tempo(reader, header.frame, header.tempo)) return refuse("no speed of a match");
  if ((flags & kHasReport) != 0) header.report = read_report(reader, header.frame);
  if ((flags & kPassesOn) != 0) {
    header.reporter = reader.byte();
    header.passed_on = read_report(reader, header.frame);
    if (header.reporter >= kMaxPlayers) return refuse("passes on the hash of no player");
  }
  if ((flags & kHasFigures) != 0) read_figures(reader, header);
  header.ack_mask = reader.number();
  for (std::size_t p = 0; p < kMaxPlayers; ++p) {
    if ((header.ack_mask >> p & 1) == 0) continue;
    header.ack[p] = read_frame_near(reader, header.frame);
    header.slack[p] = static_cast<std::int8_t>(reader.byte());
  }
  unsigned seen = 0;
  while (reader.remaining() > 0) {
    InputSlice slice{};
    slice.player = reader.byte();
    slice.first = read_frame_near(reader, header.frame);
    slice.count = static_cast<Frame>(reader.number());
    slice.tokens = reader.raw(reader.number());
    if (reader.failed()) break;
    if (slice.player >= kMaxPlayers || (seen >> slice.player & 1) != 0) return refuse("inputs of no player, or twice");
    if (!is_frame(slice.first) || slice.count < 1 || slice.count > kSliceFrames) return refuse("frames out of range");
    seen |= 1u << slice.player;
    packet.slices[packet.slice_count++] = slice;
  }
  if (reader.failed()) return refuse("ends early, or a number is written in no known way");
  return packet;
}

SliceReader::SliceReader(const InputSlice& slice) : tokens_(slice.tokens), left_(slice.count) {}

bool SliceReader::next(InputEntry& entry) {
  if (left_ == 0) {
    failed_ = failed_ || !tokens_.empty();
    return false;
  }
  if (run_ == 0 && !read_token()) {
    failed_ = true;
    return false;
  }
  --run_;
  --left_;
  entry = run_absent_ ? InputEntry{true, {}} : InputEntry{false, {previous_, previous_size_}};
  return true;
}

bool SliceReader::read_token() {
  static_assert(sizeof previous_ == kInputCap);
  WireReader reader(tokens_);
  const std::uint8_t token = reader.byte();
  if (reader.failed()) return false;
  run_ = 1;
  run_absent_ = (token & 0xc0) == kAbsentRun;
  if (token < kLiteral) {
    run_ = (token & 63) + 1;
    if (run_ > left_) return false;
  } else if (token == kLiteral) {
    const std::uint32_t size = reader.number();
    if (size > kInputCap) return false;
    const Bytes input = reader.raw(size);
    if (reader.failed()) return false;
    previous_size_ = size;
    if (size > 0) std::memcpy(previous_, input.data(), size);
  } else if (token == kDelta && previous_size_ > 0) {
    for (std::size_t i = 0; i < previous_size_; i += 8) {
      const std::uint8_t mask = reader.byte();
      for (std::size_t k = i; k < i + 8 && mask >> (k - i) != 0; ++k) {
        if ((mask >> (k - i) & 1) == 0) continue;
        if (k >= previous_size_) return false;
        previous_[k] = reader.byte();
      }
    }
  } else if (token >= kShortDelta && previous_size_ > 0 && previous_size_ <= kShortInput) {
    for (std::size_t k = 0; k < kShortInput; ++k) {
      if ((token >> k & 1) == 0) continue;
      if (k >= previous_size_) return false;
      previous_[k] = reader.byte();
    }
  } else {
    return false;
  }
  if (reader.failed()) return false;
  tokens_ = tokens_.subspan(tokens_.size() - reader.remaining());
  return true;
}

}  // namespace isostep
