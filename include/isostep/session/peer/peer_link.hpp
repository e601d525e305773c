// PeerLink: what is known of one peer across the network: when it was heard, what it has, how far away it is.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/pace/line_meter.hpp"
#include "isostep/session/pace/remote_position.hpp"
#include "isostep/session/protocol/allowance.hpp"
#include "isostep/session/protocol/packet.hpp"

namespace isostep {

struct PeerLink {
  PeerId peer = 0;
  bool is_connected = false;
  Time heard = 0;      // [us] when a valid word came last
  Time next_send = 0;  // [us]
  Frame sent_frame = kNoFrame;
  RemotePosition position;  // the peer's next frame

  bool has_clock = false;
  std::uint16_t clock = 0;  // [ms] the peer's, mod 2^16
  Time clock_at = 0;        // [us] when it was that
  Time round_trip = 0;      // [us] smoothed; 0: unknown
  RecentMedian<Time> round_trips;
  LineMeter meter;                  // of what arrives
  std::uint16_t datagrams_out = 0;  // mod 2^16

  Frame acked[kMaxPlayers] = {};      // first frame of each player that the peer lacks
  Frame burst_end[kMaxPlayers] = {};  // first frame of each that this period's datagrams left out
  int burst = 0;                      // datagrams of this period, at most
  int most_burst = kBurst;
  bool has_more = false;                // something did not fit
  bool may_burst = true;                // it acknowledged something new since the last datagram but a period's first
  Time acked_at = 0;                    // [us] when it last acknowledged something new; 0: never
  std::int8_t slack[kMaxPlayers] = {};  // how early inputs reach it, as it last said
  std::uint32_t reported_mask = 0;      // players of whom it did
  Frame newest_frame = 0;               // of which the datagram is that said this,
  std::uint16_t newest_time = 0;        // and when [ms] by the peer's clock:
  int stretch = 0;                      // [1/256 period] by which its frames are longer,
  std::uint8_t slowest = 0xff;          // and for whom
  Frame spares = 0;                     // [frames] by which its rollbacks have to be shorter
  std::uint32_t waits_for = 0;          // who holds the match up

  Allowance datagrams, messages;  // each of its own: a flood of the ones must not drown the others

  void connect(Time now) {
    is_connected = true;
    heard = now;
    datagrams.start(now);
    messages.start(now);
  }
  /// A period's first datagram begins with the unacknowledged inputs. What does not fit goes into up to three more, but
  /// only if the peer acknowledges: one that is far behind gets the same again no sooner than it can have it. A player
  /// waits for the others' inputs, so up to seven bring all of a round trip: seven of 480 bytes in 60 ms.
  static constexpr int kBurst = 4, kPlayersBurst = 7;
  bool continues_burst(Time now) const {
    return has_more && burst < most_burst && now < next_send && (burst > 1 || may_burst);
  }
  /// Returns true once a period and right after a frame, but not within half a period: catching up steps many at once.
  bool may_send(Frame current, Time period, Time now) const {
    return now >= next_send || continues_burst(now) || (sent_frame != current && now + period / 2 >= next_send);
  }
  /// Returns true if the header is newer than all that was heard. A peer that stalls sends many of one frame.
  bool is_newest(const PacketHeader& header) const {
    if (header.frame != newest_frame) return header.frame > newest_frame;
    return static_cast<std::uint16_t>(header.time - newest_time) < 0x8000;
  }
  void set_clock(const PacketHeader& header, Time now) {
    has_clock = true;
    clock = header.time;
    clock_at = now;
    if (!header.has_echo) return;
    const std::uint16_t ms = static_cast<std::uint16_t>(static_cast<std::uint16_t>(now / 1000) - header.echo);
    if (ms > 32767) return;  // ahead of our own clock: nonsense
    round_trips.add(Time{ms} * 1000);
    const Time sample = round_trips.median([](Time trip) { return trip; });
    round_trip = round_trip == 0 ? sample : (round_trip * 7 + sample) / 8;
  }
};

}  // namespace isostep
