// A user's file that calls what the public headers offer inline, for every scalar that is built. Compiled at -O0, and
// with -mfma for the linker trap: whatever it leaves behind as a weak symbol, a linker may keep for the whole program.
// SPDX-License-Identifier: MIT
#include <cstring>

#include "all_headers.hpp"

namespace {

using namespace isostep;

/// Keeps a value from being thought unused.
template <class T> void keep(const T& value) {
  volatile unsigned char byte = 0;
  byte = reinterpret_cast<const unsigned char*>(&value)[0];
  static_cast<void>(byte);
}
/// A value that the compiler may not know.
template <class T> T unknown(T value) {
  T copy = value;
  std::memcpy(&copy, &value, sizeof copy);
  return copy;
}

template <class S> void use_numbers() {
  const S a = unknown(S(3)), b = unknown(S(2));
  const Unit<S> u = unknown(Unit<S>(0.5));
  keep(a + b), keep(a - b), keep(a * b), keep(a / b), keep(-a), keep(a * u), keep(a * unknown(Step<S>(0.25)));
  keep(a < b), keep(a > b), keep(a <= b), keep(a >= b), keep(a == b), keep(a != b);
  S c = a;
  c += b, c -= b, c *= b, c /= b;
  keep(c);
  const Sum<S> sum = product(a, b) + product(a, a) - product(b, b);
  keep(round_to<S>(sum)), keep(widen<Sum<S>>(a) + sum), keep(sum < product(a, b)), keep(divide_to<S>(a, b));
  keep(min(a, b)), keep(max(a, b)), keep(clamp(a, b, a)), keep(abs(a));
  keep(convert<Velocity<S>>(a)), keep(convert<S>(u)), keep(to_bits(a)), keep(from_bits<S>(to_bits(a)));
  keep(is_finite(a)), keep(to_double(a)), keep(from_double<S>(unknown(0.5))), keep(resolution<S>());
  keep(from_literal<S>(Literal(0.5)));
  keep(sqrt(a)), keep(rsqrt(a)), keep(sin(a)), keep(cos(a)), keep(sin_cos(a)), keep(sin_cos_to<Unit<S>>(a));
  keep(atan2(a, b)), keep(atan2_to<S>(u, u)), keep(asin(S(u * a))), keep(acos(S(u * a)));
  keep(exp(b)), keep(exp_to<Step<S>>(-b)), keep(log(a)), keep(log_to<S>(u));
  keep(power_to<Step<S>>(S(u * b), unknown(Step<S>(0.25))));
  keep(direction_of(a, b, a));
  Unit<S> x = u, y = u, z = u, w = u;
  normalise4(x, y, z, w);
  keep(x);
  S read = a;
  TextError error;
  keep(from_text("1.5", read, error)), keep(to_text(a).size());
  Pcg32 random = Pcg32::seeded(1);
  keep(uniform(random, b, a)), keep(random_between(random, 1, 6)), keep(unit_interval<S>(random.next_u24()));
  keep(Limits<S>::extent()), keep(Limits<S>::minimum_size()), keep(Limits<S>::position()), keep(Limits<S>::speed());
  keep(Limits<S>::angular_speed()), keep(Limits<S>::mass()), keep(Limits<S>::mass_ratio());
}

template <class S> void use_mathematics() {
  const S a = unknown(S(3));
  const Vec3<S> v = {a, a, S(1)};
  const Vec3<Unit<S>> n = {unknown(Unit<S>(0)), Unit<S>(1), Unit<S>(0)};
  keep(v + v), keep(v - v), keep(-v), keep(v == v), keep(v != v), keep(v[1]), keep(v * a), keep(n * a);
  Vec3<S> w = v;
  w += v, w -= v, w[0] = a;
  keep(dot(v, v)), keep(dot(v, n)), keep(dot_sum(v, v)), keep(cross(v, v)), keep(cross(v, n)), keep(scale(v, v));
  keep(abs(v)), keep(min(v, w)), keep(max(v, w)), keep(max_abs(v)), keep(is_finite(v)), keep(convert<Velocity<S>>(v));
  keep(tangents_of(n)), keep(Vec3<S>::zero()), keep(a * v), keep(v / a), keep(length(v)), keep(distance(v, w));
  keep(normalise(v)), keep(heading_of(v));
  const Quat<Unit<S>> q = rotation(n, a);
  keep(q * conjugate(q)), keep(normalise(q)), keep(integrate(q, n)), keep(q == q), keep(Quat<Unit<S>>::identity());
  const Mat3<Unit<S>> r = to_matrix(q);
  keep(r * v), keep(transposed_times(r, v)), keep(r * r), keep(transpose(r)), keep(rotate_diagonal(r, v)), keep(r + r);
  keep(rotate(q, v)), keep(r.column(1)), keep(Mat3<S>::identity()), keep(Mat3<S>::diagonal(v));
  const Pose<S> pose = {v, q};
  const Transform<S> t = Transform<S>::of(pose);
  keep(to_world(t, v)), keep(to_local(t, v)), keep(compose(t, t)), keep(relative(t, t)), keep(compose(pose, pose));
  keep(pose.is_identity());
  const Aabb<S> box = Aabb<S>::around(v, v);
  keep(overlap(box, box)), keep(contains(box, box)), keep(merge(box, box)), keep(grow(box, a)), keep(half_area(box));
  keep(box == box);
}

template <class S> void use_geometry() {
  const S a = unknown(S(1));
  const Primitive<S> sphere = primitive_of(Sphere<S>{a});
  const Primitive<S> crate = primitive_of(Box<S>{{a, a, a}});
  const Primitive<S> pill = primitive_of(Capsule<S>{a, a});
  const Transform<S> t = Transform<S>::of(Pose<S>::identity());
  keep(bounds(sphere, t)), keep(bounds(crate, t)), keep(bounds(pill, t));
  const Child<S> child = {crate, Pose<S>::identity()};
  const std::span<const Child<S>> children(&child, 1);
  keep(validate(sphere)), keep(validate(Pose<S>::identity())), keep(validate<S>(children)), keep(normalised(child));
  keep(describe(validate(sphere))[0]), keep(mass_properties<S>(children, a));
  Manifold<S> manifold;
  collide(sphere, t, crate, t, a, manifold);
  keep(overlaps(sphere, t, crate, t));
  RayHit<S> hit;
  keep(ray_cast(sphere, t, {a, a, a}, {a, a, a}, a, hit)), keep(closest_point(sphere, t, {a, a, a}));
}

template <class S, int W, class Isa> void use_lanes() {
  using L = Lanes<S, W, Isa>;
  S numbers[W];
  for (S& number : numbers) number = unknown(S(2));
  const L a = L::load(numbers), b = L::broadcast(S(3));
  const auto less_lanes = less(a, b);
  (a + b - L::zero()).store(numbers);
  select(less_lanes, a * b, min(a, max(a, b))).store(numbers);
  keep(numbers);
}

struct Ignore {
  template <class T> ISO_INLINE void operator()(const char*, T&& value) const { keep(value); }
};

template <class S> void use_state(World<S>& world) {
  std::vector<std::uint8_t> bytes;
  Writer writer(bytes);
  Settings<S> settings;
  Settings<S>::fields(Ignore{}, settings);
  writer.write(settings);
  writer.write(unknown(S(1)));
  writer.write_array(std::vector<std::uint32_t>{1, 2});
  Reader reader(bytes);
  reader.read(settings);
  keep(reader.template read<S>());
  std::vector<std::uint32_t> array;
  reader.read_array(array, 8u);
  keep(reader.ok());
  DiffReport report;
  diff_value("settings", settings, settings, report);
  keep(report.any());

  ReplayIdentity identity{};
  identity.scalar = ScalarTraits<S>::kName;
  const Result<ReplayHeader> header = make_replay_header(identity);
  std::vector<std::uint8_t> file;
  Recorder<World<S>> recorder(sink_to(file));
  if (header && recorder.begin(world, header.value())) {
    keep(recorder.frame({}, world.hash())), keep(recorder.keyframe(world)), keep(recorder.finish());
    const ReplayReader replay(file);
    keep(verify_replay(replay, world, SameHeader{header.value()}).outcome);
  }
  WorldRecorder<S> commands(world, sink_to(file));
  keep(commands.begin("none")), keep(commands.end_frame()), keep(commands.keyframe()), keep(commands.finish());
  std::vector<std::uint8_t> log;
  Writer log_writer(log);
  using Few = CommandTypes<void, SetPose<S>, AddShape<S>>;  // names of the whole list fill pages
  write_command<Few>(log_writer, SetPose<S>{BodyId{}, Pose<S>::identity()});
  write_command<Few>(log_writer, AddShape<S>{});
  keep(play_commands<Few>(
           log, [&](const auto&) { return true; }, [&] { world.step(); })
           .ok());
}

struct Drawer : DebugDraw {
  void part(const DrawnBody& body, const DrawnPart& part) override { keep(body.pose.position), keep(part.radius); }
};

template <class S> void use_world() {
  World<S> world;
  const ShapeId sphere = world.add_shape(Sphere{0.5});
  const ShapeId crate = world.add_shape(Box<S>{{S(0.5), S(0.5), S(0.5)}});
  world.add_shape(Capsule{0.5, 1.0});
  const ShapeId ground = world.add_shape(HalfSpace<S>{{Unit<S>(0), Unit<S>(1), Unit<S>(0)}, S(0)});
  BodyDefinition<S> definition;
  definition.shape = ground;
  const BodyId floor = world.create(definition);
  definition.type = BodyType::dynamic;
  definition.shape = crate;
  definition.position = {S(0), S(2), S(0)};
  const BodyId body = world.create({.type = BodyType::dynamic, .shape = sphere, .position = {0, 4, 0}});
  const BodyId other = world.create(definition);
  JointProperties<S> joint = world.joint_at(JointType::ball, body, other, Pose<S>::identity());
  keep(world.create(joint)), keep(body == other), keep(body != floor), keep(static_cast<bool>(body));
  world.apply_impulse(body, {S(0), S(3), S(0)});
  world.apply_force_at(body, {S(0), S(3), S(0)}, {S(0), S(3), S(0)});
  world.set_velocity(body, {S(0), S(0), S(0)}, {S(0), S(0), S(0)});
  const StepReport report = world.step();
  keep(report.clean());
  for (const ContactBegin<S>& touch : world.events().contact_begin) keep(touch.impulse);
  for (const BodyId asleep : world.events().fell_asleep) keep(asleep);
  if (const auto hit = world.cast_ray({S(0), S(9), S(0)}, {S(0), S(-9), S(0)})) keep(hit->body);
  std::vector<BodyId> found;
  world.overlap_shape(primitive_of(Sphere<S>{S(1)}), Pose<S>::identity(), found);
  std::vector<RayCastHit<S>> hits;
  world.cast_ray_all({S(0), S(9), S(0)}, {S(0), S(-9), S(0)}, hits);
  keep(world.closest_point({S(0), S(9), S(0)}, S(4))), keep(world.pose(body)), keep(world.bodies().size());
  for (const RenderPose& pose : world.poses_float(0.5f)) keep(pose.position);
  world.apply(WakeBody{body});
  Drawer drawer;
  draw(world, drawer, {.masses = true});
  typename World<S>::Snapshot frame;
  world.save(frame);
  world.load(frame);
  keep(world.hash()), keep(frame.bytes());
  World<S> moved = std::move(world);
  use_state(moved);
}

template <class S> void use_particle_records(ParticleWorld<S>& world, ParticleId a, ParticleId b) {
  Spring<S> spring;
  spring.a = a;
  spring.b = b;
  spring.stiffness = unknown(S(3));
  const SpringId spring_id = world.add(spring);
  ParticleForce<S> force;
  force.particle = a;
  const ForceId force_id = world.add(force);
  Cohesion<S> cohesion;
  cohesion.material = world.default_material();
  const CohesionId cohesion_id = world.add(cohesion);
  const LinkId link_id = world.add(Link<S>{LinkType::rod, a, b, {S(0), S(0), S(0)}, S(1), S(0)});
  Collider<S> plane;
  const ColliderId collider_id = world.add(plane);
  const ParticleMaterialId material_id = world.add(ParticleMaterial<S>{});
  keep(world.set(spring_id, spring)), keep(world.set(force_id, force)), keep(world.set(cohesion_id, cohesion));
  keep(world.set(collider_id, plane)), keep(world.set(material_id, ParticleMaterial<S>{}));
  if (const Link<S>* link = world.find(link_id)) keep(world.set(link_id, *link));
  keep(world.find(spring_id)), keep(world.find(force_id)), keep(world.find(cohesion_id));
  ParticleTouch<S> touch = {};
  touch.particle = a;
  keep(world.touch(touch)), keep(world.apply(DestroyParticle{ParticleId{}}));
  keep(ParticleLimits<S>::position()), keep(ParticleLimits<S>::speed()), keep(ParticleLimits<S>::acceleration());
  keep(ParticleLimits<S>::least_mass()), keep(ParticleLimits<S>::mass());
  keep(distance_to(plane, {S(1), S(2), S(3)}));
  keep(oscillator_step(S(3), S(1), InverseMass<S>(1), S(60)));
  keep(world.remove(spring_id)), keep(world.remove(force_id)), keep(world.remove(cohesion_id));
  keep(world.remove(link_id)), keep(world.remove(collider_id)), keep(world.remove(material_id));
}

template <class S> void use_particles() {
  ParticleSettings<S> settings;
  settings.integrator = Integrator::rk4;
  ParticleWorld<S> world(settings);
  ParticleDefinition<S> definition;
  definition.velocity = {S(0), S(3), S(0)};
  const ParticleId a = world.create(definition), b = world.create({.position = {0, 4, 0}, .pinned = true});
  use_particle_records(world, a, b);
  keep(world.place(a, {S(0), S(2), S(0)}, {S(0), S(0), S(0)})), keep(world.set_mass(a, S(2)));
  keep(world.apply_force(a, {S(0), S(3), S(0)})), keep(world.apply_impulse(a, {S(0), S(3), S(0)}));
  keep(world.position(a)), keep(world.velocity(a)), keep(world.mass(a)), keep(world.particles().size());
  std::vector<std::uint8_t> file;
  ParticleRecorder<S> recorder(world, sink_to(file));
  keep(recorder.begin("none")), keep(world.step().clean()), keep(recorder.end_frame()), keep(recorder.finish());
  for (const ParticleContactBegin<S>& met : world.events().contact_begin) keep(met.speed);
  for (const ParticleExpired<S>& gone : world.events().expired) keep(gone.position);
  keep(world.events().touch_impulses.size()), keep(world.counts().contacts);
  typename ParticleWorld<S>::Snapshot frame;
  world.save(frame);
  world.load(frame);
  keep(world.hash()), keep(frame.bytes()), keep(world.state().position[0]);
  Drawer drawer;
  draw(world, drawer);
  ParticleWorld<S> moved = std::move(world);
  const ReplayReader replay(file);
  const Result<ReplayHeader> header = header_of_world(moved.settings(), "none", 0);
  if (header) keep(verify_replay(replay, moved, SameHeader{header.value()}).outcome);
}

template <class S> void use_all_of() {
  use_numbers<S>();
  use_mathematics<S>();
  use_geometry<S>();
  use_lanes<S, 1, isa::Portable>();
  use_lanes<S, 4, isa::Portable>();
  use_world<S>();
  use_particles<S>();
}

template <class T> void use_exact() {
  Exact<T> a = unknown(Exact<T>(T(2)));
  a += a * a - a / a, a *= a, a -= a, a /= Exact<T>(3);
  keep(sqrt(a)), keep(abs(a)), keep(min(a, a)), keep(max(a, a)), keep(sin(a)), keep(a < a), keep(a == a),
      keep(a.value());
}

void use_the_rest() {
  Bitset bits;
  bits.set(3);
  bits.reset(3);
  keep(bits.insert(70)), keep(bits.test(3)), keep(bits.find_next(0)), keep(bits.count()), keep(bits.any());
  std::uint64_t keys[3] = {3, 1, 2}, scratch[3];
  stable_sort(keys, scratch, 3, OwnKey{});
  SlotMap slots;
  const BodyId id = slots.take<BodyId>();
  keep(slots.holds(id)), keep(slots.entries().size());
  slots.give_back(id.slot);
  ShortText<8> text;
  text.append("seven").append_number(7);
  keep(text.view().size()), keep(fault_text(Fault::none)[0]), keep(describe(FaultReport{}).size()),
      keep(hash_bytes("x", 1));
  keep(pin_floats([] { return 1; }));
  Lcg lcg{1};
  const auto look = [](auto tag) {
    typename decltype(tag)::Type world;
    use_lanes(world, simd_named("best").value());
    keep(read_whole(world, {}).ok()), keep(world.tick());
  };
  keep(with_world("", std::string_view("float"), look).size()), keep(with_world(RecordedWorld{"", 1}, look).size());
  keep(with_portable_world(1, look)), keep(check_replay({}).result.frames);
  keep(random_below(lcg, 6)), keep(kVersionText[0]), keep(probe_environment_here());
}

}  // namespace

/// It is called by the linker trap, so that no linker thinks this file idle.
int use_everything() {
#define ISO_USE_ALL_OF(S) use_all_of<S>();
  ISO_FOR_EACH_SCALAR(ISO_USE_ALL_OF)
#undef ISO_USE_ALL_OF
  use_exact<float>();
  use_exact<double>();
  use_the_rest();
  return 0;
}
