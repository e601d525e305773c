// The relay's sockets, its clients and the packets under way.
// SPDX-License-Identifier: MIT
#include "transport/udp_relay.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "transport/impaired_direction.hpp"

namespace isostep::transport {
namespace {

constexpr int kPacketsATurn = 256;      // of one socket, so that a flood through one leaves the others their turn
constexpr int kSocketBuffer = 1 << 20;  // [bytes] a burst of all clients between two turns

Time clock_now() {
  const auto since = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<Time>(std::chrono::duration_cast<std::chrono::microseconds>(since).count());
}

Error failure(const char* what, std::string_view place) { return {ErrorCode::invalid, what, place}; }

/// A file descriptor that closes itself.
class Socket {
 public:
  Socket() = default;
  explicit Socket(int descriptor) : descriptor_(descriptor) {}
  Socket(Socket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  Socket& operator=(Socket&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }
  ~Socket() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

Socket open_socket(int family) {
  Socket opened(::socket(family, SOCK_DGRAM, 0));
  if (opened.descriptor() < 0) return opened;
  const int flags = ::fcntl(opened.descriptor(), F_GETFL, 0);
  if (flags < 0 || ::fcntl(opened.descriptor(), F_SETFL, flags | O_NONBLOCK) < 0) return Socket();
  // The buffer is as large as the system allows; a smaller one only loses more.
  ::setsockopt(opened.descriptor(), SOL_SOCKET, SO_RCVBUF, &kSocketBuffer, sizeof kSocketBuffer);
  return opened;
}

/// IPv4 or IPv6.
struct UdpAddress {
  sockaddr_storage storage = {};
  socklen_t size = sizeof storage;

  int family() const { return storage.ss_family; }
  const sockaddr* generic() const { return reinterpret_cast<const sockaddr*>(&storage); }
  sockaddr* generic() { return reinterpret_cast<sockaddr*>(&storage); }
  in_port_t& port() {
    return family() == AF_INET6 ? reinterpret_cast<sockaddr_in6*>(&storage)->sin6_port
                                : reinterpret_cast<sockaddr_in*>(&storage)->sin_port;
  }
};

/// The first of the name's; a name of both kinds is one of IPv4 where the system has that.
std::optional<UdpAddress> look_up(const std::string& name, std::uint16_t port) {
  for (const int family : {AF_INET, AF_INET6}) {
    addrinfo hints = {};
    hints.ai_family = family;
    hints.ai_socktype = SOCK_DGRAM;
    addrinfo* found = nullptr;
    if (::getaddrinfo(name.c_str(), nullptr, &hints, &found) != 0 || found == nullptr) continue;
    UdpAddress address;
    address.size = found->ai_addrlen;
    std::memcpy(&address.storage, found->ai_addr, found->ai_addrlen);
    ::freeaddrinfo(found);
    address.port() = htons(port);
    return address;
  }
  return std::nullopt;
}

/// The key of a client: its address and port, which is all that the system fills in of a sender.
using AddressBytes = std::array<std::uint8_t, 16 + 4 + 2>;
AddressBytes key_of(UdpAddress address) {
  AddressBytes key{};
  const in_port_t port = address.port();
  std::memcpy(key.data() + 20, &port, sizeof port);
  if (address.family() == AF_INET6) {
    const auto& own = reinterpret_cast<const sockaddr_in6&>(address.storage);
    std::memcpy(key.data(), &own.sin6_addr, 16);
    std::memcpy(key.data() + 16, &own.sin6_scope_id, 4);
  } else {
    std::memcpy(key.data(), &reinterpret_cast<const sockaddr_in&>(address.storage).sin_addr, 4);
  }
  return key;
}

struct Client {
  UdpAddress address;
  Socket upstream;
  ImpairedDirection up, down;
  Time last_heard;  // [us] by clock_now(), from the client

  ImpairedDirection& direction(Direction which) { return which == Direction::up ? up : down; }
};

struct Packet {
  AddressBytes client;
  Direction direction;
  std::vector<std::uint8_t> bytes;
};

}  // namespace

struct UdpRelay::State {
  RelaySettings settings;
  RelayStatistics statistics;
  Socket listener;
  std::uint16_t port = 0;
  UdpAddress target;
  Time started = clock_now();
  std::map<AddressBytes, Client> clients;
  std::map<std::pair<Time, std::uint64_t>, Packet> queue;
  std::uint64_t queued = 0;  // orders what is due at one time
  std::vector<pollfd> polled;
  std::vector<AddressBytes> polled_clients;  // of polled[i + 1]
  std::uint8_t buffer[kLargestPacket + 1];

