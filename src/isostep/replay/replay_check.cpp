// Checks of a replay: the world that it needs, and whether that passes through the replay's hashes.
// SPDX-License-Identifier: MIT
#include "isostep/replay/replay_check.hpp"

#include "isostep/core/scalar_names.hpp"
#include "isostep/dynamics/solver_name.hpp"
#include "isostep/replay/world_kinds.hpp"

namespace isostep {
namespace {

std::string worlds_here() {
  std::string names;
  any_world([&](auto tag) {
    const std::string_view kind = WorldTraits<typename decltype(tag)::Type>::kName;
    const std::string_view name = kind.empty() ? std::string_view("rigid bodies") : kind;
    if (names.find(name) != std::string::npos) return false;
    if (!names.empty()) names += ", ";
    names += name;
    return false;
  });
  return names;
}

/// The header that this build would write for `settings` of the world in the file, or, with null, for what the file
/// claims.
template <class W, class Settings>
Result<ReplayHeader> header_here(const Settings* settings, const ReplayIdentity& claimed) {
  ReplayIdentity here = settings != nullptr ? identity_of_world(*settings, claimed.scene) : claimed;
  here.behaviour = behaviour_version();
  here.scalar = ScalarTraits<typename W::Scalar>::kName;
  here.scalar_id = ScalarTraits<typename W::Scalar>::kId;
  here.world = WorldTraits<W>::kName;
  here.hash_algorithm = kHashName;
  return make_replay_header(here);
}

/// Verifies a file that is sound in itself. Its start is read once: for the header that this build would write, and to
/// be stepped on. `lanes` becomes what steps it once the header is one that can be compared.
template <class W>
VerifyResult verify_as(const ReplayReader& replay, W& world, const ReplayIdentity& claimed, const VerifySpan& span,
                       const char*& lanes) {
  const VerifyResult start = replay.has_state() ? detail::read_start(replay, world, {}) : VerifyResult{};
  const bool known = replay.has_state() && start.outcome == VerifyOutcome::verified;
  const Result<ReplayHeader> here = header_here<W>(known ? &world.settings() : nullptr, claimed);
  if (!here) return detail::corrupt(0, 0, {ErrorCode::corrupt, "the header's scene or solver cannot be read", ""});
  lanes = world.simd_name();
  const HeaderMismatch mismatch = compare_headers(replay.header(), here.value());
  if (!mismatch.key.empty()) return detail::incompatible(mismatch);
  if (!replay.has_state()) return detail::verify_end(replay, 0);
  if (span.first > replay.frame_count()) return detail::too_short(replay);
  const VerifyResult begun = span.state.empty() ? start : detail::read_start(replay, world, span);
  return begun.outcome == VerifyOutcome::verified ? detail::verify_frames(replay, world, span) : begun;
}

template <class W>
void check_as(const ReplayReader& replay, const ReplayIdentity& claimed, const ReplayCheck& check,
              CheckedReplay& checked) {
  W world;
  use_lanes(world, check.simd);
  checked.result = verify_as(replay, world, claimed, check.span, checked.lanes);
  if (check.reached == nullptr || checked.result.outcome != VerifyOutcome::verified) return;
  check.reached->clear();
  Writer writer(*check.reached);
  world.write_portable(writer);
}

/// Returns null, or why this build cannot play a recording of such a world: core/book.hpp.
const char* left_out_for(const ReplayIdentity& claimed) {
  const bool rigid = claimed.world == WorldTraits<World<float>>::kName;
  const std::optional<SolverName> solver = rigid ? solver_named(claimed.solver) : std::nullopt;
  return solver ? left_out(*solver) : nullptr;
}

}  // namespace

CheckedReplay check_replay(Bytes file, const ReplayCheck& check) {
  CheckedReplay checked;
  const ReplayReader replay(file);
  checked.result = detail::verify_file(replay);
  if (checked.result.outcome != VerifyOutcome::verified) return checked;
  if (!replay.has_header()) {
    checked.result = detail::verify_end(replay, 0);
    return checked;
  }
  const Result<ReplayIdentity> identity = identity_of(replay.header());
  if (!identity) {
    checked.result = detail::incompatible({identity.error().place.view(), {}, "a field that can be read"});
    return checked;
  }
  const ReplayIdentity& claimed = identity.value();
  checked.scene = claimed.scene;
  checked.scalar = claimed.scalar;
  checked.left_out = left_out_for(claimed);
  if (checked.left_out != nullptr) {
    checked.result = detail::incompatible({"solver", claimed.solver, {}});
    checked.result.error = {ErrorCode::incompatible, checked.left_out, "solver"};
    return checked;
  }
  const std::string_view missing = with_world(claimed.world, claimed.scalar, [&](auto tag) {
    check_as<typename decltype(tag)::Type>(replay, claimed, check, checked);
  });
  if (missing.empty()) return checked;
  const bool kind = missing == kWorldKey;
  const std::string known = kind ? worlds_here() : joined_scalar_names(", ");
  checked.result = detail::incompatible({missing, kind ? claimed.world : claimed.scalar, std::string_view(known)});
  return checked;
}

}  // namespace isostep
