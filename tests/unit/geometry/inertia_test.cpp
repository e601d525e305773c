// Closed forms of inertia and sums of them, against quadrature in double, for every scalar: O28.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/inertia.hpp"

#include <gtest/gtest.h>

#include "isostep/articulation/articulation_link.hpp"
#include "isostep/geometry/mass_tensor.hpp"
#include "oracle.hpp"

namespace isostep {
namespace inertia_test {

using oracle::D3;
using oracle::PointMass;
using Cloud = std::vector<PointMass>;  // volumes are shares of the mass

template <class S> struct Tolerance;
template <> struct Tolerance<float> { static constexpr double relative = 1e-6; };
template <> struct Tolerance<double> { static constexpr double relative = 1e-12; };
template <> struct Tolerance<Q16_16> { static constexpr double relative = 1e-3; };
template <> struct Tolerance<Q32_32> { static constexpr double relative = 1e-8; };

struct Moments {
  double mass = 0;
  D3 centre = {0, 0, 0};
  double tensor[3][3] = {};
};
Moments moments_of(const Cloud& cloud, const D3* about = nullptr) {
  Moments m;
  for (const PointMass& p : cloud) m.mass += p.volume;
  for (const PointMass& p : cloud) m.centre += p.at * (p.volume / m.mass);
  for (const PointMass& p : cloud) {
    const D3 d = p.at - (about != nullptr ? *about : m.centre);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m.tensor[i][j] += p.volume * ((i == j ? dot(d, d) : 0) - d[i] * d[j]);
    }
  }
  return m;
}
Cloud scaled(Cloud cloud, double mass) {
  double whole = 0;
  for (const PointMass& p : cloud) whole += p.volume;
  for (PointMass& p : cloud) p.volume *= mass / whole;
  return cloud;
}
/// Discs between low and high of squared radius q(y), with a hole of squared radius hole.
template <class Q> Cloud revolved(double low, double high, Q q, double hole = 0) {
  Cloud cloud, gone;
  oracle::add_revolved(cloud, low, high, q);
  if (hole > 0) oracle::add_revolved(gone, low, high, [hole](double) { return hole; });
  for (const PointMass& p : gone) cloud.push_back({p.at, -p.volume});
  return cloud;
}
/// A sphere's surface has as much area between two heights as its cylinder.
Cloud shell(double r) {
  Cloud cloud;
  double heights[2];
  oracle::gauss(-r, r, heights);
  for (const double y : heights) {
    for (int a = 0; a < 8; ++a) {
      const double angle = a * std::acos(-1.0) / 4, aside = std::sqrt(r * r - y * y);
      cloud.push_back({{aside * std::cos(angle), y, aside * std::sin(angle)}, 1});
    }
  }
  return cloud;
}
Cloud rod(double half) {
  double y[2];
  oracle::gauss(-half, half, y);
  return {{{0, y[0], 0}, 1}, {{0, y[1], 0}, 1}};
}
Cloud box(D3 half) { return oracle::cloud_of(primitive_of(Box<double>{half})); }
/// Four points, exact for squares: Keast 1986, rule of degree 2.
Cloud tetrahedron(D3 a, D3 b, D3 c, D3 d) {
  const double far = (5 + 3 * std::sqrt(5.0)) / 20, near = (5 - std::sqrt(5.0)) / 20;
  const D3 all = (a + b + c + d) * near;
  Cloud cloud;
  for (const D3& corner : {a, b, c, d}) cloud.push_back({all + corner * (far - near), 1});
  return cloud;
}
Cloud placed(Cloud cloud, const Pose<double>& pose) {
  for (PointMass& p : cloud) p.at = pose.position + to_matrix(pose.orientation) * p.at;
  return cloud;
}
Cloud joined(Cloud a, const Cloud& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

template <class S> class InertiaOf : public testing::Test {
 protected:
  static S number(double x) { return from_double<S>(x); }
  /// Sizes and masses that S holds to three digits and more.
  double size() { return random_.in(0.5, 3); }
  double mass() { return random_.in(1, 20); }

  static void expect_solid(double y, double x, double z) {
    const double slack = 1e-3 * (x + y + z);
    EXPECT_LE(x, y + z + slack);
    EXPECT_LE(y, z + x + slack);
    EXPECT_LE(z, x + y + slack);
  }
  static void expect(Vec3<S> got, const Cloud& cloud, double m, const char* what, const D3* about = nullptr) {
    const Moments wanted = moments_of(scaled(cloud, m), about);
    double largest = 0;
    for (int i = 0; i < 3; ++i) largest = std::fmax(largest, wanted.tensor[i][i]);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(to_double(got[i]), wanted.tensor[i][i], Tolerance<S>::relative * largest) << what << ' ' << i;
      for (int j = 0; j < i; ++j) EXPECT_NEAR(wanted.tensor[i][j], 0, 1e-12 * largest) << what;
    }
    expect_solid(to_double(got.y), to_double(got.x), to_double(got.z));
  }
  static void expect(const MassTensor<S>& got, const Cloud& cloud) {
    const Moments wanted = moments_of(cloud);
    double largest = 0;
    for (int i = 0; i < 3; ++i) largest = std::fmax(largest, wanted.tensor[i][i]);
    EXPECT_NEAR(to_double(got.mass), wanted.mass, Tolerance<S>::relative * wanted.mass);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(to_double(got.centre[i]), wanted.centre[i], Tolerance<S>::relative * 10);
      for (int j = 0; j < 3; ++j) {
        // A tensor is turned from both sides.
        EXPECT_NEAR(to_double(got.tensor.rows[i][j]), wanted.tensor[i][j], 2 * Tolerance<S>::relative * largest)
            << i << ' ' << j;
        EXPECT_EQ(got.tensor.rows[i][j], got.tensor.rows[j][i]);
      }
    }
    const double xx = to_double(got.tensor.rows[0].x), zz = to_double(got.tensor.rows[2].z);
    expect_solid(to_double(got.tensor.rows[1].y), xx, zz);
  }
  /// As S holds it, so that the oracle has the same sizes.
  double held(double x) { return to_double(number(x)); }
  D3 held(D3 v) { return {held(v.x), held(v.y), held(v.z)}; }
  D3 sizes() {
    const double x = size(), y = size();
    return held(D3{x, y, size()});
  }
  Vec3<S> vector(D3 v) { return {number(v.x), number(v.y), number(v.z)}; }
  Pose<S> pose() {
    const D3 at = random_.point(3);
    return {vector(at), random_.orientation<S>()};
  }
  static Pose<double> real(const Pose<S>& p) {
    const auto& q = p.orientation;
    return {oracle::real(p.position),
            normalise(Quat<double>{to_double(q.x), to_double(q.y), to_double(q.z), to_double(q.w)})};
  }