  RelayTraffic& traffic(Direction direction) { return direction == Direction::up ? statistics.up : statistics.down; }
  Result<void> bind();
  Client* client_at(const UdpAddress& address, Time now);
  bool make_room(Time now);
  void take_from_clients();
  void take_from_target(const AddressBytes& key);
  void accept(const AddressBytes& key, Client& client, Direction direction, std::size_t bytes, Time now);
  void send_due(Time now);
  void send(const Packet& packet);
};

Result<void> UdpRelay::State::bind() {
  const std::optional<UdpAddress> to = look_up(settings.target_address, settings.target_port);
  if (!to || settings.target_port == 0) return failure("no such target", settings.target_address);
  target = *to;
  std::optional<UdpAddress> at = look_up(settings.listen_address, settings.listen_port);
  if (!at) return failure("no such address to listen at", settings.listen_address);
  listener = open_socket(at->family());
  const int descriptor = listener.descriptor(), no = 0;
  // "::" is every address of both kinds, also where the system would take it for IPv6 alone.
  if (at->family() == AF_INET6) ::setsockopt(descriptor, IPPROTO_IPV6, IPV6_V6ONLY, &no, sizeof no);
  if (descriptor < 0 || ::bind(descriptor, at->generic(), at->size) != 0 ||
      ::getsockname(descriptor, at->generic(), &at->size) != 0) {
    return failure("the port is taken, or the address is not of this machine", settings.listen_address);
  }
  port = ntohs(at->port());
  return {};
}

/// Drops the client that has been idle longest, if that is kIdle or more.
bool UdpRelay::State::make_room(Time now) {
  if (clients.size() < settings.max_clients) return true;
  const auto oldest = std::min_element(clients.begin(), clients.end(), [](const auto& a, const auto& b) {
    return a.second.last_heard < b.second.last_heard;
  });
  if (oldest == clients.end() || now - oldest->second.last_heard < kIdle) return false;
  clients.erase(oldest);
  return true;
}

Client* UdpRelay::State::client_at(const UdpAddress& address, Time now) {
  const AddressBytes key = key_of(address);
  const auto found = clients.find(key);
  if (found != clients.end()) return &found->second;
  if (!make_room(now)) return nullptr;
  Socket upstream = open_socket(target.family());
  // The socket is connected, so that only the target can answer.
  if (upstream.descriptor() < 0 || ::connect(upstream.descriptor(), target.generic(), target.size) != 0) {
    return nullptr;
  }
  const std::uint64_t stream = 2 * statistics.clients++;
  Client client{address,
                std::move(upstream),
                {settings.profile.up, settings.seed, stream},
                {settings.profile.down, settings.seed, stream + 1},
                now};
  return &clients.emplace(key, std::move(client)).first->second;
}

void UdpRelay::State::take_from_clients() {
  for (int i = 0; i < kPacketsATurn; ++i) {
    UdpAddress from;
    const ssize_t got = ::recvfrom(listener.descriptor(), buffer, sizeof buffer, 0, from.generic(), &from.size);
    if (got < 0) return;
    const Time now = clock_now();
    Client* client = client_at(from, now);
    if (client == nullptr) {
      ++statistics.turned_away;
      continue;
    }
    client->last_heard = now;
    accept(key_of(from), *client, Direction::up, static_cast<std::size_t>(got), now);
  }
}

void UdpRelay::State::take_from_target(const AddressBytes& key) {
  const auto client = clients.find(key);
  if (client == clients.end()) return;
  for (int i = 0; i < kPacketsATurn; ++i) {
    const ssize_t got = ::recv(client->second.upstream.descriptor(), buffer, sizeof buffer, 0);
    if (got < 0) return;  // also what the target's machine says when nobody listens there
    accept(key, client->second, Direction::down, static_cast<std::size_t>(got), clock_now());
  }
}

/// The packet in the buffer.
void UdpRelay::State::accept(const AddressBytes& key, Client& client, Direction direction, std::size_t bytes,
                             Time now) {
  RelayTraffic& counts = traffic(direction);
  ++counts.received;
  counts.received_bytes += bytes;
  const Fate fate = client.direction(direction).decide(now - started, bytes);
  if (fate.copies == 0) ++counts.lost;
  if (fate.copies == 2) ++counts.doubled;
  for (std::uint32_t copy = 0; copy < fate.copies; ++copy) {
    if (bytes > kLargestPacket || queue.size() >= settings.max_queued) {
      ++counts.overflowed;
      continue;
    }
    queue.emplace(std::pair(started + fate.arrives[copy], queued++),
                  Packet{key, direction, std::vector<std::uint8_t>(buffer, buffer + bytes)});
  }
}

void UdpRelay::State::send_due(Time now) {
  while (!queue.empty() && queue.begin()->first.first <= now) {
    send(queue.begin()->second);
    queue.erase(queue.begin());
  }
}

void UdpRelay::State::send(const Packet& packet) {
  RelayTraffic& counts = traffic(packet.direction);
  const auto client = clients.find(packet.client);
  ssize_t sent = -1;
  if (client != clients.end() && packet.direction == Direction::up) {
    sent = ::send(client->second.upstream.descriptor(), packet.bytes.data(), packet.bytes.size(), 0);
  } else if (client != clients.end()) {
    const UdpAddress& to = client->second.address;
    sent = ::sendto(listener.descriptor(), packet.bytes.data(), packet.bytes.size(), 0, to.generic(), to.size);
  }
  if (sent < 0) {
    ++counts.unsent;
    return;
  }
  ++counts.forwarded;
  counts.forwarded_bytes += packet.bytes.size();
}

// ---- the relay

UdpRelay::UdpRelay(std::unique_ptr<State> state) : state_(std::move(state)) {}
UdpRelay::UdpRelay(UdpRelay&&) noexcept = default;
UdpRelay& UdpRelay::operator=(UdpRelay&&) noexcept = default;
UdpRelay::~UdpRelay() = default;

Result<UdpRelay> UdpRelay::open(const RelaySettings& settings) {
  auto state = std::make_unique<State>();
  state->settings = settings;
  if (const Result<void> bound = state->bind(); !bound) return bound.error();
  return UdpRelay(std::move(state));
}

std::uint16_t UdpRelay::port() const { return state_->port; }
const RelayStatistics& UdpRelay::statistics() const { return state_->statistics; }

Result<void> UdpRelay::turn(Time longest) {
  State& state = *state_;
  Time wait = longest;
  if (!state.queue.empty()) {
    const Time due = state.queue.begin()->first.first, now = clock_now();
    wait = std::min(wait, due > now ? due - now : 0);
  }
  state.polled.assign(1, {state.listener.descriptor(), POLLIN, 0});
  state.polled_clients.clear();
  for (const auto& [key, client] : state.clients) {
    state.polled.push_back({client.upstream.descriptor(), POLLIN, 0});
    state.polled_clients.push_back(key);
  }
  const int milliseconds = static_cast<int>((std::min(wait, kSecond) + 999) / 1000);
  const int ready = ::poll(state.polled.data(), static_cast<nfds_t>(state.polled.size()), milliseconds);
  if (ready < 0 && errno != EINTR) return failure("poll failed", "relay");
  if (ready > 0) {
    for (std::size_t i = 1; i < state.polled.size(); ++i) {
      if (state.polled[i].revents != 0) state.take_from_target(state.polled_clients[i - 1]);
    }
    if (state.polled[0].revents != 0) state.take_from_clients();
  }
  state.send_due(clock_now());
  return {};
}

Result<void> UdpRelay::run(const std::atomic<bool>& stop) {
  constexpr Time kLook = 50000;  // [us]
  while (!stop.load(std::memory_order_relaxed)) {
    if (const Result<void> turned = turn(kLook); !turned) return turned;
  }
  return {};
}

}  // namespace isostep::transport
