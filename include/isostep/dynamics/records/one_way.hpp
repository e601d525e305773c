// OneWay: a body that can be passed from one side: the platform of a game of jumps, a valve, a cat flap.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/core/lower_bound.hpp"
#include "isostep/core/registry.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/mat3.hpp"
#include "isostep/math/quat.hpp"

namespace isostep {

using OneWayId = Id<struct OneWayTag>;

/// A body that only stops bodies that come against the axis, from the side that it points to. Others pass. A pair is
/// judged as it meets: it is solid if a contact's normal, outward, has at least that cosine to the axis and the other
/// body does not leave. A solid pair stays solid while it has contacts. A pair that overlaps otherwise becomes a Ghost,
/// and is judged again once it has been apart. A pair that is only near has no contact yet. Two such bodies must both
/// stop each other. A character stands on it if its lowest point is above the body, passes it from below, and drops
/// through by a Ghost. One record a body.
/// Source:  Rapier's function for one-way platforms, as data.
template <class S> struct OneWay {
  BodyId body = {};
  Vec3<Unit<S>> axis = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};  // [1] body frame, unit length
  S least_cosine = S(0.5);                                    // [1] of the normal to the axis: 60 degrees

  ISO_FIELDS(body, axis, least_cosine)
};

/// A OneWay record at the start of a step.
template <class S> struct Way {
  std::uint32_t body;    // slot
  Vec3<Unit<S>> axis;    // [1] world
  Unit<S> least_cosine;  // [1]

  /// [m/s] A slower body lies on it and jitters.
  static ISO_INLINE constexpr Velocity<S> slack() { return Velocity<S>(0.0625); }
  /// Returns true if a body with that velocity [m/s] against this one leaves it, or passes it from below.
  ISO_INLINE bool lets_out(Vec3<Velocity<S>> velocity) const {
    return slack() < saturate_to<Velocity<S>>(dot_sum(velocity, axis));
  }
};

/// Holds all OneWay records of a step, ascending by the body's slot. Keeps nothing from step to step but memory.
template <class S> class Ways {
 public:
  /// orientation_of(slot) returns the orientation of a body.
  template <class OrientationOf>
  ISO_INLINE void update(const Registry<OneWay<S>, OneWayId>& records, const OrientationOf& orientation_of) {
    all_.clear();
    if (records.all().empty()) return;
    for (std::uint32_t slot = 0; slot < records.all().size(); ++slot) {
      const OneWay<S>& record = records.all()[slot];
      if (!records.is_taken(slot)) continue;
      const Mat3<Unit<S>> turn = to_matrix(orientation_of(record.body.slot));
      all_.push_back({record.body.slot, turn * record.axis, convert<Unit<S>>(record.least_cosine)});
    }
    scratch_.resize(all_.size());
    stable_sort(all_.data(), scratch_.data(), static_cast<std::uint32_t>(all_.size()), BySlot{});
  }
  ISO_INLINE bool empty() const { return all_.empty(); }
  /// Returns null if the body is not one-way.
  ISO_INLINE const Way<S>* find(std::uint32_t body) const {
    const std::size_t at =
        lower_bound(all_.size(), [&](std::size_t i) ISO_INLINE_LAMBDA { return all_[i].body < body; });
    return at < all_.size() && all_[at].body == body ? &all_[at] : nullptr;
  }

 private:
  struct BySlot {
    ISO_INLINE std::uint64_t operator()(const Way<S>& way) const { return way.body; }
  };
  std::vector<Way<S>> all_, scratch_;
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<OneWay<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::not_here;
  static constexpr Wakes kWakes = Wakes::touching;
  static FaultReport fault(const OneWay<S>& w) {
    return Checklist()
        .proper(is_direction<S>(w.axis), "axis", "a vector of length 1")
        .finite(w.least_cosine, "least_cosine")
        .proper(S(0) < w.least_cosine && w.least_cosine <= S(1), "least_cosine", "above 0, up to 1")
        .report();
  }
  static constexpr NamedBodies<S> bodies(const OneWay<S>& w) { return named_body<S>(w.body, MustBe::any); }
  static constexpr OnlyOne only_one(const OneWay<S>&) { return kOneABody; }
  static RecordKey key(const OneWay<S>& r) { return {r.body.slot}; }
  template <class Random> static void draw(OneWay<S>& w, Random& random) {
    w.body = random.mover();
    if (random.one_in(2)) w.axis = {Unit<S>(1), Unit<S>(0), Unit<S>(0)};
    w.least_cosine = random.in(0.25, 0.75);
  }
};

}  // namespace isostep::detail
