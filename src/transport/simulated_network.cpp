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

SimulatedNetwork::SimulatedNetwork(const SimulationSettings& settings) : settings_(settings) {
  stations_.emplace_back().peers.resize(settings_.max_peers);
}

EndpointId SimulatedNetwork::add_client(const NetworkProfile& profile) {
  const EndpointId id = static_cast<EndpointId>(stations_.size());
  Station& station = stations_.emplace_back();
  station.profile = profile;
  station.home = links_.size();
  station.peers.resize(settings_.max_peers);
  add_link(id, kHost, profile, 2 * std::uint64_t{id});
  return id;
}

SimulatedNetwork::Link& SimulatedNetwork::add_link(EndpointId from, EndpointId to, const NetworkProfile& profile,
                                                   std::uint64_t stream) {
  links_.push_back(std::make_unique<Link>(Link{
      .number = links_.size(),
      .ends = {to, from},
      .lines = {
          {.direction = {profile.up, settings_.seed, stream}, .statistics = {}, .messages = {}, .losing_since = {}},
          {.direction = {profile.down, settings_.seed, stream + 1},
           .statistics = {},
           .messages = {},
           .losing_since = {}}}}));
  return *links_.back();
}

SimulatedNetwork::Link& SimulatedNetwork::link_between(EndpointId from, EndpointId to) {
  if (to == kHost) return home_of(from);
  for (const std::unique_ptr<Link>& link : links_) {
    if (link->ends[index_of(Direction::down)] == from && link->ends[index_of(Direction::up)] == to) return *link;
  }
  // Streams of random numbers that no client's own link has.
  const std::uint64_t stream = (std::uint64_t{from} << 32 | to) << 1 | std::uint64_t{1} << 63;
  return add_link(from, to, stations_[from == kHost ? to : from].profile, stream);
}

void SimulatedNetwork::set_profile(EndpointId client, const NetworkProfile& profile) {
  stations_[client].profile = profile;
  for (const std::unique_ptr<Link>& link : links_) {
    const EndpointId from = link->ends[index_of(Direction::down)], to = link->ends[index_of(Direction::up)];
    if (from != client && !(from == kHost && to == client)) continue;
    for (const Direction direction : kDirections) {
      link->lines[index_of(direction)].direction.set_conditions(profile.of(direction));
    }
  }
}

void SimulatedNetwork::set_silent(EndpointId endpoint, bool silent) { stations_[endpoint].silent = silent; }

void SimulatedNetwork::set_side(EndpointId endpoint, int side) { stations_[endpoint].side = side; }

const DirectionStatistics& SimulatedNetwork::statistics(EndpointId client, Direction direction) const {
  return home_of(client).lines[index_of(direction)].statistics;
}

// ---- connections

/// The end that the direction leads to calls the other by its lowest free number; a client's 0 is the host's.
bool SimulatedNetwork::take_number(Link& link, Direction direction) {
  const std::size_t d = index_of(direction);
  const EndpointId other = link.ends[index_of(reverse(direction))];
  std::vector<Link*>& peers = stations_[link.ends[d]].peers;
  const std::size_t first = link.ends[d] == kHost || other == kHost ? 0 : 1;
  for (std::size_t number = first; number < peers.size(); ++number) {
    if (peers[number] != nullptr) continue;
    peers[number] = &link;
    link.numbered[d] = true;
    link.peers[d] = static_cast<PeerId>(number);
    return true;
  }
  return false;
}

bool SimulatedNetwork::connect(EndpointId from, EndpointId to) {
  if (from == to) return false;
  Link& link = link_between(from, to);
  if (link.active || !take_number(link, Direction::down)) return false;
  ++link.connection;
  link.active = true;
  link.ears[index_of(Direction::down)] = Ear::waiting;
  for (Line& line : link.lines) {
    line.messages.clear();
    line.next_number = 0;
    line.losing_since.reset();
  }
  send_reliable(link, Direction::up, Content::hello, nullptr);
  advance_to(now_);
  return true;
}

void SimulatedNetwork::cut(EndpointId client) { close(home_of(client)); }

SimulatedNetwork::Link* SimulatedNetwork::link_of(EndpointId from, PeerId peer, Direction& direction) {
  const std::vector<Link*>& peers = stations_[from].peers;
  Link* link = peer < peers.size() ? peers[peer] : nullptr;
  if (link == nullptr) return nullptr;
  direction = link->ends[index_of(Direction::down)] == from ? Direction::up : Direction::down;
  return link->ears[index_of(reverse(direction))] == Ear::closed ? nullptr : link;
}

