// One lane of a prepared contact's block, row by row: for what changes few contacts after all were prepared.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>

#include "isostep/dynamics/solvers/contact_block.hpp"
#include "isostep/math/mat3.hpp"

namespace isostep {

/// One lane of a block of `width`, addressed like a block of one. Gives the same bits at every width.
template <class S> class ContactLane {
 public:
  /// `words`: those of the contact's RollingRows if it has them, else of its ContactBlock.
  ISO_INLINE ContactLane(unsigned char* words, std::size_t width, std::int32_t points, bool rolling)
      : words_(words), width_(width), points_(static_cast<std::size_t>(points)), rolling_(rolling) {}

  /// Renews the responses. kappa: mass times inverse inertia in world axes [1/m^2], of the two bodies now.
  ISO_INLINE void turn_by(const Mat3<S>& kappa_a, const Mat3<S>& kappa_b) const {
    const S share_a = get<S>(block() + offsetof(Block, share_a)), share_b = get<S>(block() + offsetof(Block, share_b));
    each_row([&](std::size_t at, std::size_t direction) ISO_INLINE_LAMBDA {
      const Vec3<S> jacobian_a = vector(at + offsetof(Row, jacobian_a)),
                    jacobian_b = vector(at + offsetof(Row, jacobian_b));
      const Vec3<S> response_a = (kappa_a * jacobian_a) * share_a, response_b = (kappa_b * jacobian_b) * share_b;
      const S linear = direction != kTurns ? share_a + share_b : S(0);
      const S k = linear + round_to<S>(dot_sum(jacobian_a, response_a) + dot_sum(jacobian_b, response_b));
      put(at + offsetof(Row, response_a), response_a);
      put(at + offsetof(Row, response_b), response_b);
      put(at + offsetof(Row, effective_mass), S(0.125) < k ? divide_to<S>(S(1), k) : S(0));  // as RowMaker's
    });
  }

 protected:
  using V = Velocity<S>;
  using Block = ContactBlock<S, 1, kMaxContactPoints>;
  using Rolling = RollingRows<S, 1>;
  using Row = AngularRow<S, 1>;
  using Friction = FrictionRow<S, 1>;
  using Normal = NormalRow<S, 1>;
  static_assert(offsetof(Friction, row) == 0 && offsetof(Normal, row) == 0 && sizeof(Velocity<S>) == sizeof(S));
  static constexpr std::size_t kTurns = ~std::size_t{0};  // in place of a direction: the row only turns

  // Places are those in a block of one [bytes].
  ISO_INLINE std::size_t points() const { return points_; }
  ISO_INLINE std::size_t block() const { return rolling_ ? sizeof(Rolling) : 0; }
  ISO_INLINE std::size_t normal(std::size_t p) const { return block() + offsetof(Block, normals) + p * sizeof(Normal); }
  /// Calls act(place, place of the direction along which the row pushes, or kTurns).
  template <class Act> ISO_INLINE void each_row(const Act& act) const {
    for (std::size_t k = 0; rolling_ && k < 2; ++k) act(offsetof(Rolling, rows) + k * sizeof(Row), kTurns);
    for (std::size_t k = 0; k < 2; ++k) {
      const std::size_t at = block() + offsetof(Block, tangents) + k * sizeof(Friction);
      act(at, at + offsetof(Friction, direction));
    }
    act(block() + offsetof(Block, twist), kTurns);
    for (std::size_t p = 0; p < points_; ++p) act(normal(p), block() + offsetof(Block, normal));
  }
  template <class T> ISO_INLINE T get(std::size_t at) const {
    T value;
    std::memcpy(&value, words_ + width_ * at, sizeof value);
    return value;
  }
  template <class T> ISO_INLINE void put(std::size_t at, T value) const {
    std::memcpy(words_ + width_ * at, &value, sizeof value);
  }
  ISO_INLINE Vec3<S> vector(std::size_t at) const {
    return {get<S>(at), get<S>(at + sizeof(S)), get<S>(at + 2 * sizeof(S))};
  }
  ISO_INLINE void put(std::size_t at, Vec3<S> value) const {
    for (std::size_t i = 0; i < 3; ++i) put(at + i * sizeof(S), value[static_cast<int>(i)]);
  }

 private:
  unsigned char* words_;
  std::size_t width_, points_;
  bool rolling_;
};

}  // namespace isostep
