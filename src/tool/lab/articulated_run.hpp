// One run of a scene's tree of hinges in joint coordinates, as the laboratory watches it.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/articulation/articulation.hpp"
#include "result.hpp"
#include "scenes/measure.hpp"
#include "scenes/residuals.hpp"
#include "scenes/sight.hpp"
#include "subject.hpp"

namespace isostep::tool::lab {

inline constexpr const char* kArticulation = "articulation";  // the model
inline constexpr const char* kArticulatedBody = "articulated_body";

/// Returns why the scene is no articulation; empty: it is one. It is a tree of bodies of one part each, on hinges with
/// motors at most, that nothing touches; each body comes after the one that it hangs on.
std::string refusal_of_articulation(const scenes::Scene& scene);

/// The constructor throws scenes::SceneError for what the scalar refuses.
template <class S> class ArticulatedRun {
 public:
  ArticulatedRun(const Subject& subject, const LabPoint& point);

  void prepare() {}
  /// Steps once. Returns whether the step had to mend numbers.
  bool step();
  scenes::Energy energy() const;
  double joint_error() const { return 0; }
  scenes::Overlap overlap() const { return {}; }
  scenes::ContactResiduals residuals() const { return {kUnknown, kUnknown, kUnknown, 0}; }
  scenes::Sight sight(int faults) const;

 private:
  Articulation<S> tree_;
};

#define ISO_ARTICULATED_RUN(extern, S) extern template class ArticulatedRun<S>;
ISO_EXTERN_FLOAT(ISO_ARTICULATED_RUN) ISO_EXTERN_DOUBLE(ISO_ARTICULATED_RUN) ISO_EXTERN_Q32_32(ISO_ARTICULATED_RUN)

}  // namespace isostep::tool::lab
