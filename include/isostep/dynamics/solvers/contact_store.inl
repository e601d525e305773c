// Stores solved blocks in the contacts: the impulses that the next step begins with. Part of contact_kernel.inl, with
// internal linkage like it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "isostep/dynamics/solvers/contact_kernels.hpp"
#include "isostep/scalar/lanes.hpp"

namespace isostep {
namespace {

template <class S, int W, class Isa> struct ContactStorer {
  using L = Lanes<S, W, Isa>;
  using V = Lanes<Velocity<S>, W, Isa>;
  using Block = ContactBlock<S, W, kMaxContactPoints>;  // its first `points` normals alone are there

  static void store(const StoreRun<S>& run) {
    const std::size_t bytes = block_bytes<S, W>(run.points, run.rolling);
    const auto* memory = static_cast<const unsigned char*>(run.blocks) + (run.rolling ? sizeof(RollingRows<S, W>) : 0);
    for (std::int32_t at = 0; at < run.count; at += W, memory += bytes) {
      const Block& block = *reinterpret_cast<const Block*>(memory);
      V words[8];  // Contact<S> from normal_impulse to twist_impulse
      V total = V::zero();
      ISO_UNROLL for (int p = 0; p < kMaxContactPoints; ++p) {
        words[p] = V::zero();  // of a point that is not there
        if (p >= run.points) continue;
        words[p] = V::load(block.normals[p].row.impulse);
        total = total + (V::load(block.normals[p].total_impulse) + words[p]);
      }
      ISO_UNROLL for (int axis = 0; axis < 3; ++axis) {
        V sum = V::zero();
        for (const FrictionRow<S, W>& tangent : block.tangents) {
          sum = sum + round_to<V>(product(L::load(tangent.direction[axis]), V::load(tangent.row.impulse)));
        }
        words[4 + axis] = sum;
      }
      words[7] = V::load(block.twist.impulse);
      write(run, at, words, total);
    }
  }

 private:
  static ISO_INLINE void write(const StoreRun<S>& run, std::int32_t at, const V* words, V total) {
    const std::int32_t real = run.count - at < W ? run.count - at : W;
    const std::uint32_t pushed = to_bits(less(V::zero(), total));
    alignas(kLaneAlignment<Velocity<S>, W>) Velocity<S> totals[W];
    total.store(totals);
    Velocity<S>* rows[W];
    ISO_UNROLL for (int i = 0; i < W; ++i) {
      Contact<S>& contact = run.contacts[run.order[i < real ? at + i : at]];
      rows[i] = contact.normal_impulse;
      if (i >= real) continue;
      const bool touching = ((pushed >> i) & 1u) != 0;
      contact.flags = touching ? contact.flags | contact_flag::kTouching : contact.flags & ~contact_flag::kTouching;
      run.step_impulses[run.order[at + i]] = totals[i];
    }
    store_transposed<8>(rows, words, 0xffffffffu >> (32 - real));
  }
};

}  // namespace
}  // namespace isostep
