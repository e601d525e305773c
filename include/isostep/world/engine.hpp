// WorldEngine<S>: what stands behind World<S>: the state, the caches derived from it, and the stages that advance it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "isostep/collision/narrowphase/pair_kernels.hpp"
#include "isostep/core/bitset.hpp"
#include "isostep/core/disjoint_sets.hpp"
#include "isostep/dynamics/carrying.hpp"
#include "isostep/dynamics/solvers/solvers.hpp"
#include "isostep/state/command_journal.hpp"
#include "isostep/state/leaves.hpp"
#include "isostep/world/checks.hpp"
#include "isostep/world/proxies.hpp"
#include "isostep/world/state.hpp"
#include "isostep/world/world.hpp"

namespace isostep {

/// Where a body or joint of a slot lies.
struct Location {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  static constexpr std::uint32_t kFixed = 0xfffffffeu;
  static constexpr std::uint32_t kAwake = 0xfffffffdu;
  std::uint32_t set = kNone;  // one of the above, or an index into WorldState::frozen
  std::uint32_t index = 0;

  bool is_frozen() const { return set < kAwake; }
  template <class Visitor, class Self> static ISO_INLINE constexpr void fields(Visitor&& visit, Self&& self) {
    visit("set", self.set);
    visit("index", self.index);
  }
};

/// A record of a woken island, to be sorted into the awake image.
template <class S> struct WokenRecord {
  std::uint64_t key;  // its place among the awake
  const FrozenIsland<S>* island;
  std::size_t index;
};

template <class S> class WorldEngine {
 public:
  explicit WorldEngine(const Settings<S>& settings);

  using Command = isostep::Command<S>;

  // engine_commands.inl, engine_destroy.inl, engine_joint_commands.inl: what a command does. Returns what it made or
  // whether it was accepted. `journal_` runs it.
#define ISO_EXECUTE(name, Type, Result, S) Result execute(const Type& command);
  ISO_FOR_EACH_COMMAND(ISO_EXECUTE, S)
#undef ISO_EXECUTE
  std::size_t destroy_all(std::span<const BodyId> bodies);

  // engine_step.inl
  StepReport step(const StageObserver& observer);
  StageView view(std::uint32_t stage);

  // engine_bodies.inl
  const BodyState<S>* state_of(BodyId body) const;
  const BodyProperties<S>* properties_of(BodyId body) const;
  const JointProperties<S>* properties_of(JointId joint) const;
  const BodyState<S>& state_at(Location at) const;
  const BodyProperties<S>& properties_at(Location at) const;
  Location location(std::uint32_t slot) const { return locations_[slot]; }
  std::span<const Child<S>> children_of(std::uint32_t shape_slot) const;
  Pose<S> origin_pose(const BodyState<S>& state, const BodyProperties<S>& body) const;
  Pose<S> centre_pose_at(std::uint32_t slot) const;
  S joint_error(JointId joint) const;

  // engine_leaves.inl
  static void walk_leaves(void* engine, LeafPart part, std::uint32_t stage, const LeafSink& sink);
  template <class Visit> void visit_leaves(LeafPart part, std::uint32_t stage, const Visit& visit);

  // engine_queries.inl
  std::optional<RayCastHit<S>> cast_ray(Vec3<S> origin, Vec3<S> translation, QueryFilter filter) const;
  void cast_ray_all(Vec3<S> origin, Vec3<S> translation, std::vector<RayCastHit<S>>& out, QueryFilter filter) const;
  bool sees(const QueryFilter& filter, std::uint32_t slot) const;
  std::optional<RayCastHit<S>> hit_of(std::uint32_t slot, Vec3<S> origin, Vec3<S> translation, S most) const;
  std::optional<ClosestBody<S>> closest(Vec3<S> point, S max_distance, QueryFilter filter) const;
  void overlapping(const Primitive<S>& shape, const Pose<S>& pose, std::vector<BodyId>& out, QueryFilter filter) const;
  void bodies_near(const Aabb<S>& box, std::vector<BodyId>& out, QueryFilter filter) const;
  void fill_render_poses(float alpha);

  // engine_state.inl
  void load(const WorldState<S>& from);
  std::uint64_t hash() const;
  void write_portable(Writer& writer) const;
  Result<void> read_portable(Reader& reader);

  template <class AnyId> bool known(const SlotMap& slots, AnyId id, const char* field) {
    return journal_.accept(detail::fault_of_id(slots, id, state_.settings.id_space, field));
  }
  bool known(BodyId body) { return known(state_.body_slots, body, "body"); }

  WorldState<S> state_;
  Events<S> events_;
  StepReport report_;
  mutable CommandJournal journal_;  // queries are refused, too
  const ContactKernels<S>* kernels_;
  const PairKernels<S>* pair_kernels_;
  const TreeKernels<S>* tree_kernels_;
  TaskRunner runner_;
  AssetSource assets_;
  std::vector<RenderPose> render_poses_;

 private:
  // engine_bodies.inl
  BodyState<S>* awake_state(std::uint32_t slot);
  BodyProperties<S>& mutable_properties(std::uint32_t slot);
  void insert_body(BodySet<S>& set, std::uint32_t set_name, const BodyState<S>& state, const BodyProperties<S>& body);
  void relabel(const BodySet<S>& set, std::uint32_t set_name, std::size_t from);
  void insert_joint(const JointState<S>& state, const JointProperties<S>& joint);
  void relabel_joints(const JointSet<S>& set, std::uint32_t set_name, std::size_t from);
  void renew_fat_box(BodyState<S>& state, const BodyProperties<S>& body, bool always);
  void draw_from_here(const BodyState<S>& state);
  void wake_touching(std::uint32_t slot);
  void wake_held_by(std::uint32_t slot);
  void restless(std::uint32_t slot);
  Location locate(BodyId body) const;
  bool may_change(BodyId body);
  bool may_push(BodyId body);
  BodyState<S>* wake_for_change(std::uint32_t slot);
  void halt(std::uint32_t slot);

  // engine_commands.inl
  bool find_blobs(const AddShape<S>& command, std::vector<BlobRef>& blobs);
  bool check(const BodyDefinition<S>& definition);
  bool set_mass(const BodyDefinition<S>& definition, BodyProperties<S>& body);
  PendingForce<S>& pending_force(std::uint32_t slot);

  // engine_destroy.inl
  bool doom(BodyId body);
  void end_touches_of_doomed();
  void bury_doomed();
  void destroy_joints_of(std::uint32_t slot);

  // engine_joint_commands.inl
  std::uint32_t wake_joint(JointId joint);

  // engine_contacts.inl
  void find_pairs();
  void update_pairs();
  void wake_touched_islands();
  bool bodies_touch(std::uint32_t slot_a, std::uint32_t slot_b) const;
  std::uint32_t row_of(std::uint32_t slot) const;
  void update_sensors();
  void emit_contact_events();
  S mass_of_row(std::uint32_t row) const;
  S pressing(std::size_t first, std::size_t end) const;

  // engine_parts.inl
  /// A body's place among the frames, and what tells how it collides: its PartKind and the bits below.
  struct Framed {
    static constexpr std::uint32_t kNone = 0xffffffffu;
    static constexpr std::uint32_t kSensor = 1u << 8, kFrozen = 1u << 9;
    std::uint32_t index = kNone;
    std::uint32_t traits = 0;
  };
  /// Parts are collided and merged so many at a time; where each list of them stands when a group begins.
  static constexpr std::size_t kGroup = 256;
  struct ListEnds {
    std::uint32_t spheres, boxes, others;
  };
  void collect_joined_pairs();
  BodyFrame<S> frame_at(Location at) const;
  static std::uint32_t traits_of(const BodyFrame<S>& frame);
  void make_room_for_frames();
  void frame_awake_body(std::size_t index);
  void frame_body(std::uint32_t slot);
  template <class Visit>
  static ISO_INLINE bool visit_parts(const BodyFrame<S>& a, const BodyFrame<S>& b, S margin, std::uint64_t& looks,
                                     Visit&& visit);
  static void collide_parts(const BodyFrame<S>& a, std::uint32_t i, const BodyFrame<S>& b, std::uint32_t j, S margin,
                            Manifold<S>& out);
  /// What compounds may take: two of their parts that are compared, and two that are collided. Both are some times as
  /// many as pairs of bodies may be: comparing takes a hundredth of what a contact takes.
  struct PartBudget {
    std::uint64_t looks, parts;
  };
  static constexpr std::uint64_t kLooksPerPair = 64, kPartsPerPair = 2;
  void gather_parts();
  bool gather_parts(PartBudget each, PartBudget all);
  bool gather_others(Framed at_a, Framed at_b, const PartBudget& each, PartBudget& all);
  void add_part(std::vector<std::uint32_t>& list, const PartPair& part);
  ListEnds list_ends() const;
  ListEnds ends_of(std::size_t group) const;
  std::size_t parts_of(std::size_t group) const;

  // engine_manifolds.inl
  void find_carried();
  static constexpr std::size_t kLeastSharedPairs = 4 * kGroup;  // some 60 us of float
  void update_manifolds();
  void make_manifolds();
  void share_manifolds();
  static void do_manifolds(void* engine, std::uint32_t stage, std::uint32_t piece);
  void collide_group(std::size_t group, std::uint8_t* counts, Manifold<S>* manifolds) const;
  static void collide_others(const PairRun<S>& run);
  std::size_t place_group(std::size_t group, const std::uint8_t* counts);
  void merge_group(std::size_t group, const std::uint8_t* counts, const Manifold<S>* manifolds, std::size_t next,
                   std::size_t& old_cursor);
  std::size_t first_old_contact(std::size_t group) const;
  void fill_contact(const PartPair& parts, const Manifold<S>& manifold, Contact<S>& contact, ContactGeometry<S>& g,
                    std::size_t& old_cursor) const;

  // engine_step.inl
  void tell_untold();
  void apply_forces();
  template <class Solver, class After> void solve(Solver& solver, const After& after, bool watched);
  StepContext<S> solver_context(bool watched);
  void finalise_bodies();
  void finish_body(std::size_t index);
  void discard_bad_impulses();

  // engine_leaves.inl
  template <class Visit> void visit_places(const Visit& visit);
  template <class Visit> void visit_manifolds(const Visit& visit);
  template <class Visit> void visit_solver(const Visit& visit, SolverStage stage);
  template <class Visit> void visit_scratch(const Visit& visit, Stage stage);

  // engine_sleep.inl
  void update_sleep();
  void update_sleep_clocks();
  void freeze_ready_islands();
  void freeze_marked();
  void unlist(std::uint32_t frozen_index);
  void merge_woken();
  void thaw_body(std::uint32_t slot);
  void thaw_bodies(std::span<const std::uint32_t> slots);
  void count_names(const FrozenIsland<S>& island, std::uint32_t by);

  // engine_state.inl
  void forget_places(bool other_fixed);
  void renew_places(bool other_fixed);

  // Caches: functions of the state.
  std::vector<Location> locations_;        // by body slot
  std::vector<Location> joint_locations_;  // by joint slot
  std::vector<std::uint32_t> named_;       // by body slot: contacts and joints of frozen islands that name the body
  Proxies<S> proxies_;

  // One step's scratch; drawing and the next step's events read some of it.
  Solvers<S> solvers_;
  std::vector<Acceleration<S>> accelerations_;
  std::vector<Pose<S>> start_poses_;         // of the centres of bodies awake when the step began
  std::vector<std::uint32_t> start_slots_;   // of those bodies, ascending; drawing asks for them after the step
  std::vector<BodyFrame<S>> frames_;         // of awake bodies, then of those that they might touch
  std::vector<Material<S>> materials_;       // by frame
  std::vector<Carrier<S>> carriers_;         // kinematic bodies that turn, by row
  std::vector<Carried<S>> carried_;          // contacts on them
  std::vector<Framed> framed_;               // by slot
  std::vector<std::uint32_t> framed_slots_;  // those that are not empty
  std::vector<PartPair> parts_;              // that might touch, ascending by their contacts' keys
  std::vector<ListEnds> groups_;
  std::vector<std::uint32_t> sphere_pairs_, box_pairs_, other_pairs_;  // places in their groups, ascending
  std::vector<std::uint8_t> point_counts_;                             // by place in a group
  std::vector<Manifold<S>> manifolds_;                                 // by place, where the count is not zero
  std::size_t placed_ = 0;                                             // contacts of this step so far
  std::vector<std::size_t> group_firsts_;                              // contacts before each group's
  std::uint32_t manifold_pieces_ = 0;
  std::size_t awake_frames_ = 0;
  std::vector<Contact<S>> old_contacts_;
  std::vector<ContactGeometry<S>> geometry_;
  std::vector<JointEnds<S>> joint_ends_;
  std::vector<std::uint64_t> joined_pairs_;  // ascending pair keys that joints keep from colliding
  std::vector<SensorOverlap> new_overlaps_;
  std::vector<SensorOverlap> overlap_scratch_;
  std::vector<std::uint64_t> sort_scratch_;
  std::vector<std::uint32_t> slots_;
  std::vector<Velocity<S>> step_impulses_;  // [m/s] per contact, of the whole step
  DisjointSets islands_;
  std::vector<std::uint32_t> island_clock_;
  std::vector<std::shared_ptr<const FrozenIsland<S>>> woken_;  // off the list, not yet in the awake image
  std::vector<WokenRecord<S>> woken_records_, woken_scratch_;
  std::vector<ContactEnd> contact_end_scratch_;
  std::vector<SensorEvent> sensor_end_scratch_;
  std::vector<std::uint32_t> doomed_;         // destroyed, their ids and records not yet dropped
  Bitset is_doomed_;                          // the same
  std::vector<std::uint32_t> other_islands_;  // indices at which two states differ
};

}  // namespace isostep
