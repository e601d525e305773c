// The families of trials, one file each, in the order in which they are listed.
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "trial.hpp"

namespace isostep::scenes {

std::span<const Trial> stacking_trials();
std::span<const Trial> structure_trials();
std::span<const Trial> chain_trials();
std::span<const Trial> crowd_trials();
std::span<const Trial> far_trials();
std::span<const Trial> motion_trials();
std::span<const Trial> friction_trials();
std::span<const Trial> contact_law_trials();
std::span<const Trial> recovery_trials();
std::span<const Trial> spring_trials();
std::span<const Trial> loop_trials();
std::span<const Trial> bounce_trials();
std::span<const Trial> ragdoll_trials();
std::span<const Trial> mechanism_trials();
std::span<const Trial> gear_trials();
std::span<const Trial> fixed_point_trials();

inline std::vector<std::span<const Trial>> trial_families() {
  return {stacking_trials(),     // a line each
          structure_trials(),    //
          chain_trials(),        //
          crowd_trials(),        //
          far_trials(),          //
          motion_trials(),       //
          friction_trials(),     //
          contact_law_trials(),  //
          recovery_trials(),     //
          spring_trials(),       //
          loop_trials(),         //
          bounce_trials(),       //
          ragdoll_trials(),      //
          mechanism_trials(),    //
          gear_trials(),         //
          fixed_point_trials()};
}

}  // namespace isostep::scenes
