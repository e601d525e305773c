// A program of the tests: a shape with a blob in worlds, snapshots, portable states and command logs, in a copy of the
// headers that has it in its list. Its worlds are compiled here and take no step.
// SPDX-License-Identifier: MIT
#define ISOSTEP_OWN_SCALARS
#include <cstdio>
#include <cstdlib>

#include "isostep/collision/continuous/shape_impact.inl"
#include "own_world.hpp"

using namespace isostep;
using Buffer = std::vector<std::uint8_t>;

void check(bool good, const char* what) {
  if (good) return;
  std::printf("not so: %s\n", what);
  std::exit(1);
}
Child<float> part_named(std::uint32_t name) { return {Probe<float>{name}.primitive(), Pose<float>::identity()}; }
ShapeId add(World<float>& world, const BlobRef& blob) {
  const Child<float> part = part_named(1);
  return world.add_shape(std::span<const Child<float>>(&part, 1), std::span<const BlobRef>(&blob, 1));
}
Buffer portable(const World<float>& world) {
  Buffer bytes;
  Writer writer(bytes);
  world.write_portable(writer);
  return bytes;
}
bool read(World<float>& world, const Buffer& bytes) {
  Reader reader(bytes);
  return world.read_portable(reader).ok();
}
bool play(World<float>& world, const Buffer& log) {
  return play_commands<EveryCommand<float>>(
             log, [&](const auto& c) { return static_cast<bool>(world.apply(c)); }, [] {})
      .ok();
}
AssetSource source_of(BlobRef& asset) {
  return {[](void* user, const ContentId& id) {
            const BlobRef& known = *static_cast<BlobRef*>(user);
            return known->id() == id ? known : nullptr;
          },
          &asset};
}

/// Names live as long as their parts; content as long as a world or a snapshot names it.
void lifetimes() {
  World<float> world;
  const std::uint64_t empty = world.hash();
  const Buffer no_blobs = portable(world);
  BlobRef blob = Probe<float>::bake(500, 250, 125);
  const std::weak_ptr<const Blob> content = blob;
  const ShapeId a = add(world, blob), b = add(world, Probe<float>::bake(500, 250, 125));
  blob = nullptr;
  check(a && b && world.state().geometry->names().size() == 1, "equal content is one blob");
  check(world.state().geometry->names()[0].uses == 2, "it has two uses");
  World<float> twin;
  add(twin, Probe<float>::bake(500, 250, 125));
  check(twin.hash() != world.hash(), "uses are hashed");
  add(twin, Probe<float>::bake(500, 250, 125));
  check(twin.hash() == world.hash(), "the same commands, the same hash, whoever made the content");
  World<float>::Snapshot snapshot;
  world.save(snapshot);
  const std::uint64_t saved = world.hash();
  check(world.remove_shape(a) && world.remove_shape(b), "shapes go");
  check(world.state().geometry->empty() && !content.expired(), "the snapshot keeps the content");
  check(world.load(snapshot) && world.hash() == saved, "restored");
  check(world.remove_shape(b) && world.remove_shape(a), "shapes go again");
  world.save(snapshot);
  check(content.expired(), "content goes with its last name");
  World<float> other;
  check(portable(other) == no_blobs && other.hash() == empty, "a world without blobs is written as ever");
  const BlobRef flat = Probe<float>::bake(0, 1, 1000);
  check(!add(world, flat), "a size of 0");
  const ShapeId c = add(world, Probe<float>::bake(100, 100, 100));
  add(world, Probe<float>::bake(200, 100, 100));
  world.remove_shape(c);
  add(world, Probe<float>::bake(300, 100, 100));
  check(world.state().geometry->names().size() == 2, "the lowest free place is taken again");
}

void refusals() {
  World<float> world;
  const std::uint64_t empty = world.hash();
  const BlobRef blob = Probe<float>::bake(500, 250, 125), wrong = Blob::make(ShapeType::box, {1, 2, 3});
  const Child<float> part = part_named(1), nameless = part_named(0), beyond = part_named(2);
  const auto refused = [&](const Child<float>& child, std::vector<BlobRef> blobs, const char* what) {
    const bool taken = static_cast<bool>(world.add_shape(std::span<const Child<float>>(&child, 1), blobs));
    check(!taken && world.fault() == Fault::bad_shape && world.hash() == empty, what);
  };
  refused(part, {}, "a name without a blob");
  refused(nameless, {}, "no name");
  refused(nameless, {blob}, "no name beside a blob");
  refused(beyond, {blob}, "a name beyond the blobs");
  refused(part, {wrong}, "another type's blob");
  refused(part, {blob, wrong}, "a blob that nobody names");
  refused(part, {nullptr}, "null");
  refused(part, {Blob::make(ShapeType::probe, {1, 2, 3})}, "bytes that make no shape");
  check(!world.apply(AddShape<float>{{part}, {{blob->id(), nullptr}}}), "a name that nobody knows");
  check(!world.apply(AddShape<float>{{part}, {{wrong->id(), blob}}}), "content of another name");
}

/// The blob is carried once, or brought by the game.
void files() {
  World<float> world;
  Buffer log;
  world.record_to(&log);
  const BlobRef carried = Probe<float>::bake(500, 250, 125);
  BlobRef asset = Probe<float>::bake(125, 250, 500, BlobHome::asset);
  add(world, carried);
  const std::size_t once = log.size();
  add(world, carried);
  check(log.size() - once < once - 12, "the second mention has no content");
  World<float> played;
  check(play(played, log) && played.hash() == world.hash(), "a command log that carries its blobs");
  World<float> loaded;
  check(read(loaded, portable(world)) && loaded.hash() == world.hash(), "a state that carries its blobs");
  check(portable(loaded) == portable(world), "and is written alike");
  for (std::size_t cut = 0; cut < portable(world).size(); ++cut) {
    Buffer part = portable(world);
    part.resize(cut);
    check(!read(loaded, part) && loaded.hash() == world.hash(), "a state cut short is refused");
  }
  for (std::size_t at = portable(world).size() - 24; at < portable(world).size(); ++at) {
    Buffer altered = portable(world);
    altered[at] ^= 1;
    World<float> fresh;
    check(!read(fresh, altered), "altered content is refused");
  }

  add(world, asset);
  World<float> without, with;
  check(!play(without, log) && !read(loaded, portable(world)), "an asset that nobody brings");
  with.use_assets(source_of(asset));
  check(play(with, log) && with.hash() == world.hash(), "a command log whose asset the game brings");
  loaded.use_assets(source_of(asset));
  check(read(loaded, portable(world)) && loaded.hash() == world.hash(), "a state whose asset the game brings");
  check(loaded.state().geometry->content(1) == asset, "its content is the game's");
  World<float>::Snapshot snapshot;
  world.save(snapshot);
  World<float> restored;
  check(restored.load(snapshot) && restored.hash() == world.hash(), "a snapshot needs no source");
}

int main() {
  lifetimes();
  refusals();
  files();
  std::printf("all as it should be\n");
}
