// A host's tenure: its lease, what is final, and when it ends.
// SPDX-License-Identifier: MIT
#include "isostep/session/agreement/tenure.hpp"

namespace isostep {
namespace {

/// [us] beyond the patience of the others, in which who was silent may be heard again.
constexpr Time kDeposed = kSecond;

}  // namespace

void Tenure::begin(std::uint32_t term, Time patience, Frame start, Frame final_end, Time now) {
  *this = Tenure{};
  term_ = term;
  patience_ = patience;
  start_ = start;
  final_end_ = final_end;
  backed_at_ = turn_at_ = now;
}

std::uint64_t Tenure::group_with(const Roster& roster, std::span<const Follower> followers, Frame end) const {
  std::uint64_t group = std::uint64_t{1} << roster.host;
  for (std::size_t m = 0; m < followers.size(); ++m) {
    if (m != roster.host && followers[m].has >= end && followers[m].heard != 0) group |= std::uint64_t{1} << m;
  }
  return group;
}

bool Tenure::may_go_on_to_next(const Roster& roster, std::uint64_t enrolled,
                               std::span<const Follower> followers) const {
  return is_backed_ && roster.is_majority(enrolled & group_with(roster, followers, final_end_));
}

Tenure::Duty Tenure::turn(const Roster& roster, std::span<const Follower> followers, Frame own_end, Time now) {
  const Time gap = now - turn_at_;
  turn_at_ = now;
  if (roster.version == 0) {  // nobody knows whom to ask without us
    is_backed_ = true;
    backed_at_ = now;
    if (own_end > final_end_) final_end_ = own_end;
    return Duty::serves;
  }
  std::uint64_t present = std::uint64_t{1} << roster.host, over = 0;
  for (std::size_t m = 0; m < followers.size(); ++m) {
    const std::uint64_t bit = std::uint64_t{1} << m;
    if (followers[m].is_over) over |= bit;
    else if (followers[m].heard != 0 && now - followers[m].heard <= lease()) present |= bit;
  }
  const bool can_others = roster.is_majority(roster.voters() & ~(std::uint64_t{1} << roster.host));
  is_backed_ = roster.is_majority(present);
  // Who slept for longer than its lease does not know what was decided meanwhile.
  if (gap > lease() && can_others) return Duty::steps_down;
  if (is_backed_) {
    backed_at_ = now;
    // As far as a majority is: what one of them has beyond that may still be otherwise. Inputs of hosts before count
    // only together with ours: see Ongaro, Ousterhout 2014, sec. 5.4.2.
    const auto try_end = [&](Frame end) {
      const bool is_further = end > final_end_ && end >= start_ && end <= own_end;
      if (is_further && roster.is_majority(group_with(roster, followers, end))) final_end_ = end;
    };
    try_end(own_end);
    for (std::size_t m = 0; m < followers.size(); ++m) try_end(followers[m].has);
    return Duty::serves;
  }
  if ((roster.voters() & ~(present | over)) == 0) return Duty::reforms;
  return now - backed_at_ > patience_ + kDeposed ? Duty::steps_down : Duty::stands;
}

}  // namespace isostep
