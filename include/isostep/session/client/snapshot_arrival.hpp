// SnapshotArrival: a state of the host's that comes in pieces.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/peer/snapshot_transfer.hpp"
#include "isostep/session/protocol/message.hpp"

namespace isostep {

/// In: which state, and its pieces in order. Out: the bytes, and the progress for the host. Keeps: which state they are
/// of, also without a connection: the pieces may go on where they end.
class SnapshotArrival {
 public:
  explicit SnapshotArrival(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  /// The state whose first bytes we have. Its frame is kNoFrame if there is none.
  const HashReport& start() const { return start_; }
  SnapshotProgress progress() const { return {static_cast<std::uint32_t>(bytes_.size()), size_}; }
  bool is_whole() const { return bytes_.size() == size_; }
  /// Returns true if the host knows of all that has arrived.
  bool is_told() const { return told_ >= bytes_.size(); }
  bool goes_on(const HashReport& start, std::uint32_t from) const {
    return from == bytes_.size() && start.frame == start_.frame && start.chain == start_.chain;
  }
  /// The pieces begin at `from`. Bytes before it stay; if it is 0, all are dropped.
  void begin(const HashReport& start, std::uint32_t size, std::uint32_t from) {
    start_ = start;
    size_ = size;
    told_ = from;
    if (from == 0) bytes_.clear();
  }
  /// Appends the next piece. False: it is another. Memory grows with what arrives, not with what is promised.
  bool take(const Piece& piece) {
    if (piece.bytes.empty() || piece.offset != bytes_.size() || piece.bytes.size() > size_ - bytes_.size())
      return false;
    bytes_.insert(bytes_.end(), piece.bytes.begin(), piece.bytes.end());
    return true;
  }
  /// Forgets the state, which was used or is bad.
  void forget() { start_ = HashReport{}; }
  /// Reports progress, once per `period`: the host sends as data arrives, but limits a peer's messages.
  bool write_next(Time now, Time period, std::vector<std::uint8_t>& message) {
    if (is_told() || (!is_whole() && now < next_)) return false;
    next_ = now + period;
    told_ = static_cast<std::uint32_t>(bytes_.size());
    write_progress(told_, message);
    return true;
  }

 private:
  std::vector<std::uint8_t>& bytes_;
  HashReport start_;
  std::uint32_t size_ = 0, told_ = 0;  // [bytes]
  Time next_ = 0;                      // [us] when the host is told again
};

}  // namespace isostep
