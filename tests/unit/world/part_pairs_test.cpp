// PartPairs alone: which parts of two bodies are looked at.
// SPDX-License-Identifier: MIT

#include "isostep/systems/contacts/part_pairs.hpp"

#include <array>
#include <map>
#include <utility>

#include "random/dice.hpp"
#include "unit/world/systems.hpp"

namespace isostep::test {
namespace part_pairs_test {

template <class S> class PartPairsOf : public ::testing::Test {
 protected:
  PartPairsOf() : world(settings<S>(0)) {}

  /// Gathers the pairs of the world as it is now. Returns how many pairs of compounds lack parts.
  std::uint32_t gather() {
    systems = std::make_unique<Systems<S>>(world);
    systems->find_pairs();
    pairs = std::make_unique<PartPairs<S>>(systems->state, systems->map);
    pairs->begin();
    for (std::size_t i = 0; i < systems->state.awake.states.size(); ++i) pairs->frame_awake_body(i);
    return pairs->gather(systems->proxies.pairs());
  }
  std::size_t parts() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < pairs->groups(); ++i) count += pairs->group(i).parts.size();
    return count;
  }
  /// Adds so many small boxes in a row from the origin on.
  ShapeId add_row(int count, double apart = 1) {
    std::vector<Child<S>> children;
    for (int i = 0; i < count; ++i) {
      const Pose<S> pose = {vec<S>(apart * i, 0, 0), Quat<Unit<S>>::identity()};
      children.push_back({primitive_of(Box<S>{vec<S>(0.25, 0.25, 0.25)}), pose});
    }
    return world.add_shape(std::span<const Child<S>>(children));
  }

  World<S> world;
  std::unique_ptr<Systems<S>> systems;
  std::unique_ptr<PartPairs<S>> pairs;
};
TYPED_TEST_SUITE(PartPairsOf, SystemScalars);

TYPED_TEST(PartPairsOf, plain_bodies_have_a_frame_each_and_a_list_by_their_kinds) {
  using S = TypeParam;
  World<S>& w = this->world;
  const ShapeId ball = add_ball(w, 0.5), box = add_box(w, 0.5, 0.5, 0.5);
  for (const ShapeId shape : {ball, ball, box, box}) w.create(moving<S>(shape, {0, 0, 0}));
  EXPECT_EQ(this->gather(), 0u);
  ASSERT_EQ(this->pairs->groups(), 1u);
  const PartGroup group = this->pairs->group(0);
  EXPECT_EQ(this->pairs->frames().size(), 4u);
  EXPECT_EQ(group.parts.size(), 6u);
  EXPECT_EQ(group.spheres.size(), 1u);
  EXPECT_EQ(group.boxes.size(), 1u);
  EXPECT_EQ(group.others.size(), 4u);
}

TYPED_TEST(PartPairsOf, a_joint_keeps_its_bodies_from_colliding_unless_it_says_otherwise) {
  using S = TypeParam;
  World<S>& w = this->world;
  const ShapeId ball = add_ball(w, 0.5);
  const BodyId a = w.create(moving<S>(ball, {0, 0, 0})), b = w.create(moving<S>(ball, {0.5, 0, 0}));
  const JointId joint = w.create(w.joint_at(JointType::ball, a, b, Pose<S>::identity()));
  ASSERT_TRUE(joint);
  this->gather();
  EXPECT_EQ(this->parts(), 0u);
  JointProperties<S> collides = *w.joint(joint);
  collides.flags |= joint_flag::kCollideConnected;
  ASSERT_TRUE(w.destroy(joint));
  ASSERT_TRUE(w.create(collides));
  this->gather();
  EXPECT_EQ(this->parts(), 1u);
}

TYPED_TEST(PartPairsOf, of_compounds_only_parts_that_are_near_each_other_pair_and_groups_have_256) {
  using S = TypeParam;
  World<S>& w = this->world;
  const ShapeId row = this->add_row(300);
  w.create(moving<S>(row, {0, 0, 0}));
  w.create(moving<S>(row, {0, 0.25, 0}));
  EXPECT_EQ(this->gather(), 0u);
  EXPECT_EQ(this->parts(), 300u);
  ASSERT_EQ(this->pairs->groups(), 2u);
  EXPECT_EQ(this->pairs->group(0).parts.size(), PartGroup::kEnough);
  EXPECT_EQ(this->pairs->group(1).others.size(), 44u);
}

