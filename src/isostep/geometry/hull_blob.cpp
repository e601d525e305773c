// Hulls to bytes and back.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/hull_blob.hpp"

#include <utility>

namespace isostep {
namespace {

Error bad_exponent() { return {ErrorCode::invalid, "a hull's exponent is 0 to 16", "exponent"}; }

}  // namespace

Error detail::bad_hull_point(std::size_t index, const char* expected) {
  ShortText<112> text = "point ";
  text.append_number(index).append(" of a hull: expected ").append(expected);
  return {ErrorCode::invalid, text, "points"};
}

Result<BlobRef> hull_blob(std::span<const GridPoint> points, int exponent, BlobHome home) {
  if (exponent < 0 || exponent > GridHull::kFinest) return bad_exponent();
  const Result<ConvexHull> hull = convex_hull(points);
  if (!hull.ok()) return hull.error();
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  writer.write(static_cast<std::uint32_t>(exponent));
  writer.write_array(hull.value().vertices);
  return Blob::make(ShapeType::hull, std::move(bytes), home);
}

Result<GridHull> read_hull(Bytes bytes) {
  Reader reader(bytes);
  const auto exponent = reader.read<std::uint32_t>();
  if (reader.ok() && exponent > GridHull::kFinest) return bad_exponent();
  std::vector<GridPoint> points;
  reader.read_array(points, ConvexHull::kMaxVertices);
  if (reader.ok() && reader.remaining() != 0) reader.fail(ErrorCode::corrupt, "bytes after a hull's last vertex");
  const Result<void> read = reader.result("hull");
  if (!read.ok()) return read.error();
  Result<ConvexHull> hull = convex_hull(points);
  if (!hull.ok()) return hull.error();
  if (hull.value().vertices != points)
    return Error{ErrorCode::corrupt, "a hull's points are not its vertices in ascending order", "points"};
  return GridHull{static_cast<int>(exponent), std::move(hull.value())};
}

}  // namespace isostep
