// The end of a benchmark's program: 0, or 64 for words that it does not take, or 70 and a line that says what failed.
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

namespace isostep::bench {

/// Reads the words into what `app` was given, then calls `run()`.
template <class Run> int run_program(CLI::App& app, int count, char** words, const Run& run) {
  try {
    app.parse(count, words);
    run();
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 64;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 70;
  }
}

}  // namespace isostep::bench