void SimulatedNetwork::disconnect(EndpointId from, PeerId peer) {
  std::erase_if(stations_[from].inbox, [&](const Waiting& waiting) { return waiting.peer == peer; });
  Direction direction = Direction::up;
  Link* link = link_of(from, peer, direction);
  if (link == nullptr) return;
  link->ears[index_of(reverse(direction))] = Ear::closed;
  send_reliable(*link, direction, Content::goodbye, nullptr);
  advance_to(now_);
}

/// Answers a hello on the side that is connected to.
void SimulatedNetwork::answer(Link& link) {
  if (!take_number(link, Direction::up)) return send_reliable(link, Direction::down, Content::goodbye, nullptr);
  link.ears[index_of(Direction::up)] = Ear::open;
  arrive(link, Direction::up, ArrivalKind::connected, Channel::reliable, nullptr);
  send_reliable(link, Direction::down, Content::welcome, nullptr);
}

void SimulatedNetwork::hang_up(Link& link, Direction direction) {
  Ear& ear = link.ears[index_of(direction)];
  if (ear != Ear::closed) arrive(link, direction, ArrivalKind::disconnected, Channel::reliable, nullptr);
  ear = Ear::closed;
}

void SimulatedNetwork::close(Link& link) {
  for (const Direction direction : kDirections) hang_up(link, direction);
  finish(link);
}

void SimulatedNetwork::finish(Link& link) {
  for (const Direction direction : kDirections) {
    const std::size_t d = index_of(direction);
    if (link.numbered[d]) stations_[link.ends[d]].peers[link.peers[d]] = nullptr;
    link.numbered[d] = false;
  }
  link.active = false;
}

// ---- sending

Result<void> SimulatedNetwork::send(EndpointId from, PeerId peer, Channel channel, Bytes bytes) {
  if (bytes.size() > cap_of(channel)) {
    ++oversized_;
    return Error{ErrorCode::limit, "the message is larger than its channel's cap", "send"};
  }
  Direction direction = Direction::up;
  Link* link = link_of(from, peer, direction);
  if (link == nullptr || link->ears[index_of(reverse(direction))] != Ear::open) {
    ++unaddressed_;
    return Error{ErrorCode::invalid, "the peer is not connected", "send"};
  }
  DirectionStatistics& statistics = link->lines[index_of(direction)].statistics;
  const bool reliable = channel == Channel::reliable;
  (reliable ? statistics.reliable : statistics.datagrams) += 1;
  (reliable ? statistics.reliable_bytes : statistics.datagram_bytes) += bytes.size();
  Payload payload = std::make_shared<const std::vector<std::uint8_t>>(bytes.begin(), bytes.end());
  if (reliable) send_reliable(*link, direction, Content::message, std::move(payload));
  else send_datagram(*link, direction, std::move(payload));
  advance_to(now_);
  return {};
}

void SimulatedNetwork::send_datagram(Link& link, Direction direction, Payload payload) {
  const std::uint64_t connection = link.connection;
  const Fate fate = put_on_line(link, direction, payload->size());
  for (std::uint32_t copy = 0; copy < fate.copies; ++copy) {
    schedule(fate.arrives[copy], {What::datagram_arrives, direction, link.number, connection, payload});
  }
}

void SimulatedNetwork::send_reliable(Link& link, Direction direction, Content content, Payload payload) {
  Line& line = link.lines[index_of(direction)];
  const std::size_t size = payload ? payload->size() : 0;
  const std::uint64_t number = line.next_number++;
  const std::size_t pieces = size == 0 ? 1 : (size + cap_of(Channel::datagram) - 1) / cap_of(Channel::datagram);
  line.messages[number] = {content, static_cast<std::uint32_t>(pieces), std::move(payload)};
  for (std::size_t piece = 0; piece < pieces && link.active; ++piece) {
    const std::size_t bytes = std::min(cap_of(Channel::datagram), size - piece * cap_of(Channel::datagram));
    try_piece(link, {What::try_piece, direction, link.number, link.connection, nullptr, number,
                     static_cast<std::uint32_t>(bytes)});
  }
}

