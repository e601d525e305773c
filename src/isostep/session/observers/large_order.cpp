// OrderAssembly: pieces become orders.
// SPDX-License-Identifier: MIT
#include "isostep/session/observers/large_order.hpp"

#include "isostep/state/hash.hpp"

namespace isostep {

Bytes OrderAssembly::take(std::size_t player, bool is_absent, const OrderPiece& piece) {
  Part& part = parts_[player];
  if (is_absent) {
    part.bytes.clear();
    part.total = 0;
    return {};
  }
  const auto expected = static_cast<std::uint8_t>(part.sequence + (piece.bytes.empty() ? 0 : 1));
  const bool goes_on = piece.sequence == expected &&
                       (piece.bytes.empty() || (piece.offset == part.bytes.size() && piece.total == part.total));
  part.sequence = piece.sequence;
  if (!goes_on) part.bytes.clear(), part.total = 0;
  if (piece.bytes.empty() || (!goes_on && piece.offset != 0)) return {};
  part.total = piece.total;
  part.bytes.insert(part.bytes.end(), piece.bytes.begin(), piece.bytes.end());
  if (part.bytes.size() < part.total) return {};
  ++part.completed;
  part.total = 0;
  whole_.swap(part.bytes);
  part.bytes.clear();
  return whole_;
}

void OrderAssembly::save(Snapshot& to) const {
  for (std::size_t p = 0; p < kMaxPlayers; ++p) to.parts[p] = parts_[p];
}

void OrderAssembly::load(const Snapshot& from) {
  for (std::size_t p = 0; p < kMaxPlayers; ++p) parts_[p] = from.parts[p];
}

std::uint64_t OrderAssembly::hash() const {
  HashCombiner combiner;
  for (const Part& part : parts_) {
    combiner.add(std::uint64_t{part.completed} << 32 | std::uint64_t{part.total} << 8 | part.sequence);
    combiner.add(hash_bytes(part.bytes.data(), part.bytes.size()));
  }
  return combiner.value();
}

void OrderAssembly::write_portable(Writer& writer) const {
  for (const Part& part : parts_) {
    writer.write(part.sequence);
    writer.write(part.completed);
    writer.write(part.total);
    writer.write_bytes(part.bytes);
  }
}

Result<void> OrderAssembly::read_portable(Reader& reader) {
  Part read[kMaxPlayers];
  for (Part& part : read) {
    reader.read(part.sequence);
    reader.read(part.completed);
    reader.read(part.total);
    const Bytes bytes = reader.read_bytes(kLargeOrderCap);
    part.bytes.assign(bytes.begin(), bytes.end());
    const bool is_idle = part.total == 0 && bytes.empty();
    const bool is_under_way = !bytes.empty() && bytes.size() < part.total && part.total <= kLargeOrderCap;
    if (!is_idle && !is_under_way) reader.fail(ErrorCode::invalid, "more of an order than its size, or too large");
  }
  const Result<void> result = reader.result("orders");
  if (!result) return result;
  for (std::size_t p = 0; p < kMaxPlayers; ++p) parts_[p] = read[p];
  return {};
}

}  // namespace isostep
