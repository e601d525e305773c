// MemoryCap counts what Linux counts: private writable memory, mapped or not yet touched.
// SPDX-License-Identifier: MIT
#include "memory_cap.hpp"

#include "tool/common/tool.hpp"

#if defined(__linux__)
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#endif

namespace isostep::tool {

#if defined(__linux__)
namespace {

/// [bytes]
std::uint64_t data_now() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t pages[6] = {};  // size, resident, shared, text, library, data
  for (std::uint64_t& count : pages) file >> count;
  if (!file) throw ToolError(exit_status::kUnavailable, "--max-memory: /proc/self/statm cannot be read");
  return pages[5] * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void limit_data(std::uint64_t bytes) {
  rlimit limit = {};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = std::min<rlim_t>(bytes, limit.rlim_max);
  if (setrlimit(RLIMIT_DATA, &limit) != 0)
    throw ToolError(exit_status::kUnavailable, "--max-memory: the system refuses the limit");
}

}  // namespace

MemoryCap::MemoryCap(int mebibytes) {
  rlimit limit = {};
  getrlimit(RLIMIT_DATA, &limit);
  before_ = limit.rlim_cur;
  limit_data(data_now() + (static_cast<std::uint64_t>(mebibytes) << 20));
}
MemoryCap::~MemoryCap() {
  rlimit limit = {};
  getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = before_;
  setrlimit(RLIMIT_DATA, &limit);
}
#else
MemoryCap::MemoryCap(int) { throw ToolError(exit_status::kUnavailable, "--max-memory: not on this system"); }
MemoryCap::~MemoryCap() = default;
#endif

}  // namespace isostep::tool
