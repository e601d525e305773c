// `isostep diff --stages`: whatever bit of whatever array is turned after whatever stage, it names the frame, the stage
// and the field, in rigid worlds with every solver and in worlds of particles.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "built.hpp"
#include "tool/common/tool.hpp"
#include "unit/tool/fault_injections.hpp"
#include "unit/tool/staged_recordings.hpp"

namespace isostep::test {
namespace diff_stages_test {

using Arrays = std::vector<std::string>;

/// Arrays that are fields of more than one: "prepared" stands for "prepared[].normals[]", too.
bool is_part_of(const std::string& array, const std::string& name) {
  return array == name || (array.rfind(name, 0) == 0 && (array[name.size()] == '[' || array[name.size()] == '.'));
}

/// `owners`: of arrays that belong to somebody, whose the printed slot must be. `state`: whether the state's arrays are
/// written as well, or just what stages leave in scratch.
template <class W>
void inject_everywhere(const tool::Input& input, const std::map<std::string, Arrays>& scratch,
                       const std::map<std::string, std::string>& owners, bool state) {
  const OrderlySide orderly(input);
  const Survey survey = Surveyor<W>().survey(input.bytes);
  std::set<std::pair<std::string, std::string>> missing;
  for (const auto& [stage, arrays] : scratch) {
    for (const std::string& array : arrays) missing.insert({stage, array});
  }
  for (const auto& [place, found] : survey) {
    const auto& [stage, array] = place;
    bool wanted = state;
    for (auto name = missing.begin(); name != missing.end();) {
      const bool match = name->first == stage && is_part_of(array, name->second);
      wanted = wanted || match;
      name = match ? missing.erase(name) : std::next(name);
    }
    if (scratch.count(stage) != 0) {
      for (const std::string& name : scratch.at(stage)) wanted = wanted || is_part_of(array, name);
    }
    if (!wanted || is_part_of(array, "shapes")) continue;  // which snapshots share, and nobody writes
    const auto owner = owners.find(array.substr(0, array.find('[')));
    SCOPED_TRACE("stage " + stage + ", " + found.field.path);
    expect_named(input, orderly, stage, found, owner == owners.end() ? "" : owner->second);
  }
  for (const auto& [stage, array] : missing) ADD_FAILURE() << "stage " << stage << " never left " << array;
}

const std::map<std::string, std::string> kRigidOwners = {
    {"bodies", "body slot "},
    {"properties", "body slot "},
    {"static_bodies", "body slot "},
    {"static_properties", "body slot "},
    {"contacts", "body slots "},
    {"joints", "joint slot "},
    {"joint_properties", "joint slot "},
    {"forces", "body slot "},
    {"overlaps", "body slots "},
    {"pairs", "body slots "},
    {"locations", "body slot "},
    {"joint_locations", "joint slot "},
    {"accelerations", "body slot "},
    {"start_poses", "body slot "},
    {"start_slots", "body slot "},
    {"frames", "body slot "},
    {"materials", "body slot "},
    {"parts", "body slots "},
    {"old_contacts", "body slots "},
    {"new_overlaps", "body slots "},
    {"geometry", "body slots "},
    {"joint_constraints", "joint slot "},
    {"solver_velocity", "body slot "},
    {"solver_displacement", "body slot "},
    {"solver_mass", "body slot "},
    {"solver_start", "body slot "},
    {"solver_inertia", "body slot "},
    {"colours", "body slots "},
    {"order", "body slots "},
    {"prepared", "body slots "},
    {"step_impulses", "body slots "},
    {"sensor_begin", "body slots "},
    {"sensor_end", "body slots "},
    {"contact_begin", "body slots "},
    {"contact_end", "body slots "},
    {"fell_asleep", "body slot "},
    {"woke", "body slot "},
    {"untold_contact_end", "body slots "},
    {"untold_sensor_end", "body slots "},
    {"untold_woke", "body slot "},
    {"untold_sensors", "body slot "},
    {"points", "body slots "},
    {"ends", "body slot"},
    {"held_joints", "joint slot "},
    {"islands", "*"},
};
Arrays with(Arrays arrays, const Arrays& more) {
  arrays.insert(arrays.end(), more.begin(), more.end());
  return arrays;
}
/// The arrays that do not depend on the solver, and those that its stages add.
std::map<std::string, Arrays> rigid_scratch(const Arrays& colour, const Arrays& prepare, const Arrays& solve) {
  const Arrays rows = {"solver_velocity", "solver_displacement"}, joints = {"joint_constraints"};
  return {
      {"find_pairs", {"pairs", "locations", "joint_locations"}},
      {"apply_forces", {"accelerations", "start_poses", "start_slots"}},
      {"update_manifolds", {"frames", "materials", "parts", "old_contacts", "new_overlaps", "geometry"}},
      {"colour_constraints", with(with(with(rows, joints), {"solver_mass", "solver_start", "solver_inertia"}), colour)},
      {"prepare", prepare},
      {"solve_substeps", with(with(rows, joints), solve)},
      {"store_impulses", {"step_impulses"}},
      {"finalise_bodies", {"report"}},
      {"update_sensors", {"sensor_begin", "sensor_end"}},
      {"emit_events", {"contact_begin", "contact_end"}},
      {"update_sleep", {"locations", "joint_locations", "fell_asleep", "woke"}},
      {"move_characters", {"locations", "joint_locations"}}};
}

const Arrays kBlocks = {"prepared", "prepared[].tangents", "prepared[].normals", "prepared[].rolling"};

TEST_F(Recorded, EveryArrayOfEveryStageIsNamedWithSoftStep) {
  const tool::Input input(file("a", rigid_recording<float>(SolverName::soft_step, 44)));
  inject_everywhere<World<float>>(input, rigid_scratch({"colours", "order"}, kBlocks, kBlocks), kRigidOwners, true);
}
TEST_F(Recorded, EveryArrayOfEveryStageIsNamedWithGaussSeidel) {
  const tool::Input input(file("a", rigid_recording<Q32_32>(SolverName::pgs, 44)));
  inject_everywhere<World<Q32_32>>(input, rigid_scratch({"colours", "order"}, kBlocks, kBlocks), kRigidOwners, false);
}
TEST_F(Recorded, EveryArrayOfEveryStageIsNamedWithWorstFirst) {
  ISO_NEEDS_BOOK();
  const tool::Input input(file("a", rigid_recording<Q16_16>(SolverName::worst_first, 44)));
  inject_everywhere<World<Q16_16>>(
      input, rigid_scratch({"points", "rolling", "held_joints", "ends", "neighbours"}, {}, {"points"}), kRigidOwners,
      false);
}
TEST_F(Recorded, EveryArrayOfEveryStageIsNamedWithTheDirectSolver) {
  const tool::Input input(file("a", rigid_recording<double>(SolverName::direct, 44)));
  const Arrays islands = {"islands[].joints", "islands[].contacts", "islands[].bodies", "islands[].joint_blocks",
                          "islands[].contact_blocks"};
  const Arrays rows = with(kBlocks, {"islands[].blocks", "islands[].blocks[].rows"});
  inject_everywhere<World<double>>(input, rigid_scratch(islands, kBlocks, rows), kRigidOwners, false);
}

const std::map<std::string, std::string> kParticleOwners = {
    {"position.x", "particle slot "},
    {"position.y", "particle slot "},
    {"position.z", "particle slot "},
    {"velocity.x", "particle slot "},
    {"velocity.y", "particle slot "},
    {"velocity.z", "particle slot "},
    {"inverse_mass", "particle slot "},
    {"material", "particle slot "},
    {"contacts", "particle slot"},
    {"old_contacts", "particle slot"},
    {"pushes", "particle slot "},
    {"touches", "particle slot "},
    {"lifetimes", "particle slot "},
    {"colliding", "particle slot "},
    {"reaches", "particle slot "},
    {"pairs", "particle slots "},
    {"rows", "particle slot"},
    {"displacement.x", "particle slot "},
    {"displacement.y", "particle slot "},
    {"displacement.z", "particle slot "},
    {"contact_begin", "particle slot"},
    {"expired", "particle slot "},
    {"spring_rows.a", "particle slot"},
    {"spring_rows.b", "particle slot"},
    {"spring_rows.stiffness", "particle slot"},
    {"spring_rows.damping", "particle slot"},
    {"spring_rows.rest_length", "particle slot"},
    {"spring_rows.least_extension", "particle slot"},
    {"spring_rows.of_a", "particle slot"},
    {"spring_rows.of_b", "particle slot"},
};
const std::map<std::string, Arrays> kParticleScratch = {
    {"find_contacts",
     {"h", "rate", "contact_softness", "link_softness", "flight_rows", "colliding", "reaches", "pairs", "old_contacts",
      "first_contact", "first_touch", "rows"}},
    {"solve_substeps",
     {"displacement.x", "displacement.y", "displacement.z", "spring_rows.a", "spring_rows.b", "spring_rows.stiffness",
      "spring_rows.damping", "spring_rows.rest_length", "spring_rows.least_extension", "spring_rows.of_a",
      "spring_rows.of_b", "spring_rows.anchors", "springs_yield", "oscillators", "rows"}},
    {"restitution", {"rows"}},
    {"store_impulses", {"contact_begin", "touch_impulses"}},
    {"finalise_particles", {"report"}},
    {"yield_springs", {"yielded"}},
    {"expire_particles", {"expired"}}};

TEST_F(Recorded, EveryArrayOfEveryStageOfParticlesIsNamed) {
  const tool::Input input(file("a", particle_recording<float>(0, 130)));
  inject_everywhere<ParticleWorld<float>>(input, kParticleScratch, kParticleOwners, true);
}
TEST_F(Recorded, EveryArrayOfEveryStageOfParticlesIsNamedInFixedPoint) {
  const tool::Input input(file("a", particle_recording<Q32_32>(6, 130)));
  inject_everywhere<ParticleWorld<Q32_32>>(input, kParticleScratch, kParticleOwners, false);
}

/// Slots that the tool names, from the world itself.
TEST_F(Recorded, OwnersAreThoseOfTheWorld) {
  const std::vector<std::uint8_t> bytes = rigid_recording<float>(SolverName::soft_step, 10);
  const tool::Input input(file("a", bytes));
  const tool::FieldList fields = tool::played_here(input)->fields_at({9, 1, "solve_substeps"});
  const ReplayReader replay(input.bytes);
  World<float> w;
  Reader reader(replay.state());
  ASSERT_TRUE(w.read_portable(reader).ok());
  for (std::uint64_t i = 0; i < 10; ++i) ASSERT_TRUE(w.step_recorded(replay.frame(i).input).ok());
  const auto& [states, properties] = w.state().awake;
  const auto& contacts = w.state().contacts;
  ASSERT_GT(contacts.size(), 8u);
  for (std::size_t i = 0; i < states.size(); ++i) {
    const std::string slot = "body slot " + std::to_string(states[i].slot);
    EXPECT_EQ(tool::owner_of(fields, "bodies[" + std::to_string(i) + "].angular_velocity.z"), slot);
    EXPECT_EQ(tool::owner_of(fields, "solver_velocity[" + std::to_string(i + 1) + "].linear.x"), slot);
  }
  EXPECT_EQ(tool::owner_of(fields, "solver_velocity[0].linear.x"), "") << "what does not move";
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const ContactKey key = contacts[i].key;
    const std::string slots = "body slots " + std::to_string(key.body_a) + " and " + std::to_string(key.body_b);
    EXPECT_EQ(tool::owner_of(fields, "prepared[" + std::to_string(i) + "].normals[0].impulse"), slots);
  }
  const std::string joint = "joint slot " + std::to_string(w.state().joints.states[2].slot);
  EXPECT_EQ(tool::owner_of(fields, "joint_constraints[2].point_impulse.x"), joint);
}

/// A side whose hash of one stage is not that of the fields that it shows.
class OtherHash : public tool::StageSide {
 public:
  OtherHash(const OrderlySide& side, std::size_t point) : side_(side), point_(point) {}
  std::vector<tool::TracePoint> trace() const override {
    std::vector<tool::TracePoint> points = side_.trace();
    points.at(point_).hash ^= 1;
    return points;
  }
  tool::FieldList fields_at(const StagePoint& at) const override { return side_.fields_at(at); }

