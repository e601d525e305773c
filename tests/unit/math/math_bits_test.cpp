// The bits of the mathematics for games: hashes of every function's results, the same on every machine and compiler.
// SPDX-License-Identifier: MIT
#include <array>
#include <ostream>

#include "isostep/math/affine.hpp"
#include "isostep/math/angles.hpp"
#include "isostep/math/curves.hpp"
#include "isostep/math/draws.hpp"
#include "isostep/math/euler.hpp"
#include "isostep/math/frames.hpp"
#include "isostep/math/noise.hpp"
#include "isostep/math/rotations.hpp"
#include "isostep/math/vectors.hpp"
#include "oracle.hpp"

namespace isostep {
namespace math_bits_test {

using namespace test;

/// FNV-1a over the bits of what it is given.
class Bits {
 public:
  template <class T> void add(T x) {
    const auto bits = static_cast<std::uint64_t>(to_bits(x));
    for (int byte = 0; byte < 8; ++byte) hash_ = (hash_ ^ (bits >> 8 * byte & 0xff)) * 0x100000001b3u;
  }
  template <class T> void add(Vec3<T> v) { add(v.x), add(v.y), add(v.z); }
  template <class T> void add(Quat<T> q) { add(q.x), add(q.y), add(q.z), add(q.w); }
  template <class T> void add(const Mat3<T>& m) { add(m.rows[0]), add(m.rows[1]), add(m.rows[2]); }
  std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325u;
};

/// One draw of arguments.
template <class S> struct Arguments {
  using U = Unit<S>;
  explicit Arguments(Draw& draw)
      : a(draw.vector<S>(3)),
        b(draw.vector<S>(3)),
        p(draw.rotation<S>()),
        q(draw.rotation<S>()),
        m(draw.direction<S>()),
        n(draw.direction<S>()),
        angle(draw.number<S>(4)),
        t(abs(draw.number<U>(0))) {}
  Vec3<S> a, b;
  Quat<U> p, q;
  Vec3<U> m, n;
  S angle;
  U t;
};

template <class S> void add_rotations(const Arguments<S>& x, Bits& bits) {
  using U = Unit<S>;
  const AxisAngle<S> turn = axis_angle_of<S>(x.p);
  bits.add(turn.axis), bits.add(turn.angle);
  bits.add(rotation_vector_of<S>(x.q)), bits.add(rotation_by(x.a));
  bits.add(to_quaternion(to_matrix(x.p))), bits.add(rotation_between(x.m, x.n)), bits.add(look_rotation(x.a, x.b));
  bits.add(angle_between<S>(x.p, x.q)), bits.add(slerp(x.p, x.q, x.t)), bits.add(nlerp(x.p, x.q, x.t));
  const SwingTwist<U> parts = swing_twist_of(x.p, x.n);
  bits.add(parts.swing), bits.add(parts.twist);
  for (const EulerOrder order : {EulerOrder::xyz, EulerOrder::yxz, EulerOrder::zyx}) {
    bits.add(rotation_of(order, x.a.x, x.a.y, x.a.z));
    const EulerAngles<S> angles = euler_angles_of<S>(order, x.q);
    bits.add(angles.first), bits.add(angles.second), bits.add(angles.third);
  }
}
template <class S> void add_vectors(const Arguments<S>& x, Bits& bits) {
  bits.add(clamp_length(x.a, S(1))), bits.add(move_towards(x.a, x.b, S(1)));
  bits.add(project_on_line(x.a, x.n)), bits.add(project_on_plane(x.a, x.n)), bits.add(reflect(x.a, x.n));
  bits.add(angle_between(x.a, x.b)), bits.add(signed_angle(x.a, x.b, convert<S>(x.n)));
  bits.add(basis_of(x.a, x.b).to_world), bits.add(change_of_basis(to_matrix(x.p), skew_of(x.a)));
  const Mat3<S> m = {{x.a, x.b, convert<S>(x.n)}};
  bits.add(determinant(m)), bits.add(inverse_of(m).inverse);
  bits.add(inverse_of(Affine<S>{m, x.a}).inverse.position);
}
template <class S> void add_curves(const Arguments<S>& x, Bits& bits) {
  bits.add(wrap_angle(x.angle)), bits.add(angle_difference(x.a.x, x.angle)), bits.add(lerp_angle(x.a.x, x.angle, x.t));
  bits.add(turn_towards(x.a.x, x.angle, S(0.25))), bits.add(to_degrees(x.angle)), bits.add(to_radians(x.angle));
  bits.add(lerp(x.a, x.b, x.t)), bits.add(inverse_lerp(x.a.x, x.b.x, x.angle));
  bits.add(smooth_step(x.t)), bits.add(smoother_step(x.t));
  const std::array<S, 4> coefficients = {x.a.x, x.a.y, x.a.z, S(0.5)};
  bits.add(polynomial(std::span<const S>(coefficients), convert<S>(x.t)));
  bits.add(hermite(x.a, x.b, x.b, x.a, x.t)), bits.add(hermite_slope(x.a, x.b, x.b, x.a, x.t));
  bits.add(catmull_rom(x.a, x.b, x.a, x.b, x.t)), bits.add(bezier(x.a, x.b, x.b, x.a, x.t));
  bits.add(value_noise(x.a, 7)), bits.add(gradient_noise(x.b, 7)), bits.add(fractal_noise(x.a, 7, 6));
}
template <class S> void add_draws(Pcg32& random, Bits& bits) {
  bits.add(random_normal<S>(random)), bits.add(random_direction<S>(random)), bits.add(random_rotation<S>(random));
  bits.add(random_in_ball(random, S(3))), bits.add(random_in_disc(random, S(3)));
  bits.add(random_in_box(random, Vec3<S>::zero(), Vec3<S>{S(1), S(2), S(3)}));
}

struct Hashes {
  std::uint64_t rotations, vectors, curves, draws;
  bool operator==(const Hashes&) const = default;
};
void PrintTo(const Hashes& h, std::ostream* out) {
  for (const std::uint64_t hash : {h.rotations, h.vectors, h.curves, h.draws}) *out << std::hex << hash << ' ';
}
template <class S> Hashes hashes() {
  Bits rotations, vectors, curves, draws;
  Draw draw(71);
  Pcg32 random = Pcg32::seeded(72);
  for (int i = 0; i < kDraws; ++i) {
    const Arguments<S> x(draw);
    add_rotations(x, rotations), add_vectors(x, vectors), add_curves(x, curves), add_draws<S>(random, draws);
  }
  return {rotations.hash(), vectors.hash(), curves.hash(), draws.hash()};
}

TEST(MathBits, AreThoseOfEveryMachine) {
  EXPECT_EQ(hashes<float>(),
            (Hashes{0xd90474ba279258f1u, 0xfd409efe375c3be0u, 0x974308a29ef18353u, 0xdff00c3a6528c533u}));
  EXPECT_EQ(hashes<double>(),
            (Hashes{0xacf84db3b763ea76u, 0xaba3e2a142450e5cu, 0x60bc3d01b8492206u, 0xd32128566cceddc9u}));
  EXPECT_EQ(hashes<Q16_16>(),
            (Hashes{0xf2d9851d6061eb4eu, 0xe4767bfbddee7f1du, 0xb07e6a9b0e993f97u, 0xaf51657aecf80e2eu}));
  EXPECT_EQ(hashes<Q32_32>(),
            (Hashes{0x9dc78b2c419afd32u, 0xee9d1cf11b6583adu, 0xc214b1c84d8453f7u, 0x6f9022f4a8d3cfbeu}));
}

}  // namespace math_bits_test
}  // namespace isostep
