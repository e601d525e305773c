// Hulls and meshes mirrored, and as large or small as powers of two make them: exactly, point by point.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/core/result.hpp"
#include "isostep/geometry/blob.hpp"

namespace isostep {

/// A transformation of every point, in the geometry's own frame.
struct Instance {
  bool mirror_x = false, mirror_y = false, mirror_z = false;  // the coordinate changes its sign
  int doublings = 0;                                          // then each is 2^doublings times as large; -1 halves
};

/// Makes a blob of its own, whose name is that of its content: the one that the points so changed would have given. An
/// odd number of mirrors turns a mesh's triangles round, so that their outward sides stay outward; ids, first vertices,
/// materials and their table stay. No point is rounded, so mirroring twice gives the first blob. A larger one stays on
/// its grid while the points fit, a smaller one takes a finer grid while there is one: of a blob on the finest grid
/// that holds it, as all are that were made of metres, instances are on theirs, and halving undoes doubling.
/// Error:  vertices, faces and volume of a mirrored hull are mirror images bit for bit; its other moments within the
///         digits of HullMass, contacts of its edges within the last digits of Unit<S>.
/// Errors: ErrorCode::invalid, whose place is "type": neither hull nor mesh; "doublings": a point would leave the range
/// or fall between the steps of the finest grid, 2^-16 m; those of read_hull and read_triangle_mesh.
Result<BlobRef> instance_of(const Blob& blob, const Instance& instance, BlobHome home = BlobHome::carried);

}  // namespace isostep
