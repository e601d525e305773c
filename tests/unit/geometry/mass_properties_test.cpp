// Mass properties against quadrature in double, for every scalar.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/mass_properties.hpp"

#include <gtest/gtest.h>

#include "isostep/geometry/limits.hpp"
#include "oracle.hpp"

namespace isostep {
namespace mass_properties_test {

using oracle::D3;

/// The range promised for a scalar and the relative error allowed there, beside rounding to S.
template <class S> struct Promise;
template <> struct Promise<float> { static constexpr double low = 0.02, high = 20, one = 4e-7, several = 1e-6; };
template <> struct Promise<double> { static constexpr double low = 0.02, high = 20, one = 1e-14, several = 1e-13; };
template <> struct Promise<Q16_16> { static constexpr double low = 0.1, high = 10, one = 1e-5, several = 1e-4; };
template <> struct Promise<Q32_32> { static constexpr double low = 0.02, high = 20, one = 1e-10, several = 2e-9; };

template <class S> double step() { return kIsFixed<S> ? to_double(resolution<S>()) : 0.0; }

/// Mass, centre and inertia tensor about the centre, of density 1.
struct Reference {
  double volume = 0;
  D3 centre = {0, 0, 0};
  double inertia[3][3] = {};
};

template <class S> Reference integrate_cloud(const std::vector<Child<S>>& children) {
  Reference ref;
  std::vector<oracle::PointMass> all;
  for (const Child<S>& child : children) {
    const Transform<double> t = oracle::real(Transform<S>::of(child.pose));
    for (const auto& m : oracle::cloud_of(oracle::real(child.primitive))) all.push_back({to_world(t, m.at), m.volume});
  }
  for (const auto& m : all) ref.volume += m.volume;
  for (const auto& m : all) ref.centre += m.at * (m.volume / ref.volume);
  for (const auto& m : all) {
    const D3 d = m.at - ref.centre;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      ref.inertia[i][i] += m.volume * (d[j] * d[j] + d[k] * d[k]);
      ref.inertia[i][j] -= m.volume * d[i] * d[j];
      ref.inertia[j][i] -= m.volume * d[i] * d[j];
    }
  }
  return ref;
}

template <class S> MassProperties<S> properties_of(const std::vector<Child<S>>& children, S density) {
  return mass_properties<S>(std::span<const Child<S>>(children), density);
}

template <class S> Child<S> at_origin(const Primitive<S>& p) { return {p, Pose<S>::identity()}; }

/// Largest entry of |I kappa - 1| over the principal frame, I from the cloud: zero when axes and values are right.
template <class S> void expect_inverse(const Reference& ref, const MassProperties<S>& got, double relative) {
  const Transform<double> axes = oracle::real(Transform<S>{Vec3<S>::zero(), to_matrix(got.principal)});
  double least = 1e300;
  double principal[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const D3 a = axes.rotation.column(i), b = axes.rotation.column(j);
      double sum = 0;
      for (int k = 0; k < 3; ++k) {
        for (int l = 0; l < 3; ++l) sum += a[k] * ref.inertia[k][l] * b[l];
      }
      principal[i][j] = sum / ref.volume;
    }
    least = std::fmin(least, principal[i][i]);
  }
  for (int i = 0; i < 3; ++i) {
    const double expected = 1 / principal[i][i];
    EXPECT_NEAR(to_double(got.kappa[i]), expected, relative * expected + step<S>()) << "axis " << i;
    for (int j = 0; j < i; ++j) {
      const double size = std::sqrt(principal[i][i] * principal[j][j]);
      EXPECT_NEAR(principal[i][j] / size, 0, 20 * relative) << "axes " << i << ' ' << j;
    }
  }
}

template <class S> class MassPropertiesTest : public testing::Test {};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(MassPropertiesTest, Scalars);

