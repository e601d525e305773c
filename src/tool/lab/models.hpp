// Simpler models of a scene: boxes as spheres, bodies as particles, chains as ropes of rods; or why that would not be
// the same scene any more.
// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "body_facts.hpp"
#include "scenes/scene.hpp"

namespace isostep::tool::lab {

/// A model that cannot be had says why.
template <class Model> struct Offer {
  Model model = {};
  std::string reason;  // empty: it is offered
};

/// Every dynamic body becomes a sphere of its volume, mass and place.
Offer<scenes::Scene> sphere_model(const scenes::Scene& scene);

/// A world of particles before any scalar is chosen.
struct ParticlePlan {
  struct Material {
    double radius, friction, restitution, gravity_scale;  // [m], [1]
    double damping;                                       // [1] share of the velocity that is kept for a second
    bool collides;
    friend bool operator==(const Material&, const Material&) = default;
  };
  struct Particle {
    Vec3<double> position, velocity;  // [m], [m/s]
    double mass;                      // [kg]
    std::size_t material;
  };
  struct Rod {
    int a, b;             // particles; b = -1: the anchor
    Vec3<double> anchor;  // [m]
    double length;        // [m]
  };
  struct Scenery {
    bool is_plane;            // else a line
    Vec3<double> normal;      // [1] of a plane
    double offset;            // [m] of a plane
    Vec3<double> start, end;  // [m] of a line
    double radius;            // [m] of a line
  };
  /// The place of a body of the scene: between two ends, each a particle or, at -1, a fixed point.
  struct Place {
    int ends[2];
    Vec3<double> fixed[2];  // [m]
    double share;           // [1] of the way from the first to the second
    bool dynamic;
  };
  std::vector<Material> materials;
  std::vector<Particle> particles;
  std::vector<Rod> rods;
  std::vector<Scenery> scenery;
  std::vector<Place> places;  // one a body
  Vec3<double> gravity;       // [m/s^2]
};
/// A body without joints becomes a particle of its mass and volume, a ball one without friction. A link of a chain of
/// ball joints, which nothing collides with, becomes a rod between its joints, to which its mass goes by the lever. A
/// fixed box becomes the plane of the face that all bodies are in front of, as if that face went on for ever.
Offer<ParticlePlan> particle_model(const scenes::Scene& scene);

}  // namespace isostep::tool::lab
