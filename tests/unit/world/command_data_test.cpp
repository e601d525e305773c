// Commands as data: each does what the call does, and returns what it made.
// SPDX-License-Identifier: MIT

#include "isostep/geometry/baked/surface_blob.hpp"
#include "isostep/state/field_table.hpp"
#include "random/record_draw.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace command_data_test {

/// Makes a member such that hardly any rule accepts it.
template <class T> void spoil(T& member) {
  if constexpr (requires { member.generation; }) member = {};
  else if constexpr (std::is_enum_v<T>) member = static_cast<T>(1000);
  else if constexpr (std::is_integral_v<T>) member = 0;
  else if constexpr (requires { member.orientation; }) member.orientation = {};
  else if constexpr (requires { member.w; }) member = {};
  else if constexpr (requires { member.x; }) member.x = -highest<std::remove_reference_t<decltype(member.x)>>();
  else if constexpr (Scalar<T>) member = -highest<T>();
}
/// The record, or its input, with the first of its members spoiled that `refuses(record)` then finds.
template <class Record, class Refuses> Record broken(const Record& record, const Refuses& refuses) {
  for (std::size_t spoiled = 0; spoiled < detail::count_rows<Record>(); ++spoiled) {
    Record other = record;
    std::size_t at = 0;
    Record::fields([&](const char*, auto& member) { at++ == spoiled ? spoil(member) : void(); }, other);
    if (refuses(other)) return other;
  }
  ADD_FAILURE() << "whatever it says, its rules accept it";
  return record;
}
/// Whether the rules refuse a record by itself: a number, or a null id where there has to be one.
template <class Record> bool refuses(const Record& record) {
  bool refused = detail::RecordRules<Record>::fault(record) != Fault::none;
  const auto bodies = detail::bodies_of(record);
  for (int i = 0; i < bodies.count; ++i) refused = refused || (!bodies.all[i].body && !bodies.all[i].may_be_null);
  const auto joints = detail::joints_of(record);
  for (int i = 0; i < joints.count; ++i) refused = refused || (!joints.all[i] && !joints.may_be_null(i));
  return refused;
}

template <class S> class CommandData : public ::testing::Test {};
TYPED_TEST_SUITE(CommandData, AllScalars);

