// The store of runs: a file to which lines are appended.
// SPDX-License-Identifier: MIT
#include "store.hpp"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#if __has_include(<sys/file.h>)
#include <sys/file.h>
#endif

#include "tool/common/files.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool::lab {
namespace {

/// The place behind the last whole line.
std::uintmax_t end_of_lines(const std::string& path) {
  const std::vector<std::uint8_t> bytes = read_file(path);
  const auto last = std::find(bytes.rbegin(), bytes.rend(), std::uint8_t{'\n'});
  return static_cast<std::uintmax_t>(bytes.rend() - last);
}

[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw ToolError(exit_status::kOutput, path + ": " + why);
}

/// Another process that writes there keeps us out, until it ends in whatever way.
void lock(std::FILE* file, const std::string& path) {
#if __has_include(<sys/file.h>)
  if (flock(fileno(file), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    fail(path, "another isostep lab writes there: wait for its end, or choose another --out");
#else
  static_cast<void>(file);
  static_cast<void>(path);
#endif
}

}  // namespace

bool stands_for(const LabRecord& record, const Wanted& wanted) {
  const LabResult& result = record.result;
  if (record.version != wanted.version) return false;
  return result.state == kRefused || result.frames == wanted.frames;
}

ResultStore::ResultStore(const std::string& directory) {
  if (directory.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) fail(directory, error.message());
  path_ = directory + "/" + kResultsFile;
  file_.reset(std::fopen(path_.c_str(), "ab"));
  if (file_ == nullptr) fail(path_, std::generic_category().message(errno));
  lock(file_.get(), path_);
  for (LabRecord& record : read_records(path_)) known_.emplace(name_of(record.result.point), std::move(record));
  std::filesystem::resize_file(path_, end_of_lines(path_), error);
  if (error) fail(path_, error.message());
}

const LabResult* ResultStore::find(const LabPoint& point, const Wanted& wanted) const {
  const auto found = known_.find(name_of(point));
  return found != known_.end() && stands_for(found->second, wanted) ? &found->second.result : nullptr;
}

void ResultStore::append(const LabRecord& record) {
  if (file_ == nullptr) return;
  const std::string line = to_line(record) + "\n";
  if (std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size() || std::fflush(file_.get()) != 0)
    fail(path_, std::generic_category().message(errno));
}

}  // namespace isostep::tool::lab
