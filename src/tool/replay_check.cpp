// Which world a file needs, and whether it passes through the file's hashes.
// SPDX-License-Identifier: MIT
#include "replay_check.hpp"

#include <filesystem>

#include "files.hpp"
#include "games.hpp"
#include "goldens.hpp"
#include "isostep/core/version.hpp"
#include "worlds.hpp"

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
std::string worlds_here() {
  std::string names;
  any_world([&](auto tag) {
    const std::string_view kind = WorldTraits<typename decltype(tag)::Type>::kName;
    const std::string name(kind.empty() ? "rigid bodies" : kind);
    if (names.find(name) == std::string::npos) names += (names.empty() ? "" : ", ") + name;
    return false;
  });
  return names;
}

VerifyResult corrupt(std::size_t offset, const char* message) {
  return isostep::detail::corrupt(0, offset, Error{ErrorCode::corrupt, message, ""});
}

/// The header that this build would write for the world in the file; without one, for what the file claims.
template <class W> Result<ReplayHeader> header_here(const ReplayReader& replay, const ReplayIdentity& claimed) {
  ReplayIdentity here = claimed;
  if (replay.has_state()) {
    W world;
    Reader reader(replay.state());
    if (world.read_portable(reader)) here = identity_of_world(world.settings(), claimed.scene);
  }
  here.behaviour = behaviour_version();
  here.scalar = ScalarTraits<typename W::Scalar>::kName;
  here.scalar_id = ScalarTraits<typename W::Scalar>::kId;
  here.world = WorldTraits<W>::kName;
  here.hash_algorithm = kHashName;
  return make_replay_header(here);
}

template <class W> VerifyResult verify_as(const ReplayReader& replay, const ReplayIdentity& claimed, Simd simd) {
  const Result<ReplayHeader> here = header_here<W>(replay, claimed);
  if (!here) return corrupt(0, "the header's scene or solver cannot be read");
  W world;
  use_lanes(world, simd);
  return verify(replay, world, SameHeader{here.value()});
}

template <class Game>
VerifyResult replay_golden(const typename Game::Scene& scene, const std::vector<std::uint64_t>& expected, Simd simd) {
  Game game(scene);
  use_lanes(game.world, simd);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    stop_if_interrupted();
    game.advance();
    const std::uint64_t hash = game.world.hash();
    if (hash != expected[i]) return isostep::detail::diverged(VerifyResult::Where::frame, i, expected[i], hash);
  }
  VerifyResult result{};
  result.frames = expected.size();
  return result;
}

/// `field` of a file is a name that this build does not know.
VerifyResult unknown(std::string_view field, std::string_view name) {
  const std::string here = field == "scalar" ? scalars_here() : field == "scene" ? "the named scenes" : worlds_here();
  return isostep::detail::incompatible({field, name, std::string_view(here)});
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
  file.result = isostep::detail::verify_file(replay);
  if (file.result.outcome != VerifyOutcome::verified) return file;
  if (!replay.has_header()) {
    file.result = isostep::detail::verify_end(replay);
    return file;
  }
  const Result<ReplayIdentity> identity = identity_of(replay.header());
  if (!identity) {
    file.result = isostep::detail::incompatible({identity.error().place.view(), {}, "a field that can be read"});
    return file;
  }
  file.scene = identity.value().scene;
  file.scalar = identity.value().scalar;
  const std::string_view world = identity.value().world;
  const std::string_view missing = with_world(world, std::string_view(file.scalar), [&](auto tag) {
    file.result = verify_as<typename decltype(tag)::Type>(replay, identity.value(), simd);
  });
  if (!missing.empty()) file.result = unknown(missing, missing == kWorldKey ? world : file.scalar);
  return file;
}

CheckedFile check_golden(const std::string& name, std::string_view text, Simd simd) {
  CheckedFile file;
  const std::optional<GoldenName> parsed = parse_golden_name(name);
  const auto hashes = parse_hash_lines(text);
  if (parsed) {
    file.scene = parsed->scene;
    file.scalar = parsed->scalar;
  }
  if (!parsed || !hashes) {
    file.result = corrupt(0, parsed ? "a line is not a frame number and a hash" : "not named SCENE.SCALAR.txt");
    return file;
  }
  const std::string_view missing = with_named_game(parsed->scene, parsed->scalar, [&](auto tag, const auto& scene) {
    file.result = replay_golden<typename decltype(tag)::Type>(scene, *hashes, simd);
  });
  if (!missing.empty()) file.result = unknown(missing, missing == "scene" ? file.scene : file.scalar);
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