TEST(MassProperties, OracleCloudsAgreeWithTheVoxelSum) {
  // The cloud itself, against the crudest method there is: counting small cubes.
  const Primitive<double> capsule = primitive_of(Capsule<double>{0.4, 0.7});
  const std::vector<Child<double>> list = {at_origin(capsule)};
  const Reference fine = integrate_cloud(list);
  const int n = 200;
  const double cell = 2.2 / n;
  double volume = 0, along = 0, across = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (int k = 0; k < n; ++k) {
        const D3 p = {-1.1 + (i + 0.5) * cell, -1.1 + (j + 0.5) * cell, -1.1 + (k + 0.5) * cell};
        if (oracle::signed_distance(capsule, p) > 0) continue;
        const double dv = cell * cell * cell;
        volume += dv;
        along += dv * (p.x * p.x + p.z * p.z);
        across += dv * (p.y * p.y + p.z * p.z);
      }
    }
  }
  EXPECT_NEAR(fine.volume / volume, 1, 2e-3);
  EXPECT_NEAR(fine.inertia[1][1] / along, 1, 4e-3);
  EXPECT_NEAR(fine.inertia[0][0] / across, 1, 4e-3);
}

TYPED_TEST(MassPropertiesTest, ACubeOfHalfAMetreHasKappaSixExactly) {
  using S = TypeParam;
  const auto cube = at_origin(primitive_of(Box<S>{{S(0.5), S(0.5), S(0.5)}}));
  const MassProperties<S> got = properties_of<S>({cube}, S(2));
  EXPECT_EQ(to_double(got.mass), 2);
  EXPECT_EQ(got.kappa, (Vec3<S>{S(6), S(6), S(6)}));
  EXPECT_EQ(got.centre, Vec3<S>::zero());
}

TYPED_TEST(MassPropertiesTest, OnePrimitiveMatchesIntegrationOverTheWholeRangeOfSizes) {
  using S = TypeParam;
  using P = Promise<S>;
  oracle::Random random(1);
  for (int n = 0; n < 300; ++n) {
    const auto primitive = random.primitive<S>(n % 4, P::low / 2, P::high / 2);
    const std::vector<Child<S>> list = {at_origin(primitive)};
    const Reference ref = integrate_cloud(list);
    const MassProperties<S> got = properties_of(list, S(1));
    SCOPED_TRACE(n);
    const double mass = std::fmin(ref.volume, to_double(Limits<S>::mass()));
    const double least = kIsFixed<S> ? 5e-4 * mass + 2 * step<S>() : 1e-6 * mass + 1e-7;
    EXPECT_NEAR(to_double(got.mass), mass, least);
    for (int i = 0; i < 3; ++i) {
      const double expected = ref.volume / ref.inertia[i][i];
      EXPECT_NEAR(to_double(got.kappa[i]), expected, P::one * expected + step<S>());
    }
  }
}

TYPED_TEST(MassPropertiesTest, AConesCentreIsAQuarterOfItsHeightAboveTheBase) {
  using S = TypeParam;
  using P = Promise<S>;
  oracle::Random random(13);
  for (int n = 0; n < 100; ++n) {
    const std::vector<Child<S>> list = {at_origin(random.primitive<S>(4, P::low, P::high / 2))};
    const MassProperties<S> got = properties_of(list, S(1));
    EXPECT_EQ(got.centre, (Vec3<S>{S(0), list[0].primitive.half.y * S(-0.5), S(0)}));
    expect_inverse(integrate_cloud(list), got, P::several);
  }
}

TYPED_TEST(MassPropertiesTest, OneChildKeepsItsPose) {
  using S = TypeParam;
  oracle::Random random(2);
  const Pose<S> pose = {{S(1), S(-2), S(0.5)}, random.orientation<S>()};
  const std::vector<Child<S>> list = {{primitive_of(Capsule<S>{S(0.25), S(0.75)}), pose}};
  const MassProperties<S> got = properties_of(list, S(1));
  EXPECT_EQ(got.centre, pose.position);
  EXPECT_EQ(got.principal, pose.orientation);
  expect_inverse(integrate_cloud(list), got, Promise<S>::several);
}

