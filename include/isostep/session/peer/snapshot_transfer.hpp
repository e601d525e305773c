// SnapshotTransfer: how much of a snapshot may be under way to one client, as the line takes it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/session/timeline/frame.hpp"

namespace isostep {

/// The progress of a snapshot. `size` is 0 when none is under way.
struct SnapshotProgress {
  std::uint32_t arrived = 0, size = 0;  // [bytes]
};

/// The most that is under way. What has not arrived waits in the transport's memory.
inline constexpr std::uint32_t kSnapshotFlight = 256 << 10;  // [bytes]

/// Congestion control by delay: a transfer takes what the line has, and delays other traffic by no more than kQueue. It
/// uses the round trips of datagrams, for a lost piece holds up the pieces behind it, and their delay says nothing of
/// the line.
class SnapshotTransfer {
 public:
  /// `from`: so many bytes are there already.
  void begin(std::uint32_t from, std::uint32_t size);
  /// Begins with a larger window: the client has shown for long that it takes what it is sent.
  void begin_at_once(std::uint32_t size);
  /// [bytes] of the next piece; 0: none now.
  std::uint32_t next_piece(Time now) const;
  void was_sent(std::uint32_t bytes, Time now);
  /// Notes that so many bytes have arrived. Returns false if that cannot be, or is known.
  bool has_arrived(std::uint32_t bytes);
  /// Notes the round trip of a datagram to the client.
  void measured(Time trip, Time now);

  std::uint32_t sent() const { return sent_; }
  SnapshotProgress progress() const { return {arrived_, size_}; }
  bool is_complete() const { return arrived_ == size_; }
  /// Returns true if the client has said that a piece came.
  bool is_answered() const { return window_ > kFirst; }

 private:
  static constexpr std::uint32_t kFirst = 256;      // [bytes] a first piece: who never answers costs no more
  static constexpr std::uint32_t kLeast = 4 << 10;  // [bytes] a window, of who has answered: a few packets
  /// [bytes] The first window of a known client: ten packets (RFC 6928), which take 80 ms on a line of 200 kB/s.
  static constexpr std::uint32_t kKnown = 16 << 10;
  static constexpr Time kQueue = kSecond / 10;  // [us] as LEDBAT (RFC 6817) allows
  static constexpr int kSamples = 4;            // the least of so many trips is without most of the jitter

  std::uint32_t sent_ = 0, arrived_ = 0, size_ = 0;  // [bytes]
  std::uint32_t window_ = kFirst;                    // [bytes]
  Time shortest_ = 0;                                // [us] of all trips; 0: unknown
  Time least_ = 0;                                   // [us] of the trips since the window took effect
  int samples_ = 0;                                  // of those
  Time trip_ = 0;                                    // [us] what that was the last time; 0: unknown
  Time settled_at_ = 0;                              // [us] when the window that was chosen last has taken effect
  Time grows_at_ = 0;                                // [us] not before, for there was a queue
  Time next_at_ = 0;                                 // [us] of the next piece, evenly over a round trip
};

}  // namespace isostep
