// Rapier (float, WebAssembly) in the scene benchmark: Node runs rapier.mjs in a process of its own and is asked over a
// socket. Steps are timed there; everything else is measured here, as for the other peers.
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <filesystem>

#include "node_process.hpp"
#include "peer.hpp"
#include "rapier_json.hpp"

namespace isostep::bench {
namespace {

using Json = nlohmann::json;

std::string package_directory(const char* package) {
  return std::string(ISOSTEP_BENCH_NPM_DIR "/node_modules/@dimforge/") + package;
}

class RapierEngine : public Peer {
 public:
  RapierEngine(const scenes::Scene& scene, const char* package)
      : Peer(scene), package_(package), node_(package_directory(package)) {
    Json built = {{"gravity", json_of(gravity())},
                  {"allow_sleep", allow_sleep()},
                  {"uniform", is_uniform(bodies())},
                  {"bodies", Json::array()},
                  {"joints", Json::array()}};
    for (const PeerBody& body : bodies()) built["bodies"].push_back(json_of(body));
    if (!gears().empty()) throw scenes::SceneError("", "Rapier has no gears");
    for (const PeerJoint& joint : joints()) built["joints"].push_back(json_of(joint));
    node_.ask({{"scene", built}}, 1);
  }

  void step() override { timed_steps(1); }
  double timed_steps(int count) override {
    state_.clear();
    return node_.ask({{"steps", count}}, 1).front();
  }

  std::string settings() const override { return std::string(package_) + ", 4 iterations"; }

  void take(const scenes::DrawnQueries& drawn) override { node_.ask({{"take", json_of(drawn)}}, 1); }
  /// Rapier has no batches.
  std::optional<Answered> ask(Query query) override {
    if (query == Query::rays || query == Query::casts) return std::nullopt;
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
  void drive(int) override {}  // Rapier moves kinematic bodies by their velocity

 private:
  static constexpr std::size_t kNumbers = 14;  // a body

  /// The state is asked for once a step.
  const std::vector<double>& state() const {
    if (state_.empty()) state_ = node_.ask({{"state", 0}}, kNumbers * bodies().size());
    return state_;
  }

  const char* package_;
  mutable NodeProcess node_;
  mutable std::vector<double> state_;
};

constexpr char kSimd[] = "rapier3d-simd-compat", kDeterministic[] = "rapier3d-deterministic-compat";

template <const char* package> std::unique_ptr<Engine> make_rapier(const scenes::Scene& scene, const EngineOptions&) {
  return std::make_unique<RapierEngine>(scene, package);
}

}  // namespace

std::vector<Maker> rapier_makers() {
  std::vector<Maker> found;
  const auto is_there = [](const char* package) {
    return std::filesystem::exists(package_directory(package) + "/dist");
  };
  const bool simd = is_there(kSimd), deterministic = is_there(kDeterministic);
  if ((!simd && !deterministic) || std::system("node --version >/dev/null 2>&1") != 0) return found;
  if (simd) found.push_back({"rapier-simd", false, make_rapier<kSimd>});
  if (deterministic) found.push_back({"rapier-det", false, make_rapier<kDeterministic>});
  return found;
}

}  // namespace isostep::bench
