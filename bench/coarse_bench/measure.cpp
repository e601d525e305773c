// Times and memory of coarse structures.
// SPDX-License-Identifier: MIT
#include "coarse_bench/measure.hpp"

#include <stdexcept>

#include "isostep/core/scalars.hpp"
#include "isostep/store/chosen_broad_phase.hpp"
#include "scene_bench/clock.hpp"
#include "scene_bench/text.hpp"

namespace isostep::bench {
namespace {

constexpr int kQuestions = 400;

template <class S> struct Ways {
  std::vector<Aabb<S>> boxes;
  std::vector<Sweep<S>> rays;
};
/// Questions start where boxes are, so that fields of every size are asked where there is something.
template <class S> Ways<S> ways_in(const std::vector<Aabb<S>>& boxes) {
  Ways<S> ways;
  Pcg32 random = Pcg32::seeded(5);
  for (int i = 0; i < kQuestions; ++i) {
    const Vec3<S> at = boxes[random_below(random, static_cast<std::uint32_t>(boxes.size()))].low;
    ways.boxes.push_back({at - Vec3<S>{S(1), S(1), S(1)}, at + Vec3<S>{S(1), S(1), S(1)}});
    const std::int32_t x = random_between(random, -20, 20), y = random_between(random, -2, 2);
    const Vec3<S> way = {S(x), S(y), S(random_between(random, -20, 20))};
    ways.rays.push_back({at, way, Vec3<S>::zero(), Unit<S>(1)});
  }
  return ways;
}

template <class S, class Structure> class Measured {
 public:
  Measured(const Field& field, const std::vector<Aabb<S>>& boxes, int rounds) : boxes_(boxes), rounds_(rounds) {
    row_.field = field.name;
    row_.scalar = ScalarTraits<S>::kName;
    row_.count = field.count;
  }
  CoarseRow run() {
    const std::size_t before = bytes_in_use();
    insert_all();
    row_.bytes = static_cast<double>(bytes_in_use() - before) / row_.count;
    const double boxes = 1e6 / row_.count, questions = 1e6 / kQuestions;
    row_.build = boxes * median_milliseconds(
                             rounds_, [&] { structure_.clear(); }, [&] { insert_all(); });
    row_.update = boxes * median_milliseconds(
                              rounds_, [&] { move_all(); }, [&] { update_all(); });
    row_.find = boxes * median_milliseconds(
                            rounds_, [] {}, [&] { all_pairs(structure_, pairs_); });
    row_.pairs = pairs_.keys.size();
    const Ways<S> ways = ways_in(boxes_);
    row_.query = questions * median_milliseconds(
                                 rounds_, [] {}, [&] { ask_boxes(ways); });
    row_.ray = questions * median_milliseconds(
                               rounds_, [] {}, [&] { ask_rays(ways); });
    return row_;
  }
  /// The count keeps the compiler from leaving questions out.
  std::uint64_t found() const { return found_; }

 private:
  void insert_all() {
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) structure_.insert(i, boxes_[i]);
    structure_.optimise();
  }
  /// Moves all boxes there and back again, each in its own direction.
  void move_all() {
    way_ = -way_;
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
      const S step = (boxes_[i].high.x - boxes_[i].low.x) * S(0.125) * way_;
      const Vec3<S> by = {i % 3 == 0 ? step : S(0), i % 3 == 1 ? step : S(0), i % 3 == 2 ? step : S(0)};
      boxes_[i] = {boxes_[i].low + by, boxes_[i].high + by};
    }
  }
  void update_all() {
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) structure_.update(i, boxes_[i]);
    structure_.optimise();
  }
  void ask_boxes(const Ways<S>& ways) {
    for (const Aabb<S>& box : ways.boxes) {
      structure_.query(box, [&](std::uint32_t slot) {
        found_ += slot;
        return true;
      });
    }
  }
  void ask_rays(const Ways<S>& ways) {
    for (const Sweep<S>& ray : ways.rays) {
      structure_.sweep(ray, [&](std::uint32_t slot, Unit<S> most) {
        found_ += slot;
        return most * Unit<S>(0.5);  // a hit halfway to where it could be
      });
    }
  }

  std::vector<Aabb<S>> boxes_;
  int rounds_;
  Structure structure_;
  AllPairs<S> pairs_;
  CoarseRow row_;
  S way_ = S(1);
  std::uint64_t found_ = 0;
};

template <class S> void measure_field(const Field& field, int rounds, std::vector<CoarseRow>& rows) {
  const std::vector<Aabb<S>> boxes = boxes_of<S>(field, 7);
  const std::size_t first = rows.size();
  const auto add = [&](const char* name, auto measured) {
    rows.push_back(measured.run());
    rows.back().structure = name;
    if (measured.found() == 0) throw std::runtime_error("no question found a box");
    if (rows.back().pairs != rows[first].pairs)
      throw std::runtime_error(print("%s finds %zu pairs, %s %zu", name, rows.back().pairs,
                                     rows[first].structure.c_str(), rows[first].pairs));
  };
#define ISO_ADD(name, Structure) add(#name, Measured<S, Structure<S>>(field, boxes, rounds));
  ISO_FOR_EACH_BUILT_BROAD_PHASE(ISO_ADD)
#undef ISO_ADD
}

}  // namespace

std::vector<CoarseRow> measure_coarse(int count, int rounds) {
  std::vector<CoarseRow> rows;
  for (const Field& field : fields_of(count)) {
    measure_field<float>(field, rounds, rows);
    measure_field<Q32_32>(field, rounds, rows);
  }
  return rows;
}

}  // namespace isostep::bench
