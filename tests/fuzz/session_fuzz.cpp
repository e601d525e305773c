// libFuzzer target: the input is a script of what a hostile peer says and when, to the parsers, a host, or a client.
// SPDX-License-Identifier: MIT
//
// clang++ -std=c++20 -O1 -g -fsanitize=fuzzer,address,undefined -Dalways_inline= -Iscalar/include -Iinclude -Isrc
//         -Itests tests/fuzz/session_fuzz.cpp src/isostep/{session,session/*,geometry,state}/*.cpp scalar/src/*.cpp
//         src/transport/{simulated_network,impaired_direction,network_profile}.cpp build/release/libisostep.a
//         -o session_fuzz

#include <deque>

#include "fuzz/session_script.hpp"
#include "isostep/session/agreement/roster.hpp"

namespace {

using namespace isostep;
using namespace isostep::fuzz;
using hostile::Buffer;
using hostile::Game;

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
  if (const Result<Frame> state = read_inquiry(bytes)) require(state.value() >= 0 && state.value() <= kLastFrame);
  if (const Result<Statement> read = read_statement(bytes)) require(read.value().frame >= 0);
  if (const Result<Statements> read = read_statements(bytes)) {
    const Verdict verdict = judge(read.value());
    require(verdict.minority >> kMachines == 0 && (verdict.is_decided || verdict.minority == 0));
  }
  if (const Result<RepairOffer> read = read_offer(bytes)) require(read.value().start.frame >= 0);
  if (const Result<Repaired> read = read_repaired(bytes)) require(read.value().after >= 0);
  if (const Result<Roster> read = read_roster(bytes)) {
    const Roster& roster = read.value();
    require(roster.count <= kMaxPlayers + 1 && roster.version > 0);
    require(roster.host < roster.count && roster.casting < roster.count);
    Buffer again;
    write_roster(roster, again);
    require(again.size() == bytes.size());
  }
  if (const Result<Candidate> read = read_candidate(bytes)) require(read.value().ends[0] >= 0);
  (void)read_known(bytes).ok();
  (void)read_support(bytes).ok();
  (void)read_redirect(bytes).ok();
}

// --- live ---

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
  bool has_couch = false;  // somebody asked for several seats
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
        has_couch = has_couch || hello.seats > 1;
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
        if (how % 4 == 1) write_progress(how < 128 ? script.byte() * 256u : script.word(), bytes);
        if (how % 4 == 2) write_ready(bytes);
        if (how % 4 == 3 && how < 128) bytes = any_word_of_states(script, host.session.current(), false);
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
    require(!first || !second || *first != *second || has_couch);
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
      case 6: {
        if (op < 128) write_open(script.frame(here), bytes);
        else bytes = any_word_of_states(script, here, true);
        if (op % 7 == 0) (void)client.session.resync();
        hear(Channel::reliable, bytes);
        break;
      }
      case 7:
        if (op >= 128) client.session.disconnected(0, now);
        if (op % 3 != 0) client.session.connected(0, now);
        break;
      default: hear(Channel::datagram, any_datagram(script, 9, here, op >> 4 & 3)); break;
    }
    require(client.session.portable().capacity() <= 2 * told + 64);
  }
}

/// A client whose host is gone, and that may follow it: three callers say what the script says.
void attack_candidate(Script& script) {
  const std::uint8_t options = script.byte();
  SessionConfig config = small_config(options);
  config.local_players = 0;
  config.migration = kSecond / 2;
  config.address = "1";
  config.seed = 7;
  Side client(config);
  Time now = 1000;
  const auto ignore = [](const Outgoing&) {};
  client.turn(now, ignore);
  client.session.connected(0, now);
  client.turn(now, ignore);
  Buffer bytes, scratch;
  Welcome welcome{.match = 9, .players = 3, .hosted = 1, .player = 1, .token = 101};
  welcome.start = {0, Game{}.hash()};
  welcome.opens = 0;
  write_welcome(welcome, bytes);
  client.session.receive(0, Channel::reliable, bytes, now);
  Roster roster;
  roster.version = 3;
  roster.count = 3;
  for (std::uint8_t m = 0; m < 3; ++m) roster.machines[m] = {1u << m, proof_of(100u + m), 1u + m, true, true, "1", 0};
  for (std::uint8_t m = 0; m < 3; ++m) roster.machines[m].seal = seal_of(roster, 100u + m, scratch);
  write_roster(roster, bytes);
  client.session.receive(0, Channel::reliable, bytes, now);
  for (int step = 0; step < 400 && !script.over(); ++step) {
    const std::uint8_t op = script.byte();
    const PeerId peer = static_cast<PeerId>(op >> 6);
    const Frame here = client.session.current();
    bytes.clear();
    switch (op % 10) {
      case 0:
      case 1:
        for (int turns = 1 + (op >> 4) % 4; turns > 0; --turns) {
          now += op % 10 == 0 ? 17000 : 90000;
          client.turn(now, ignore);
        }
        break;
      case 2: client.session.connected(peer, now, true); break;
      case 3: {
        Hello hello = hostile::hello_of(config);
        hello.token = 100u + script.byte() % 4;
        hello.have = {script.frame(here), script.byte()};
        write_hello(hello, bytes);
        client.session.receive(peer, Channel::reliable, bytes, now);
        break;
      }
      case 4: {
        Support support;
        support.term = 2u + script.byte() % 3;
        write_support(support, bytes);
        client.session.receive(peer, Channel::reliable, bytes, now);
        break;
      }
      case 5: {
        Roster other = roster;
        other.version = script.byte() % 8 + 1u;
        other.count = static_cast<std::uint8_t>(1 + script.byte() % 3);
        other.host = 0;
        other.casting = script.byte() % 4;
        other.was_casting = script.byte() % 2 == 0 ? Roster::kNoCasting : script.byte() % 4;
        if (script.byte() < 128) other.machines[1].seal = seal_of(other, 101, scratch);
        write_roster(other, bytes);
        client.session.receive(peer, Channel::reliable, bytes, now);
        break;
      }
      case 6:
      case 7:
        write_known(any_datagram(script, 9, here, op >> 4 & 3), bytes);
        client.session.receive(peer, Channel::reliable, bytes, now);
        break;
      case 8:
        if (op < 200) client.session.receive(peer, Channel::reliable, script.some(script.byte()), now);
        else client.session.disconnected(peer, now);
        break;
      default: client.session.receive(peer, Channel::datagram, any_datagram(script, 9, here, op >> 4 & 3), now); break;
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Script script(data, size);
  switch (script.byte() % 5) {
    case 0: attack_host(script); break;
    case 1: attack_client(script); break;
    case 2: attack_candidate(script); break;
    default: parse(script.rest());
  }
  return 0;
}
