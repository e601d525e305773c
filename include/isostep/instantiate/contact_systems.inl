// The systems that find pairs and contacts in a step. Compiled apart from the step that calls them.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/store/body_frames.inl"
#include "isostep/store/proxies.inl"
#include "isostep/systems/contacts/contact_responses.inl"
#include "isostep/systems/contacts/flush_contacts.inl"
#include "isostep/systems/contacts/narrow_phase.inl"
#include "isostep/systems/contacts/pair_rules.inl"

#define ISO_INSTANTIATE_CONTACT_SYSTEMS(S) \
  ISO_BODY_FRAMES_OF(, S)                  \
  template class Proxies<S>;               \
  template class PairRules<S>;             \
  template class PartPairs<S>;             \
  template class FlushContacts<S>;         \
  template class NarrowPhase<S>;           \
  template class ContactResponses<S>;
