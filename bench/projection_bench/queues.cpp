// One step of the resolver by every queue of its worst row: measure.hpp.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <limits>
#include <stdexcept>

#include "isostep/book/linear_search.hpp"
#include "isostep/book/sorted_order.hpp"
#include "isostep/book/worst_first.inl"
#include "isostep/state/hash.hpp"
#include "isostep/store/body_map.hpp"
#include "isostep/store/proxies.hpp"
#include "isostep/store/state_loader.hpp"
#include "isostep/systems/contacts/narrow_phase.hpp"
#include "isostep/world/step_solver.hpp"
#include "projection_bench/measure.hpp"
#include "scenes/build.hpp"
#include "scenes/named.hpp"

namespace isostep::bench {

namespace {

using S = float;

/// The inputs that a step gives its solver, without a world around it; it can be had again and again.
class OneStep {
 public:
  explicit OneStep(const World<S>& world) {
    loader_.load(world.state());
    state_.settings.solver = SolverName::worst_first;
    tools_.use_simd(Simd::best);
    proxies_.update(state_.contacts, static_cast<std::size_t>(state_.settings.most_pairs));
    phase_.update(proxies_.pairs(), tools_);
    solver_.take_forces();
    bodies_ = state_.awake.states;
    contacts_ = state_.contacts;
  }
  const std::vector<Contact<S>>& contacts() const { return contacts_; }
  /// [us] The solver's time, and the hash of what it leaves.
  template <class Queue> double run(WorstFirstResolver<S, Queue>& solver, std::uint64_t& hash) {
    std::copy(bodies_.begin(), bodies_.end(), state_.awake.states.begin());
    std::copy(contacts_.begin(), contacts_.end(), state_.contacts.begin());
    const StepContext<S> context = solver_.context(phase_.geometry(), {}, {}, {}, tools_, false);
    const auto before = std::chrono::steady_clock::now();
    solver.colour_constraints(context);
    solver.solve_substeps(context);
    const auto after = std::chrono::steady_clock::now();
    solver.store_impulses(context);
    std::vector<std::uint8_t> bytes;
    Writer writer(bytes);
    for (const BodyState<S>& body : context.states) writer.write(body);
    hash = hash_bytes(bytes.data(), bytes.size());
    return std::chrono::duration<double, std::micro>(after - before).count();
  }

 private:
  WorldState<S> state_;
  BodyMap<S> map_{state_};
  Proxies<S> proxies_{state_.shapes};
  StateLoader<S> loader_{state_, map_, proxies_};
  StepTools<S> tools_ = {};
  NarrowPhase<S> phase_{state_, map_};
  StepSolver<S> solver_{state_, map_, proxies_};
  std::vector<BodyState<S>> bodies_;
  std::vector<Contact<S>> contacts_;
};

/// The frame in which bodies of a pile fall on each other.
constexpr int kFrame = 120;

}  // namespace

std::vector<QueueRow> measure_queues(int bodies, int rounds) {
  scenes::Scene scene = scenes::pile(bodies);
  scene.substeps = 4;
  World<S> world(scenes::settings_of<S>(scene));
  scenes::build(scene, world);
  for (int i = 0; i < kFrame; ++i) world.step();
  OneStep step(world);
  QueueRow row;
  row.bodies = bodies;
  row.contacts = static_cast<std::uint32_t>(step.contacts().size());
  for (const Contact<S>& contact : step.contacts()) row.points += contact.count;
  std::vector<QueueRow> rows;
  std::uint64_t first = 0;
  const auto add = [&](const char* name, auto solver) {
    row.queue = name;
    row.us = std::numeric_limits<double>::max();
    for (int i = 0; i < rounds; ++i) {
      std::uint64_t hash = 0;
      row.us = std::min(row.us, step.run(solver, hash));
      if (rows.empty() && i == 0) first = hash;
      if (hash != first) throw std::runtime_error(std::string(name) + " leaves other bits than the tree");
    }
    rows.push_back(row);
  };
  add("tree", WorstFirstResolver<S, TournamentTree>());
  add("sorted list", WorstFirstResolver<S, SortedOrder>());
  add("linear search", WorstFirstResolver<S, LinearSearch>());
  return rows;
}

}  // namespace isostep::bench
