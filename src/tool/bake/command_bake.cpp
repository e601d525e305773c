// isostep bake: a file of polygons becomes a blob in a file, which scenes and games load as it is.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "baked.hpp"
#include "isostep/geometry/blob_file.hpp"
#include "tool/common/files.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool {
namespace {

std::string name_of(const Blob& blob) { return hex(blob.id().high) + hex(blob.id().low); }

std::string list_of(const std::vector<std::string>& names) {
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < 256; ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(i) + " \"" + names[i] + "\"";
  return text;
}

void print_table(const BakeOptions& options, const bake::SourceMesh& source, const bake::Baked& baked,
                 std::size_t bytes) {
  std::printf("%s %s\n", options.as.c_str(), name_of(*baked.blob).c_str());
  std::printf("read          %zu objects, %zu faces, %zu vertices\n", source.objects.size(), source.faces.size(),
              source.points.size());
  std::string counts;
  for (const auto& [what, count] : baked.counts)
    counts += (counts.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  std::printf("baked         %s\n", counts.c_str());
  if (options.as == "mesh") std::printf("materials     %s\n", list_of(source.materials).c_str());
  std::printf("step          2^-%d m\n", baked.exponent);
  for (const auto& [what, count] : baked.left_out) {
    if (count > 0) std::printf("left out      %zu %s\n", count, what);
  }
  if (options.points > 0) std::printf("outside       %.3f mm, the furthest point of the file\n", 1e3 * baked.outside);
  std::printf("file          %s: %zu bytes\n", options.out.c_str(), bytes);
}

void print_json(const BakeOptions& options, const bake::SourceMesh& source, const bake::Baked& baked,
                std::size_t bytes) {
  nlohmann::ordered_json json = {{"shape", options.as}, {"id", name_of(*baked.blob)}, {"exponent", baked.exponent}};
  for (const auto& [what, count] : baked.counts) json[what] = count;
  json["objects"] = source.objects;
  json["materials"] = source.materials;
  json["left_out"] = nlohmann::ordered_json::object();
  for (const auto& [what, count] : baked.left_out) json["left_out"][what] = count;
  json["outside"] = baked.outside;
  json["bytes"] = bytes;
  std::cout << json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << "\n";
}

}  // namespace

int command_bake(const BakeOptions& options) {
  const bool is_hull = options.as == "hull";
  if (!is_hull && options.points > 0) throw ToolError(exit_status::kUsage, "--points is for --as hull");
  const bake::SourceMesh source = bake::read_source(options.file);
  bake::Baked baked = is_hull ? bake::bake_hull(source, options) : bake::bake_mesh(source, options);
  baked.left_out.push_back({"lines and single points", source.bare});
  const std::vector<std::uint8_t> file = blob_file(*baked.blob);
  write_file(options.out, Bytes(file));
  if (options.json) print_json(options, source, baked, file.size());
  else print_table(options, source, baked, file.size());
  return exit_status::kOk;
}

}  // namespace isostep::tool
