// ParticleEngine<S>: what stands behind ParticleWorld<S>. It holds the state and the systems that a step calls.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "isostep/particles/commands.hpp"
#include "isostep/particles/particle_world.hpp"
#include "isostep/particles/removal.hpp"
#include "isostep/particles/solvers/soft_step.hpp"
#include "isostep/particles/solvers/worst_first_step.hpp"
#include "isostep/particles/step/contacts.hpp"
#include "isostep/particles/step/finish.hpp"
#include "isostep/state/fields.hpp"
#include "isostep/state/world_desk.hpp"

namespace isostep {

template <class S> class ParticleEngine {
 public:
  explicit ParticleEngine(const ParticleSettings<S>& settings);
  ParticleEngine(const ParticleEngine&) = delete;  // its members refer to each other
  ParticleEngine& operator=(const ParticleEngine&) = delete;

  // engine_step.inl
  ParticleReport step(const ParticleStageObserver& observer);

  // engine_fields.inl
  StageView view(std::uint32_t stage);
  static void walk_fields(void* engine, FieldGroup group, std::uint32_t stage, const FieldSink& sink);
  template <class Visit> void visit_fields(FieldGroup group, std::uint32_t stage, const Visit& visit);

  // engine_state.inl
  void load(const ParticleState<S>& from);
  std::uint64_t hash() const;
  void write_portable(Writer& writer) const;
  Result<void> read_portable(Reader& reader);

  // Each system knows only what stands above it: README.md draws who knows whom.
  ParticleState<S> state_;
  WorldDesk desk_;
  ParticleRemoval<S> removal_{state_};
  ParticleCommands<S> commands_{state_, desk_.faults, removal_};
  ParticleStep<S> step_;
  FreeFlight<S> flight_{state_, step_};
  PairSearch<S> search_{state_, step_};
  ParticleRows<S> rows_{state_, step_};
  ParticleContacts<S> contacts_{state_, step_, search_, rows_};
  ParticleSprings<S> springs_{state_, step_};
  StiffSprings<S> stiff_springs_{state_, step_};
  ParticleForces<S> forces_{state_, step_, flight_, springs_};
  ParticleIntegration<S> integration_{state_, step_, flight_, forces_, stiff_springs_};
  ParticleSoftStep<S> soft_step_{state_, step_, rows_, integration_};
  WorstFirstStep<S> worst_first_{state_, step_, rows_, integration_};
  ParticleFinish<S> finish_{state_, step_, flight_};

 private:
  /// Returns true if impulses over sub-steps are used. Time division always takes the book's methods.
  bool is_soft() const {
    return state_.settings.solver == ParticleSolver::soft_step && state_.settings.stepping == Stepping::fixed;
  }
  void begin_step();
  void solve_substeps();
  template <class Visit> void visit_scratch(const Visit& visit, ParticleStage stage);
};

/// The step is compiled apart from what is called between steps: instantiate/particle_step.cpp.
#define ISO_PARTICLE_ENGINE_OF(extern, S) \
  extern template ParticleReport ParticleEngine<S>::step(const ParticleStageObserver&);
ISO_EXTERN_FOR_EACH_SCALAR(ISO_PARTICLE_ENGINE_OF)

}  // namespace isostep