  oracle::Random random_{7};
};
using Scalars = testing::Types<float, double, Q16_16, Q32_32>;
TYPED_TEST_SUITE(InertiaOf, Scalars);

TYPED_TEST(InertiaOf, RoundThingsAreWhatQuadratureSays) {
  using S = TypeParam;
  for (int n = 0; n < 50; ++n) {
    const double m = this->held(this->mass()), r = this->held(this->size()), h = this->held(this->size());
    const double inner = this->held(r * 0.7);
    const S ms = this->number(m), rs = this->number(r), hs = this->number(h), is = this->number(inner);
    const auto ball = [&](double y) { return r * r - y * y; };
    const auto even = [&](double) { return r * r; };
    const auto cone = [&](double y) { return r * r * (h - y) * (h - y) / (4 * h * h); };
    const D3 apex = {0, h, 0};
    this->expect(inertia_of_sphere(ms, rs), revolved(-r, r, ball), m, "sphere");
    this->expect(inertia_of_spherical_shell(ms, rs), shell(r), m, "shell");
    this->expect(inertia_of_cylinder(ms, rs, hs), revolved(-h, h, even), m, "cylinder");
    this->expect(inertia_of_tube(ms, is, rs, hs), revolved(-h, h, even, inner * inner), m, "tube");
    this->expect(inertia_of_cone(ms, rs, hs), revolved(-h, h, cone), m, "cone");
    this->expect(inertia_of_cone_at_apex(ms, rs, hs), revolved(-h, h, cone), m, "cone at its apex", &apex);
    this->expect(inertia_of_capsule(ms, rs, hs), oracle::cloud_of(primitive_of(Capsule<double>{r, h})), m, "capsule");
  }
}

TYPED_TEST(InertiaOf, OthersToo) {
  for (int n = 0; n < 50; ++n) {
    const double m = this->held(this->mass()), h = this->held(this->size());
    const D3 half = this->sizes(), end = {0, -h, 0};
    const auto ms = this->number(m), hs = this->number(h);
    Cloud ellipsoid = revolved(-1, 1, [](double y) { return 1 - y * y; });
    for (PointMass& p : ellipsoid) p.at = {p.at.x * half.x, p.at.y * half.y, p.at.z * half.z};
    this->expect(inertia_of_ellipsoid(ms, this->vector(half)), ellipsoid, m, "ellipsoid");
    this->expect(inertia_of_box(ms, this->vector(half)), box(half), m, "box");
    this->expect(inertia_of_rod(ms, hs), rod(h), m, "rod");
    this->expect(inertia_of_rod_at_end(ms, hs), rod(h), m, "rod at its end", &end);
  }
}

TYPED_TEST(InertiaOf, ATetrahedronIsWhatQuadratureSays) {
  using S = TypeParam;
  for (int n = 0; n < 50; ++n) {
    const double m = this->held(this->mass());
    D3 corners[4];
    for (D3& corner : corners) corner = this->held(this->random_.point(3));
    const MassTensor<S> got =
        MassTensor<S>::tetrahedron(this->number(m), this->vector(corners[0]), this->vector(corners[1]),
                                   this->vector(corners[2]), this->vector(corners[3]));
    this->expect(got, scaled(tetrahedron(corners[0], corners[1], corners[2], corners[3]), m));
  }
}

