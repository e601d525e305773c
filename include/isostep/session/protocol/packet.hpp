// The datagram of a session: acknowledgements, the newest hash chain, and every input that the other side may lack.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/core/result.hpp"
#include "isostep/session/pace/tempo.hpp"
#include "isostep/session/protocol/player_stats.hpp"
#include "isostep/session/timeline/hash_log.hpp"
#include "isostep/session/timeline/input_stream.hpp"

namespace isostep {

/// The version of the wire format of datagrams and messages. A peer with another one is refused by name.
inline constexpr std::uint16_t kSessionProtocol = 5;
/// The most frames of one player in one datagram.
inline constexpr Frame kSliceFrames = 128;

struct PacketHeader {
  std::uint64_t match = 0;   // which is meant: what another match left in the network is refused
  std::uint16_t number = 0;  // mod 2^16, of the sender's datagrams to this receiver
  std::uint16_t time = 0;    // [ms] sender's clock mod 2^16
  std::uint16_t echo = 0;    // [ms] receiver's clock as the sender last heard it, plus what it waited since
  bool has_echo = false;
  std::uint8_t waited = 0;      // [ms] of the echo: what the sender waited; 255: so much, or more
  bool started = false;         // the match runs
  bool is_far = false;          // host: the receiver's line is one for which the others do not wait
  std::uint8_t stretch = 0;     // [1/256 period] client: a frame takes it longer by so much; host: all frames are
  std::uint8_t slowest = 0xff;  // host: the player for whom they are; 0xff: the host's machine
  std::uint8_t spares = 0;      // [frames] client: its rollbacks have to be shorter by so many, for it is too slow
  std::uint32_t waits_for = 0;  // host: players, a bit each, who hold the match up
  Tempo tempo;                  // host: as last announced
  /// Host of a match that can migrate: inputs before this frame are final, whoever becomes the host. kNoFrame: the
  /// match cannot migrate, and all that its host says is final.
  Frame final_end = kNoFrame;
  Frame frame = 0;               // the sender's next to step
  HashReport report;             // the sender's newest confirmed
  std::uint8_t reporter = 0xff;  // the player whose report is passed on; 0xff: none
  HashReport passed_on;
  std::uint8_t figured = 0xff;          // host: the player whose figures are told; 0xff: none
  PlayerStats figures;                  // without `early`, which everybody sees for itself
  std::uint32_t ack_mask = 0;           // players of whom the sender says what it has
  Frame ack[kMaxPlayers] = {};          // first missing
  std::int8_t slack[kMaxPlayers] = {};  // [frames] by which the latest of a second's inputs came before it was needed
};

/// Returns true if `slowest`, `tempo.by` and `waits_for` name only players of a match of so many.
bool is_of(const PacketHeader& header, int players);

/// A run of one player's inputs: frames first .. first + count - 1.
struct InputSlice {
  std::uint8_t player;
  Frame first, count;
  Bytes tokens;
};

struct Packet {
  PacketHeader header;
  std::uint8_t slice_count = 0;
  InputSlice slices[kMaxPlayers];
};

/// Writes a datagram into `buffer`, which has kDatagramCap bytes.
class PacketWriter {
 public:
  PacketWriter(const PacketHeader& header, std::uint8_t* buffer);
  /// Adds the inputs from `first` on that the stream has and that fit, at most `most`. Returns how many it added.
  Frame add_slice(std::uint8_t player, const InputStream& stream, Frame first, Frame most = kSliceFrames);
  Bytes bytes() const { return {buffer_, size_}; }

 private:
  std::uint8_t* buffer_;
  std::size_t size_;
  Frame frame_;  // of the header
};

/// Reads a datagram and checks every number. The result points into `bytes`. SliceReader reads the slices' tokens.
Result<Packet> read_packet(Bytes bytes);

/// Reads the entries of a slice, in order.
class SliceReader {
 public:
  explicit SliceReader(const InputSlice& slice);
  /// Returns false at the end, or at damaged tokens. The bytes of the entry are valid until the next call.
  bool next(InputEntry& entry);
  bool failed() const { return failed_; }

 private:
  bool read_token();

  Bytes tokens_;
  Frame left_;
  Frame run_ = 0;
  bool run_absent_ = false;
  bool failed_ = false;
  std::size_t previous_size_ = 0;
  std::uint8_t previous_[512];  // kInputCap
};

}  // namespace isostep
