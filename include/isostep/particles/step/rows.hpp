// ParticleRows: the constraints that hold in a step, as rows that solvers read and write, and where they stand.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/particles/constraint.hpp"
#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/step/step.hpp"

namespace isostep {

/// Links by slot, then contacts by key, then touches in the order in which they came.
template <class S> class ParticleRows {
 public:
  using V = Velocity<S>;
  using U = Unit<S>;
  using Row = ParticleConstraint<S>;

  ParticleRows(const ParticleState<S>& state, const ParticleStep<S>& step);

  // The rows are made anew every step, kind after kind.
  void clear();
  ISO_INLINE void add(const Row& row) { rows_.push_back(row); }
  ISO_INLINE void end_links() { first_contact_ = first_touch_ = static_cast<std::uint32_t>(rows_.size()); }
  ISO_INLINE void end_contacts() { first_touch_ = static_cast<std::uint32_t>(rows_.size()); }

  ISO_INLINE bool empty() const { return rows_.empty(); }
  ISO_INLINE std::span<Row> all() { return rows_; }
  ISO_INLINE std::span<Row> links() { return {rows_.data(), first_contact_}; }
  ISO_INLINE std::span<Row> contacts() { return {rows_.data() + first_contact_, rows_.data() + first_touch_}; }
  ISO_INLINE std::span<Row> touches() { return {rows_.data() + first_touch_, rows_.data() + rows_.size()}; }

  /// Finds normals and separations at the current positions. A passing particle must not meet the plane through a point
  /// where something was before.
  void look();
  /// Adds to each touched surface the velocity that a sub-step gives it.
  void accelerate_surfaces();
  /// Moves each touched surface at its own velocity, as the impulses changed it.
  void move_surfaces();

  template <class Visit> void visit_kinds(const Visit& visit);  // where each kind of row begins
  template <class Visit> void visit_scratch(const Visit& visit);

 private:
  ISO_INLINE void look_at_link(Row& row) const;
  ISO_INLINE void look_at_contact(Row& row) const;
  ISO_INLINE void look_at_touch(Row& row) const;

  const ParticleState<S>& state_;
  const ParticleStep<S>& step_;
  std::vector<Row> rows_;
  std::uint32_t first_contact_ = 0, first_touch_ = 0;
};

#define ISO_PARTICLE_ROWS_OF(extern, S) extern template class ParticleRows<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PARTICLE_ROWS_OF)

}  // namespace isostep
