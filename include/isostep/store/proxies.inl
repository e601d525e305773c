// Bodies of proxies.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/crowd.inl"
#include "isostep/store/proxies.hpp"

namespace isostep {

template <class S> void Proxies<S>::place(const BodyState<S>& state, const BodyProperties<S>& body, bool awake) {
  if (is_placed(state, body, awake)) return;
  if (!is_enabled(body)) return remove(state.slot);
  if (proxies_.size() <= state.slot) proxies_.resize(state.slot + 1, Proxy<S>{});
  Proxy<S>& known = proxies_[state.slot];
  if (!known.present) boxes_.insert(state.slot, state.fat);
  else if (!(known.box == state.fat)) boxes_.update(state.slot, state.fat);
  known = proxy_of(state, body, awake);
  pairs_.mark_moved(state.slot);
}

template <class S>
bool Proxies<S>::is_placed(const BodyState<S>& state, const BodyProperties<S>& body, bool awake) const {
  if (!is_enabled(body) || !present(state.slot)) return !is_enabled(body) && !present(state.slot);
  const Proxy<S>&known = proxies_[state.slot], now = proxy_of(state, body, awake);
  return known.box == now.box && known.traits == now.traits;
}

template <class S> void Proxies<S>::remove(std::uint32_t slot) {
  if (!present(slot)) return;
  boxes_.remove(slot);
  pairs_.mark_removed(slot);
  proxies_[slot] = Proxy<S>{};
}

template <class S> void Proxies<S>::use(BroadPhaseName name) {
  boxes_.choose(name);
  for (std::uint32_t slot = 0; slot < proxies_.size(); ++slot) {
    if (proxies_[slot].present) boxes_.insert(slot, proxies_[slot].box);
  }
  boxes_.optimise();
}

template <class S> void Proxies<S>::update(std::span<const Contact<S>> contacts, std::size_t budget) {
  boxes_.optimise();
  left_out_ = 0;
  const bool whole =
      boxes_.with([&](const auto& structure) { return pairs_.update(structure, MayCollide{&proxies_}, budget); });
  if (whole) return;
  crowd_.choose(proxies_, contacts, budget);
  pairs_.choose(crowd_.keys(), crowd_.whole());
  left_out_ = crowd_.bodies_left_out();
}

}  // namespace isostep
