// WorldEngine: making, hashing and loading it, and the portable form.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/dynamics/checks.hpp"
#include "isostep/geometry/content.hpp"
#include "isostep/state/members.hpp"
#include "isostep/store/state_validator.hpp"
#include "isostep/world/engine.hpp"

namespace isostep {

namespace detail {
/// Clamps every field to its range. Replaces a solver that is unknown or left out by soft_step.
template <class S> Settings<S> in_range(Settings<S> s) {
  s.hz = clamp(s.hz, kLeastHz, kMostHz);
  s.substeps = clamp(s.substeps, 1, min(64, kMaxRate / s.hz));
  if (static_cast<std::uint32_t>(s.solver) >= kSolvers || left_out(s.solver) != nullptr)
    s.solver = SolverName::soft_step;
  if (static_cast<std::uint32_t>(s.projection) >= kProjections) s.projection = Projection::nonlinear;
  s.id_space = min(s.id_space, SlotMap::kIdSpaces - 1u);
  s.most_pairs = clamp(s.most_pairs, kLeastPairs, kMostPairs);
  const S limit = Limits<S>::speed();
  for (int axis = 0; axis < 3; ++axis) {
    const S g = s.gravity[axis];
    s.gravity[axis] = is_finite(g) ? clamp(g, -limit, limit) : S(0);
  }
  const S bounce = s.restitution_threshold;
  s.restitution_threshold = is_finite(bounce) ? clamp(bounce, S(0), limit) : Settings<S>{}.restitution_threshold;
  return s;
}
}  // namespace detail

/// Clamps settings to their ranges, and reports a fault for those out of range.
template <class S> WorldEngine<S>::WorldEngine(const Settings<S>& settings) {
  tools_.use_simd(Simd::best);
  const Settings<S>& s = state_.settings = detail::in_range(settings);
  const char* const instead = expected_instead_of(settings.solver);
  const FaultReport report =
      detail::Checklist()
          .proper(instead == nullptr, "solver", instead)
          .in_range(s.hz == settings.hz, "hz", "10 to 10000")
          .in_range(s.substeps == settings.substeps, "substeps", "1 to 64, hz * substeps up to kMaxRate")
          .in_range(s.gravity == settings.gravity, "gravity", "components up to Limits::speed()")
          .in_range(s.solver == settings.solver, "solver", "one of SolverName")
          .in_range(s.id_space == settings.id_space, "id_space", "0 to 255")
          .in_range(s.most_pairs == settings.most_pairs, "most_pairs", "kLeastPairs to kMostPairs")
          .in_range(s.projection == settings.projection, "projection", "one of Projection")
          .in_range(s.restitution_threshold == settings.restitution_threshold, "restitution_threshold",
                    "0 to Limits::speed()")
          .report();
  desk_.faults.accept_call("World", report);
}

template <class S> std::uint64_t WorldEngine<S>::hash() const {
  detail::StateHasher hasher;
  WorldState<S>::members(hasher, state_);
  return hasher.value();
}

template <class S> void WorldEngine<S>::load(const WorldState<S>& from) {
  loader_.load(from);
  desk_.note_load();
  events_.clear();
  report_ = {};
  render_poses_.forget();
}

template <class S> void WorldEngine<S>::write_portable(Writer& writer) const {
  writer.write(ScalarTraits<S>::kId);
  WorldState<S>::members(detail::StateWriter(writer), state_);
}

namespace detail {
/// Computes the data of shapes that follow from their children and that the portable form leaves out.
template <class S> void complete_shapes(WorldState<S>& state) {
  std::vector<const void*> contents;
  find_contents<S>(state.geometry->contents(), contents);
  for (std::uint32_t slot = 0; slot < state.shapes.size(); ++slot) {
    std::shared_ptr<const StoredShape<S>>& shape = state.shapes.change(slot);
    shape = stored_shape(shape->children, Contents<S>{contents.data()});
  }
}
}  // namespace detail

template <class S> Result<void> WorldEngine<S>::read_portable(Reader& reader) {
  WorldState<S> next;
  if (reader.read<std::uint32_t>() != ScalarTraits<S>::kId && reader.ok())
    reader.fail(ErrorCode::incompatible, "not written by a rigid world of this scalar");
  const auto read_store = [&](GeometryStore& store) { store.read(reader, *state_.geometry, assets_); };
  WorldState<S>::members(detail::StateReader(reader, read_store), next);
  if (reader.ok()) {
    if (const char* missing = left_out(next.settings.solver)) reader.fail(ErrorCode::incompatible, missing);
    else if (const char* rule = broken_rule(next)) reader.fail(ErrorCode::corrupt, rule);
  }
  const Result<void> result = reader.result("world");
  if (!reader.ok()) return result;
  detail::complete_shapes(next);
  load(next);
  return result;
}

}  // namespace isostep
