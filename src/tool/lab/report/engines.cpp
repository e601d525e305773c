// Names in full. The versions are those of bench/peers.sh, and of Debian 12.
// SPDX-License-Identifier: MIT
#include "engines.hpp"

#include <algorithm>

#include "isostep/core/scalar_names.hpp"
#include "isostep/dynamics/solver_name.hpp"

namespace isostep::tool::lab {
namespace {

struct Words {
  std::string_view name;
  const char *full, *what;
};

constexpr Words kEngines[] = {
    {"bullet", "Bullet 3.24 (Debian)", "float, sequential impulses: 10 iterations; at its best 50"},
    {"dart", "DART 6.12 (Debian)", "double, an exact solution by Dantzig's method; for robots"},
    {"havok", "Havok 1.3.14 (npm @babylonjs/havok)", "float, its defaults: its interface has no iterations"},
    {"jolt", "Jolt (npm jolt-physics 1.1.0)",
     "float, sequential impulses: 10 velocity and 2 position steps; at its best 20, 6 and 4 collision steps"},
    {"mujoco", "MuJoCo 3.14.0 (npm @mujoco/mujoco)",
     "double, soft contacts by Newton's method, joints as coordinates; at its best elliptic cones without slip"},
    {"ode", "ODE 0.16 (Debian)", "double, quick step: 20 iterations; at its best the exact step, up to 300 bodies"},
    {"physx-pgs", "PhysX 5.6.1, PGS (npm physx-js-webidl 2.7.3)",
     "float, projected Gauss-Seidel: 4 position iterations; at its best 32"},
    {"physx-tgs", "PhysX 5.6.1, TGS (npm physx-js-webidl 2.7.3)",
     "float, the same over small steps of time: 4 position iterations; at its best 32"},
    {"rapier-det", "Rapier 0.21.0, deterministic (npm)", "float without SIMD: 4 iterations; at its best 16"},
    {"rapier-simd", "Rapier 0.20.0, SIMD (npm)", "float: 4 iterations; at its best 16"},
};
constexpr Words kSolvers[] = {
    {"soft_step", "soft_step, the default",
     "small steps of time, contacts as stiff damped springs, joints in trees at once"},
    {"pgs", "pgs", "one step of time and passes over all contacts, as most engines do"},
    {"worst_first", "worst_first", "small steps of time, always the worst contact next; slow in crowds"},
    {"direct", "direct", "all contacts of touching bodies solved at once; exact, for small groups"},
    {"admm", "admm", "all contacts of touching bodies solved at once, friction whole; for hundreds of bodies"},
    {"avbd", "avbd", "augmented vertex block descent: body after body, against penalties; for comparison"},
};
constexpr Words kScalars[] = {
    {"float", "float", "32 bits, floating; fastest"},
    {"double", "double", "64 bits, floating"},
    {"q16.16", "q16.16", "32 bits, fixed point: a step of 15 µm, up to 32 km; for small scenes"},
    {"q32.32", "q32.32", "64 bits, fixed point; equal bits without a floating-point unit"},
};

}  // namespace

bool is_best(std::string_view row) { return row.ends_with("-best"); }
std::string engine_of(std::string_view row) {
  if (is_best(row)) row.remove_suffix(5);
  return std::string(row);
}

std::string full_name(std::string_view engine) {
  const auto* found =
      std::find_if(std::begin(kEngines), std::end(kEngines), [&](const Words& w) { return w.name == engine; });
  return found == std::end(kEngines) ? std::string(engine) : found->full;
}

std::vector<std::string> engines_in(const std::vector<LabResult>& results) {
  std::vector<std::string> engines;
  for (const LabResult& r : results) engines.push_back(r.point.engine);
  return engines;
}

std::vector<std::vector<std::string>> who_is_who(const std::vector<std::string>& rows) {
  std::vector<std::vector<std::string>> cells = {{"name here", "in full", "what it is"}};
  for (const Words& w : kSolvers)
    cells.push_back({std::string(w.name), std::string("isostep's solver ") + w.full, w.what});
  for (const Words& w : kScalars)
    cells.push_back({std::string(w.name), std::string("isostep's numbers ") + w.full, w.what});
  for (const Words& w : kEngines) {
    const bool runs =
        std::any_of(rows.begin(), rows.end(), [&](const std::string& row) { return engine_of(row) == w.name; });
    if (runs) cells.push_back({std::string(w.name), w.full, w.what});
  }
  return cells;
}

}  // namespace isostep::tool::lab