TYPED_TEST(InertiaOf, PartsAddUpByParallelAxes) {
  using S = TypeParam;
  for (int n = 0; n < 50; ++n) {
    MassTensor<S> sum;
    Cloud all;
    for (int i = 0; i < 1 + n % 5; ++i) {
      const double m = this->held(this->random_.in(1, 5));
      const D3 half = this->sizes();
      const Pose<S> pose = this->pose();
      const MassTensor<S> part =
          MassTensor<S>::solid(this->number(m), inertia_of_box(this->number(m), this->vector(half)));
      const MassTensor<S> laid = part.placed(pose);
      const Cloud cloud = placed(scaled(box(half), m), this->real(pose));
      this->expect(laid, cloud);
      sum = i == 0 ? laid : sum + laid;
      all = joined(all, cloud);
    }
    const D3 at = this->held(this->random_.point(1));
    sum = sum + MassTensor<S>::point(S(2), this->vector(at));
    all.push_back({at, 2});
    this->expect(sum, all);
    const D3 other = this->held(this->random_.point(2));
    const Moments wanted = moments_of(all, &other);
    const Mat3<S> moved = sum.about(this->vector(other));
    const double largest = wanted.tensor[0][0] + wanted.tensor[1][1] + wanted.tensor[2][2];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(to_double(moved.rows[i][j]), wanted.tensor[i][j], Tolerance<S>::relative * largest);
    }
  }
}

TYPED_TEST(InertiaOf, ABoxOfFiveTetrahedraIsTheBox) {
  using S = TypeParam;
  const S x = S(1), y = S(1.5), z = S(2), m = S(12);
  const Vec3<S> a = {x, y, z}, b = {x, -y, -z}, c = {-x, y, -z}, d = {-x, -y, z};
  const auto corner = [&](Vec3<S> p, Vec3<S> q, Vec3<S> r, Vec3<S> s) {
    return MassTensor<S>::tetrahedron(S(2), p, q, r, s);
  };
  const MassTensor<S> sum = MassTensor<S>::tetrahedron(S(4), a, b, c, d) + corner({x, y, -z}, a, b, c) +
                            corner({x, -y, z}, a, b, d) + corner({-x, y, z}, a, c, d) + corner({-x, -y, -z}, b, c, d);
  const Vec3<S> wanted = inertia_of_box(m, {x, y, z});
  EXPECT_EQ(sum.mass, m);
  for (int i = 0; i < 3; ++i) {
    const double largest = to_double(wanted.x);
    EXPECT_NEAR(to_double(sum.tensor.rows[i][i]), to_double(wanted[i]), Tolerance<S>::relative * largest);
    EXPECT_NEAR(to_double(sum.tensor.rows[i][(i + 1) % 3]), 0, Tolerance<S>::relative * largest);
  }
}

TYPED_TEST(InertiaOf, PropertiesAreThoseOfShapes) {
  using S = TypeParam;
  for (int n = 0; n < 50; ++n) {
    const D3 half = this->sizes();
    const Pose<S> pose = this->pose(), other = this->pose();
    const auto child = [&](Pose<S> at) { return Child<S>{primitive_of(Box<S>{this->vector(half)}), at}; };
    const std::vector<Child<S>> children = {child(pose), child(other)};
    const MassProperties<S> wanted = mass_properties<S>(std::span<const Child<S>>(children), S(0.125));
    const S mass = wanted.mass * S(0.5);
    const MassTensor<S> part = MassTensor<S>::solid(mass, inertia_of_box(mass, this->vector(half)));
    const MassProperties<S> got = (part.placed(pose) + part.placed(other)).properties();
    for (int i = 0; i < 3; ++i) {
      const double kappa = to_double(wanted.kappa[i]);
      EXPECT_NEAR(to_double(got.kappa[i]), kappa, 4 * Tolerance<S>::relative * kappa + 1e-9) << n;
      EXPECT_NEAR(to_double(got.centre[i]), to_double(wanted.centre[i]), Tolerance<S>::relative * 10);
    }
    // And back to moments, as an articulation's link takes them.
    if constexpr (std::is_same_v<Finer<S>, S>) {
      const LinkMass<S> link = LinkMass<S>::of(got);
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(to_double(link.inertia[i]) * to_double(got.kappa[i]), to_double(got.mass),
                    1e-5 * to_double(got.mass));
    }
  }
}

TYPED_TEST(InertiaOf, WhatHasNoInertiaAboutAnAxisHasNoKappaThere) {
  using S = TypeParam;
  const MassTensor<S> rod = MassTensor<S>::solid(S(3), inertia_of_rod(S(3), S(1)));
  const MassProperties<S> got = rod.properties();
  EXPECT_NEAR(to_double(got.kappa.x), 3, 0.01);
  EXPECT_EQ(got.kappa.y, S(0));
  EXPECT_EQ(MassTensor<S>::point(S(1), Vec3<S>::zero()).properties().kappa, Vec3<S>::zero());
}

}  // namespace inertia_test
}  // namespace isostep
