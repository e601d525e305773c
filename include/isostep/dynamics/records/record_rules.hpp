// RecordRules: what a kind of record says of itself beside its fields, in the kind's own file.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "isostep/core/fault.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/body.hpp"
#include "isostep/dynamics/checks.hpp"
#include "isostep/dynamics/joints/joint_record.hpp"
#include "isostep/dynamics/settings.hpp"
#include "isostep/geometry/shape.hpp"

// Each kind specialises RecordRules<Record>, from RecordDefaults<S>, with
//   fault(record)            what its numbers must be; has no default
//   bodies(record), joints(record)   constexpr: names its members that are BodyId and JointId; it goes with them
//   fault_at(record, place)  what the bodies and joints that it names must be like
//   only_one(record), key(record)    two records of a kind may not have one key; what is said of the second
//   kNoCarrier               the first body of one record may not be the second of another; what is said of the two
//   kWakes, kTies, kBears    see RecordDefaults
//   kActs                    what it does in a sub-step, with the functions that Acts names; has no default either
//   draw(record, random)     what random worlds of the tests make of it; else its values follow from its fields
// Commands, the validator of foreign states, sleep and random worlds ask these. Rules that are missing or contradict
// the record do not compile: rule_checks.hpp.

namespace isostep {

/// Returns one key for the pairs (a, b) and (b, a).
ISO_INLINE constexpr std::uint64_t kinds_key(std::uint32_t a, std::uint32_t b) {
  return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
}

}  // namespace isostep

namespace isostep::detail {

/// The bodies that wake when a record is added, changed or removed.
enum class Wakes {
  none,      // it only tells
  named,     // those that it names, and the bodies of its joints
  touching,  // those, and what touches them: it acts on it
  all        // it acts on more than it names
};

/// The effects of a kind on bodies in a sub-step. Its rules have the functions that its enumerator names and no others,
/// or RecordStore does not compile (rule_checks.hpp). They are `template <class Forces> static void`, where Forces is
/// RecordForces<S> (systems/forces/record_forces.hpp): a parameter, since that is a layer above a kind's file. A kind
/// that slows has a priority, by which its records are asked: the highest first.
enum class Acts {
  not_here,            // it only tells, or other systems read it
  pushes,              // act(record, Forces&): whatever else acts
  resists,             // resist(record, Forces&): what all that pushes leads to, on a part of each body that it names
  pushes_and_resists,  // both; of bodies that it does not name its act counts those that it resists
  slows                // slow(record, Forces&): rates at which bodies fade, solved once a body, after what resists
};
ISO_INLINE constexpr bool pushes(Acts acts) { return acts == Acts::pushes || acts == Acts::pushes_and_resists; }
ISO_INLINE constexpr bool resists(Acts acts) { return acts == Acts::resists || acts == Acts::pushes_and_resists; }

enum class MustBe { any, dynamic, kinematic };
/// A body that a record names: its field, whether that may be null, the type that the body must have, and the point on
/// it where the force acts.
template <class S> struct NamedBody {
  BodyId body;
  const char* field;
  bool may_be_null;
  MustBe must_be;
  Vec3<S> point;  // [m] body frame
  const char* point_field;
};
template <class S> struct NamedBodies {
  NamedBody<S> all[2];
  int count;
};
/// Names the body of a record that is about the whole body.
template <class S> ISO_INLINE constexpr NamedBodies<S> named_body(BodyId body, MustBe must_be) {
  return {{{body, "body", false, must_be, Vec3<S>::zero(), ""}, {}}, 1};
}
/// Names the dynamic body of a record that acts at a point.
template <class S> ISO_INLINE constexpr NamedBodies<S> named_point(BodyId body, Vec3<S> point, const char* field) {
  return {{{body, "body", false, MustBe::dynamic, point, field}, {}}, 1};
}
ISO_INLINE constexpr bool is_as_asked(BodyType type, MustBe must_be) {
  if (must_be == MustBe::any) return true;
  return type == (must_be == MustBe::dynamic ? BodyType::dynamic : BodyType::kinematic);
}
/// Returns true if a force of the record acts too far from the centre of mass of the body that it names. A record
/// without a point is about the whole body.
template <class S> bool overreaches(const BodyProperties<S>& body, const NamedBody<S>& named) {
  return *named.point_field != 0 && overreaches(body.kappa, body.principal, named.point - body.local_centre);
}
/// The joints that a record names: the first `count`. A third one may be null.
struct NamedJoints {
  JointId all[3] = {};
  int count = 0;

