// Files to check, told apart by their names; golden lists by the scenes that they name.
// SPDX-License-Identifier: MIT
#include "checked_file.hpp"

#include <filesystem>

#include "goldens.hpp"
#include "isostep/core/scalar_names.hpp"
#include "tool/common/files.hpp"
#include "tool/common/games.hpp"
#include "tool/common/hash_lines.hpp"

namespace isostep::tool {
namespace {

VerifyResult corrupt(const char* message) {
  return isostep::detail::corrupt(0, 0, Error{ErrorCode::corrupt, message, ""});
}

template <class Game>
VerifyResult replay_golden(const typename Game::Scene& scene, const std::vector<std::uint64_t>& expected, Simd simd,
                           const VerifySpan& span) {
  Game game(scene);
  use_lanes(game.world, simd);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    stop_if_interrupted();
    if (span.go_on != nullptr && !span.go_on(span.user)) return isostep::detail::stopped(i);
    game.advance();
    const std::uint64_t hash = game.world.hash();
    if (hash != expected[i]) return isostep::detail::diverged(VerifyResult::Where::frame, i, expected[i], hash);
  }
  VerifyResult result{};
  result.frames = expected.size();
  return result;
}

/// `field` of a list is a name that this build does not know.
VerifyResult unknown(std::string_view field, std::string_view name) {
  const std::string here = field == "scene" ? "the named scenes" : joined_scalar_names(", ");
  return isostep::detail::incompatible({field, name, std::string_view(here)});
}

}  // namespace

int status_of(const CheckedFile& file) {
  return file.missing.empty() ? exit_code(file.result.outcome) : exit_status::kNoInput;
}
std::string text_of(const CheckedFile& file) {
  if (!file.missing.empty()) return "UNREADABLE: " + file.missing;
  return describe(file.result) + (file.limit.empty() ? "" : ": " + file.limit);
}

CheckedFile check_golden(const std::string& name, std::string_view text, Simd simd, const VerifySpan& span) {
  CheckedFile file;
  const std::optional<GoldenName> parsed = parse_golden_name(name);
  const auto hashes = parse_hash_lines(text);
  if (parsed) {
    file.scene = parsed->scene;
    file.scalar = parsed->scalar;
  }
  if (!parsed || !hashes) {
    file.result = corrupt(parsed ? "a line is not a frame number and a hash" : "not named SCENE.SCALAR.txt");
    return file;
  }
  const std::string_view missing = with_named_game(parsed->scene, parsed->scalar, [&](auto tag, const auto& scene) {
    file.result = replay_golden<typename decltype(tag)::Type>(scene, *hashes, simd, span);
  });
  if (!missing.empty()) file.result = unknown(missing, missing == "scene" ? file.scene : file.scalar);
  return file;
}

CheckedFile check_file(const std::string& path, const VerifySpan& span) {
  CheckedFile file;
  try {
    const std::vector<std::uint8_t> bytes = read_file(path);
    const std::filesystem::path place(path);
    file = place.extension() == ".txt"
               ? check_golden(place.filename().string(),
                              std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()), Simd::best,
                              span)
               : CheckedFile{check_replay(bytes, {.span = span})};
  } catch (const ToolError& error) {
    if (error.status() != exit_status::kNoInput) throw;
    file.missing = error.what();
  }
  file.path = path;
  return file;
}

}  // namespace isostep::tool
