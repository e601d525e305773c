// The command line: words into options, an exit status out, errors as one line on stderr. For the two programs that
// have one, the tool and its demo.
// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <exception>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "isostep/core/scalar_names.hpp"
#include "isostep/core/version.hpp"
#include "scenes/scene.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool {

/// The commands of a program, and what to do when one is chosen.
class CommandLine {
 public:
  static constexpr int kMostFrames = 1'000'000'000;

  explicit CommandLine(CLI::App& app) : app_(app) {
    app.require_subcommand(0, 1);
    app.set_version_flag("--version", std::string("isostep ") + kVersionText);
  }

  CLI::App* add(const char* name, const char* what, std::function<int()> action) {
    CLI::App* command = app_.add_subcommand(name, what);
    command->callback([this, action] { choose(action); });
    return command;
  }
  CLI::App& app() { return app_; }
  void choose(std::function<int()> action) { chosen_ = std::move(action); }
  int execute() const {
    if (!chosen_) throw ToolError(exit_status::kUsage, "a command is missing (isostep --help)");
    return chosen_();
  }

  template <std::size_t N> static std::vector<std::string> names_in(const char* const (&names)[N]) {
    return {std::begin(names), std::end(names)};
  }
  /// Accepts numbers from `least` to `most`. A CLI::Range alone accepts "nan" too.
  static CLI::Validator number_between(double least, double most) {
    return CLI::Range(least, most) & CLI::Validator(refuse_nan, "");
  }
  static std::string refuse_nan(const std::string& word) {
    double number = 0;
    return CLI::detail::lexical_cast(word, number) && std::isnan(number) ? word + " is not a number" : "";
  }
  /// A word that is there and says nothing: a variable of somebody's script that is not set.
  static std::string refuse_blank(const std::string& word) {
    return word.find_first_not_of(" \t\n") == std::string::npos ? "is empty" : "";
  }
  static void add_scalar(CLI::App* command, std::string& scalar) {
    command->add_option("--scalar", scalar, "the number type")
        ->check(CLI::IsMember(scalar_names()))
        ->capture_default_str();
  }
  /// Adds an option that names a file or a directory.
  static CLI::Option* add_path(CLI::App* command, const char* name, std::string& path, const char* what) {
    return command->add_option(name, path, what)->check(refuse_blank, "");
  }
  static void add_frames(CLI::App* command, int& frames) {
    command->add_option("--frames", frames, "how many; the scene's own count otherwise")
        ->check(CLI::Range(0, kMostFrames));
  }

 private:
  CLI::App& app_;
  std::function<int()> chosen_;
};

namespace detail {

inline int fail(int status, std::string message) {
  for (char& c : message) {
    if (c == '\n') c = ' ';
  }
  std::cerr << "isostep: " << message << "\n";
  return status;
}

/// `status`, where all that was printed has arrived.
inline int delivered(int status) {
  std::cout.flush();
  const bool written = std::cout.good() && std::fflush(stdout) == 0;
  return written ? status : fail(exit_status::kOutput, "standard output cannot be written");
}

template <class AddCommands> int parse_and_run(int argc, const char* const* argv, const AddCommands& add_commands) {
  CLI::App app("Deterministic 3D physics: the same inputs give the same bits.", "isostep");
  CommandLine line(app);
  const std::shared_ptr<void> commands = add_commands(line);  // their options
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return delivered(app.exit(error));
    return fail(exit_status::kUsage, std::string(error.what()) + " (isostep --help)");
  }
  catch_interrupt();
  return delivered(line.execute());
}

}  // namespace detail

/// An exit status for these words, of a program with the commands that `add_commands(line)` adds. It returns what holds
/// their options.
template <class AddCommands> int run_program(int argc, const char* const* argv, const AddCommands& add_commands) {
  try {
    return detail::parse_and_run(argc, argv, add_commands);
  } catch (const ToolError& error) {
    return detail::fail(error.status(), error.what());
  } catch (const scenes::SceneError& error) {
    return detail::fail(exit_status::kSoftware, error.what());
  } catch (const std::bad_alloc&) {
    return detail::fail(exit_status::kSoftware, "out of memory");
  } catch (const std::exception& error) {
    return detail::fail(exit_status::kSoftware, error.what());
  }
}

}  // namespace isostep::tool
