// Lists of hits in canonical order.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "isostep/core/stable_sort.hpp"
#include "isostep/state/pack.hpp"
#include "isostep/store/query_types.hpp"

namespace isostep::detail {

template <class S, class Fraction>
ISO_INLINE bool comes_before(const QueryHit<S, Fraction>& a, const QueryHit<S, Fraction>& b) {
  if (a.fraction != b.fraction) return a.fraction < b.fraction;
  if (a.body.slot != b.body.slot) return a.body.slot < b.body.slot;
  return a.child != b.child ? a.child < b.child : a.triangle < b.triangle;
}

/// Lists the first hits, as many as the caller's memory has room for.
template <class S, class Fraction> class NearestHits {
  using Hit = QueryHit<S, Fraction>;

 public:
  ISO_INLINE explicit NearestHits(std::span<Hit> room) : room_(room) {}
  ISO_INLINE std::size_t count() const { return count_; }
  /// [1] The latest fraction of interest: a later hit is not listed.
  ISO_INLINE Fraction latest() const {
    return count_ < room_.size() ? Fraction(1) : room_.empty() ? Fraction(0) : room_[count_ - 1].fraction;
  }
  ISO_INLINE void add(const Hit& hit) {
    if (room_.empty()) return;
    if (count_ == room_.size()) {
      if (!comes_before(hit, room_[count_ - 1])) return;
      --count_;
    }
    std::size_t place = count_++;
    for (; place > 0 && comes_before(hit, room_[place - 1]); --place) room_[place] = room_[place - 1];
    room_[place] = hit;
  }

 private:
  std::span<Hit> room_;
  std::size_t count_ = 0;
};

/// Appends all hits to a vector.
template <class S, class Fraction> class EveryHit {
  using Hit = QueryHit<S, Fraction>;
  struct ByPart {
    ISO_INLINE std::uint64_t operator()(const Hit& hit) const { return std::uint64_t{hit.child} << 32 | hit.triangle; }
  };
  struct BySlot {
    ISO_INLINE std::uint64_t operator()(const Hit& hit) const { return hit.body.slot; }
  };
  /// Fractions are not negative, so their bits ascend as they do, except those of a zero with a sign.
  struct ByFraction {
    ISO_INLINE std::uint64_t operator()(const Hit& hit) const {
      return hit.fraction == Fraction(0) ? 0 : static_cast<std::uint64_t>(field_bits(hit.fraction));
    }
  };

 public:
  ISO_INLINE explicit EveryHit(std::vector<Hit>& out) : out_(out), first_(out.size()) {}
  ISO_INLINE Fraction latest() const { return Fraction(1); }
  ISO_INLINE void add(const Hit& hit) { out_.push_back(hit); }
  ISO_INLINE void sort() {
    const auto count = static_cast<std::uint32_t>(out_.size() - first_);
    if (count < 2) return;
    std::vector<Hit> scratch(count <= kInsertionSortLimit ? 0 : count);
    Hit* const hits = out_.data() + first_;
    stable_sort(hits, scratch.data(), count, ByPart{});
    stable_sort(hits, scratch.data(), count, BySlot{});
    stable_sort(hits, scratch.data(), count, ByFraction{});
  }

 private:
  std::vector<Hit>& out_;
  std::size_t first_;
};

}  // namespace isostep::detail
