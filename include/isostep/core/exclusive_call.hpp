// ExclusiveCall: a call that changes a world, from its entry to its return.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/fault_log.hpp"
#include "isostep/core/one_at_a_time.hpp"

namespace isostep {

/// Keeps other calls out: a call from inside another one, as an observer of stages could make it, is refused.
class ExclusiveCall {
 public:
  ISO_INLINE ExclusiveCall(OneAtATime& of, FaultLog& faults, const char* name) : entry_(of) {
    if (!allowed()) faults.refuse_call(name, {Fault::called_in_step, "", "", "observers to change nothing"});
  }
  ISO_INLINE bool allowed() const { return entry_.alone(); }

 private:
  OneAtATime::Entry entry_;
};

}  // namespace isostep
