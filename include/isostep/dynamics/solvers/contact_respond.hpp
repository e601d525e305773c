// A prepared contact of a KindResponse: other masses in its rows, and no more load than it bears.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/contact_response.hpp"
#include "isostep/dynamics/solvers/contact_lane.hpp"

namespace isostep {

/// Changes contacts with a KindResponse after all contacts are prepared, and relieves those that give way after each
/// pass. Kernels know of neither, so a world without such contacts pays nothing.
template <class S> class RespondingContact : public ContactLane<S> {
  using Lane = ContactLane<S>;
  using typename Lane::Block, typename Lane::Rolling, typename Lane::Row, typename Lane::V;

 public:
  using Lane::Lane;

  /// Replaces the mass shares. Shares of scaled masses add up to one too: coefficients stay near one at any scales.
  ISO_INLINE void respond(const ContactResponse<S>& response, const SolverMass<S>& a, const SolverMass<S>& b) const {
    const MassShare<S> share = response.share(a.mass, b.mass);
    this->put(this->block() + offsetof(Block, share_a), share.a);
    this->put(this->block() + offsetof(Block, share_b), share.b);
    this->turn_by(response.seen_a(a).kappa, response.seen_b(b).kappa);
  }
  /// Reduces the normal impulses to `most` [m/s] together, all by one factor, and cuts friction, twist and rolling to
  /// the cone of the rest.
  ISO_INLINE void relieve(V most, MotionRow<V>& a, MotionRow<V>& b) const {
    V load = V(0);
    for (std::size_t p = 0; p < this->points(); ++p) load = saturating_add(load, impulse_at(this->normal(p)));
    if (!(most < load)) return;
    const V kept = divide_to<V>(most, load);
    const std::size_t block = this->block();
    const V limit = saturate_to<V>(product(this->template get<S>(block + offsetof(Block, friction)), most));
    const V twist = saturate_to<V>(product(this->template get<S>(block + offsetof(Block, twist_friction)), most));
    const V rolling =
        block == 0 ? V(0) : saturate_to<V>(product(this->template get<S>(offsetof(Rolling, lever)), most));
    const Unit<S> ratio = this->template get<Unit<S>>(block + offsetof(Block, ratio));
    V left = limit;  // as solve_tangents() of the kernel
    this->each_row([&](std::size_t at, std::size_t direction) ISO_INLINE_LAMBDA {
      const V old = impulse_at(at);
      V next = round_to<V>(product(kept, old));
      if (at < block) next = clamp(old, -rolling, rolling);
      else if (direction == Lane::kTurns) next = clamp(old, -twist, twist);
      else if (at < this->normal(0)) {
        next = clamp(old, -left, left);
        left = min(limit, saturate_to<V>(product(S(2.41421356237309504880), limit - abs(next))));
        left = round_to<V>(product(left, ratio));
      }
      change(at, direction, next - old, a, b);
    });
  }

 private:
  ISO_INLINE V impulse_at(std::size_t row) const { return this->template get<V>(row + offsetof(Row, impulse)); }
  ISO_INLINE void change(std::size_t at, std::size_t direction, V by, MotionRow<V>& a, MotionRow<V>& b) const {
    const std::size_t block = this->block();
    this->put(at + offsetof(Row, impulse), impulse_at(at) + by);
    if (direction != Lane::kTurns) {
      const Vec3<S> along = this->vector(direction);
      const S share_a = this->template get<S>(block + offsetof(Block, share_a)),
              share_b = this->template get<S>(block + offsetof(Block, share_b));
      a.linear = a.linear - times(along, round_to<V>(product(share_a, by)));
      b.linear = b.linear + times(along, round_to<V>(product(share_b, by)));
    }
    a.angular = a.angular - times(this->vector(at + offsetof(Row, response_a)), by);
    b.angular = b.angular + times(this->vector(at + offsetof(Row, response_b)), by);
  }
  static ISO_INLINE Vec3<V> times(Vec3<S> v, V x) {
    return {round_to<V>(product(v.x, x)), round_to<V>(product(v.y, x)), round_to<V>(product(v.z, x))};
  }
};

}  // namespace isostep
