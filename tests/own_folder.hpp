// OwnFolder: a fixture whose every test has a folder to itself, new when it begins and gone when it ends.
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace isostep {

class OwnFolder : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo& info = *testing::UnitTest::GetInstance()->current_test_info();
    const std::string name = std::string("isostep-") + info.test_suite_name() + "-" + info.name() + "-";
    int tries = 0;  // whoever runs the same test at the same time has another
    do {
      folder_ = std::filesystem::path(testing::TempDir()) / (name + std::to_string(tries));
    } while (!std::filesystem::create_directory(folder_) && ++tries < 1000);
    ASSERT_LT(tries, 1000) << folder_;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  /// The path of a file with these bytes.
  std::string file(const std::string& name, const std::vector<std::uint8_t>& bytes) const {
    std::ofstream(path(name), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    return path(name);
  }

  std::filesystem::path folder_;
};

}  // namespace isostep
