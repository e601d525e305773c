// The ENet host behind an endpoint, and what must be set on it before games can use it.
// SPDX-License-Identifier: MIT
#include "transport/enet_transport.hpp"

#include <enet/enet.h>

#include <algorithm>
#include <charconv>
#include <deque>
#include <utility>
#include <vector>

#include "transport/enet_guard.hpp"
#include "transport/enet_lines.hpp"
#include "transport/system_random.hpp"

namespace isostep::transport {
namespace {

static_assert(ENET_VERSION >= ENET_VERSION_CREATE(1, 3, 17), "earlier ones crash on some unsequenced packets");

constexpr enet_uint8 kDatagrams = 0, kReliables = 1;  // ENet's channels

/// [bytes] The cap on messages of one peer that ENet holds for us: reliable ones out of order, and what poll() leaves
/// behind.
constexpr std::size_t kWaitingCap = 512 << 10;

/// ENet drops unreliable messages on purpose when round trips grow. Recovering all at once and never giving way means
/// that it does not. Both sides set it: each setting is also sent, and becomes the other's.
constexpr enet_uint32 kThrottleInterval = 5000;  // [ms]
constexpr enet_uint32 kRecoverAtOnce = ENET_PEER_PACKET_THROTTLE_SCALE;
constexpr enet_uint32 kNeverGiveWay = 0;

enum class Link : std::uint8_t { none, attempting, open, closing };

struct Peer {
  Link link = Link::none;
  std::uint32_t datagrams = 0;     // taken from it in this poll
  std::size_t unacknowledged = 0;  // [bytes] given to ENet reliably, not yet let go
};

/// ENet lets a reliable packet go when it is acknowledged or its peer is reset.
void ENET_CALLBACK let_go(ENetPacket* packet) {
  static_cast<Peer*>(packet->userData)->unacknowledged -= packet->dataLength;
}

Error failure(const char* what, const char* place) { return {ErrorCode::invalid, what, place}; }

}  // namespace

struct EnetTransport::State {
  struct Waiting {
    ArrivalKind kind;
    PeerId peer;
    Channel channel;
    ENetPacket* packet;  // of a message
    bool incoming = false;
  };

  EnetSettings settings;
  EnetStatistics statistics;
  bool accepts = false;  // connections that others ask for
  std::optional<EnetLines> lines;
  bool more = false;  // the last poll left something behind
  ENetHost* host = nullptr;
  ENetAddress target = {};     // of the last connection that we asked for
  std::optional<PeerId> ours;  // that connection, until it ends
  std::vector<Peer> peers;
  std::deque<Waiting> inbox;
  ENetPacket* handed_out = nullptr;  // what the last receive() shows

