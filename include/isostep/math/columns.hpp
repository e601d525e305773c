// Columns: many vectors with their x, y and z apart, as lanes load them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "isostep/math/mat3.hpp"
#include "isostep/scalar/lanes.hpp"

namespace isostep {

/// It holds at most kMost vectors. Lanes that read beyond the last get the last again.
template <class T, int kMost> struct Columns {
  static_assert(kMost % 16 == 0, "blocks of lanes of any width fill it");
  alignas(64) T x[std::size_t{kMost}];
  alignas(64) T y[std::size_t{kMost}];
  alignas(64) T z[std::size_t{kMost}];

  ISO_INLINE constexpr Vec3<T> at(std::uint32_t i) const { return {x[i], y[i], z[i]}; }
  ISO_INLINE constexpr void set(std::uint32_t i, Vec3<T> v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
  /// Repeats the last of `count` vectors up to a whole block of W.
  template <int W> ISO_INLINE constexpr void pad(std::uint32_t count) {
    for (std::uint32_t i = count; i % W != 0; ++i) set(i, at(count - 1));
  }
  template <class L> ISO_INLINE Vec3<L> load(std::uint32_t first) const {
    return {L::load(x + first), L::load(y + first), L::load(z + first)};
  }
  template <class L> ISO_INLINE void store(std::uint32_t first, Vec3<L> v) {
    v.x.store(x + first);
    v.y.store(y + first);
    v.z.store(z + first);
  }
};

/// Vectors that live elsewhere, in blocks of 16. Lanes that read beyond the last get the last again.
template <class T> struct ColumnsView {
  using Block = Columns<T, 16>;

  const Block* blocks = nullptr;
  std::uint32_t count = 0;

  ISO_INLINE std::uint32_t size() const { return count; }
  ISO_INLINE Vec3<T> operator[](std::uint32_t i) const { return blocks[i / 16].at(i % 16); }
  /// Loads from a multiple of the lanes' width.
  template <class L> ISO_INLINE Vec3<L> load(std::uint32_t first) const {
    return blocks[first / 16].template load<L>(first % 16);
  }

  struct Iterator {
    const ColumnsView* of;
    std::uint32_t i;
    ISO_INLINE Vec3<T> operator*() const { return (*of)[i]; }
    ISO_INLINE Iterator& operator++() {
      ++i;
      return *this;
    }
    ISO_INLINE bool operator!=(const Iterator& other) const { return i != other.i; }
  };
  ISO_INLINE Iterator begin() const { return {this, 0}; }
  ISO_INLINE Iterator end() const { return {this, count}; }
};

/// The memory that a ColumnsView shows.
template <class T> class ColumnsArray {
 public:
  ISO_INLINE void push_back(Vec3<T> v) {
    const std::uint32_t at = count_++ % 16;
    if (at == 0) blocks_.emplace_back();
    for (std::uint32_t i = at; i < 16; ++i) blocks_.back().set(i, v);
  }
  ISO_INLINE ColumnsView<T> view() const { return {blocks_.data(), count_}; }
  ISO_INLINE std::size_t memory() const { return blocks_.size() * sizeof blocks_[0]; }  // [bytes] that it points to

 private:
  std::vector<Columns<T, 16>> blocks_;
  std::uint32_t count_ = 0;
};

template <class L, class T> ISO_INLINE Vec3<L> broadcast(Vec3<T> v) {
  return {L::broadcast(v.x), L::broadcast(v.y), L::broadcast(v.z)};
}
template <class L, class T> ISO_INLINE Mat3<L> broadcast(const Mat3<T>& m) {
  return {{broadcast<L>(m.rows[0]), broadcast<L>(m.rows[1]), broadcast<L>(m.rows[2])}};
}

}  // namespace isostep
