// Worlds: made, stepped, asked and set up.
// SPDX-License-Identifier: MIT
#include "objects.hpp"

using namespace isostep;
using namespace isostep::c;

namespace {

template <class S> iso_status world_create(const void* from, iso_world** out) {
  constexpr const char* kCall = "world_create";
  return guarded(kCall, [&] {
    ISO_C_REQUIRE(kCall, out);
    *out = nullptr;
    if constexpr (!kIsBuilt<S>) {
      return refuse(ISO_NO_SCALAR, kCall);
    } else {
      Settings<S> settings;
      const iso_status taken = take_sized(kCall, from, settings);
      if (taken != kOk) return taken;
      auto made = std::make_unique<WorldOf<S>>(settings);
      if (made->world.fault() != Fault::none) return refuse(made->world.fault());
      *out = open_handle<iso_world>(made.get());
      made.release();
      return kOk;
    }
  });
}
template <class S> iso_status get_settings(const iso_world* world, void* out) {
  return in_world<S>(world, "world_get_settings", Access::reads,
                     [&](auto& of) { return put_sized("world_get_settings", out, of.world.settings()); });
}
template <class S> iso_status set_gravity(iso_world* world, const void* from) {
  return in_world<S>(world, "world_set_gravity", Access::changes, [&](auto& of) {
    Vec3<S> gravity = Vec3<S>::zero();
    const iso_status taken = take_plain("world_set_gravity", from, gravity);
    if (taken == kOk) of.world.set_gravity(gravity);
    return taken;
  });
}

CFaultReport told(const FaultReport& report) {
  CFaultReport told;
  told.status = static_cast<std::int32_t>(report.fault);
  told.command.at = report.command;
  told.field.at = report.field;
  told.expected.at = report.expected;
  return told;
}

template <class IdType>
iso_status put_ids(const char* call, const std::vector<IdType>& ids, std::uint64_t* out, size_t room, size_t* count) {
  return put_list(call, ids, out, room, count);
}

}  // namespace

iso_status iso_world_destroy(iso_world* world) {
  constexpr const char* kCall = "world_destroy";
  if (world == nullptr) return kOk;
  WorldObject* object = nullptr;
  const iso_status status = enter(world, kCall, Access::changes, object);
  if (status != kOk) return status;
  if (object->tape != nullptr) object->tape->let_go();
  close_cell(reinterpret_cast<Cell*>(world));
  let_go_of(object);
  return kOk;
}

iso_status iso_world_get_scalar(const iso_world* world, iso_scalar* out) {
  WorldObject* object = nullptr;
  const iso_status status = enter(world, "world_get_scalar", Access::reads, object);
  if (status != kOk) return status;
  ISO_C_REQUIRE("world_get_scalar", out);
  *out = static_cast<iso_scalar>(object->scalar);
  return kOk;
}
uint64_t iso_world_tick(const iso_world* world) {
  std::uint64_t tick = 0;
  in_any_world(world, "world_tick", Access::reads, [&](auto& of) {
    tick = of.world.tick();
    return kOk;
  });
  return tick;
}
uint64_t iso_world_hash(const iso_world* world) {
  std::uint64_t hash = 0;
  in_any_world(world, "world_hash", Access::reads, [&](auto& of) {
    hash = of.world.hash();
    return kOk;
  });
  return hash;
}

iso_status iso_world_step(iso_world* world, iso_step_report* report) {
  constexpr const char* kCall = "world_step";
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    if (report != nullptr) {  // before anything happens
      const iso_status writable = put_sized(kCall, report, StepReport{});
      if (writable != kOk) return writable;
    }
    const Inside inside(of, WorldObject::kSteps);
    const StepReport happened = of.world.step();
    return report == nullptr ? kOk : put_sized(kCall, report, happened);
  });
}

