// Watching recordings.
// SPDX-License-Identifier: MIT
#include "watch.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "diff_replays.hpp"
#include "page/camera.hpp"
#include "recorded_peer.hpp"

namespace isostep::tool {
namespace {

constexpr int kAllFrames = -1;

/// The frames `from` to `end` - 1, and the state before them.
template <class W>
void film_frames(const RecordedPeer<W>& peer, Frame from, Frame end, int every, page::Recording& recording) {
  W world = peer.start();
  for (Frame frame = peer.first(); frame < from; ++frame) {
    stop_if_interrupted();
    peer.play(world, frame);
  }
  page::Camera camera(recording, every);
  camera.begin(world);
  for (Frame frame = from; frame < end; ++frame) {
    stop_if_interrupted();
    peer.play(world, frame);
    camera.stepped(world, frame - from + 1, frame + 1 == end);
  }
}

template <class Visit> void with_world_of(const Input& input, Visit&& visit) {
  const ReplayKind kind = kind_of(input);
  const std::string_view missing = with_world(kind.world, kind.scalar, visit);
  if (!missing.empty()) {
    throw ToolError(exit_code(VerifyOutcome::incompatible),
                    input.path + ": of a " + std::string(missing) + " that this build lacks");
  }
}

std::string scene_of(const Input& input) {
  const ReplayReader replay(input.bytes);
  const ReplayField* const scene = replay.header().find("scene");
  return scene == nullptr ? input.path : std::string(scene->value.view());
}

/// What belongs to a scene that is run, and not to what was run already.
bool asks_for_a_run(const RunOptions& options) {
  const RunOptions standard;
  const std::string files = options.load + options.save + options.record + options.hashes + options.dump;
  const GameOptions& game = options.game;
  const bool methods = game.hz != standard.game.hz || game.substeps != standard.game.substeps ||
                       game.solver != standard.game.solver || game.integrator != standard.game.integrator ||
                       game.stepping != standard.game.stepping;
  return methods || !files.empty() || !options.beside.empty() || options.scalar != standard.scalar || options.json;
}

}  // namespace

void require_pages() {
  if (!page::available()) throw ToolError(exit_status::kUnavailable, page::how_to_get());
}

void write_page(const page::Film& film, const std::string& path, bool told, const std::string& more) {
  const std::string text = page::page_of(film);
  write_file(path, text);
  if (told)
    std::printf("page          %s, %.1f MB%s\n", path.c_str(), 1e-6 * static_cast<double>(text.size()), more.c_str());
}

bool is_recording(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  char bytes[sizeof kReplayMagic] = {};
  std::ifstream(path, std::ios::binary).read(bytes, sizeof bytes);
  return std::memcmp(bytes, kReplayMagic, sizeof bytes) == 0;
}

int watch(const RunOptions& options) {
  if (options.html.empty() || asks_for_a_run(options)) {
    throw ToolError(exit_status::kUsage, options.scene +
                                             ": a recording is watched as it was recorded, with --html and " +
                                             "no options of a run but --frames; `isostep verify` checks it");
  }
  require_pages();
  const Input input(options.scene);
  page::Film film;
  film.scene = scene_of(input);
  film.every = options.html_every;
  with_world_of(input, [&](auto tag) {
    const RecordedPeer<typename decltype(tag)::Type> peer(input);
    const Frame asked = options.frames == kAllFrames ? peer.end() : peer.first() + options.frames;
    film_frames(peer, peer.first(), std::min(peer.end(), asked), film.every, film.run);
  });
  write_page(film, options.html, true);
  return exit_status::kOk;
}

void watch_both(const std::string& path_a, const std::string& path_b, const std::string& html) {
  require_pages();
  const Input a(path_a), b(path_b);
  if (!a.is_replay() || !b.is_replay()) throw ToolError(exit_status::kUsage, "--html plays recordings, not snapshots");
  page::Film film;
  film.scene = scene_of(a);
  with_world_of(a, [&](auto tag) {
    using W = typename decltype(tag)::Type;
    const RecordedPeer<W> peer_a(a), peer_b(b);
    const Frame from = std::max(peer_a.first(), peer_b.first()), end = std::min(peer_a.end(), peer_b.end());
    if (from >= end) throw ToolError(exit_status::kUsage, "no frame is in both recordings: there is nothing to play");
    film_frames(peer_a, from, end, film.every, film.run);
    film_frames(peer_b, from, end, film.every, film.beside);
  });
  film.divergence = page::compare(film.run, film.beside, film.tolerance);
  write_page(film, html, true);
}

}  // namespace isostep::tool
