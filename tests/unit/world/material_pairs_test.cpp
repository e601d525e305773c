// Pairs of materials as records of a world: commands, faults, saving, loading, and what is refused in files.
// SPDX-License-Identifier: MIT
#include "isostep/store/state_validator.hpp"
#include "unit/world/commanded_world.hpp"

namespace isostep::test {
namespace material_pairs_test {

template <class S> class MaterialPairs : public CommandedWorld<S> {
 protected:
  static MaterialPair<S> pair(std::uint32_t a, std::uint32_t b) {
    MaterialPair<S> p;
    p.kind_a = a;
    p.kind_b = b;
    return p;
  }
  template <class Change>
  void expect_bad(Fault fault, const char* field, Change&& change, int line = __builtin_LINE()) {
    SCOPED_TRACE(line);
    MaterialPair<S> p = pair(1, 2);
    change(p);
    this->expect_refused(fault, [&] { return this->world.add(p); });
    EXPECT_STREQ(this->world.fault().field, field);
    EXPECT_STREQ(this->world.fault().command, "add_material_pair");
  }
};
TYPED_TEST_SUITE(MaterialPairs, AllScalars);

TYPED_TEST(MaterialPairs, bad_fields_are_refused_by_name) {
  using S = TypeParam;
  this->expect_bad(Fault::bad_argument, "kind_a", [](auto& p) { p.kind_a = 0; });
  this->expect_bad(Fault::bad_argument, "kind_b", [](auto& p) { p.kind_b = 0; });
  this->expect_bad(Fault::bad_argument, "friction", [](auto& p) { p.friction = S(-1); });
  this->expect_bad(Fault::out_of_range, "friction", [](auto& p) { p.friction = S(17); });
  this->expect_bad(Fault::bad_argument, "static_friction", [](auto& p) { p.static_friction = S(-1); });
  this->expect_bad(Fault::out_of_range, "static_friction", [](auto& p) { p.static_friction = S(17); });
  this->expect_bad(Fault::bad_argument, "restitution", [](auto& p) { p.restitution = num<S>(1.5); });
  this->expect_bad(Fault::bad_argument, "restitution", [](auto& p) { p.restitution = S(-1); });
  this->expect_bad(Fault::bad_argument, "rolling_resistance", [](auto& p) { p.rolling_resistance = S(-1); });
  this->expect_bad(Fault::out_of_range, "rolling_resistance",
                   [](auto& p) { p.rolling_resistance = Limits<S>::extent() + S(1); });
  if constexpr (!kIsFixed<S>) {
    this->expect_bad(Fault::not_finite, "friction", [](auto& p) { p.friction = not_a_number<S>(); });
    this->expect_bad(Fault::not_finite, "static_friction", [](auto& p) { p.static_friction = not_a_number<S>(); });
    this->expect_bad(Fault::not_finite, "restitution", [](auto& p) { p.restitution = endless<S>(); });
    this->expect_bad(Fault::not_finite, "rolling_resistance", [](auto& p) { p.rolling_resistance = endless<S>(); });
  }
}

TYPED_TEST(MaterialPairs, two_kinds_have_one_record_whatever_their_order) {
  using S = TypeParam;
  World<S>& w = this->world;
  const MaterialPairId first = w.add(this->pair(1, 2)), second = w.add(this->pair(2, 2));
  ASSERT_TRUE(first && second);
  this->expect_refused(Fault::bad_argument, [&] { return w.add(this->pair(1, 2)); });
  EXPECT_STREQ(w.fault().field, "kind_b");
  this->expect_refused(Fault::bad_argument, [&] { return w.add(this->pair(2, 1)); });
  this->expect_refused(Fault::bad_argument, [&] { return w.set(second, this->pair(2, 1)); });
  EXPECT_TRUE(w.set(first, this->pair(2, 1))) << "its own";
  EXPECT_TRUE(w.set(second, this->pair(3, 2)));
  EXPECT_TRUE(w.remove(first));
  this->expect_refused(Fault::stale_id, [&] { return w.set(first, this->pair(5, 6)); });
  this->expect_refused(Fault::stale_id, [&] { return w.remove(first); });
  EXPECT_TRUE(w.add(this->pair(1, 2)));
}

TYPED_TEST(MaterialPairs, a_record_wakes_what_it_may_change) {
  using S = TypeParam;
  World<S>& w = this->world;
  const auto asleep = [&] {
    for (int i = 0; i < 200 && w.is_awake(this->sleeper); ++i) w.step();
    return !w.is_awake(this->sleeper);
  };
  ASSERT_TRUE(asleep());
  const MaterialPairId id = w.add(this->pair(1, 2));
  EXPECT_TRUE(w.is_awake(this->sleeper));
  ASSERT_TRUE(asleep());
  w.remove(id);
  EXPECT_TRUE(w.is_awake(this->sleeper));
}

TYPED_TEST(MaterialPairs, a_world_that_is_saved_or_written_goes_on_with_them) {
  using S = TypeParam;
  World<S>& w = this->world;
  Material<S> m;
  m.kind = 1;
  m.anisotropy = vec<S>(0.25, 1, 1);
  m.static_friction = S(1);
  ASSERT_TRUE(w.set_material(this->flier, m) && w.set_material(this->ground, m));
  const std::uint64_t without = w.hash();
  const MaterialPairId removed = w.add(this->pair(1, 3)), kept = w.add(this->pair(1, 1));
  ASSERT_TRUE(w.remove(removed));
  EXPECT_NE(w.hash(), without);
  typename World<S>::Snapshot saved;
  w.save(saved);
  World<S> late(w.settings());
  const std::vector<std::uint8_t> bytes = bytes_of(w);
  Reader whole(bytes);
  ASSERT_TRUE(late.read_portable(whole));
  EXPECT_EQ(late.hash(), w.hash());
  EXPECT_EQ(bytes_of(late), bytes);
  std::vector<std::uint64_t> hashes;
  for (int i = 0; i < 60; ++i) {
    w.step();
    late.step();
    EXPECT_EQ(late.hash(), w.hash()) << i;
    hashes.push_back(w.hash());
  }
  ASSERT_TRUE(w.remove(kept));
  w.load(saved);
  EXPECT_NE(w.find(kept), nullptr);
  for (const std::uint64_t hash : hashes) {
    w.step();
    EXPECT_EQ(w.hash(), hash);
  }
}

TYPED_TEST(MaterialPairs, a_state_with_two_records_of_the_same_kinds_or_a_bad_one_is_not_valid) {
  using S = TypeParam;
  World<S>& w = this->world;
  w.add(this->pair(1, 2));
  const MaterialPairId removed = w.add(this->pair(1, 3));
  w.add(this->pair(1, 4));
  w.remove(removed);
  const auto rule_of = [&](auto&& change) -> std::string {
    WorldState<S> state = w.state();
    change(state.records.change().material_pairs.change_all(), state.settings);
    const char* rule = broken_rule(state);
    return rule == nullptr ? "" : rule;
  };
  EXPECT_EQ(rule_of([](auto&, auto&) {}), "");
  EXPECT_EQ(rule_of([](auto& all, auto&) { std::swap(all[2].kind_a, all[2].kind_b), all[2].kind_a = 2; }),
            "two records of a kind are about the same");
  EXPECT_EQ(rule_of([](auto& all, auto&) { all[1].kind_a = 1; }), "a free record holds something");
  EXPECT_EQ(rule_of([](auto& all, auto&) { all[0].friction = S(-1); }), "a record is out of range");
  EXPECT_EQ(rule_of([](auto&, auto& s) { s.restitution_threshold = S(-1); }), "settings out of range");
}

TYPED_TEST(MaterialPairs, the_restitution_threshold_is_a_speed) {
  using S = TypeParam;
  const auto made_with = [](S threshold) {
    Settings<S> s = settings<S>();
    s.restitution_threshold = threshold;
    return World<S>(s);
  };
  EXPECT_EQ(made_with(S(0)).fault().fault, Fault::none);
  EXPECT_EQ(made_with(Limits<S>::speed()).fault().fault, Fault::none);
  for (const S bad : {S(-1), Limits<S>::speed() + S(1)}) {
    const World<S> w = made_with(bad);
    EXPECT_EQ(w.fault().fault, Fault::out_of_range);
    EXPECT_STREQ(w.fault().field, "restitution_threshold");
    EXPECT_EQ(w.settings().restitution_threshold, bad < S(0) ? S(0) : Limits<S>::speed());
  }
  if constexpr (!kIsFixed<S>) {
    EXPECT_EQ(made_with(not_a_number<S>()).settings().restitution_threshold, S(0.25));
    EXPECT_EQ(made_with(not_a_number<S>()).fault().fault, Fault::out_of_range);
  }
}

}  // namespace material_pairs_test
}  // namespace isostep::test
