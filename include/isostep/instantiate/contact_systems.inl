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
  ISO_PROXIES_OF(, S)                      \
  ISO_PAIR_RULES_OF(, S)                   \
  ISO_PART_PAIRS_OF(, S)                   \
  ISO_FLUSH_CONTACTS_OF(, S)               \
  ISO_NARROW_PHASE_OF(, S)                 \
  ISO_CONTACT_RESPONSES_OF(, S)