/// Sends the piece, and arranges its arrival or the next attempt. That the sender knows of the loss stands for the
/// acknowledgement that does not come; lost acknowledgements would only repeat what has arrived.
void SimulatedNetwork::try_piece(Link& link, Event event) {
  DirectionStatistics& statistics = link.lines[index_of(event.direction)].statistics;
  if (event.attempt != 0) ++statistics.repeated;
  const Fate fate = put_on_line(link, event.direction, event.bytes);
  if (fate.copies != 0) {
    event.what = What::piece_arrives;
    return schedule(fate.arrives[0], std::move(event));
  }
  Time patience = kPatience;
  for (const Line& line : link.lines) {
    patience += Time{line.direction.conditions().latency} + line.direction.conditions().jitter;
  }
  const Time longest = std::max(patience, kLongestPatience);
  patience = std::min(longest, patience << std::min(event.attempt, 10u));
  event.what = What::try_piece;
  ++event.attempt;
  schedule(now_ + patience, std::move(event));
}

/// Puts a packet on the line. Ends the connection when the line has been dead for too long.
Fate SimulatedNetwork::put_on_line(Link& link, Direction direction, std::size_t bytes) {
  Line& line = link.lines[index_of(direction)];
  Fate fate = line.direction.decide(now_, bytes);
  const Station &from = stations_[link.ends[index_of(reverse(direction))]],
                &to = stations_[link.ends[index_of(direction)]];
  if (from.silent || to.silent || from.side != to.side) fate = {};
  ++line.statistics.packets;
  line.statistics.packet_bytes += bytes;
  if (fate.copies == 2) ++line.statistics.doubled;
  if (fate.copies != 0) {
    line.losing_since.reset();
    return fate;
  }
  ++line.statistics.lost;
  if (!line.losing_since) line.losing_since = now_;
  if (now_ - *line.losing_since >= settings_.timeout) close(link);
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
  Link& link = *links_[event.link];
  if (!link.active || link.connection != event.connection) return;
  if (event.what == What::try_piece) return try_piece(link, event);
  if (event.what == What::piece_arrives) return piece_arrived(link, event);
  Line& line = link.lines[index_of(event.direction)];
  if (link.ears[index_of(event.direction)] != Ear::open) {
    ++line.statistics.unexpected;
    return;
  }
  ++line.statistics.delivered;
  arrive(link, event.direction, ArrivalKind::message, Channel::datagram, event.payload);
}

void SimulatedNetwork::piece_arrived(Link& link, const Event& event) {
  auto& messages = link.lines[index_of(event.direction)].messages;
  --messages.at(event.number).pieces_left;
  while (link.active && !messages.empty() && messages.begin()->second.pieces_left == 0) {
    const auto first = messages.extract(messages.begin());
    deliver(link, event.direction, first.mapped());
  }
}

void SimulatedNetwork::deliver(Link& link, Direction direction, const Message& message) {
  Ear& ear = link.ears[index_of(direction)];
  switch (message.content) {
    case Content::hello: return answer(link);
    case Content::welcome:
      if (ear == Ear::closed) return;
      ear = Ear::open;
      return arrive(link, direction, ArrivalKind::connected, Channel::reliable, nullptr);
    case Content::goodbye: hang_up(link, direction); return finish(link);
    case Content::message:
      if (ear != Ear::open) return;
      ++link.lines[index_of(direction)].statistics.delivered;
      return arrive(link, direction, ArrivalKind::message, Channel::reliable, message.payload);
  }
}

void SimulatedNetwork::arrive(Link& link, Direction direction, ArrivalKind kind, Channel channel, Payload payload) {
  const std::size_t d = index_of(direction);
  stations_[link.ends[d]].inbox.push_back(
      {kind, direction == Direction::up, link.peers[d], channel, std::move(payload)});
}

void SimulatedNetwork::inject(EndpointId to, PeerId from, Channel channel, Bytes bytes) {
  Payload payload = std::make_shared<const std::vector<std::uint8_t>>(bytes.begin(), bytes.end());
  stations_[to].inbox.push_back({ArrivalKind::message, false, from, channel, std::move(payload)});
}

std::optional<Arrival> SimulatedNetwork::receive(EndpointId endpoint) {
  Station& station = stations_[endpoint];
  if (station.inbox.empty()) return std::nullopt;
  const Waiting next = std::move(station.inbox.front());
  station.inbox.pop_front();
  station.handed_out = next.payload;
  const Bytes bytes = next.payload ? Bytes(*next.payload) : Bytes{};
  return Arrival{next.kind, next.peer, next.channel, bytes, next.incoming};
}

}  // namespace isostep::transport
