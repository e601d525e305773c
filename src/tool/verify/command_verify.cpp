// isostep verify: replays files and compares the hash of every frame.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <iostream>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <thread>

#include "checked_file.hpp"
#include "commands.hpp"
#include "goldens.hpp"
#include "memory_cap.hpp"
#include "tool/common/games.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool {
namespace {

namespace fs = std::filesystem;

/// The file is one that is checked in a directory: every *.replay, and goldens.txt.
bool is_checkable(const fs::path& path) { return path.extension() == ".replay" || path.filename() == "goldens.txt"; }

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

std::vector<Checkable> checkables_of(const std::vector<std::string>& paths) {
  std::vector<Checkable> all;
  for (const std::string& path : files_of(paths)) {
    for (Checkable& one : checkables_in(path)) all.push_back(std::move(one));
  }
  return all;
}

/// Prints the hash of every frame of a scene, as today's build has them: scalar, frame and hash, a line each.
int print_goldens(const std::string& scene_name) {
  for (const SceneRow& row : scene_rows()) {
    if (row.name != scene_name) continue;
    with_every_scalar(row, [&](const char* scalar, auto tag, const auto& scene) {
      typename decltype(tag)::Type game(scene);
      const std::vector<std::uint64_t> hashes = hashes_of(game, golden_frames(scene_name));
      for (std::size_t i = 0; i < hashes.size(); ++i) std::printf("%s %zu %s\n", scalar, i, hex(hashes[i]).c_str());
    });
    return exit_status::kOk;
  }
  throw ToolError(exit_status::kUsage, "no scene '" + scene_name + "'; `isostep scenes` lists them");
}

/// Workers take the next one; results land in their order. The first exception ends all, and so does a limit:
/// between frames, or a second later in the midst of one, and then of the program.
class Checking {
 public:
  Checking(const std::vector<Checkable>& all, const VerifyOptions& options)
      : all_(all), options_(options), results_(all.size()), done_(all.size()) {
    for (std::size_t i = 0; i < all.size(); ++i) results_[i] = stopped(all[i].path, "");
    if (options.max_seconds > 0) end_ = real_milliseconds() + 1e3 * options.max_seconds;
  }

  /// The exit status; what is left has been said.
  int run() {
    std::thread watch;
    if (end_ > 0) watch = std::thread([this] { end_in_the_midst(); });
    work_together();
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      finished_ = true;
    }
    changed_.notify_all();
    if (watch.joinable()) watch.join();
    if (failure_) std::rethrow_exception(failure_);
    return tell_all();
  }

 private:
  static CheckedFile stopped(const std::string& path, const std::string& limit) {
    CheckedFile file;
    file.path = path;
    file.result = isostep::detail::stopped(0);
    file.remark = limit;
    return file;
  }
  static bool has_time(void* self) { return !static_cast<Checking*>(self)->is_late(); }
  bool is_late() const { return end_ > 0 && end_ < real_milliseconds(); }

  void work_together() {
    std::optional<MemoryCap> cap;
    if (options_.max_memory > 0) cap.emplace(options_.max_memory);
    std::vector<std::thread> workers;
    const std::size_t count = std::min<std::size_t>(static_cast<std::size_t>(options_.jobs), all_.size());
    try {
      for (std::size_t i = 1; i < count; ++i) workers.emplace_back([this] { work(); });
    } catch (const std::system_error&) {
      // The system gives no more threads: those that are there do the work.
    }
    work();
    for (std::thread& worker : workers) worker.join();
  }
  void work() {
    for (std::size_t i = next_++; i < all_.size() && !stop_; i = next_++) {
      try {
        stop_if_interrupted();
        report(i, check_within_limits(all_[i]));
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!failure_) failure_ = std::current_exception();
        stop_ = true;
      }
    }
  }
  CheckedFile check_within_limits(const Checkable& what) {
    VerifySpan span;
    span.go_on = &Checking::has_time;
    span.user = this;
    try {
      CheckedFile file = check(what, span);
      if (file.missing.empty() && file.result.outcome == VerifyOutcome::stopped) file.remark = "--max-seconds";
      return file;
    } catch (const std::bad_alloc&) {
      if (options_.max_memory == 0) throw;
      return stopped(what.path, "--max-memory");
    }
  }
  /// Lines appear in order, as soon as all before them are known.
  void report(std::size_t i, CheckedFile&& file) {
    const std::lock_guard<std::mutex> lock(mutex_);
    results_[i] = std::move(file);
    done_[i] = 1;
    for (; shown_ < done_.size() && done_[shown_] != 0; ++shown_) show(results_[shown_]);
  }
  void show(const CheckedFile& file) const {
    if (options_.json) return;
    std::printf("%-40s %-7s %s\n", file.path.c_str(), file.scalar.c_str(), text_of(file).c_str());
    std::fflush(stdout);
  }
  int tell_all();

  /// A frame may take as long as its commands like.
  void end_in_the_midst() {
    std::unique_lock<std::mutex> lock(mutex_);
    const std::chrono::duration<double> most(options_.max_seconds + 1);
    if (changed_.wait_for(lock, most, [this] { return finished_; })) return;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (done_[i] == 0) results_[i].remark = "--max-seconds";
    }
    for (; shown_ < all_.size(); ++shown_) show(results_[shown_]);
    const int status = tell_all();
    std::cout.flush();
    std::fflush(stdout);
    std::_Exit(status);
  }

  const std::vector<Checkable>& all_;
  const VerifyOptions& options_;
  std::vector<CheckedFile> results_;
  std::vector<std::uint8_t> done_;
  double end_ = 0;  // [ms], or 0: no limit
  bool finished_ = false;
  std::condition_variable changed_;
  std::size_t shown_ = 0;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::exception_ptr failure_;
};

const char* word_of(const CheckedFile& file) {
  if (!file.missing.empty()) return "unreadable";
  constexpr const char* kWords[] = {"verified", "diverged", "incompatible", "truncated", "corrupt", "stopped"};
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

int Checking::tell_all() {
  int worst = 0;
  std::size_t verified = 0;
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const CheckedFile& file : results_) {
    worst = std::max(worst, status_of(file));
    verified += status_of(file) == 0 ? 1u : 0u;
    if (options_.json) list.push_back(json_of(file));
  }
  if (options_.json) {
    std::cout << nlohmann::ordered_json{{"files", list}, {"verified", verified}, {"exit", worst}}.dump(
                     -1, ' ', false, nlohmann::json::error_handler_t::replace)
              << "\n";
  } else {
    std::printf("%zu of %zu verified\n", verified, results_.size());
  }
  return worst;
}

}  // namespace

int command_verify(const VerifyOptions& options) {
  if (!options.goldens.empty()) return print_goldens(options.goldens);
  if (options.paths.empty()) throw ToolError(exit_status::kUsage, "verify wants paths, or --goldens SCENE");
  const std::vector<Checkable> all = checkables_of(options.paths);
  return Checking(all, options).run();
}

}  // namespace isostep::tool
