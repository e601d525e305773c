// BoundedQueue: order, and which one gives way.
// SPDX-License-Identifier: MIT
#include "isostep/session/timeline/bounded_queue.hpp"

#include <gtest/gtest.h>

#include <deque>

namespace isostep {
namespace bounded_queue_test {

TEST(BoundedQueue, GivesBackInOrder) {
  BoundedQueue<int> queue(3);
  EXPECT_TRUE(queue.empty());
  for (int i = 1; i <= 3; ++i) queue.push(i);
  EXPECT_EQ(queue.size(), 3u);
  for (int i = 1; i <= 3; ++i) EXPECT_EQ(queue.pop(), i);
  EXPECT_TRUE(queue.empty());
  EXPECT_EQ(queue.lost(), 0u);
}

TEST(BoundedQueue, TheOldestGivesWayAndIsCounted) {
  BoundedQueue<int> queue(3);
  for (int i = 1; i <= 5; ++i) queue.push(i);
  EXPECT_EQ(queue.lost(), 2u);
  for (int i = 3; i <= 5; ++i) EXPECT_EQ(queue.pop(), i);
}

TEST(BoundedQueue, DoesWhatAListOfThatLengthDoes) {
  for (std::size_t capacity = 1; capacity < 6; ++capacity) {
    BoundedQueue<int> queue(capacity);
    std::deque<int> model;
    std::uint64_t lost = 0;
    for (std::uint32_t i = 0; i < 500; ++i) {
      if ((i * 2654435761u >> 20) % 5 < 3) {
        queue.push(static_cast<int>(i));
        model.push_back(static_cast<int>(i));
        if (model.size() > capacity) {
          model.pop_front();
          ++lost;
        }
      } else if (!model.empty()) {
        ASSERT_EQ(queue.pop(), model.front());
        model.pop_front();
      }
      ASSERT_EQ(queue.size(), model.size());
      ASSERT_EQ(queue.lost(), lost);
    }
  }
}

}  // namespace bounded_queue_test
}  // namespace isostep
