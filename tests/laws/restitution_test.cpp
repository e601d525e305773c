// Laws of restitution: energy over many bounces at any rate, low bounces, flat falls, crowds; nothing gains energy.
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <cmath>

#include "isostep/geometry/shapes/height_field.hpp"
#include "isostep/geometry/shapes/mesh.hpp"
#include "random/dice.hpp"

namespace isostep::test {
namespace restitution_test {

constexpr double kFixedBar = 0.02;  // [1] of Q16.16: its steps of 15 um/s and um add up over many bounces

template <class S> class Restitution : public ::testing::Test {
 protected:
  static World<S> world(int hz, double gravity = -10, SolverName solver = SolverName::soft_step) {
    Settings<S> s = settings<S>(gravity, hz, 8);
    s.allow_sleep = false;
    s.solver = solver;
    return World<S>(s);
  }
  static BodyDefinition<S> elastic(BodyDefinition<S> d, double e, double friction = 0) {
    d.mass = S(1);
    d.material.restitution = num<S>(e);
    d.material.friction = num<S>(friction);
    return d;
  }
  /// [J] The energy with a mass of 1 kg, at 10 m/s^2 or none.
  static double energy(const World<S>& w, BodyId id, double gravity = 10) {
    const D3 v = real(w.velocity(id));
    return dot(v, v) / 2 + gravity * real(w.center_of_mass(id)).y + turning_energy(w, id);
  }
  static double turning_energy(const World<S>& w, BodyId id) {
    const BodyProperties<S>& body = *w.view(id).properties;
    const D3 spin = real(w.angular_velocity(id));
    const Quat<Unit<S>> to_world = normalise(w.pose(id).orientation * body.principal);
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3<Unit<S>> own = {Unit<S>(0), Unit<S>(0), Unit<S>(0)};
      own[axis] = Unit<S>(1);
      const double along = dot(real(rotate(to_world, own)), spin), kappa = to_double(body.kappa[axis]);
      if (kappa > 0) sum += along * along / kappa / 2;
    }
    return sum;
  }
  static double height(const World<S>& w, BodyId id) { return real(w.center_of_mass(id)).y; }

  /// [1] Lowest and highest energy over the start's, counted from where the ball touches.
  struct Kept {
    double least = 1, most = 1;
    int bounces = 0;
  };
  static Kept drop_ball(int hz, double fall, int seconds, SolverName solver) {
    World<S> w = world(hz, -10, solver);
    add_ground(w);
    const BodyId id = w.create(elastic(moving<S>(add_ball(w, 0.125), {0, 0.125 + fall, 0}), 1));
    const double start = 10 * fall;
    Kept kept;
    double before = 0;
    for (int i = 0; i < seconds * hz; ++i) {
      w.step();
      const double now = (energy(w, id) - 1.25) / start, v = real(w.velocity(id)).y;
      kept.least = std::min(kept.least, now);
      kept.most = std::max(kept.most, now);
      kept.bounces += before < 0 && v > 0;
      before = v;
    }
    return kept;
  }

