// broken_rule: whether a state read from outside keeps every rule that the step relies on.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/instantiate.hpp"
#include "isostep/store/state.hpp"

namespace isostep {

/// Returns a sentence for the first rule that the state breaks, null if it keeps all.
template <class S> const char* broken_rule(const WorldState<S>& state);

#define ISO_BROKEN_RULE_OF(extern, S) extern template const char* broken_rule(const WorldState<S>&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_BROKEN_RULE_OF)

}  // namespace isostep
