// Two recordings played side by side.
// SPDX-License-Identifier: MIT
#include "divergence.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace isostep::tool::page {
namespace {

/// A recording up to some frame: who is there, and where.
class Play {
 public:
  struct Place {
    bool is = false;
    std::array<std::int32_t, 3> at = {};
  };

  explicit Play(const Recording& recording) : recording_(recording), places_(recording.actors.size()) {}
  void advance(std::size_t frame) {
    for (const Changed& changed : recording_.frames[frame].changed)
      places_[changed.actor].is = changed.to != Change::gone;
    for (const Moved& moved : recording_.frames[frame].moved) places_[moved.actor].at = moved.pose.at;
  }
  const std::vector<Place>& places() const { return places_; }

 private:
  const Recording& recording_;
  std::vector<Place> places_;
};

/// The namesake in `b` of each actor of `a`, or -1. Wheels have none: they go where their bodies go.
std::vector<std::int32_t> namesakes(const Recording& a, const Recording& b) {
  std::map<std::uint64_t, std::int32_t> by_id;
  const auto id = [](const Actor& actor) { return std::uint64_t{actor.generation} << 32 | actor.slot; };
  for (std::size_t i = 0; i < b.actors.size(); ++i) {
    if (!b.actors[i].wheel) by_id[id(b.actors[i])] = static_cast<std::int32_t>(i);
  }
  std::vector<std::int32_t> found;
  for (const Actor& actor : a.actors) {
    const auto at = by_id.find(id(actor));
    found.push_back(actor.wheel || at == by_id.end() ? -1 : at->second);
  }
  return found;
}

double distance(const Play::Place& a, const Play::Place& b) {
  double square = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = kGrid * (double{static_cast<double>(a.at[i])} - b.at[i]);
    square += d * d;
  }
  return std::sqrt(square);
}

}  // namespace

Divergence compare(const Recording& a, const Recording& b, double tolerance) {
  Divergence found;
  Play play_a(a), play_b(b);
  const std::vector<std::int32_t> in_b = namesakes(a, b);
  for (std::size_t frame = 0; frame < a.frames.size() && frame < b.frames.size(); ++frame) {
    play_a.advance(frame);
    play_b.advance(frame);
    double most = 0;
    std::size_t farthest = 0, alone = a.actors.size();
    for (std::size_t i = 0; i < in_b.size(); ++i) {
      if (a.actors[i].wheel) continue;
      const Play::Place& here = play_a.places()[i];
      const Play::Place there = in_b[i] < 0 ? Play::Place{} : play_b.places()[static_cast<std::size_t>(in_b[i])];
      if (here.is != there.is) alone = std::min(alone, i);
      if (!here.is || !there.is || distance(here, there) <= most) continue;
      most = distance(here, there);
      farthest = i;
    }
    found.apart.push_back(most);
    const bool beyond = most > tolerance;
    if (found.frame != Divergence::kNever || (!beyond && alone == a.actors.size())) continue;
    const Actor& actor = a.actors[beyond ? farthest : alone];
    found.frame = static_cast<std::int32_t>(frame);
    found.slot = actor.slot;
    found.generation = actor.generation;
    found.distance = beyond ? most : 0;
  }
  return found;
}

}  // namespace isostep::tool::page