  enum class Ground { plane, box, mesh, field };
  static BodyId lay(World<S>& w, Ground kind, double cell) {
    constexpr int kCells = 12;
    std::vector<Vec3<double>> points;
    std::vector<MeshTriangle> triangles;
    const double half = kCells * cell / 2;
    for (int k = 0; k <= kCells; ++k) {
      for (int i = 0; i <= kCells; ++i) {
        points.push_back({i * cell - half, 0, k * cell - half});
        if (i == kCells || k == kCells) continue;
        const auto at = static_cast<std::uint32_t>(k * (kCells + 1) + i), below = at + kCells + 1;
        triangles.push_back({{at, below, at + 1}});
        triangles.push_back({{below + 1, at + 1, below}});
      }
    }
    const std::vector<double> heights(points.size(), 0);
    ShapeId shape;
    switch (kind) {
      case Ground::plane: return add_ground(w);
      case Ground::box: shape = add_box(w, 4, 1, 4); break;
      case Ground::mesh: shape = w.add_shape(mesh_blob(points, triangles).value()); break;
      case Ground::field:
        shape = w.add_shape(height_field_blob({kCells + 1, kCells + 1, cell}, heights).value());
        break;
    }
    BodyDefinition<S> d = still<S>(shape);
    if (kind == Ground::box) d.position.y = S(-1);
    if (kind == Ground::field) d.position = vec<S>(-half, 0, -half);
    return w.create(d);
  }
};
TYPED_TEST_SUITE(Restitution, AllScalars);

// Ten bounces from 4.9 m: 0.36 % is what a mean square error of 3 J^2 of 480 J allows.
TYPED_TEST(Restitution, of_one_keeps_the_energy_of_a_ball_at_every_rate) {
  for (const int hz : {60, 100, 240, 480, 1000}) {
    const auto kept = this->drop_ball(hz, 4.9, 10, SolverName::soft_step);
    EXPECT_GT(kept.least, pick<TypeParam>(0.999, 0.999, 1 - kFixedBar, 0.999)) << hz;
    EXPECT_LT(kept.most, pick<TypeParam>(1.001, 1.001, 1 + kFixedBar, 1.001)) << hz;
    EXPECT_GE(kept.bounces, 4) << hz;
  }
}

// A ball of a fall of 4 mm meets at 0.28 m/s, a little above the threshold.
TYPED_TEST(Restitution, keeps_low_bounces_down_to_the_threshold) {
  for (const double fall : {0.004, 0.01, 0.1}) {
    const auto kept = this->drop_ball(60, fall, 2, SolverName::soft_step);
    const double bar = 0.01 * kept.bounces * pick<TypeParam>(1, 1, 2, 1);
    EXPECT_GT(kept.least, 1 - bar) << fall;
    EXPECT_LT(kept.most, 1 + bar) << fall;
    EXPECT_GE(kept.bounces, 1 / std::sqrt(0.8 * fall) - 1) << fall;
  }
}

TYPED_TEST(Restitution, of_no_solver_gains_energy_for_a_ball) {
  for (std::uint32_t solver = 0; solver < kSolvers; ++solver) {
    if (left_out(SolverName{solver}) != nullptr) continue;
    const auto kept = this->drop_ball(60, 2, 10, static_cast<SolverName>(solver));
    EXPECT_LT(kept.most, pick<TypeParam>(1.001, 1.001, 1 + kFixedBar, 1.001)) << kSolverNames[solver];
  }
}

TYPED_TEST(Restitution, of_flat_falls_is_that_of_a_ball_and_turns_nothing) {
  using S = TypeParam;
  Dice dice(42);
  for (int n = 0; n < 24; ++n) {
    World<S> w = this->world(60);
    const double fall = dice.in(0.3, 3), e = dice.in(0.5, 1), turned = dice.in(0, 3), cell = dice.in(0.15, 0.6);
    const double x = dice.in(-0.2, 0.2), z = dice.in(-0.2, 0.2), half = dice.in(0.05, 0.4);
    this->lay(w, static_cast<typename TestFixture::Ground>(n % 4), cell);
    const ShapeId shape =
        n / 4 % 2 == 0 ? add_box(w, 0.5, half, 0.3) : w.add_shape(Cylinder<S>{num<S>(0.4), num<S>(half)});
    BodyDefinition<S> d = this->elastic(moving<S>(shape, {x, fall + half, z}), e, 0.6);
    d.orientation = turn<S>({0, 1, 0}, turned);
    const BodyId id = w.create(d);
    double apex = 0, spin = 0, before = -1;
    const double start = this->energy(w, id);
    for (int i = 0; i < 200 && !(before > 0 && real(w.velocity(id)).y < 0); ++i) {
      before = real(w.velocity(id)).y;
      w.step();
      if (real(w.velocity(id)).y > 0 || before > 0) apex = std::max(apex, this->height(w, id) - half);
      spin = std::max(spin, length(real(w.angular_velocity(id))));
      EXPECT_LT(this->energy(w, id), start * pick<S>(1.001, 1.001, 1.005, 1.001)) << n;
    }
    EXPECT_NEAR(apex, e * e * fall, 0.02 * e * e * fall) << n << " e " << e << " fall " << fall;
    EXPECT_LT(spin, pick<S>(0.01, 0.01, 0.05, 0.01)) << n;
  }
}

// Without gravity and friction, between walls.
TYPED_TEST(Restitution, of_plates_and_cylinders_that_collide_gives_no_energy) {
  using S = TypeParam;
  for (const double e : {1.0, 0.7}) {
    for (int kind = 0; kind < 2; ++kind) {
      World<S> w = this->world(60, 0);
      for (int axis = 0; axis < 3; ++axis) {
        for (const int side : {-1, 1}) {
          Vec3<Unit<S>> normal = {Unit<S>(0), Unit<S>(0), Unit<S>(0)};
          normal[axis] = Unit<S>(side);
          w.create(this->elastic(still<S>(w.add_shape(HalfSpace<S>{normal, S(-2)})), e));
        }
      }
      const ShapeId shape = kind == 0 ? add_box(w, 0.5, 0.0625, 0.5) : w.add_shape(Cylinder<S>{S(0.375), S(0.125)});
      std::vector<BodyId> all;
      Dice dice(7);
      for (int i = 0; i < 12; ++i) {
        const D3 speed = dice.point(3), spin = dice.point(1);
        BodyDefinition<S> d =
            moving<S>(shape, {1.3 * (i % 3 - 1), 0.8 * (i / 6) - 0.5, 1.3 * (i / 3 % 2) - 0.6}, speed);
        d.angular_velocity = vec<S>(spin.x, spin.y, spin.z);
        all.push_back(w.create(this->elastic(d, e)));
      }
      const auto sum = [&] {
        double energy = 0;
        for (const BodyId id : all) energy += this->energy(w, id, 0);
        return energy;
      };
      const double start = sum();
      double most = start;
      for (int i = 0; i < 600; ++i) {
        w.step();
        most = std::max(most, sum());
      }
      EXPECT_LT(most, start * pick<S>(1.005, 1.005, 1.02, 1.005)) << e << " " << kind;
    }
  }
}

// SimBenchmark's elastic 666 (Kang and Hwangbo 2018) in small: 64 balls of 10 cm, two seconds, a hundredth of a second.
TYPED_TEST(Restitution, of_a_crowd_of_elastic_balls_keeps_its_energy) {
  using S = TypeParam;
  World<S> w = this->world(100);
  add_ground(w);
  const ShapeId shape = add_ball(w, 0.1);
  std::vector<BodyId> all;
  Dice dice(3);
  for (int i = 0; i < 64; ++i) {
    const D3 off = dice.point(0.0005);
    const D3 at = {0.21 * (i % 4) + off.x, 1.1 + 0.21 * (i / 16) + off.y, 0.21 * (i / 4 % 4) + off.z};
    all.push_back(w.create(this->elastic(moving<S>(shape, at), 1)));
  }
  const auto sum = [&] {
    double energy = 0;
    for (const BodyId id : all) energy += this->energy(w, id);
    return energy;
  };
  const double start = sum();
  double least = start, most = start;
  for (int i = 0; i < 200; ++i) {
    w.step();
    least = std::min(least, sum());
    most = std::max(most, sum());
  }
  EXPECT_GT(least, 0.97 * start);
  EXPECT_LT(most, 1.01 * start);
}

}  // namespace restitution_test
}  // namespace isostep::test
