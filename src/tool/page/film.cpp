// Recordings played for a page.
// SPDX-License-Identifier: MIT
#include "film.hpp"

#include <algorithm>
#include <cstdio>

#include "camera.hpp"
#include "tool/common/recorded_file.hpp"
#include "tool/common/recorded_peer.hpp"

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
  const std::string_view missing = with_world(world_of(input), visit);
  if (!missing.empty()) {
    throw ToolError(exit_code(VerifyOutcome::incompatible),
                    input.path + ": of a " + std::string(missing) + " that this build lacks");
  }
}

std::string scene_of(const Input& input) {
  const ReplayField* const scene = input.replay.header().find("scene");
  return scene == nullptr ? input.path : std::string(scene->value.view());
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

void film_recording(const std::string& path, int frames, int every, const std::string& html) {
  require_pages();
  const Input input(path);
  page::Film film;
  film.scene = scene_of(input);
  film.every = every;
  with_world_of(input, [&](auto tag) {
    const RecordedPeer<typename decltype(tag)::Type> peer(input);
    const Frame asked = frames == kAllFrames ? peer.end() : peer.first() + frames;
    film_frames(peer, peer.first(), std::min(peer.end(), asked), film.every, film.run);
  });
  write_page(film, html, true);
}

void film_both(const std::string& path_a, const std::string& path_b, const std::string& html) {
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
