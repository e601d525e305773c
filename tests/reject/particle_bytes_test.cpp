// Damaged portable forms of a particle world: refused with a reason, or a world that obeys every rule and steps.
// SPDX-License-Identifier: MIT
#include "determinism/particle_mess.hpp"

namespace isostep::test {
namespace particle_bytes_test {

/// One of everything that a form can hold, and few of it.
template <class S> std::vector<std::uint8_t> small_form() {
  ParticleSettings<S> settings = particle_settings<S>(-10, 2);
  settings.hz = 30;
  ParticleWorld<S> w(settings);
  const ParticleMaterialId balls = w.add(ball_material<S>(0.5, 0.25, 0.5));
  const ParticleMaterialId gone = w.add(ball_material<S>(1));
  add_plane(w);
  ParticleDefinition<S> d = particle_at<S>({0, 0.5, 0}, {0.25, 0, 0});
  d.material = balls;
  d.lifetime = 100;
  const ParticleId a = w.create(d);
  d.position = vec<S>(0.75, 0.5, 0);
  d.lifetime = 0;
  const ParticleId b = w.create(d), hole = w.create(particle_at<S>({9, 9, 9})),
                   pinned = w.create(pinned_at<S>({0, 3, 0}));
  Spring<S> spring = spring_of<S>(a, pinned, 10, 2.5);
  spring.elastic_limit = S(1);
  w.add(spring);
  const SpringId no_spring = w.add(spring);
  w.add(force_of<S>(ForceType::drag, a));
  w.add(Cohesion<S>{balls, S(1), S(1), S(1), S(2), S(1)});
  w.add(link_of<S>(LinkType::cable, b, pinned, 2.625));
  for (int i = 0; i < 3; ++i) w.step();
  w.destroy(hole);
  w.remove(gone);
  w.remove(no_spring);
  w.step();
  EXPECT_GT(w.counts().contacts, 1u);
  EXPECT_TRUE(w.apply_force(b, vec<S>(1, 2, 3)));
  ParticleTouch<S> touch = {};
  touch.particle = a;
  touch.normal.y = Unit<S>(-1);
  touch.friction = num<S>(0.5);
  touch.inverse_mass = num<InverseMass<S>>(0.5);
  EXPECT_TRUE(w.touch(touch));
  return bytes_of(w);
}

/// False: refused. The world is then as it was.
template <class S> bool survives(const std::vector<std::uint8_t>& bytes, ParticleWorld<S>& w) {
  const std::uint64_t before = w.hash();
  Reader reader(bytes);
  const Result<void> read = w.read_portable(reader);
  if (!read.ok()) {
    EXPECT_FALSE(read.error().message.view().empty());
    EXPECT_EQ(w.hash(), before) << "a refused form changed the world";
    return false;
  }
  EXPECT_EQ(broken_rule(w), "");
  for (int i = 0; i < 3; ++i) {
    w.step();
    EXPECT_EQ(broken_rule(w), "") << "step " << i;
  }
  return true;
}

template <class S> class ParticleBytes : public ::testing::Test {};
TYPED_TEST_SUITE(ParticleBytes, AllScalars);

TYPED_TEST(ParticleBytes, every_cut_is_refused) {
  using S = TypeParam;
  const std::vector<std::uint8_t> whole = small_form<S>();
  ParticleWorld<S> w;
  for (std::size_t length = 0; length < whole.size(); ++length) {
    const std::vector<std::uint8_t> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(length));
    ASSERT_FALSE(survives(cut, w)) << length << " of " << whole.size();
  }
  EXPECT_TRUE(survives(whole, w));
}

TYPED_TEST(ParticleBytes, every_flipped_bit_is_refused_or_gives_a_world_that_obeys_its_rules) {
  using S = TypeParam;
  std::vector<std::uint8_t> bytes = small_form<S>();
  int taken = 0, refused = 0;
  ParticleWorld<S> w;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ (1u << bit));
      SCOPED_TRACE(::testing::Message() << "byte " << i << " bit " << bit);
      ++(survives(bytes, w) ? taken : refused);
      if (this->HasFailure()) return;
      bytes[i] = static_cast<std::uint8_t>(bytes[i] ^ (1u << bit));
    }
  }
  EXPECT_GT(taken, 1000) << "positions and the like may be others";
  EXPECT_GT(refused, 1000);
}

TYPED_TEST(ParticleBytes, words_put_to_their_extremes_are_refused_or_give_a_world_that_obeys_its_rules) {
  using S = TypeParam;
  const std::vector<std::uint8_t> good = small_form<S>();
  int taken = 0, refused = 0;
  ParticleWorld<S> w;
  for (std::size_t i = 0; i + 4 <= good.size(); ++i) {
    for (const std::uint32_t word :
         {0x7fffffffu, 0x80000000u, 0xffffffffu, 0u, 0x7f800000u, 0xff800000u, 0x7fc00000u, 0x7ff00000u, 0x00000001u}) {
      std::vector<std::uint8_t> bytes = good;
      store_le(&bytes[i], word);
      SCOPED_TRACE(::testing::Message() << "at " << i << " word " << word);
      ++(survives(bytes, w) ? taken : refused);
      if (this->HasFailure()) return;
    }
  }
  EXPECT_GT(taken, 1000);
  EXPECT_GT(refused, 1000);
}

TYPED_TEST(ParticleBytes, the_form_of_another_scalar_or_of_a_rigid_world_is_refused_by_name) {
  using S = TypeParam;
  using Other = std::conditional_t<std::is_same_v<S, float>, Q16_16, float>;
  ParticleWorld<S> w;
  const auto expect_incompatible = [&](const std::vector<std::uint8_t>& bytes) {
    Reader reader(bytes);
    const Result<void> result = w.read_portable(reader);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().code, ErrorCode::incompatible);
    EXPECT_EQ(result.error().message.view(), "not written by a particle world of this scalar");
  };
  expect_incompatible(small_form<Other>());
  expect_incompatible(bytes_of(World<S>()));
  World<S> rigid;
  const std::vector<std::uint8_t> bytes = small_form<S>();
  Reader reader(bytes);
  const Result<void> result = rigid.read_portable(reader);
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().code, ErrorCode::incompatible);
}

TYPED_TEST(ParticleBytes, a_velocity_of_the_lowest_number_is_out_of_range) {
  using S = TypeParam;
  using V = Velocity<S>;
  ParticleWorld<S> w;
  w.create(particle_at<S>({1, 2, 3}));
  for (const V v : {-highest<V>(), from_bits<V>(RawBits<V>{1} << (sizeof(V) * 8 - 1))}) {
    if (to_double(v) == 0) continue;  // -0 of IEEE
    ParticleState<S> state = w.state();
    ASSERT_EQ(ParticleValidator<S>(state).broken_rule(), nullptr);
    state.velocity.y[0] = v;
    ASSERT_NE(ParticleValidator<S>(state).broken_rule(), nullptr);
    EXPECT_STREQ(ParticleValidator<S>(state).broken_rule(), "a velocity is out of range");
  }
}

}  // namespace particle_bytes_test
}  // namespace isostep::test
