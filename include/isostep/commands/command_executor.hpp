// CommandExecutor<S>: what each command does.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "isostep/commands/command.hpp"
#include "isostep/commands/destruction.hpp"
#include "isostep/core/fault_log.hpp"
#include "isostep/core/instantiate.hpp"
#include "isostep/dynamics/checks.hpp"
#include "isostep/geometry/mass_properties.hpp"
#include "isostep/state/command_journal.hpp"
#include "isostep/store/record_place.hpp"
#include "isostep/systems/motion/move_targets.hpp"
#include "isostep/systems/motion/render_poses.hpp"
#include "isostep/systems/sleep/island_sleep.hpp"
#include "isostep/systems/sleep/island_wake.hpp"

namespace isostep {

/// Input:   commands, which WorldDesk::run brings.
/// Output:  the changed state, and what each command returns. A refused command changes nothing and leaves its fault in
///          the log.
/// Keeps:   nothing.
template <class S> class CommandExecutor {
 public:
  using EveryCommand = isostep::EveryCommand<S>;

  ISO_INLINE CommandExecutor(WorldState<S>& state, BodyMap<S>& map, Proxies<S>& proxies, IslandWake<S>& wake,
                             IslandSleep<S>& sleep, Destruction<S>& destruction, RenderPoses<S>& render_poses,
                             const AssetSource& assets, FaultLog& faults, CommandJournal& journal)
      : state_(state),
        map_(map),
        proxies_(proxies),
        wake_(wake),
        sleep_(sleep),
        destruction_(destruction),
        render_poses_(render_poses),
        assets_(assets),
        faults_(faults),
        journal_(journal) {}

  // execute_*.inl: one for each line of the list. Returns what the command made, or whether it was accepted.
#define ISO_EXECUTE(name, Type, Result, S) Result execute(const Type& command);
  ISO_FOR_EACH_COMMAND(ISO_EXECUTE, S)
#undef ISO_EXECUTE
  /// Does what that many DestroyBody do. A stale id is a fault, and the others go on. Returns how many it destroyed.
  std::size_t destroy_all(std::span<const BodyId> bodies);

 private:
  // Whether a command may do what it is to do; if not, that is its fault.
  template <class AnyId> bool known(const SlotMap& slot_map, AnyId id, const char* field) {
    return faults_.accept(detail::fault_of_id(slot_map, id, state_.settings.id_space, field));
  }
  bool known(BodyId body) { return known(state_.body_slots, body, "body"); }
  bool is_enabled(BodyId body);
  bool may_change(BodyId body);
  bool may_push(BodyId body);
  bool mark_for_destruction(BodyId body);
  bool accept_traits(std::span<const Child<S>> children);
  bool find_blobs(const AddShape<S>& command, std::vector<BlobRef>& blobs);
  bool accept_patch(const Result<BakedHeightField>& changed);
  void replace_blob(std::uint32_t shape, std::uint32_t child, const BlobRef& blob);
  /// A change of a height field, in the field's frame.
  struct FieldChange {
    std::uint32_t child;  // of its shape
    Aabb<S> about;        // [m] old and new heights
    ShapeView<S> before, after;
  };
  void renew_ground(std::uint32_t body, const Pose<S>& field, const FieldChange& change);
  void lift_buried(std::uint32_t ground, const Transform<S>& placed, const Aabb<S>& there, const FieldChange& change);
  S rise_below(Vec3<S> centre, const Transform<S>& placed, const FieldChange& change) const;
  bool accepts(const BodyDefinition<S>& definition);
  bool check_drives(JointId joint, const JointProperties<S>& next);
  bool accepts(const BodyMass<S>& mass);
  bool check_mass(const BodyMass<S>& mass, const MassProperties<S>& shape);
  bool check_ties(std::uint32_t slot, const BodyProperties<S>& next);
  bool check_joints_of(std::uint32_t slot, const BodyProperties<S>& next);
  template <class Record> bool check_tie(const Record& record, std::uint32_t slot, const BodyProperties<S>& next);
  bool check_ends(const JointProperties<S>& joint);
  template <class Change> bool change_joint(JointId joint, const Change& change);
  template <class Record> bool check_record(const Record& record);
  template <class Record> bool check_joints(const Record& record);
  template <class Record>
  detail::RecordPlace<S> place_of(const Record& record, std::uint32_t slot, const BodyProperties<S>* next) const;
  template <class Record> bool check_alone(const Record& record, std::uint32_t slot);
  template <class Record> void wake_for_record(const Record& record);
  void wake_what_rests_on(BodyId body);
  template <class Record> auto add_record(const Record& record);
  template <class Record, class IdType> bool set_record(IdType id, const Record& record);
  template <class IdType> bool remove_record(IdType id);
  template <class IdType, class Input> bool set_input(IdType id, const Input& input);

  static BodyProperties<S> properties_of(const BodyDefinition<S>& definition);
  bool give_mass(const BodyMass<S>& mass, BodyProperties<S>& body);
  bool give_mass_anew(const BodyMass<S>& mass, BodyProperties<S>& body);
  void replace(std::uint32_t slot, BodyState<S> state, const BodyProperties<S>& next);
  void wake_coupled(std::uint32_t slot);
  void leave_ground(std::uint32_t slot, const Pose<S>* from = nullptr);
  void forget_move(std::uint32_t slot);
  void halt(std::uint32_t slot);
  PendingForce<S>& pending_force(std::uint32_t slot);

  WorldState<S>& state_;
  BodyMap<S>& map_;
  Proxies<S>& proxies_;
  IslandWake<S>& wake_;
  IslandSleep<S>& sleep_;
  Destruction<S>& destruction_;
  RenderPoses<S>& render_poses_;
  const AssetSource& assets_;
  FaultLog& faults_;
  CommandJournal& journal_;
};

}  // namespace isostep
