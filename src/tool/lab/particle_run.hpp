// One run of a scene's particles, as the laboratory watches it: bodies are where their particles are.
// SPDX-License-Identifier: MIT
#pragma once

#include "result.hpp"
#include "scenes/measure.hpp"
#include "scenes/particles/particle_measure.hpp"
#include "scenes/residuals.hpp"
#include "scenes/sight.hpp"
#include "subject.hpp"

namespace isostep::tool::lab {

template <class S> class ParticleRun {
 public:
  ParticleRun(const Subject& subject, const LabPoint& point);

  void prepare() {}
  bool step();
  scenes::Energy energy() const;
  double joint_error() const { return scenes::largest_link_error(world_); }
  scenes::Overlap overlap() const;
  scenes::ContactResiduals residuals() const { return {kUnknown, kUnknown, kUnknown, 0}; }
  scenes::Sight sight(int faults) const;

 private:
  void add_particles();
  void add_rods();
  void add_scenery();

  const ParticlePlan& plan_;
  ParticleWorld<S> world_;
  std::vector<ParticleId> particles_;  // as the plan's
  double mass_ = 0;                    // [kg]
};

#define ISO_EXTERN(S) extern template class ParticleRun<S>;
ISO_FOR_EACH_SCALAR(ISO_EXTERN)
#undef ISO_EXTERN

}  // namespace isostep::tool::lab
