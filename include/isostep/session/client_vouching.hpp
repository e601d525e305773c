// Vouching: a client's players may play once other machines have the states that it has.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/session/client_seats.hpp"

namespace isostep {

/// In: where our part of the match began, when we have caught up, and who agrees with our states. Out: whether enough
/// do. Keeps: the beginning, and since when we are near the present.
class Vouching {
 public:
  Vouching(const std::vector<InputStream>& streams, const OwnSeats& own) : streams_(streams), own_(own) {}

  /// The state with which our part of the match began.
  Frame base() const { return base_; }
  void begin_at(Frame base) {
    base_ = base;
    near_since_ = 0;
  }
  void was_repaired_at(Frame base) { base_ = base; }
  void is_near(Time now) {
    if (near_since_ == 0) near_since_ = now;
  }
  /// Do the host's machine and enough others have the states that we have? Machines, a bit each: whose states since
  /// base() were ours, and who differs; `with_host`: players who share a machine with the host.
  bool suffices(std::uint64_t agreeing, std::uint64_t differing, std::uint32_t with_host, Time now) const;

 private:
  const std::vector<InputStream>& streams_;
  const OwnSeats& own_;
  Frame base_ = 0;
  Time near_since_ = 0;  // [us] when we first had nearly caught up; 0: not yet
};

}  // namespace isostep