  ~State();
  Result<void> open(const ENetAddress* address);
  Result<void> attempt(const ENetAddress& address);
  ENetPeer* enet_peer(PeerId peer) { return &host->peers[peer]; }
  void leave(PeerId peer);
  void purge(PeerId peer);
  void poll();
  void handle(const ENetEvent& event);
  void handle_connect(PeerId peer);
  void handle_disconnect(PeerId peer);
  void handle_message(PeerId peer, enet_uint8 enet_channel, ENetPacket* packet);
  void count();
};

// ---- opening and ending

EnetTransport::State::~State() {
  if (host == nullptr) return;
  for (PeerId peer = 0; peer < peers.size(); ++peer) leave(peer);
  if (handed_out != nullptr) enet_packet_destroy(handed_out);
  enet_host_destroy(host);
  enet_deinitialize();
}

Result<void> EnetTransport::State::open(const ENetAddress* address) {
  std::uint64_t secret[2];
  if (!draw_secret(secret)) return failure("the system gives no random numbers", "draw_secret");
  if (enet_initialize() != 0) return failure("ENet could not start", "enet_initialize");
  peers.resize(settings.max_peers);
  host = enet_host_create(address, peers.size(), kEnetChannels, 0, 0);
  if (host == nullptr) {
    enet_deinitialize();
    return failure("no socket: the port is taken, or the address is not of this machine", "enet_host_create");
  }
  host->mtu = kEnetMtu;
  host->maximumPacketSize = cap_of(Channel::reliable);
  host->maximumWaitingData = kWaitingCap;
  host->duplicatePeers = settings.max_peers_an_address;
  lines.emplace(Doorkeeper(settings.key, {secret[0], secret[1]}), accepts);
  lines->guard(host);
  // Takes the host's MTU over: until 1.3.18 nothing else does.
  for (PeerId peer = 0; peer < peers.size(); ++peer) enet_peer_reset(enet_peer(peer));
  return {};
}

Result<void> EnetTransport::State::attempt(const ENetAddress& address) {
  target = address;
  std::uint64_t drawn[2];
  if (!draw_secret(drawn)) return failure("the system gives no random numbers", "draw_secret");
  if (ours && peers[*ours].link == Link::attempting) leave(*ours);
  host->randomSeed = static_cast<enet_uint32>(drawn[0]);  // of the identity, by which a host tells connections apart
  ENetPeer* peer = enet_host_connect(host, &target, kEnetChannels, 0);
  if (peer == nullptr) {
    return Error{ErrorCode::limit, "max_peers connections are open or closing", "enet_host_connect"};
  }
  const enet_uint32 milliseconds = static_cast<enet_uint32>(settings.timeout / 1000);
  enet_peer_timeout(peer, ENET_PEER_TIMEOUT_LIMIT, milliseconds, milliseconds);
  ours = peer->incomingPeerID;
  peers[*ours].link = Link::attempting;
  lines->begin(peer, drawn[1]);
  enet_host_flush(host);
  return {};
}

void EnetTransport::State::purge(PeerId peer) {
  std::erase_if(inbox, [&](const Waiting& waiting) {
    if (waiting.peer != peer) return false;
    if (waiting.packet != nullptr) enet_packet_destroy(waiting.packet);
    return true;
  });
}

/// Ends a connection at once and without an event here; the peer is told, once.
void EnetTransport::State::leave(PeerId peer) {
  purge(peer);
  peers[peer].link = Link::none;
  if (ours == peer) ours.reset();
  ENetPeer* remote = enet_peer(peer);
  // A peer that has not answered yet cannot be told.
  if (remote->state == ENET_PEER_STATE_CONNECTING) return enet_peer_reset(remote);
  enet_peer_disconnect_now(remote, 0);
}

// ---- events

void EnetTransport::State::poll() {
  constexpr enet_uint32 kEnetPackets = 256;  // that ENet reads before it looks whether there is anything to tell
  // Looks that find nothing: an error is of one packet, of a peer out of reach or a stranger's above ENet's buffer; and
  // 256 packets that are thrown away leave the rest waiting.
  constexpr int kMostEmpty = 64;
  int empty = 0;
  more = false;
  for (Peer& peer : peers) peer.datagrams = 0;
  for (std::uint32_t events = 0; events < settings.events_per_poll && inbox.size() < settings.events_per_poll;) {
    ENetEvent event;
    const enet_uint32 before = host->totalReceivedPackets;
    const int found = enet_host_service(host, &event, 0);
    const bool is_flooded = host->totalReceivedPackets - before >= kEnetPackets;
    if (found == 0 && !is_flooded) return count();
    if (found > 0) {
      handle(event);
      ++events;
      continue;
    }
    if (found < 0) ++statistics.socket_errors;
    if (++empty == kMostEmpty) break;
  }
  more = true;
  count();
}

void EnetTransport::State::handle(const ENetEvent& event) {
  const PeerId peer = event.peer->incomingPeerID;
  if (event.type == ENET_EVENT_TYPE_CONNECT) handle_connect(peer);
  if (event.type == ENET_EVENT_TYPE_DISCONNECT) handle_disconnect(peer);
  if (event.type == ENET_EVENT_TYPE_RECEIVE) handle_message(peer, event.channelID, event.packet);
}

void EnetTransport::State::handle_connect(PeerId peer) {
  ENetPeer* remote = enet_peer(peer);
  const bool incoming = peers[peer].link != Link::attempting;
  if ((incoming && !accepts) || remote->mtu != kEnetMtu || remote->channelCount != kEnetChannels) {
    leave(peer);
    if (!incoming) inbox.push_back({ArrivalKind::disconnected, peer, Channel::reliable, nullptr});
    return;
  }
  const enet_uint32 milliseconds = static_cast<enet_uint32>(settings.timeout / 1000);
  enet_peer_timeout(remote, ENET_PEER_TIMEOUT_LIMIT, milliseconds, milliseconds);
  enet_peer_throttle_configure(remote, kThrottleInterval, kRecoverAtOnce, kNeverGiveWay);
  peers[peer].link = Link::open;
  inbox.push_back({ArrivalKind::connected, peer, Channel::reliable, nullptr, incoming});
}

void EnetTransport::State::handle_disconnect(PeerId peer) {
  const Link link = std::exchange(peers[peer].link, Link::none);
  if (ours == peer) ours.reset();
  if (link != Link::open && link != Link::attempting) return;
  inbox.push_back({ArrivalKind::disconnected, peer, Channel::reliable, nullptr});
}

void EnetTransport::State::handle_message(PeerId peer, enet_uint8 enet_channel, ENetPacket* packet) {
  const bool datagram = enet_channel == kDatagrams;
  const Channel channel = datagram ? Channel::datagram : Channel::reliable;
  const enet_uint32 flag = datagram ? ENET_PACKET_FLAG_UNSEQUENCED : ENET_PACKET_FLAG_RELIABLE;
  bool keep = peers[peer].link == Link::open;
  if (keep && (packet->dataLength > cap_of(channel) || (packet->flags & flag) == 0)) {
    ++statistics.refused;
    keep = false;
  }
  if (keep && datagram && ++peers[peer].datagrams > settings.datagrams_per_peer) {
    ++statistics.flooded;
    keep = false;
  }
  if (!keep) return enet_packet_destroy(packet);
  inbox.push_back({ArrivalKind::message, peer, channel, packet});
}

/// ENet's own counters are 32 bits wide.
void EnetTransport::State::count() {
  statistics.packets_sent += std::exchange(host->totalSentPackets, 0u);
  statistics.bytes_sent += std::exchange(host->totalSentData, 0u);
  statistics.packets_received += std::exchange(host->totalReceivedPackets, 0u);
  statistics.bytes_received += std::exchange(host->totalReceivedData, 0u);
  const EnetLines::Sent sent = lines->take_sent();
  statistics.packets_sent += sent.packets;
  statistics.bytes_sent += sent.bytes;
  statistics.implausible = lines->refused();
}

// ---- the endpoint

EnetTransport::EnetTransport(std::unique_ptr<State> state) : state_(std::move(state)) {}
EnetTransport::EnetTransport(EnetTransport&&) noexcept = default;
EnetTransport& EnetTransport::operator=(EnetTransport&&) noexcept = default;
EnetTransport::~EnetTransport() = default;

Result<EnetTransport> EnetTransport::listen(std::uint16_t port, const EnetSettings& settings) {
  if (settings.max_peers == 0 || settings.max_peers > ENET_PROTOCOL_MAXIMUM_PEER_ID) {
    return Error{ErrorCode::limit, "a host has 1 to 4095 peers", "max_peers"};
  }
  ENetAddress address = {ENET_HOST_ANY, port};
  if (!settings.bind_address.empty() && enet_address_set_host(&address, settings.bind_address.c_str()) != 0) {
    return failure("no address has this name", "bind_address");
  }
  auto state = std::make_unique<State>();
  state->settings = settings;
  state->accepts = true;
  if (const Result<void> opened = state->open(&address); !opened) return opened.error();
  return EnetTransport(std::move(state));
}

Result<EnetTransport> EnetTransport::connect(const std::string& address, std::uint16_t port,
                                             const EnetSettings& settings) {
  auto state = std::make_unique<State>();
  state->settings = settings;
  state->settings.max_peers = 1;
  if (const Result<void> opened = state->open(nullptr); !opened) return opened.error();
  EnetTransport transport(std::move(state));
  if (const Result<void> attempted = transport.connect_to(address, port); !attempted) return attempted.error();
  return transport;
}

Result<void> EnetTransport::connect_to(const std::string& name, std::uint16_t port) {
  ENetAddress address = {ENET_HOST_ANY, port};
  if (port == 0 || enet_address_set_host(&address, name.c_str()) != 0) {
    return failure("no address has this name, or its port is 0", "connect");
  }
  return state_->attempt(address);
}

Result<void> EnetTransport::connect_to(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  const std::string name(text.substr(0, colon));
  const std::string_view port = colon == std::string_view::npos ? "" : text.substr(colon + 1);
  ENetAddress address = {ENET_HOST_ANY, 0};
  const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), address.port);
  const bool is_port = error == std::errc() && end == port.data() + port.size() && address.port != 0;
  if (!is_port || enet_address_set_host_ip(&address, name.c_str()) != 0) {
    return failure("expected an address like 192.0.2.7:4000", "connect_to");
  }
  return state_->attempt(address);
}

