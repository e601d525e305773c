// The bytes of triangle meshes, and what is refused of bytes.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "isostep/geometry/baked/triangle_mesh.hpp"
#include "unit/geometry/triangle_soup.hpp"

namespace isostep::test {
namespace triangle_mesh_bytes_test {

void expect_same_triangles(const TriangleMesh& a, const TriangleMesh& b) {
  ASSERT_EQ(a.triangle_count(), b.triangle_count());
  for (std::uint32_t t = 0; t < a.triangle_count(); ++t) ASSERT_TRUE(a.triangle(t) == b.triangle(t));
}

TEST(TriangleMesh, bytes_give_the_mesh_again) {
  Random random(13);
  for (int trial = 0; trial < 50; ++trial) {
    const Soup soup = random_soup(random, 3, 1 + 4 * trial);
    if (soup.triangles.empty()) continue;
    const TriangleMesh mesh = soup.mesh(trial % 17).value();
    const std::vector<std::uint8_t> bytes = mesh.bytes();
    EXPECT_EQ(bytes.size(), 12 + 12 * mesh.points().size() + 13 * mesh.triangles().size());
    const Result<TriangleMesh> again = read_triangle_mesh(bytes);
    ASSERT_TRUE(again.ok()) << fault_text(again);
    EXPECT_EQ(again.value().exponent(), trial % 17);
    EXPECT_EQ(again.value().bytes(), bytes);
    expect_same_triangles(mesh, again.value());
    EXPECT_EQ(queried(mesh, mesh.bounds()), queried(again.value(), mesh.bounds()));
  }
}

TEST(TriangleMesh, bytes_are_as_written_down) {
  const Points points = {{1, -2, 3}, {4, 5, 6}, {-7, 8, 0x123456}};
  const std::vector<std::uint8_t> expected = {
      9,    0,    0,    0,                                                     // exponent
      3,    0,    0,    0,    1, 0, 0, 0, 0xfe, 0xff, 0xff, 0xff, 3, 0, 0, 0,  // points
      4,    0,    0,    0,    5, 0, 0, 0, 6,    0,    0,    0,                 //
      0xf9, 0xff, 0xff, 0xff, 8, 0, 0, 0, 0x56, 0x34, 0x12, 0,                 //
      1,    0,    0,    0,    0, 0, 0, 0, 1,    0,    0,    0,    2, 0, 0, 0,  // triangles
      77};
  EXPECT_EQ(triangle_mesh(points, Triangles{{{0, 1, 2}}}, Materials{77}, 9).value().bytes(), expected);
}

TEST(TriangleMesh, other_bytes_are_refused_or_are_a_mesh_with_those_bytes) {
  Random random(14);
  const Soup soup = random_soup(random, 3, 60);
  const std::vector<std::uint8_t> whole = soup.mesh().value().bytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    ASSERT_FALSE(read_triangle_mesh({whole.data(), size}).ok()) << size;
  }
  int refused = 0, accepted = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<std::uint8_t> bytes = whole;
    for (int n = 0; n <= trial % 3; ++n) {
      std::uint8_t& byte = bytes[random() % bytes.size()];
      byte = static_cast<std::uint8_t>(trial % 2 == 0 ? random() : byte ^ 1u << random() % 8);
    }
    if (trial % 7 == 0) bytes.push_back(0);
    const Result<TriangleMesh> mesh = read_triangle_mesh(bytes);
    ++(mesh.ok() ? accepted : refused);
    if (!mesh) continue;
    ASSERT_EQ(mesh.value().bytes(), bytes);
    std::map<EdgeKind, int> kinds;
    if (trial % 50 != 0) continue;
    ASSERT_NO_FATAL_FAILURE(expect_neighbours_of_all_pairs(mesh.value(), kinds));
  }
  EXPECT_GT(refused, 5000);
  EXPECT_GT(accepted, 1000) << "materials and places may be others";
  for (int trial = 0; trial < 20000; ++trial) {
    std::vector<std::uint8_t> bytes(random() % 100);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() % 4);
    ASSERT_FALSE(read_triangle_mesh(bytes).ok());
  }
}

TEST(TriangleMesh, bytes_have_one_form) {
  std::vector<std::uint8_t> bytes = triangle_mesh(kSquare, Triangles{{{0, 1, 2}}, {{3, 2, 1}}}, {}, 0).value().bytes();
  bytes[4 + 4 + 4 * 12 + 4 + 4] = 2;  // the first triangle's second and third vertices change places
  bytes[4 + 4 + 4 * 12 + 4 + 8] = 1;
  bytes[4 + 4 + 4 * 12 + 4 + 12 + 4] = 1;
  bytes[4 + 4 + 4 * 12 + 4 + 12 + 8] = 2;
  EXPECT_EQ(fault_text(read_triangle_mesh(bytes)),
            "points: points are not each used, once, in the order of the triangles");
}

}  // namespace triangle_mesh_bytes_test
}  // namespace isostep::test
