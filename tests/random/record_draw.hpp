// RecordDraw: what a random record of a world says, by its kind's own rules or by its fields alone.
// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <type_traits>
#include <vector>

#include "random/dice.hpp"
#include "unit/world/worlds.hpp"

namespace isostep::test {

/// Gives the values for which RecordRules::draw asks. All are functions of the world's state and the dice; what the
/// world has none of is null, which it refuses. A double is in the unit of what it becomes, `unit` of those.
template <class S> class RecordDraw {
 public:
  RecordDraw(const World<S>& world, Dice& dice) : world_(world), dice_(dice) {}

  /// Draws by the rules of the kind, else by the fields.
  template <class Record> void draw(Record& record) {
    using Rules = detail::RecordRules<Record>;
    if constexpr (requires(RecordDraw & self) { Rules::draw(record, self); }) Rules::draw(record, *this);
    else draw_fields(record);
  }
  /// Draws each field by its type and its default: a body or joint that it may name, a number about the default or from
  /// 0 to 1 where that is 0.
  template <class Record> void draw_fields(Record& record) {
    Record::fields([&](const char* name, auto& member) { draw_field<Record>(name, member); }, record);
  }

  // ---- what a record names
  BodyId body() { return body_of(BodyType::dynamic); }
  BodyId kinematic_body() { return body_of(BodyType::kinematic); }
  BodyId mover() {
    return body_where([&](BodyId id) { return moves(id); });
  }
  BodyId any_body() {
    return body_where([](BodyId) { return true; });
  }
  JointId joint() {
    const std::vector<JointId> all = world_.joints();
    return all.empty() ? JointId{} : dice_.one_of(all);
  }
  bool moves(BodyId id) const { return id && world_.type(id) != BodyType::static_; }
  double mass(BodyId id) const { return id ? to_double(world_.mass(id)) : 0; }  // [kg]
  std::uint32_t parts(BodyId id) const {
    const auto& shapes = world_.state().shapes;
    return id ? static_cast<std::uint32_t>(shapes[world_.view(id).properties->shape]->children.size()) : 1;
  }
  std::uint32_t kind() { return 1 + dice_.below(kMaterialKinds); }  // Material::kind
  std::uint64_t tick() const { return world_.tick(); }

  // ---- numbers
  std::uint32_t below(std::uint32_t n) { return dice_.below(n); }
  bool one_in(std::uint32_t n) { return dice_.one_in(n); }
  std::int32_t rank() { return static_cast<std::int32_t>(dice_.below(5)) - 2; }  // a priority
  S in(double low, double high, double unit = 1) { return num<S>(dice_.in(low, high) * unit); }
  Vec3<S> point(double reach, double height = 0) { return vec<S>(dice_.point(reach) + D3{0, height, 0}); }
  Vec3<S> arrow(double low, double high, double unit = 1) { return vec<S>(dice_.arrow_of(dice_.in(low, high) * unit)); }
  /// In the world, so far from the middle of a body.
  Vec3<S> beside(BodyId id, double low, double high) {
    const D3 middle = id ? real(world_.center_of_mass(id)) : D3{0, 0, 0};
    return vec<S>(middle + dice_.arrow(low, high));
  }
  Vec3<Unit<S>> direction() { return normalise(vec<Unit<S>>(dice_.direction())); }
  Quat<Unit<S>> turn() { return dice_.template orientation<S>(); }
  /// Where a zone is, near the middle of the world.
  template <class Zone> void region(Zone& zone) {
    zone.shape = static_cast<ZoneShape>(dice_.below(3));
    zone.pose.position = point(3);
    zone.pose.orientation = turn();
    const S x = in(0.5, 2), y = in(0.5, 2);
    zone.half = {x, y, in(0.5, 2)};
  }

 private:
  template <class Match> BodyId body_where(const Match& match) {
    const std::vector<BodyId> all = world_.bodies();
    for (int tries = 0; tries < 8 && !all.empty(); ++tries) {
      const BodyId id = dice_.one_of(all);
      if (match(id)) return id;
    }
    return {};
  }
  BodyId body_of(BodyType type) {
    return body_where([&](BodyId id) { return world_.type(id) == type; });
  }

  template <class Record, class T> void draw_field(const char* name, T& member) {
    if constexpr (std::is_same_v<T, BodyId>) {
      member = body_for<Record>(name);
    } else if constexpr (std::is_same_v<T, JointId>) {
      member = joint();
    } else if constexpr (std::is_bounded_array_v<T>) {
      for (auto& element : member) draw_value(element);
    } else {
      draw_value(member);
    }
  }
  /// As the rules want it. Where it may be null it is at times.
  template <class Record> BodyId body_for(const char* name) {
    const auto named = detail::bodies_of(Record{});
    for (int i = 0; i < named.count; ++i) {
      if (std::string_view(named.all[i].field) != name) continue;
      if (named.all[i].may_be_null && dice_.one_in(3)) return {};
      const detail::MustBe must_be = named.all[i].must_be;
      return must_be == detail::MustBe::any       ? any_body()
             : must_be == detail::MustBe::dynamic ? body()
                                                  : kinematic_body();
    }
    return {};
  }

  void draw_value(bool& member) { member = dice_.one_in(2); }
  template <class T> void draw_value(T& member) {
    if constexpr (std::is_enum_v<T>)
      member = static_cast<T>(dice_.below(static_cast<std::uint32_t>(words_of(T{}).size())));
    else if constexpr (std::is_signed_v<T> && std::is_integral_v<T>) member += rank();
    else if constexpr (std::is_integral_v<T>) member += dice_.below(4);
    else member = member == T(0) ? num<T>(dice_.in(0, 1)) : num<T>(to_double(member) * dice_.in(0.5, 2));
  }
  /// One of length 1 is a direction.
  template <class T> void draw_value(Vec3<T>& member) {
    const D3 now = real(member);
    if (length(now) != 1) member = vec<T>(now + dice_.point(1));
    else if constexpr (std::is_same_v<T, Unit<S>>) member = normalise(vec<T>(dice_.direction()));
    else member = vec<T>(dice_.direction());
  }
  void draw_value(Quat<Unit<S>>& member) { member = turn(); }
  void draw_value(Pose<S>& member) { member = {point(3), turn()}; }
  void draw_value(Mat3<S>& member) {
    const S x = in(-2, 0), y = in(-2, 0);
    member = Mat3<S>::diagonal({x, y, in(-2, 0)});
  }

  const World<S>& world_;
  Dice& dice_;
};

}  // namespace isostep::test
