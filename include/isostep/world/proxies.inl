// Bodies of proxies.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/crowd.inl"
#include "isostep/world/proxies.hpp"

namespace isostep {

template <class S> void Proxies<S>::place(const BodyState<S>& state, const BodyProperties<S>& body, bool awake) {
  if (proxies_.size() <= state.slot) proxies_.resize(state.slot + 1, Proxy<S>{});
  Proxy<S>& known = proxies_[state.slot];
  const Proxy<S> next = {state.fat, ProxyTraits::of(body, awake), true};
  if (!known.present) {
    tree_.insert(state.slot, state.fat);
  } else if (!(known.box == next.box)) {
    tree_.update(state.slot, state.fat);
  } else if (known.traits == next.traits) {
    return;
  }
  known = next;
  pairs_.mark_moved(state.slot);
}

template <class S> void Proxies<S>::remove(std::uint32_t slot) {
  if (!present(slot)) return;
  tree_.remove(slot);
  pairs_.mark_removed(slot);
  proxies_[slot] = Proxy<S>{};
}

template <class S> void Proxies<S>::update(std::span<const Contact<S>> contacts, std::size_t budget) {
  tree_.optimise();
  left_out_ = 0;
  if (pairs_.update(tree_, MayCollide{&proxies_}, budget)) return;
  crowd_.choose(proxies_, contacts, budget);
  pairs_.choose(crowd_.keys(), crowd_.whole());
  left_out_ = crowd_.bodies_left_out();
}

}  // namespace isostep
