// Records that are registered with a world: every kind is added, set, read and removed in one way.
// SPDX-License-Identifier: MIT
#include "isostep/fracture/breaking.hpp"
#include "objects.hpp"

using namespace isostep;
using namespace isostep::c;

namespace {

template <class S, class Record, class Id>
iso_status add_record(iso_world* world, const char* call, const void* from, iso_record* out) {
  return in_world<S>(world, call, Access::changes, [&](auto& of) {
    ISO_C_REQUIRE(call, out);
    Record record;
    const iso_status taken = take_sized(call, from, record);
    return taken != kOk ? taken : put_id<Id>(of.world.add(record), out);
  });
}
template <class S, class Record, class Id>
iso_status set_record(iso_world* world, const char* call, iso_record id, const void* from) {
  return in_world<S>(world, call, Access::changes, [&](auto& of) {
    Record record;
    const iso_status taken = take_sized(call, from, record);
    if (taken == kOk) of.world.set(id_of<Id>(id), record);
    return taken;
  });
}
template <class S, class Id> iso_status get_record(const iso_world* world, const char* call, iso_record id, void* out) {
  return in_world<S>(world, call, Access::reads, [&](auto& of) {
    const auto* const record = of.world.find(id_of<Id>(id));
    if (record == nullptr) return refuse({Fault::stale_id, call, "id", "a record of this world and kind"});
    return put_sized(call, out, *record);
  });
}
template <class S, class Input, class Id>
iso_status set_input(iso_world* world, const char* call, iso_record id, const void* from) {
  return in_world<S>(world, call, Access::changes, [&](auto& of) {
    Input input;
    const iso_status taken = take_sized(call, from, input);
    if (taken == kOk) of.world.set_input(id_of<Id>(id), input);
    return taken;
  });
}
template <class S> iso_status set_spin(iso_world* world, const char* call, iso_record wheel, S spin) {
  return in_world<S>(world, call, Access::changes, [&](auto& of) {
    of.world.set_spin(id_of<WheelId>(wheel), spin);
    return kOk;
  });
}
/// Hands out an input or a state that `find(world, id)` returns.
template <class S, class Id, class Find>
iso_status get_part(const iso_world* world, const char* call, iso_record id, void* out, const Find& find) {
  return in_world<S>(world, call, Access::reads, [&](auto& of) {
    const auto* const part = find(of.world, id_of<Id>(id));
    if (part == nullptr) return refuse({Fault::stale_id, call, "id", "a record of this world and kind"});
    return put_sized(call, out, *part);
  });
}
template <class Id> iso_status remove_record(iso_world* world, const char* call, iso_record id) {
  return in_any_world(world, call, Access::changes, [&](auto& of) {
    of.world.remove(id_of<Id>(id));
    return kOk;
  });
}

}  // namespace

#define ISO_REMOVE(name, Record, Id, S)                           \
  iso_status iso_remove_##name(iso_world* world, iso_record id) { \
    return remove_record<Id>(world, "remove_" #name, id);         \
  }
ISO_FOR_EACH_RECORD(ISO_REMOVE, unused)

#define ISO_RECORD(P, name, Record, Id, S)                                                             \
  iso_status iso_##P##_add_##name(iso_world* world, const iso_##P##_##name* record, iso_record* out) { \
    return add_record<S, Record, Id>(world, "add_" #name, record, out);                                \
  }                                                                                                    \
  iso_status iso_##P##_set_##name(iso_world* world, iso_record id, const iso_##P##_##name* record) {   \
    return set_record<S, Record, Id>(world, "set_" #name, id, record);                                 \
  }                                                                                                    \
  iso_status iso_##P##_get_##name(const iso_world* world, iso_record id, iso_##P##_##name* out) {      \
    return get_record<S, Id>(world, "get_" #name, id, out);                                            \
  }
#define ISO_INPUT(P, name, Input, Id, S)                                                                          \
  iso_status iso_##P##_set_##name##_input(iso_world* world, iso_record id, const iso_##P##_##name##_input* in) {  \
    return set_input<S, Input, Id>(world, "set_" #name "_input", id, in);                                         \
  }                                                                                                               \
  iso_status iso_##P##_get_##name##_input(const iso_world* world, iso_record id, iso_##P##_##name##_input* out) { \
    return get_part<S, Id>(world, "get_" #name "_input", id, out,                                                 \
                           [](const auto& of, Id record) { return of.input(record); });                           \
  }
#define ISO_STATE(P, name, State, Id, S)                                                                          \
  iso_status iso_##P##_get_##name##_state(const iso_world* world, iso_record id, iso_##P##_##name##_state* out) { \
    return get_part<S, Id>(world, "get_" #name "_state", id, out,                                                 \
                           [](const auto& of, Id record) { return of.state(record); });                           \
  }
#define ISO_FAMILY(P, S)                     \
  ISO_FOR_EACH_RECORD_WITH(ISO_RECORD, P, S) \
  ISO_FOR_EACH_INPUT_WITH(ISO_INPUT, P, S)   \
  ISO_FOR_EACH_RECORD_STATE_WITH(ISO_STATE, P, S)
ISO_C_FAMILIES(ISO_FAMILY)

#define ISO_NUMBERED(P, S, N)                                                       \
  iso_status iso_##P##_wheel_set_spin(iso_world* world, iso_record wheel, N spin) { \
    return set_spin<S>(world, "wheel_set_spin", wheel, same_bits<S>(spin));         \
  }
ISO_NUMBERED(f32, float, float)
ISO_NUMBERED(f64, double, double)
ISO_NUMBERED(q16, Q16_16, std::int32_t)
ISO_NUMBERED(q32, Q32_32, std::int64_t)
#undef ISO_FAMILY
#undef ISO_NUMBERED

iso_status iso_break_bodies(iso_world* world, uint32_t most, iso_break_report* report) {
  constexpr const char* kCall = "break_bodies";
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    if (report != nullptr) {
      const iso_status writable = put_sized(kCall, report, BreakReport{});
      if (writable != kOk) return writable;
    }
    const BreakReport happened = break_bodies(of.world, most);
    refusal_here().happened = false;  // a body that cannot be broken is told in the report
    return report == nullptr ? kOk : put_sized(kCall, report, happened);
  });
}
