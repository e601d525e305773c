// Coarse structures and articulations, once built, ask for no memory.
// SPDX-License-Identifier: MIT

#include "determinism/allocation_count.hpp"
#include "isostep/articulation/articulation.hpp"
#include "isostep/core/random.hpp"
#include "isostep/state/concepts.hpp"
#include "isostep/store/chosen_broad_phase.hpp"

namespace isostep::test {
namespace structure_allocation_test {

/// Four hundred boxes that move, go and come, with all that is asked of a structure after each frame.
template <class S, class Structure> class CoarseFrames {
 public:
  explicit CoarseFrames(std::uint32_t seed) : random_(Pcg32::seeded(seed)) {}

  /// Runs by the same random numbers each time.
  std::size_t run() {
    Pcg32 random = random_;
    structure_.clear();
    pairs_.clear();
    std::size_t found = 0;
    for (int frame = 0; frame < 20; ++frame) {
      for (std::uint32_t slot = 0; slot < 400; ++slot) move(random, slot);
      if (frame % 2 == 0) structure_.optimise();
      pairs_.update(structure_, Any{});
      all_pairs(structure_, all_);
      found += all_.keys.size();
    }
    return found;
  }

 private:
  struct Any {
    bool operator()(std::uint32_t, std::uint32_t) const { return true; }
  };
  void move(Pcg32& random, std::uint32_t slot) {
    const std::uint32_t what = random_below(random, 8);
    if (what > 4) return;
    pairs_.mark_moved(slot);
    if (what == 4 && structure_.contains(slot)) return structure_.remove(slot);
    const S x = S(random_between(random, -50, 50)) * S(0.25);
    const S y = S(random_between(random, -50, 50)) * S(0.25);
    const S z = S(random_between(random, -50, 50)) * S(0.25);
    const S side = slot % 100 == 0 ? S(10) : S(1);
    const Aabb<S> box = {{x, y, z}, {x + side, y + side, z + side}};
    if (structure_.contains(slot)) structure_.update(slot, box);
    else structure_.insert(slot, box);
  }

  Pcg32 random_;
  Structure structure_;
  PairSet<S> pairs_;
  AllPairs<S> all_;
};
template <class S, class Structure> void hold_warm_frames(const char* name) {
  CoarseFrames<S, Structure> frames(3);
  const std::size_t found = frames.run();
  EXPECT_GT(found, 1000u) << name;
  frames.run();  // what a structure builds in a cleared memory may need a little more than in a fresh one
  Count count;
  EXPECT_EQ(frames.run(), found) << name;
  EXPECT_EQ(count.so_far(), 0u) << name;
}
template <class S> class StructureAllocation : public testing::Test {};
TYPED_TEST_SUITE(StructureAllocation, AllocationScalars);

TYPED_TEST(StructureAllocation, AWarmCoarseStructureAsksForNoMemory) {
#define ISO_HOLD(name, Structure) hold_warm_frames<TypeParam, Structure<TypeParam>>(#name);
  ISO_FOR_EACH_BUILT_BROAD_PHASE(ISO_HOLD)
#undef ISO_HOLD
}

template <class S> void run_an_articulation() {
  ArticulationDefinition<S> definition;
  ArticulationLink<S> link;
  link.type = ArticulationJoint::free;
  link.mass.inertia = {S(1), S(1), S(1)};
  definition.links.push_back(link);
  for (const ArticulationJoint type : {ArticulationJoint::ball, ArticulationJoint::hinge, ArticulationJoint::slider}) {
    link.type = type;
    link.parent = static_cast<std::uint32_t>(definition.links.size() - 1);
    link.frame_a.position = {S(0), S(-1), S(0)};
    link.limited = true;
    link.lower = type == ArticulationJoint::ball ? S(0) : S(-0.5);
    link.upper = S(0.5);
    link.drive.damping = link.drive.max_force = S(100);
    link.drive.speed = {S(5), S(5), S(5)};
    definition.links.push_back(link);
  }
  Articulation<S> tree;
  ASSERT_TRUE(tree.build(definition).ok());
  Snapshot<Articulation<S>> kept;
  tree.step();
  tree.save(kept);
  const Count count;
  std::uint64_t hash = 0;
  for (int i = 0; i < 60; ++i) {
    tree.apply_force(2, {S(10), S(0), S(0)}, tree.link_centre(2));
    tree.step();
    if (i == 30) tree.load(kept);
    tree.save(kept);
    hash ^= tree.hash();
  }
  EXPECT_EQ(count.so_far(), 0u);
  EXPECT_NE(hash, 0u);
}
TEST(ArticulationAllocation, ABuiltTreeAsksForNoMemory) {
  run_an_articulation<float>();
  run_an_articulation<double>();
  run_an_articulation<Q32_32>();
}

}  // namespace structure_allocation_test
}  // namespace isostep::test
