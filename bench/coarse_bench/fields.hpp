// Fields of boxes: so many, so dense, of one size or of many.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "isostep/core/random.hpp"
#include "isostep/math/aabb.hpp"

namespace isostep::bench {

struct Field {
  std::string name;
  int count;
  double neighbours;    // that a box of average size overlaps, about
  int doublings;        // of sizes, from the smallest: 0 is one size
  bool spreads_upward;  // or is a level's ground, 4 m high
};
/// The fields that games have: a crowd on a level, sparse and dense, things of all sizes, debris in the air.
inline std::vector<Field> fields_of(int count) {
  return {{"sparse level", count, 0.25, 0, false},
          {"dense level", count, 4, 0, false},
          {"all sizes", count, 2, 6, false},
          {"debris", count, 1, 1, true}};
}

/// Boxes of half a metre and more, on numbers that every scalar holds.
template <class S> std::vector<Aabb<S>> boxes_of(const Field& field, std::uint64_t seed) {
  Pcg32 random = Pcg32::seeded(seed);
  const double side = 0.5 * (1 << field.doublings / 2) + 0.25, volume = 8 * side * side * side;
  const double room = field.count * volume / field.neighbours;
  double reach = 1;  // [m] half an edge of the field
  while ((field.spreads_upward ? 8 * reach * reach * reach : 4 * reach * reach * 4) < room) reach *= 1.0625;
  const auto edge = static_cast<std::int32_t>(reach * 16);
  const std::int32_t high = field.spreads_upward ? edge : 32;
  std::vector<Aabb<S>> boxes;
  for (int i = 0; i < field.count; ++i) {
    const std::int32_t x = random_between(random, -edge, edge), y = random_between(random, -high, high);
    const Vec3<S> low = {S(x) / S(16), S(y) / S(16), S(random_between(random, -edge, edge)) / S(16)};
    const std::int32_t doubled = random_between(random, 0, field.doublings);
    const std::int32_t fewer = random_between(random, 0, field.doublings);  // small ones are more
    const S size = S(0.5) * S(1 << (doubled < fewer ? doubled : fewer));
    boxes.push_back({low, low + Vec3<S>{size, size, size}});
  }
  return boxes;
}

}  // namespace isostep::bench
