// libFuzzer target: the input is a script of what a hostile peer says and when, to the parsers, a host, or a client.
// SPDX-License-Identifier: MIT
//
// clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -Iscalar/include -Iinclude -Isrc -Itests
//         tests/fuzz/session_fuzz.cpp src/isostep/{session,geometry,state}/*.cpp scalar/src/*.cpp
//         src/transport/{simulated_network,impaired_direction,network_profile}.cpp build/release/libisostep.a
//         -o session_fuzz

#include <deque>
#include <map>

#include "unit/session/hostile.hpp"

namespace {

using namespace isostep;
using hostile::Buffer;
using hostile::Game;

void require(bool condition) {
  if (!condition) __builtin_trap();
}

class Script {
 public:
  Script(const std::uint8_t* data, std::size_t size) : bytes_(data, size) {}
  bool over() const { return bytes_.empty(); }
  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t first = bytes_[0];
    bytes_ = bytes_.subspan(1);
    return first;
  }
  std::uint32_t word() {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8 | byte();
    return value;
  }
  Bytes some(std::size_t size) {
    const Bytes taken = bytes_.first(size < bytes_.size() ? size : bytes_.size());
    bytes_ = bytes_.subspan(taken.size());
    return taken;
  }
  Bytes rest() { return some(bytes_.size()); }
  /// Mostly near `now`, seldom anywhere.
  Frame frame(Frame now) {
    const std::uint8_t how = byte();
    if (how >= 240) return static_cast<Frame>(word() % (std::uint32_t{kLastFrame} + 1));
    const Frame near = now + how % 160 - 80;
    return near < 0 ? 0 : near;
  }

 private:
  Bytes bytes_;
};

// --- parsers ---

void parse(Bytes bytes) {
  if (const Result<Packet> packet = read_packet(bytes)) {
    const PacketHeader& header = packet.value().header;
    require(header.frame >= 0 && header.frame <= kLastFrame && packet.value().slice_count <= kMaxPlayers);
    require(header.report.frame >= kNoFrame && header.report.frame <= kLastFrame);
    for (const Frame ack : header.ack) require(ack >= 0 && ack <= kLastFrame);
    for (std::uint8_t i = 0; i < packet.value().slice_count; ++i) {
      const InputSlice& slice = packet.value().slices[i];
      require(slice.player < kMaxPlayers && slice.count >= 1 && slice.count <= kSliceFrames);
      SliceReader reader(slice);
      InputEntry entry;
      Frame count = 0;
      std::uint32_t sum = 0;
      while (reader.next(entry)) {
        require(entry.bytes.size() <= kInputCap);
        for (const std::uint8_t byte : entry.bytes) sum += byte;
        ++count;
      }
      require(reader.failed() ? count <= slice.count : count == slice.count);
      require(sum <= 255u * kInputCap * kSliceFrames);
    }
  }
  (void)message_kind(bytes).ok();
  (void)read_hello(bytes).ok();
  if (const Result<SavedMatch> saved = read_saved_match(bytes)) {
    require(saved.value().players >= 1 && saved.value().players <= kMaxPlayers && saved.value().start.frame >= 0);
  }
  if (const Result<Ballot> ballot = read_ballot(bytes)) {
    require(ballot.value().number != 0 && (ballot.value().yes & ballot.value().no) == 0);
  }
  if (const Result<PlayersProposal> proposal = read_proposal(bytes)) require(proposal.value().player < kMaxPlayers);
  if (const Result<Votes> votes = read_votes(bytes)) require((votes.value().yes & votes.value().no) == 0);
  if (const Result<Ask> ask = read_ask(bytes)) require(ask.value().speed == 0 || !ask.value().is_paused);
  if (const Result<Welcome> welcome = read_welcome(bytes)) require(welcome.value().players <= kMaxPlayers);
  (void)read_refusal(bytes).ok();
  if (const Result<Piece> piece = read_piece(bytes)) require(piece.value().bytes.size() <= bytes.size());
  (void)read_progress(bytes).ok();
  if (const Result<Frame> open = read_open(bytes)) require(open.value() >= 0 && open.value() <= kLastFrame);
}

// --- live ---

SessionConfig small_config(std::uint8_t options) {
  SessionConfig config;
  config.players = 3;
  config.mode = (options & 1) != 0 ? SessionMode::lockstep : SessionMode::rollback;
  config.window = 6;
  config.most_delay = 8;
  config.kept = 32;
  config.history = (options & 2) != 0 ? 64 : 600;
  config.max_peers = 4;
  config.max_strangers = 0;
  config.reservation = kSecond;
  config.silence = config.patience = kSecond / 2;
  config.most_packets = (options & 4) != 0 ? 120 : 1000000;
  return config;
}

