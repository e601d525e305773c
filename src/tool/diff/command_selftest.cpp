// isostep selftest: a world that saves, runs ahead and loads, or is rebuilt, is what one is that never did.
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <vector>

#include "commands.hpp"
#include "differences.hpp"
#include "tool/common/games.hpp"

namespace isostep::tool {
namespace {

template <class Game> class Selftest {
 public:
  using World = typename Game::World;
  using Scene = typename Game::Scene;

  Selftest(const SelftestOptions& options, const Scene& scene)
      : options_(options), scene_(scene), game_(scene, options.game), other_(scene, options.game) {}

  int run() {
    for (int i = 0; i < kOtherLife; ++i) other_.advance();
    const int frames = options_.frames >= 0 ? options_.frames : scene_.frames;
    Game straight(scene_, options_.game);
    truth_.push_back(straight.world.hash());
    const std::vector<std::uint64_t> hashes = hashes_of(straight, frames + options_.rollback);
    truth_.insert(truth_.end(), hashes.begin(), hashes.end());
    for (int frame = 0; frame <= frames; ++frame) {
      stop_if_interrupted();
      if (frame > 0) game_.advance();
      if (!is_true(game_.world, frame, "a world that was loaded and runs on")) return exit_status::kDifferent;
      if (frame % options_.every == 0 && !restore(frame)) return exit_status::kDifferent;
    }
    std::printf(
        "%s in %s: %d frames, %d times saved, run %d frames ahead, loaded and run again, and rebuilt: all the same, "
        "%s\n",
        std::string(scene_.name).c_str(), ScalarTraits<typename World::Scalar>::kName, frames, restores_,
        options_.rollback, hex(game_.world.hash()).c_str());
    return exit_status::kOk;
  }

 private:
  /// `frame` steps were taken.
  bool is_true(const World& world, int frame, const char* who) {
    const std::uint64_t expected = truth_[static_cast<std::size_t>(frame)];
    if (world.hash() == expected) return true;
    std::printf("DIFFERENT after %d frames: %s has %s, a world that never saved has %s\n", frame, who,
                hex(world.hash()).c_str(), hex(expected).c_str());
    Game straight(scene_, options_.game);
    for (int i = 0; i < frame; ++i) straight.advance();
    print_differences(straight.world.state(), world.state());
    return false;
  }

  bool ahead(World& world, int frame, const char* who) {
    for (int i = 1; i <= options_.rollback; ++i) {
      game_.before_step(world);
      world.step();
      game_.after_step(world);
      if (!is_true(world, frame + i, who)) return false;
    }
    return true;
  }

  bool restore(int frame) {
    ++restores_;
    World& world = game_.world;
    world.save(snapshot_);
    if (!ahead(world, frame, "a world that saved and runs ahead")) return false;
    world.load(snapshot_);
    if (!is_true(world, frame, "a world that was loaded")) return false;
    if (!ahead(world, frame, "a world that runs again")) return false;
    world.load(snapshot_);

    // The portable form goes into a world that has lived: nothing of that life may be left in it.
    write(world, bytes_);
    Reader reader(bytes_);
    World& rebuilt = other_.world;
    if (const Result<void> read = rebuilt.read_portable(reader); !read) {
      std::printf("DIFFERENT after %d frames: the portable form is refused: %.*s\n", frame,
                  static_cast<int>(read.error().message.view().size()), read.error().message.view().data());
      return false;
    }
    write(rebuilt, again_);
    if (again_ != bytes_) {
      std::printf("DIFFERENT after %d frames: the portable form is another when it is written again\n", frame);
      return false;
    }
    return is_true(rebuilt, frame, "a rebuilt world") && ahead(rebuilt, frame, "a rebuilt world that runs ahead");
  }

  static void write(const World& world, std::vector<std::uint8_t>& bytes) {
    bytes.clear();
    Writer writer(bytes);
    world.write_portable(writer);
  }

  static constexpr int kOtherLife = 13;  // frames

  const SelftestOptions& options_;
  const Scene& scene_;
  Game game_, other_;
  std::vector<std::uint64_t> truth_;  // after 0, 1, ... frames
  typename World::Snapshot snapshot_;
  std::vector<std::uint8_t> bytes_, again_;
  int restores_ = 0;
};

}  // namespace

int command_selftest(const SelftestOptions& options) {
  int status = exit_status::kSoftware;
  with_game(options.scene, options.scalar, [&](auto tag, const auto& scene) {
    try {
      status = Selftest<typename decltype(tag)::Type>(options, scene).run();
    } catch (const scenes::SceneError& error) {
      fail_scene(options.scene, error);
    }
  });
  return status;
}

}  // namespace isostep::tool
