// FurthestWay: the judge of scenes in which nothing should move.
// SPDX-License-Identifier: MIT
#pragma once

#include "judges.hpp"

namespace isostep::scenes {

/// The furthest that any body came from where it was at `from` [s], in units of so many metres.
class FurthestWay : public Judge {
 public:
  FurthestWay(double from, double unit) : from_(from), unit_(unit) {}
  void see(const Sight& sight) override {
    if (sight.time < from_) return;
    if (settled_.bodies.empty()) settled_ = sight;
    for (std::size_t i = 0; i < settled_.bodies.size(); ++i) {
      worst_ = worse(worst_, length_of(way_of(settled_, sight, i)) / unit_);
    }
  }
  double figure() const override { return worst_; }

 private:
  double from_, unit_;
  Sight settled_;
  double worst_ = 0;
};

}  // namespace isostep::scenes
