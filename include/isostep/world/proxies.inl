// Bodies of proxies.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/proxies.hpp"

namespace isostep {

template <class S> void Proxies<S>::place(const BodyState<S>& state, const BodyProperties<S>& body, bool awake) {
  if (keys_.size() <= state.slot) keys_.resize(state.slot + 1, Key{});
  Key& key = keys_[state.slot];
  const Key next = {state.fat,
                    body.filter,
                    true,
                    awake,
                    body.type == BodyType::dynamic,
                    (body.flags & body_flag::kSensor) != 0,
                    (body.flags & body_flag::kCollide) != 0};
  if (!key.present) {
    tree_.insert(state.slot, state.fat);
  } else if (!(key.box == next.box)) {
    tree_.update(state.slot, state.fat);
  } else if (key.awake == next.awake && key.dynamic == next.dynamic && key.sensor == next.sensor &&
             key.collides == next.collides && key.filter.category == next.filter.category &&
             key.filter.mask == next.filter.mask && key.filter.group == next.filter.group) {
    return;
  }
  key = next;
  pairs_.mark_moved(state.slot);
}

template <class S> void Proxies<S>::remove(std::uint32_t slot) {
  if (!present(slot)) return;
  tree_.remove(slot);
  pairs_.mark_removed(slot);
  keys_[slot] = Key{};
}

template <class S> void Proxies<S>::update() {
  tree_.optimise();
  pairs_.update(tree_, MayCollide{&keys_});
}

}  // namespace isostep
