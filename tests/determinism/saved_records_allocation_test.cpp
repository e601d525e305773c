// A world with one record of each kind that is told its inputs and saved in every frame asks for no memory once warm.
// SPDX-License-Identifier: MIT

#include "determinism/allocation_count.hpp"
#include "determinism/solver_scene.hpp"
#include "isostep/store/state.hpp"
#include "unit/world/named_by_records.hpp"

namespace isostep::test {
namespace saved_records_allocation_test {

/// The things that records name: two crates that stand on the ground, a capsule and a sensor that are carried, three
/// joints.
template <class S> class OneOfEach {
 public:
  explicit OneOfEach(World<S>& world) : world_(world) {
    world_.create(still<S>(add_box(world_, 20, 0.5, 20), {0, -0.5, 0}));
    const ShapeId crate = add_box(world_, 0.5, 0.5, 0.5), capsule = world_.add_shape(Capsule{0.25, 0.5});
    named_.a = world_.create(moving<S>(crate, {0, 0.5, 0}));
    named_.b = world_.create(moving<S>(crate, {3, 0.5, 0}));
    named_.carried = world_.create(kinematic_at(capsule, {6, 0.75, 0}, false));
    named_.sensor = world_.create(kinematic_at(crate, {9, 0.5, 0}, true));
    named_.create_joints(world_);
#define ISO_ADD(name, Record, Id, S) \
  EXPECT_TRUE(world_.add(named_.template naming<Record>())) << #name << describe(world_.fault());
    ISO_FOR_EACH_RECORD(ISO_ADD, S)
#undef ISO_ADD
  }

  /// Inputs of all records that take one, a step, a save.
  void play(int frame) {
    const WorldState<S>& state = world_.state();
#define ISO_TELL(name, Input, Id, S) tell<Input>(state.records->name##s, frame);
    ISO_FOR_EACH_INPUT(ISO_TELL, S)
#undef ISO_TELL
    world_.step();
    world_.save(saved_);
  }

 private:
  template <class Input, class Record, class Id> void tell(const Registry<Record, Id>& all, int frame) {
    for (std::uint32_t slot = 0; slot < all.all().size(); ++slot) {
      const Id id = all.slot_map().template id_of<Id>(slot);
      if (all.is_taken(slot)) {
        EXPECT_TRUE(world_.set_input(id, input_of<Input>(frame)));
      }
    }
  }
  static BodyDefinition<S> kinematic_at(ShapeId shape, D3 at, bool is_sensor) {
    BodyDefinition<S> body = still<S>(shape, at);
    body.type = BodyType::kinematic;
    body.sensor = is_sensor;
    return body;
  }
  template <class Input> static Input input_of(int frame) {
    Input input;
    if constexpr (requires { input.move; }) input.move = {S(0), S(0), S(frame % 60 < 30 ? 1 : -1)};
    if constexpr (requires { input.throttle; }) input.throttle = S(frame % 60 < 30 ? 1 : -1);
    return input;
  }
  World<S>& world_;
  typename World<S>::Snapshot saved_;
  NamedByRecords<S> named_;
};

template <class S> class SavedRecords : public testing::Test {};
TYPED_TEST_SUITE(SavedRecords, AllocationScalars);

TYPED_TEST(SavedRecords, OneOfEachKindIsSavedInEveryFrameWithoutMemory) {
  using S = TypeParam;
  World<S> world(settings<S>());
  OneOfEach<S> records(world);
  for (int frame = 0; frame < 120; ++frame) records.play(frame);
  const Count count;
  for (int frame = 120; frame < 720; ++frame) records.play(frame);
  EXPECT_EQ(count.so_far(), 0u);
}

}  // namespace saved_records_allocation_test
}  // namespace isostep::test
