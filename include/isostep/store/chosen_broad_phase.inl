// Bodies of chosen_broad_phase.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/chosen_broad_phase.hpp"

namespace isostep {

template <class S> void ChosenBroadPhase<S>::choose(BroadPhaseName name) {
  with([](auto& structure) { structure.clear(); });
  name_ = name;
}
template <class S> void ChosenBroadPhase<S>::insert(std::uint32_t slot, const Aabb<S>& box) {
  with([&](auto& structure) { structure.insert(slot, box); });
}
template <class S> void ChosenBroadPhase<S>::update(std::uint32_t slot, const Aabb<S>& box) {
  with([&](auto& structure) { structure.update(slot, box); });
}
template <class S> void ChosenBroadPhase<S>::remove(std::uint32_t slot) {
  with([&](auto& structure) { structure.remove(slot); });
}
template <class S> void ChosenBroadPhase<S>::optimise() {
  with([](auto& structure) { structure.optimise(); });
}
template <class S> const Aabb<S>& ChosenBroadPhase<S>::box(std::uint32_t slot) const {
  const auto find = [&](const auto& structure) { return &structure.box(slot); };
  return *with(*this, find);
}

template <class S>
void ChosenBroadPhase<S>::query_other(const Aabb<S>& box, bool (*visit)(void*, std::uint32_t), void* data) const {
  const auto ask = [&](const auto& structure) {
    structure.query(box, [&](std::uint32_t slot) { return visit(data, slot); });
  };
  with(*this, ask);
}
template <class S>
void ChosenBroadPhase<S>::sweep_other(const Sweep<S>& sweep, Unit<S> (*visit)(void*, std::uint32_t, Unit<S>),
                                      void* data) const {
  const auto ask = [&](const auto& structure) {
    structure.sweep(sweep, [&](std::uint32_t slot, Unit<S> most) { return visit(data, slot, most); });
  };
  with(*this, ask);
}

}  // namespace isostep