TYPED_TEST(MassPropertiesTest, CompoundsMatchIntegration) {
  using S = TypeParam;
  using P = Promise<S>;
  oracle::Random random(3);
  for (int n = 0; n < 200; ++n) {
    const double size = random.size(P::low * 2, P::high / 4);  // children within a factor of eight of each other
    std::vector<Child<S>> list;
    const int children = 2 + n % 5;
    for (int i = 0; i < children; ++i) {
      const auto primitive = random.primitive<S>((n + i) % 5, size / 4, size);
      list.push_back({primitive, {oracle::made<S>(random.point(2 * size)), random.orientation<S>()}});
    }
    const Reference ref = integrate_cloud(list);
    const MassProperties<S> got = properties_of(list, S(1));
    SCOPED_TRACE(n);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(to_double(got.centre[i]), ref.centre[i], P::several * size + 2 * step<S>());
    }
    expect_inverse(ref, got, P::several);
  }
}

TYPED_TEST(MassPropertiesTest, ABoxCutInHalvesIsTheBoxAgain) {
  using S = TypeParam;
  const Primitive<S> half = primitive_of(Box<S>{{S(0.5), S(1), S(1.5)}});
  Child<S> left = at_origin(half), right = at_origin(half);
  left.pose.position = {S(2.5), S(0), S(0)};
  right.pose.position = {S(3.5), S(0), S(0)};
  const MassProperties<S> got = properties_of<S>({left, right}, S(1));
  EXPECT_EQ(to_double(got.mass), 12);
  EXPECT_EQ(got.centre, (Vec3<S>{S(3), S(0), S(0)}));
  EXPECT_EQ(got.principal, Quat<Unit<S>>::identity()) << "already principal";
  const double expected[3] = {3 / 3.25, 3 / 3.25, 3 / 2.0};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(to_double(got.kappa[i]), expected[i], Promise<S>::several * expected[i]);
}

TYPED_TEST(MassPropertiesTest, ThinRodsWeighTheirTrueShare) {
  using S = TypeParam;
  // Volumes 4e-5 and less of the cube around the longer rod.
  Child<S> thin = at_origin(primitive_of(Box<S>{{S(0.0625), S(8), S(0.0625)}}));
  Child<S> thick = at_origin(primitive_of(Capsule<S>{S(0.125), S(1)}));
  thin.pose.position = {S(0), S(8), S(0)};
  thick.pose.position = {S(1), S(0), S(0.5)};
  const std::vector<Child<S>> list = {thin, thick};
  const Reference ref = integrate_cloud(list);
  const MassProperties<S> got = properties_of(list, S(1));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(to_double(got.centre[i]), ref.centre[i], Promise<S>::several);
  expect_inverse(ref, got, Promise<S>::several);
}

TYPED_TEST(MassPropertiesTest, ATurnedCompoundHasTheSameValuesAlongTurnedAxes) {
  using S = TypeParam;
  oracle::Random random(4);
  const Quat<Unit<S>> turn = random.orientation<S>();
  const Primitive<S> box = primitive_of(Box<S>{{S(0.25), S(0.5), S(1)}});
  std::vector<Child<S>> list = {at_origin(box), at_origin(box)};
  const Vec3<S> arm = {S(1), S(0.5), S(0.25)};
  list[0].pose.position = to_matrix(turn) * arm;
  list[1].pose.position = to_matrix(turn) * -arm;
  list[0].pose.orientation = list[1].pose.orientation = turn;
  const MassProperties<S> got = properties_of(list, S(1));
  expect_inverse(integrate_cloud(list), got, Promise<S>::several);
  EXPECT_FALSE(got.principal.w < Unit<S>(0));
}

TYPED_TEST(MassPropertiesTest, PrincipalInertiasObeyTheTriangleInequality) {
  using S = TypeParam;
  oracle::Random random(5);
  for (int n = 0; n < 200; ++n) {
    std::vector<Child<S>> list;
    for (int i = 0; i <= n % 4; ++i) {
      list.push_back(
          {random.primitive<S>((n + i) % 5, 0.1, 2), {oracle::made<S>(random.point(3)), random.orientation<S>()}});
    }
    const MassProperties<S> got = properties_of(list, S(1));
    const D3 j = {1 / to_double(got.kappa.x), 1 / to_double(got.kappa.y), 1 / to_double(got.kappa.z)};
    const double slack = (j.x + j.y + j.z) * 2e-3;
    EXPECT_GT(to_double(min(got.kappa.x, min(got.kappa.y, got.kappa.z))), 0);
    EXPECT_LE(j.x, j.y + j.z + slack);
    EXPECT_LE(j.y, j.z + j.x + slack);
    EXPECT_LE(j.z, j.x + j.y + slack);
  }
}

