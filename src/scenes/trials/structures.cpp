// Trials of things that are built to stand: card house, arch, towers of planks.
// SPDX-License-Identifier: MIT
#include "families.hpp"
#include "judges.hpp"
#include "scenes/named.hpp"
#include "scenes/shapes.hpp"

namespace isostep::scenes {
namespace {

/// A turn about the world's z axis, anticlockwise as seen from +z.
Rotation roll(double angle) {
  const SinCos<double> half = sin_cos(angle / 2);
  return {0, 0, half.sin, half.cos};
}

Scene bare_floor(int frames) {
  Scene scene = stack(0);
  scene.frames = frames;
  return scene;
}

// Card house. A pair of cards leans edge to edge at its mid-plane and stands on its lower inner edges; one board lies
// on a storey's peaks, on both cards of each. A peak that is loaded on one side alone slips: where one edge is lower
// than the other, the face that it meets drives it further down, and only friction beyond cot(lean) would hold it.
constexpr double kCard = 0.4, kThick = 0.02, kDeep = 0.3;  // [m]
constexpr double kLean = kTurn / 18;                       // [rad] from the vertical

void add_card(Scene& scene, Point at, double length, double angle) {
  SceneBody card = body_of(box_part({kThick / 2, length / 2, kDeep / 2}), at);
  card.orientation = roll(angle);
  card.friction = 0.7;
  scene.bodies.push_back(card);
}

Scene card_house() {
  constexpr int kStoreys = 4;
  constexpr double kApart = 0.4, kBeyond = 0.05;  // [m] of peaks; of a board beyond the outer ones
  const SinCos<double> lean = sin_cos(kLean);
  const double reach = (kThick * lean.cos + kCard * lean.sin) / 2;   // [m] of a card to either side
  const double height = (kThick * lean.sin + kCard * lean.cos) / 2;  // [m] the same upwards
  Scene scene = bare_floor(3600);
  for (int storey = 0; storey < kStoreys; ++storey) {
    const int pairs = kStoreys - storey;
    const double ground = storey * (2 * height + kThick), width = (pairs - 1) * kApart;  // [m]
    for (int i = 0; i < pairs; ++i) {
      const double peak = i * kApart - width / 2;
      add_card(scene, {peak - reach, ground + height, 0}, kCard, -kLean);
      add_card(scene, {peak + reach, ground + height, 0}, kCard, kLean);
    }
    if (pairs > 1) {
      add_card(scene, {0, ground + 2 * height + kThick / 2, 0}, width + 2 * kBeyond, kTurn / 4);
    }
  }
  return scene;
}

/// [s] The time of the run that was left when the first body was a quarter of a card from its start.
class Unstanding : public FromStart {
 public:
  explicit Unstanding(const Scene& scene) : whole_(static_cast<double>(scene.frames) / scene.hz) {}
  double figure() const override { return fell_ < 0 ? 0 : whole_ - fell_; }

 private:
  void compare(const Sight& start, const Sight& now) override {
    for (std::size_t i = 0; fell_ < 0 && i < start.bodies.size(); ++i) {
      const bool in_place = length_of(way_of(start, now, i)) < kCard / 4;
      if (!in_place) fell_ = now.time;
    }
  }
  double whole_, fell_ = -1;  // [s]
};

// Arch: a half circle of wedges. A wedge is two boxes, each flat on one of its side faces, so that neighbours touch in
// planes; towards the outside the boxes gape.
constexpr int kStones = 11;
constexpr double kInner = 4, kOuter = 5;  // [m] radii

SceneBody wedge(double angle) {
  constexpr double kHalf = kTurn / 4 / kStones;  // [rad] half of what a stone spans
  const SinCos<double> half = sin_cos(kHalf);
  const double width = kInner * 2 * half.sin * half.cos;  // [m] of a box: just short of the other side face
  const double middle = (kInner + kOuter) / 2;
  SceneBody body;
  for (const double side : {-1.0, 1.0}) {
    ScenePart part = box_part({(kOuter - kInner) / 2, width / 2, 0.5});
    // The part is in the stone's frame, x outward and its origin in the middle of its bisector.
    part.position = {middle * half.cos + width / 2 * half.sin - middle,
                     side * (middle * half.sin - width / 2 * half.cos), 0};
    part.orientation = roll(side * kHalf);
    body.parts.push_back(part);
  }
  const SinCos<double> at = sin_cos(angle);
  body.position = {middle * at.cos, middle * at.sin, 0};
  body.orientation = roll(angle);
  body.mass = 1;
  body.friction = 0.6;
  return body;
}

Scene arch() {
  Scene scene = bare_floor(3600);
  for (int i = 0; i < kStones; ++i) scene.bodies.push_back(wedge((i + 0.5) * (kTurn / 2 / kStones)));
  return scene;
}

/// [%] The largest way of the stone at the top, which is the middle one, over its height.
class KeystoneWay : public FromStart {
 public:
  double figure() const override { return 100 * worst_; }

 private:
  void compare(const Sight& start, const Sight& now) override {
    const std::size_t keystone = start.bodies.size() - 1 - kStones / 2;
    worst_ = worse(worst_, length_of(way_of(start, now, keystone)) / start.bodies[keystone].centre.y);
  }
  double worst_ = 0;
};

// Towers of planks, each layer across the one below.
constexpr double kPlankHeight = 0.15;  // [m]

void add_plank(Scene& scene, int layer, double across, Point half) {
  const bool turned = layer % 2 == 1;
  const double y = (2 * layer + 1) * half.y;
  scene.bodies.push_back(turned ? body_of(box_part({half.z, half.y, half.x}), {0, y, across})
                                : body_of(box_part(half), {across, y, 0}));
}

/// A tower in the middle of the game: of every second layer one plank is out, a middle one and one of either side in
/// turn.
Scene jenga() {
  constexpr int kLayers = 18, kPlanks = 3;
  constexpr double kPitch = 0.25;  // [m]
  Scene scene = bare_floor(600);
  for (int layer = 0; layer < kLayers; ++layer) {
    const int out = layer % 2 == 1 && layer < kLayers - 2 ? (layer / 2 + 1) % kPlanks : -1;
    for (int i = 0; i < kPlanks; ++i) {
      if (i != out) add_plank(scene, layer, (i - 1) * kPitch, {0.122, kPlankHeight / 2, 0.375});
    }
  }
  return scene;
}

/// Two planks a layer, on edge, near their ends.
Scene keva() {
  Scene scene = bare_floor(600);
  for (int layer = 0; layer < 30; ++layer) {
    for (const double across : {-0.4, 0.4}) add_plank(scene, layer, across, {0.05, kPlankHeight, 0.5});
  }
  return scene;
}

std::unique_ptr<Judge> by_a_plank(const Scene&) { return std::make_unique<Displaced>(kPlankHeight); }

}  // namespace

std::span<const Trial> structure_trials() {
  static const Trial trials[] = {
      {"card_house", "8", "20 cards lean in pairs under three boards, for a minute",
       "time missing from a minute of standing", "s", 0, card_house, judge_of<Unstanding>},
      {"arch", "9", "a half circle of 11 wedges without mortar, for a minute",
       "largest way of the keystone, of its height", "%", 1, arch, judge_of<KeystoneWay>},
      {"jenga_tower", "10", "18 layers of planks, eight planks taken out",
       "planks that moved by more than their thickness", "", 0, jenga, by_a_plank},
      {"keva_tower", "10", "30 layers of two planks on edge", "planks that moved by more than half their height", "", 0,
       keva, by_a_plank},
  };
  return trials;
}

}  // namespace isostep::scenes
