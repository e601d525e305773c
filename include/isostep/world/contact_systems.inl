// The systems that find pairs and contacts in a step. Compiled apart from the step that calls them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/world/body_frames.inl"
#include "isostep/world/contact_responses.inl"
#include "isostep/world/flush_contacts.inl"
#include "isostep/world/narrow_phase.inl"
#include "isostep/world/pair_rules.inl"
#include "isostep/world/proxies.inl"

#define ISO_INSTANTIATE_CONTACT_SYSTEMS(S) \
  ISO_BODY_FRAMES_OF(, S)                  \
  template class Proxies<S>;               \
  template class PairRules<S>;             \
  template class PartPairs<S>;             \
  template class FlushContacts<S>;         \
  template class NarrowPhase<S>;           \
  template class ContactResponses<S>;
