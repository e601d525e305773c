// From a contact's geometry to the numbers its kernel needs, one contact at a time.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/body.hpp"
#include "isostep/dynamics/contact.hpp"
#include "isostep/dynamics/solver_body.hpp"
#include "isostep/dynamics/solvers/contact_block.hpp"

namespace isostep {

/// Friction by the root of the product, the rest by the larger.
template <class S> MixedMaterial<S> mix(const Material<S>& a, const Material<S>& b);

/// Fills a block of one contact; rows past the contact's points are left alone.
template <class S>
void prepare_contact(const Contact<S>& contact, const ContactGeometry<S>& geometry, const SolverBodies<S>& bodies,
                     ContactBlock<S, 1, kMaxContactPoints>& block);

/// The rows that resist rolling, for a prepared block.
template <class S>
void prepare_rolling(const ContactGeometry<S>& geometry, const SolverBodies<S>& bodies,
                     const ContactBlock<S, 1, kMaxContactPoints>& block, RollingRows<S, 1>& rolling);

}  // namespace isostep
