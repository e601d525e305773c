// A prepared contact as fields: its lane of a block of any width, laid out as a block of one.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstring>
#include <span>

#include "isostep/dynamics/solvers/contact_block.hpp"

namespace isostep {
namespace {

/// A view of one lane of a block. Blocks are words of W lanes without padding: word k of lane l is at k W + l. So the
/// view is the same at every width, and builds for CPUs with other lanes can be compared.
template <class S> class LaneOfBlock {
 public:
  LaneOfBlock(void* block, std::size_t width, std::size_t lane, std::int32_t points, bool rolling)
      : at_(static_cast<unsigned char*>(block) + lane * sizeof(S)),
        width_(width),
        points_(static_cast<std::size_t>(points)),
        rolling_(rolling) {
    each_word([](unsigned char* own, unsigned char* shared) { std::memcpy(own, shared, sizeof(S)); });
  }
  void write_back() {
    each_word([](unsigned char* own, unsigned char* shared) { std::memcpy(shared, own, sizeof(S)); });
  }

  /// Visits all numbers or, if `solved`, only those that solving changes.
  template <class Visit> void visit(const Visit& visit, bool solved) {
    auto* words = rolling_ ? own_.bytes : own_.bytes + sizeof(RollingRows<S, 1>);
    auto& block = *reinterpret_cast<ContactBlock<S, 1, kMaxContactPoints>*>(own_.bytes + sizeof(RollingRows<S, 1>));
    auto& rolling = *reinterpret_cast<RollingRows<S, 1>*>(words);
    const std::span<NormalRow<S, 1>> normals(block.normals, points_);
    if (solved) return visit_impulses(visit, block, rolling, normals);
    visit("normal", block.normal);
    visit("share_a", block.share_a);
    visit("share_b", block.share_b);
    visit("friction", block.friction);
    visit("ratio", block.ratio);
    visit("tangents", block.tangents);
    visit("twist", block.twist);
    visit("twist_friction", block.twist_friction);
    visit("normals", normals);
    if (rolling_) visit("rolling", rolling);
  }

 private:
  template <class Visit>
  void visit_impulses(const Visit& visit, ContactBlock<S, 1, kMaxContactPoints>& block, RollingRows<S, 1>& rolling,
                      std::span<NormalRow<S, 1>> normals) {
    const auto impulse = [](const auto& of_row, auto& row) { of_row("impulse", row.impulse); };
    visit.each("normals", normals.size(), [&](const auto& of_point, std::size_t p) {
      impulse(of_point, normals[p].row);
      of_point("total_impulse", normals[p].total_impulse);
    });
    visit.each("tangents", 2, [&](const auto& of_row, std::size_t k) { impulse(of_row, block.tangents[k].row); });
    visit("twist_impulse", block.twist.impulse);
    if (!rolling_) return;
    visit.each("rolling", 2, [&](const auto& of_row, std::size_t k) { impulse(of_row, rolling.rows[k]); });
  }
  template <class Copy> void each_word(const Copy& copy) {
    const std::size_t words = block_bytes<S, 1>(static_cast<std::int32_t>(points_), rolling_) / sizeof(S);
    unsigned char* own = rolling_ ? own_.bytes : own_.bytes + sizeof(RollingRows<S, 1>);
    for (std::size_t k = 0; k < words; ++k) copy(own + k * sizeof(S), at_ + k * width_ * sizeof(S));
  }

  unsigned char* at_;  // the lane's first word
  std::size_t width_, points_;
  bool rolling_;
  union {
    unsigned char bytes[sizeof(RollingBlock<S, 1, kMaxContactPoints>)];
    RollingBlock<S, 1, kMaxContactPoints> block;
  } own_;
};

}  // namespace
}  // namespace isostep
