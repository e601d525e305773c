// Every call that computes, made while the caller's float environment is not as IEEE 754 starts out: the same answers.
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "determinism/hostile_environment.hpp"
#include "isostep/geometry/baked/hull_blob.hpp"
#include "isostep/geometry/baked/surface_blob.hpp"
#include "isostep/isostep.hpp"
#include "unit/world/worlds.hpp"

#if defined(ISOSTEP_HOSTILE_ENVIRONMENTS)

namespace isostep::test {
namespace rounding_modes_test {

/// The answers by the names of the calls. A struct with padding is taken apart into numbers.
struct Answers {
  std::vector<std::pair<const char*, std::uint64_t>> all;

  void hash(const char* call, std::uint64_t value) { all.emplace_back(call, value); }
  template <class S> void number(const char* call, S x) { all.emplace_back(call, std::uint64_t(to_bits(x))); }
  template <class T> void vector(const char* call, Vec3<T> v) {
    for (int i = 0; i < 3; ++i) number(call, v[i]);
  }
  template <class U> void turn(const char* call, Quat<U> q) {
    for (const U x : {q.x, q.y, q.z, q.w}) number(call, x);
  }
  template <class T> void matrix(const char* call, const Mat3<T>& m) {
    for (const Vec3<T>& row : m.rows) vector(call, row);
  }
};

/// Arguments are made before the environment changes: of usual numbers, and of some that are hardly above zero.
template <class S> struct Arguments {
  using U = Unit<S>;
  S a, b, c, d;
  U part;
  Vec3<S> v, w, up;
  Vec3<U> n, m;
  Quat<U> p, q;
  Mat3<S> matrix;
  S many;          // [rad] more than a turn
  Mat3<U> turned;  // by p

  explicit Arguments(bool tiny) {
    const S size = tiny ? resolution<S>() * S(11) : S(1);
    a = S(0.7) * size, b = S(1.9) * size, c = S(0.3) * size, d = S(2.3) * size;
    part = tiny ? resolution<U>() * U(1) : U(0.37);
    v = {a, -b, c}, w = {c, d, -a}, up = {S(0), S(1), S(0)};
    n = {U(0.6), U(0), U(0.8)}, m = {U(0), U(-0.8), U(0.6)};
    p = isostep::normalise(Quat<U>{U(0.1), U(0.2), U(0.3), U(0.9)});
    q = isostep::normalise(Quat<U>{U(-0.5), U(0.2), U(0.7), U(0.1)});
    many = S(7.3) + a;
    turned = to_matrix(p);
    matrix = {{{a, b, c}, {-b, d, a}, {c, a, b}}};
  }
};

template <class S> void ask_mathematics(const Arguments<S>& x, Answers& to) {
  using U = Unit<S>;
  to.number("determinant", determinant(x.matrix)), to.matrix("inverse_of", inverse_of(x.matrix).inverse);
  to.vector("inverse_of affine", inverse_of(Affine<S>{x.matrix, x.v}).inverse.position);
  to.number("wrap_angle", wrap_angle(x.many)), to.number("angle_difference", angle_difference(x.a, x.b));
  to.number("lerp_angle", lerp_angle(x.a, x.d, x.part)), to.number("turn_towards", turn_towards(x.a, x.b, x.c));
  to.number("to_degrees", to_degrees(x.a)), to.number("to_radians", to_radians(x.a));
  to.number("lerp", lerp(x.a, x.b, x.part)), to.vector("lerp of vectors", lerp(x.v, x.w, x.part));
  to.number("inverse_lerp", inverse_lerp<S>(x.c, x.b, x.a));
  to.number("smooth_step", smooth_step(x.part)), to.number("smoother_step", smoother_step(x.part));
  const S coefficients[] = {x.a, x.b, x.c};
  to.number("polynomial", polynomial(std::span<const S>(coefficients), x.d));
  to.number("hermite", hermite(x.a, x.b, x.c, x.d, x.part));
  to.number("hermite_slope", hermite_slope(x.a, x.b, x.c, x.d, x.part));
  to.number("catmull_rom", catmull_rom(x.a, x.b, x.c, x.d, x.part)),
      to.number("bezier", bezier(x.a, x.b, x.c, x.d, x.part));
  to.vector("hermite of vectors", hermite(x.v, x.w, x.w, x.v, x.part));
  to.vector("hermite_slope of vectors", hermite_slope(x.v, x.w, x.w, x.v, x.part));
  to.vector("catmull_rom of vectors", catmull_rom(x.v, x.w, x.up, x.v, x.part));
  to.vector("bezier of vectors", bezier(x.v, x.w, x.up, x.v, x.part));
  to.turn("rotation_of", rotation_of(EulerOrder::xyz, x.a, x.b, x.c));
  to.number("euler_angles_of", euler_angles_of<S>(EulerOrder::zyx, x.p).second);
  to.matrix("basis_of", basis_of(x.v, x.w).to_world),
      to.matrix("change_of_basis", change_of_basis<S>(x.turned, x.matrix));
  to.number("value_noise", value_noise(x.v, 3u)), to.number("gradient_noise", gradient_noise(x.v, 3u));
  to.number("fractal_noise", fractal_noise(x.v, 3u, 4));
  to.number("axis_angle_of", axis_angle_of<S>(x.p).angle), to.vector("rotation_vector_of", rotation_vector_of<S>(x.p));
  to.turn("rotation_by", rotation_by(x.v)), to.turn("look_rotation", look_rotation(x.v, x.up));
  to.number("angle_between turns", angle_between<S>(x.p, x.q)), to.turn("to_quaternion", to_quaternion(x.turned));
  to.turn("rotation_between", rotation_between(x.n, x.m)), to.turn("slerp", slerp(x.p, x.q, x.part));
  to.turn("nlerp", nlerp(x.p, x.q, x.part)), to.turn("swing_twist_of", swing_twist_of(x.p, x.n).swing);
  to.vector("clamp_length", clamp_length(x.v, x.c)), to.vector("move_towards", move_towards(x.v, x.w, x.c));
  to.vector("project_on_line", project_on_line<S>(x.v, x.n)),
      to.vector("project_on_plane", project_on_plane<S>(x.v, x.n));
  to.vector("reflect", reflect<S>(x.v, x.n)), to.number("angle_between", angle_between(x.v, x.w));
  to.number("signed_angle", signed_angle(x.v, x.w, x.up));
  const auto draw = [&](auto random) {
    to.number("random_normal", random_normal<S>(random)), to.vector("random_direction", random_direction<S>(random));
    to.vector("random_in_ball", random_in_ball(random, x.b)), to.vector("random_in_disc", random_in_disc(random, x.b));
    to.vector("random_in_box", random_in_box(random, -x.up, x.up)),
        to.turn("random_rotation", random_rotation<S>(random));
  };
  draw(Pcg32::seeded(5)), draw(Lcg{5});
  to.number("sin", sin(x.a)), to.number("cos", cos(x.a)), to.number("atan2", atan2(x.a, x.b));
  to.number("asin", asin(S(0.25))), to.number("acos", acos(S(0.25))), to.number("exp", exp(-x.b)),
      to.number("log", log(x.b));
  static_assert(sizeof(U) > 0);
}

template <class S> void ask_masses(const Arguments<S>& x, Answers& to) {
  const auto tensor = [&](const char* call, const MassTensor<S>& t) {
    to.number(call, t.mass), to.vector(call, t.centre), to.matrix(call, t.tensor);
  };
  const MassTensor<S> solid = MassTensor<S>::tetrahedron(x.d, x.v, x.w, x.up, -x.v);
  tensor("MassTensor::tetrahedron", solid), tensor("MassTensor::placed", solid.placed({x.w, x.p}));
  to.matrix("MassTensor::about", solid.about(x.w));
  tensor("MassTensor::joined", solid.joined(MassTensor<S>::point(x.a, x.w)));
  to.turn("MassTensor::properties", solid.properties().principal);
  const Quat<Unit<S>> long_turn = {Unit<S>(0.1), Unit<S>(0.2), Unit<S>(0.3), Unit<S>(0.9)};
  to.turn("normalised", normalised(Child<S>{primitive_of(Sphere<S>{S(1)}), {x.v, long_turn}}).pose.orientation);
  const Child<S> parts[] = {{primitive_of(Box<S>{{x.a, x.b, x.c}}), {x.v, x.p}},
                            {primitive_of(Sphere<S>{x.a}), {x.w, x.q}}};
  const MassProperties<S> both = mass_properties<S>(parts, S(3));
  to.number("mass_properties", both.mass), to.vector("mass_properties", both.kappa),
      to.turn("mass_properties", both.principal);
}

inline std::uint64_t digest(const Result<BlobRef>& blob) {
  EXPECT_TRUE(blob.ok());
  return blob.ok() ? hash_bytes(blob.value()->bytes().data(), blob.value()->bytes().size()) : 0;
}
/// Shapes that are baked from numbers of doubles.
struct Baked {
  std::vector<Vec3<double>> points;
  std::vector<double> heights;
  std::vector<GridPoint> cloud;

