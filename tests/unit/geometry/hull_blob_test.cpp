// Hulls as blobs: one blob for every scalar, whatever the points' order; strange bytes and points are refused by name.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/hull_blob.hpp"

#include <gmock/gmock.h>

#include <thread>

#include "isostep/geometry/content.hpp"
#include "unit/geometry/hull_recipes.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace hull_blob_test {

using ::testing::HasSubstr;

std::vector<D3> drawn(int n) {
  scenes::Draws draws(static_cast<std::uint32_t>(n) + 77);
  std::vector<D3> points;
  for (const scenes::Point& p : scenes::drawn_hull(n, draws).points) points.push_back({p.x, p.y, p.z});
  return points;
}
template <class S> BlobRef baked(const std::vector<D3>& points) {
  std::vector<Vec3<S>> own;
  for (const D3 p : points) own.push_back(vec<S>(p));
  return hull_blob(std::span<const Vec3<S>>(own)).value();
}
Error refused(const std::vector<D3>& points) {
  const Result<BlobRef> made = hull_blob(std::span<const D3>(points));
  EXPECT_FALSE(made.ok());
  return made.ok() ? Error{} : made.error();
}

TEST(HullBlob, every_scalar_and_every_order_of_the_points_give_one_name) {
  for (int n = 0; n < 40; ++n) {
    const std::vector<D3> points = drawn(n);
    const ContentId id = baked<double>(points)->id();
    EXPECT_EQ(baked<float>(points)->id(), id);
    EXPECT_EQ(baked<Q16_16>(points)->id(), id);
    EXPECT_EQ(baked<Q32_32>(points)->id(), id);
    std::vector<D3> mixed(points.rbegin(), points.rend());
    mixed.push_back(points[points.size() / 2]);
    D3 middle = {0, 0, 0};
    for (const D3 p : points) middle += p * (1.0 / static_cast<double>(points.size()));
    mixed.push_back(middle);
    EXPECT_EQ(baked<double>(mixed)->id(), id) << "a point twice and a point inside";
    EXPECT_NE(baked<double>(drawn(n + 1))->id(), id);
  }
}

TEST(HullBlob, the_grid_is_the_finest_that_holds_the_points) {
  const auto exponent_of = [](double size) {
    const std::vector<D3> points = {{size, 0, 0}, {0, size, 0}, {0, 0, size}, {0, 0, 0}};
    return read_hull(baked<double>(points)->bytes()).value().exponent;
  };
  EXPECT_EQ(exponent_of(7.9), 16);
  EXPECT_EQ(exponent_of(8), 15);
  EXPECT_EQ(exponent_of(15.9), 15);
  EXPECT_EQ(exponent_of(16), 14);
  EXPECT_EQ(exponent_of(524286), 0);
}

TEST(HullBlob, what_makes_no_hull_is_refused_by_name) {
  const double nan = std::nan("");
  EXPECT_THAT(std::string(refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, nan, 1}}).message.view()),
              HasSubstr("point 3 of a hull: expected finite"));
  EXPECT_THAT(std::string(refused({{0, 0, 0}, {1, 0, 0}, {0, -1e30, 0}, {0, 0, 1}}).message.view()),
              HasSubstr("point 2 of a hull: expected coordinates below"));
  EXPECT_THAT(std::string(refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).message.view()), HasSubstr("no volume"));
  EXPECT_THAT(std::string(refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}).message.view()),
              HasSubstr("no volume"));
  EXPECT_THAT(std::string(refused({}).message.view()), HasSubstr("no volume"));
  std::vector<D3> ball;
  for (int n = 0; n < 400; ++n) {
    const double y = 1 - 2 * (n + 0.5) / 400, r = std::sqrt(1 - y * y), angle = 2.399963 * n;
    ball.push_back({r * isostep::cos(angle), y, r * isostep::sin(angle)});
  }
  const Error many = refused(ball);
  EXPECT_EQ(many.code, ErrorCode::limit);
  EXPECT_THAT(std::string(many.message.view()), HasSubstr("400 vertices, at most 128"));
  EXPECT_FALSE(hull_blob(in_steps({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 17).ok());
}

TEST(HullBlob, no_other_bytes_are_taken) {
  const BlobRef blob = baked<double>(drawn(2));
  const std::vector<std::uint8_t> bytes(blob->bytes().begin(), blob->bytes().end());
  ASSERT_TRUE(read_hull(bytes).ok());
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(read_hull(Bytes(bytes).subspan(0, size)).ok());
  int taken = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      std::vector<std::uint8_t> altered = bytes;
      altered[at] = static_cast<std::uint8_t>(altered[at] ^ 1 << bit);
      const Result<GridHull> read = read_hull(altered);
      if (!read.ok()) continue;
      ++taken;  // a vertex elsewhere, or another exponent: then the bytes are that hull's
      EXPECT_EQ(hull_blob(read.value().hull.vertices, read.value().exponent).value()->bytes().size(), bytes.size());
    }
  }
  EXPECT_GT(taken, 10);
  std::vector<std::uint8_t> longer = bytes;
  longer.push_back(0);
  EXPECT_FALSE(read_hull(longer).ok());
}

TEST(HullBlob, random_bytes_are_refused) {
  scenes::Draws draws(5);
  for (int n = 0; n < 20000; ++n) {
    std::vector<std::uint8_t> bytes(draws.next() % 200);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(draws.next() >> 24);
    if (bytes.size() > 8 && n % 2 == 0) {  // a header that could be
      bytes[0] = static_cast<std::uint8_t>(draws.next() % 17);
      bytes[1] = bytes[2] = bytes[3] = bytes[5] = bytes[6] = bytes[7] = 0;
      bytes[4] = static_cast<std::uint8_t>((bytes.size() - 8) / 12);
    }
    EXPECT_FALSE(read_hull(bytes).ok());
  }
}

TEST(HullBlob, threads_that_ask_at_once_get_one_content_each_time) {
  for (int round = 0; round < 20; ++round) {
    const BlobRef blob = baked<double>(drawn(round));
    const void* seen[4] = {};
    std::vector<std::thread> threads;
    for (const void*& content : seen)
      threads.emplace_back([&blob, &content] {
        content_of<double>(*blob);
        content = content_of<float>(*blob);
      });
    for (std::thread& thread : threads) thread.join();
    for (const void* content : seen) {
      ASSERT_NE(content, nullptr);
      const auto& hull = static_cast<const HullContent<float>*>(content)->solid;
      EXPECT_EQ(hull.polyhedron().vertices.size(), read_hull(blob->bytes()).value().hull.vertices.size());
    }
    EXPECT_EQ(content_of<float>(*blob), content_of<float>(*blob));
  }
}

}  // namespace hull_blob_test
}  // namespace isostep::test
