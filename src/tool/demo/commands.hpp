// The command demo: what each is told; each returns an exit status.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace isostep::tool {

struct DemoOptions {
  std::string out;  // directory for the recordings; empty: a temporary one
};
int command_demo(const DemoOptions& options);

}  // namespace isostep::tool
