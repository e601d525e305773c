// Camera: takes every so many steps of a run for a page.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/particles/settings.hpp"
#include "isostep/replay/recorder.hpp"
#include "recorder.hpp"

namespace isostep::tool::page {

/// The camera tells a page of a run as it goes.
class Camera {
 public:
  Camera(Recording& recording, int every) : recording_(recording), recorder_(recording), every_(every) {}

  template <class S> void begin(const World<S>& world) {
    recording_.solver = solver_name(world.settings().solver);
    begin_any(world);
  }
  template <class S> void begin(const ParticleWorld<S>& world) {
    recording_.solver = kIntegratorNames[static_cast<std::uint32_t>(world.settings().integrator)];
    begin_any(world);
  }
  /// It is called after a step, the `taken`-th.
  template <class W> void stepped(const W& world, int taken, bool last) {
    if (taken % every_ == 0 || last) recorder_.record(world);
  }

 private:
  template <class W> void begin_any(const W& world) {
    recording_.scalar = ScalarTraits<typename W::Scalar>::kName;
    recording_.hz = world.settings().hz;
    recording_.substeps = world.settings().substeps;
    recorder_.record(world);
  }

  Recording& recording_;
  Recorder recorder_;
  int every_;
};

}  // namespace isostep::tool::page
