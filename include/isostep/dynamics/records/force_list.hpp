// The closed list of forces that act from step to step, and all records that are registered with a world.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/registry.hpp"
#include "isostep/dynamics/records/aero_surface.hpp"
#include "isostep/dynamics/records/attractor.hpp"
#include "isostep/dynamics/records/body_spring.hpp"
#include "isostep/dynamics/records/buoyancy_point.hpp"
#include "isostep/dynamics/records/drag.hpp"
#include "isostep/dynamics/records/explosion.hpp"
#include "isostep/dynamics/records/force_zone.hpp"
#include "isostep/dynamics/records/record_list.hpp"
#include "isostep/dynamics/records/thruster.hpp"
#include "isostep/dynamics/records/water.hpp"

namespace isostep {

/// In the first word of a portable form, beside what names the world: there are records in it.
inline constexpr std::uint32_t kPortableForcesBit = 0x20000000u;
/// The same of those of ISO_FOR_EACH_NEWER_RECORD: a word of which kinds there are comes before them.
inline constexpr std::uint32_t kPortableNewerRecordsBit = 0x10000000u;

/// ISO_FOR_EACH_FORCE(R, S) expands R(name, Record, Id, S) for each kind, in the order in which they act. What resists
/// motion - drag, surfaces, the drag of water - acts after all others, for it asks what they are about to do. Every
/// kind has three commands, add_name, set_name and remove_name, and a registry in ForceRecords, whose name is the same
/// with an s. To add one: README.md.
#define ISO_FOR_EACH_FORCE(R, S)                 \
  R(force_zone, ForceZone<S>, ForceZoneId, S)    \
  R(attractor, Attractor<S>, AttractorId, S)     \
  R(body_spring, BodySpring<S>, BodySpringId, S) \
  R(thruster, Thruster<S>, ThrusterId, S)        \
  R(buoyancy, BuoyancyPoint<S>, BuoyancyId, S)   \
  R(explosion, Explosion<S>, ExplosionId, S)     \
  R(water, Water<S>, WaterId, S)                 \
  R(drag, BodyDrag<S>, DragId, S)                \
  R(aero_surface, AeroSurface<S>, AeroSurfaceId, S)

/// All records: those and what is no force, record_list.hpp.
#define ISO_FOR_EACH_RECORD(R, S) \
  ISO_FOR_EACH_FORCE(R, S)        \
  ISO_FOR_EACH_OTHER_RECORD(R, S) \
  ISO_FOR_EACH_NEWER_RECORD(R, S)

/// Of all kinds. Only commands change them: copies share them until one does.
template <class S> struct ForceRecords {
#define ISO_REGISTRY(name, Record, Id, S) Registry<Record, Id> name##s;
  ISO_FOR_EACH_RECORD(ISO_REGISTRY, S)
#undef ISO_REGISTRY

  // As the compiler makes them, but in one place: inlined into every command that changes records they are minutes of
  // compiling.
  ForceRecords();
  ForceRecords(const ForceRecords&);
  ~ForceRecords();
  // No weak functions in each of the files that use them.
  ISO_INLINE ForceRecords(ForceRecords&&) = default;
  ISO_INLINE ForceRecords& operator=(const ForceRecords&) = default;
  ISO_INLINE ForceRecords& operator=(ForceRecords&&) = default;

  /// visit("name", registry) in the order of the list.
  template <class Visitor, class Self> static ISO_INLINE void members(Visitor&& visit, Self&& self) {
#define ISO_VISIT(name, Record, Id, S) visit(#name "s", self.name##s);
    ISO_FOR_EACH_RECORD(ISO_VISIT, S)
#undef ISO_VISIT
  }
  /// The same of the forces alone.
  template <class Visitor, class Self> static ISO_INLINE void forces(Visitor&& visit, Self&& self) {
#define ISO_VISIT(name, Record, Id, S) visit(#name "s", self.name##s);
    ISO_FOR_EACH_FORCE(ISO_VISIT, S)
#undef ISO_VISIT
  }
  /// The same of all but the newer ones: in hashes and portable forms together, or not at all.
  template <class Visitor, class Self> static ISO_INLINE void first_members(Visitor&& visit, Self&& self) {
#define ISO_VISIT(name, Record, Id, S) visit(#name "s", self.name##s);
    ISO_FOR_EACH_FORCE(ISO_VISIT, S)
    ISO_FOR_EACH_OTHER_RECORD(ISO_VISIT, S)
#undef ISO_VISIT
  }
  /// Of the newer ones, the kinds whose bits are set: the first kind has the lowest.
  template <class Visitor, class Self>
  static ISO_INLINE void newer_members(std::uint32_t kinds, Visitor&& visit, Self&& self) {
#define ISO_VISIT(name, Record, Id, S)                   \
  if ((kinds & 1u) != 0) visit(#name "s", self.name##s); \
  kinds >>= 1;
    ISO_FOR_EACH_NEWER_RECORD(ISO_VISIT, S)
#undef ISO_VISIT
  }
#define ISO_COUNT(name, Record, Id, S) +1
  static constexpr std::uint32_t kNewerKinds = (1u << (0 ISO_FOR_EACH_NEWER_RECORD(ISO_COUNT, S))) - 1u;
#undef ISO_COUNT
  /// Bits of the kinds of which one was ever added.
  ISO_INLINE std::uint32_t newer_kinds() const {
    std::uint32_t kinds = 0, bit = 1;
#define ISO_BIT(name, Record, Id, S)                            \
  kinds |= name##s.slot_map().entries().size() == 0 ? 0u : bit; \
  bit <<= 1;
    ISO_FOR_EACH_NEWER_RECORD(ISO_BIT, S)
#undef ISO_BIT
    return kinds;
  }
  /// None of the first was ever added.
  ISO_INLINE bool untouched() const {
    bool none = true;
#define ISO_NONE(name, Record, Id, S) none = none && name##s.slot_map().entries().size() == 0;
    ISO_FOR_EACH_FORCE(ISO_NONE, S)
    ISO_FOR_EACH_OTHER_RECORD(ISO_NONE, S)
#undef ISO_NONE
    return none;
  }
  ISO_INLINE bool no_forces() const {
    bool none = true;
#define ISO_NONE(name, Record, Id, S) none = none && name##s.slot_map().entries().size() == 0;
    ISO_FOR_EACH_FORCE(ISO_NONE, S)
#undef ISO_NONE
    return none;
  }
};

namespace detail {
/// The registry of an id's type.
#define ISO_REGISTRY(name, Record, Id, S) \
  template <class Records> ISO_INLINE auto& registry_of(Records& records, Id) { return records.name##s; }
ISO_FOR_EACH_RECORD(ISO_REGISTRY, S)
#undef ISO_REGISTRY
/// The id of a kind of record.
template <class Record> struct ForceIdOf;
#define ISO_ID_OF(name, Record, Id, S) \
  template <class S> struct ForceIdOf<Record> { using Type = Id; };
ISO_FOR_EACH_RECORD(ISO_ID_OF, S)
#undef ISO_ID_OF

/// The bodies that a record names.
template <class Record> ISO_INLINE BodyId first_body_of(const Record& record) {
  if constexpr (requires { record.a; }) return record.a;
  else if constexpr (requires { record.body; }) return record.body;
  else if constexpr (requires { record.sensor; }) return record.sensor;
  else return {};
}
template <class Record> ISO_INLINE BodyId second_body_of(const Record& record) {
  if constexpr (requires { record.b; }) return record.b;
  else if constexpr (requires { record.on; }) return record.on;
  else return {};
}
/// The joints that a record names; null where it names fewer.
struct NamedJoints {
  JointId all[3];
};
template <class Record> ISO_INLINE NamedJoints joints_of(const Record& record) {
  if constexpr (requires { record.joint_a; }) return {{record.joint_a, record.joint_b, record.joint_c}};
  else if constexpr (requires { record.joint; }) return {{record.joint, {}, {}}};
  else return {};
}
}  // namespace detail

}  // namespace isostep