  Baked() {
    for (int i = 0; i < 5; ++i) {
      for (int k = 0; k < 5; ++k) {
        points.push_back({i * 1.1, (i * 7 + k * 3) % 4 * 0.13, k * 0.9});
        heights.push_back((i * 5 + k * 3) % 7 * 0.07);
      }
    }
    Pcg32 random = Pcg32::seeded(9);
    const auto place = [&] { return random_between(random, -90000, 90000); };
    for (int i = 0; i < 300; ++i) {
      const int px = place(), py = place(), pz = place();
      cloud.push_back({px, py, pz});
    }
  }
  std::vector<MeshTriangle> triangles() const {
    std::vector<MeshTriangle> all;
    for (std::uint32_t i = 0; i < 4; ++i) {
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t p = 5 * i + k;
        all.push_back({{p, p + 1, p + 6}}), all.push_back({{p, p + 6, p + 5}});
      }
    }
    return all;
  }
};
void ask_baking(const Baked& x, Answers& to) {
  to.hash("mesh_blob", digest(mesh_blob(x.points, x.triangles())));
  to.hash("height_field_blob", digest(height_field_blob({5, 5, 1.3}, x.heights)));
  const Result<std::vector<GridPoint>> fewer = simplified(x.cloud, 40);
  ASSERT_TRUE(fewer.ok());
  const Result<BlobRef> hull = hull_blob(fewer.value(), 16);
  to.hash("simplified, hull_blob", digest(hull));
  to.hash("instance_of", digest(instance_of(*hull.value(), {.mirror_x = true})));
  const Result<SurfaceMaterial> ice = surface_material(0.07, 0.31);
  to.hash("surface_material", ice.ok() ? ice.value().friction * 4096u + ice.value().restitution : 0);
}

template <class S> void ask_particles(Answers& to) {
  const auto build_one = [&](const char* call, const auto& definition) {
    ParticleWorld<S> world;
    EXPECT_TRUE(build(world, definition)) << call;
    to.hash(call, world.hash());
    for (int i = 0; i < 5; ++i) world.step();
    to.hash(call, world.hash());
  };
  build_one("build cloth", ClothDefinition<S>{.columns = 5, .rows = 4, .mass = S(4)});
  build_one("build rope", RopeDefinition<S>{.particles = 7});
  build_one("build bridge", BridgeDefinition<S>{});
  build_one("build platform", PlatformDefinition<S>{});
  build_one("build blob", BlobDefinition<S>{});
  build_one("build soft box", SoftBoxDefinition<S>{});
}

struct Sketch : DebugDraw {
  Answers& to;
  explicit Sketch(Answers& answers) : to(answers) {}
  void part(const DrawnBody& body, const DrawnPart& part) override {
    for (const auto x : body.pose.position) to.number("draw", x);
    to.number("draw", part.radius);
  }
};

template <class S> void ask_world(const Arguments<S>& x, Answers& to) {
  World<S> world;
  const ShapeId box = world.add_shape(Box<S>{{S(0.3), S(0.4), S(0.2)}}), ball = world.add_shape(Sphere<S>{S(0.31)});
  const Child<S> parts[] = {{primitive_of(Sphere<S>{S(0.3)}), {{S(0.4), S(0.1), S(0)}, x.p}},
                            {primitive_of(Capsule<S>{S(0.2), S(0.3)}), {{S(-0.3), S(0), S(0.2)}, x.q}}};
  const ShapeId two = world.add_shape(std::span<const Child<S>>(parts));
  world.create({.shape = world.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)})});
  const BodyId a = world.create({.type = BodyType::dynamic,
                                 .shape = two,
                                 .position = {S(0.3), S(1.7), S(0.1)},
                                 .orientation = x.p,
                                 .angular_velocity = {S(0.3), S(0.7), S(0.2)}});
  const BodyId b = world.create({.type = BodyType::dynamic, .shape = box, .position = {S(1.3), S(1.7), S(0.1)}});
  const BodyId c = world.create({.type = BodyType::dynamic, .shape = ball, .position = {S(0.1), S(4), S(0)}});
  const JointId hinge = world.create(world.joint_at(JointType::hinge, a, b, {{S(0.9), S(1.6), S(0)}, x.q}));
  to.hash("World::create", world.hash());
  world.apply_force_at(b, x.v, {S(1.2), S(1.6), S(0)}), world.apply_impulse_at(c, x.w, {S(0.1), S(4.1), S(0)});
  for (int i = 0; i < 40; ++i) world.step();
  to.hash("World::step", world.hash());
  to.vector("World::pose", world.pose(a).position), to.turn("World::pose", world.pose(a).orientation);
  to.vector("World::velocity", world.velocity(a)), to.vector("World::velocity_at", world.velocity_at(a, x.v));
  to.number("World::mass", world.mass(a)), to.number("World::inertia", world.inertia(a, x.n));
  to.vector("World::view", world.view(a).pose.position);
  to.number("World::joint_error", world.joint_error(hinge)),
      to.number("World::joint_position", world.joint_position(hinge));
  const auto hit = world.cast_ray({S(0.2), S(9), S(0.1)}, {S(0.13), S(-9), S(0.07)});
  if (hit) to.number("World::cast_ray", hit->fraction), to.vector("World::cast_ray", hit->point);
  const auto met =
      world.cast_shape(primitive_of(Sphere<S>{S(0.2)}), {{S(0.2), S(9), S(0.1)}, x.p}, {S(0.1), S(-9), S(0)});
  if (met) to.number("World::cast_shape", met->fraction), to.vector("World::cast_shape", met->point);
  const auto nearest = world.closest_point({S(2), S(3), S(1)}, S(9));
  if (nearest) to.vector("World::closest_point", nearest->point), to.number("World::closest_point", nearest->distance);
  for (const RenderPose& pose : world.poses_float(0.3f)) to.number("World::poses_float", pose.position[1]);
  Sketch sketch(to);
  draw(world, sketch);

  const RagdollBone<S> bones[] = {{.shape = ball, .mass = S(1)},
                                  {.parent = 0,
                                   .shape = ball,
                                   .pose = {{S(0), S(-0.5), S(0)}, x.p},
                                   .mass = S(1),
                                   .joint = {{S(0), S(-0.3), S(0)}, x.p},
                                   .swing_x = S(0.5),
                                   .swing_y = S(0.4),
                                   .lower = S(-0.4),
                                   .upper = S(0.6)}};
  add_ragdoll<S>(world, bones, {.friction = S(0.3), .limit_frequency = S(7)});
  to.hash("add_ragdoll", world.hash());
  const Result<GridHull> solid = grid_box(Box<S>{{S(0.3), S(0.4), S(0.2)}});
  ASSERT_TRUE(solid.ok());
  const Result<Fracture> broken = fracture(solid.value(), EightBoxes{}, FractureImpact{{100, 200, 300}, {1, -2, 3}}, 7);
  ASSERT_TRUE(broken.ok());
  const std::vector<ShapeId> shapes = add_piece_shapes(world, broken.value());
  const auto shards = shatter<S>(broken.value(), world.view(b), shapes);
  ASSERT_TRUE(shards.ok());
  for (const BodyDefinition<S>& shard : shards.value()) {
    to.vector("shatter", shard.position), to.vector("shatter", shard.velocity), to.number("shatter", shard.mass);
  }
  Breakable<S> glass;
  glass.body = b;
  world.set_input(world.add(glass), {.impulse = S(1)});
  break_bodies(world, 64u);
  to.hash("break_bodies", world.hash());
}

