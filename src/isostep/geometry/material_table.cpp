// Tables of materials: what is refused, and how they are read.
// SPDX-License-Identifier: MIT
#include "material_table.hpp"

#include "isostep/scalar/environment.hpp"
#include "isostep/scalar/lattice.hpp"

namespace isostep {

Result<SurfaceMaterial> surface_material(double friction, double restitution) {
  return pin_floats([&]() -> Result<SurfaceMaterial> {
    if (!(friction >= 0 && friction <= 16)) return Error{ErrorCode::invalid, "friction is 0 to 16", "friction"};
    if (!(restitution >= 0 && restitution <= 1))
      return Error{ErrorCode::invalid, "restitution is 0 to 1", "restitution"};
    return SurfaceMaterial{static_cast<std::uint16_t>(nearest_scaled(friction, SurfaceMaterial::kBits)),
                           static_cast<std::uint16_t>(nearest_scaled(restitution, SurfaceMaterial::kBits))};
  });
}

Result<void> check_table(std::span<const SurfaceMaterial> table) {
  if (table.size() > SurfaceMaterials::kMost)
    return Error{ErrorCode::limit, "a table has 254 materials at most", "table"};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const bool is_sound = table[i].friction <= SurfaceMaterial::kMostFriction &&
                          table[i].restitution <= SurfaceMaterial::kMostRestitution;
    if (is_sound) continue;
    Error fault{ErrorCode::invalid, "friction is 0 to 16, restitution 0 to 1, in 1/1024", "table["};
    fault.place.append_number(i).append("]");
    return fault;
  }
  return {};
}

void write_table(Writer& writer, const std::vector<SurfaceMaterial>& table) {
  if (!table.empty()) writer.write_array(table);
}

std::vector<SurfaceMaterial> read_table(Reader& reader) {
  std::vector<SurfaceMaterial> table;
  if (reader.remaining() == 0) return table;
  reader.read_array(table, SurfaceMaterials::kMost);
  if (table.empty()) reader.fail(ErrorCode::corrupt, "a table of materials that has none");
  return table;
}

}  // namespace isostep
