// Replays and goldens are told apart by the names of their files.
// SPDX-License-Identifier: MIT
#include "checked_file.hpp"

#include <filesystem>

#include "goldens.hpp"
#include "isostep/core/scalar_names.hpp"
#include "tool/common/files.hpp"
#include "tool/common/games.hpp"

namespace isostep::tool {
namespace {

VerifyResult corrupt(const char* message) {
  return isostep::detail::corrupt(0, 0, Error{ErrorCode::corrupt, message, ""});
}

/// The hash of every frame of a scene; fewer, when there is no time for more.
template <class Game>
std::vector<std::uint64_t> hashes_in_time(const typename Game::Scene& scene, std::size_t frames, Simd simd,
                                          const VerifySpan& span) {
  Game game(scene);
  use_lanes(game.world, simd);
  std::vector<std::uint64_t> hashes;
  while (hashes.size() < frames) {
    stop_if_interrupted();
    if (span.go_on != nullptr && !span.go_on(span.user)) break;
    game.advance();
    hashes.push_back(game.world.hash());
  }
  return hashes;
}

/// `hashes` are those of some of the frames; a divergence before a mark is first seen there, else by the digest.
void compare(const Golden& expected, const std::vector<std::uint64_t>& hashes, CheckedFile& file) {
  const Golden actual = golden_of(expected.scene, expected.scalar, hashes);
  file.result.frames = hashes.size();
  for (std::size_t i = 0; i < expected.marks.size(); ++i) {
    const std::size_t frame = frame_of_mark(expected, i);
    if (frame >= hashes.size() || hashes[frame] == expected.marks[i]) continue;
    file.result = isostep::detail::diverged(VerifyResult::Where::frame, frame, expected.marks[i], hashes[frame]);
    file.remark = "the first of the frames whose hashes are listed; another before it may differ";
    return;
  }
  if (hashes.size() < expected.frames) {
    file.result = isostep::detail::stopped(hashes.size());
  } else if (actual.digest != expected.digest) {
    file.result =
        isostep::detail::diverged(VerifyResult::Where::frame, expected.frames - 1, expected.digest, actual.digest);
    file.remark = "these are digests of all frames; the frames whose hashes are listed agree";
  }
}

/// `field` of a golden is a name that this build does not know.
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
  return describe(file.result) + (file.remark.empty() ? "" : ": " + file.remark);
}

CheckedFile check_golden(std::string_view line, Simd simd, const VerifySpan& span) {
  CheckedFile file;
  const std::optional<Golden> golden = parse_golden(line);
  if (!golden) {
    file.result = corrupt("a line is not SCENE SCALAR FRAMES DIGEST HASH...");
    return file;
  }
  file.scene = golden->scene;
  file.scalar = golden->scalar;
  const std::string_view missing = with_named_game(golden->scene, golden->scalar, [&](auto tag, const auto& scene) {
    if constexpr (requires { scenes::left_out(scene); }) file.left_out = scenes::left_out(scene);
    if (file.left_out != nullptr) {
      file.result = isostep::detail::incompatible({"scene", std::string_view(golden->scene), {}});
      file.result.error = {ErrorCode::incompatible, file.left_out, "scene"};
      return;
    }
    compare(*golden, hashes_in_time<typename decltype(tag)::Type>(scene, golden->frames, simd, span), file);
  });
  if (!missing.empty()) file.result = unknown(missing, missing == "scene" ? file.scene : file.scalar);
  return file;
}

std::vector<Checkable> checkables_in(const std::string& path) {
  if (std::filesystem::path(path).extension() != ".txt") return {{path}};
  std::vector<std::uint8_t> bytes;
  try {
    bytes = read_file(path);
  } catch (const ToolError& error) {
    if (error.status() != exit_status::kNoInput) throw;
    return {{path}};  // check() says why it cannot be read
  }
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::vector<Checkable> found;
  for (const std::string_view line : golden_lines(text)) {
    found.push_back({path + ":" + std::string(line.substr(0, line.find(' '))), std::string(line)});
  }
  if (found.empty()) found.push_back({path, ""});
  return found;
}

CheckedFile check(const Checkable& what, const VerifySpan& span) {
  CheckedFile file;
  try {
    file = what.golden ? check_golden(*what.golden, Simd::best, span)
                       : CheckedFile{check_replay(read_file(what.path), {.span = span})};
  } catch (const ToolError& error) {
    if (error.status() != exit_status::kNoInput) throw;
    file.missing = error.what();
  }
  file.path = what.path;
  return file;
}

}  // namespace isostep::tool
