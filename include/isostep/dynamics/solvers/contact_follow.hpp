// A prepared contact follows a body that turns fast: its rows turn bodies by their inertia of now, and begin anew.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/contact_lane.hpp"

namespace isostep {

/// Contacts are prepared once a step. Where a body turns by a radian in it, they answer an impulse with an inertia
/// about axes that have long turned: a rod is 600 times easier to turn about its length than across, and pushed along
/// the one and turned about the other it gains energy out of nothing, in a step a hundred thousand times what it had.
/// Rows that answer with the inertia of now (turn_by) and begin each sub-step from nothing only take energy, whatever
/// their arms: a row pushes no more once nothing approaches along it. What presses overlaps apart is bounded elsewhere.
/// Arms and normals stay: the place of a contact does not turn with what passes by it.
template <class S> class FollowedContact : public ContactLane<S> {
  using Lane = ContactLane<S>;
  using typename Lane::Normal, typename Lane::Row, typename Lane::V;

 public:
  ISO_INLINE FollowedContact(unsigned char* words, std::size_t width, std::int32_t points, bool rolling)
      : Lane(words, width, points, rolling) {}

  /// Forgets the warm start: impulses of before met other axes, and one pass would not take all of them back.
  ISO_INLINE void forget_impulses() const {
    for (std::size_t p = 0; p < this->points(); ++p) {
      const std::size_t at = this->normal(p), total = at + offsetof(Normal, total_impulse);
      const V given = this->template get<V>(at + offsetof(Row, impulse));
      this->put(total, this->template get<V>(total) + given);
    }
    this->each_row([&](std::size_t at, std::size_t)
                       ISO_INLINE_LAMBDA { this->put(at + offsetof(Row, impulse), V(0)); });
  }
};

}  // namespace isostep