TYPED_TEST(CommandData, commands_given_as_data_do_what_the_calls_do) {
  using S = TypeParam;
  World<S> called(settings<S>()), told(settings<S>());
  const auto both = [&]<class C>(const C& command, auto&& call) {
    constexpr int kNumber = detail::kNumberOf<C, EveryCommand<S>>;
    const bool a = static_cast<bool>(call(called)), b = static_cast<bool>(told.apply(command));
    EXPECT_EQ(a, b) << kNumber;
    EXPECT_EQ(called.fault(), told.fault());
    EXPECT_EQ(called.hash(), told.hash()) << kNumber;
    return a;
  };
  const Child<S> ball = {primitive_of(Sphere<S>{num<S>(0.5)}), Pose<S>::identity()};
  EXPECT_TRUE(both(AddShape<S>{{ball}}, [&](auto& w) { return w.add_shape(std::span<const Child<S>>(&ball, 1)); }));
  EXPECT_TRUE(both(AddShape<S>{{ball, ball}}, [&](auto& w) {
    const Child<S> two[] = {ball, ball};
    return w.add_shape(std::span<const Child<S>>(two));
  }));
  const ShapeId shape = {0, 1};
  const BodyDefinition<S> d = moving<S>(shape, {0, 2, 0}, {1, 0, 0}), e = moving<S>(shape, {0, 4, 0});
  EXPECT_TRUE(both(CreateBody<S>{d}, [&](auto& w) { return w.create(d); }));
  EXPECT_TRUE(both(CreateBody<S>{e}, [&](auto& w) { return w.create(e); }));
  const BodyId a = called.bodies()[0], b = called.bodies()[1];
  EXPECT_TRUE(both(RemoveShape{{1, 1}}, [](auto& w) { return w.remove_shape({1, 1}); }));
  EXPECT_FALSE(both(RemoveShape{shape}, [&](auto& w) { return w.remove_shape(shape); }));
  EXPECT_TRUE(both(WakeBody{a}, [&](auto& w) { return w.wake(a); }));
  const Pose<S> pose = {vec<S>(1, 2, 3), turn<S>({0, 1, 0}, 1)};
  EXPECT_TRUE(both(SetPose<S>{a, pose}, [&](auto& w) { return w.set_pose(a, pose); }));
  const Vec3<S> v = vec<S>(1, -2, 3), u = vec<S>(0.5, 0.25, -1);
  EXPECT_TRUE(both(SetVelocity<S>{a, v, u}, [&](auto& w) { return w.set_velocity(a, v, u); }));
  EXPECT_TRUE(both(ApplyForce<S>{a, v, u}, [&](auto& w) { return w.apply_force(a, v, u); }));
  EXPECT_TRUE(both(ApplyImpulse<S>{a, v, u}, [&](auto& w) { return w.apply_impulse(a, v, u); }));
  Material<S> material;
  material.friction = num<S>(0.25);
  EXPECT_TRUE(both(SetMaterial<S>{a, material}, [&](auto& w) { return w.set_material(a, material); }));
  EXPECT_TRUE(both(SetFilter{a, {2, 3, 4}}, [&](auto& w) { return w.set_filter(a, {2, 3, 4}); }));
  EXPECT_TRUE(both(SetMotion<S>{a, S(1), S(1), S(2), body_flag::kLockX},
                   [&](auto& w) { return w.set_motion(a, S(1), S(1), S(2), body_flag::kLockX); }));
  EXPECT_TRUE(both(SetUserData{a, 9}, [&](auto& w) { return w.set_user_data(a, 9); }));
  EXPECT_TRUE(both(SetGravity<S>{u}, [&](auto& w) { return w.set_gravity(u); }));
  JointProperties<S> joint = called.joint_at(JointType::ball, a, b, pose);
  EXPECT_TRUE(both(CreateJoint<S>{joint}, [&](auto& w) { return w.create(joint); }));
  joint.user_data = 3;
  EXPECT_TRUE(both(SetJoint<S>{{0, 1}, joint}, [&](auto& w) { return w.set_joint({0, 1}, joint); }));
  called.step();
  told.step();
  EXPECT_TRUE(both(DestroyJoint{{0, 1}}, [](auto& w) { return w.destroy(JointId{0, 1}); }));
  EXPECT_TRUE(both(DestroyBody{a}, [&](auto& w) { return w.destroy(a); }));
  EXPECT_FALSE(both(DestroyBody{a}, [&](auto& w) { return w.destroy(a); }));
  const std::vector<std::int16_t> heights(9, 0), one = {5};
  const BlobRef field = height_field_blob(height_field({10, 0, 3, 3, 512}, heights, {}).value());
  const ShapeId ground = called.add_shape(field);
  EXPECT_EQ(told.add_shape(field), ground);
  EXPECT_TRUE(both(SetHeights{ground, 0, 1, 1, 1, 1, one}, [&](auto& w) {
    return w.set_heights(ground, 0, {1, 1, 1, 1, one});
  }));
  EXPECT_FALSE(both(SetHeights{ground, 1, 1, 1, 1, 1, one}, [&](auto& w) {
    return w.set_heights(ground, 1, {1, 1, 1, 1, one});
  }));
  EXPECT_TRUE(both(SleepBody{b}, [&](auto& w) { return w.sleep(b); }));
  const BodyMass<S> heavy = {S(1), S(4), Vec3<S>::zero()};
  EXPECT_TRUE(both(SetMass<S>{b, heavy}, [&](auto& w) { return w.set_mass(b, heavy); }));
  EXPECT_TRUE(both(SetEnabled{b, 0}, [&](auto& w) { return w.set_enabled(b, false); }));
  EXPECT_TRUE(both(SetEnabled{b, 1}, [&](auto& w) { return w.set_enabled(b, true); }));
  EXPECT_TRUE(both(SetType<S>{b, kinematic}, [&](auto& w) { return w.set_type(b, kinematic); }));
  EXPECT_TRUE(both(MoveTo<S>{b, pose}, [&](auto& w) { return w.move_to(b, pose); }));
  EXPECT_TRUE(both(SetType<S>{b, dynamic, heavy}, [&](auto& w) { return w.set_type(b, dynamic, heavy); }));
  EXPECT_TRUE(both(SetShape<S>{b, shape, heavy}, [&](auto& w) { return w.set_shape(b, shape, heavy); }));
  EXPECT_FALSE(both(SetShape<S>{b, {9, 1}, heavy}, [&](auto& w) { return w.set_shape(b, {9, 1}, heavy); }));
  EXPECT_FALSE(both(MoveTo<S>{b, pose}, [&](auto& w) { return w.move_to(b, pose); }));

  const S low = S(1), high = S(2);
  EXPECT_FALSE(both(SetWheelSpin<S>{{0, 1}, high}, [&](auto& w) { return w.set_spin({0, 1}, high); })) << "gone";
  WheelSettings<S> wheel;
  wheel.body = b;
  wheel.radius = high;
  const WheelId spun = called.add(wheel);
  ASSERT_EQ(told.apply(AddRecord<WheelSettings<S>>{wheel}), spun);
  EXPECT_TRUE(both(SetWheelSpin<S>{spun, high}, [&](auto& w) { return w.set_spin(spun, high); }));
  EXPECT_EQ(called.state(spun)->spin, high);
  const S most = Limits<S>::speed();
  EXPECT_FALSE(both(SetWheelSpin<S>{spun, most}, [&](auto& w) { return w.set_spin(spun, most); }));
  EXPECT_TRUE(both(RemoveRecord<WheelId>{spun}, [&](auto& w) { return w.remove(spun); }));
  const auto joined = [&](JointType type, double x) {
    const Pose<S> frame = {vec<S>(x, 0, 0), Quat<Unit<S>>::identity()};
    const JointProperties<S> made = called.joint_at(type, {}, b, frame);
    EXPECT_TRUE(both(CreateJoint<S>{made}, [&](auto& world) { return world.create(made); }));
    return called.joints().back();
  };
  const JointId hinge = joined(JointType::hinge, 0);
  EXPECT_TRUE(both(SetJointLimits<S>{hinge, -low, low}, [&](auto& w) { return w.set_limits(hinge, -low, low); }));
  EXPECT_FALSE(both(SetJointLimits<S>{hinge, high, low}, [&](auto& w) { return w.set_limits(hinge, high, low); }));
  EXPECT_TRUE(both(SetJointMotor<S>{hinge, low, high}, [&](auto& w) { return w.set_motor(hinge, low, high); }));
  EXPECT_FALSE(both(SetJointMotor<S>{hinge, low, -high}, [&](auto& w) { return w.set_motor(hinge, low, -high); }));
  EXPECT_TRUE(both(SetJointSpring<S>{hinge, high, low}, [&](auto& w) { return w.set_spring(hinge, high, low); }));
  EXPECT_FALSE(both(SetJointSpring<S>{hinge, high, -low}, [&](auto& w) { return w.set_spring(hinge, high, -low); }));
  EXPECT_TRUE(both(SetJointTarget<S>{hinge, low}, [&](auto& w) { return w.set_target(hinge, low); }));
  EXPECT_FALSE(both(SetJointTarget<S>{{9, 1}, low}, [&](auto& w) { return w.set_target({9, 1}, low); }));
}

