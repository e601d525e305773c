// Datagrams of a match, written and read.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer/datagrams.hpp"

#include "isostep/session/peer/reach.hpp"

namespace isostep {

bool Datagrams::accept(PeerLink& link, Bytes bytes, Time now, Packet& packet) {
  ++stats_.datagrams_in;
  stats_.bytes_in += bytes.size();
  if (!link.datagrams.spend(config_.most_packets, now)) {
    ++stats_.flooded;
    return false;
  }
  const Result<Packet> read = read_packet(bytes);
  if (!read) {
    ++stats_.refused;
    return false;
  }
  packet = read.value();
  return true;
}

bool Datagrams::accept_message(PeerLink& link, Bytes bytes, Time now) {
  stats_.bytes_in += bytes.size();
  if (!link.messages.spend(config_.most_packets, now)) {
    ++stats_.flooded;
    return false;
  }
  if (!message_kind(bytes)) {
    ++stats_.refused;
    return false;
  }
  return true;
}

void Datagrams::take_header(PeerLink& link, const PacketHeader& header, const SendEnds& ends, bool is_after_pause,
                            Time now) const {
  // Of an old or forged datagram only what stays true is taken: what was had, and the inputs.
  const bool is_current = link.position.is_near(header.frame, now, clock_.period());
  link.position.heard(header.frame, now, clock_.period());
  if (!link.position.is_near(link.newest_frame, now, clock_.period())) link.newest_frame = 0;
  if (is_current) link.meter.arrived(header.number, now);
  if (is_current && !is_after_pause) {
    link.meter.measured(header.time, now);
    link.set_clock(header, now);
  }
  if (is_current && link.is_newest(header)) {
    link.newest_frame = header.frame;
    link.newest_time = header.time;
    link.stretch = header.stretch;
    link.slowest = header.slowest;
    link.spares = header.spares < window_of(config_) / 2 ? header.spares : window_of(config_) / 2;
    link.waits_for = header.waits_for;
  }
  for (int p = 0; p < config_.players; ++p) {
    if ((header.ack_mask >> p & 1) == 0) continue;
    // Nobody has what was never sent; and what was had once stays had.
    const Frame ack = header.ack[p];
    if (ack > link.acked[p] && ack <= streams_[static_cast<std::size_t>(p)].end()) {
      link.acked[p] = ack;
      if (ends.of[p] > 0) {
        link.acked_at = now;
        link.may_burst = true;
      }
    }
    if (!is_current) continue;
    link.slack[p] = header.slack[p];
    link.reported_mask |= 1u << p;
  }
}

Bytes Datagrams::compose(PeerLink& link, PacketHeader header, const SendEnds& ends, Frame present, Frame most,
                         Time now) {
  header.number = link.datagrams_out++;
  header.time = static_cast<std::uint16_t>(now / 1000);
  header.has_echo = link.has_clock;
  const Time waited = (now - link.clock_at) / 1000;
  header.echo = static_cast<std::uint16_t>(link.clock + waited);
  header.waited = static_cast<std::uint8_t>(waited < 255 ? waited : 255);
  header.frame = present;
  header.report = hashes_.settled();
  PacketWriter writer(header, buffer_);
  const bool continues = link.continues_burst(now);
  link.burst = continues ? link.burst + 1 : 1;
  if (continues) link.may_burst = false;
  // In turns, so that one player's long inputs cannot keep another's out for ever.
  bool is_left = false;
  Frame added = 0;
  for (int i = 0; i < config_.players; ++i) {
    const int p = (i + present) % config_.players;
    const Frame until = ends.of[p];
    const InputStream& stream = streams_[static_cast<std::size_t>(p)];
    const Frame first = continues && link.burst_end[p] > link.acked[p] ? link.burst_end[p] : link.acked[p];
    const Frame few = until - first < most ? until - first : most;
    const Frame count = writer.add_slice(static_cast<std::uint8_t>(p), stream, first, few);
    link.burst_end[p] = first + count;
    added += count;
    is_left = is_left || link.burst_end[p] < until;
  }
  link.has_more = is_left && added > 0;
  if (!continues) link.next_send = now + clock_.period();
  link.sent_frame = present;
  ++stats_.datagrams_out;
  stats_.bytes_out += writer.bytes().size();
  return writer.bytes();
}

}  // namespace isostep
