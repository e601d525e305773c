// The build of a MeshTree.
// SPDX-License-Identifier: MIT
#include "isostep/geometry/baked/mesh_tree.hpp"

#include <algorithm>
#include <utility>

#include "isostep/core/stable_sort.hpp"

namespace isostep {
namespace {

struct Bounds {
  std::int32_t low[3] = {INT32_MAX, INT32_MAX, INT32_MAX}, high[3] = {INT32_MIN, INT32_MIN, INT32_MIN};

  void add(const Bounds& other) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], other.low[axis]);
      high[axis] = std::max(high[axis], other.high[axis]);
    }
  }
};

struct Item {
  Bounds box;
  std::uint32_t triangle;

  /// The doubled centre of the box.
  std::int32_t centre(int axis) const { return box.low[axis] + box.high[axis]; }
};

struct CentreKey {
  int axis;
  ISO_INLINE std::uint64_t operator()(const Item& item) const {
    return static_cast<std::uint64_t>(item.centre(axis) + 2 * MeshPoint::kLimit);
  }
};

struct Range {
  std::uint32_t first, count;
};

static_assert(MeshTree::capacity(MeshTree::kLevels) >= MeshTree::kMaxTriangles);
static_assert(MeshTree::kMaxTriangles <= MeshNode::kFirstMask);

constexpr int kBins = 16;
/// The triangles of two levels of full nodes. Bins cost more than they save up to so many, and full nodes save memory.
constexpr std::uint32_t kFew = static_cast<std::uint32_t>(MeshTree::capacity(2));

struct Bin {
  Bounds box;
  std::uint32_t count = 0;

  void add(const Bin& other) {
    box.add(other.box);
    count += other.count;
  }
};

/// The centres of a range, cut into slices of equal width.
struct Slices {
  int axis;
  std::int32_t start;
  std::uint64_t scale;  // 2^-32 slices a step

  int operator()(const Item& item) const {
    return static_cast<int>(static_cast<std::uint64_t>(item.centre(axis) - start) * scale >> 32);
  }
};

/// A cut of a range: triangles of slices 0 to `last` are the first part.
struct Cut {
  Slices slices;
  int last;
  std::uint64_t cost;
};

}  // namespace

