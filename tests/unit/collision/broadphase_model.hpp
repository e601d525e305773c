// Boxes by slot beside a structure and its pairs: what brute force says of them.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/collision/broadphase/tree.hpp"
#include "isostep/core/random.hpp"
#include "isostep/geometry/limits.hpp"

namespace isostep::test {

using BroadphaseScalars = testing::Types<float, double, Q16_16, Q32_32>;

/// A whole number of quarters, so that every scalar holds the same boxes and boxes often touch exactly.
template <class S> S quarters(Pcg32& random, int low, int high) {
  return S(random_between(random, low, high)) * S(0.25);
}
template <class S> Vec3<S> random_point(Pcg32& random, int reach) {
  const S x = quarters<S>(random, -reach, reach);
  const S y = quarters<S>(random, -reach, reach);
  const S z = quarters<S>(random, -reach, reach);
  return {x, y, z};
}
template <class S> Aabb<S> random_box(Pcg32& random, int reach) {
  const Vec3<S> low = random_point<S>(random, reach);
  const S x = quarters<S>(random, 0, 6);
  const S y = quarters<S>(random, 0, 6);
  const S z = quarters<S>(random, 0, 6);
  return {low, low + Vec3<S>{x, y, z}};
}

/// Boxes by slot, and what a filter says of each.
template <class S> struct Model {
  struct Slot {
    bool present = false;
    bool movable = true;
    std::uint32_t group = 0;
    Aabb<S> box{};
  };
  std::vector<Slot> slots;

  bool may_collide(std::uint32_t a, std::uint32_t b) const {
    if (!slots[a].movable && !slots[b].movable) return false;
    return slots[a].group == 0 || slots[a].group != slots[b].group;
  }
  std::vector<std::uint64_t> brute_force() const {
    std::vector<std::uint64_t> keys;
    for (std::uint32_t a = 0; a < slots.size(); ++a) {
      for (std::uint32_t b = a + 1; b < slots.size(); ++b) {
        if (!slots[a].present || !slots[b].present || !may_collide(a, b)) continue;
        if (overlap(slots[a].box, slots[b].box)) keys.push_back(std::uint64_t{a} << 32 | b);
      }
    }
    return keys;
  }
};
template <class S> struct Filter {
  const Model<S>* model;
  bool operator()(std::uint32_t a, std::uint32_t b) const {
    EXPECT_LT(a, b);
    return model->may_collide(a, b);
  }
};
struct Everything {
  bool operator()(std::uint32_t, std::uint32_t) const { return true; }
};

struct Collect {
  std::vector<std::uint32_t>* slots;
  bool operator()(std::uint32_t slot) const {
    slots->push_back(slot);
    return true;
  }
};
template <class S> std::vector<std::uint32_t> found(const AabbTree<S>& tree, const Aabb<S>& box) {
  std::vector<std::uint32_t> slots;
  tree.query(box, Collect{&slots});
  std::sort(slots.begin(), slots.end());
  return slots;
}
template <class S> std::vector<std::uint32_t> found(const Model<S>& model, const Aabb<S>& box) {
  std::vector<std::uint32_t> slots;
  for (std::uint32_t i = 0; i < model.slots.size(); ++i) {
    if (model.slots[i].present && overlap(model.slots[i].box, box)) slots.push_back(i);
  }
  return slots;
}

/// The fraction at which a segment enters a box grown by `half`, by slabs in double, or 2 for a miss.
template <class S> double entry(const Sweep<S>& sweep, const Aabb<S>& box) {
  double from = 0;
  double to = to_double(sweep.max_fraction);
  for (int i = 0; i < 3; ++i) {
    const double o = to_double(sweep.origin[i]);
    const double d = to_double(sweep.displacement[i]);
    const double low = to_double(box.low[i]) - to_double(sweep.half[i]);
    const double high = to_double(box.high[i]) + to_double(sweep.half[i]);
    if (d == 0) {
      if (o < low || o > high) return 2;
      continue;
    }
    from = std::max(from, std::min((low - o) / d, (high - o) / d));
    to = std::min(to, std::max((low - o) / d, (high - o) / d));
  }
  return from <= to ? from : 2;
}

template <class S> struct AllTouched {
  std::vector<std::uint32_t>* slots;
  Unit<S> operator()(std::uint32_t slot, Unit<S> fraction) const {
    slots->push_back(slot);
    return fraction;
  }
};
template <class S> struct Nearest {
  const Model<S>* model;
  const Sweep<S>* sweep;
  double* best;
  int* visits;
  Unit<S> operator()(std::uint32_t slot, Unit<S> fraction) const {
    ++*visits;
    const double at = entry(*sweep, model->slots[slot].box);
    if (at >= *best) return fraction;
    *best = at;
    return from_double<Unit<S>>(at);
  }
};

/// One random insertion, removal, move or change of filter, done to model, tree and pairs alike.
template <class S> void churn(Pcg32& random, Model<S>& model, AabbTree<S>& tree, PairSet<S>& pairs, int reach) {
  const std::uint32_t slot = random_below(random, static_cast<std::uint32_t>(model.slots.size()));
  typename Model<S>::Slot& s = model.slots[slot];
  const std::uint32_t what = random_below(random, 10);
  if (!s.present) {
    s = {true, what < 7, what % 3, random_box<S>(random, reach)};
    tree.insert(slot, s.box);
    pairs.mark_moved(slot);
  } else if (what < 2) {
    s.present = false;
    tree.remove(slot);
    pairs.mark_removed(slot);
  } else if (what < 4) {
    s.group = random_below(random, 3);
    s.movable = what == 2;
    pairs.mark_moved(slot);
  } else {
    const Vec3<S> by = random_point<S>(random, what == 9 ? 30 : 2);  // a nudge, or a leap
    s.box = what == 8 ? random_box<S>(random, reach) : Aabb<S>{s.box.low + by, s.box.high + by};
    tree.update(slot, s.box);
    pairs.mark_moved(slot);
  }
}

}  // namespace isostep::test