/// A session with its game, and the rules that hold whatever happens.
struct Side {
  explicit Side(const SessionConfig& config) : session(config) {}

  void confirmed(Frame frame, std::uint64_t hash) { hashes[frame] = hash; }
  void turn(Time now, const std::function<void(const Outgoing&)>& send) {
    for (int p = 0; p < session.config().players; ++p) {
      if (session.wants_input(p)) session.add_local_input(p, hostile::bot(p, session.current()));
    }
    const int steps = drive(session, game, now, *this);
    require(steps <= 2 * session.config().kept + 8);
    int sent = 0;
    while (const std::optional<Outgoing> out = session.poll_send(now)) {
      require(out->bytes.size() <= (out->channel == Channel::datagram ? kDatagramCap : kReliableCap));
      require(++sent < 1000);
      send(*out);
    }
    require(session.current() >= 0 && session.current() <= kLastFrame + 1);
    const bool runs = session.phase() == SessionPhase::playing || session.phase() == SessionPhase::watching;
    require(!runs || session.confirmed() <= session.current());
    while (const std::optional<SessionEvent> event = session.poll_event()) {
      if (event->kind == SessionEvent::Kind::desync) named |= event->player == 0xff ? 256u : 1u << event->player;
    }
  }
  Session<Game> session;
  Game game;
  std::map<Frame, std::uint64_t> hashes;
  std::uint32_t named = 0;  // whose states differed: a bit each, 256: the host's
};

Buffer any_datagram(Script& script, std::uint64_t match, Frame now, std::uint8_t player) {
  PacketHeader header;
  header.match = match;
  header.time = static_cast<std::uint16_t>(script.byte() * 256);
  const std::uint8_t flags = script.byte();
  header.has_echo = (flags & 1) != 0;
  if (header.has_echo) header.echo = static_cast<std::uint16_t>(script.word());
  header.started = (flags & 2) == 0;
  header.is_far = (flags & 16) != 0;
  if ((flags & 32) != 0) header.stretch = script.byte() | 1;
  if ((flags & 32) != 0) header.slowest = script.byte() % 8;
  header.frame = script.frame(now);
  if ((flags & 64) != 0) {
    header.tempo = {script.byte(), script.frame(now), static_cast<std::uint8_t>(4 + script.byte() % 13),
                    script.byte() % 2 == 0, static_cast<std::uint8_t>(script.byte() % 9 == 8 ? 0xff : 0)};
  }
  if ((flags & 4) != 0) header.report = {script.frame(now), script.byte()};
  if ((flags & 8) != 0) {
    header.reporter = script.byte() % 8;
    header.passed_on = {script.frame(now), script.byte()};
  }
  header.ack_mask = script.byte();
  for (std::size_t p = 0; p < kMaxPlayers; ++p) {
    if ((header.ack_mask >> p & 1) == 0) continue;
    header.ack[p] = script.frame(now);
    header.slack[p] = static_cast<std::int8_t>(script.byte());
  }
  std::uint8_t buffer[kDatagramCap];
  PacketWriter writer(header, buffer);
  for (int slices = script.byte() % 3; slices > 0; --slices) {
    InputStream stream(200, 3);
    const Frame first = script.frame(now);
    stream.reset(first);
    for (int runs = script.byte() % 8; runs > 0; --runs) {
      const std::uint8_t kind = script.byte();
      const std::uint8_t input[3] = {kind, script.byte(), 0};
      for (int n = kind % 20; n >= 0; --n)
        stream.append({kind >= 200, kind >= 200 ? Bytes{} : Bytes(input, kind == 99 ? 3 : 2)});
    }
    const std::uint8_t who = script.byte();
    writer.add_slice(who < 160 ? player : who % 8, stream, first);
  }
  return Buffer(writer.bytes().begin(), writer.bytes().end());
}