#define ISO_COUNT(name, Record, Id, S) +1
constexpr std::size_t kRecordCommands =
    0 ISO_FOR_EACH_RECORD(ISO_COUNT, float) ISO_FOR_EACH_RECORD(ISO_COUNT, float) ISO_FOR_EACH_RECORD(ISO_COUNT, float)
        ISO_FOR_EACH_INPUT(ISO_COUNT, float);
#undef ISO_COUNT
static_assert(EveryCommand<float>::kCount == 29 + kRecordCommands, "a command more: test it above");

/// Two worlds of bodies and joints for every kind of record, of which one is told by calls, one by commands as data.
template <class S> class ToldRecords {
 public:
  ToldRecords() {
    for (World<S>* w : {&called_, &told_}) {
      const ShapeId ball = add_ball(*w, 0.5);
      std::vector<BodyId> bodies;
      for (int i = 0; i < 3; ++i) bodies.push_back(w->create(moving<S>(ball, {2.0 * i, 2, 0})));
      BodyDefinition<S> carried = still<S>(ball, {0, 20, 0});
      carried.type = BodyType::kinematic;
      w->create(carried);
      carried.sensor = true;
      w->create(carried);
      const auto join = [&](JointType type, BodyId a, BodyId to) {
        w->create(w->joint_at(type, a, to, {vec<S>(1, 2, 0), Quat<Unit<S>>::identity()}));
      };
      for (const BodyId body : bodies) join(JointType::slider, {}, body);
      for (std::size_t i = 1; i < bodies.size(); ++i) join(JointType::six_axis, bodies[0], bodies[i]);
    }
  }
  /// Adds, changes and removes one of the kind, and what its rules refuse.
  template <class Record, class IdType> void tell_of(const char* name) {
    Record record = drawn<Record>();
    int tries = 0;
    while (!both(AddRecord<Record>{record}, [&](auto& w) { return w.add(record); }) && ++tries < 8000)
      record = drawn<Record>();
    const std::vector<IdType> ids =
        detail::registry_of(*called_.state().records, IdType{}).slot_map().template ids<IdType>();
    ASSERT_EQ(ids.size(), 1u) << "no world takes a " << name << " of random values";
    const IdType id = ids[0];
    const Record bad = broken(record, [](const Record& r) { return refuses(r); });
    EXPECT_FALSE(both(AddRecord<Record>{bad}, [&](auto& w) { return w.add(bad); })) << name;
    EXPECT_FALSE(both(SetRecordOf<Record>{id, bad}, [&](auto& w) { return w.set(id, bad); })) << name;
    EXPECT_TRUE(both(SetRecordOf<Record>{id, record}, [&](auto& w) { return w.set(id, record); })) << name;
    EXPECT_NE(called_.find(id), nullptr);
    if constexpr (requires { detail::inputs_of(called_.state().parts, id); }) tell_input<Record>(id);
    EXPECT_TRUE(both(RemoveRecord<IdType>{id}, [&](auto& w) { return w.remove(id); })) << name;
    EXPECT_FALSE(both(RemoveRecord<IdType>{id}, [&](auto& w) { return w.remove(id); })) << name;
    EXPECT_FALSE(both(SetRecordOf<Record>{id, record}, [&](auto& w) { return w.set(id, record); })) << name;
    EXPECT_EQ(called_.find(id), nullptr);
    called_.step();
    told_.step();
    EXPECT_EQ(called_.hash(), told_.hash()) << name;
  }

 private:
  template <class Record> Record drawn() {
    Record record;
    RecordDraw<S>(called_, dice_).draw(record);
    return record;
  }
  template <class Record, class IdType> void tell_input(IdType id) {
    using Rules = detail::RecordRules<Record>;
    using Input = std::remove_cvref_t<decltype(detail::inputs_of(called_.state().parts, id)[0])>;
    Input input;
    RecordDraw<S> random(called_, dice_);
    if constexpr (requires { Rules::draw(input, random); }) Rules::draw(input, random);
    EXPECT_TRUE(both(SetInputOf<Input>{id, input}, [&](auto& w) { return w.set_input(id, input); }));
    const Input bad = broken(input, [](const Input& i) { return Rules::fault(i) != Fault::none; });
    EXPECT_FALSE(both(SetInputOf<Input>{id, bad}, [&](auto& w) { return w.set_input(id, bad); }));
    const IdType stale = {id.slot, id.generation + 1};
    EXPECT_FALSE(both(SetInputOf<Input>{stale, input}, [&](auto& w) { return w.set_input(stale, input); }));
  }
  template <class C, class Call> bool both(const C& command, const Call& call) {
    const bool a = static_cast<bool>(call(called_)), b = static_cast<bool>(told_.apply(command));
    EXPECT_EQ(a, b);
    EXPECT_EQ(called_.fault(), told_.fault());
    EXPECT_EQ(called_.hash(), told_.hash());
    return a;
  }

  World<S> called_{settings<S>()}, told_{settings<S>()};
  Dice dice_{17};
};

