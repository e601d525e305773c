// The rigid world of one scalar, compiled once more: src/isostep/instantiate/world.cpp for double alone.
// SPDX-License-Identifier: MIT
#include "isostep/world/world.inl"

namespace isostep {

template class World<double>;

}  // namespace isostep
