// Which world a file needs, and whether it passes through the file's hashes.
// SPDX-License-Identifier: MIT
#include "replay_check.hpp"

#include <filesystem>

#include "files.hpp"
#include "isostep/core/version.hpp"
#include "scene_game.hpp"
#include "scenes/named.hpp"

namespace isostep::tool {
namespace {

std::string scalars_here() {
  std::string names;
  any_scalar([&](auto tag) {
    names += (names.empty() ? "" : ", ") + std::string(ScalarTraits<typename decltype(tag)::Type>::kName);
    return false;
  });
  return names;
}

VerifyResult corrupt(std::size_t offset, const char* message) {
  return detail::corrupt(0, offset, Error{ErrorCode::corrupt, message, ""});
}

/// The header that this build would write for the world in the file; without one, for what the file claims.
template <class S> Result<ReplayHeader> header_here(const ReplayReader& replay, const ReplayIdentity& claimed) {
  ReplayIdentity here = claimed;
  if (replay.has_state()) {
    World<S> world;
    Reader reader(replay.state());
    if (world.read_portable(reader)) here = identity_of_world<S>(world.settings(), claimed.scene);
  }
  here.behaviour = behaviour_version();
  here.scalar = ScalarTraits<S>::kName;
  here.scalar_id = ScalarTraits<S>::kId;
  here.hash_algorithm = kHashName;
  return make_replay_header(here);
}

template <class S> VerifyResult verify_as(const ReplayReader& replay, const ReplayIdentity& claimed, Simd simd) {
  const Result<ReplayHeader> here = header_here<S>(replay, claimed);
  if (!here) return corrupt(0, "the header's scene or solver cannot be read");
  World<S> world;
  use_lanes(world, simd);
  return verify(replay, world, SameHeader{here.value()});
}

template <class S>
VerifyResult replay_golden(const scenes::Scene& scene, const std::vector<std::uint64_t>& expected, Simd simd) {
  SceneGame<S> game(scene);
  use_lanes(game.world, simd);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    stop_if_interrupted();
    game.advance();
    const std::uint64_t hash = game.world.hash();
    if (hash != expected[i]) return detail::diverged(VerifyResult::Where::frame, i, expected[i], hash);
  }
  VerifyResult result{};
  result.frames = expected.size();
  return result;
}

VerifyResult unknown_scalar(std::string_view name) {
  return detail::incompatible({"scalar", name, std::string_view(scalars_here())});
}

}  // namespace

int status_of(const CheckedFile& file) {
  return file.missing.empty() ? exit_code(file.result.outcome) : exit_status::kNoInput;
}
std::string text_of(const CheckedFile& file) {
  return file.missing.empty() ? describe(file.result) : "UNREADABLE: " + file.missing;
}

CheckedFile check_replay(Bytes bytes, Simd simd) {
  CheckedFile file;
  const ReplayReader replay(bytes);
  file.result = detail::verify_file(replay);
  if (file.result.outcome != VerifyOutcome::verified) return file;
  if (!replay.has_header()) {
    file.result = detail::verify_end(replay);
    return file;
  }
  const Result<ReplayIdentity> identity = identity_of(replay.header());
  if (!identity) {
    file.result = detail::incompatible({identity.error().place.view(), {}, "a field that can be read"});
    return file;
  }
  file.scene = identity.value().scene;
  file.scalar = identity.value().scalar;
  const bool found = with_scalar(file.scalar, [&](auto tag) {
    file.result = verify_as<typename decltype(tag)::Type>(replay, identity.value(), simd);
  });
  if (!found) file.result = unknown_scalar(file.scalar);
  return file;
}

CheckedFile check_golden(const std::string& name, std::string_view text, Simd simd) {
  CheckedFile file;
  const std::optional<GoldenName> parsed = parse_golden_name(name);
  const auto hashes = parse_hash_lines(text);
  const std::optional<scenes::Scene> scene = parsed ? scenes::find_scene(parsed->scene) : std::nullopt;
  if (parsed) {
    file.scene = parsed->scene;
    file.scalar = parsed->scalar;
  }
  if (!parsed || !hashes) {
    file.result = corrupt(0, parsed ? "a line is not a frame number and a hash" : "not named SCENE.SCALAR.txt");
  } else if (!scene) {
    file.result = detail::incompatible({"scene", std::string_view(parsed->scene), "the named scenes"});
  } else if (!with_scalar(parsed->scalar, [&](auto tag) {
               file.result = replay_golden<typename decltype(tag)::Type>(*scene, *hashes, simd);
             })) {
    file.result = unknown_scalar(parsed->scalar);
  }
  return file;
}

CheckedFile check_file(const std::string& path) {
  CheckedFile file;
  try {
    const std::vector<std::uint8_t> bytes = read_file(path);
    const std::filesystem::path place(path);
    file = place.extension() == ".txt"
               ? check_golden(place.filename().string(),
                              std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()))
               : check_replay(bytes);
  } catch (const ToolError& error) {
    if (error.status() != exit_status::kNoInput) throw;
    file.missing = error.what();
  }
  file.path = path;
  return file;
}

}  // namespace isostep::tool
