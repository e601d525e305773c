// Hashes that were recorded, and those that come out here.
// SPDX-License-Identifier: MIT
#include "diff_replays.hpp"

#include <algorithm>
#include <cstdio>

#include "isostep/replay/world_kinds.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool {
namespace {

template <class W> std::vector<std::uint64_t> hashes_as(const Input& input, std::uint64_t frames) {
  const ReplayReader& replay = input.replay;
  W world;
  Reader reader(replay.state());
  const Result<void> read = world.read_portable(reader);
  if (!read) refuse(input.path, VerifyOutcome::corrupt, read.error());
  std::vector<std::uint64_t> hashes;
  for (std::uint64_t i = 0; i < frames; ++i) {
    stop_if_interrupted();
    const Result<void> stepped = world.step_recorded(replay.frame(i).input);
    if (!stepped) refuse(input.path, VerifyOutcome::corrupt, stepped.error());
    hashes.push_back(world.hash());
  }
  return hashes;
}
/// The hashes after each of the first frames, as they come out here; empty where this build lacks the world.
std::vector<std::uint64_t> hashes_here(const Input& input, std::uint64_t frames) {
  const Result<RecordedWorld> world = recorded_world(input.replay.header());
  std::vector<std::uint64_t> hashes;
  if (!world) return hashes;
  with_world(world.value(), [&](auto tag) { hashes = hashes_as<typename decltype(tag)::Type>(input, frames); });
  return hashes;
}

bool comes_out_as_recorded(const Input& input, std::uint64_t frames) {
  const ReplayReader& replay = input.replay;
  const std::vector<std::uint64_t> here = hashes_here(input, frames);
  for (std::size_t i = 0; i < here.size(); ++i) {
    const std::uint64_t recorded = replay.frame(i).hash;
    if (recorded == here[i]) continue;
    std::printf("frame %zu: recorded as %s, comes out as %s here: it was made by something that behaves otherwise\n", i,
                hex(recorded).c_str(), hex(here[i]).c_str());
    return false;
  }
  return true;
}

}  // namespace

bool are_comparable(const RecordedWorld& a, const RecordedWorld& b) {
  if (a.kind == b.kind && a.scalar_id == b.scalar_id) return true;
  std::printf("the %s differ\n", a.kind != b.kind ? "kinds of world" : "scalars");
  return false;
}

int report_recorded(std::uint64_t frame, std::uint64_t a, std::uint64_t b, std::uint64_t here) {
  const char* verdict = a == here   ? "B was made by something that behaves otherwise"
                        : b == here ? "A was made by something that behaves otherwise"
                                    : "neither was made by something that behaves as this does";
  std::printf("frame %llu: recorded as %s and %s, both come out as %s here: %s\n",
              static_cast<unsigned long long>(frame), hex(a).c_str(), hex(b).c_str(), hex(here).c_str(), verdict);
  return exit_status::kDifferent;
}

bool are_recorded_alike(const Input& a, const Input& b, std::uint64_t frames) {
  const std::uint64_t both = std::min({frames, a.replay.frame_count(), b.replay.frame_count()});
  if (isostep::detail::same_bytes(a.bytes, b.bytes)) return comes_out_as_recorded(a, both);
  for (std::uint64_t i = 0; i < both; ++i) {
    const std::uint64_t of_a = a.replay.frame(i).hash, of_b = b.replay.frame(i).hash;
    if (of_a == of_b) continue;
    const std::vector<std::uint64_t> here = hashes_here(a, i + 1);
    if (!here.empty()) {
      report_recorded(i, of_a, of_b, here.back());
    } else {  // provers alone have played them
      std::printf("frame %llu: recorded as %s and %s\n", static_cast<unsigned long long>(i), hex(of_a).c_str(),
                  hex(of_b).c_str());
    }
    return false;
  }
  return true;
}

}  // namespace isostep::tool
