// The events of the simulated network: datagrams, pieces of reliable messages, connections.
// SPDX-License-Identifier: MIT
#include "transport/simulated_network.hpp"

#include <algorithm>

namespace isostep::transport {
namespace {

/// A piece is sent again a round trip and this later, then twice as much later each time, up to the longest.
constexpr Time kPatience = 10000;           // [us]
constexpr Time kLongestPatience = kSecond;  // [us]

Direction reverse(Direction direction) { return direction == Direction::up ? Direction::down : Direction::up; }
std::size_t index_of(Direction direction) { return static_cast<std::size_t>(direction); }

}  // namespace

SimulatedNetwork::SimulatedNetwork(const SimulationSettings& settings)
    : settings_(settings), peers_(settings.max_peers, nullptr), inboxes_(1), handed_out_(1) {}

EndpointId SimulatedNetwork::add_client(const NetworkProfile& profile) {
  const EndpointId id = static_cast<EndpointId>(clients_.size() + 1);
  const std::uint64_t stream = 2 * std::uint64_t{id};
  clients_.push_back(std::make_unique<Client>(Client{
      .id = id,
      .lines = {
          {.direction = {profile.up, settings_.seed, stream}, .statistics = {}, .messages = {}, .losing_since = {}},
          {.direction = {profile.down, settings_.seed, stream + 1},
           .statistics = {},
           .messages = {},
           .losing_since = {}}}}));
  inboxes_.emplace_back();
  handed_out_.emplace_back();
  return id;
}

void SimulatedNetwork::set_profile(EndpointId client, const NetworkProfile& profile) {
  for (const Direction direction : kDirections) {
    client_of(client).lines[index_of(direction)].direction.set_conditions(profile.of(direction));
  }
}

void SimulatedNetwork::set_silent(EndpointId client, bool silent) { client_of(client).silent = silent; }

const DirectionStatistics& SimulatedNetwork::statistics(EndpointId client, Direction direction) const {
  return clients_[client - 1]->lines[index_of(direction)].statistics;
}

// ---- connections

bool SimulatedNetwork::connect(EndpointId id) {
  Client& client = client_of(id);
  if (client.active) return false;
  ++client.connection;
  client.active = true;
  client.ears[index_of(Direction::down)] = Ear::waiting;
  for (Line& line : client.lines) {
    line.messages.clear();
    line.next_number = 0;
    line.losing_since.reset();
  }
  send_reliable(client, Direction::up, Content::hello, nullptr);
  advance_to(now_);
  return true;
}

void SimulatedNetwork::cut(EndpointId client) { close(client_of(client)); }

/// The connection behind a sender's peer number; null when that side is not, or no longer, part of one.
SimulatedNetwork::Client* SimulatedNetwork::other_end(EndpointId from, PeerId peer) {
  const bool is_host = from == kHost;
  Client* client = nullptr;
  if (is_host && peer < peers_.size()) client = peers_[peer];
  if (!is_host && peer == 0) client = &client_of(from);
  if (client == nullptr) return nullptr;
  const Direction heard = is_host ? Direction::up : Direction::down;
  return client->ears[index_of(heard)] == Ear::closed ? nullptr : client;
}

void SimulatedNetwork::disconnect(EndpointId from, PeerId peer) {
  std::erase_if(inboxes_[from], [&](const Waiting& waiting) { return waiting.peer == peer; });
  Client* client = other_end(from, peer);
  if (client == nullptr) return;
  const Direction direction = from == kHost ? Direction::down : Direction::up;
  client->ears[index_of(reverse(direction))] = Ear::closed;
  send_reliable(*client, direction, Content::goodbye, nullptr);
  advance_to(now_);
}

/// The host's, to a hello.
void SimulatedNetwork::answer(Client& client) {
  const auto free = std::find(peers_.begin(), peers_.end(), nullptr);
  if (free == peers_.end()) return send_reliable(client, Direction::down, Content::goodbye, nullptr);
  *free = &client;
  client.hosted = true;
  client.peer = static_cast<PeerId>(free - peers_.begin());
  client.ears[index_of(Direction::up)] = Ear::open;
  arrive(client, Direction::up, ArrivalKind::connected, Channel::reliable, nullptr);
  send_reliable(client, Direction::down, Content::welcome, nullptr);
}

void SimulatedNetwork::hang_up(Client& client, Direction direction) {
  Ear& ear = client.ears[index_of(direction)];
  if (ear != Ear::closed) arrive(client, direction, ArrivalKind::disconnected, Channel::reliable, nullptr);
  ear = Ear::closed;
}

void SimulatedNetwork::close(Client& client) {
  for (const Direction direction : kDirections) hang_up(client, direction);
  finish(client);
}

void SimulatedNetwork::finish(Client& client) {
  if (client.hosted) peers_[client.peer] = nullptr;
  client.hosted = client.active = false;
}

// ---- sending

Result<void> SimulatedNetwork::send(EndpointId from, PeerId peer, Channel channel, Bytes bytes) {
  if (bytes.size() > cap_of(channel)) {
    ++oversized_;
    return Error{ErrorCode::limit, "the message is larger than its channel's cap", "send"};
  }
  Client* client = other_end(from, peer);
  const Direction direction = from == kHost ? Direction::down : Direction::up;
  if (client == nullptr || client->ears[index_of(reverse(direction))] != Ear::open) {
    ++unaddressed_;
    return Error{ErrorCode::invalid, "the peer is not connected", "send"};
  }
  DirectionStatistics& statistics = client->lines[index_of(direction)].statistics;
  const bool reliable = channel == Channel::reliable;
  (reliable ? statistics.reliable : statistics.datagrams) += 1;
  (reliable ? statistics.reliable_bytes : statistics.datagram_bytes) += bytes.size();
  Payload payload = std::make_shared<const std::vector<std::uint8_t>>(bytes.begin(), bytes.end());
  if (reliable) send_reliable(*client, direction, Content::message, std::move(payload));
  else send_datagram(*client, direction, std::move(payload));
  advance_to(now_);
  return {};
}

void SimulatedNetwork::send_datagram(Client& client, Direction direction, Payload payload) {
  const std::uint64_t connection = client.connection;
  const Fate fate = put_on_line(client, direction, payload->size());
  for (std::uint32_t copy = 0; copy < fate.copies; ++copy) {
    schedule(fate.arrives[copy], {What::datagram_arrives, direction, client.id, connection, payload});
  }
}

void SimulatedNetwork::send_reliable(Client& client, Direction direction, Content content, Payload payload) {
  Line& line = client.lines[index_of(direction)];
  const std::size_t size = payload ? payload->size() : 0;
  const std::uint64_t number = line.next_number++;
  const std::size_t pieces = size == 0 ? 1 : (size + kDatagramCap - 1) / kDatagramCap;
  line.messages[number] = {content, static_cast<std::uint32_t>(pieces), std::move(payload)};
  for (std::size_t piece = 0; piece < pieces && client.active; ++piece) {
    const std::size_t bytes = std::min(kDatagramCap, size - piece * kDatagramCap);
    try_piece(client, {What::try_piece, direction, client.id, client.connection, nullptr, number,
                       static_cast<std::uint32_t>(bytes)});
  }
}

/// Sends the piece, and arranges its arrival or the next attempt. That the sender knows of the loss stands for the
/// acknowledgement that does not come; lost acknowledgements would only repeat what has arrived.
void SimulatedNetwork::try_piece(Client& client, Event event) {
  DirectionStatistics& statistics = client.lines[index_of(event.direction)].statistics;
  if (event.attempt != 0) ++statistics.repeated;
  const Fate fate = put_on_line(client, event.direction, event.bytes);
  if (fate.copies != 0) {
    event.what = What::piece_arrives;
    return schedule(fate.arrives[0], std::move(event));
  }
  Time patience = kPatience;
  for (const Line& line : client.lines) {
    patience += Time{line.direction.conditions().latency} + line.direction.conditions().jitter;
  }
  const Time longest = std::max(patience, kLongestPatience);
  patience = std::min(longest, patience << std::min(event.attempt, 10u));
  event.what = What::try_piece;
  ++event.attempt;
  schedule(now_ + patience, std::move(event));
}

/// Also ends the connection when the line has been dead for too long.
Fate SimulatedNetwork::put_on_line(Client& client, Direction direction, std::size_t bytes) {
  Line& line = client.lines[index_of(direction)];
  Fate fate = line.direction.decide(now_, bytes);
  if (client.silent) fate = {};
  ++line.statistics.packets;
  line.statistics.packet_bytes += bytes;
  if (fate.copies == 2) ++line.statistics.doubled;
  if (fate.copies != 0) {
    line.losing_since.reset();
    return fate;
  }
  ++line.statistics.lost;
  if (!line.losing_since) line.losing_since = now_;
  if (now_ - *line.losing_since >= settings_.timeout) close(client);
  return fate;
}

// ---- events

void SimulatedNetwork::schedule(Time time, Event event) {
  events_.emplace(std::pair(time, scheduled_++), std::move(event));
}

std::optional<Time> SimulatedNetwork::next_event_time() const {
  if (events_.empty()) return std::nullopt;
  return events_.begin()->first.first;
}

void SimulatedNetwork::advance_to(Time time) {
  while (!events_.empty() && events_.begin()->first.first <= time) {
    const auto next = events_.extract(events_.begin());
    now_ = next.key().first;
    run(next.mapped());
  }
  now_ = std::max(now_, time);
}

void SimulatedNetwork::run(const Event& event) {
  Client& client = client_of(event.client);
  if (!client.active || client.connection != event.connection) return;
  if (event.what == What::try_piece) return try_piece(client, event);
  if (event.what == What::piece_arrives) return piece_arrived(client, event);
  Line& line = client.lines[index_of(event.direction)];
  if (client.ears[index_of(event.direction)] != Ear::open) {
    ++line.statistics.unexpected;
    return;
  }
  ++line.statistics.delivered;
  arrive(client, event.direction, ArrivalKind::message, Channel::datagram, event.payload);
}

void SimulatedNetwork::piece_arrived(Client& client, const Event& event) {
  auto& messages = client.lines[index_of(event.direction)].messages;
  --messages.at(event.number).pieces_left;
  while (client.active && !messages.empty() && messages.begin()->second.pieces_left == 0) {
    const auto first = messages.extract(messages.begin());
    deliver(client, event.direction, first.mapped());
  }
}

void SimulatedNetwork::deliver(Client& client, Direction direction, const Message& message) {
  Ear& ear = client.ears[index_of(direction)];
  switch (message.content) {
    case Content::hello: return answer(client);
    case Content::welcome:
      if (ear == Ear::closed) return;
      ear = Ear::open;
      return arrive(client, direction, ArrivalKind::connected, Channel::reliable, nullptr);
    case Content::goodbye: hang_up(client, direction); return finish(client);
    case Content::message:
      if (ear != Ear::open) return;
      ++client.lines[index_of(direction)].statistics.delivered;
      return arrive(client, direction, ArrivalKind::message, Channel::reliable, message.payload);
  }
}

void SimulatedNetwork::arrive(Client& client, Direction direction, ArrivalKind kind, Channel channel, Payload payload) {
  const bool to_host = direction == Direction::up;
  const PeerId peer = to_host ? client.peer : PeerId{0};
  inboxes_[to_host ? kHost : client.id].push_back({kind, peer, channel, std::move(payload)});
}

void SimulatedNetwork::inject(EndpointId to, PeerId from, Channel channel, Bytes bytes) {
  Payload payload = std::make_shared<const std::vector<std::uint8_t>>(bytes.begin(), bytes.end());
  inboxes_[to].push_back({ArrivalKind::message, from, channel, std::move(payload)});
}

std::optional<Arrival> SimulatedNetwork::receive(EndpointId endpoint) {
  std::deque<Waiting>& inbox = inboxes_[endpoint];
  if (inbox.empty()) return std::nullopt;
  const Waiting next = std::move(inbox.front());
  inbox.pop_front();
  handed_out_[endpoint] = next.payload;
  const Bytes bytes = next.payload ? Bytes(*next.payload) : Bytes{};
  return Arrival{next.kind, next.peer, next.channel, bytes};
}

}  // namespace isostep::transport
