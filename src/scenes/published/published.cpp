// The list of published tests.
// SPDX-License-Identifier: MIT
#include "published.hpp"

namespace isostep::scenes {

const std::vector<PublishedTest>& published_tests() {
  static const std::vector<PublishedTest> all = [] {
    std::vector<PublishedTest> list;
    for (const std::span<const PublishedTest> source :
         {sim_benchmark_tests(), sim_benchmark_robot_tests(), erez_tests(), chung_pollard_tests()})
      list.insert(list.end(), source.begin(), source.end());
    return list;
  }();
  return all;
}

const PublishedTest* find_published_test(std::string_view name) {
  for (const PublishedTest& test : published_tests()) {
    if (name == test.trial.name) return &test;
  }
  return nullptr;
}

}  // namespace isostep::scenes
