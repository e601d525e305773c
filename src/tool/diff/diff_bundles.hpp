// Two peers of one session: the first frame after which their recordings differ, its stage, and the fields.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdio>
#include <optional>

#include "diff_replays.hpp"
#include "differences.hpp"
#include "isostep/core/version.hpp"
#include "stage_trace.hpp"
#include "tool/common/recorded_peer.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool {

inline bool is_bundle(const Input& input) { return facts_chunk(input.replay) != nullptr; }

template <class W> void print_peer(const char* name, const RecordedPeer<W>& peer) {
  std::printf("%s: ", name);
  if (peer.facts()) {
    const BundleFacts& facts = *peer.facts();
    std::printf("%s, ", facts.player == 0xff ? "the host" : ("player " + std::to_string(facts.player)).c_str());
    if (facts.agreed != kNoFrame) std::printf("agreed before frame %d, ", facts.agreed);
  }
  std::printf("frames %d to %d\n", peer.first(), peer.end() - 1);
}

/// The first field on which they do not agree, and whether this build is of another behaviour than either.
inline void print_headers(const ReplayHeader& a, const ReplayHeader& b) {
  const HeaderMismatch mismatch = compare_headers(a, b);
  if (!mismatch.key.empty()) {
    const auto text = [](const auto& value) {
      return value.empty() ? std::string("missing") : std::string(value.view());
    };
    std::printf("%s: %s in A, %s in B\n", std::string(mismatch.key.view()).c_str(), text(mismatch.in_file).c_str(),
                text(mismatch.here).c_str());
  }
  const std::string here = hex(behaviour_version());
  for (const auto& [name, header] : {std::pair{"A", &a}, std::pair{"B", &b}}) {
    const ReplayField* field = header->find("behaviour");
    if (field != nullptr && field->value.view() != here) {
      std::printf("behaviour: %s here, %s in %s: what is played here says little\n", here.c_str(),
                  std::string(field->value.view()).c_str(), name);
    }
  }
}

/// States as the peers had them before a frame.
template <class W> void print_states(const RecordedPeer<W>& a, const RecordedPeer<W>& b, Frame frame) {
  const std::optional<W> of_a = a.state_before(frame), of_b = b.state_before(frame);
  for (const auto& [name, state] : {std::pair{"A", &of_a}, std::pair{"B", &of_b}}) {
    if (!*state) std::printf("  the state that %s had is not in its file and does not come out here\n", name);
  }
  if (of_a && of_b) print_differences(of_a->state(), of_b->state());
}

inline const char* verdict(bool a, bool b) {
  if (a && b) return "as recorded for both: they had other commands or other states before";
  if (a) return "as A recorded it, not as B did";
  if (b) return "as B recorded it, not as A did";
  return "as neither recorded it";
}

/// The place at which the peers' own traces part.
template <class W>
std::optional<StagePlace> traced_place(const RecordedPeer<W>& a, const RecordedPeer<W>& b, Frame frame) {
  const std::optional<Trace> of_a = a.stages(frame), of_b = b.stages(frame);
  if (!of_a || !of_b) return std::nullopt;
  return place_of<W>(*of_a, *of_b);
}

/// `stray`: which of the peers had its world changed between the frame before and this one, or null.
inline void print_place(Frame frame, const std::optional<StagePlace>& place, bool same_commands, const char* stray) {
  if (place) {
    std::printf("frame %d, %s\n", frame, place->text().c_str());
  } else {
    std::printf("within frame %d (trace was off)\n", frame);
  }
  if (!same_commands) std::printf("%s", kCommandsDiffer);
  if (stray != nullptr) {
    std::printf(
        "  the world of %s was changed between frames %d and %d: a command outside its frame, which no rollback "
        "repeats\n",
        stray, frame - 1, frame);
  } else if (same_commands && place && place->is_outside_steps()) {
    std::printf("  the commands of this frame agree: something else changed a state outside its steps\n");
  }
}

/// One frame, played here from the state that the peer had before it; nothing when it does not come out as recorded.
template <class W> std::optional<PlayedFrame<W>> play_again(const RecordedPeer<W>& peer, Frame frame) {
  std::optional<W> world = peer.state_before(frame);
  if (!world) return std::nullopt;
  PlayedFrame<W> played(std::move(*world), peer.commands(frame));
  if (!played.playable() || played.hash() != peer.hash_after(frame)) return std::nullopt;
  return played;
}

template <class W> void report_bundles(const RecordedPeer<W>& a, const RecordedPeer<W>& b, Frame frame) {
  std::optional<PlayedFrame<W>> again_a = play_again(a, frame), again_b = play_again(b, frame);
  const bool same_commands = isostep::detail::same_bytes(a.commands(frame), b.commands(frame));
  const bool of_a = a.changed_before(frame), of_b = b.changed_before(frame);
  const char* const stray = of_a && of_b ? "both" : of_a ? "A" : of_b ? "B" : nullptr;
  if (again_a && again_b) {
    const StagePlace place = place_of<W>(again_a->trace(), again_b->trace());
    print_place(frame, place, same_commands, stray);
    print_differences(again_a->state_at(place), again_b->state_at(place));
  } else {
    print_place(frame, traced_place(a, b, frame), same_commands, stray);
    print_states(a, b, frame + 1);
  }
  std::printf("played again here, the frame comes out %s\n", verdict(again_a.has_value(), again_b.has_value()));
}

/// Compares what was recorded; played again is only the frame that differs, and what leads to it where no state is
/// stored.
template <class W> int diff_bundles(const Input& input_a, const Input& input_b) {
  const RecordedPeer<W> a(input_a), b(input_b);
  print_headers(a.header(), b.header());
  print_peer("A", a);
  print_peer("B", b);
  const Frame first = std::max(a.first(), b.first()), end = std::min(a.end(), b.end());
  if (first >= end) {
    std::printf("no frame is in both\n");
    return exit_status::kDifferent;
  }
  if (a.hash_before(first) != b.hash_before(first)) {
    std::printf("before frame %d, the first that is in both\n", first);
    print_states(a, b, first);
    return exit_status::kDifferent;
  }
  for (Frame frame = first; frame < end; ++frame) {
    if (a.hash_after(frame) != b.hash_after(frame)) {
      report_bundles(a, b, frame);
      return exit_status::kDifferent;
    }
    const auto hash_a = a.game_hash_after(frame), hash_b = b.game_hash_after(frame);
    if (hash_a && hash_b && *hash_a != *hash_b) {
      std::printf("frame %d: the worlds agree, what the games keep beside them differs (hashes %s and %s)\n", frame,
                  hex(*hash_a).c_str(), hex(*hash_b).c_str());
      return exit_status::kDifferent;
    }
  }
  std::printf("the same: frames %d to %d\n", first, end - 1);
  return exit_status::kOk;
}

}  // namespace isostep::tool