/// A host with one honest client, peer 0; peers 1 and 2 do what the script says.
void attack_host(Script& script) {
  const std::uint8_t options = script.byte();
  SessionConfig config = small_config(options);
  SessionConfig client_config = config;
  client_config.local_players = 0;
  config.host = true;
  config.seed = 1;
  config.asks_admission = (options & 16) != 0;
  Side host(config), client(client_config);
  Time now = 1000;
  std::deque<std::pair<Channel, Buffer>> up, down;
  bool cut = false;
  std::uint64_t match = 0;
  std::uint8_t seats[3] = {0xff, 0xff, 0xff};
  std::uint64_t tokens[3] = {};
  Buffer overheard;
  const auto to_client = [&](const Outgoing& out) {
    const Buffer bytes(out.bytes.begin(), out.bytes.end());
    if (out.peer == 0 && out.close) cut = true;
    if (out.peer == 0 && !bytes.empty()) down.emplace_back(out.channel, bytes);
    if (out.channel != Channel::reliable || bytes.empty() || bytes[0] != std::uint8_t(MessageKind::welcome)) return;
    const Welcome welcome = read_welcome(bytes).value();
    match = welcome.match;
    if (out.peer == 0 || out.peer > 2) return;
    seats[out.peer] = welcome.player;
    tokens[out.peer] = welcome.token;
  };
  const auto to_host = [&](const Outgoing& out) {
    if (out.close) cut = true;
    if (out.bytes.empty()) return;
    up.emplace_back(out.channel, Buffer(out.bytes.begin(), out.bytes.end()));
    overheard = up.back().second;
  };
  host.turn(now, to_client);
  client.turn(now, to_host);
  host.session.connected(0, now);
  client.session.connected(0, now);
  if ((options & 8) != 0) host.session.start(now);  // then everybody joins late
  Frame settled = host.session.confirmed();
  for (int step = 0; step < 400 && !script.over(); ++step) {
    const std::uint8_t op = script.byte();
    const PeerId peer = static_cast<PeerId>(1 + (op >> 4) % 2);
    switch (op % 10) {
      case 0:
      case 1:
      case 2: {
        for (int turns = 1 + (op >> 5); turns > 0; --turns) {
          now += op % 10 == 2 ? 17000 : 4000;
          host.turn(now, to_client);
          while (const auto applicant = host.session.poll_applicant()) {
            require(applicant->player < 3 && applicant->seat < 3 && applicant->peer < 4);
            if (applicant->peer == 0 || script.byte() < 200) (void)host.session.admit(applicant->id);
          }
          client.turn(now, to_host);
          for (; !up.empty(); up.pop_front()) host.session.receive(0, up.front().first, up.front().second, now);
          for (; !down.empty(); down.pop_front())
            client.session.receive(0, down.front().first, down.front().second, now);
          if (!cut) continue;
          cut = false;
          host.session.disconnected(0, now);
          client.session.disconnected(0, now);
          host.session.connected(0, now);
          client.session.connected(0, now);
        }
        break;
      }
      case 3: host.session.receive(peer, Channel::datagram, script.some(script.byte()), now); break;
      case 4: host.session.receive(peer, Channel::reliable, script.some(script.byte()), now); break;
      case 5:
      case 6:
        host.session.receive(peer, Channel::datagram, any_datagram(script, match, host.session.current(), seats[peer]),
                             now);
        break;
      case 7: {
        Hello hello = hostile::hello_of(config);
        const std::uint8_t how = script.byte();
        hello.spectator = (how & 1) != 0;
        if ((how & 2) != 0) hello.token = tokens[1 + (how >> 7)];
        if ((how & 8) != 0) hello.seat = static_cast<int>(how >> 4 & 3) - 1;
        if ((how & 64) != 0) hello.seats = 1 + (how >> 4 & 3);
        if ((how & 4) != 0) hello.have = {script.frame(host.session.current()), script.byte()};
        if ((how & 8) != 0) hello.partial = {script.frame(host.session.current()), script.byte()};
        if ((how & 8) != 0) hello.partial_size = script.word();
        host.session.connected(peer, now);
        Buffer bytes;
        write_hello(hello, bytes);
        host.session.receive(peer, Channel::reliable, bytes, now);
        break;
      }
      case 8: {
        Buffer bytes;
        const std::uint8_t how = script.byte();
        if (how % 8 == 0) host.session.disconnected(peer, now);
        if (how % 8 == 4) (void)host.session.kick_peer(peer, "");
        if (how % 4 == 1) write_progress(script.word(), bytes);
        if (how % 4 == 2) write_ready(bytes);
        if (how % 4 == 3 && how < 128) write_ready(bytes);
        if (how % 4 == 3 && how >= 128)
          write_ask({how >= 192, static_cast<std::uint8_t>(how >= 192 ? 0 : how % 32)}, bytes);
        host.session.receive(peer, Channel::reliable, bytes, now);
        break;
      }
      default: {
        Buffer bytes = overheard;
        if (!bytes.empty()) bytes[script.byte() % bytes.size()] ^= static_cast<std::uint8_t>(1u << op % 8);
        host.session.receive(peer, Channel::datagram, bytes, now);
        if (op >= 128 && !up.empty() && up.back().first == Channel::datagram) up.pop_back();
        break;
      }
    }
    require(host.session.confirmed() >= settled);
    const auto first = host.session.peer_of(1), second = host.session.peer_of(2);
    require(!first || !second || *first != *second);
    settled = host.session.confirmed();
  }
  // The honest never differ, and neither is told so of the other.
  for (const auto& [frame, hash] : client.hashes) {
    const auto there = host.hashes.find(frame);
    if (there != host.hashes.end()) require(there->second == hash);
  }
  require((client.named & 257u) == 0);
  require(client.session.portable().capacity() < 200000 && host.session.portable().capacity() < 200000);
}

