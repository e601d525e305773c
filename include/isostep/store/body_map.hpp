// BodyMap<S>: where the bodies and joints of a state lie.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/core/fields.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/store/state.hpp"

namespace isostep {

/// The array that holds a body or joint, and its place there: an index, or a place of StaticBodies.
struct Location {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::uint32_t kStatic = 0xfffffffeu;
  static constexpr std::uint32_t kAwake = 0xfffffffdu;
  std::uint32_t set = kNone;  // one of the above, or an index into WorldState::sleeping
  std::uint32_t index = 0;

  ISO_INLINE bool is_asleep() const { return set < kAwake; }
  ISO_FIELDS(set, index)
};

/// BodyMap leads from a slot to the record, in O(1). A cache: all of it follows from the state.
/// Input:   the state, and calls from whatever moves records between its arrays.
/// Output:  locations, and the records that lie there.
/// Keeps:   a location for each slot; how often sleeping islands name a body; the content of blobs.
template <class S> class BodyMap {
 public:
  ISO_INLINE explicit BodyMap(WorldState<S>& state) : state_(state) {}

  // Locations, by slot.
  ISO_INLINE std::size_t slot_count() const { return locations_.size(); }
  ISO_INLINE Location location(std::uint32_t slot) const { return locations_[slot]; }
  ISO_INLINE Location joint_location(std::uint32_t slot) const { return joint_locations_[slot]; }
  /// The row of SolverBodies: 0, which nothing moves, unless the body is awake.
  ISO_INLINE std::uint32_t row_of(std::uint32_t slot) const {
    if (slot == kNoBody) return 0;
    const Location at = locations_[slot];
    return at.set == Location::kAwake ? at.index + 1 : 0;
  }
  /// Contacts and joints of sleeping islands that name the body.
  ISO_INLINE std::uint32_t names(std::uint32_t slot) const { return names_[slot]; }
  /// Whether the body takes part; what is disabled lies among the static ones. kNoBody, the world itself, does.
  ISO_INLINE bool is_enabled(std::uint32_t slot) const {
    if (slot == kNoBody || locations_[slot].set != Location::kStatic) return true;
    return isostep::is_enabled(state_.static_bodies.properties(locations_[slot].index));
  }
  /// Whether both bodies of a joint take part: if not, it holds nothing.
  ISO_INLINE bool is_enabled(const JointProperties<S>& joint) const {
    return is_enabled(joint.body_a) && is_enabled(joint.body_b);
  }

  // Records. Those by id are null for an id that names nothing.
  ISO_INLINE const BodyState<S>& state_at(Location at) const {
    if (at.set == Location::kAwake) return state_.awake.states[at.index];
    if (at.set == Location::kStatic) return state_.static_bodies.state(at.index);
    return state_.sleeping[at.set]->bodies.states[at.index];
  }
  ISO_INLINE const BodyProperties<S>& properties_at(Location at) const {
    if (at.set == Location::kAwake) return state_.awake.properties[at.index];
    if (at.set == Location::kStatic) return state_.static_bodies.properties(at.index);
    return state_.sleeping[at.set]->bodies.properties[at.index];
  }
  const BodyState<S>* state_of(BodyId body) const;
  const BodyProperties<S>* properties_of(BodyId body) const;
  const JointProperties<S>* properties_of(JointId joint) const;
  /// The records of a body that does not sleep, to be changed.
  BodyState<S>& change_state(std::uint32_t slot);
  BodyProperties<S>& change_properties(std::uint32_t slot);
  ISO_INLINE std::span<const Child<S>> children_of(std::uint32_t shape_slot) const {
    return state_.shapes[shape_slot]->children;
  }
  /// Of all parts of a shape.
  ISO_INLINE const ShapeTraits& traits_of(std::uint32_t shape_slot) const { return state_.shapes[shape_slot]->traits; }
  /// Whether the body, or one of its parts, is a sensor; and whether nothing of it is anything else.
  ISO_INLINE bool senses(const BodyProperties<S>& body) const {
    return (body.flags & body_flag::kSensor) != 0 || traits_of(body.shape).has(part_flag::kSensor);
  }
  ISO_INLINE bool is_sensor(const BodyProperties<S>& body) const {
    return (body.flags & body_flag::kSensor) != 0 || !traits_of(body.shape).any_solid;
  }
  /// Whether one of two bodies is dynamic: others do not push each other.
  ISO_INLINE bool is_pushed(std::uint32_t slot_a, std::uint32_t slot_b) const {
    return properties_at(location(slot_a)).type == BodyType::dynamic ||
           properties_at(location(slot_b)).type == BodyType::dynamic;
  }
  /// Whether something of it presses on others.
  ISO_INLINE bool has_contacts(const BodyProperties<S>& body) const {
    constexpr std::uint32_t kFlags = body_flag::kSensor | body_flag::kCollide;
    return (body.flags & kFlags) == body_flag::kCollide && traits_of(body.shape).any_solid;
  }
  /// No less than any of its parts collides with.
  ISO_INLINE Filter filter_of(const BodyProperties<S>& body) const {
    return traits_of(body.shape).filter_or(body.filter);
  }
  /// Whether events tell when the contacts of a part begin and end.
  ISO_INLINE bool reports(const BodyProperties<S>& body, std::uint32_t child) const {
    return (body.flags & body_flag::kReportContacts) != 0 ||
           children_of(body.shape)[child].traits.has(part_flag::kReportContacts);
  }
  /// The part that a contact's key names: a leaf.
  Leaf leaf_of(std::uint32_t body_slot, std::uint32_t leaf) const;
  /// The bodies and parts of a contact.
  ContactEnd named(const ContactKey& key) const;
  /// Null: the shape has no such child, or it is no height field.
  const Child<S>* height_field_of(std::uint32_t shape_slot, std::uint32_t child) const;
  /// Null: the shape has few children.
  ISO_INLINE const ChildTree<S>* tree_of(std::uint32_t shape_slot) const {
    return state_.shapes[shape_slot]->tree.get();
  }
  /// [m] The least thickness() of all its children.
  ISO_INLINE S thinnest_of(std::uint32_t shape_slot) const { return state_.shapes[shape_slot]->thinnest; }
  /// [m] The least of all shapes.
  S least_thickness() const;
  /// Whether a body has the shape.
  ISO_INLINE bool is_used(std::uint32_t shape_slot) const {
    return shape_slot < uses_.size() && uses_[shape_slot] != 0;
  }
  /// Contents of the blobs that children name.
  ISO_INLINE Contents<S> contents() const { return {contents_.data()}; }
  static Pose<S> origin_pose(const BodyState<S>& state, const BodyProperties<S>& body);
  /// The inverse: where the centre of mass is, axes as the body's, of a body with its origin there.
  static Pose<S> centre_pose(const Pose<S>& origin, Vec3<S> local_centre);
  Pose<S> origin_pose_at(std::uint32_t slot) const;
  /// Pose of the centre of mass, or for kNoBody of the world itself.
  ISO_INLINE Pose<S> centre_pose_at(std::uint32_t slot) const {
    if (slot == kNoBody) return Pose<S>::identity();
    const BodyState<S>& state = state_at(locations_[slot]);
    return {state.centre, state.orientation};
  }

  // Changes. `set` is the array's name in a Location.
  /// Puts a body among the static or the awake ones, and a joint among the awake ones.
  void insert(const BodyState<S>& state, const BodyProperties<S>& body);
  void insert(const JointState<S>& state, const JointProperties<S>& joint);
  /// Erases a body that does not sleep.
  void erase(std::uint32_t slot);
  /// Erases an awake joint.
  void erase_joint(std::uint32_t slot);
  /// The records of an array from index `from` on were moved.
  void relabel(const BodySet<S>& bodies, std::uint32_t set, std::size_t from);
  void relabel(const JointSet<S>& joints, std::uint32_t set, std::size_t from);
  ISO_INLINE void place(std::uint32_t slot, Location at) { locations_[slot] = at; }
  ISO_INLINE void place_joint(std::uint32_t slot, Location at) { joint_locations_[slot] = at; }
  /// Counts the bodies that an island's contacts and joints name. `by`: 1 when it falls asleep; modulo 2^32, -1 when it
  /// wakes.
  void count_names(const SleepingIsland<S>& island, std::uint32_t by);
  /// The bodies of a page of StaticBodies from row `from` on were moved.
  void relabel_static(std::size_t page, std::size_t from = 0);
  /// Counts the bodies of a shape. `by`: 1 when one comes; modulo 2^32, -1 when it goes.
  ISO_INLINE void count_use(std::uint32_t shape_slot, std::uint32_t by) {
    if (uses_.size() <= shape_slot) uses_.resize(shape_slot + 1);
    uses_[shape_slot] += by;
  }
  /// Makes room for every slot that the state has handed out.
  void make_room();
  /// Renews all contents, after the state's blobs have changed.
  void renew_contents();
  /// Renews the one at a place.
  void renew_content(std::uint32_t place);
  /// A shape of children as a world stores them, or of none, with all that follows from them; contents come first.
  static std::shared_ptr<const StoredShape<S>> stored(std::vector<Child<S>> children, Contents<S> contents);
  /// Puts a shape in place of that which the slot has; its number is among those handed out.
  void put_shape(std::uint32_t slot, std::vector<Child<S>> children);
  /// The shapes of the state are others.
  ISO_INLINE void forget_thickness() { knows_thickness_ = false; }

  template <class Visit> void visit_scratch(const Visit& visit) {
    visit("locations", std::span(locations_.data(), state_.body_slots.entries().size()));
    visit("joint_locations", std::span(joint_locations_.data(), state_.joint_slots.entries().size()));
  }

 private:
  Location locate(BodyId body) const;

  WorldState<S>& state_;
  std::vector<Location> locations_, joint_locations_;
  std::vector<std::uint32_t> names_;   // by body slot
  std::vector<const void*> contents_;  // by place in the geometry store
  std::vector<std::uint32_t> uses_;    // by shape slot: bodies that have it
  mutable S thickness_ = S(0);         // [m] least_thickness(), where it is known
  mutable bool knows_thickness_ = false;
};

#define ISO_BODY_MAP_OF(extern, S) extern template class BodyMap<S>;
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BODY_MAP_OF)

}  // namespace isostep
