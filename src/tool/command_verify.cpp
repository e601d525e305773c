// isostep verify: replays files and compares the hash of every frame.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>

#include "checked_file.hpp"
#include "commands.hpp"
#include "tool.hpp"

namespace isostep::tool {
namespace {

namespace fs = std::filesystem;

/// In a directory: every *.replay, and *.txt in a folder named goldens. Ascending.
bool is_checkable(const fs::path& path) {
  if (path.extension() == ".replay") return true;
  return path.extension() == ".txt" && path.parent_path().filename() == "goldens";
}

std::vector<std::string> files_of(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    std::error_code error;
    if (!fs::is_directory(path, error)) {
      files.push_back(path);
      continue;
    }
    std::vector<std::string> found;
    std::error_code none;  // a link that leads nowhere is a file that cannot be read
    for (fs::recursive_directory_iterator it(path, error), end; !error && it != end; it.increment(error)) {
      if (is_checkable(it->path()) && !fs::is_directory(it->path(), none)) found.push_back(it->path().string());
    }
    if (error) throw ToolError(exit_status::kNoInput, path + ": " + error.message());
    if (found.empty()) throw ToolError(exit_status::kNoInput, path + ": holds no replay");
    std::sort(found.begin(), found.end());
    files.insert(files.end(), found.begin(), found.end());
  }
  return files;
}

/// Workers take the next file; results land in the files' order. The first exception ends all.
class Checking {
 public:
  Checking(const std::vector<std::string>& paths, bool show)
      : paths_(paths), results_(paths.size()), done_(paths.size()), show_(show) {}

  std::vector<CheckedFile> run(int jobs) {
    std::vector<std::thread> workers;
    const std::size_t count = std::min<std::size_t>(static_cast<std::size_t>(jobs), paths_.size());
    try {
      for (std::size_t i = 1; i < count; ++i) workers.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
      // The system gives no more threads: those that are there do the work.
    }
    work();
    for (std::thread& worker : workers) worker.join();
    if (failure_) std::rethrow_exception(failure_);
    return std::move(results_);
  }

 private:
  void work() {
    for (std::size_t i = next_++; i < paths_.size() && !stop_; i = next_++) {
      try {
        stop_if_interrupted();
        results_[i] = check_file(paths_[i]);
        report(i);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        stop_ = true;
      }
    }
  }
  /// Lines appear in order, as soon as all before them are known.
  void report(std::size_t i) {
    const std::lock_guard<std::mutex> lock(mutex_);
    done_[i] = 1;
    for (; shown_ < done_.size() && done_[shown_] != 0; ++shown_) {
      if (!show_) continue;
      const CheckedFile& file = results_[shown_];
      std::printf("%-40s %-7s %s\n", file.path.c_str(), file.scalar.c_str(), text_of(file).c_str());
      std::fflush(stdout);
    }
  }

  const std::vector<std::string>& paths_;
  std::vector<CheckedFile> results_;
  std::vector<std::uint8_t> done_;
  bool show_;
  std::size_t shown_ = 0;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::exception_ptr failure_;
};

const char* word_of(const CheckedFile& file) {
  if (!file.missing.empty()) return "unreadable";
  constexpr const char* kWords[] = {"verified", "diverged", "incompatible", "truncated", "corrupt"};
  return kWords[static_cast<std::size_t>(file.result.outcome)];
}

nlohmann::ordered_json json_of(const CheckedFile& file) {
  nlohmann::ordered_json json = {{"path", file.path},     {"outcome", word_of(file)},     {"scene", file.scene},
                                 {"scalar", file.scalar}, {"frames", file.result.frames}, {"message", text_of(file)}};
  if (file.missing.empty() && file.result.outcome == VerifyOutcome::diverged) {
    json["expected"] = hex(file.result.expected);
    json["actual"] = hex(file.result.actual);
  }
  return json;
}

}  // namespace

int command_verify(const VerifyOptions& options) {
  const std::vector<std::string> paths = files_of(options.paths);
  const std::vector<CheckedFile> files = Checking(paths, !options.json).run(options.jobs);
  int worst = 0;
  std::size_t verified = 0;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CheckedFile& file : files) {
    worst = std::max(worst, status_of(file));
    verified += status_of(file) == 0 ? 1u : 0u;
    if (options.json) list.push_back(json_of(file));
  }
  if (options.json) {
    std::cout << nlohmann::ordered_json{{"files", list}, {"verified", verified}, {"exit", worst}}.dump(
                     -1, ' ', false, nlohmann::json::error_handler_t::replace)
              << "\n";
  } else {
    std::printf("%zu of %zu verified\n", verified, files.size());
  }
  return worst;
}

}  // namespace isostep::tool
