// Contacts by pairs of bodies: they ascend by key, so those of a pair stand side by side.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "isostep/core/lower_bound.hpp"
#include "isostep/dynamics/contact.hpp"

namespace isostep::detail {

template <class S> ISO_INLINE std::size_t end_of_pair(std::span<const Contact<S>> contacts, std::size_t first) {
  std::size_t end = first;
  while (end < contacts.size() && contacts[end].key.body_a == contacts[first].key.body_a &&
         contacts[end].key.body_b == contacts[first].key.body_b)
    ++end;
  return end;
}

/// Calls visit(first, end) for the contacts of each pair, in order.
template <class S, class Visit>
ISO_INLINE void for_each_pair(std::span<const Contact<S>> contacts, const Visit& visit) {
  for (std::size_t first = 0, end = 0; first < contacts.size(); first = end) {
    end = end_of_pair(contacts, first);
    visit(first, end);
  }
}

/// Returns the contacts of the bodies in slots a < b; empty if they have none.
template <class S>
ISO_INLINE std::span<const Contact<S>> contacts_of(std::span<const Contact<S>> contacts, std::uint32_t a,
                                                   std::uint32_t b) {
  const ContactKey least = {a, b, 0, 0};
  const std::size_t first =
      lower_bound(contacts.size(), [&](std::size_t i) ISO_INLINE_LAMBDA { return contacts[i].key < least; });
  if (first == contacts.size() || contacts[first].key.body_a != a || contacts[first].key.body_b != b) return {};
  return contacts.subspan(first, end_of_pair(contacts, first) - first);
}

}  // namespace isostep::detail