template <class S> void ask_articulation(Answers& to) {
  if constexpr (!std::same_as<S, Q16_16>) {
    ArticulationDefinition<S> definition;
    definition.links.resize(2);
    definition.links[1].parent = 0;
    for (auto& link : definition.links) {
      link.mass.mass = S(1.3);
      link.mass.inertia = {S(2.3), S(2.9), S(3.1)};
    }
    Articulation<S> tree;
    const Result<void> built = tree.build(definition);
    EXPECT_TRUE(built.ok()) << built.error().place.view() << built.error().message.view();
    for (int i = 0; i < 20; ++i) tree.step();
    to.hash("Articulation::step", tree.hash());
    to.vector("Articulation::link_pose", tree.link_pose(1).position);
    JointCoordinates<S> moved;
    moved.position.x = S(7.3), moved.velocity.x = S(0.7);
    EXPECT_TRUE(tree.set_coordinates(0, moved));
    for (int i = 0; i < 2; ++i) {
      EXPECT_TRUE(tree.apply_force(1, {S(0.7), S(-0.3), S(0.1)}, {S(0.3), S(0.1), S(0.7)}));
      EXPECT_TRUE(tree.apply_torque(1, {S(0.1), S(0.3), S(0.7)}));
    }
    to.hash("Articulation's commands", tree.hash());
  }
}

