// The book's resolver: contacts and links one at a time, the fastest closing first.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/core/island_budgets.hpp"
#include "isostep/core/tournament_tree.hpp"
#include "isostep/particles/axes.hpp"
#include "isostep/particles/constraint.hpp"
#include "isostep/particles/limits.hpp"

namespace isostep {

/// The terms of a call beside its rows.
template <class S> struct ResolverTerms {
  S rate;                                   // [1/s] gained [m/s] is what forces give in 1 / rate
  bool lags;                                // velocities without gained are those of half that time ago
  std::optional<std::uint32_t> iterations;  // shared by all islands; none: default_iterations() for each
  std::uint64_t looks = ~std::uint64_t{0};  // at rows; when they are over, one pass ends the call
};

/// Resolves the most urgent of all rows, again and again, as the book does: contacts, cables, rods and friction.
/// Source:  Millington 2007, ch. 7.1-7.2 (impulses, linear projection, resting contacts, order), p. 140 (friction).
/// Symbols: v_s = n.(v_b - v_a) [m/s] separating speed; C [m] = separation + n.(d_b - d_a); e = restitution;
///          g = n.(gained_b - gained_a), the part of v_s that this sub-step's forces made; N = impulse of this call;
///          f = v_s - min(g, 0), the closing speed without g; p = -C, the depth; h = the time that g took.
///          Bounce: v_s' = max(0, e sqrt(f^2 - 2 p |g| / h) + min(g, 0)), so that one sub-step's gravity does not
///          bounce; where velocities lag, f has half of |g| more.
/// Order:   first wrong velocities, the largest first: contacts and cables that touch and close, rods that change
///          length, friction that must change. Then overlaps, the deepest first: moving particles apart changes no
///          velocity, so it cannot undo the first part. Ties go to the lowest index.
/// Differs: the book subtracts neither g from the speed of a bounce nor the work of leaving an overlap against the
///          forces: both add energy at each bounce. It takes the row of lowest v_s first, also among overlaps: two
///          slow contacts that push each other to and fro would keep a deep one waiting. Here an impulse lowers g of
///          both its particles, so the upper contacts of a stack tell gravity from an impact. Friction is a vector
///          within the cone mu N of the call's total, and is looked at whenever a neighbour moves, not only when its
///          contact is the worst. A contact or cable with C above 0 waits; once it has touched it counts to the end of
///          the call.
/// Cost:    O(log rows) for each row that shares a movable particle with the resolved one. Where hundreds share one,
///          the search ends after most_looks() or terms.looks, and every row is resolved once more in the rows' order,
///          so a particle's contacts with scenery should come last. No allocation once warm.
/// Limits:  relative speeds and C beyond the ends of Velocity<S> count as those ends; velocities and displacements are
///          held within passing_speed() and passing_distance().
template <class S> class WorstFirst {
  using V = Velocity<S>;

 public:
  /// Returns the number of iterations that the book allows an island of `count` rows.
  static ISO_INLINE std::uint32_t default_iterations(std::uint32_t count) {
    return count > 0x7fffffffu ? 0xffffffffu : 2u * count;
  }

  /// Returns the most looks at an island's rows in one call: half a second of them, and 64 a row. A pile takes 50; a
  /// crowd in one place would take the cube of its number.
  static ISO_INLINE std::uint64_t most_looks(std::uint32_t count) { return (1u << 20) + std::uint64_t{64} * count; }

  /// Resolves rows after the integration of a sub-step, or between its velocity and its position. Returns how many rows
  /// are still unsettled when the iterations or looks have run out. `displacement` [m] is the way since the rows'
  /// separation was measured, the integration's part too; it is moved, separation stays. `gained` [m/s] is what forces
  /// have added to velocity in 1 / terms.rate s, 0 of pinned particles. Rows' impulses are those of this call, approach
  /// is lowered. Where positions are integrated first, gravity's way along a slope, g h^2 a sub-step, is not friction's
  /// to undo.
  std::uint32_t resolve(ParticleConstraint<S>* rows, std::uint32_t count, Axes<V>& velocity, Axes<V>& displacement,
                        const Axes<V>& gained, const ResolverTerms<S>& terms);

  /// The counts of the last call: rows resolved, and looks at rows for their urgency.
  ISO_INLINE std::uint32_t iterations() const { return iterations_; }
  ISO_INLINE std::uint64_t looks() const { return looks_; }

 private:
  using Row = ParticleConstraint<S>;
  struct Point {
    Vec3<V> velocity, displacement, gained;
  };
  /// A row's particles in points_, kNoParticle for none.
  struct Sides {
    std::uint32_t a, b;
  };
  enum class Need : std::uint32_t { motion, projection, nothing };
  struct Urgency {
    Need need;
    V amount;  // [m/s] or [m], the lower the sooner
  };

  void gather(const Row* rows, std::uint32_t count, const Axes<V>& velocity, const Axes<V>& displacement,
              const Axes<V>& gained);
  void list_neighbours(const Row* rows, std::uint32_t count);
  void scatter(Axes<V>& velocity, Axes<V>& displacement);
  std::uint32_t point_of(std::uint32_t slot, const Axes<V>& velocity, const Axes<V>& displacement,
                         const Axes<V>& gained);

  void look(const Row& row, std::uint32_t index);
  void look_at_neighbours(const Row* rows, std::uint32_t index, std::uint32_t point);
  void apply(Row& row, std::uint32_t index);
  void share_out(const Row* rows, std::uint32_t count);
  std::uint32_t leave_island(std::uint32_t row);
  std::uint32_t resolve_worst(Row* rows, std::uint32_t count, const ResolverTerms<S>& terms);
  std::uint32_t pass_over(Row* rows, std::uint32_t count);

  ISO_INLINE Vec3<V> velocity_of_b(const Row& row, Sides sides) const;
  ISO_INLINE V separating_speed(const Row& row, Sides sides) const;
  ISO_INLINE V gained_speed(const Row& row, Sides sides) const;
  ISO_INLINE V gap(const Row& row, Sides sides) const;
  ISO_INLINE V bounced_speed(const Row& row, V former, V gained, V separation) const;
  ISO_INLINE V fastest_of(const Row& row, Sides sides) const;
  ISO_INLINE Vec3<V> friction_change(const Row& row, Sides sides, V speed) const;
  ISO_INLINE void push(const Row& row, Sides sides, Vec3<V> change, Vec3<V> Point::*of, V most);
  ISO_INLINE void hit(Row& row, Sides sides, Vec3<V> change);

  /// Orders rows: first the more urgent, then the lower index.
  ISO_INLINE auto before() const {
    return [this](std::uint32_t i, std::uint32_t j) ISO_INLINE_LAMBDA {
      const Urgency& a = urgency_[i];
      const Urgency& b = urgency_[j];
      if (a.need != b.need) return a.need < b.need;
      if (a.amount != b.amount) return a.amount < b.amount;
      return i < j;
    };
  }

  std::vector<Point> points_;              // the particles of the rows, in order of first mention
  std::vector<std::uint32_t> slots_;       // of points_
  std::vector<std::uint32_t> point_of_;    // by slot; kNoParticle between calls
  std::vector<Sides> sides_;               // by row
  std::vector<std::uint32_t> first_;       // by point, and one more: its rows in neighbours_
  std::vector<std::uint32_t> neighbours_;  // rows that can move a point, ascending
  std::vector<std::uint8_t> touched_;      // by row
  std::vector<Urgency> urgency_;           // by row
  IslandBudgets budgets_;                  // of a call
  TournamentTree worst_;                   // of urgency_
  S rate_ = S(0);                          // [1/s] of a call, as lags_
  bool lags_ = false;
  std::uint32_t iterations_ = 0;
  std::uint64_t looks_ = 0;
};

#define ISO_EXTERN_WORST_FIRST(S) extern template class WorstFirst<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN_WORST_FIRST)
#undef ISO_EXTERN_WORST_FIRST

}  // namespace isostep