 private:
  const OrderlySide& side_;
  std::size_t point_;
};
TEST_F(Recorded, AHashThatDiffersWhileNoFieldDoesIsSaidToBeThat) {
  const tool::Input input(file("a", rigid_recording<float>(SolverName::soft_step, 6)));
  const OrderlySide orderly(input);
  const auto points = orderly.trace();
  const auto at = std::find_if(points.begin(), points.end(), [](const tool::TracePoint& point) {
    return point.at == StagePoint{4, 1, "prepare"};
  });
  ASSERT_NE(at, points.end());
  const std::string out = said(input, orderly, OtherHash(orderly, static_cast<std::size_t>(at - points.begin())), 1);
  EXPECT_EQ(out.rfind("frame 4, stage prepare\n  the hashes differ though none of ", 0), 0u) << out;
  EXPECT_EQ(std::count(out.begin(), out.end(), '\n'), 2) << out;
}

/// What is looked at does not depend on this machine's lanes.
TEST_F(Recorded, TracesAreEqualOnAllLanes) {
  const tool::Input rigid(file("a", rigid_recording<float>(SolverName::soft_step, 20)));
  StagedReplay narrow;
  narrow.simd = Simd::scalar;
  EXPECT_EQ(said(rigid, *tool::played_here(rigid), *tool::played_here(rigid, narrow), 0),
            "the same: 20 frames, stage by stage\n");
  const tool::Input particles(file("b", particle_recording<float>(1, 20)));
  EXPECT_EQ(said(particles, *tool::played_here(particles), *tool::played_here(particles, narrow), 0),
            "the same: 20 frames, stage by stage\n");
}

/// A fault that stays is named where it is made, not where it shows: in state it shows some stages later.
TEST_F(Recorded, AFaultThatStaysIsNamedByTheStageThatMadeIt) {
  const tool::Input input(file("a", rigid_recording<float>(SolverName::soft_step, 12)));
  const StageFault fault = {{8, 1, "prepare"}, "prepared[5].normals[0].row.effective_mass", 20};
  StagedReplay how;
  how.fault = &fault;
  const std::string out = said(input, *tool::played_here(input), *tool::played_here(input, how), 1);
  EXPECT_EQ(out.rfind("frame 8, stage prepare\n  prepared[5].normals[0].row.effective_mass: ", 0), 0u) << out;
  EXPECT_NE(out.find("1048576 ulp apart [body slots "), std::string::npos) << out;
  EXPECT_NE(out.find("\n  1 of "), std::string::npos) << out;
}

TEST_F(Recorded, AFaultBetweenStepsIsTheCommandsStage) {
  const tool::Input input(file("a", rigid_recording<double>(SolverName::soft_step, 6)));
  for (const std::uint32_t step : {1u, 2u}) {  // before the frame's step, and after it
    const StageFault fault = {{3, step, "commands"}, "bodies[4].centre.y", 0};
    StagedReplay how;
    how.fault = &fault;
    const std::string out = said(input, *tool::played_here(input), *tool::played_here(input, how), 1);
    const std::string where = step == 1 ? "frame 3, stage commands\n" : "frame 3, stage commands after the step\n";
    EXPECT_EQ(out.rfind(where + "  bodies[4].centre.y: ", 0), 0u) << out;
    EXPECT_NE(out.find("1 ulp apart [body slot "), std::string::npos) << out;
  }
}

TEST_F(Recorded, OtherCommandsAndOtherLengthsAreNamed) {
  std::vector<std::uint8_t> bytes[3];
  std::uint32_t slot = 0;
  for (int i = 0; i < 3; ++i) {
    World<float> w(solver_settings<float>(SolverName::soft_step));
    const SolverScene<float> scene(w);
    slot = scene.bodies()[2].slot;
    WorldRecorder<float> recorder(w, sink_to(bytes[i]));
    ASSERT_TRUE(recorder.begin("stages").ok());
    for (int frame = 0; frame < (i == 2 ? 5 : 7); ++frame) {
      if (i == 1 && frame == 4) w.apply_impulse(scene.bodies()[2], vec<float>(1, 0, 0));
      for (int step = 0; step < (frame == 3 ? 2 : 1); ++step) w.step();
      ASSERT_TRUE(recorder.end_frame().ok());
    }
    ASSERT_TRUE(recorder.finish().ok());
  }
  const std::string a = file("a", bytes[0]), b = file("b", bytes[1]), c = file("c", bytes[2]);
  const std::string other = output(1, {a, b});
  const std::string place = "frame 4, stage commands\n  the commands or steps of this frame differ\n  bodies[";
  EXPECT_EQ(other.rfind(place, 0), 0u) << other;
  EXPECT_NE(other.find("].velocity.x: "), std::string::npos) << other;
  EXPECT_NE(other.find(" apart [body slot " + std::to_string(slot) + "]\n  1 of "), std::string::npos) << other;
  EXPECT_EQ(output(1, {a, c}), "the same as far as both go: 7 and 5 frames\n");
  EXPECT_EQ(output(0, {a}), "the same: 7 frames, stage by stage\n");
  const tool::Input input(a);
  const StageFault fault = {{3, 2, "finalise_bodies"}, "bodies[2].angular_velocity.x", 3};
  StagedReplay how;
  how.fault = &fault;
  EXPECT_EQ(said(input, *tool::played_here(input), *tool::played_here(input, how), 1)
                .rfind("frame 3, step 2 of the frame, stage finalise_bodies\n  bodies[2].angular_velocity.x: ", 0),
            0u);
}

TEST_F(Recorded, FaultsThatCannotBeInjectedAreErrors) {
  const tool::Input input(file("a", rigid_recording<float>(SolverName::soft_step, 3)));
  StageFault fault;
  for (const char* text :
       {"1:prepare:prepared[5].normals[0].row.efective_mass:3", "1:prepare:tick:64", "9:prepare:tick:1",
        "1.3:prepare:tick:1", "1:repair:tick:1", "1:commands:body_slots.first_free:0"}) {
    ASSERT_TRUE(read_stage_fault(text, fault)) << text;
    StagedReplay how;
    how.fault = &fault;
    EXPECT_THROW(tool::played_here(input, how)->trace(), tool::ToolError) << text;
  }
  for (const char* text :
       {"", "1", "1:prepare", "1:prepare:tick", "x:prepare:tick:1", "1.0:prepare:tick:1", "1:prepare:tick:one"}) {
    EXPECT_FALSE(read_stage_fault(text, fault)) << text;
  }
  EXPECT_THROW(tool::played_here(input)->fields_at({1, 1, "repair"}), tool::ToolError);
}

/// Of a path that another program made up.
TEST(FieldOwners, NobodyOwnsWhatIsInNoArray) {
  tool::FieldList fields;
  for (const char* path : {"body_slots.first_free", "bodies[x].slot", "bodies[].slot", "bodies[7", "bodies[7].slot",
                           "bodies[99999999999999999999].slot"}) {
    fields.add({path, kFieldFormat<std::uint32_t>, 3});
    const bool body = std::string_view(path) == "bodies[7].slot";
    EXPECT_EQ(tool::owner_of(fields, path), body ? "body slot 3" : "") << path;
  }
}

}  // namespace diff_stages_test
}  // namespace isostep::test