Result<void> EnetTransport::connect_again() {
  if (state_->target.port == 0) return failure("nobody was connected to before", "connect_again");
  if (state_->ours) state_->leave(*state_->ours);
  return state_->attempt(state_->target);
}

std::uint16_t EnetTransport::port() const { return state_->host->address.port; }
const EnetStatistics& EnetTransport::statistics() const { return state_->statistics; }

void EnetTransport::poll() { state_->poll(); }

void EnetTransport::flush() {
  enet_host_flush(state_->host);
  state_->count();
}

void EnetTransport::wait(Time longest) {
  if (state_->more || !state_->inbox.empty()) return;
  enet_uint32 condition = ENET_SOCKET_WAIT_RECEIVE | ENET_SOCKET_WAIT_INTERRUPT;
  const Time milliseconds = std::min(longest, kSecond) / 1000;
  if (enet_socket_wait(state_->host->socket, &condition, static_cast<enet_uint32>(milliseconds)) != 0) {
    ++state_->statistics.socket_errors;
  }
}

Result<void> EnetTransport::send(PeerId id, Channel channel, Bytes bytes) {
  if (bytes.size() > cap_of(channel)) {
    return Error{ErrorCode::limit, "the message is larger than its channel's cap", "send"};
  }
  if (id >= state_->peers.size() || state_->peers[id].link != Link::open) {
    return failure("the peer is not connected", "send");
  }
  Peer& peer = state_->peers[id];
  const bool reliable = channel == Channel::reliable;
  if (reliable && peer.unacknowledged + bytes.size() > state_->settings.unacknowledged_cap) {
    // Whole and in order, or the connection ends: a message left out would be neither.
    state_->leave(id);
    state_->inbox.push_back({ArrivalKind::disconnected, id, Channel::reliable, nullptr});
    return Error{ErrorCode::limit, "the peer acknowledges too slowly: its connection ends", "unacknowledged_cap"};
  }
  const enet_uint32 flags = reliable ? ENET_PACKET_FLAG_RELIABLE : ENET_PACKET_FLAG_UNSEQUENCED;
  ENetPacket* packet = enet_packet_create(bytes.data(), bytes.size(), flags);
  if (packet == nullptr) return Error{ErrorCode::limit, "no memory for a packet", "send"};
  if (reliable) {
    packet->userData = &peer;
    packet->freeCallback = let_go;
    peer.unacknowledged += bytes.size();
  }
  ENetPeer* remote = state_->enet_peer(id);
  // ENet fragments what is larger than a piece, and fragments are reliable; a datagram fits beside less.
  static_assert(kEnetPiece + 16 >= cap_of(Channel::datagram));
  if (!reliable) remote->mtu = kEnetMtu + 16;
  const int sent = enet_peer_send(remote, reliable ? kReliables : kDatagrams, packet);
  remote->mtu = kEnetMtu;
  if (sent == 0) return {};
  if (packet->referenceCount == 0) enet_packet_destroy(packet);
  return failure("the peer is not connected", "enet_peer_send");
}

std::optional<Arrival> EnetTransport::receive() {
  if (state_->handed_out != nullptr) enet_packet_destroy(std::exchange(state_->handed_out, nullptr));
  if (state_->inbox.empty()) return std::nullopt;
  const State::Waiting next = state_->inbox.front();
  state_->inbox.pop_front();
  state_->handed_out = next.packet;
  const Bytes bytes = next.packet != nullptr ? Bytes(next.packet->data, next.packet->dataLength) : Bytes{};
  return Arrival{next.kind, next.peer, next.channel, bytes, next.incoming};
}

void EnetTransport::disconnect(PeerId id) {
  if (id >= state_->peers.size()) return;
  Peer& peer = state_->peers[id];
  if (peer.link == Link::attempting) state_->leave(id);
  if (peer.link != Link::open) return;
  state_->purge(id);
  peer.link = Link::closing;
  enet_peer_disconnect_later(state_->enet_peer(id), 0);
  flush();
}

}  // namespace isostep::transport