TYPED_TEST(MassPropertiesTest, TheOrderOfChildrenChangesNothingBeyondRounding) {
  using S = TypeParam;
  oracle::Random random(6);
  std::vector<Child<S>> list;
  for (int i = 0; i < 4; ++i) {
    list.push_back({random.primitive<S>(i % 3, 0.3, 1), {oracle::made<S>(random.point(2)), random.orientation<S>()}});
  }
  const MassProperties<S> forward = properties_of(list, S(1));
  const std::vector<Child<S>> reversed(list.rbegin(), list.rend());
  const MassProperties<S> backward = properties_of(reversed, S(1));
  for (int i = 0; i < 3; ++i) {
    const double kappa = to_double(forward.kappa[i]);
    EXPECT_NEAR(to_double(backward.kappa[i]), kappa, Promise<S>::several * kappa);
  }
}

TYPED_TEST(MassPropertiesTest, MassSaturatesAndNeverVanishes) {
  using S = TypeParam;
  const S big = Limits<S>::extent(), small = Limits<S>::minimum_size();
  const auto mountain = at_origin(primitive_of(Box<S>{{big, big, big}}));
  const MassProperties<S> heavy = properties_of<S>({mountain, mountain}, Limits<S>::mass());
  EXPECT_EQ(heavy.mass, Limits<S>::mass());
  const auto grain = at_origin(primitive_of(Sphere<S>{small}));
  const MassProperties<S> light = properties_of<S>({grain}, resolution<S>());
  EXPECT_EQ(light.mass, resolution<S>());
  EXPECT_NEAR(to_double(light.kappa.x), 2.5 / (to_double(small) * to_double(small)), 1e-3 * to_double(light.kappa.x));
}

TYPED_TEST(MassPropertiesTest, DenseSmallAndThinThingsWeighWhatTheyShould) {
  using S = TypeParam;
  const auto bearing = at_origin(primitive_of(Sphere<S>{S(0.0625)}));
  EXPECT_NEAR(to_double(properties_of<S>({bearing}, S(7800)).mass), 7800 * 1.0226538585904274e-3, 5e-4);
  const auto plate = at_origin(primitive_of(Box<S>{{S(8), S(0.03125), S(8)}}));
  EXPECT_EQ(to_double(properties_of<S>({plate}, S(64)).mass), 1024);
}

TYPED_TEST(MassPropertiesTest, AHalfSpaceOrAnEmptyListIsImmovable) {
  using S = TypeParam;
  using U = Unit<S>;
  const auto floor = at_origin(primitive_of(HalfSpace<S>{{U(0), U(1), U(0)}, S(0)}));
  const auto ball = at_origin(primitive_of(Sphere<S>{S(1)}));
  for (const auto& list : {std::vector<Child<S>>{}, std::vector<Child<S>>{floor}, std::vector<Child<S>>{ball, floor}}) {
    const MassProperties<S> got = properties_of(list, S(1));
    EXPECT_EQ(got.mass, S(0));
    EXPECT_EQ(got.kappa, Vec3<S>::zero());
  }
}

TYPED_TEST(MassPropertiesTest, AUsersInertiaBecomesKappa) {
  using S = TypeParam;
  const auto got = from_mass_and_inertia<S>(S(8), {S(2), S(4), S(0)}, {S(0), S(1), S(0)});
  EXPECT_EQ(got.kappa, (Vec3<S>{S(4), S(2), S(0)}));
  EXPECT_EQ(got.centre.y, S(1));
  const auto heavier = with_mass(got, S(16));
  EXPECT_EQ(heavier.mass, S(16));
  EXPECT_EQ(heavier.kappa, got.kappa);
}

}  // namespace mass_properties_test
}  // namespace isostep
