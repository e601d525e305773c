// Random questions about a world: rays, casts, overlaps, nearest points, by whatever filter; and a world's answers.
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "random/dice.hpp"

namespace isostep::test {

template <class S> struct Questions {
  struct Overlap {
    QueryShape<S> shape;
    Pose<S> pose;
    QueryFilter filter;
  };
  struct Nearest {
    Vec3<S> point;
    S most;  // [m]
    QueryFilter filter;
  };
  std::vector<RayCast<S>> rays;
  std::vector<ShapeCast<S>> casts;
  std::vector<Overlap> overlaps;
  std::vector<Nearest> nearest;
};

/// The counts of what was found at all: equal answers mean little where it is nothing.
struct Found {
  std::size_t rays = 0, casts = 0, overlaps = 0, nearest = 0;  // questions with an answer
  std::size_t several = 0, inside = 0, triangles = 0, refused = 0;
};

/// Questions are of a world's state and a seed alone.
template <class S> class QuestionsOf {
 public:
  static constexpr int kOfEach = 20;  // so many that a batch of them is shared among threads

  QuestionsOf(const World<S>& world, std::uint64_t seed) : world_(world), bodies_(world.bodies()), dice_(seed) {
    for (const BodyId id : bodies_) {
      const std::span<const Child<S>> children = world.view(id).children;
      if (children.size() != 1 || !is_castable(children[0])) continue;
      solids_.push_back(world.state().shape_slots.template id_of<ShapeId>(world.view(id).properties->shape));
    }
  }
  Questions<S> draw() {
    Questions<S> q;
    for (int i = 0; i < kOfEach; ++i) {
      if (i % 4 == 3) {
        q.rays.push_back(draw_plumb());
        continue;
      }
      const Vec3<S> from = vec<S>(place());
      const Vec3<S> drawn = draw_way(from), way = drawn == Vec3<S>::zero() ? vec<S>(0, -1, 0) : drawn;
      q.rays.push_back({from, way, filter()});
    }
    for (int i = 0; i < kOfEach; ++i) {
      const QueryShape<S> asked = shape();
      const Pose<S> pose = {vec<S>(place()), dice_.template orientation<S>()};
      const Vec3<S> way = draw_way(pose.position);
      q.casts.push_back({asked, pose, way, filter()});
    }
    for (int i = 0; i < kOfEach; ++i) {
      const QueryShape<S> asked = shape();
      const Pose<S> pose = {vec<S>(place()), dice_.template orientation<S>()};
      q.overlaps.push_back({asked, pose, filter()});
      const Vec3<S> at = vec<S>(place());
      const S most = num<S>(dice_.in(0, 3));
      q.nearest.push_back({at, most, filter()});
    }
    return q;
  }

 private:
  static bool is_castable(const Child<S>& part) {
    const ShapeType type = part.primitive.type;
    return !is_surface(type) && type != ShapeType::half_space && part.pose.is_identity();
  }
  BodyId body() { return dice_.one_of(bodies_); }
  /// A place in the air, about the ground, or in the middle of a body.
  D3 place() {
    if (dice_.one_in(3)) return real(world_.view(body()).pose.position);
    const D3 p = dice_.point(5);
    return {p.x, dice_.one_in(3) ? 0.1 * p.y - 0.25 : 0.5 * p.y + 2, p.z};
  }
  /// Towards a body and past it, straight down, or any way.
  Vec3<S> draw_way(Vec3<S> from) {
    const std::uint32_t kind = dice_.below(4);
    if (kind == 0) return vec<S>(0, -dice_.in(0.5, 8), 0);
    if (kind == 1) return vec<S>(dice_.arrow(0, 9));
    const D3 to = real(world_.view(body()).pose.position);
    return vec<S>((to - real(from)) * dice_.in(0.5, 1.5));
  }
  /// A ray down on a corner or an edge of the terrain, where several triangles are met at once.
  RayCast<S> draw_plumb() {
    const double x = dice_.below(9), z = dice_.below(9), aside = dice_.one_in(2) ? 0 : dice_.in(0, 1);
    const double height = dice_.in(0.5, 4), depth = dice_.in(0.5, 8);
    const double along_x = dice_.one_in(2) ? aside : 0, along_z = dice_.one_in(2) ? -along_x : aside;
    return {vec<S>(2 * (x + along_x) - 8, height, 2 * (z + along_z) - 8), vec<S>(0, -depth, 0), filter()};
  }
  QueryShape<S> shape() {
    if (!solids_.empty() && dice_.one_in(2)) return dice_.one_of(solids_);
    const D3 half = {dice_.in(0.1, 0.5), dice_.in(0.1, 0.5), dice_.in(0.1, 0.5)};
    switch (dice_.below(5)) {
      case 0: return primitive_of(Sphere<S>{num<S>(half.x)});
      case 1: return primitive_of(Capsule<S>{num<S>(half.x), num<S>(half.y)});
      case 2: return primitive_of(Cylinder<S>{num<S>(half.x), num<S>(half.y)});
      case 3: return primitive_of(Cone<S>{num<S>(half.x), num<S>(half.y)});
      default: return primitive_of(Box<S>{vec<S>(half)});
    }
  }
  QueryFilter filter() {
    QueryFilter f;
    if (dice_.one_in(6)) f.mask = 1u << dice_.below(2);
    f.sensors = dice_.one_in(2);
    if (dice_.one_in(4)) f.ignore = body();
    if (dice_.one_in(4)) f.group = 1 + dice_.below(4);
    f.back_faces = dice_.one_in(3);
    f.start_inside = dice_.one_in(3) ? StartInside::ignore : StartInside::report;
    f.per = static_cast<HitPer>(dice_.below(3));
    return f;
  }

  const World<S>& world_;
  const std::vector<BodyId> bodies_;
  std::vector<ShapeId> solids_;
  Dice dice_;
};
template <class S> Questions<S> draw_questions(const World<S>& world, std::uint64_t seed) {
  return QuestionsOf<S>(world, seed).draw();
}

/// All that a world says to each question, as bits: one row a question, in order.
template <class S> class Answers {
 public:
  Answers(const World<S>& world, const Questions<S>& questions) {
    of_rays(world, questions);
    of_casts(world, questions);
    of_overlaps(world, questions);
    of_nearest(world, questions);
    found.refused = world.fault() == Fault::none ? 0 : 1;
  }
  /// The first question that is answered otherwise; -1: none is.
  int first_difference(const Answers& other) const {
    if (rows_.size() != other.rows_.size()) return 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i] != other.rows_[i]) return static_cast<int>(i);
    }
    return -1;
  }

  Found found;

 private:
  void of_rays(const World<S>& world, const Questions<S>& questions) {
    std::vector<RayCastHit<S>> batch(2 * questions.rays.size());
    world.cast_rays(questions.rays, batch);
    for (std::size_t i = 0; i < questions.rays.size(); ++i) {
      const RayCast<S>& ray = questions.rays[i];
      std::vector<RayCastHit<S>> all;
      world.cast_ray_all(ray.origin, ray.translation, all, ray.filter);
      add_hits(all, world.cast_ray(ray.origin, ray.translation, ray.filter), found.rays);
      add(batch[2 * i]);
      add(batch[2 * i + 1]);
    }
  }
  void of_casts(const World<S>& world, const Questions<S>& questions) {
    std::vector<ShapeCastHit<S>> batch(questions.casts.size());
    world.cast_shapes(questions.casts, batch);
    for (std::size_t i = 0; i < questions.casts.size(); ++i) {
      const ShapeCast<S>& cast = questions.casts[i];
      std::vector<ShapeCastHit<S>> all;
      world.cast_shape_all(cast.shape, cast.pose, cast.translation, all, cast.filter);
      add_hits(all, world.cast_shape(cast.shape, cast.pose, cast.translation, cast.filter), found.casts);
      add(batch[i]);
    }
  }
  void of_overlaps(const World<S>& world, const Questions<S>& questions) {
    for (const auto& asked : questions.overlaps) {
      rows_.emplace_back();
      std::vector<OverlapHit> hits;
      world.overlap_shape(asked.shape, asked.pose, hits, asked.filter);
      for (const OverlapHit& hit : hits) {
        add({hit.body.slot, hit.body.generation, hit.child, hit.triangle, hit.material});
        found.triangles += hit.triangle != 0;
      }
      const auto first = world.overlap_first(asked.shape, asked.pose, asked.filter);
      add({first ? first->body.slot + std::uint64_t{1} : 0});
      found.overlaps += !hits.empty();
    }
  }
  void of_nearest(const World<S>& world, const Questions<S>& questions) {
    for (const auto& asked : questions.nearest) {
      rows_.emplace_back();
      const auto nearest = world.closest_point(asked.point, asked.most, asked.filter);
      if (!nearest) continue;
      ++found.nearest;
      add({nearest->body.slot, nearest->body.generation, bits(nearest->distance)});
      add(nearest->point);
      add(nearest->normal);
    }
  }
  template <class Hit, class First>
  void add_hits(const std::vector<Hit>& all, const First& first, std::size_t& answered) {
    rows_.emplace_back();
    for (const Hit& hit : all) {
      add(hit);
      found.inside += hit.inside;
      found.triangles += hit.triangle != 0;
    }
    add(first.value_or(Hit{}));
    answered += first.has_value();
    found.several += all.size() > 1;
  }
  template <class F> void add(const QueryHit<S, F>& hit) {
    add({hit.body.slot, hit.body.generation, hit.child, hit.triangle, hit.material, hit.inside, bits(hit.fraction)});
    add(hit.point);
    add(hit.normal);
  }
  template <class T> void add(const Vec3<T>& v) { add({bits(v.x), bits(v.y), bits(v.z)}); }
  void add(std::initializer_list<std::uint64_t> numbers) {
    rows_.back().insert(rows_.back().end(), numbers.begin(), numbers.end());
  }
  template <class T> static std::uint64_t bits(T x) { return static_cast<std::uint64_t>(to_bits(x)); }

  std::vector<std::vector<std::uint64_t>> rows_;
};

}  // namespace isostep::test
