// The file of results: what is known of earlier runs, and one line more for each that ends.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "result.hpp"

namespace isostep::tool::lab {

inline constexpr const char* kResultsFile = "results.jsonl";

/// The conditions under which an earlier run stands for this one.
struct Wanted {
  std::string version;
  int frames = 0;  // at the point's rate
};
bool stands_for(const LabRecord& record, const Wanted& wanted);

/// Open for appending. Whole lines alone are in the file at any moment but within `append`; what a crash cut off
/// there is taken away by the next that opens it.
class ResultStore {
 public:
  /// Makes the directory. Empty: nothing is kept. Throws ToolError 64 for a line that is no result, 66, or 74, for a
  /// file that another process has open here too.
  explicit ResultStore(const std::string& directory);

  /// Returns null where there is none that stands for it.
  const LabResult* find(const LabPoint& point, const Wanted& wanted) const;
  /// Throws ToolError 74.
  void append(const LabRecord& record);
  /// The path of the file; empty: nothing is kept.
  const std::string& path() const { return path_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
  std::map<std::string, LabRecord> known_;
};

}  // namespace isostep::tool::lab
