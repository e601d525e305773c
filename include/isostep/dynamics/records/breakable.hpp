// Breakable: a body that a hard enough contact breaks.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "isostep/core/fields.hpp"
#include "isostep/core/id.hpp"
#include "isostep/dynamics/records/record_rules.hpp"
#include "isostep/math/vec3.hpp"

namespace isostep {

using BreakableId = Id<struct BreakableTag>;

/// A pattern of fracture_pattern.hpp, with parameters derived from most_pieces.
enum class BreakPattern : std::uint32_t { eight_boxes, grain, radial, voronoi };

/// The words for it, in scene files and in C.
inline constexpr const char* kBreakPatternNames[] = {"eight_boxes", "grain", "radial", "voronoi"};
ISO_INLINE constexpr std::span<const char* const> words_of(BreakPattern) { return kBreakPatternNames; }

/// A dynamic body of one box or hull that breaks. If in a step the contacts with another body give it more than
/// break_impulse, summed along their normals, the step marks it by a Blow and reports it in events().broke.
/// break_bodies(world) (fracture/breaking.hpp) then replaces marked bodies by pieces, with commands, so that this is
/// recorded and rolled back. The mark is state: a loaded snapshot has it too. Pieces are breakable in turn, with
/// `depth` counted down, and each breaks at the same change of speed.
template <class S> struct Breakable {
  BodyId body = {};
  S break_impulse = S(1);  // [kg m/s]
  BreakPattern pattern = BreakPattern::eight_boxes;
  std::uint32_t most_pieces = 8;  // 2 to 256; of eight_boxes 8 or more
  std::uint32_t depth = 1;        // how often: 1: its pieces do not break; 0: it does not, but may expire
  Vec3<Unit<S>> grain = {Unit<S>(0), Unit<S>(1), Unit<S>(0)};  // [1] of wood, in the shape's frame: unit length
  std::uint64_t seed = 0;
  S small_mass = S(0);         // [kg] pieces lighter than that are gone
  std::uint32_t lifetime = 0;  // [steps] after so long; 0: all stay
  std::uint64_t expires = 0;   // [steps] World::tick() from which break_bodies() takes it away; 0: never
  bool owns_shape = false;     // break_bodies() removes the shape along with it: pieces have shapes of their own

  ISO_FIELDS(body, break_impulse, pattern, most_pieces, depth, grain, seed, small_mass, lifetime, expires, owns_shape)
};

/// The blow that breaks a body. The step writes it after a hard contact, or the game sets it as an input.
template <class S> struct Blow {
  S impulse = S(0);                                                // [kg m/s] 0: whole
  Vec3<S> point = {S(0), S(0), S(0)};                              // [m] body frame
  Vec3<Unit<S>> direction = {Unit<S>(0), Unit<S>(0), Unit<S>(0)};  // [1] into the body, body frame

  ISO_FIELDS(impulse, point, direction)
};

}  // namespace isostep

namespace isostep::detail {

template <class S> struct RecordRules<Breakable<S>> : RecordDefaults<S> {
  static constexpr Acts kActs = Acts::not_here;
  static FaultReport fault(const Breakable<S>& b) {
    constexpr std::uint32_t kMostPieces = 256, kMostDepth = 16;
    const bool boxes = b.pattern == BreakPattern::eight_boxes;
    return Checklist()
        .finite(b.break_impulse, "break_impulse")
        .finite(b.small_mass, "small_mass")
        .proper(b.pattern <= BreakPattern::voronoi, "pattern", "one of BreakPattern")
        .proper((boxes ? 8u : 2u) <= b.most_pieces && b.most_pieces <= kMostPieces, "most_pieces",
                "2 to 256, of eight_boxes 8 or more")
        .proper(b.depth <= kMostDepth, "depth", "0 to 16")
        .proper(is_direction<S>(b.grain), "grain", "a vector of length 1")
        .proper(S(0) <= b.break_impulse, "break_impulse", kZeroOrMore)
        .proper(S(0) <= b.small_mass, "small_mass", kZeroOrMore)
        .report();
  }
  static FaultReport fault(const Blow<S>& b) {
    return Checklist()
        .finite(b.impulse, "impulse")
        .also(fault_of_place(b.point, "point"))
        .proper(S(0) <= b.impulse, "impulse", kZeroOrMore)
        .proper(b.direction == Vec3<Unit<S>>::zero() || is_direction<S>(b.direction), "direction",
                "a vector of length 1, or 0")
        .report();
  }
  static constexpr NamedBodies<S> bodies(const Breakable<S>& b) { return named_body<S>(b.body, MustBe::dynamic); }
  static constexpr OnlyOne only_one(const Breakable<S>&) { return kOneABody; }
  static RecordKey key(const Breakable<S>& r) { return {r.body.slot}; }
  template <class Random> static void draw(Breakable<S>& b, Random& random) {
    b.body = random.body();
    b.break_impulse = random.in(0.5, 8, random.mass(b.body));
    b.pattern = static_cast<BreakPattern>(random.below(4));
    b.most_pieces = 8 + random.below(5);
    b.depth = 1 + random.below(2);
    b.seed = random.below(1u << 16);
    b.small_mass = random.in(0, 1);
    b.lifetime = random.below(60);
  }
};

}  // namespace isostep::detail
