// Breakable bodies: what breaks them, what their pieces keep (O27) and become, and that all is state and commands.
// SPDX-License-Identifier: MIT
#include "isostep/fracture/breaking.hpp"

#include "sample.hpp"
#include "unit/effects/fractured.hpp"
#include "unit/effects/totals.hpp"

namespace isostep::test {
namespace breaking_test {

template <class S> class Breakables : public ::testing::Test {
 protected:
  Breakables() : world_(settings<S>()) { add_ground(world_); }

  BodyId crate(D3 at, double mass = 20, double half = 0.5) {
    BodyDefinition<S> d = moving<S>(add_box(world_, half, half, half), at);
    d.mass = num<S>(mass);
    return world_.create(d);
  }
  BodyId ball(D3 at, D3 velocity, double mass = 10) {
    BodyDefinition<S> d = moving<S>(add_ball(world_, 0.25), at, velocity);
    d.mass = num<S>(mass);
    return world_.create(d);
  }
  BreakableId make_breakable(BodyId body, double impulse, BreakPattern pattern = BreakPattern::eight_boxes,
                             std::uint32_t depth = 1) {
    Breakable<S> b;
    b.body = body;
    b.break_impulse = num<S>(impulse);
    b.pattern = pattern;
    b.most_pieces = pattern == BreakPattern::eight_boxes ? 8 : 16;
    b.depth = depth;
    const BreakableId id = world_.add(b);
    EXPECT_TRUE(id) << describe(world_.fault());
    return id;
  }
  /// Steps until something is marked.
  bool step_until_broken(int most) {
    for (int i = 0; i < most; ++i) {
      world_.step();
      if (!world_.events().broke.empty()) return true;
    }
    return false;
  }
  std::vector<BodyId> dynamic_bodies() const {
    std::vector<BodyId> all;
    for (const BodyId id : world_.bodies()) {
      if (world_.type(id) == BodyType::dynamic) all.push_back(id);
    }
    return all;
  }
  Total totals() const {
    Total sum;
    for (const BodyId id : dynamic_bodies()) add_body(sum, world_, id, {0, 0, 0});
    return sum;
  }

  World<S> world_;
};
TYPED_TEST_SUITE(Breakables, AllScalars);

TYPED_TEST(Breakables, break_above_their_impulse_and_not_below) {
  using S = TypeParam;
  for (const double speed : {2.0, 8.0}) {
    const BodyId body = this->crate({0, 0.5, 0});
    const BreakableId id = this->make_breakable(body, 50);
    const BodyId hitter = this->ball({0, 0.5, 1.5}, {0, 0, -speed});
    const bool broken = this->step_until_broken(120);
    EXPECT_EQ(broken, speed > 5);
    EXPECT_EQ(this->world_.input(id)->impulse > S(0), broken);
    if (broken) {
      const Broke<S> told = this->world_.events().broke[0];
      EXPECT_EQ(told.body, body);
      // An inelastic blow at most: the reduced mass times the speed, and what sub-steps add.
      EXPECT_GT(to_double(told.impulse), 50);
      EXPECT_NEAR(to_double(told.point.z), 0.5, 0.1);
      EXPECT_LT(to_double(told.direction.z), -0.9);
      EXPECT_EQ(this->world_.input(id)->impulse, told.impulse);
    }
    const BreakReport report = break_bodies(this->world_);
    EXPECT_EQ(report.broken, broken ? 1u : 0u);
    EXPECT_EQ(this->world_.contains(body), !broken);
    for (const BodyId all : this->dynamic_bodies()) this->world_.destroy(all);
    (void)hitter;
  }
}

TYPED_TEST(Breakables, keep_mass_centre_and_momenta_in_every_pattern) {  // O27
  using S = TypeParam;
  const double bound = pick<S>(1e-5, 1e-12, 1e-3, 1e-8);
  for (const BreakPattern pattern :
       {BreakPattern::eight_boxes, BreakPattern::grain, BreakPattern::radial, BreakPattern::voronoi}) {
    const BodyId body = this->crate({0, 1, 0});
    this->make_breakable(body, 20, pattern);
    this->ball({0.125, 1.125, 2}, {0, 1, -10});
    ASSERT_TRUE(this->step_until_broken(60));
    const Total before = this->totals();
    const BreakReport report = break_bodies(this->world_);
    ASSERT_EQ(report.broken, 1u);
    EXPECT_GT(report.pieces, 4u);
    const Total after = this->totals();
    EXPECT_EQ(this->dynamic_bodies().size(), 1u + report.pieces);
    EXPECT_NEAR(after.mass / before.mass, 1, bound);
    EXPECT_LT(length(after.centre() - before.centre()), 4 * bound);
    EXPECT_LT(relative(after.momentum, before.momentum), 4 * bound);
    EXPECT_LT(relative(after.angular, before.angular), 4 * bound);
    for (const BodyId all : this->dynamic_bodies()) this->world_.destroy(all);
  }
}

TYPED_TEST(Breakables, break_as_deep_as_they_may) {
  const BodyId body = this->crate({0, 8, 0}, 64);
  this->make_breakable(body, 8, BreakPattern::eight_boxes, 2);
  int broken = 0;
  for (int i = 0; i < 400; ++i) {
    this->world_.step();
    broken += static_cast<int>(break_bodies(this->world_).broken);
  }
  EXPECT_GT(broken, 4) << "the fall breaks the crate and most of its pieces";
  EXPECT_LE(broken, 9);
  EXPECT_TRUE(this->world_.state().records->breakables.slot_map().template ids<BreakableId>().size() <= 8u);
}

TYPED_TEST(Breakables, small_pieces_expire_with_their_shapes) {
  using S = TypeParam;
  const std::uint32_t shapes = this->world_.counts().shapes;
  const BodyId body = this->crate({0, 0.5, 0});
  const BreakableId id = this->make_breakable(body, 10);
  Breakable<S> record = *this->world_.find(id);
  record.small_mass = S(100), record.lifetime = 30;
  ASSERT_TRUE(this->world_.set(id, record));
  ASSERT_TRUE(this->world_.set_input(id, {.impulse = S(1)}));  // broken without a blow
  EXPECT_EQ(break_bodies(this->world_).pieces, 8u);
  EXPECT_GT(this->world_.counts().shapes, shapes + 1);
  std::uint32_t expired = 0;
  for (int i = 0; i < 40; ++i) {
    this->world_.step();
    expired += break_bodies(this->world_).expired;
    EXPECT_EQ(expired, i < 29 ? 0u : 8u) << i;
  }
  EXPECT_TRUE(this->dynamic_bodies().empty());
  EXPECT_EQ(this->world_.counts().shapes, shapes + 1) << "the crate's own stays";
}

TYPED_TEST(Breakables, so_many_break_at_once_and_the_rest_after_them) {
  using S = TypeParam;
  for (int n = 0; n < 6; ++n) {
    const BreakableId id = this->make_breakable(this->crate({2.0 * n, 0.5, 0}), 10);
    ASSERT_TRUE(this->world_.set_input(id, {.impulse = S(1)}));
  }
  for (const std::uint32_t expected : {4u, 2u, 0u}) EXPECT_EQ(break_bodies(this->world_, 4).broken, expected);
}

TYPED_TEST(Breakables, what_cannot_break_stays_whole) {
  using S = TypeParam;
  const BodyId body = this->ball({0, 4, 0}, {0, -4, 0});
  const BreakableId id = this->make_breakable(body, 1);
  ASSERT_TRUE(this->step_until_broken(120));
  EXPECT_EQ(break_bodies(this->world_).whole, 1u);
  EXPECT_TRUE(this->world_.contains(body));
  EXPECT_EQ(this->world_.input(id)->impulse, S(0));
}

TYPED_TEST(Breakables, marks_and_pieces_are_state) {
  using S = TypeParam;
  for (int n = 0; n < 12; ++n)
    this->make_breakable(this->crate({n % 4 - 1.5, 0.5 + n / 4, 0}, 10), 15, static_cast<BreakPattern>(n % 4), 2);
  this->ball({0, 1, 4}, {0, 0, -14}, 20);
  ASSERT_TRUE(this->step_until_broken(60));
  typename World<S>::Snapshot marked;
  this->world_.save(marked);  // between the step and break_bodies
  World<S> other(settings<S>());
  const std::vector<std::uint8_t> portable = bytes_of(this->world_);
  std::vector<std::uint64_t> hashes;
  std::uint32_t broken = 0;
  for (int i = 0, frames = sampled(90, 30); i < frames; ++i) {
    broken += break_bodies(this->world_).broken;
    this->world_.step();
    hashes.push_back(this->world_.hash());
  }
  EXPECT_GT(broken, 3u);
  ASSERT_TRUE(this->world_.load(marked));
  Reader reader(portable);
  ASSERT_TRUE(other.read_portable(reader).ok());
  for (std::size_t i = 0; i < hashes.size(); ++i) {
    break_bodies(this->world_), break_bodies(other);
    this->world_.step(), other.step();
    ASSERT_EQ(this->world_.hash(), hashes[i]) << i;
    ASSERT_EQ(other.hash(), hashes[i]) << i;
  }
}

TYPED_TEST(Breakables, bad_numbers_are_named) {
  using S = TypeParam;
  const BodyId body = this->crate({0, 0.5, 0});
  const auto refused = [&](const char* field, const auto& change, Fault fault = Fault::bad_argument) {
    Breakable<S> b;
    b.body = body;
    change(b);
    EXPECT_FALSE(this->world_.add(b));
    EXPECT_STREQ(this->world_.fault().field, field);
    EXPECT_EQ(this->world_.fault().fault, fault) << field;
  };
  refused(
      "body", [](Breakable<S>& b) { b.body = {}; }, Fault::null_id);
  refused("break_impulse", [](Breakable<S>& b) { b.break_impulse = S(-1); });
  refused("pattern", [](Breakable<S>& b) { b.pattern = static_cast<BreakPattern>(4); });
  refused("most_pieces", [](Breakable<S>& b) { b.most_pieces = 7; });
  refused("most_pieces", [](Breakable<S>& b) { b.most_pieces = 257; });
  refused("depth", [](Breakable<S>& b) { b.depth = 17; });
  refused("grain", [](Breakable<S>& b) { b.grain = Vec3<Unit<S>>::zero(); });
  refused("small_mass", [](Breakable<S>& b) { b.small_mass = S(-1); });
  EXPECT_EQ(this->world_.state().records->kinds(), 0u);
  const BreakableId id = this->make_breakable(body, 1);
  refused("body", [](Breakable<S>&) {});  // has a record
  const auto refused_input = [&](const char* field, const Blow<S>& blow, Fault fault = Fault::bad_argument) {
    EXPECT_FALSE(this->world_.set_input(id, blow)) << field;
    EXPECT_STREQ(this->world_.fault().field, field);
    EXPECT_EQ(this->world_.fault().fault, fault) << field;
    EXPECT_EQ(this->world_.input(id)->impulse, S(0));
  };
  refused_input("impulse", {.impulse = S(-1)});
  refused_input("point", {.impulse = S(1), .point = {highest<S>(), S(0), S(0)}}, Fault::out_of_range);
  refused_input("direction", {.impulse = S(1), .direction = {Unit<S>(0.5), Unit<S>(0), Unit<S>(0)}});
}

TYPED_TEST(Breakables, what_is_disabled_breaks_once_it_is_not) {
  using S = TypeParam;
  World<S>& w = this->world_;
  BodyDefinition<S> d = moving<S>(add_box(w, 0.5, 0.5, 0.5), {0, 2, 0});
  d.mass = S(10);
  const BodyId crate = w.create(d);
  const BreakableId id = this->make_breakable(crate, 1);
  ASSERT_TRUE(w.set_input(id, {.impulse = S(2), .direction = {Unit<S>(0), Unit<S>(-1), Unit<S>(0)}}))
      << describe(w.fault());
  ASSERT_TRUE(w.set_enabled(crate, false));
  break_bodies(w, 8);
  EXPECT_EQ(this->dynamic_bodies().size(), 1u);
  ASSERT_TRUE(w.set_enabled(crate, true));
  break_bodies(w, 8);
  EXPECT_EQ(this->dynamic_bodies().size(), 8u);
}

}  // namespace breaking_test
}  // namespace isostep::test
