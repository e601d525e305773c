// The command demo: its options; it returns an exit status.
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

namespace isostep::tool {

class CommandLine;
/// demo, peer, relay and verify. Returns what holds their options.
std::shared_ptr<void> add_demo_commands(CommandLine& line);
/// A program of these alone: an exit status.
int run_demo(int argc, const char* const* argv);

struct DemoOptions {
  std::string out;  // directory for the recordings; empty: a temporary one
};
int command_demo(const DemoOptions& options);

}  // namespace isostep::tool