  ISO_INLINE constexpr const char* field(int i) const {
    constexpr const char* kFields[] = {"joint_a", "joint_b", "joint_c"};
    return count == 1 ? "joint" : kFields[i];
  }
  ISO_INLINE bool may_be_null(int i) const { return i == 2; }
};

/// A joint that a record names, as the world has it.
template <class S> struct JointSeen {
  const JointProperties<S>* properties = nullptr;  // null: the record names none
  bool has_coordinate = false;                     // that motors drive and couplings tie
  JointMeasure measure = JointMeasure::angle;      // of that coordinate
};
/// The bodies and joints that a record names, as the world has them; null for none. record_place.hpp finds them.
template <class S> struct RecordPlace {
  const Settings<S>& settings;
  const BodyProperties<S>* bodies[2];
  std::span<const Child<S>> parts;  // of the shape of the first body
  JointSeen<S> joints[3];
};

/// The key of a record. Two records of a kind must not have one key.
struct RecordKey {
  std::uint64_t first = 0, second = 0;
  friend constexpr bool operator==(const RecordKey&, const RecordKey&) = default;
};
/// The texts that refuse a second one.
struct OnlyOne {
  const char *field, *expected;
};
inline constexpr OnlyOne kOneABody = {"body", "a body that has no record yet"};
inline constexpr OnlyOne kOneAJoint = {"joint", "a joint that has no record yet"};
inline constexpr OnlyOne kOnePairOfKinds = {"kind_b", "a pair of kinds that has no record yet"};

template <class Record> struct RecordRules;

template <class S> struct RecordDefaults {
  using Scalar = S;
  static constexpr Wakes kWakes = Wakes::named;
  static constexpr bool kTies = false;   // bodies that it names sleep and wake together
  static constexpr bool kBears = false;  // it holds bodies up or back, and ends where they come to rest
  static constexpr bool kSeesOthers = false;  // a step asks for bodies that it neither names nor touches
  template <class Record> static ISO_INLINE FaultReport fault_at(const Record&, const RecordPlace<S>&) { return {}; }
};

/// Returns the bodies and joints that a record names.
template <class Record> ISO_INLINE auto bodies_of(const Record& record) {
  using Rules = RecordRules<Record>;
  if constexpr (requires { Rules::bodies(record); }) return Rules::bodies(record);
  else return NamedBodies<typename Rules::Scalar>{{}, 0};
}
template <class Record> ISO_INLINE BodyId first_body_of(const Record& record) { return bodies_of(record).all[0].body; }
template <class Record> ISO_INLINE BodyId second_body_of(const Record& record) { return bodies_of(record).all[1].body; }
template <class Record> ISO_INLINE NamedJoints joints_of(const Record& record) {
  using Rules = RecordRules<Record>;
  if constexpr (requires { Rules::joints(record); }) return Rules::joints(record);
  else return {};
}

// ---- what kinds ask of their numbers

inline constexpr char kZeroOrMore[] = "0 or more", kPart[] = "0 to 1", kInput[] = "-1 to 1";
inline constexpr char kLeastSize[] = "Limits::minimum_size() or more", kDirection[] = "a vector of length 1";

template <class S> FaultReport fault_of_pose(const Pose<S>& pose) {
  return Checklist()
      .also(fault_of_place(pose.position, "pose.position"))
      .proper(is_unit<S>(pose.orientation), "pose.orientation", kUnitLength)
      .report();
}
/// Checks the region of a zone of any kind.
template <class Zone> FaultReport fault_of_region(const Zone& z) {
  using S = decltype(z.half.x);
  return Checklist()
      .proper(z.shape <= decltype(z.shape)::box, "shape", "one of ZoneShape")
      .also(fault_of_pose(z.pose))
      .finite(z.half, "half")
      .in_range(within(z.half, Limits<S>::position()), "half", "0 to Limits::position()")
      .proper(S(0) <= z.half.x && S(0) <= z.half.y && S(0) <= z.half.z, "half", "0 to Limits::position()")
      .report();
}

/// Adds checks of single numbers to a list.
template <class S> struct NumberChecks {
  Checklist list;

  void not_negative(S x, const char* field) { list.finite(x, field).proper(S(0) <= x, field, kZeroOrMore); }
  void part(S x, const char* field) { list.finite(x, field).proper(S(0) <= x && x <= S(1), field, kPart); }
  void input(S x, const char* field) { list.finite(x, field).proper(within(x, S(1)), field, kInput); }
  void size(S x, const char* field) {
    list.finite(x, field)
        .in_range(x <= Limits<S>::extent(), field, "up to Limits::extent()")
        .proper(Limits<S>::minimum_size() <= x, field, kLeastSize);
  }
  void grip(S x, const char* field) {
    list.finite(x, field).in_range(x <= kMaxFriction<S>, field, "0 to 16").proper(S(0) <= x, field, "0 to 16");
  }
  void size_of_slip(S x, const char* field) {
    list.finite(x, field).in_range(x <= S(4), field, "2^-10 to 4").proper(S(0x1p-10) <= x, field, "2^-10 to 4");
  }
  void direction(const Vec3<Unit<S>>& v, const char* field) { list.proper(is_direction<S>(v), field, kDirection); }
};

}  // namespace isostep::detail
