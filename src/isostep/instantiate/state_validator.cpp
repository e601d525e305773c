// broken_rule of every shipped scalar's world. Compiled apart from the world that reads states.
// SPDX-License-Identifier: MIT
#include "isostep/store/state_validator.inl"

namespace isostep {

#define ISO_INSTANTIATE_BROKEN_RULE(S) ISO_BROKEN_RULE_OF(, S)
ISO_FOR_EACH_SCALAR(ISO_INSTANTIATE_BROKEN_RULE)

}  // namespace isostep
