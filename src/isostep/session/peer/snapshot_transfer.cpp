// The window of a snapshot's transfer.
// SPDX-License-Identifier: MIT
#include "isostep/session/peer/snapshot_transfer.hpp"

namespace isostep {
namespace {

constexpr std::uint32_t kPiece = kReliableCap - 64;  // [bytes] in one message, with its head
constexpr std::uint32_t kPieces = 8;                 // a window has so many: small ones leave evenly
constexpr Time kLate = kSecond / 25;                 // [us] between turns, at 30 a second and a bit
constexpr Time kQueueStays = 2 * kSecond;            // [us] after a queue was seen; a full one drops, and is empty then
constexpr Time kLongestTrip = 60 * kSecond;          // [us] as a datagram's clock tells it; beyond, nothing is learnt

std::uint64_t bounded(std::uint64_t value, std::uint64_t least, std::uint64_t most) {
  return value < least ? least : value > most ? most : value;
}

}  // namespace

void SnapshotTransfer::begin(std::uint32_t from, std::uint32_t size) {
  *this = SnapshotTransfer{};
  sent_ = arrived_ = from;
  size_ = size;
}

void SnapshotTransfer::begin_at_once(std::uint32_t size) {
  begin(0, size);
  window_ = kKnown;
}

std::uint32_t SnapshotTransfer::next_piece(Time now) const {
  if (sent_ == size_ || sent_ - arrived_ >= window_ || now < next_at_) return 0;
  const auto piece = static_cast<std::uint32_t>(bounded(window_ / kPieces, kFirst, kPiece));
  return size_ - sent_ < piece ? size_ - sent_ : piece;
}

void SnapshotTransfer::was_sent(std::uint32_t bytes, Time now) {
  sent_ += bytes;
  // A window in four fifths of a round trip. Turns that come late are made up for.
  if (next_at_ + kLate < now) next_at_ = now - kLate;
  next_at_ += trip_ * bytes * 4 / (std::uint64_t{window_} * 5);
}

bool SnapshotTransfer::has_arrived(std::uint32_t bytes) {
  if (bytes <= arrived_ || bytes > sent_) return false;
  arrived_ = bytes;
  if (window_ < kLeast) window_ = kLeast;
  return true;
}

void SnapshotTransfer::measured(Time trip, Time now) {
  if (trip > kLongestTrip || !is_answered()) return;
  if (trip == 0) trip = 1;  // the clock of datagrams ticks in milliseconds
  if (shortest_ == 0 || trip < shortest_) shortest_ = trip;
  if (now < settled_at_) return;
  if (samples_ == 0 || trip < least_) least_ = trip;
  if (++samples_ < kSamples) return;
  samples_ = 0;
  trip_ = least_;
  settled_at_ = now + trip_;
  const bool is_free = trip_ <= shortest_ + kQueue / 2;
  if (!is_free) grows_at_ = now + kQueueStays;
  if (is_free && now < grows_at_) return;
  // Half as much again until something waits, then an eighth; or what makes the queue kQueue long. Steps are small
  // then, for transports take a sudden delay for a loss and send all that is under way again.
  const std::uint64_t more = window_ + std::uint64_t{window_} / (grows_at_ == 0 ? 2 : 8);
  const std::uint64_t wanted = is_free ? more : std::uint64_t{window_} * (shortest_ + kQueue) / trip_;
  window_ = static_cast<std::uint32_t>(bounded(wanted < more ? wanted : more, kLeast, kSnapshotFlight));
}

}  // namespace isostep
