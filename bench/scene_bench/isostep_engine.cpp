// Our engine in the scene benchmark, one maker a scalar, and the list of makers.
// SPDX-License-Identifier: MIT
#include "engine.hpp"
#include "scenes/build.hpp"
#include "scenes/script.hpp"

namespace isostep::bench {
namespace {

template <class S> class OurEngine : public Engine {
 public:
  OurEngine(const scenes::Scene& scene, const EngineOptions& options)
      : script_(scene.script),
        world_(scenes::settings_of<S>(scene, 60, options.substeps > 0 ? options.substeps : Settings<S>{}.substeps)) {
    bodies_ = scenes::build(scene, world_).bodies;
  }

  void before_step(int, bool script) override {
    if (script) scenes::before_step(script_, world_);
  }
  void step() override {
    if (!world_.step().clean()) ++faults_;
  }

  bool all_asleep() const override { return world_.counts().awake == 0; }
  int faults() const override { return faults_; }
  std::vector<Place> places() const override {
    std::vector<Place> places;
    for (const BodyId body : script_ == scenes::Script::none ? bodies_ : world_.bodies()) {
      const Vec3<S> c = world_.centre(body);
      places.push_back({{to_double(c.x), to_double(c.y), to_double(c.z)}, world_.type(body) == BodyType::dynamic});
    }
    return places;
  }
  double joint_error() const override { return scenes::largest_joint_error(world_); }
  scenes::Energy energy() const override { return scenes::measure_energy(world_); }
  scenes::Overlap overlap() const override { return scenes::measure_overlap(world_); }
  std::string settings() const override {
    return std::string(world_.simd_name()) + ", " + std::to_string(world_.settings().substeps) + " sub-steps";
  }

 private:
  scenes::Script script_;
  World<S> world_;
  std::vector<BodyId> bodies_;
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
#if defined(ISOSTEP_BENCH_RAPIER)
  for (const Maker& maker : rapier_makers()) all.push_back(maker);
#endif
#if defined(ISOSTEP_BENCH_BULLET)
  all.push_back({"bullet", false, make_bullet});
#endif
#if defined(ISOSTEP_BENCH_ODE)
  all.push_back({"ode", false, make_ode});
#endif
  return all;
}

}  // namespace isostep::bench
