// The worlds that the library holds: the list of their kinds, each over every scalar, found by what a file says of its
// world.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>

#include "isostep/core/scalars.hpp"
#include "isostep/geometry/blob.hpp"
#include "isostep/particles/particle_stages.hpp"
#include "isostep/particles/particle_state.hpp"
#include "isostep/particles/recorder.hpp"
#include "isostep/replay/recorder.hpp"
#include "isostep/state/replay_header.hpp"
#include "isostep/store/stages.hpp"

namespace isostep {

/// The facts about a RecordableWorld that it does not tell itself.
template <class W> struct WorldTraits;

template <class S> struct WorldTraits<World<S>> {
  static constexpr std::string_view kName = {};                         // in HEAD; empty: not there
  static constexpr std::uint32_t kPortableId = ScalarTraits<S>::kId;    // a portable form begins so, no other world's
  static constexpr std::span<const char* const> kStages = kStageNames;  // a trace has one hash more for each step
};

template <class S> struct WorldTraits<ParticleWorld<S>> {
  static constexpr std::string_view kName = kParticleWorldName;
  static constexpr std::uint32_t kPortableId = ScalarTraits<S>::kId | kParticleWorldBit;
  static constexpr std::span<const char* const> kStages = kParticleStageNames;
};


/// Reads a whole portable form, with nothing after it.
template <class W> ISO_INLINE Result<void> read_whole(W& world, Bytes bytes) {
  Reader reader(bytes);
  const Result<void> read = world.read_portable(reader);
  if (!read) return read;
  reader.expect_end();
  return reader.result("snapshot");
}

template <class W> struct WorldTag { using Type = W; };

/// Calls visit(WorldTag<W>{}) for each world until a call returns true. Returns true if one did.
template <class Visit> ISO_INLINE bool any_world(Visit&& visit) {
  return any_scalar([&](auto tag) ISO_INLINE_LAMBDA {
    using S = typename decltype(tag)::Type;
    return visit(WorldTag<World<S>>{}) || visit(WorldTag<ParticleWorld<S>>{});
  });
}

/// Calls visit(WorldTag<W>{}) for the world of that kind whose ScalarTraits satisfy `is_scalar(name, id)`. Returns an
/// empty text, or the field of HEAD that names nothing of this build.
template <class IsScalar, class Visit>
ISO_INLINE std::string_view with_world_if(std::string_view kind, IsScalar&& is_scalar, Visit&& visit) {
  bool known = false;
  const bool found = any_world([&](auto tag) ISO_INLINE_LAMBDA {
    using W = typename decltype(tag)::Type;
    using Number = ScalarTraits<typename W::Scalar>;
    if (kind != WorldTraits<W>::kName) return false;
    known = true;
    if (!is_scalar(std::string_view(Number::kName), Number::kId)) return false;
    visit(tag);
    return true;
  });
  return found ? "" : known ? "scalar" : kWorldKey;
}
template <class Visit>
ISO_INLINE std::string_view with_world(std::string_view kind, std::string_view scalar, Visit&& visit) {
  return with_world_if(
      kind, [&](std::string_view name, std::uint32_t) ISO_INLINE_LAMBDA { return name == scalar; }, visit);
}
/// The header's facts about the world of a recording, as views of the header.
struct RecordedWorld {
  std::string_view kind;    // WorldTraits::kName
  std::uint64_t scalar_id;  // of ScalarTraits
};
ISO_INLINE Result<RecordedWorld> recorded_world(const ReplayHeader& header) {
  const Result<std::uint64_t> scalar = header.number("scalar_id");
  if (!scalar) return scalar.error();
  const ReplayField* const kind = header.find(kWorldKey);
  return RecordedWorld{kind == nullptr ? std::string_view() : kind->value.view(), scalar.value()};
}
template <class Visit> ISO_INLINE std::string_view with_world(const RecordedWorld& world, Visit&& visit) {
  return with_world_if(
      world.kind, [&](std::string_view, std::uint32_t id) ISO_INLINE_LAMBDA { return id == world.scalar_id; }, visit);
}

/// Calls visit(WorldTag<W>{}) for the world whose portable form begins with that word. False: there is none.
template <class Visit> ISO_INLINE bool with_portable_world(std::uint32_t word, Visit&& visit) {
  return any_world([&](auto tag) ISO_INLINE_LAMBDA {
    if (word != WorldTraits<typename decltype(tag)::Type>::kPortableId) return false;
    visit(tag);
    return true;
  });
}

}  // namespace isostep
