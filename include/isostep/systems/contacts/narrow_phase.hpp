// NarrowPhase<S>: from pairs of bodies to contacts.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/belt.hpp"
#include "isostep/dynamics/kind_table.hpp"
#include "isostep/systems/contacts/flush_contacts.hpp"
#include "isostep/systems/contacts/part_pairs.hpp"
#include "isostep/systems/contacts/step_tools.hpp"

namespace isostep {

/// Holds the rules that records set for the contacts of a step.
template <class S> struct ContactRules {
  std::span<const std::uint64_t> apart = {};  // pairs of bodies that do not touch, ascending
  const Belts<S>* belts = nullptr;            // null: none
};

/// Input:   the state with the last step's contacts, the pairs of the broad phase in ascending order.
/// Output:  WorldState::contacts, ascending by key, with the impulses of the contacts that they continue; their
///          geometry; the overlaps of sensors.
/// Keeps:   nothing from step to step but memory.
/// Method:  PartPairs gathers pairs of parts in groups. Each pair fills a manifold of its own, so groups are collided
///          in any order. Manifolds on one flat surface are joined. Then manifolds are merged, in order, with the
///          contacts of the last step.
template <class S> class NarrowPhase {
 public:
  ISO_INLINE NarrowPhase(WorldState<S>& state, const BodyMap<S>& map)
      : state_(state), map_(map), part_pairs_(state, map), flush_(state, map) {}

  /// Returns the number of compound pairs that lack parts because the budget is used up. A step with many pairs is
  /// shared among the threads of `tools`.
  std::uint32_t update(std::span<const std::uint64_t> pairs, const StepTools<S>& tools,
                       const ContactRules<S>& rules = {});

  /// Parallel to the contacts.
  ISO_INLINE const std::vector<ContactGeometry<S>>& geometry() const { return geometry_; }
  /// The contacts of the last step.
  ISO_INLINE const std::vector<Contact<S>>& old_contacts() const { return old_contacts_; }
  /// Ascending, except where the sensor has the higher slot. SensorOverlaps takes them over.
  ISO_INLINE std::vector<SensorOverlap>& overlaps() { return overlaps_; }

  /// What the last step found to collide, and what it took to find it.
  ISO_INLINE const PartPairs<S>& part_pairs() const { return part_pairs_; }
  /// See PartPairs::joined_pairs().
  ISO_INLINE std::span<const std::uint64_t> joined_pairs() const { return part_pairs_.joined_pairs(); }

  template <class Visit> void visit_scratch(const Visit& visit) {
    part_pairs_.visit_scratch(visit);
    visit("old_contacts", old_contacts_);
    visit("new_overlaps", overlaps_);
    visit.each("geometry", geometry_.size(), [&](const auto& of_contact, std::size_t i) {
      ContactGeometry<S>& g = geometry_[i];
      of_contact("row_a", g.row_a);
      of_contact("row_b", g.row_b);
      of_contact("normal", g.normal);
      of_contact("axis", g.axis);
      of_contact("ratio", g.ratio);
      of_contact("points", std::span(g.points, state_.contacts[i].count));
      of_contact("material", g.material);
    });
  }

 private:
  static constexpr std::size_t kLeastSharedPairs = 4 * PartGroup::kEnough;  // some 60 us of float

  void update_alone();
  void update_shared(const TaskRunner& runner);
  static void run_piece(void* phase, std::uint32_t stage, std::uint32_t piece);
  void collide_group(std::size_t group, std::uint8_t* counts, Manifold<S>* manifolds) const;
  void collide_others(const PairRun<S>& run) const;
  void join_flat(const PairRun<S>& run) const;
  std::uint32_t join_flat(const PairRun<S>& run, std::uint32_t begin) const;
  bool lie_alike(const PartPair& x, const PartPair& y) const;
  /// Returns true if one of the two parts is a sensor: such a pair has no contact.
  ISO_INLINE bool is_sensed(const PartPair& pair) const {
    const BodyFrame<S>&a = part_pairs_.frames()[pair.frame_a], &b = part_pairs_.frames()[pair.frame_b];
    return (a.senses || b.senses) && (is_sensor_leaf(a, pair.child_a) || is_sensor_leaf(b, pair.child_b));
  }
  std::size_t place_group(std::size_t group, const std::uint8_t* counts);
  void merge_group(std::size_t group, const std::uint8_t* counts, const Manifold<S>* manifolds, std::size_t next,
                   std::size_t& old_cursor);
  std::size_t first_old_contact(std::size_t group) const;
  void fill_contact(const PartPair& parts, const Manifold<S>& manifold, Contact<S>& contact, ContactGeometry<S>& g,
                    std::size_t& old_cursor) const;
  std::uint32_t reported_flag(const BodyFrame<S>& a, const BodyFrame<S>& b, const ContactKey& key) const;
  void settle_friction(const PartPair& parts, const Contact<S>& contact, ContactGeometry<S>& g) const;
  std::span<const Contact<S>> old_contacts_of(const ContactKey& key, std::size_t cursor) const;

  WorldState<S>& state_;
  const BodyMap<S>& map_;
  PartPairs<S> part_pairs_;
  FlushContacts<S> flush_;
  MaterialTable<S> material_table_;
  std::span<const std::uint64_t> pairs_;  // for one update
  const Belts<S>* belts_ = nullptr;       // null: none runs
  const PairKernels<S>* kernels_ = nullptr;
  std::vector<std::uint8_t> point_counts_;  // by place in a group
  std::vector<Manifold<S>> manifolds_;      // by place, where the count is not zero
  std::size_t placed_ = 0;                  // contacts of this step so far
  std::vector<std::size_t> group_firsts_;   // contacts before each group's
  std::uint32_t pieces_ = 0;                // that threads share a stage in
  std::vector<Contact<S>> old_contacts_;
  std::vector<ContactGeometry<S>> geometry_;
  std::vector<SensorOverlap> overlaps_;
};

#define ISO_NARROW_PHASE_OF(extern, S) extern template class NarrowPhase<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_NARROW_PHASE_OF)

}  // namespace isostep
