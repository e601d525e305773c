// EnetLines: packets between ENet and its socket.
// SPDX-License-Identifier: MIT
#include "transport/enet_lines.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>

namespace isostep::transport {
namespace {

constexpr std::uint32_t kPeerMask = 0xfff;
constexpr std::size_t kChecksum = sizeof(enet_uint32);
static_assert(LineTags::kSize >= kChecksum && kEnetMtu + LineTags::kSize <= kPacketCap);

std::uint32_t peer_of(Bytes enet_packet) { return (std::uint32_t{enet_packet[0]} << 8 | enet_packet[1]) & kPeerMask; }

Source source_of(const ENetAddress& address) { return {address.host, address.port}; }

bool are_equal(const ENetAddress& a, const ENetAddress& b) { return a.host == b.host && a.port == b.port; }

bool is_alive(const ENetPeer& peer) {
  return peer.state != ENET_PEER_STATE_DISCONNECTED && peer.state != ENET_PEER_STATE_ZOMBIE;
}

EnetLines* lines_of(ENetHost* host) { return static_cast<EnetLines*>(host->peers[0].data); }

}  // namespace

void EnetLines::guard(ENetHost* host) {
  host_ = host;
  tags_.resize(host->peerCount);
  for (std::size_t i = 0; i < host->peerCount; ++i) host->peers[i].data = this;
  host->intercept = intercept;
  host->checksum = before_sending;
}

void EnetLines::begin(ENetPeer* peer, std::uint64_t nonce) {
  asked_ = peer;
  nonce_ = nonce;
  ask_ = door_.ask(nonce);
  awaits_challenge_ = false;
  tags_[peer->incomingPeerID] = door_.tags(nonce, true);
}

EnetLines::Sent EnetLines::take_sent() {
  const Sent sent = sent_;
  sent_ = {};
  return sent;
}

void EnetLines::send(const ENetAddress& to, Bytes bytes) {
  ENetBuffer buffer;
  buffer.data = const_cast<std::uint8_t*>(bytes.data());  // ENet has one type for what is sent and received
  buffer.dataLength = bytes.size();
  const int sent = enet_socket_send(host_->socket, &to, &buffer, 1);
  if (sent <= 0) return;  // as good as lost: the other side asks again
  ++sent_.packets;
  sent_.bytes += static_cast<std::uint64_t>(sent);
}

// ---- what came

/// 1 means that the packet is dealt with.
int ENET_CALLBACK EnetLines::intercept(ENetHost* host, ENetEvent*) {
  return lines_of(host)->take({host->receivedData, host->receivedDataLength}) ? 0 : 1;
}

/// ENet may read the packet.
bool EnetLines::take(std::span<std::uint8_t> packet) {
  if (Doorkeeper::is_word(packet) && packet.size() <= Doorkeeper::kWord) {
    if (!take_challenge(packet) && !answer(packet)) ++refused_;
    return false;
  }
  if (Doorkeeper::is_word(packet) ? accepts_ && take_open(packet) : take_packet(packet)) return true;
  ++refused_;
  return false;
}

bool EnetLines::take_packet(std::span<std::uint8_t> packet) {
  if (packet.size() < LineTags::kSize + 2) return false;
  const std::uint32_t peer = peer_of(packet.subspan(LineTags::kSize));
  if (peer >= tags_.size() || !is_alive(host_->peers[peer])) return false;
  if (!are_equal(host_->peers[peer].address, host_->receivedAddress)) return false;
  return tags_[peer].open(packet) && show(packet);
}

/// Makes what ENet expects of an opened packet: no tag before it, and a checksum after its header.
bool EnetLines::show(std::span<std::uint8_t> packet) {
  const std::span<std::uint8_t> inner = packet.subspan(LineTags::kSize);
  if (!is_plausible_enet_packet(inner)) return false;
  const std::size_t header = (inner[0] & ENET_PROTOCOL_HEADER_FLAG_SENT_TIME >> 8) != 0 ? 4 : 2;
  std::memmove(inner.data() - kChecksum, inner.data(), header);
  std::memset(inner.data() + header - kChecksum, 0, kChecksum);
  host_->receivedData = inner.data() - kChecksum;
  host_->receivedDataLength = inner.size() + kChecksum;
  return true;
}

bool EnetLines::answer(Bytes ask) {
  if (!accepts_) return false;
  const auto word = door_.answer(ask, source_of(host_->receivedAddress), enet_time_get());
  if (word) send(host_->receivedAddress, *word);
  return word.has_value();
}

/// The peer that ENet will take for a CONNECT: the one that is free first, unless it refuses.
ENetPeer* EnetLines::place_for(const ENetAddress& address, std::uint32_t connect_id) const {
  ENetPeer* free = nullptr;
  std::size_t of_address = 0;
  for (std::size_t i = 0; i < tags_.size(); ++i) {
    ENetPeer& peer = host_->peers[i];
    if (peer.state == ENET_PEER_STATE_DISCONNECTED) {
      if (free == nullptr) free = &peer;
      continue;
    }
    if (peer.connectID == connect_id) return nullptr;  // or tags_to() would not tell them apart
    of_address += peer.state != ENET_PEER_STATE_CONNECTING && peer.address.host == address.host ? 1 : 0;
  }
  return of_address < host_->duplicatePeers ? free : nullptr;
}

/// Lets ENet read one packet, a CONNECT, of a sender that has proved its address, and takes a peer for it.
bool EnetLines::take_open(std::span<std::uint8_t> open) {
  constexpr std::size_t kConnect = Doorkeeper::kOpen + LineTags::kSize + 4 + sizeof(ENetProtocolConnect);
  const auto nonce = door_.take_open(open, source_of(host_->receivedAddress), enet_time_get());
  if (!nonce || open.size() != kConnect) return false;
  // The sender asks again, before it heard that it is let in; or others say it again.
  if (std::find(opened_.begin(), opened_.end(), *nonce) != opened_.end()) return false;
  const std::span<std::uint8_t> packet = open.subspan(Doorkeeper::kOpen);
  LineTags tags = door_.tags(*nonce, false);
  if (!tags.open(packet) || peer_of(packet.subspan(LineTags::kSize)) != kPeerMask) return false;
  ENetProtocolConnect connect;
  std::memcpy(&connect, open.data() + open.size() - sizeof connect, sizeof connect);
  ENetPeer* const peer = place_for(host_->receivedAddress, connect.connectID);
  if (peer == nullptr || !show(packet)) return false;
  tags_[peer->incomingPeerID] = tags;
  enet_peer_timeout(peer, ENET_PEER_TIMEOUT_LIMIT, Doorkeeper::kLife, Doorkeeper::kLife);  // until it is connected
  opened_[next_opened_++ % opened_.size()] = *nonce;
  return true;
}

bool EnetLines::take_challenge(Bytes challenge) {
  if (!awaits_challenge_ || asked_->state != ENET_PEER_STATE_CONNECTING) return false;
  if (!are_equal(asked_->address, host_->receivedAddress)) return false;
  const auto cookie = door_.take_challenge(challenge, nonce_);
  if (!cookie) return false;
  awaits_challenge_ = false;
  const std::span<std::uint8_t> open(connect_, connect_size_);
  Doorkeeper::write_open(nonce_, *cookie, open.first<Doorkeeper::kOpen>());
  tags_[asked_->incomingPeerID].seal(open.subspan(Doorkeeper::kOpen));
  send(asked_->address, open);
  return true;
}

// ---- what goes

/// ENet calls it with its own array of buffers, of which the first is the header, for what goes; and with one other
/// buffer for what came, whose checksum is then 0.
enet_uint32 ENET_CALLBACK EnetLines::before_sending(const ENetBuffer* buffers, size_t count) {
  if (count == 1) return 0;
  const auto* host = reinterpret_cast<const char*>(buffers) - offsetof(ENetHost, buffers);
  lines_of(const_cast<ENetHost*>(reinterpret_cast<const ENetHost*>(host)))->seal();
  return 0;
}

/// The tags for the peer to whom ENet has given this identity. None for a CONNECT, where it stands for nothing.
LineTags* EnetLines::tags_to(std::uint32_t connect_id, std::uint32_t peer_there) {
  if (peer_there == kPeerMask) return nullptr;
  for (std::size_t i = 0; i < tags_.size(); ++i) {
    const ENetPeer& peer = host_->peers[i];
    // A peer that acknowledges an end is over for ENet before that is sent.
    if (peer.state == ENET_PEER_STATE_DISCONNECTED) continue;
    if (peer.connectID == connect_id && peer.outgoingPeerID == peer_there) return &tags_[i];
  }
  return nullptr;
}

/// Makes of ENet's buffers one with the tag before them; of a CONNECT the ask.
void EnetLines::seal() {
  ENetBuffer* const buffers = host_->buffers;
  const std::size_t header = buffers[0].dataLength - kChecksum;
  std::uint32_t connect_id = 0;  // where a checksum would be
  std::memcpy(&connect_id, static_cast<const std::uint8_t*>(buffers[0].data) + header, sizeof connect_id);
  buffers[0].dataLength = header;
  std::size_t size = LineTags::kSize;
  for (std::size_t i = 0; i < host_->bufferCount; ++i) {
    const std::size_t length = std::min(buffers[i].dataLength, sizeof out_ - size);  // all of it: kEnetMtu
    if (length > 0) std::memcpy(out_ + size, buffers[i].data, length);
    size += length;
  }
  buffers[0].data = out_;
  buffers[0].dataLength = size;
  host_->bufferCount = 1;
  const std::uint32_t peer_there = peer_of(Bytes(out_).subspan(LineTags::kSize));
  if (LineTags* tags = tags_to(connect_id, peer_there)) {
    tags->seal({out_, size});
  } else if (asked_ != nullptr && peer_there == kPeerMask) {
    // ENet does not know the other side's number yet: its CONNECT, which it repeats until it is answered.
    std::copy_n(out_, size, connect_ + Doorkeeper::kOpen);
    connect_size_ = Doorkeeper::kOpen + size;
    awaits_challenge_ = true;
    buffers[0].data = ask_.data();
    buffers[0].dataLength = ask_.size();
  } else {
    buffers[0].dataLength = 0;  // of no connection: an empty packet, which nobody reads
  }
}

}  // namespace isostep::transport
