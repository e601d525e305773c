// PartPairs<S>: from pairs of bodies to the pairs of their parts that might touch, in groups.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/instantiate.hpp"
#include "isostep/store/body_frames.hpp"
#include "isostep/systems/contacts/throng.hpp"

namespace isostep {

/// Pairs of parts that are collided and merged together, because they fit in a core's cache. The lists hold ascending
/// places in `parts`: pairs of plain spheres, pairs of plain boxes, all others. A group has all pairs of a body with
/// one that has surfaces, so that triangles in one plane are known together.
struct PartGroup {
  static constexpr std::size_t kEnough = 256;  // pairs
  static constexpr std::size_t kMost = 4096;   // pairs, of a body on a fine mesh
  std::size_t first;                           // of its parts, among those of all groups
  std::span<const PartPair> parts;
  std::span<const std::uint32_t> spheres, boxes, others;
};

/// Input:   the state, the pairs of the broad phase in ascending order.
/// Output:  frames and materials of the bodies; the pairs of parts, ascending by their contacts' keys. Leaves out pairs
///          that a joint, a rule or the parts' own filters keep from colliding, and some of a throng.
/// Keeps:   nothing from step to step but memory.
/// Budget:  compounds may compare 64 pairs of parts and collide 2 for each pair of bodies that Settings::most_pairs
///          allows: a comparison costs a hundredth of a contact. Beyond the budget every pair of bodies gets the same
///          share.
template <class S> class PartPairs {
 public:
  ISO_INLINE PartPairs(const WorldState<S>& state, const BodyMap<S>& map) : state_(state), map_(map) {}

  /// Call in this order: begin, frame_awake_body for each awake body in any order or in parallel, gather.
  void begin(std::span<const std::uint64_t> apart = {});
  void frame_awake_body(std::size_t index);
  /// Returns the number of compound pairs that lack parts because the budget is used up.
  std::uint32_t gather(std::span<const std::uint64_t> pairs);
  /// Returns the result of the last `gather`.
  ISO_INLINE std::uint32_t cut_compounds() const { return cut_compounds_; }

  /// Pairs of bodies that joints and rules keep from colliding, ascending.
  ISO_INLINE std::span<const std::uint64_t> joined_pairs() const { return joined_pairs_; }
  /// Returns true if bodies begin in one place, so that gather() leaves out some of their pairs.
  ISO_INLINE bool any_throng() const { return throng_.any(); }
  /// The frames of awake bodies in their order, then of the other bodies that they might touch.
  ISO_INLINE const std::vector<BodyFrame<S>>& frames() const { return frames_; }
  ISO_INLINE const std::vector<Material<S>>& materials() const { return materials_; }
  ISO_INLINE std::size_t groups() const { return groups_.size(); }
  ISO_INLINE std::size_t parts() const { return parts_.size(); }
  /// Returns how many comparisons of parts the last `gather` took, unless it cut compounds.
  ISO_INLINE std::uint64_t looks() const { return looks_; }
  static ISO_INLINE constexpr std::uint64_t most_looks(std::uint64_t most_pairs) { return most_pairs * kLooksPerPair; }
  static ISO_INLINE constexpr std::uint64_t most_parts(std::uint64_t most_pairs) { return most_pairs * kPartsPerPair; }
  PartGroup group(std::size_t index) const;

  template <class Visit> void visit_scratch(const Visit& visit) {
    visit("frames", frames_);
    visit("materials", materials_);
    visit("parts", parts_);
  }

 private:
  /// A body's place among the frames, and its collision traits: its PartKind and the bits below.
  struct Framed {
    static constexpr std::uint32_t kNone = 0xffffffffu;
    static constexpr std::uint32_t kSenses = 1u << 8, kAsleep = 1u << 9;
    std::uint32_t index = kNone;
    std::uint32_t traits = 0;
  };
  /// The sizes of all lists as a group begins.
  struct ListEnds {
    std::uint32_t parts, spheres, boxes, others;
  };
  /// Numbers of pairs of parts that may be compared, and that may be collided.
  struct Budget {
    std::uint64_t looks, parts;
  };
  static constexpr std::uint64_t kLooksPerPair = 64, kPartsPerPair = 2;

  void collect_joined_pairs(std::span<const std::uint64_t> apart);
  void make_room_for_frames();
  void frame_body(std::uint32_t slot);
  static std::uint32_t traits_of(const BodyFrame<S>& frame);
  bool gather(std::span<const std::uint64_t> pairs, Budget each, Budget all);
  bool gather_others(Framed at_a, Framed at_b, const Budget& each, Budget& all);
  bool meet(const BodyFrame<S>& a, std::uint32_t i, const BodyFrame<S>& b, std::uint32_t j, bool presses) const;
  template <class Visit>
  bool visit_sorted_leaves(const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, std::uint64_t& looks, Visit& visit);
  void add_part(std::vector<std::uint32_t>& list, const PartPair& part);
  bool ends_group(const PartPair& part) const;
  ListEnds list_ends() const;

  void find_throng(std::span<const std::uint64_t> pairs);

  const WorldState<S>& state_;
  const BodyMap<S>& map_;
  Throng<S> throng_;
  std::vector<std::uint64_t> joined_pairs_, sort_scratch_;
  std::vector<BodyFrame<S>> frames_;
  std::vector<Material<S>> materials_;       // by frame
  std::vector<Framed> framed_;               // by slot
  std::vector<std::uint32_t> framed_slots_;  // those that are not empty
  std::vector<PartPair> parts_;
  std::vector<std::uint64_t> leaf_pairs_;  // of two bodies
  std::vector<ListEnds> groups_;
  std::vector<std::uint32_t> spheres_, boxes_, others_;  // places in their groups
  std::uint32_t cut_compounds_ = 0;
  std::uint64_t looks_ = 0;
};

#define ISO_PART_PAIRS_OF(extern, S) extern template class PartPairs<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PART_PAIRS_OF)

}  // namespace isostep
