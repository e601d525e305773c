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
#define ISO_F32(name, Record, Id, S) ISO_RECORD(f32, name, Record, Id, S)
#define ISO_F64(name, Record, Id, S) ISO_RECORD(f64, name, Record, Id, S)
#define ISO_Q16(name, Record, Id, S) ISO_RECORD(q16, name, Record, Id, S)
#define ISO_Q32(name, Record, Id, S) ISO_RECORD(q32, name, Record, Id, S)
ISO_FOR_EACH_RECORD(ISO_F32, float)
ISO_FOR_EACH_RECORD(ISO_F64, double)
ISO_FOR_EACH_RECORD(ISO_Q16, Q16_16)
ISO_FOR_EACH_RECORD(ISO_Q32, Q32_32)

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
