// WorldEngine<S>: what stands behind World<S>: the state, and the systems that advance it.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>

#include "isostep/commands/command_executor.hpp"
#include "isostep/commands/destruction.hpp"
#include "isostep/dynamics/carriers.hpp"
#include "isostep/query/cast_queries.hpp"
#include "isostep/query/overlap_queries.hpp"
#include "isostep/state/fields.hpp"
#include "isostep/state/world_desk.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/store/stages.hpp"
#include "isostep/store/state.hpp"
#include "isostep/store/state_loader.hpp"
#include "isostep/systems/character/characters.hpp"
#include "isostep/systems/contacts/contact_responses.hpp"
#include "isostep/systems/contacts/narrow_phase.hpp"
#include "isostep/systems/contacts/pair_rules.hpp"
#include "isostep/systems/contacts/step_tools.hpp"
#include "isostep/systems/continuous/continuous_collision.hpp"
#include "isostep/systems/events/break_events.hpp"
#include "isostep/systems/events/contact_events.hpp"
#include "isostep/systems/events/contact_points.hpp"
#include "isostep/systems/events/hit_events.hpp"
#include "isostep/systems/events/joint_loads.hpp"
#include "isostep/systems/events/sensor_overlaps.hpp"
#include "isostep/systems/motion/body_finisher.hpp"
#include "isostep/systems/motion/move_targets.hpp"
#include "isostep/systems/motion/render_poses.hpp"
#include "isostep/systems/motion/sensor_mounts.hpp"
#include "isostep/systems/sleep/island_sleep.hpp"
#include "isostep/systems/sleep/island_wake.hpp"
#include "isostep/world/resimulation/step_memory.hpp"
#include "isostep/world/step_solver.hpp"
#include "isostep/world/world.hpp"

namespace isostep {

/// The state of a world and its systems. A step calls the systems in the order of its stages. A system can be read and
/// tested alone. Its header states its input, its output and what it keeps. A system knows the state, except Proxies
/// and Carriers, and the systems that its constructor names. It never knows other systems or the engine:
///
///   BodyMap         -> no other (has a ShapeMap and a JointMap inside)
///   Proxies         -> no other (has a Crowd inside)
///   IslandWake      -> BodyMap, Proxies
///   IslandSleep     -> BodyMap, Proxies
///   PairRules       -> BodyMap
///   NarrowPhase     -> BodyMap (as PartPairs inside of it)
///   ContactResponses -> BodyMap
///   Carriers        -> no other
///   StepSolver      -> BodyMap
///   BodyFinisher    -> BodyMap, Proxies
///   ContinuousCollision -> BodyMap, Proxies
///   SensorOverlaps  -> BodyMap, Proxies
///   ContactEvents   -> BodyMap
///   BreakEvents     -> BodyMap
///   JointLoads      -> BodyMap, Destruction
///   HitEvents       -> BodyMap
///   ContactPoints   -> BodyMap
///   RenderPoses     -> no other
///   Destruction     -> BodyMap, Proxies, IslandWake
///   MoveTargets     -> BodyMap
///   SensorMounts    -> BodyMap, Proxies
///   CommandExecutor -> BodyMap, Proxies, IslandWake, IslandSleep, Destruction, RenderPoses; faults, journal, assets
///   CastQueries, OverlapQueries -> BodyMap, Proxies; faults
///   Characters      -> BodyMap, Proxies, IslandWake, CommandExecutor
///   StateLoader     -> BodyMap, Proxies
///   StepMemory      -> the engine: it steps a part of the state by an engine of its own
///
/// BodyMap and Proxies are caches of the state: a system that moves bodies updates them. The step passes all other data
/// between systems from call to call.
template <class S> class WorldEngine {
 public:
  explicit WorldEngine(const Settings<S>& settings);
  WorldEngine(const WorldEngine&) = delete;  // its members refer to each other
  WorldEngine& operator=(const WorldEngine&) = delete;

  // engine_step.inl
  /// Steps, from memory where that is known: resimulation/step_memory.hpp. Whoever watches sees every stage.
  StepReport step(const StageObserver& observer);
  StepReport step_whole(const StageObserver& observer);

  // engine_fields.inl
  StageView view(std::uint32_t stage);
  static void walk_fields(void* engine, FieldGroup group, std::uint32_t stage, const FieldSink& sink);
  template <class Visit> void visit_fields(FieldGroup group, std::uint32_t stage, const Visit& visit);

  // engine_state.inl
  void load(const WorldState<S>& from);
  std::uint64_t hash() const;
  void write_portable(Writer& writer) const;
  Result<void> read_portable(Reader& reader);

  WorldState<S> state_;
  Events<S> events_;
  StepReport report_;
  WorldDesk desk_;
  StepTools<S> tools_ = {};
  AssetSource assets_;

  BodyMap<S> map_{state_};
  Proxies<S> proxies_{state_.shapes};
  IslandWake<S> wake_{state_, map_, proxies_};
  IslandSleep<S> sleep_{state_, map_, proxies_};
  MoveTargets<S> targets_{state_, map_};
  SensorMounts<S> mounts_{state_, map_, proxies_};
  PairRules<S> pair_rules_{state_, map_};
  NarrowPhase<S> narrow_phase_{state_, map_};
  ContactResponses<S> responses_{state_, map_};
  Belts<S> belts_;
  Carriers<S> carriers_;
  StepSolver<S> solver_{state_, map_, proxies_};
  BodyFinisher<S> finisher_{state_, map_, proxies_};
  ContinuousCollision<S> continuous_{state_, map_, proxies_};
  SensorOverlaps<S> sensors_{state_, map_, proxies_};
  ContactEvents<S> contact_events_{state_, map_};
  BreakEvents<S> break_events_{state_, map_};
  HitEvents<S> hit_events_{state_, map_};
  ContactPoints<S> contact_points_{state_, map_};
  RenderPoses<S> render_poses_{state_};
  Destruction<S> destruction_{state_, map_, proxies_, wake_};
  JointLoads<S> joint_loads_{state_, map_, destruction_};
  CommandExecutor<S> commands_{state_,       map_,          proxies_, wake_,        sleep_,
                               destruction_, render_poses_, assets_,  desk_.faults, desk_.journal};
  CastQueries<S> casts_{state_, map_, proxies_, desk_.faults};
  OverlapQueries<S> overlaps_{state_, map_, proxies_, desk_.faults};
  Characters<S> characters_{state_, map_, proxies_, wake_, commands_};
  StateLoader<S> loader_{state_, map_, proxies_};
  std::unique_ptr<StepMemory<S>> memory_;  // null: it remembers no step

 private:
  // engine_step.inl
  void find_pairs();
  void find_contacts();
  void tell_untold();
  void tell_sleep();
  template <class Solver, class After> void solve(Solver& solver, const After& after, bool watched);

  // engine_fields.inl
  template <class Visit> void visit_scratch(const Visit& visit, Stage stage);

  std::vector<std::uint32_t> change_of_;  // of tell_sleep(), by slot
};

/// The step is compiled apart from what is called between steps: instantiate/world_step.cpp.
#define ISO_ENGINE_OF(extern, S)                                         \
  extern template StepReport WorldEngine<S>::step(const StageObserver&); \
  extern template StepReport WorldEngine<S>::step_whole(const StageObserver&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_ENGINE_OF)

}  // namespace isostep
