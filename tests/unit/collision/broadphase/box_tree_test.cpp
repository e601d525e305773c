// The tree of boxes as a coarse structure. What is its own is in broadphase_tree_test.cpp.
// SPDX-License-Identifier: MIT
#include "unit/collision/broadphase/laws.hpp"

namespace isostep::test {

INSTANTIATE_TYPED_TEST_SUITE_P(BoxTree, CoarseStructure, EveryScalar<AabbTree>);

}  // namespace isostep::test