void attack_client(Script& script) {
  const std::uint8_t options = script.byte();
  SessionConfig config = small_config(options);
  config.local_players = (options & 16) != 0 ? 2 : 1;
  if ((options & 8) != 0) config.mode = SessionMode::spectator;
  Side client(config);
  Time now = 1000;
  std::size_t told = 0;
  const auto ignore = [](const Outgoing&) {};
  client.turn(now, ignore);
  client.session.connected(0, now);
  client.turn(now, ignore);
  const auto hear = [&](Channel channel, Bytes bytes) {
    told += bytes.size();
    client.session.receive(0, channel, bytes, now);
  };
  for (int step = 0; step < 400 && !script.over(); ++step) {
    const std::uint8_t op = script.byte();
    const Frame here = client.session.current();
    Buffer bytes;
    switch (op % 10) {
      case 0:
      case 1:
        for (int turns = 1 + (op >> 5); turns > 0; --turns) {
          now += op % 10 == 0 ? 17000 : 3000;
          client.turn(now, ignore);
        }
        break;
      case 2: hear(Channel::datagram, script.some(script.byte())); break;
      case 3: hear(Channel::reliable, script.some(script.byte())); break;
      case 4: {
        Welcome welcome;
        welcome.match = 9;
        welcome.players = 3;
        welcome.hosted = op >> 6;
        welcome.player = config.mode == SessionMode::spectator ? 0xff : op >> 4 & 3;
        if ((op & 8) != 0) welcome.others = 2u << (op >> 4 & 3) & 7u;
        welcome.start = {client.session.confirmed(), script.byte()};
        if (here == 0) welcome.start = {0, Game{}.hash()};
        if (op >= 128) welcome.start.frame = script.frame(here);
        welcome.hash = script.byte() % 2 == 0 ? Game{}.hash() : 1;
        welcome.opens = script.byte() % 2 == 0 ? kNoFrame : script.frame(here);
        if (op >= 160) welcome.snapshot_size = script.byte() < 128 ? 2 * script.byte() : script.word();
        if (op >= 224) welcome.snapshot_from = script.byte() < 128 ? script.byte() : script.word();
        if (op >= 240) {
          Writer state(bytes);
          Game{}.write_portable(state);
          welcome.snapshot_size = static_cast<std::uint32_t>(bytes.size());
        }
        Buffer message;
        write_welcome(welcome, message);
        hear(Channel::reliable, message);
        for (std::size_t at = 0; at < bytes.size(); at += 16000) {
          write_piece({static_cast<std::uint32_t>(at),
                       Bytes(bytes).subspan(at, std::min<std::size_t>(16000, bytes.size() - at))},
                      message);
          hear(Channel::reliable, message);
        }
        break;
      }
      case 5: {
        const std::uint32_t offset =
            op < 128 ? static_cast<std::uint32_t>(client.session.portable().size()) : script.word();
        write_piece({offset, script.some(script.byte())}, bytes);
        hear(Channel::reliable, bytes);
        break;
      }
      case 6:
        write_open(script.frame(here), bytes);
        hear(Channel::reliable, bytes);
        break;
      case 7:
        if (op >= 128) client.session.disconnected(0, now);
        if (op % 3 != 0) client.session.connected(0, now);
        break;
      default: hear(Channel::datagram, any_datagram(script, 9, here, op >> 4 & 3)); break;
    }
    require(client.session.portable().capacity() <= 2 * told + 64);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Script script(data, size);
  switch (script.byte() % 4) {
    case 0: attack_host(script); break;
    case 1: attack_client(script); break;
    default: parse(script.rest());
  }
  return 0;
}