class MeshTreeBuilder {
 public:
  explicit MeshTreeBuilder(std::span<const MeshBox> boxes) : items_(boxes.size()), scratch_(boxes.size()) {
    Bounds all;
    for (std::uint32_t i = 0; i < items_.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) {
        items_[i].box.low[axis] = static_cast<std::int32_t>(boxes[i].low[axis]);
        items_[i].box.high[axis] = static_cast<std::int32_t>(boxes[i].high[axis]);
      }
      items_[i].triangle = i;
      all.add(items_[i].box);
    }
    for (int axis = 0; axis < 3; ++axis) {
      tree_.bounds_.low[axis] = all.low[axis];
      tree_.bounds_.high[axis] = all.high[axis];
      while (tree_.cell(axis, all.high[axis]) > 0x7fffu) ++tree_.shift_[axis];
      while ((tree_.bounds_.high[axis] - tree_.bounds_.low[axis]) >> area_shift_ >= 1 << 19) ++area_shift_;
    }
  }

  MeshTree run(int levels) {
    tree_.nodes_.reserve(items_.size() / 8 + 1);
    add_node({0, static_cast<std::uint32_t>(items_.size())}, levels);
    tree_.order_.reserve(items_.size());
    for (const Item& item : items_) tree_.order_.push_back(item.triangle);
    tree_.nodes_.shrink_to_fit();
    return std::move(tree_);
  }

 private:
  struct Child {
    std::uint32_t reference;
    Bounds bounds;
  };

  /// Adds the node of a range. It has at most capacity(levels) triangles, so recursion ends at level 1.
  Child add_node(Range range, int levels) {
    const auto index = static_cast<std::uint32_t>(tree_.nodes_.size());
    tree_.nodes_.push_back({{}, {}, {MeshNode::kNoChild, MeshNode::kNoChild, MeshNode::kNoChild, MeshNode::kNoChild}});
    Range parts[4];
    const int count = divide(range, levels, parts);
    Child whole = {index, {}};
    for (int i = 0; i < 4; ++i) {
      if (i >= count) {
        set_lane(tree_.nodes_[index], i, {0x7fff, 0x7fff, 0x7fff}, {0, 0, 0});  // touches no box but the widest
        continue;
      }
      const bool is_leaf = parts[i].count <= MeshTree::kLeafTriangles;
      const Child child = is_leaf ? leaf_of(parts[i]) : add_node(parts[i], levels - 1);
      set_child(tree_.nodes_[index], i, child);
      whole.bounds.add(child.bounds);
    }
    return whole;
  }

  Child leaf_of(Range range) const {
    return {MeshNode::kLeaf | range.count << MeshNode::kCountShift | range.first, bounds_of(range)};
  }
  Bounds bounds_of(Range range) const {
    Bounds bounds;
    for (const Item& item : items_of(range)) bounds.add(item.box);
    return bounds;
  }
  std::span<const Item> items_of(Range range) const { return {items_.data() + range.first, range.count}; }

  void set_child(MeshNode& node, int lane, const Child& child) const {
    std::uint64_t low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = tree_.cell(axis, child.bounds.low[axis]);
      high[axis] = tree_.cell(axis, child.bounds.high[axis]);
    }
    set_lane(node, lane, low, high);
    node.children[lane] = child.reference;
  }
  static void set_lane(MeshNode& node, int lane, const std::uint64_t (&low)[3], const std::uint64_t (&high)[3]) {
    for (int axis = 0; axis < 3; ++axis) {
      node.low[axis] |= low[axis] << (16 * lane);
      node.high[axis] |= high[axis] << (16 * lane);
    }
  }

  /// Splits the part with the most triangles until there are four, or none is larger than it need be. Each has at most
  /// capacity(levels - 1) triangles: a range that has no more is split freely, others are halved twice.
  int divide(Range range, int levels, Range (&parts)[4]) {
    const bool is_free = range.count > kFew && range.count <= MeshTree::capacity(levels - 1);
    const std::uint32_t grain = grain_of(range.count);
    int count = 1;
    parts[0] = range;
    while (count < 4) {
      int most = 0;
      for (int i = 1; i < count; ++i) {
        if (parts[i].count > parts[most].count) most = i;
      }
      if (parts[most].count <= grain) break;
      const std::uint32_t left = split(parts[most], is_free, grain);
      for (int i = count; i > most + 1; --i) parts[i] = parts[i - 1];
      parts[most + 1] = {parts[most].first + left, parts[most].count - left};
      parts[most].count = left;
      ++count;
    }
    return count;
  }
  /// The number of which the halves of a range are a multiple, but for its last: a full leaf or node where triangles
  /// are few.
  static std::uint32_t grain_of(std::uint32_t count) {
    const bool is_few = MeshTree::capacity(1) < count && count <= kFew;
    return is_few ? static_cast<std::uint32_t>(MeshTree::capacity(1)) : MeshTree::kLeafTriangles;
  }

  /// Orders the range and returns the size of its first part.
  std::uint32_t split(Range range, bool is_free, std::uint32_t grain) {
    Bounds centres;
    for (const Item& item : items_of(range)) centres.add(centre_of(item));
    const Cut cut = is_free ? best_cut(range, centres) : Cut{{}, 0, UINT64_MAX};
    return cut.cost == UINT64_MAX ? halve(range, longest_axis(centres), grain) : partition(range, cut);
  }

  static Bounds centre_of(const Item& item) {
    Bounds centre;
    for (int axis = 0; axis < 3; ++axis) centre.low[axis] = centre.high[axis] = item.centre(axis);
    return centre;
  }
  static int longest_axis(const Bounds& bounds) {
    int longest = 0;
    for (int axis = 1; axis < 3; ++axis) {
      if (bounds.high[axis] - bounds.low[axis] > bounds.high[longest] - bounds.low[longest]) longest = axis;
    }
    return longest;
  }

  std::uint32_t halve(Range range, int axis, std::uint32_t grain) {
    stable_sort(items_.data() + range.first, scratch_.data(), range.count, CentreKey{axis});
    return ((range.count + 1) / 2 + grain - 1) / grain * grain;
  }

  Cut best_cut(Range range, const Bounds& centres) {
    Cut best = {{}, 0, UINT64_MAX};
    Bin bins[3][kBins] = {};
    Slices slices[3];
    for (int axis = 0; axis < 3; ++axis) {
      const auto width = static_cast<std::uint64_t>(centres.high[axis] - centres.low[axis]) + 1;
      slices[axis] = {axis, centres.low[axis], (std::uint64_t{kBins} << 32) / width};
    }
    for (const Item& item : items_of(range)) {
      for (int axis = 0; axis < 3; ++axis) {
        Bin& bin = bins[axis][slices[axis](item)];
        bin.box.add(item.box);
        ++bin.count;
      }
    }
    for (int axis = 0; axis < 3; ++axis) {
      const Cut cut = best_cut_of(bins[axis], slices[axis]);
      if (cut.cost < best.cost) best = cut;
    }
    return best;
  }
  Cut best_cut_of(const Bin (&bins)[kBins], const Slices& slices) const {
    std::uint64_t above[kBins];
    Bin upper;
    for (int i = kBins - 1; i > 0; --i) {
      upper.add(bins[i]);
      above[i] = cost_of(upper);
    }
    Cut best = {slices, 0, UINT64_MAX};
    Bin lower;
    for (int i = 0; i + 1 < kBins; ++i) {
      lower.add(bins[i]);
      const bool parts = lower.count != 0 && above[i + 1] != 0;
      if (!parts || cost_of(lower) + above[i + 1] >= best.cost) continue;
      best.last = i;
      best.cost = cost_of(lower) + above[i + 1];
    }
    return best;
  }
  /// The cost of a bin: half the surface times the triangles, below 2^(1.6 + 2 * 19 + 22), of two parts 2^62.6.
  std::uint64_t cost_of(const Bin& bin) const {
    if (bin.count == 0) return 0;
    std::uint64_t d[3];
    for (int axis = 0; axis < 3; ++axis) {
      d[axis] = (static_cast<std::uint64_t>(bin.box.high[axis] - bin.box.low[axis]) >> area_shift_) + 1;
    }
    return (d[0] * d[1] + d[1] * d[2] + d[2] * d[0]) * bin.count;
  }

  std::uint32_t partition(Range range, const Cut& cut) {
    Item* const items = items_.data() + range.first;
    std::uint32_t left = 0, right = 0;
    for (std::uint32_t i = 0; i < range.count; ++i) {
      if (cut.slices(items[i]) <= cut.last) items[left++] = items[i];
      else scratch_[right++] = items[i];
    }
    for (std::uint32_t i = 0; i < right; ++i) items[left + i] = scratch_[i];
    return left;
  }

  std::vector<Item> items_, scratch_;
  MeshTree tree_;
  int area_shift_ = 0;  // extents lose so many bits before they are multiplied
};

MeshTree MeshTree::build(std::span<const MeshBox> boxes, int levels) { return MeshTreeBuilder(boxes).run(levels); }

void MeshTree::rename(std::span<const std::uint32_t> ids) {
  for (std::uint32_t& triangle : order_) triangle = ids[triangle];
}

std::size_t MeshTree::memory() const {
  return sizeof(*this) + nodes_.size() * sizeof(MeshNode) + order_.size() * sizeof(std::uint32_t);
}

}  // namespace isostep
