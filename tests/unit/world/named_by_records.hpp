// NamedByRecords: the bodies and joints of a test that gives a world one record of each kind.
// SPDX-License-Identifier: MIT
#pragma once

#include <type_traits>

#include "isostep/world/world.hpp"

namespace isostep::test {

template <class S> struct NamedByRecords {
  BodyId a, b, carried, sensor;  // carried and sensor are kinematic
  JointId hinge_a, hinge_b, six;

  /// Ties a, b and the world, once the bodies are there.
  void create_joints(World<S>& world) {
    hinge_a = world.create(hinge<S>({.a = a}));
    hinge_b = world.create(hinge<S>({.a = b}));
    SixAxisDefinition<S> free;
    free.a = a;
    free.b = b;
    six = world.create(six_axis<S>(free));
  }
  /// A record with its defaults that names what its kind may name.
  template <class Record> Record naming() const {
    Record record;
    const bool walks = std::is_same_v<Record, CharacterSettings<S>>;
    if constexpr (requires { record.body; }) record.body = walks ? carried : a;
    if constexpr (requires { record.a; }) record.a = a;
    if constexpr (requires { record.b; }) record.b = b;
    if constexpr (requires { record.sensor; }) record.sensor = sensor;
    if constexpr (requires { record.on; }) record.on = a;
    if constexpr (requires { record.joint; }) record.joint = six;
    if constexpr (requires { record.joint_a; }) record.joint_a = hinge_a;
    if constexpr (requires { record.joint_b; }) record.joint_b = hinge_b;
    if constexpr (requires { record.kind_a; }) record.kind_a = 1;
    if constexpr (requires { record.kind_b; }) record.kind_b = 2;
    return record;
  }
};

}  // namespace isostep::test
