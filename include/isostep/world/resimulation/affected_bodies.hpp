// AffectedBodies<S>: the bodies whose next step may differ from one that is known.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/store/state.hpp"

namespace isostep {

/// Input:   the state now, and another state of the same tick whose step is known.
/// Output:  a set of bodies, by slot. No body outside of it touches one of them, or could in this step, in either;
///          joints, records and sleeping islands lie inside or outside as a whole. So the step of all others is known.
/// Keeps:   nothing from call to call but memory.
/// Method:  Bodies that differ are affected, and those of contacts, joints, forces and records that differ. Then, until
///          no more are found: dynamic bodies whose fat boxes meet that of an affected body in either state, and those
///          that contacts, joints or records tie to one.
template <class S> class AffectedBodies {
 public:
  ISO_INLINE AffectedBodies(const WorldState<S>& now, const BodyMap<S>& map, const Proxies<S>& proxies)
      : now_(now), map_(map), proxies_(proxies) {}

  /// Returns false if a whole step is needed: the states differ in something that all bodies depend on, or have what
  /// reaches beyond boxes, or more than `most` bodies are affected.
  bool find(const WorldState<S>& old, std::size_t most);
  ISO_INLINE bool contain(std::uint32_t slot) const { return slot < marks_.size() && marks_[slot] != 0; }
  template <class Contact_> ISO_INLINE bool contain_one_of(const Contact_& contact) const {
    return contain(contact.key.body_a) || contain(contact.key.body_b);
  }

  /// Returns false if the last search ended because there are more.
  ISO_INLINE bool are_few() const { return slots_.size() <= most_; }

 private:
  bool same_ground() const;
  bool reach_is_known() const;

  void mark(std::uint32_t slot);
  void mark_movable(std::uint32_t slot);
  void mark_island(const SleepingIsland<S>& island);
  bool mark_tenants();
  void mark_bodies();
  void mark_sleepers();
  void mark_contacts();
  void mark_joints();
  void mark_ends(const JointProperties<S>& joint);
  void mark_pending();
  void mark_overlaps();
  void mark_untold();
  bool mark_records();
  template <class Record, class IdType>
  bool mark_records(const Registry<Record, IdType>& now, const Registry<Record, IdType>& old);

  bool is_movable(std::uint32_t slot) const;
  bool reach_neighbours();
  void reach(const Aabb<S>& box);
  void tie(std::uint32_t a, std::uint32_t b);
  void tie_contacts(const std::vector<Contact<S>>& contacts);
  void tie_joints(const std::vector<JointProperties<S>>& joints);
  void tie_records(const RecordStore<S>& records);
  template <class Record> void tie_record(const Record& record);

  const WorldState<S>& now_;
  const BodyMap<S>& map_;
  const Proxies<S>& proxies_;
  const WorldState<S>* old_ = nullptr;
  std::vector<std::uint8_t> marks_;   // by slot
  std::vector<std::uint32_t> slots_;  // the marked ones, as they were found
  std::vector<Aabb<S>> boxes_;        // of bodies that slept in the old state
  std::size_t reached_ = 0;           // of slots_: the neighbours of those before are marked
  std::size_t most_ = 0;
};

#define ISO_AFFECTED_BODIES_OF(extern, S) extern template class AffectedBodies<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_AFFECTED_BODIES_OF)

}  // namespace isostep
