// Destruction<S>: destroys bodies, one or many, with all that names them.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/bitset.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/systems/sleep/island_wake.hpp"

namespace isostep {

/// Input:   slots of bodies and joints that exist.
/// Output:  the state without them: their ids, records, contacts, joints, overlaps and forces. WorldState::untold keeps
///          the ends of their contacts and overlaps. What they may have held up is awake.
/// Keeps:   bodies that are marked and not yet erased.
/// Destroying many bodies at once gives the same state as one by one, in the order of their marks.
template <class S> class Destruction {
 public:
  ISO_INLINE Destruction(WorldState<S>& state, BodyMap<S>& map, Proxies<S>& proxies, IslandWake<S>& wake)
      : state_(state), map_(map), proxies_(proxies), wake_(wake) {}

  /// Destroys a body but for what takes a pass over the world:
  /// its id, records and joints stay until `erase_marked`.
  void mark(std::uint32_t slot);
  ISO_INLINE bool is_marked(std::uint32_t slot) const { return is_marked_.test(slot); }
  ISO_INLINE std::size_t marked() const { return marked_.size(); }
  /// The number of marked bodies that are awake.
  ISO_INLINE std::size_t marked_awake() const { return marked_awake_; }
  /// Erases the marked bodies in one pass over each array, whatever their number and that of their joints.
  void erase_marked();
  void destroy_joint(std::uint32_t slot);
  /// Ends the contacts and overlaps of a body, and the forces that were asked for it. The body itself stays and is
  /// awake, and so is what it may have held up.
  void part(std::uint32_t slot);

 private:
  /// The turn in which a body or joint goes; ascending. kStays comes after all others.
  using Turn = std::uint64_t;
  static constexpr Turn kStays = ~Turn{0};
  struct Going {
    Turn turn;
    std::uint32_t slot;
  };
  struct ByTurn {
    ISO_INLINE std::uint64_t operator()(const Going& going) const { return going.turn; }
  };
  Turn turn_of_body(BodyId body) const;
  Turn turn_of_joint(JointId joint) const;
  void erase_joints();
  template <class TurnOf> void remove_records(const TurnOf& turn_of);
  void sort(std::vector<Going>& going);
  void tell_ends();
  void erase_what_names_them();
  void erase_records();

  WorldState<S>& state_;
  BodyMap<S>& map_;
  Proxies<S>& proxies_;
  IslandWake<S>& wake_;
  std::vector<std::uint32_t> marked_;
  Bitset is_marked_;  // the same
  std::size_t marked_awake_ = 0;
  std::vector<std::uint32_t> ranks_;     // by body slot, of the marked: place in marked_
  std::vector<Turn> turns_;              // by joint slot
  std::vector<Going> joints_, records_;  // that go
  std::vector<Going> scratch_;
  std::vector<ContactEnd> contact_end_scratch_;
  std::vector<SensorEvent> sensor_end_scratch_;
};

#define ISO_DESTRUCTION_OF(extern, S) extern template class Destruction<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_DESTRUCTION_OF)

}  // namespace isostep