iso_status iso_world_get_counts(const iso_world* world, iso_world_counts* out) {
  return in_any_world(world, "world_get_counts", Access::reads,
                      [&](auto& of) { return put_sized("world_get_counts", out, of.world.counts()); });
}
iso_status iso_world_bodies(const iso_world* world, iso_body* out, size_t room, size_t* count) {
  return in_any_world(world, "world_bodies", Access::reads,
                      [&](auto& of) { return put_ids("world_bodies", of.world.bodies(), out, room, count); });
}
iso_status iso_world_joints(const iso_world* world, iso_joint* out, size_t room, size_t* count) {
  return in_any_world(world, "world_joints", Access::reads,
                      [&](auto& of) { return put_ids("world_joints", of.world.joints(), out, room, count); });
}

iso_status iso_world_use_simd(iso_world* world, iso_simd simd) {
  constexpr const char* kCall = "world_use_simd";
  if (simd >= Enumerators<Simd>::kCount) return refuse(ISO_BAD_ENUM, kCall, "simd");
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    const bool has = of.world.use_simd(static_cast<Simd>(simd));
    return has ? kOk : refuse(kMisused, kCall, "simd", "lanes that this processor and build have");
  });
}
const char* iso_world_simd_name(const iso_world* world) {
  const char* name = nullptr;
  in_any_world(world, "world_simd_name", Access::reads, [&](auto& of) {
    name = of.world.simd_name();
    return kOk;
  });
  return name;
}
iso_status iso_world_use_broad_phase(iso_world* world, iso_broad_phase name) {
  constexpr const char* kCall = "world_use_broad_phase";
  if (name >= Enumerators<BroadPhaseName>::kCount) return refuse(ISO_BAD_ENUM, kCall, "name");
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    const auto structure = static_cast<BroadPhaseName>(name);
    const char* const instead = expected_instead_of(structure);
    if (instead != nullptr) return refuse(kMisused, kCall, "name", instead);
    const bool has = of.world.use_broad_phase(structure);
    return has ? kOk : refuse(kMisused, kCall, "name", "a structure that this world has");
  });
}
iso_status iso_world_get_broad_phase(const iso_world* world, iso_broad_phase* out) {
  return in_any_world(world, "world_get_broad_phase", Access::reads, [&](auto& of) {
    ISO_C_REQUIRE("world_get_broad_phase", out);
    *out = static_cast<iso_broad_phase>(of.world.broad_phase());
    return kOk;
  });
}
iso_status iso_world_use_threads(iso_world* world, iso_run run, void* user, int32_t threads) {
  constexpr const char* kCall = "world_use_threads";
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    if (run != nullptr && threads < 1) return refuse(kMisused, kCall, "threads", "1 or more");
    of.world.use_threads(run == nullptr ? TaskRunner{} : TaskRunner{run, user, threads});
    return kOk;
  });
}

iso_status iso_world_fault(const iso_world* world, iso_fault_report* out) {
  return in_any_world(world, "world_fault", Access::reads,
                      [&](auto& of) { return put_sized("world_fault", out, told(of.world.fault())); });
}
iso_status iso_world_first_fault(const iso_world* world, iso_fault_report* out) {
  return in_any_world(world, "world_first_fault", Access::reads,
                      [&](auto& of) { return put_sized("world_first_fault", out, told(of.world.first_fault())); });
}
iso_status iso_world_forget_faults(iso_world* world) {
  return in_any_world(world, "world_forget_faults", Access::changes, [&](auto& of) {
    of.world.forget_faults();
    return kOk;
  });
}
iso_status iso_world_fault_text(const iso_world* world, char* text, size_t* size) {
  return in_any_world(world, "world_fault_text", Access::reads, [&](auto& of) {
    const FaultReport& fault = of.world.fault();
    return copy_text("world_fault_text", fault == Fault::none ? "" : describe(fault).c_str(), text, size);
  });
}

#define ISO_WORLDS(P, S)                                                                     \
  iso_status iso_##P##_world_create(const iso_##P##_settings* settings, iso_world** out) {   \
    return world_create<S>(settings, out);                                                   \
  }                                                                                          \
  iso_status iso_##P##_world_get_settings(const iso_world* world, iso_##P##_settings* out) { \
    return get_settings<S>(world, out);                                                      \
  }                                                                                          \
  iso_status iso_##P##_world_set_gravity(iso_world* world, const iso_##P##_vec3* gravity) {  \
    return set_gravity<S>(world, gravity);                                                   \
  }
ISO_C_FAMILIES(ISO_WORLDS)
