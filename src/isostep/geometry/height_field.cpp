// Height fields: what is refused, their triangles and their canonical bytes.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/height_field.hpp"

#include <algorithm>

#include "isostep/state/archive.hpp"
#include "material_table.hpp"

namespace isostep {
namespace {

Error fault(const char* place, ShortText<112> message) { return {ErrorCode::invalid, message, place}; }

Result<void> check_grid(const HeightGrid& grid) {
  if (grid.exponent > BakedHeightField::kMaxExponent) return fault("exponent", "the exponent of a step is 0 to 16");
  if (grid.height_shift > BakedHeightField::kMaxHeightShift)
    return fault("height_shift", "a unit of height is 2^0 to 2^7 steps");
  if (grid.columns < 2) return fault("columns", "a field has 2 columns or more");
  if (grid.rows < 2) return fault("rows", "a field has 2 rows or more");
  if (grid.pitch == 0) return fault("pitch", "the pitch is 0 steps");
  const std::uint64_t intervals = std::max(grid.columns, grid.rows) - 1;
  if (intervals * grid.pitch >= std::uint64_t{MeshPoint::kLimit})
    return fault("pitch", "the last column or row has a coordinate of more than 23 bits");
  const std::uint64_t cells = std::uint64_t{grid.columns - 1} * (grid.rows - 1);
  if (cells <= BakedHeightField::kMaxCells) return {};
  ShortText<112> message;
  message.append_number(cells).append(" cells, at most ").append_number(BakedHeightField::kMaxCells);
  return Error{ErrorCode::limit, message.append(" are possible"), "cells"};
}

Result<void> check_count(const char* list, std::uint64_t count, std::uint64_t expected, const char* places) {
  if (count == expected) return {};
  ShortText<112> message;
  message.append_number(count).append(" ").append(list).append(" for ").append_number(expected);
  return fault(list, message.append(" ").append(places));
}

constexpr char kNothingThere[] = "every cell is a hole or a ghost";

/// An offset from the corner of half 0, in columns and rows; half 1 takes it from the opposite corner, with the sign
/// turned.
struct Offset {
  std::int32_t i, k;
};
constexpr Offset kOpposite[3] = {{-1, 1}, {1, 1}, {1, -1}};  // across edge k
constexpr Offset kCells[3] = {{-1, 0}, {0, 0}, {0, -1}};     // from the cell to the one across edge k

/// The place of a triangle: its cell, and 1 for half 0, -1 for half 1. Half 1 is half 0 turned about the middle of the
/// cell.
struct Place {
  std::uint32_t i, k;
  std::int32_t sign;
};
Place place_of(const HeightGrid& grid, std::uint32_t id) {
  const std::uint32_t cell = id / 2, half = id % 2, k = cell / grid.cells_x();
  return {cell - k * grid.cells_x(), k, half == 0 ? 1 : -1};
}
/// The number of the cell across edge k, a ghost's too, or kNoTriangle where it is outside or a hole.
std::uint32_t cell_across(const HeightCells& field, Place place, int k) {
  const std::uint32_t i = place.i + static_cast<std::uint32_t>(place.sign * kCells[k].i),
                      row = place.k + static_cast<std::uint32_t>(place.sign * kCells[k].k);
  if (i >= field.grid.cells_x() || row >= field.grid.cells_z()) return kNoTriangle;  // -1 too
  const std::uint32_t cell = row * field.grid.cells_x() + i;
  return field.materials[cell] == BakedHeightField::kHole ? kNoTriangle : cell;
}

CellRange cells_about(const HeightGrid& grid, const HeightPatch& patch) {
  const auto before = [](std::uint32_t v) { return v == 0 ? 0 : v - 1; };
  return {{before(patch.column), before(patch.row)},
          {std::min(patch.column + patch.columns - 1, grid.cells_x() - 1),
           std::min(patch.row + patch.rows - 1, grid.cells_z() - 1)}};
}

}  // namespace

std::uint32_t BakedHeightField::neighbour(std::uint32_t id, int k) const {
  const std::uint32_t cell = cell_across(cells(), place_of(grid_, id), k);
  return cell == kNoTriangle ? kNoTriangle : 2 * cell + (1 - id % 2);
}

/// The triangles of an edge span a parallelogram of the grid, so the sum of the heights across tells how they lie to
/// each other when it is compared with the sum along.
BakedTriangle BakedHeightField::triangle(std::uint32_t id) const {
  const HeightCells field = cells();
  const Place place = place_of(grid_, id);
  const std::uint32_t i = place.i + id % 2, k = place.k + id % 2;
  const std::int16_t* const corner = field.heights + static_cast<std::size_t>(k) * grid_.columns + i;
  const std::int32_t pitch = place.sign * static_cast<std::int32_t>(grid_.pitch), unit = 1 << grid_.height_shift;
  const auto x = static_cast<std::int32_t>(i * grid_.pitch), z = static_cast<std::int32_t>(k * grid_.pitch);
  const std::ptrdiff_t column = place.sign, row = column * static_cast<std::ptrdiff_t>(grid_.columns);
  const auto at = [&](Offset o) -> MeshPoint {
    return {x + o.i * pitch, corner[o.i * column + o.k * row] * unit, z + o.k * pitch};
  };
  BakedTriangle baked = {corners(id), {}, {}, materials_[id / 2]};
  for (int e = 0; e < 3; ++e) {
    if (cell_across(field, place, e) == kNoTriangle) continue;
    const MeshPoint a = baked.points[e], b = baked.points[(e + 1) % 3], c = baked.points[(e + 2) % 3];
    baked.opposite[e] = at(kOpposite[e]);
    const std::int32_t rise = baked.opposite[e].y + c.y - a.y - b.y;
    baked.edges[e] = rise < 0 ? EdgeKind::convex : rise > 0 ? EdgeKind::concave : EdgeKind::flat;
  }
  return baked;
}

bool BakedHeightField::range_of(const MeshBox& box, CellBox& range) const {
  const MeshBox own = bounds();
  if (!own.touches(box)) return false;
  const std::int64_t pitch = grid_.pitch, unit = std::int64_t{1} << grid_.height_shift;
  const std::uint32_t last[2] = {grid_.cells_x() - 1, grid_.cells_z() - 1};
  for (int side = 0; side < 2; ++side) {
    const int axis = 2 * side;
    if (box.low[axis] > box.high[axis]) return false;
    const std::int64_t low = std::max(box.low[axis], own.low[axis]), high = std::min(box.high[axis], own.high[axis]);
    // A cell ends where the next begins.
    range.low[side] = low == 0 ? 0 : static_cast<std::uint32_t>((low - 1) / pitch);
    range.high[side] = std::min(last[side], static_cast<std::uint32_t>(high / pitch));
  }
  if (box.low[1] > box.high[1]) return false;
  const std::int64_t low = std::max(box.low[1], own.low[1]), high = std::min(box.high[1], own.high[1]);
  range.low_height = static_cast<std::int32_t>((low + unit - 1) >> grid_.height_shift);
  range.high_height = static_cast<std::int32_t>(high >> grid_.height_shift);
  return true;
}

Result<BakedHeightField> height_field(const HeightGrid& grid, std::span<const std::int16_t> heights,
                                      const SurfaceMaterials& materials) {
  const std::span<const std::uint8_t> numbers = materials.numbers;
  const Result<void> checked = check_grid(grid);
  if (!checked) return checked.error();
  const std::uint32_t cells = (grid.columns - 1) * (grid.rows - 1);
  const Result<void> places = check_count("heights", heights.size(), std::uint64_t{grid.columns} * grid.rows, "places");
  if (!places) return places.error();
  const Result<void> of_cells = check_count("materials", numbers.empty() ? cells : numbers.size(), cells, "cells");
  if (!of_cells) return of_cells.error();
  const Result<void> of_table = check_table(materials.table);
  if (!of_table) return of_table.error();

  BakedHeightField field;
  field.grid_ = grid;
  field.heights_.assign(heights.begin(), heights.end());
  field.materials_.assign(numbers.begin(), numbers.end());
  field.materials_.resize(cells, 0);
  field.table_.assign(materials.table.begin(), materials.table.end());
  field.blocks_.lay_out(grid);
  field.blocks_.refresh(field.cells(), field.all_cells());
  if (field.blocks_.span().is_empty()) return fault("materials", kNothingThere);
  return field;
}

MeshBox BakedHeightField::bounds_about(const HeightPatch& patch) const {
  const HeightCells field = cells();
  const CellRange about = cells_about(grid_, patch);
  HeightSpan span;
  for (std::uint32_t k = about.low[1]; k <= about.high[1]; ++k) {
    for (std::uint32_t i = about.low[0]; i <= about.high[0]; ++i) field.add_cell(span, i, k);
  }
  return field.box_of(about, span);
}

Result<BakedHeightField> BakedHeightField::with_heights(const HeightPatch& patch) const {
  const bool inside = patch.columns > 0 && patch.rows > 0 && patch.column <= grid_.columns &&
                      patch.columns <= grid_.columns - patch.column && patch.row <= grid_.rows &&
                      patch.rows <= grid_.rows - patch.row;
  if (!inside) return fault("heights", "the rectangle is empty or leaves the field");
  const std::uint64_t wide = patch.columns - 1, deep = patch.rows - 1;
  const Result<void> places =
      check_count("heights", patch.heights.size(), std::uint64_t{patch.columns} * patch.rows, "places");
  if (!places) return places.error();
  const std::uint64_t numbers = patch.materials.size();
  const Result<void> of_cells = check_count("materials", numbers, numbers == 0 ? 0 : wide * deep, "cells");
  if (!of_cells) return of_cells.error();
  BakedHeightField field = *this;
  const auto copy_row = [&](auto from, auto& to, std::uint64_t length, std::uint64_t k, std::uint64_t line) {
    const auto row = from.subspan(k * length, length);
    std::copy(row.begin(), row.end(), to.begin() + static_cast<std::ptrdiff_t>((patch.row + k) * line + patch.column));
  };
  const std::uint64_t numbered = numbers == 0 ? 0 : deep;
  for (std::uint64_t k = 0; k < patch.rows; ++k)
    copy_row(patch.heights, field.heights_, patch.columns, k, grid_.columns);
  for (std::uint64_t k = 0; k < numbered; ++k) copy_row(patch.materials, field.materials_, wide, k, grid_.cells_x());
  field.blocks_.refresh(field.cells(), cells_about(grid_, patch));
  if (field.blocks_.span().is_empty()) return fault("materials", kNothingThere);
  return field;
}

std::size_t BakedHeightField::memory() const {
  return sizeof(*this) + heights_.size() * sizeof(std::int16_t) + materials_.size() +
         table_.size() * sizeof(SurfaceMaterial) + blocks_.memory();
}

std::vector<std::uint8_t> BakedHeightField::bytes() const {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(sizeof(HeightGrid) + heights_.size() * sizeof(std::int16_t) + materials_.size());
  Writer writer(bytes);
  writer.write(grid_);
  writer.write_records(heights_.data(), heights_.size());
  writer.write_raw(materials_);
  write_table(writer, table_);
  return bytes;
}

Result<BakedHeightField> read_height_field(Bytes bytes) {
  Reader reader(bytes);
  const auto grid = reader.read<HeightGrid>();
  const Result<void> begun = reader.result("height field");
  if (!begun) return begun.error();
  const Result<void> checked = check_grid(grid);
  if (!checked) return checked.error();
  const std::size_t places = std::size_t{grid.columns} * grid.rows;  // below 2^26, as cells are at most 2^24
  std::vector<std::int16_t> heights;
  if (reader.remaining() / sizeof(std::int16_t) < places)
    reader.fail(ErrorCode::truncated, "fewer heights than places");
  else heights.resize(places);
  reader.read_records(heights.data(), heights.size());
  const Bytes materials = reader.read_view((grid.columns - 1) * (grid.rows - 1));
  const std::vector<SurfaceMaterial> table = read_table(reader);
  reader.expect_end();
  const Result<void> whole = reader.result("height field");
  if (!whole) return whole.error();
  return height_field(grid, heights, {materials, table});
}

}  // namespace isostep
