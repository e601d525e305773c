// plain_flight.hpp by the compiler's own flags for speed.
// SPDX-License-Identifier: MIT
#include "plain_flight.inl"

namespace isostep::bench {
void step_fast(const PlainFlight& flight) { step_plainly(flight); }
}  // namespace isostep::bench
