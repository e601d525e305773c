// Engines in WebAssembly: Node runs a script of theirs in a process of its own and is asked over a socket. Steps are
// timed there; everything else is measured here, as for the other peers.
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "node_json.hpp"
#include "node_process.hpp"
#include "peer.hpp"

namespace isostep::bench {
namespace {

using Json = nlohmann::json;

/// One engine as it is run. What it refuses stands in its script.
struct NodeRow {
  const char* name;
  const char* package;  // of npm
  const char* script;
  const char* variant;  // that the script knows
  const char* settings;
};
constexpr char kSimd[] = "@dimforge/rapier3d-simd-compat", kDeterministic[] = "@dimforge/rapier3d-deterministic-compat",
               kHavok[] = "@babylonjs/havok", kJolt[] = "jolt-physics", kPhysx[] = "physx-js-webidl",
               kMujoco[] = "@mujoco/mujoco", kRapier[] = "rapier.mjs";
constexpr NodeRow kRows[] = {
    {"rapier-simd", kSimd, kRapier, "", "4 iterations"},
    {"rapier-simd-best", kSimd, kRapier, "best", "16 iterations"},
    {"rapier-det", kDeterministic, kRapier, "", "4 iterations"},
    {"rapier-det-best", kDeterministic, kRapier, "best", "16 iterations"},
    {"havok", kHavok, "havok.mjs", "", "defaults"},
    {"jolt", kJolt, "jolt.mjs", "", "10 velocity and 2 position steps"},
    {"jolt-best", kJolt, "jolt.mjs", "best", "20 velocity and 6 position steps, 4 collision steps"},
    {"physx-pgs", kPhysx, "physx.mjs", "pgs", "PGS, 4 position and 1 velocity iterations"},
    {"physx-pgs-best", kPhysx, "physx.mjs", "pgs-best", "PGS, 32 position and 4 velocity iterations"},
    {"physx-tgs", kPhysx, "physx.mjs", "tgs", "TGS, 4 position and 1 velocity iterations"},
    {"physx-tgs-best", kPhysx, "physx.mjs", "tgs-best", "TGS, 32 position and 4 velocity iterations"},
    {"mujoco", kMujoco, "mujoco.mjs", "", "pyramidal cones, Newton, Euler"},
    {"mujoco-best", kMujoco, "mujoco.mjs", "best", "elliptic cones, Newton, implicitfast, no slip"},
};

std::string package_directory(const NodeRow& row) {
  return std::string(ISOSTEP_BENCH_NPM_DIR "/node_modules/") + row.package;
}

class NodeEngine : public Peer {
 public:
  NodeEngine(const scenes::Scene& scene, const NodeRow& row)
      : Peer(scene), row_(row), node_(row.script, package_directory(row), row.variant) {
    const auto letters = static_cast<std::size_t>(node_.ask({{"scene", scene_json()}}, 1).front());
    if (letters == 0) return;
    std::string reason;
    for (const double letter : node_.ask({{"reason", 0}}, letters)) reason += static_cast<char>(letter);
    throw scenes::SceneError("", reason);
  }

  void step() override { timed_steps(1); }
  double timed_steps(int count) override {
    state_.clear();
    return node_.ask({{"steps", count}}, 1).front();
  }

  std::string settings() const override { return std::string(row_.package) + ", " + row_.settings; }

  void take(const scenes::DrawnQueries& drawn) override {
    if (answers_queries()) node_.ask({{"take", json_of(drawn)}}, 1);
  }
  /// Rapier alone is asked, and has no batches.
  std::optional<Answered> ask(Query query) override {
    if (!answers_queries() || query == Query::rays || query == Query::casts) return std::nullopt;
    const std::vector<double> answer = node_.ask({{"ask", kQueryNames[static_cast<std::size_t>(query)]}}, 2);
    return Answered{answer[0], static_cast<std::uint64_t>(answer[1])};
  }

 protected:
  Motion motion(std::size_t i) const override {
    const double* m = state().data() + kNumbers * i;
    return {{m[0], m[1], m[2]},
            {m[7], m[8], m[9]},
            {m[10], m[11], m[12]},
            normalise(Quat<double>{m[3], m[4], m[5], m[6]}),
            m[13] != 0};
  }
  void replace(std::size_t i, const PeerBody& by) override {
    state_.clear();
    node_.ask({{"replace", {i, json_of(by)}}}, 1);
  }
  void launch(std::size_t i, Vec3<double> velocity) override {
    state_.clear();
    node_.ask({{"launch", {i, json_of(velocity)}}}, 1);
  }
  void drive(int) override {}  // scripts move kinematic bodies by their velocity

 private:
  static constexpr std::size_t kNumbers = 14;  // a body

  bool answers_queries() const { return row_.script == kRapier; }

  Json scene_json() const {
    const auto all = [](const auto& list) {
      Json json = Json::array();
      for (const auto& item : list) json.push_back(json_of(item));
      return json;
    };
    return {{"gravity", json_of(gravity())}, {"hz", hz()},
            {"allow_sleep", allow_sleep()},  {"uniform", is_uniform(bodies())},
            {"bodies", all(bodies())},       {"joints", all(joints())},
            {"gears", all(gears())},         {"forces", all(forces())}};
  }
  /// The state is asked for once a step.
  const std::vector<double>& state() const {
    if (state_.empty()) state_ = node_.ask({{"state", 0}}, kNumbers * bodies().size());
    return state_;
  }

  const NodeRow& row_;
  mutable NodeProcess node_;
  mutable std::vector<double> state_;
};

template <std::size_t row> std::unique_ptr<Engine> make_node(const scenes::Scene& scene, const EngineOptions&) {
  return std::make_unique<NodeEngine>(scene, kRows[row]);
}
template <std::size_t... rows> std::vector<Maker> makers_of(std::index_sequence<rows...>) {
  return {{kRows[rows].name, false, make_node<rows>}...};
}

}  // namespace

std::vector<Maker> node_makers() {
  static const bool node = std::system("node --version >/dev/null 2>&1") == 0;
  if (!node) return {};
  const std::vector<Maker> all = makers_of(std::make_index_sequence<std::size(kRows)>());
  std::vector<Maker> found;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool is_there = std::filesystem::exists(package_directory(kRows[i]) + "/package.json");
    if (is_there) found.push_back(all[i]);
  }
  return found;
}

}  // namespace isostep::bench
