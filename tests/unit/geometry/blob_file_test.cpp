// Blobs as files: what is written reads back, and nothing else does.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/blob_file.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "isostep/geometry/baked/hull_blob.hpp"

namespace isostep {
namespace blob_file_test {

BlobRef tetrahedron() {
  const std::vector<Vec3<double>> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return hull_blob(std::span<const Vec3<double>>(points)).value();
}

TEST(BlobFile, ReadsBackWhatWasWritten) {
  const BlobRef blob = tetrahedron();
  const std::vector<std::uint8_t> file = blob_file(*blob);
  EXPECT_EQ(file.size(), 8 + 16 + 4 + 4 + blob->bytes().size());
  for (const BlobHome home : {BlobHome::carried, BlobHome::asset}) {
    const Result<BlobRef> read = read_blob_file(file, home);
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read.value()->id(), blob->id());
    EXPECT_EQ(read.value()->type(), ShapeType::hull);
    EXPECT_EQ(read.value()->home(), home);
    EXPECT_EQ(blob_file(*read.value()), file);
  }
}

TEST(BlobFile, ThatIsCutExtendedOrAlteredIsRefused) {
  const std::vector<std::uint8_t> file = blob_file(*tetrahedron());
  for (std::size_t size = 0; size < file.size(); ++size) {
    const Result<BlobRef> read = read_blob_file(Bytes(file).first(size));
    ASSERT_FALSE(read.ok()) << size;
    EXPECT_EQ(read.error().code, size < 8 ? ErrorCode::invalid : ErrorCode::truncated) << size;
  }
  std::vector<std::uint8_t> longer = file;
  longer.push_back(0);
  EXPECT_FALSE(read_blob_file(longer).ok());
  for (std::size_t bit = 0; bit < 8 * file.size(); ++bit) {
    std::vector<std::uint8_t> altered = file;
    altered[bit / 8] = static_cast<std::uint8_t>(altered[bit / 8] ^ (1u << bit % 8));
    EXPECT_FALSE(read_blob_file(altered).ok()) << bit;
  }
}

TEST(BlobFile, OfNoShapesTypeIsRefused) {
  const BlobRef strange = Blob::make(static_cast<ShapeType>(kShapeTypes), {1, 2, 3});
  const Result<BlobRef> read = read_blob_file(blob_file(*strange));
  ASSERT_FALSE(read.ok());
  EXPECT_EQ(read.error().code, ErrorCode::invalid);
}

TEST(BlobFile, OfRandomBytesIsRefused) {
  std::mt19937 random(5);
  for (int i = 0; i < 2000; ++i) {
    std::vector<std::uint8_t> bytes(random() % 200);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    for (std::size_t k = 0; i % 2 == 1 && k < bytes.size() && k < sizeof kBlobFileMagic; ++k)
      bytes[k] = kBlobFileMagic[k];
    EXPECT_FALSE(read_blob_file(bytes).ok());
  }
}

}  // namespace blob_file_test
}  // namespace isostep
