// plain_flight.hpp by the library's exact flags.
// SPDX-License-Identifier: MIT
#include "plain_flight.inl"

namespace isostep::bench {
void step_exact(const PlainFlight& flight) { step_plainly(flight); }
}  // namespace isostep::bench
