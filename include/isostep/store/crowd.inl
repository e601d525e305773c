// Bodies of crowd.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/collision/broadphase/pairs.hpp"
#include "isostep/core/lower_bound.hpp"
#include "isostep/core/stable_sort.hpp"
#include "isostep/store/crowd.hpp"

namespace isostep {

/// The search for the partners of one body.
template <class S> struct Crowd<S>::Search {
  Crowd* crowd;
  std::uint32_t slot;
  ProxyTraits traits;  // whose partners are those of this side alone
  Side side;
  std::size_t share;  // partners that the body may have
  std::size_t most;   // and all bodies together

  /// Returns true if the other body takes the pair: two that are awake and not free both find it.
  bool is_others(std::uint32_t other) const {
    if (other == slot) return true;
    const std::uint32_t own = crowd->proxies_[slot].traits.kinds, its = crowd->proxies_[other].traits.kinds;
    return side == Side::held && other < slot && ((own | its) & proxy_kind::kFree) == 0 &&
           (its & proxy_kind::kAllAwake) != 0;
  }
  /// Takes a pair. Returns false if it is one more than there may be.
  bool take(std::uint32_t other) {
    if (is_others(other)) return true;
    const std::uint64_t key = pair_key(slot, other);
    if (side == Side::free && crowd->has_contacts(key)) return true;
    if (share == 0 || crowd->keys_.size() >= most) {
      crowd->leave_out(slot);
      return false;
    }
    crowd->keys_.push_back(key);
    --share;
    return true;
  }
  void run() {
    const auto enter = [&](std::uint32_t node) { return traits.pairs_with(crowd->traits_[node]); };
    const auto visit = [&](std::uint32_t other) { return take(other); };
    if (side == Side::held) crowd->tree_.query_all(slot, enter, visit);
    else crowd->tree_.query_behind(slot, enter, visit);
  }
};

template <class S> void Crowd<S>::build(std::span<const Proxy<S>> proxies) {
  proxies_ = proxies;
  tree_.clear();
  awake_.clear();
  for (std::uint32_t slot = 0; slot < proxies.size(); ++slot) {
    if (!proxies[slot].present || proxies[slot].traits.kinds == 0) continue;
    tree_.stage(slot, proxies[slot].box);
    if ((proxies[slot].traits.kinds & proxy_kind::kAllAwake) != 0) awake_.push_back(slot);
  }
  tree_.rebuild();
  tree_.fold(
      traits_, [&](std::uint32_t slot) { return proxies_[slot].traits; }, ProxyTraits::of_both);
}

/// Gathers every awake body's partners on one side: at most `share` for each, until there are `most` pairs in all.
/// Returns false if some are left out.
template <class S> bool Crowd<S>::gather(Side side, std::size_t share, std::size_t most) {
  const std::uint32_t before = left_out_;
  for (const std::uint32_t slot : awake_) {
    ProxyTraits traits = proxies_[slot].traits;
    if (side == Side::free && (traits.kinds & proxy_kind::kFree) == 0) continue;
    traits.partners &= side == Side::free ? proxy_kind::kFree : ~proxy_kind::kFree;
    if (traits.partners == 0) continue;
    Search{this, slot, traits, side, share, most}.run();
  }
  return left_out_ == before;
}

template <class S> std::size_t Crowd<S>::share_of(std::size_t room) const {
  return max(std::size_t{1}, room / max(std::size_t{1}, awake_.size()));
}

/// Keeps the pairs of free bodies that have contacts, in order of their keys.
template <class S> void Crowd<S>::keep_contacts(std::span<const Contact<S>> contacts, std::size_t most) {
  contacts_begin_ = keys_.size();
  std::uint64_t last = ~std::uint64_t{0};
  for (const Contact<S>& contact : contacts) {
    const std::uint32_t a = contact.key.body_a, b = contact.key.body_b;
    const std::uint64_t key = pair_key(a, b);
    if (key == last) continue;  // of other parts
    last = key;
    const ProxyTraits &of_a = proxies_[a].traits, &of_b = proxies_[b].traits;
    const bool free = (of_a.kinds & proxy_kind::kFree) != 0 && (of_b.kinds & proxy_kind::kFree) != 0;
    if (!free || !of_a.pairs_with(of_b) || !overlap(proxies_[a].box, proxies_[b].box)) continue;
    if (keys_.size() < most) keys_.push_back(key);
    else leave_out(a);
  }
  contacts_end_ = keys_.size();
}
template <class S> bool Crowd<S>::has_contacts(std::uint64_t key) const {
  const std::span contacts = std::span(keys_).subspan(contacts_begin_, contacts_end_ - contacts_begin_);
  const std::size_t at = lower_bound(contacts.size(), [&](std::size_t i) { return contacts[i] < key; });
  return at < contacts.size() && contacts[at] == key;
}

template <class S> void Crowd<S>::forget(std::size_t all_but) {
  keys_.resize(all_but);
  is_left_out_.clear();
  left_out_ = 0;
  contacts_begin_ = contacts_end_ = 0;
}

template <class S>
void Crowd<S>::choose(std::span<const Proxy<S>> proxies, std::span<const Contact<S>> contacts, std::size_t budget) {
  constexpr std::size_t kAnyNumber = ~std::size_t{0};
  build(proxies);
  forget(0);
  const bool all_held = gather(Side::held, kAnyNumber, budget);
  const std::size_t held = keys_.size();
  if (!all_held || !gather(Side::free, kAnyNumber, budget)) {
    forget(all_held ? held : 0);
    if (!all_held) gather(Side::held, share_of(budget), budget);
    keep_contacts(contacts, budget);
    gather(Side::free, share_of(budget - keys_.size()), budget);
  }
  scratch_.resize(keys_.size());
  stable_sort(keys_.data(), scratch_.data(), static_cast<std::uint32_t>(keys_.size()), OwnKey{});
}

}  // namespace isostep