TYPED_TEST(CommandData, records_of_every_kind_are_added_changed_told_and_removed) {
  using S = TypeParam;
  ToldRecords<S> worlds;
#define ISO_TELL(name, Record, Id, S) worlds.template tell_of<Record, Id>(#name);
  ISO_FOR_EACH_RECORD(ISO_TELL, S)
#undef ISO_TELL
}

TYPED_TEST(CommandData, a_command_returns_what_it_made) {
  using S = TypeParam;
  World<S> w(settings<S>());
  const Child<S> ball = {primitive_of(Sphere<S>{num<S>(0.5)}), Pose<S>::identity()};
  const ShapeId shape = w.apply(AddShape<S>{{ball}});
  EXPECT_TRUE(w.contains(shape));
  const BodyId body = w.apply(CreateBody<S>{moving<S>(shape, {0, 2, 0})});
  EXPECT_TRUE(w.contains(body));
  const JointId joint = w.apply(CreateJoint<S>{w.joint_at(JointType::ball, {}, body, Pose<S>::identity())});
  EXPECT_TRUE(w.contains(joint));
  EXPECT_TRUE(w.apply(DestroyBody{body}));
  EXPECT_FALSE(w.apply(CreateBody<S>{moving<S>({7, 1}, {0, 2, 0})}));
  EXPECT_STREQ(w.fault().command, "create_body");
}

}  // namespace command_data_test
}  // namespace isostep::test
