// Our engine in the scene benchmark, one maker a scalar, and the list of makers.
// SPDX-License-Identifier: MIT
#include "our_queries.hpp"
#include "scenes/build.hpp"
#include "scenes/script.hpp"

namespace isostep::bench {
namespace {

template <class S> class OurEngine : public Engine {
 public:
  OurEngine(const scenes::Scene& scene, const EngineOptions& options)
      : script_(scene.script), world_(settings_of(scene, options)) {
    const scenes::Built<S> built = scenes::build(scene, world_);
    if (scene.name == "S14") world_.set_filter(built.bodies[0], {OurQueries<S>::kTerrain, 0xffffffffu, 0});
  }

  void before_step(int) override { scenes::before_step(script_, world_); }
  void step() override {
    if (!world_.step().clean()) ++faults_;
  }

  bool all_asleep() const override { return world_.counts().awake == 0; }
  int faults() const override { return faults_; }
  scenes::Sight sight() const override { return scenes::sight_of(world_, faults_); }
  scenes::Overlap overlap() const override { return scenes::measure_overlap(world_); }
  std::string settings() const override {
    return std::string(world_.simd_name()) + ", " + std::to_string(world_.settings().substeps) + " sub-steps";
  }

  void take(const scenes::DrawnQueries& drawn) override { queries_.take(drawn); }
  std::optional<Answered> ask(Query query) override { return queries_.ask(world_, query); }

 private:
  static Settings<S> settings_of(const scenes::Scene& scene, const EngineOptions& options) {
    Settings<S> settings = scenes::settings_of<S>(scene);
    if (options.substeps > 0) settings.substeps = options.substeps;
    return settings;
  }

  scenes::Script script_;
  World<S> world_;
  OurQueries<S> queries_;
  int faults_ = 0;
};

template <class S> std::unique_ptr<Engine> make_ours(const scenes::Scene& scene, const EngineOptions& options) {
  return std::make_unique<OurEngine<S>>(scene, options);
}

}  // namespace

std::vector<Maker> makers() {
  std::vector<Maker> all;
#define ISO_MAKER(S) all.push_back({ScalarTraits<S>::kName, true, make_ours<S>});
  ISO_FOR_EACH_SCALAR(ISO_MAKER)
#undef ISO_MAKER
  for (const Maker& maker : peer_makers()) all.push_back(maker);
  return all;
}

}  // namespace isostep::bench
