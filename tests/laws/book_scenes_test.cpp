// The demonstrations of the book run by their scripts: each against the law that it shows, in every scalar.
// SPDX-License-Identifier: MIT
#include "built.hpp"
#include "scenes/book/book.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"
#include "scenes/script.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {
namespace book_scenes_test {

template <class S> class BookScenes : public ::testing::Test {
 protected:
  void open(const char* name) {
    scene_ = *scenes::find_scene(name);
    world_ = std::make_unique<World<S>>(scenes::settings_of<S>(scene_));
    bodies_ = scenes::build(scene_, *world_).bodies;
  }
  void step() {
    scenes::before_step(scene_.script, *world_);
    StepReport report = world_->step();
    if (std::is_same_v<S, Q16_16>) report.clamped_speed = 0;  // splinters and small balls turn faster than it counts
    ASSERT_TRUE(report.clean()) << "at " << world_->tick();
  }
  void run_to(std::uint64_t tick) {
    while (world_->tick() < tick && !::testing::Test::HasFatalFailure()) step();
  }
  BodyId body(std::size_t i) const { return bodies_[i]; }
  D3 centre(std::size_t i) const { return real(world_->center_of_mass(bodies_[i])); }
  D3 velocity(std::size_t i) const { return real(world_->velocity(bodies_[i])); }
  D3 spin(std::size_t i) const { return real(world_->angular_velocity(bodies_[i])); }
  D3 axis(std::size_t i, D3 local) const { return rotated<S>(world_->pose(bodies_[i]).orientation, local); }

  scenes::Scene scene_;
  std::unique_ptr<World<S>> world_;
  std::vector<BodyId> bodies_;
};
TYPED_TEST_SUITE(BookScenes, AllScalars);

TYPED_TEST(BookScenes, an_aircraft_flies_level_and_turns_for_a_minute_each) {
  this->open("flight");
  double turned = 0, last = 0;
  while (this->world_->tick() < 2 * scenes::kFlightTurns) {
    this->step();
    const std::uint64_t t = this->world_->tick();
    const D3 nose = this->axis(0, {1, 0, 0}), right = this->axis(0, {0, 0, 1}), v = this->velocity(0);
    EXPECT_NEAR(this->centre(0).y, scenes::kFlightHeight, t < scenes::kFlightTurns ? 0.25 : 1.5) << t;
    EXPECT_NEAR(length(v), scenes::kFlightSpeed, 0.3) << t;
    if (t < scenes::kFlightTurns) {
      EXPECT_EQ(this->centre(0).z, 0) << t;
    }
    const double heading = std::atan2(nose.z, nose.x);
    turned += std::remainder(heading - last, 2 * kPi);
    last = heading;
    if (t < scenes::kFlightTurns + 300) continue;  // five seconds to bank
    EXPECT_NEAR(-right.y, scenes::kFlightBank, 0.08) << t;
    EXPECT_LT(std::fabs(dot(v, right)), 0.3) << "it slips at " << t;
    // A coordinated turn: the centripetal acceleration is that of the bank.
    const double bank = std::asin(-right.y), rate = std::fabs(this->spin(0).y);
    EXPECT_NEAR(rate, 10 * std::tan(bank) / length(v), 0.03) << t;
  }
  EXPECT_GT(turned, 2.5 * 2 * kPi);
}

TYPED_TEST(BookScenes, mirrored_controls_fly_the_mirrored_path) {  // O26
  using S = TypeParam;
  this->open("flight_left");
  const scenes::Scene scene = *scenes::find_scene("flight");
  World<S> right(scenes::settings_of<S>(scene));
  const BodyId aircraft = scenes::build(scene, right).bodies[0];
  double worst = 0;
  while (this->world_->tick() < 2 * scenes::kFlightTurns) {
    scenes::before_step(scene.script, right);
    right.step();
    this->step();
    const Vec3<S> a = right.center_of_mass(aircraft), b = this->world_->center_of_mass(this->body(0));
    worst = std::max(worst, length(real(a - Vec3<S>{b.x, b.y, -b.z})));
    if (right.tick() < scenes::kFlightTurns) {
      ASSERT_EQ(worst, 0);
    }
  }
  // Not bit for bit: fixed point rounds halves upwards, and floats add left wings before right ones.
  EXPECT_LT(worst, pick<S>(1e-3, 1e-11, 0.05, 1e-4));
  EXPECT_GT(std::fabs(this->centre(0).z), 5);
}

TYPED_TEST(BookScenes, a_boat_reaches_a_steady_course) {
  this->open("sail");
  this->run_to(3000);
  const D3 before = this->velocity(0);
  EXPECT_GT(before.x, 1);
  EXPECT_LT(std::fabs(before.z), 0.1 * before.x) << "it drifts";
  EXPECT_GT(this->axis(0, {1, 0, 0}).x, 0.99) << "the bow is off";
  EXPECT_GT(this->axis(0, {0, 1, 0}).y, 0.98) << "it heels";
  this->run_to(3600);
  EXPECT_NEAR(this->velocity(0).x, before.x, 0.02);
  EXPECT_NEAR(this->centre(0).y, 0.1, 0.01);
}

TYPED_TEST(BookScenes, a_boat_without_wind_is_at_rest_within_five_seconds) {  // O21
  using S = TypeParam;
  this->open("becalmed");
  this->run_to(300);
  EXPECT_NEAR(this->centre(0).y, 0.1, pick<S>(2e-3, 2e-3, 5e-3, 2e-3));
  EXPECT_LT(length(this->velocity(0)), 0.01);
  this->run_to(900);
  EXPECT_NEAR(this->centre(0).y, 0.1, pick<S>(1e-4, 1e-8, 1e-2, 1e-6));
}

TYPED_TEST(BookScenes, rounds_push_the_cubes_and_all_comes_to_rest) {
  this->open("bigballistic");
  this->run_to(900);
  EXPECT_EQ(this->world_->bodies().size(), 3u + 16u);
  EXPECT_GT(this->centre(1).z, 21) << "the first cube stands where it stood";
  for (const BodyId id : this->world_->bodies()) {
    if (this->world_->type(id) != BodyType::dynamic) continue;
    EXPECT_GT(real(this->world_->center_of_mass(id)).y, 0.38) << "it sank in";
    // Balls may still spin where they lie: about its normal one point has no friction.
    EXPECT_LT(length(real(this->world_->velocity(id))), 0.01);
  }
}

TYPED_TEST(BookScenes, a_charge_throws_all_rubble_outwards) {
  this->open("explosion");
  std::vector<double> before;
  for (std::size_t i = 1; i < this->bodies_.size(); ++i) before.push_back(length(this->centre(i)));
  this->run_to(scenes::kBlastBegins + 60);
  for (std::size_t i = 1; i < this->bodies_.size(); ++i) EXPECT_GT(length(this->centre(i)), before[i - 1] + 0.5) << i;
}

TYPED_TEST(BookScenes, a_blast_among_500_rolls_back_through_its_middle) {
  using S = TypeParam;
  this->open("blast");
  this->run_to(scenes::kBlastBegins + 20);  // the wave is 4 s m from the charge and goes on
  typename World<S>::Snapshot middle;
  this->world_->save(middle);
  this->run_to(scenes::kBlastBegins + 80);
  const std::uint64_t hash = this->world_->hash();
  double thrown = 0;
  for (std::size_t i = 1; i < this->bodies_.size(); ++i) thrown = std::max(thrown, length(this->velocity(i)));
  EXPECT_GT(thrown, 3);
  ASSERT_TRUE(this->world_->load(middle));
  this->run_to(scenes::kBlastBegins + 80);
  EXPECT_EQ(this->world_->hash(), hash);
}

TYPED_TEST(BookScenes, a_hanging_chain_is_a_catenary) {  // O22
  using S = TypeParam;
  this->open("catenary");
  this->run_to(1800);
  const std::size_t links = scenes::kCatenaryLinks;
  double length_of_all = 0;  // by the links' middles and the hooks
  D3 last = {-5, 10, 0};
  for (std::size_t i = 0; i <= links; ++i) {
    const D3 at = i < links ? this->centre(i) : D3{5, 10, 0};
    length_of_all += length(at - last);
    last = at;
  }
  double low = 0.5, high = 50;  // a of y = a cosh(x / a): 2 a sinh(5 / a) is the length
  for (int i = 0; i < 100; ++i) {
    const double a = (low + high) / 2;
    (2 * a * std::sinh(5 / a) > length_of_all ? low : high) = a;
  }
  const double a = low, sag = a * (std::cosh(5 / a) - 1), tolerance = sag * pick<S>(0.01, 0.01, 0.02, 0.01);
  EXPECT_GT(sag, 3);
  for (std::size_t i = 0; i < links; ++i) {
    const D3 at = this->centre(i);
    EXPECT_NEAR(at.y, 10 - sag + a * (std::cosh(at.x / a) - 1), tolerance) << i;
    EXPECT_LT(length(this->velocity(i)), 0.02);
  }
}

TYPED_TEST(BookScenes, a_top_precesses_as_fast_as_it_must) {  // O14
  using S = TypeParam;
  this->open("top");
  double turned = 0, last = kPi;
  while (this->world_->tick() < 600) {
    this->step();
    const D3 at = this->centre(0);
    EXPECT_NEAR(at.y, std::cos(scenes::kTopTilt), pick<S>(0.01, 0.01, 0.03, 0.01)) << "it nods";
    const double azimuth = std::atan2(-at.z, at.x);
    turned += std::remainder(azimuth - last, 2 * kPi);
    last = azimuth;
  }
  EXPECT_NEAR(turned / 10, scenes::kTopPrecession, pick<S>(0.01, 0.01, 0.03, 0.01) * scenes::kTopPrecession);
}

TYPED_TEST(BookScenes, a_door_swings_with_the_period_of_its_inertia) {  // O15
  using S = TypeParam;
  this->open("hinge");
  std::vector<double> crossings;
  double last = this->centre(0).x;
  while (this->world_->tick() < 600) {
    this->step();
    const double x = this->centre(0).x;
    if ((x > 0) != (last > 0)) crossings.push_back((static_cast<double>(this->world_->tick()) - x / (x - last)) / 60);
    last = x;
  }
  ASSERT_GE(crossings.size(), 4u);
  // From level the swing is 90 degrees each way: the arithmetic-geometric mean of 1 and cos 45 degrees.
  const double inertia = (0.1 * 0.1 + 1) / 12 + 0.25, small = 2 * kPi * std::sqrt(inertia / (10 * 0.5));
  const double period = small / 0.847213;
  const double measured = 2 * (crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1);
  EXPECT_NEAR(measured, period, period * pick<S>(0.005, 0.005, 0.01, 0.005));
  EXPECT_EQ(this->centre(0).z, 0);
}

TYPED_TEST(BookScenes, a_piston_is_where_its_crank_puts_it) {
  using S = TypeParam;
  this->open("piston");
  double least = 9, most = -9;
  while (this->world_->tick() < 600) {
    this->step();
    const D3 pin = this->axis(0, {0.4, 0, 0});
    EXPECT_NEAR(this->centre(1).x, pin.x + std::sqrt(1.6 * 1.6 - pin.y * pin.y), pick<S>(2e-3, 2e-3, 1e-2, 2e-3));
    EXPECT_EQ(this->centre(1).y, 1);
    least = std::min(least, this->centre(1).x), most = std::max(most, this->centre(1).x);
    if (this->world_->tick() > 60) {
      EXPECT_NEAR(this->spin(0).z, 4, 0.05);
    }
  }
  EXPECT_NEAR(least, 1.2, 0.01);
  EXPECT_NEAR(most, 2, 0.01);
}

TYPED_TEST(BookScenes, balls_roll_out_by_their_resistance) {
  using S = TypeParam;
  this->open("rolling");
  this->run_to(300);
  for (std::size_t i = 1; i <= 4; ++i) {
    const double lever = i == 1 ? 0 : 0.01 * (1 << (i - 1));
    // The torque of weight and lever slows a solid sphere's 7/5 of mass: a = 5/7 g lever / r.
    const double expected = std::max(4 - 5.0 / 7 * 10 * lever / 0.5 * 5, 0.0);
    EXPECT_NEAR(this->velocity(i).x, expected, pick<S>(0.02, 0.02, 0.06, 0.02)) << i;
  }
}

TYPED_TEST(BookScenes, sledges_run_along_their_runners_and_hold_across_them) {
  this->open("sledges");
  this->run_to(60);
  // Along: a sixteenth of the friction. Across: all of it. Askew: what is across the runners goes first.
  const double mu = 0.25 * 10;
  EXPECT_NEAR(this->velocity(1).x, 4 - mu * scenes::kSledgeRunners, 0.03);
  EXPECT_NEAR(this->velocity(3).x, 4 - mu, 0.06);
  const D3 runners = this->axis(2, {1, 0, 0}), v = this->velocity(2);
  EXPECT_LT(v.x, 3.5);
  this->run_to(180);
  const D3 later = this->velocity(2);
  EXPECT_LT(length(this->velocity(3)), 0.01);
  EXPECT_GT(length(later), 1.5);
  EXPECT_LT(length(cross(later, runners)), 0.1 * length(later)) << "it does not run along its runners";
}

TYPED_TEST(BookScenes, friction_at_rest_holds_what_friction_in_motion_does_not) {  // O16
  using S = TypeParam;
  this->open("slopes");
  const double held = pick<S>(2e-3, 1e-3, 5e-3, 1e-3);
  const D3 first[2] = {this->centre(1), this->centre(3)};
  this->run_to(300);
  for (const int n : {0, 1}) EXPECT_LT(length(this->centre(2 * static_cast<std::size_t>(n) + 1) - first[n]), 5 * held);
  const double angle = kPi / 6, a = 10 * (std::sin(angle) - 0.4 * std::cos(angle));
  EXPECT_NEAR(length(this->velocity(5)), a * 5, a * 5 * pick<S>(0.03, 0.03, 0.05, 0.03));
}

TYPED_TEST(BookScenes, a_cube_breaks_in_eight_and_a_tower_stays_above_the_floor) {
  this->open("fracture");
  this->run_to(300);
  EXPECT_GE(this->world_->bodies().size(), 1u + 1u + 8u);
  this->open("tower");
  double mass = 0, before = 0;
  for (const BodyId id : this->world_->bodies()) before += to_double(this->world_->mass(id));
  this->run_to(300);
  EXPECT_GT(this->world_->bodies().size(), 102u + 7u * 5u) << "hardly a box broke";
  for (const BodyId id : this->world_->bodies()) {
    mass += to_double(this->world_->mass(id));
    if (this->world_->type(id) == BodyType::dynamic) {
      EXPECT_GT(real(this->world_->center_of_mass(id)).y, 0);
    }
  }
  EXPECT_NEAR(mass / before, 1, pick<TypeParam>(1e-5, 1e-12, 1e-3, 1e-8));
}

TYPED_TEST(BookScenes, four_materials_break_and_small_pieces_are_gone_after_a_while) {
  if (std::is_same_v<TypeParam, Q16_16>) return;  // glass is thinner than what Q16.16 has
  this->open("materials");
  std::size_t most = 0;
  while (this->world_->tick() < 300) {
    this->step();
    most = std::max(most, this->world_->bodies().size());
  }
  EXPECT_GT(most, 1u + 8u + 4u * 6u);
  EXPECT_LT(this->world_->bodies().size(), most);
}

TYPED_TEST(BookScenes, every_coarse_structure_gives_the_same_bits) {  // O29
  using S = TypeParam;
  std::vector<std::uint64_t> hashes;
  for (const BroadPhaseName structure : kBuiltBroadPhases) {
    const char* const name = kBroadPhaseNames[static_cast<std::size_t>(structure)];
    this->open((std::string("coarse_") + name).c_str());
    EXPECT_EQ(kBroadPhaseNames[static_cast<std::size_t>(this->world_->broad_phase())], std::string(name));
    for (int i = 0; i < 4; ++i) {
      this->run_to(static_cast<std::uint64_t>(60 * (i + 1)));
      if (name == kBroadPhaseNames[0]) hashes.push_back(this->world_->hash());
      else EXPECT_EQ(this->world_->hash(), hashes[static_cast<std::size_t>(i)]) << name;
    }
  }
  EXPECT_EQ(hashes.size(), 4u);
  (void)sizeof(S);
}

}  // namespace book_scenes_test
}  // namespace isostep::test
