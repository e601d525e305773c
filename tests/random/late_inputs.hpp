// Two worlds that roll back and play again with late inputs: one steps all of it, the other what differs.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <memory>
#include <string>

#include "isostep/state/pack.hpp"
#include "random/records.hpp"
#include "random/world.hpp"

namespace isostep::test {

/// The canonical bytes of all events of a step, list after list.
template <class S> std::vector<std::uint8_t> bytes_of_events(const Events<S>& events) {
  std::vector<std::uint8_t> bytes;
  const auto add = [&](const auto& list) {
    using Event = typename std::remove_cvref_t<decltype(list)>::value_type;
    for (const Event& event : list) {
      const std::size_t from = bytes.size();
      bytes.resize(from + kPackedSize<Event>);
      pack(bytes.data() + from, event);
    }
    bytes.push_back(0xee);
  };
  add(events.contact_begin);
  add(events.contact_end);
  add(events.sensor_begin);
  add(events.sensor_end);
  add(events.broke);
  add(events.joint_broke);
  add(events.hits);
  add(events.contacts);
  add(events.fell_asleep);
  add(events.woke);
  return bytes;
}

/// Adds, changes or removes a record of a kind that names its bodies.
template <class S> void change_local_record(World<S>& w, Dice& dice) {
  RandomRecords<S> random(w, dice);
  const RecordStore<S>& records = *w.state().records;
  switch (dice.below(7)) {
    case 0: random.change(records.drags); break;
    case 1: random.change(records.thrusters); break;
    case 2: random.change(records.body_springs); break;
    case 3: random.change(records.hit_reports); break;
    case 4: random.change(records.surface_velocitys); break;
    case 5: random.change(records.one_ways); break;
    default: random.change(records.aero_surfaces);
  }
}

/// Clusters of one to four bodies, 4 m apart, some with a sensor or a kinematic body beside them.
template <class S> void add_field(World<S>& w, std::uint64_t seed, int side, double middle) {
  Dice dice(seed * 977 + 3);
  w.create(still<S>(add_box(w, 4.0 * side, 1, 4.0 * side), {middle, -1, 0}));
  const ShapeId shapes[] = {add_box(w, 0.5, 0.5, 0.5), add_ball(w, 0.5),
                            w.add_shape(Capsule<S>{num<S>(0.3), num<S>(0.4)}), add_box(w, 0.3, 0.6, 0.4)};
  for (int cell = 0; cell < side * side; ++cell) {
    const D3 at = {middle + 4.0 * (cell % side - side / 2), 0, 4.0 * (cell / side - side / 2)};
    const int count = 1 + static_cast<int>(dice.below(4));
    BodyId below;
    for (int i = 0; i < count; ++i) {
      const double x = dice.in(-0.3, 0.3), z = dice.in(-0.3, 0.3);
      BodyDefinition<S> body = moving<S>(shapes[dice.below(4)], at + D3{x, 0.6 + 1.05 * i, z});
      body.report_contacts = dice.one_in(2);
      const BodyId made = w.create(body);
      const Pose<S> between = {body.position - vec<S>(0, 0.5, 0), Quat<Unit<S>>::identity()};
      if (below && dice.one_in(4)) w.create(ball<S>({.a = below, .b = made, .frame = between}));
      below = made;
    }
    if (dice.one_in(6)) {
      BodyDefinition<S> sensor = still<S>(shapes[0], at + D3{1.2, 0.6, 0});
      sensor.sensor = true;
      w.create(sensor);
    }
    if (dice.one_in(9)) {
      BodyDefinition<S> wall = still<S>(shapes[3], at + D3{-1.3, 0.5, 0});
      wall.type = BodyType::kinematic;
      w.create(wall);
    }
  }
}

enum class LateWorld { field, everything, both };

/// Plays a world of a seed twice and compares the two after every step.
template <class S> class LateInputs {
 public:
  LateInputs(LateWorld kind, std::uint64_t seed, SolverName solver, int side)
      : kind_(kind),
        seed_(seed),
        side_(side),
        plain_(make(solver)),
        remembering_(make(solver)),
        dice_(seed * 31337 + 11) {
    remembering_.remember_steps(16);
    if (seed % 2 == 1) remembering_.use_simd(Simd::scalar);
  }

  /// Plays `frames`, with a rollback after one in five. Returns what differed first, or nothing.
  std::string play(int frames) {
    snapshots_.resize(static_cast<std::size_t>(frames));
    late_.resize(static_cast<std::size_t>(frames));
    for (int frame = 0; frame < frames; ++frame) {
      if (const std::string lost = step(frame); !lost.empty()) return lost;
      if (frame < 5 || !dice_.one_in(5)) continue;
      const int back = 1 + static_cast<int>(dice_.below(static_cast<std::uint32_t>(std::min(frame, 10))));
      if (const std::string lost = roll_back(frame + 1 - back, frame); !lost.empty()) return lost;
    }
    return "";
  }
  std::uint64_t steps() const { return steps_; }
  Resimulation totals() const { return remembering_.resimulation(); }

 private:
  /// An input that came late. 0: none.
  struct Late {
    std::uint64_t seed = 0;
    std::uint32_t what = 0;
  };

  World<S> make(SolverName solver) const {
    if (kind_ != LateWorld::field) {
      RandomWorld<S> random(seed_, solver);
      if (kind_ == LateWorld::both) add_field(random.world, seed_, side_, 50);
      return std::move(random.world);
    }
    Settings<S> s = settings<S>();
    s.solver = solver;
    s.allow_sleep = seed_ % 3 != 0;
    World<S> w(s);
    add_field(w, seed_, side_, 0);
    return w;
  }

  std::string roll_back(int from, int to) {
    if (!dice_.one_in(8)) {  // else all inputs are as they were
      const auto most = static_cast<std::uint32_t>(to - from + 1);
      const int at = from + (dice_.one_in(3) ? static_cast<int>(dice_.below(most)) : 0);
      late_[static_cast<std::size_t>(at)] = {dice_.below(1000000) + 1ull, dice_.below(10)};
    }
    for (World<S>* w : {&plain_, &remembering_}) w->load(snapshots_[static_cast<std::size_t>(from)]);
    for (int frame = from; frame <= to; ++frame) {
      if (const std::string lost = step(frame); !lost.empty()) return lost;
    }
    return "";
  }

  std::string step(int frame) {
    plain_.save(snapshots_[static_cast<std::size_t>(frame)]);
    for (World<S>* w : {&plain_, &remembering_}) command(*w, frame);
    const StepReport all = plain_.step(), part = remembering_.step();
    ++steps_;
    std::string lost;
    if (plain_.hash() != remembering_.hash()) lost += " state";
    if (bytes_of_events(plain_.events()) != bytes_of_events(remembering_.events())) lost += " events";
    if (bytes_of(all) != bytes_of(part)) lost += " report";
    return lost.empty() ? "" : "seed " + std::to_string(seed_) + " frame " + std::to_string(frame) + ":" + lost;
  }
  static std::vector<std::uint8_t> bytes_of(const StepReport& report) {
    std::vector<std::uint8_t> bytes(kPackedSize<StepReport>);
    pack(bytes.data(), report);
    return bytes;
  }

  void command(World<S>& w, int frame) const {
    if (kind_ == LateWorld::field) {
      Dice dice(seed_ * 7 + static_cast<std::uint64_t>(frame) * 1000003);
      const std::vector<BodyId> bodies = w.bodies();
      if (dice.one_in(3)) w.apply_impulse(dice.one_of(bodies), vec<S>(dice.arrow(0, 3)));
      if (seed_ % 2 == 1 && dice.one_in(4)) change_local_record(w, dice);
    } else {
      RandomWorld<S>::command(w, seed_, static_cast<std::uint64_t>(frame));
    }
    const Late& late = late_[static_cast<std::size_t>(frame)];
    if (late.seed != 0) come_late(w, late);
  }
  static void come_late(World<S>& w, const Late& late) {
    Dice dice(late.seed);
    const std::vector<BodyId> bodies = w.bodies();
    const BodyId body = dice.one_of(bodies);
    const Vec3<S> way = vec<S>(dice.arrow(0, 2));
    Pose<S> pose = w.pose(body);
    pose.position += way;
    switch (late.what) {
      case 0: w.apply_impulse(body, way); break;
      case 1: w.set_velocity(body, way, vec<S>(0, 0, 0)); break;
      case 2: w.apply_force(body, way * S(16), vec<S>(0, 0, 0)); break;
      case 3: w.wake(body); break;
      case 4:
        if (w.type(body) == BodyType::dynamic && bodies.size() > 12) w.destroy(body);
        break;
      case 5: w.set_pose(body, pose); break;
      case 6: w.sleep(body); break;
      case 7: change_local_record(w, dice); break;
      case 8: {
        const std::vector<JointId> joints = w.joints();
        if (!joints.empty()) w.destroy(dice.one_of(joints));
        break;
      }
      default: w.move_to(body, pose);  // of a kinematic one; others refuse
    }
  }

  LateWorld kind_;
  std::uint64_t seed_;
  int side_;
  World<S> plain_, remembering_;
  Dice dice_;
  std::vector<typename World<S>::Snapshot> snapshots_;
  std::vector<Late> late_;  // by frame
  std::uint64_t steps_ = 0;
};

}  // namespace isostep::test