/// A heap of boxes, spheres and capsules that are turned every way.
template <class S> ShapeId add_heap(World<S>& w, Dice& dice, int parts) {
  std::vector<Child<S>> children;
  for (int i = 0; i < parts; ++i) {
    const double a = dice.in(0.1, 0.4), b = dice.in(0.1, 0.4);
    const Primitive<S> shape = i % 3 == 0   ? primitive_of(Sphere<S>{num<S>(a)})
                               : i % 3 == 1 ? primitive_of(Capsule<S>{num<S>(a), num<S>(b)})
                                            : primitive_of(Box<S>{vec<S>(a, b, 0.2)});
    children.push_back({shape, {vec<S>(dice.point(2)), dice.orientation<S>()}});
  }
  return w.add_shape(std::span<const Child<S>>(children));
}

TYPED_TEST(PartPairsOf, trees_of_many_children_find_what_a_search_of_all_finds) {
  using S = TypeParam;
  Dice dice(5);
  std::size_t found = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const double far = trial % 3 == 0 ? 0 : trial % 3 == 1 ? 900 : to_double(Limits<S>::position()) * 0.5;
    this->world = World<S>(settings<S>(0));
    for (const int parts : {1, 4, 40, 90}) {
      BodyDefinition<S> d = moving<S>(add_heap(this->world, dice, parts), D3{far, -far, 0.5 * far} + dice.point(1.5));
      d.orientation = dice.orientation<S>();
      ASSERT_TRUE(this->world.create(d)) << describe(this->world.fault());
    }
    const auto gathered = [&](bool trees) {
      for (std::uint32_t slot = 0; !trees && slot < this->systems->state.shapes.size(); ++slot) {
        auto bare = std::make_shared<StoredShape<S>>(*this->systems->state.shapes[slot]);
        bare->tree = nullptr;
        this->systems->state.shapes.change(slot) = bare;
      }
      PartPairs<S> finder(this->systems->state, this->systems->map);
      finder.begin();
      for (std::size_t i = 0; i < this->systems->state.awake.states.size(); ++i) finder.frame_awake_body(i);
      EXPECT_EQ(finder.gather(this->systems->proxies.pairs()), 0u);
      std::vector<std::array<std::uint32_t, 4>> list;
      for (std::size_t g = 0; g < finder.groups(); ++g) {
        for (const PartPair& p : finder.group(g).parts) list.push_back({p.frame_a, p.frame_b, p.child_a, p.child_b});
      }
      return list;
    };
    this->systems = std::make_unique<Systems<S>>(this->world);
    this->systems->find_pairs();
    const auto by_trees = gathered(true), by_all = gathered(false);
    ASSERT_EQ(by_trees, by_all) << trial;
    found += by_all.size();
  }
  EXPECT_GT(found, 4000u);
}

TYPED_TEST(PartPairsOf, beyond_the_budget_every_pair_of_compounds_gets_the_same_share) {
  using S = TypeParam;
  static_assert(kLeastPairs == 64);
  struct Case {
    int children;
    double apart;  // [m]
    std::size_t share;
  };
  // 64 * 64 comparisons and 64 * 2 parts for three pairs.
  const Case cases[] = {{100, 1, 42},  // of 100 pairs of likes
                        {36, 0, 42}};  // of 1296 pairs of parts in one place
  for (const Case& each : cases) {
    Settings<S> few = settings<S>(0);
    few.most_pairs = kLeastPairs;
    this->world = World<S>(few);
    const ShapeId row = this->add_row(each.children, each.apart);
    for (int i = 0; i < 3; ++i) this->world.create(moving<S>(row, {0, 0.125 * i, 0}));
    EXPECT_EQ(this->gather(), 3u);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> parts;  // by frames
    for (std::size_t g = 0; g < this->pairs->groups(); ++g) {
      for (const PartPair& pair : this->pairs->group(g).parts) ++parts[{pair.frame_a, pair.frame_b}];
    }
    EXPECT_EQ(parts.size(), 3u);
    for (const auto& [pair, count] : parts) EXPECT_EQ(count, each.share) << pair.first << " " << pair.second;
  }
}

}  // namespace part_pairs_test
}  // namespace isostep::test
