// The command line in this process: words in, exit status, streams and files out.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "own_folder.hpp"
#include "tool/command_line.hpp"

namespace isostep::tool {

struct Answer {
  int status;
  std::string out, err;
};

class CommandLine : public OwnFolder {
 protected:
  static Answer run(std::vector<std::string> words) {
    words.insert(words.begin(), "isostep");
    std::vector<const char*> pointers;
    for (const std::string& word : words) pointers.push_back(word.c_str());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const int status = run_command_line(static_cast<int>(pointers.size()), pointers.data());
    std::fflush(stdout);
    std::string out = testing::internal::GetCapturedStdout();
    return {status, std::move(out), testing::internal::GetCapturedStderr()};
  }
  static std::string content_of(const std::filesystem::path& place) {
    std::ifstream file(place, std::ios::binary);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  std::string read(const std::string& name) const { return content_of(path(name)); }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
  }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()));
  }
  /// A recording of 70 frames: two blocks.
  void record(const std::string& name, std::vector<std::string> more = {}) {
    std::vector<std::string> words = {"run", "S1x5", "--frames", "70", "--record", path(name)};
    words.insert(words.end(), more.begin(), more.end());
    ASSERT_EQ(run(words).status, 0);
  }
};

inline void expect_one_line(const Answer& answer, int status, const std::string& part) {
  EXPECT_EQ(answer.status, status);
  EXPECT_EQ(answer.out, "");
  EXPECT_NE(answer.err.find(part), std::string::npos) << answer.err;
  EXPECT_EQ(answer.err.find('\n'), answer.err.size() - 1) << answer.err;
}

}  // namespace isostep::tool
