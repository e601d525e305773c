// A program of the tests: the balloon of the page of records as commands, hashes, logs, portable forms, scene files and
// the description of the C interface treat it, in a copy of the headers that has it in its list, and what it does in a
// step.
// SPDX-License-Identifier: MIT
#define ISOSTEP_OWN_SCALARS
#include <cstdio>

#include "c/describe/schema.cpp"
#include "own_step.hpp"
#include "scenes/json_tree.cpp"
#include "scenes/object_reader.cpp"
#include "scenes/scene_records.cpp"

using namespace isostep;

namespace {

void say_refusal(const World<float>& world) {
  const FaultReport& fault = world.fault();
  std::printf("%s.%s ", fault.command, fault.field);
}

BodyId body_of(World<float>& world, float x = 0) {
  BodyDefinition<float> ball;
  ball.type = BodyType::dynamic;
  ball.position.x = x;
  ball.shape = world.add_shape(Sphere<float>{0.5f});
  return world.create(ball);
}

/// A balloon lifts its body, and no other.
void say_step() {
  World<float> world;
  const BodyId held = body_of(world), free = body_of(world, 10);
  world.add(Balloon<float>{held, 100000});
  world.step();
  std::printf(" rises %d falls %d", world.velocity(held).y > 0, world.velocity(free).y < 0);
}

}  // namespace

int main() {
  World<float> world, other, third;
  std::vector<std::uint8_t> log;
  world.record_to(&log);
  const BodyId body = body_of(world), late = body_of(world);
  const auto without = world.hash();
  const BalloonId balloon = world.add(Balloon<float>{body, 2});
  world.add(Balloon<float>{late, -1});
  say_refusal(world);
  world.add(Balloon<float>{body, 1});
  say_refusal(world);
  world.set(balloon, Balloon<float>{BodyId{}, 3});
  say_refusal(world);
  world.set(balloon, Balloon<float>{body, 3});
  const Result<void> played = play_commands<EveryCommand<float>>(
      log, [&](const auto& command) { return static_cast<bool>(other.apply(command)); }, [] {});
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  world.write_portable(writer);
  Reader reader(bytes);
  const bool read = third.read_portable(reader).ok();
  std::printf("volume %g hashed %d played %d portable %d", double{world.find(balloon)->volume}, world.hash() != without,
              played.ok() && other.hash() == world.hash(), read && third.hash() == world.hash());
  world.destroy(body);
  std::printf(" gone %d", world.find(balloon) == nullptr);
  say_step();

  const scenes::SceneRecord record =
      scenes::read_record(scenes::parse_json(R"({"type": "balloon", "body": 0, "volume": 3})"), "/records/0", 1, 0);
  std::printf(" scene %s", scenes::text_of(record).c_str());
  const isostep::c_header::Schema schema = isostep::c_header::make_schema();
  std::printf(" C %s\n", schema.records.back().c_str());
}
