// The environment probe as the library's own flags compile it.
// SPDX-License-Identifier: MIT
#include "isostep/scalar/environment.hpp"

namespace isostep {

std::uint32_t probe_environment() { return probe_environment_here(); }

}  // namespace isostep
