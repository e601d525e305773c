// The judges that several trials share.
// SPDX-License-Identifier: MIT
#include "judges.hpp"

namespace isostep::scenes {

void Drift::compare(const Sight& start, const Sight& now) {
  double below = 0;  // [m] how far up the body below has come
  for (std::size_t i = 0; i < start.bodies.size(); ++i) {
    const Vec3<double> way = way_of(start, now, i);
    const bool fell = way.y - below < -0.5;
    below = way.y;
    const double aside = std::hypot(way.x, way.z);
    if (start.bodies[i].dynamic) worst_ = worse(worst_, fell || aside > 1 ? 1 : aside);
  }
}

void Displaced::compare(const Sight& start, const Sight& now) {
  double count = 0;
  for (std::size_t i = 0; i < start.bodies.size(); ++i) {
    const bool in_place = length_of(way_of(start, now, i)) <= limit_;
    if (start.bodies[i].dynamic && !in_place) ++count;
  }
  most_ = worse(most_, count);
}

}  // namespace isostep::scenes