template <class S> Answers ask(const Arguments<S>& usual, const Arguments<S>& tiny, const Baked& baked) {
  Answers to;
  ask_mathematics(usual, to), ask_mathematics(tiny, to), ask_masses(usual, to);
  ask_baking(baked, to);
  ask_particles<S>(to), ask_world(usual, to), ask_articulation<S>(to);
  return to;
}

template <class S> class RoundingModes : public ::testing::Test {};
TYPED_TEST_SUITE(RoundingModes, AllScalars);

TYPED_TEST(RoundingModes, no_call_that_the_library_compiles_follows_its_callers) {
  using S = TypeParam;
  const Arguments<S> usual(false), tiny(true);
  const Baked baked;
  const Answers expected = ask(usual, tiny, baked);
  for (const std::uint32_t control :
       {kMasks | kDown, kMasks | kUp, kMasks | kTowardsZero, kMasks | kFlush | kDenormalsAreZero}) {
    Answers answers;
    {
      const Hostile hostile(control);
      answers = ask(usual, tiny, baked);
      EXPECT_EQ(Hostile::control(), control);
    }
    ASSERT_EQ(answers.all.size(), expected.all.size());
    for (std::size_t i = 0; i < answers.all.size(); ++i)
      EXPECT_EQ(answers.all[i].second, expected.all[i].second) << answers.all[i].first << ", control word " << control;
  }
}

}  // namespace rounding_modes_test
}  // namespace isostep::test
#endif
