// Refusals, reports and files of articulations.
// SPDX-License-Identifier: MIT
#include "isostep/articulation/articulation.hpp"

#include <functional>
#include <string>

#include "isostep/state/composite.hpp"
#include "random/articulation.hpp"

namespace isostep::test {
namespace articulation_test {

/// A game's own state.
struct Nothing {
  std::uint32_t frame = 0;
  ISO_FIELDS(frame)
};

template <class S> class ArticulationOf : public ::testing::Test {
 protected:
  static ArticulationDefinition<S> two_bars() {
    ArticulationDefinition<S> d;
    d.links.push_back(bar<S>(kArticulationBase, {0, 0, 0}, 1, 1));
    d.links.push_back(bar<S>(0, {0, -1, 0}, 1, 1));
    return d;
  }
  static std::string place_of(const ArticulationDefinition<S>& d) {
    Articulation<S> a;
    const Result<void> result = a.build(d);
    EXPECT_EQ(a.links(), result.ok() ? d.links.size() : 0u);
    return result.ok() ? "" : std::string(result.error().place.view());
  }
};
TYPED_TEST_SUITE(ArticulationOf, ArticulatedScalars);

TYPED_TEST(ArticulationOf, a_bad_definition_is_refused_by_the_name_of_its_field) {
  using S = TypeParam;
  using Change = std::function<void(ArticulationDefinition<S>&)>;
  const std::vector<std::pair<std::string, Change>> changes = {
      {"settings.hz", [](auto& d) { d.settings.hz = 5; }},
      {"settings.substeps", [](auto& d) { d.settings.substeps = 65; }},
      {"settings.gravity", [](auto& d) { d.settings.gravity.y = S(2000); }},
      {"settings.base", [](auto& d) { d.settings.base.orientation.w = Unit<S>(0.5); }},
      {"links", [](auto& d) { d.links.clear(); }},
      {"links[1].parent", [](auto& d) { d.links[1].parent = 1; }},
      {"links[0].type", [](auto& d) { d.links[0].type = static_cast<ArticulationJoint>(7); }},
      {"links[1].type", [](auto& d) { d.links[1].type = ArticulationJoint::free; }},
      {"links[1].parent",
       [](auto& d) {
         d.links[0].type = ArticulationJoint::free;
         d.links[1].parent = kArticulationBase;
       }},
      {"links[0].frame_a", [](auto& d) { d.links[0].frame_a.orientation = {}; }},
      {"links[1].frame_b", [](auto& d) { d.links[1].frame_b.position.x = S(0x1p21); }},
      {"links[1].axis",
       [](auto& d) {
         d.links[1].axis = {Unit<S>(0), Unit<S>(0.5), Unit<S>(0)};
       }},
      {"links[0].mass.mass", [](auto& d) { d.links[0].mass.mass = S(0); }},
      {"links[0].mass.centre", [](auto& d) { d.links[0].mass.centre.z = S(0x1p21); }},
      {"links[1].mass.inertia",
       [](auto& d) {
         d.links[1].mass.inertia = {S(1), S(1), S(3)};
       }},
      {"links[1].mass.inertia", [](auto& d) { d.links[1].mass.inertia.y = S(-1); }},
      {"links[1].mass.principal", [](auto& d) { d.links[1].mass.principal.x = Unit<S>(1); }},
      {"links[1].armature", [](auto& d) { d.links[1].armature = S(-1); }},
      {"links[1].damping", [](auto& d) { d.links[1].damping = S(-1); }},
      {"links[1].stiffness", [](auto& d) { d.links[1].stiffness = S(-1); }},
      {"links[1].type",
       [](auto& d) {
         d.links[1].type = ArticulationJoint::fixed;
         d.links[1].damping = S(1);
       }},
      {"links[1].rest", [](auto& d) { d.links[1].rest = S(7); }},
      {"links[1].limited", [](auto& d) { d.links[1].type = ArticulationJoint::slider; }},
      {"links[1].upper", [](auto& d) { d.links[1].limited = true; }},
      {"links[1].upper",
       [](auto& d) {
         d.links[1].type = ArticulationJoint::ball;
         d.links[1].limited = true;
         d.links[1].upper = S(3);
       }},
      {"links[1].drive.max_force", [](auto& d) { d.links[1].drive.max_force = S(-1); }},
      {"links[1].drive.pose", [](auto& d) { d.links[1].drive.pose.x = Unit<S>(1); }},
      {"links[1].drive.target", [](auto& d) { d.links[1].drive.target = S(7); }},
  };
  EXPECT_EQ(this->place_of(this->two_bars()), "");
  for (const auto& [place, change] : changes) {
    ArticulationDefinition<S> d = this->two_bars();
    change(d);
    EXPECT_EQ(this->place_of(d), place);
  }
}

TYPED_TEST(ArticulationOf, a_refused_call_changes_nothing_and_tells_why) {
  using S = TypeParam;
  Articulation<S> a = built(this->two_bars());
  const std::uint64_t hash = a.hash();
  EXPECT_FALSE(a.apply_torque(2, Vec3<S>::zero()));
  EXPECT_EQ(describe(a.fault()), "apply_torque: link: not a valid value; expected a link of the definition");
  EXPECT_FALSE(a.apply_force(0, {S(0x1p30), S(0), S(0)}, Vec3<S>::zero()));
  EXPECT_STREQ(a.fault().field, "force");
  JointCoordinates<S> c;
  c.velocity.x = Limits<S>::speed() + S(1);
  EXPECT_FALSE(a.set_coordinates(0, c));
  EXPECT_STREQ(a.fault().field, "coordinates.velocity");
  ArticulationDrive<S> drive;
  drive.damping = S(-1);
  EXPECT_FALSE(a.set_drive(1, drive));
  EXPECT_STREQ(a.fault().field, "drive");
  EXPECT_EQ(a.hash(), hash);
  EXPECT_TRUE(a.set_drive(1, {}));
}

TEST(Articulation, NumbersThatAreNoneAreRefused) {
  ArticulationDefinition<double> d;
  d.links.push_back(bar<double>(kArticulationBase, {0, 0, 0}, 1, 1));
  const double none = std::nan(""), endless = HUGE_VAL;
  d.links[0].damping = none;
  Articulation<double> a;
  EXPECT_EQ(a.build(d).error().place.view(), "links[0].damping");
  d.links[0].damping = 0;
  d.links[0].axis.x = none;
  EXPECT_EQ(a.build(d).error().place.view(), "links[0].axis");
  d.links[0].axis.x = 0;
  a = built(d);
  EXPECT_FALSE(a.apply_force(0, {none, 0, 0}, {0, 0, 0}));
  EXPECT_FALSE(a.apply_force(0, {1, 0, 0}, {endless, 0, 0}));
  EXPECT_FALSE(a.apply_torque(0, {0, 0, endless}));
  JointCoordinates<double> c;
  c.position.x = none;
  EXPECT_FALSE(a.set_coordinates(0, c));
}

// Frames that are turned and shifted in both links, against the same arm told plainly.
TYPED_TEST(ArticulationOf, frames_say_where_links_are_and_nothing_else) {
  using S = TypeParam;
  ArticulationDefinition<S> plain = this->two_bars(), framed = this->two_bars();
  const Quat<Unit<S>> turn = turn_about<S>({0.6, 0, 0.8}, 0.7);
  for (ArticulationLink<S>& l : framed.links) {
    l.frame_b = {vector<S>({0.25, -0.5, 1}), turn};  // the joint's frame, in links whose frames are elsewhere
    const D33 to_link = to_matrix(doubles(turn));
    l.mass.centre = vector<S>(to_link * doubles(l.mass.centre) + doubles(l.frame_b.position));
    l.mass.principal = turn;
    if (l.parent == 0) {
      l.frame_a.position = vector<S>(to_link * D3{0, -1, 0} + doubles(l.frame_b.position));
      l.frame_a.orientation = turn;
    }
  }
  Articulation<S> a = built(plain), b = built(framed);
  JointCoordinates<S> c;
  c.position.x = number<S>(1.2);
  a.set_coordinates(0, c);
  b.set_coordinates(0, c);
  for (int i = 0; i < 60; ++i) {
    a.step();
    b.step();
  }
  for (std::uint32_t i = 0; i < 2; ++i) {
    EXPECT_LT(size(doubles(a.link_centre(i)) - doubles(b.link_centre(i))), by_scalar<S>(1e-4, 1e-12, 1e-7));
    EXPECT_NEAR(to_double(a.coordinates(i).velocity.x), to_double(b.coordinates(i).velocity.x),
                by_scalar<S>(1e-3, 1e-11, 1e-6));
  }
}

TYPED_TEST(ArticulationOf, velocities_are_the_change_of_poses) {
  using S = TypeParam;
  TreeOptions options;
  for (unsigned seed = 0; seed < 20; ++seed) {
    TreeDice dice(seed);
    options.free = seed % 2 == 0;
    ArticulationDefinition<S> d = dice.tree<S>(options);
    d.settings.hz = 1000;
    d.settings.substeps = 1;
    Articulation<S> a = built(d);
    dice.set_going(a, 1);
    std::vector<D3> before, velocity;
    for (std::uint32_t i = 0; i < a.links(); ++i) before.push_back(doubles(a.link_pose(i).position));
    for (std::uint32_t i = 0; i < a.links(); ++i) velocity.push_back(doubles(a.link_velocity(i).linear));
    a.step();
    for (std::uint32_t i = 0; i < a.links(); ++i) {
      const D3 mean = (velocity[i] + doubles(a.link_velocity(i).linear)) * 0.5;
      const D3 way = (doubles(a.link_pose(i).position) - before[i]) * 1000.0;
      EXPECT_LT(size(way - mean), by_scalar<S>(0.05, 1e-3, 1e-3)) << seed << ' ' << i;
    }
  }
}

TYPED_TEST(ArticulationOf, a_force_at_a_point_is_a_force_and_its_torque) {
  using S = TypeParam;
  ArticulationDefinition<S> d;
  d.settings.gravity = Vec3<S>::zero();
  ArticulationLink<S> l;
  l.type = ArticulationJoint::free;
  l.mass = {S(2), Vec3<S>::zero(), vector<S>({0.5, 0.5, 0.5}), Quat<Unit<S>>::identity()};
  d.links.push_back(l);
  Articulation<S> a = built(d);
  for (int i = 0; i < 60; ++i) {
    ASSERT_TRUE(a.apply_force(0, vector<S>({4, 0, 0}), a.link_centre(0) + vector<S>({0, 0, 0.25})));
    a.step();
  }
  const LinkVelocity<S> v = a.link_velocity(0);
  EXPECT_NEAR(to_double(v.linear.x), 2, 1e-4);
  EXPECT_NEAR(to_double(v.angular.y), 2, 1e-4);
  EXPECT_NEAR(to_double(a.link_pose(0).position.x), 1, 1e-4);
}

TYPED_TEST(ArticulationOf, hostile_bytes_are_refused_or_make_a_sound_tree) {
  using S = TypeParam;
  TreeDice dice(3);
  TreeOptions options;
  options.free = options.limits = options.drives = options.springs = true;
  Articulation<S> a = built(dice.tree<S>(options));
  dice.set_going(a, 1);
  a.step();
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  a.write_portable(writer);
  const std::uint64_t hash = a.hash();
  int taken = 0;
  for (int n = 0; n < 3000; ++n) {
    std::vector<std::uint8_t> changed = bytes;
    const auto at = static_cast<std::size_t>(dice.below(static_cast<int>(changed.size())));
    if (n % 3 == 0) changed.resize(at);
    else changed[at] = static_cast<std::uint8_t>(dice.below(256));
    Articulation<S> read = built(this->two_bars());
    const std::uint64_t before = read.hash();
    Reader reader(changed);
    if (read.read_portable(reader).ok()) {
      ++taken;
      for (int i = 0; i < 3; ++i) read.step();
      for (std::uint32_t i = 0; i < read.links(); ++i) EXPECT_TRUE(is_finite(read.link_pose(i).position));
    } else {
      EXPECT_EQ(read.hash(), before);
    }
  }
  EXPECT_GT(taken, 100);
  EXPECT_EQ(a.hash(), hash);
}

TYPED_TEST(ArticulationOf, it_stands_beside_a_world_in_a_composite) {
  using S = TypeParam;
  Composite<Articulation<S>, Nothing> game;
  ASSERT_TRUE(game.world.build(this->two_bars()).ok());
  Snapshot<Composite<Articulation<S>, Nothing>> kept;
  game.save(kept);
  const std::uint64_t hash = game.hash();
  game.world.apply_torque(0, vector<S>({0, 0, 5}));
  game.world.step();
  EXPECT_NE(game.hash(), hash);
  game.load(kept);
  EXPECT_EQ(game.hash(), hash);
}

TYPED_TEST(ArticulationOf, moved_from_it_is_as_good_as_new) {
  using S = TypeParam;
  Articulation<S> a = built(this->two_bars()), b;
  b = std::move(a);
  EXPECT_EQ(b.links(), 2u);
  EXPECT_EQ(a.links(), 0u);
  a.step();
  EXPECT_EQ(a.tick(), 1u);
  EXPECT_EQ(a.link_pose(0).position, Vec3<S>::zero());
  ASSERT_TRUE(a.build(this->two_bars()).ok());
  EXPECT_EQ(a.hash(), b.hash());
}

}  // namespace articulation_test
}  // namespace isostep::test
