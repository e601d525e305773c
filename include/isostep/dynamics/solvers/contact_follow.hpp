// A prepared contact follows a body that turns fast: its rows turn bodies by their inertia of now, and begin anew.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/solvers/contact_lane.hpp"

namespace isostep {

/// A contact that follows a body which turns fast. Contacts are prepared once a step. If a body turns by a radian in
/// it, they use an inertia about axes that have long turned: a rod is 600 times easier to turn about its length than
/// across. Pushed along one and turned about the other it gains energy out of nothing, in one step a hundred thousand
/// times its own. Rows with the present inertia (turn_by) that start each sub-step from zero impulse only take energy,
/// at any arms: a row pushes no more once nothing approaches along it. The push against overlaps is bounded elsewhere.
/// Arms and normals stay: the place of a contact does not turn with the body that passes by.
template <class S> class FollowedContact : public ContactLane<S> {
  using Lane = ContactLane<S>;
  using typename Lane::Normal, typename Lane::Row, typename Lane::V;

 public:
  ISO_INLINE FollowedContact(unsigned char* words, std::size_t width, std::int32_t points, bool rolling)
      : Lane(words, width, points, rolling) {}

  /// Forgets the warm start: old impulses refer to other axes, and one pass would not take all of them back.
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
