// Houses, stairs, ramps and what else a town has.
// SPDX-License-Identifier: MIT
#include "town_pieces.hpp"

#include <cmath>

namespace isostep::scenes {
namespace {

using Kind = LevelSpot::Kind;

Point sum(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Warp moved(Point by) {
  return [by](Point p) { return sum(p, by); };
}
std::string numbered(const std::string& name, int n) { return name + " " + std::to_string(n); }
std::string name_at(const std::string& name, Point at) {
  return name + " at " + std::to_string(static_cast<int>(at.x)) + " " + std::to_string(static_cast<int>(at.z));
}
/// Along the middle of a row of three planes or more, a cell that is neither the first nor the last.
bool is_inner(const std::vector<double>& planes, int i) { return i > 0 && i + 2 < static_cast<int>(planes.size()); }

// [m] The sizes of a house.
constexpr double kEaves = 3, kRidge = 2;  // walls, and the roof above them
constexpr double kDoorHalf = 0.625, kDoorTop = 2.25;
/// The height of the roof above the eaves, at a distance from the ridge.
double gable(double z) { return kRidge * (1 - std::fabs(z) / 4); }

}  // namespace

void TownPieces::tell(std::string name, Kind kind, Point at, Point outward, int material) {
  spots_.push_back({std::move(name), kind, at, outward, material});
}

void TownPieces::add_border(double half) {
  const double h = half;
  std::vector<double> side = evenly(-h, h, 13);
  side.insert(side.begin(), -h - 0.5);
  side.push_back(h + 0.5);
  const Planes planes = {side, {-0.5, 0.25, 1.5}, side};
  mesh_.use(kWall);
  const auto filled = [&](int i, int, int k) { return !is_inner(side, i) || !is_inner(side, k); };
  mesh_.add_cells(planes, filled, moved({0, 0, 0}));
  tell_wall("border to the east", {h, 0.75, -1}, {-1, 0, 0}, kWall);
  tell_wall("border to the north", {-1, 0.75, -h}, {0, 0, 1}, kWall);
  tell_top("border's top to the west", {-h - 0.25, 1.5, -1}, kWall);
}

void TownPieces::add_house(Point at) {
  const Planes planes = {{-4, -3.75, -3, -2, -kDoorHalf, kDoorHalf, 2, 3, 3.75, 4},
                         {-0.5, 0.5, 1, 2, kDoorTop, kEaves},
                         {-3, -2.75, -1.75, -0.75, 0, 0.75, 1.75, 2.75, 3}};
  const auto filled = [&](int i, int j, int k) {
    if (is_inner(planes.x, i) && is_inner(planes.z, k)) return false;
    const bool door = is_between(planes.x, i, -kDoorHalf, kDoorHalf) && is_between(planes.y, j, -1, kDoorTop);
    const bool side = is_between(planes.x, i, -3, -2) || is_between(planes.x, i, 2, 3);
    const bool gable_side = is_between(planes.z, k, -0.75, 0.75);
    const bool window = is_between(planes.y, j, 1, 2) && (is_inner(planes.x, i) ? side : gable_side);
    return !door && !window;
  };
  mesh_.use(kWall);
  mesh_.add_cells(planes, filled, [&](Point p) {
    return sum(at, {p.x, p.y == kEaves ? kEaves + gable(p.z) : p.y, p.z});
  });
  add_roof(at);
  const std::string house = name_at("house", at);
  tell(house + ", south door", Kind::doorway, sum(at, {0, 0, 2.875}), {0, 0, 1}, kWall);
  tell(house + ", north door", Kind::doorway, sum(at, {0, 0, -2.875}), {0, 0, -1}, kWall);
  tell_wall(house + ", east wall", sum(at, {4, 1.5, 1.25}), {1, 0, 0}, kWall);
  tell_wall(house + ", west wall", sum(at, {-4, 1.5, -1.25}), {-1, 0, 0}, kWall);
  tell_wall(house + ", south wall", sum(at, {1.25, 1.5, 3}), {0, 0, 1}, kWall);
  tell_wall(house + ", east wall from inside", sum(at, {3.75, 1.5, 1.25}), {-1, 0, 0}, kWall);
  tell_wall(house + ", north wall from inside", sum(at, {-1.25, 1.5, -2.75}), {0, 0, 1}, kWall);
  tell_top(house + ", floor", sum(at, {2, 0, 1}), kGrass);
}

/// A bent slab over the walls, a sixteenth of a metre in them.
void TownPieces::add_roof(Point at) {
  constexpr double kLow = kEaves - 0.0625, kHigh = kLow + 0.25;
  const Planes planes = {evenly(-4.5, 4.5, 6), {kLow, kHigh}, {-4, -2.5, -1.25, 0, 1.25, 2.5, 4}};
  mesh_.use(kRoof);
  mesh_.add_cells(
      planes, [](int, int, int) { return true; },
      [&](Point p) {
        return sum(at, {p.x, p.y + gable(p.z), p.z});
      });
  const std::string roof = name_at("roof", at);
  const double drop = kRidge / 4;
  tell(roof + ", south side", Kind::top, sum(at, {1, kHigh + gable(2), 2}), unit_of({0, 1, drop}), kRoof);
  tell(roof + ", north side", Kind::top, sum(at, {-1, kHigh + gable(2), -2}), unit_of({0, 1, -drop}), kRoof);
}

void TownPieces::add_tall_house(Point at) {
  constexpr double kTop = 5.25;
  constexpr int kSteps = 21;
  const Planes planes = {{-5, -4.75, -3.5, -2.5, -kDoorHalf, kDoorHalf, 2.5, 3.5, 4.75, 5},
                         {-0.5, 0.5, 1, 2, kDoorTop, 3.25, 4.25, 5, kTop, 6},
                         {-4, -3.75, -2.25, -0.75, 0.75, 2.25, 3.75, 4}};
  const auto filled = [&](int i, int j, int k) {
    if (is_between(planes.y, j, 5, kTop)) return true;
    const bool inner_x = is_inner(planes.x, i), inner_z = is_inner(planes.z, k);
    if (inner_x && inner_z) return false;
    if (planes.y[static_cast<std::size_t>(j)] >= kTop) {  // the parapet; the stairs arrive where it has a gap
      return !(is_between(planes.x, i, 4.75, 5) && is_between(planes.z, k, 2.25, 3.75));
    }
    const bool door = is_between(planes.x, i, -kDoorHalf, kDoorHalf) && is_between(planes.y, j, -1, kDoorTop);
    const bool high = is_between(planes.y, j, 1, 2) || is_between(planes.y, j, 3.25, 4.25);
    const bool bay = is_between(planes.x, i, -3.5, -2.5) || is_between(planes.x, i, 2.5, 3.5);
    const bool window = high && (inner_x ? bay : i == 0 && is_between(planes.z, k, -0.75, 0.75));
    return !door && !window;
  };
  mesh_.use(kWall);
  mesh_.add_cells(planes, filled, moved(at));
  const Point foot = sum(at, {4.9375, 0, -4.125});  // of the stairs
  Planes steps = {{0, 1.5625}, {-0.5}, evenly(0, 0.375 * kSteps, kSteps)};
  for (int i = 1; i <= kSteps; ++i) steps.y.push_back(0.25 * i);
  mesh_.use(kStairs);
  mesh_.add_cells(
      steps, [](int, int j, int k) { return j <= k; }, moved(foot));
  for (int i = 0; i < kSteps; ++i)
    tell_top(numbered("outer stairs", i), sum(foot, {1, 0.25 * (i + 1), 0.375 * (i + 0.5)}), kStairs);
  tell_top("flat roof", sum(at, {-1, kTop, 1}), kWall);
  tell_top("parapet", sum(at, {-4.875, 6, 1.5}), kWall);
  tell_wall("parapet from inside", sum(at, {-4.75, 5.75, 1.5}), {1, 0, 0}, kWall);
  tell_wall("tall house, west wall", sum(at, {-5, 3, 3}), {-1, 0, 0}, kWall);
  tell_wall("tall house, south wall", sum(at, {1.5, 3, 4}), {0, 0, 1}, kWall);
  tell(std::string("tall house, south door"), Kind::doorway, sum(at, {0, 0, 3.875}), {0, 0, 1}, kWall);
  tell_top("tall house, floor", sum(at, {2, 0, 1}), kGrass);
}

/// One block: behind the terrace its layers grow thin toward the foot of the ramp, which is in the ground.
void TownPieces::add_grand_stairs(Point at) {
  constexpr int kSteps = 14;
  constexpr double kRun = 0.375, kRise = 0.1875, kTop = kSteps * kRise, kWidth = 4;
  constexpr double kTerrace = kSteps * kRun, kRamp = kTerrace + 4, kFall = 0.25;
  Planes planes = {evenly(0, kTerrace, kSteps), {-0.5}, evenly(0, kWidth, 4)};
  for (int i = 1; i <= kSteps; ++i) planes.y.push_back(kRise * i);
  for (const double x : {kTerrace + 2, kRamp, kRamp + 2, kRamp + 4, kRamp + 6, kRamp + 8, kRamp + 11})
    planes.x.push_back(x);
  mesh_.use(kStairs);
  mesh_.add_cells(
      planes, [](int i, int j, int) { return j <= i; },
      [&](Point p) {
        const double down = p.x > kRamp ? kFall * (p.x - kRamp) / (kTop + 0.5) : 0;
        return sum(at, {p.x, -0.5 + (p.y + 0.5) * (1 - down), p.z});
      });
  for (int i = 0; i < kSteps; ++i)
    tell_top(numbered("grand stairs", i), sum(at, {kRun * (i + 0.5), kRise * (i + 1), 1.5}), kStairs);
  tell_top("terrace", sum(at, {kTerrace + 3, kTop, 1.5}), kStairs);
  tell_wall("terrace, north side", sum(at, {kTerrace + 1, 1.5, 0}), {0, 0, -1}, kStairs);
  for (const double along : {1.0, 5.0, 9.0})
    tell(numbered("terrace's ramp", static_cast<int>(along)), Kind::top,
         sum(at, {kRamp + along, kTop - kFall * along, 1.5}), unit_of({kFall, 1, 0}), kStairs);
}

void TownPieces::add_tower(Point at) {
  constexpr int kSides = 24, kSteps = 20;
  constexpr double kStep = 0.1875, kTop = 6;
  const auto round = [&](Point p) {
    const SinCos<double> angle = sin_cos(kTurn * p.x / kSides);
    return sum(at, {p.z * angle.sin, p.y, p.z * angle.cos});
  };
  const auto place = [&](double side, double y, double radius) { return round({side, y, radius}); };
  const Planes walls = {evenly(0, kSides, kSides), {-0.5, 1, 2.25, 3.5, 4.5, kTop, kTop + 0.75}, {3.5, 4}, true};
  mesh_.use(kTower);
  mesh_.add_cells(
      walls,
      [&](int i, int j, int) {
        const bool door = (i == 0 || i == kSides - 1) && is_between(walls.y, j, -1, 2.25);
        const bool window = i % 6 == 3 && is_between(walls.y, j, 3.5, 4.5);
        const bool crown = is_between(walls.y, j, kTop, kTop + 1) && i % 2 == 1;
        return !door && !window && !crown;
      },
      round);
  Planes steps = {evenly(2, kSteps + 2, kSteps), {-0.5}, {1, 3.625}};
  for (int i = 1; i <= kSteps; ++i) steps.y.push_back(kStep * i);
  mesh_.use(kStairs);
  mesh_.add_cells(
      steps, [](int i, int j, int) { return j <= i; }, round);
  mesh_.use(kTower);
  mesh_.add_column(sum(at, {0, -0.5, 0}), 1.0625, 5.5, kSides);
  for (int i = 0; i < kSteps; ++i) tell_top(numbered("spiral", i), place(i + 2.5, kStep * (i + 1), 2.25), kStairs);
  tell_top("tower's column", sum(at, {0.5, 5, 0.25}), kTower);
  tell_top("tower's floor", place(0.5, 0, 2.25), kGrass);
  tell(std::string("tower's doorway"), Kind::doorway, sum(at, {0, 0, 3.75}), {0, 0, 1}, kTower);
  const double apothem = sin_cos(kTurn / kSides / 2).cos;  // of a side, for a radius of 1
  for (const int side : {3, 9, 15, 21}) {
    const SinCos<double> angle = sin_cos(kTurn * (side + 0.5) / kSides);
    tell_wall(numbered("tower, side", side), place(side + 0.5, 2.5, 4 * apothem), {angle.sin, 0, angle.cos}, kTower);
  }
}

void TownPieces::add_bridge(Point at) {
  constexpr double kReach = 12, kArch = 2;
  const auto arch = [](double x) { return kArch * (1 - x * x / (kReach * kReach)) - 0.125; };
  const Planes planes = {evenly(-kReach, kReach, 24), {-0.5, 0, 0.75}, {-1.75, -1.5, 0, 1.5, 1.75}};
  mesh_.use(kBridge);
  mesh_.add_cells(
      planes, [&](int, int j, int k) { return j == 0 || !is_inner(planes.z, k); },
      [&](Point p) {
        return sum(at, {p.x, p.y + arch(p.x), p.z});
      });
  for (const double x : {-4.0, 4.0}) mesh_.add_column(sum(at, {x, -3.5, 0}), 0.5, 3.5 + arch(x) - 0.25, 12);
  for (const int x : {-10, -6, -1, 4, 9}) {
    const double here = arch(x), next = arch(x + 1), slope = next - here;
    const Point middle = {x + 0.5, (here + next) / 2, 0.5};
    tell(numbered("bridge", x), Kind::top, sum(at, middle), unit_of({-slope, 1, 0}), kBridge);
  }
  tell_wall("bridge's rail from inside", sum(at, {0.5, arch(0) + 0.25, -1.5}), {0, 0, 1}, kBridge);
}

/// Its upper side begins a metre before `at`, in the ground.
void TownPieces::add_ramp(const std::string& name, Point at, double length, double width, double height) {
  const double slope = height / length;
  const Planes planes = {evenly(-1, length, 5), {0, 1}, evenly(0, width, 2)};
  mesh_.use(kRamp);
  mesh_.add_cells(
      planes, [](int, int, int) { return true; },
      [&](Point p) {
        return sum(at, {p.x, p.y == 0 ? -1 : slope * p.x, p.z});
      });
  for (const double share : {0.3125, 0.8125}) {
    const double x = share * length;
    tell(numbered(name, static_cast<int>(100 * share)), Kind::top, sum(at, {x, slope * x, 0.375 * width}),
         unit_of({-slope, 1, 0}), kRamp);
  }
  tell_wall(name + ", back", sum(at, {length, height / 2, 0.625 * width}), {1, 0, 0}, kRamp);
}

void TownPieces::add_ramps(Point at) {
  constexpr int kPieces = 12;
  constexpr double kRadius = 2.5, kWidth = 3;
  add_ramp("gentle ramp", at, 8, 2, 1);
  add_ramp("steep ramp", sum(at, {0, 0, 2.5}), 4, 2, 2);
  const Point foot = sum(at, {14, 0, 0});
  const auto round = [](double x) { return x <= 0 ? -0.125 : kRadius - std::sqrt(kRadius * kRadius - x * x); };
  Planes planes = {evenly(0, 0.96 * kRadius, kPieces), {0, 1}, evenly(0, kWidth, 3)};
  planes.x.push_back(kRadius + 0.5);
  mesh_.use(kRamp);
  const double lip = round(planes.x[kPieces]);
  const auto height = [&](double x) { return x > planes.x[kPieces] ? lip : round(x); };
  mesh_.add_cells(
      planes, [](int, int, int) { return true; },
      [&](Point p) {
        return sum(foot, {p.x, p.y == 0 ? -1 : height(p.x), p.z});
      });
  for (const std::size_t i : {4u, 7u, 10u}) {
    const double x = planes.x[i], next = planes.x[i + 1];
    const double low = on_lattice(round(x)), high = on_lattice(round(next));
    const double from = on_lattice(foot.x + x), to = on_lattice(foot.x + next);
    tell(numbered("round ramp", static_cast<int>(i)), Kind::top, {(from + to) / 2, (low + high) / 2, foot.z + 1.25},
         unit_of({low - high, to - from, 0}), kRamp);
  }
  tell_top("round ramp's top", sum(foot, {kRadius + 0.25, on_lattice(lip), 1.25}), kRamp);
}

void TownPieces::add_fountain(Point at) {
  constexpr int kSides = 24;
  const Planes planes = {evenly(0, kTurn, kSides), {-0.5, 0.25, 0.625}, {1.5, 1.875}, true};
  mesh_.use(kTower);
  mesh_.add_cells(
      planes, [](int, int, int) { return true; },
      [&](Point p) {
        const SinCos<double> angle = sin_cos(p.x);
        return sum(at, {p.z * angle.sin, p.y, p.z * angle.cos});
      });
  mesh_.add_column(sum(at, {0, -0.5, 0}), 0.25, 1.5, 12);
  tell_top("fountain", sum(at, {0.75, 0, 0.25}), kStreet);
}

void TownPieces::add_posts() {
  mesh_.use(kBridge);
  for (int n = 0; n < 6; ++n) {
    for (const double side : {-3.5, 3.5}) mesh_.add_column({-25.0 + 10 * n, -0.5, side}, 0.125, 3.5, 8);
  }
}

}  // namespace isostep::scenes
