// isostep diff: the first frame, stage and field at which replays or bundles part, or in which two snapshots differ.
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "commands.hpp"
#include "diff_bundles.hpp"
#include "diff_replays.hpp"
#include "differences.hpp"
#include "stage_trace.hpp"
#include "tool/common/tool.hpp"
#include "tool/page/film.hpp"

namespace isostep::tool {
namespace {

/// One of the two replays, played here.
template <class W> class Player {
 public:
  explicit Player(const Input& input) : input_(input), replay_(input.replay) {
    Reader reader(replay_.state());
    const Result<void> read = world_.read_portable(reader);
    if (!read) refuse(input.path, VerifyOutcome::corrupt, read.error());
  }
  std::uint64_t frames() const { return replay_.frame_count(); }
  ReplayFrame frame(std::uint64_t i) const { return replay_.frame(i); }
  W& world() { return world_; }

  /// Keeps the state before, then plays.
  void step(std::uint64_t i) {
    world_.save(before_);
    const Result<void> stepped = world_.step_recorded(frame(i).input);
    if (!stepped) refuse(input_.path, VerifyOutcome::corrupt, stepped.error());
  }
  /// The world is gone then.
  PlayedFrame<W> play_again(std::uint64_t i) {
    world_.load(before_);
    return {std::move(world_), frame(i).input};
  }

 private:
  const Input& input_;
  const ReplayReader& replay_;
  W world_;
  typename W::Snapshot before_;
};

template <class W> int report_frame(Player<W>& a, Player<W>& b, std::uint64_t frame) {
  PlayedFrame<W> of_a = a.play_again(frame), of_b = b.play_again(frame);
  const StagePlace place = place_of<W>(of_a.trace(), of_b.trace());
  std::printf("frame %llu, %s\n", static_cast<unsigned long long>(frame), place.text().c_str());
  if (!isostep::detail::same_bytes(a.frame(frame).input, b.frame(frame).input)) std::printf("%s", kCommandsDiffer);
  print_differences(of_a.state_at(place), of_b.state_at(place));
  return exit_status::kDifferent;
}

template <class W> int diff_as(const Input& input_a, const Input& input_b) {
  Player<W> a(input_a), b(input_b);
  DiffReport start(kShown);
  diff_states(a.world().state(), b.world().state(), start);
  if (start.any()) {
    std::printf("the start, before frame 0\n");
    print(start, a.world().state());
    return exit_status::kDifferent;
  }
  for (std::uint64_t i = 0; i < a.frames() && i < b.frames(); ++i) {
    stop_if_interrupted();
    a.step(i);
    b.step(i);
    const std::uint64_t hash = a.world().hash();
    if (hash != b.world().hash()) return report_frame(a, b, i);
    if (a.frame(i).hash != b.frame(i).hash) return report_recorded(i, a.frame(i).hash, b.frame(i).hash, hash);
  }
  if (a.frames() != b.frames()) {
    std::printf("the same as far as both go: %llu and %llu frames\n", static_cast<unsigned long long>(a.frames()),
                static_cast<unsigned long long>(b.frames()));
    return exit_status::kDifferent;
  }
  std::printf("the same: %llu frames\n", static_cast<unsigned long long>(a.frames()));
  return exit_status::kOk;
}

int diff_replays(const Input& a, const Input& b) {
  const RecordedWorld world = world_of(a);
  if (!are_comparable(world, world_of(b))) return exit_status::kDifferent;
  int status = exit_code(VerifyOutcome::incompatible);
  const bool bundles = is_bundle(a) || is_bundle(b);
  const std::string_view missing = with_world(world, [&](auto tag) {
    using W = typename decltype(tag)::Type;
    status = bundles ? diff_bundles<W>(a, b) : diff_as<W>(a, b);
  });
  if (!missing.empty()) throw ToolError(status, a.path + ": of a " + std::string(missing) + " that this build lacks");
  return status;
}

std::uint32_t portable_id_of(const Input& input) {
  std::uint32_t id = 0;
  Reader(input.bytes).read(id);
  return id;
}
bool is_snapshot(const Input& input) {
  return with_portable_world(portable_id_of(input), [](auto) {});
}

template <class W> void load(W& world, const Input& input) {
  const Result<void> read = read_whole(world, input.bytes);
  if (!read) refuse(input.path, VerifyOutcome::corrupt, read.error());
}

int diff_snapshots(const Input& a, const Input& b) {
  int status = exit_status::kOk;
  with_portable_world(portable_id_of(a), [&](auto tag) {
    typename decltype(tag)::Type world_a, world_b;
    load(world_a, a);
    load(world_b, b);
    const bool differ = print_differences(world_a.state(), world_b.state());
    if (!differ) std::printf("the same: %s\n", hex(world_a.hash()).c_str());
    status = differ ? exit_status::kDifferent : exit_status::kOk;
  });
  return status;
}

}  // namespace

int command_diff(const DiffOptions& options) {
  if (!options.html.empty()) require_pages();  // before the work
  if (options.stages) return diff_stages(options);
  if (options.b.empty()) throw ToolError(exit_status::kUsage, "diff compares two files; one alone only with --stages");
  const Input a(options.a), b(options.b);
  for (const Input* input : {&a, &b}) {
    if (input->is_replay() || is_snapshot(*input)) continue;
    throw ToolError(exit_code(VerifyOutcome::corrupt),
                    input->path + ": neither a replay nor a portable snapshot of a scalar of this build");
  }
  if (a.is_replay() != b.is_replay())
    throw ToolError(exit_status::kUsage, "a replay and a snapshot cannot be compared");
  const int status = a.is_replay() ? diff_replays(a, b) : diff_snapshots(a, b);
  if (!options.html.empty()) film_both(options.a, options.b, options.html);
  return status;
}

}  // namespace isostep::tool
