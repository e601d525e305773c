// Bodies of sequential.hpp.
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "isostep/dynamics/solvers/contact_follow.hpp"
#include "isostep/dynamics/solvers/contact_respond.hpp"
#include "isostep/dynamics/solvers/sequential.hpp"
#include "isostep/dynamics/solvers/sequential_stages.inl"

namespace isostep {
namespace detail {

template <class S>
ISO_INLINE std::uint32_t depth_of(const ContactGeometry<S>& g, std::uint32_t points, const SolverBodies<S>& bodies) {
  bool deep = false;
  for (std::uint32_t p = 0; p < points; ++p) deep = deep || g.points[p].separation < -kDeepOverlap<S>;
  if (!deep) return kShallow;
  return bodies.moves(g.row_a) && bodies.moves(g.row_b) ? kDeep : kPressed;
}

// [rows] A world with less to do in a pass stays on its thread: waking another costs more than it saves.
inline constexpr std::uint32_t kLeastShared = 512;
// [rows] To prepare a joint costs as much; and the fewest joints of a piece.
inline constexpr std::uint32_t kRowsOfJoint = 32, kLeastJoints = 16;

}  // namespace detail

template <class S>
void Sequential<S>::add_run(const ContactKernels<S>& kernels, std::uint32_t bucket, std::uint32_t first,
                            std::uint32_t count) {
  const auto width = static_cast<std::uint32_t>(kernels.width);
  const std::uint32_t blocks = (count + width - 1) / width;
  const std::uint32_t variant = bucket % kContactVariants, kind = bucket / kContactVariants;
  const std::uint32_t colour = kind / detail::kDepths, depth = kind % detail::kDepths;
  runs_.push_back({&kernels, variant, colour, depth, first, count, block_count_, blocks, memory_bytes_});
  block_count_ += blocks;
  const detail::Variant shape = detail::Variant::of(variant);
  memory_bytes_ += blocks * width * block_bytes<S, 1>(shape.points, shape.rolling);
  memory_bytes_ = (memory_bytes_ + 63) / 64 * 64;
}

template <class S> void Sequential<S>::colour_constraints(const StepContext<S>& context) {
  stages_.clear();  // there are some if the last step came to no end
  pieces_.clear();
  schedule_ = schedule_of_(context);
  gather(context);
  plan_passes(context.runner);
}

/// Gathers bodies. Then contacts are coloured, energies bound and joints prepared side by side.
template <class S> void Sequential<S>::gather(const StepContext<S>& context) {
  bodies_.begin(context, schedule_.rate);
  joints_.begin(context);
  const auto bodies = static_cast<std::uint32_t>(bodies_.count()), joints = static_cast<std::uint32_t>(joints_.size());
  share(context.runner, bodies + detail::kRowsOfJoint * joints);
  body_pieces_ = piece_count(bodies, PassPlan::kLeastPiece, threads_);
  joint_pieces_ = min(piece_count(joints, detail::kLeastJoints, threads_), kMaxPieces - kGroupers);
  any_followed_.assign(body_pieces_, 0);
  add_stage(Work::gather, body_pieces_);
  add_stage(Work::group, kGroupers + joint_pieces_);
  run(context);
}

template <class S> void Sequential<S>::colour_contacts(const StepContext<S>& context) {
  constexpr std::uint32_t kUncolouredBucket = Colouring::kUncoloured * detail::kDepths * kContactVariants;
  impacts_.begin(context, bodies_.rows());
  const std::size_t count = context.contacts.size();
  const SolverBodies<S>& bodies = bodies_.rows();
  colouring_.begin(bodies.mass.size());
  bucket_.resize(count);
  order_.resize(count);
  bucket_ends_.assign(kUncolouredBucket + 1, 0);
  runs_.clear();
  block_count_ = 0;
  memory_bytes_ = 0;
  const auto kind_of = [&](std::size_t i) {
    const std::uint32_t points = context.contacts[i].count;
    const bool rolling = context.geometry[i].material.rolling_resistance > S(0);
    const std::uint32_t variant = points - 1 + (rolling ? std::uint32_t{kMaxContactPoints} : 0u);
    return variant + detail::depth_of(context.geometry[i], points, bodies) * kContactVariants;
  };
  std::uint32_t buckets = 0;  // up to the last that is used
  for (std::size_t i = 0; i < count; ++i) {
    const ContactGeometry<S>& g = context.geometry[i];
    bodies_.meet(g.row_a);
    bodies_.meet(g.row_b);
    const std::uint32_t colour = colouring_.colour(g.row_a, bodies.moves(g.row_a), g.row_b, bodies.moves(g.row_b));
    bucket_[i] = kUncolouredBucket;
    if (colour != Colouring::kUncoloured) {
      bucket_[i] = colour * detail::kDepths * kContactVariants + kind_of(i);
      buckets = max(buckets, bucket_[i] + 1);
    }
    ++bucket_ends_[bucket_[i]];
  }
  std::uint32_t total = 0;
  for (std::uint32_t b = 0; b < buckets; ++b) {
    if (bucket_ends_[b] != 0) add_run(*context.contact_kernels, b, total, bucket_ends_[b]);
    total += bucket_ends_[b];
    bucket_ends_[b] = total - bucket_ends_[b];
  }
  bucket_ends_[kUncolouredBucket] = total;
  for (std::size_t i = 0; i < count; ++i) order_[bucket_ends_[bucket_[i]]++] = static_cast<std::uint32_t>(i);
  // Contacts that found no colour are solved one by one, in canonical order, at every width.
  const ContactKernels<S>& narrow = *contact_kernels<S>(Simd::scalar);
  for (std::uint32_t first = total; first < count;) {
    const std::uint32_t kind = kind_of(order_[first]);
    std::uint32_t end = first + 1;
    while (end < count && kind_of(order_[end]) == kind) ++end;
    add_run(narrow, kUncolouredBucket + kind, first, end - first);
    first = end;
  }
}

/// Lends the threads to what follows if that is enough work, in rows.
template <class S> void Sequential<S>::share(const TaskRunner& runner, std::uint32_t work) {
  runner_ = work < detail::kLeastShared ? TaskRunner{} : runner;
  threads_ = static_cast<std::uint32_t>(max(runner_.threads, std::int32_t{1}));
}

/// Plans the passes. Contacts without a colour are one piece by themselves, however many they are, as their order
/// counts. A body counts as a row: to integrate it costs as much.
template <class S> void Sequential<S>::plan_passes(const TaskRunner& runner) {
  const auto rows_of = [](const Run& run) {
    const detail::Variant shape = detail::Variant::of(run.variant);
    return static_cast<std::uint32_t>(shape.points) + 3u + (shape.rolling ? 2u : 0u);
  };
  const auto bodies = static_cast<std::uint32_t>(bodies_.count());
  std::uint32_t work = bodies;
  for (const Run& run : runs_) work += run.blocks * rows_of(run);
  share(runner, work);
  const bool any = any_followed();
  body_pieces_ = piece_count(bodies, PassPlan::kLeastPiece, threads_);
  any_followed_.assign(body_pieces_, any);
  for (PassPlan& plan : colours_) plan.begin(threads_);
  all_.begin(threads_);
  for (std::uint32_t i = 0; i < runs_.size(); ++i) {
    const Run& run = runs_[i];
    for (std::uint32_t depth = 0; depth <= run.depth; ++depth) {
      PassPlan& plan = colours_[depth];
      if (run.colour == Colouring::kUncoloured) plan.add_alone(i, run.blocks);
      if (run.colour != Colouring::kUncoloured) plan.add(run.colour, i, run.blocks, rows_of(run));
    }
    all_.add(0, i, run.blocks, rows_of(run));
  }
  for (PassPlan& plan : colours_) plan.end();
  all_.end();
}

template <class S> std::size_t Sequential<S>::place_of(const Run& run, std::uint32_t block) const {
  const detail::Variant shape = detail::Variant::of(run.variant);
  const auto width = static_cast<std::size_t>(run.kernels->width);
  return run.offset + block * width * block_bytes<S, 1>(shape.points, shape.rolling);
}

/// Returns the contacts of a slice, whose last block may have unused lanes.
template <class S>
typename Sequential<S>::Contacts Sequential<S>::contacts_of(const Run& run, const PassPlan::Slice& slice) {
  const auto width = static_cast<std::uint32_t>(run.kernels->width);
  const std::uint32_t first = slice.first * width, end = (slice.first + slice.count) * width;
  return {run.first + first, static_cast<std::int32_t>(min(end, run.count) - first)};
}

template <class S> BlockRun<S> Sequential<S>::blocks_of(const PassPlan::Slice& slice) {
  const Run& run = runs_[slice.run];
  return {memory_.data() + place_of(run, slice.first), &block_bodies_[run.first_block + slice.first],
          static_cast<std::int32_t>(slice.count), bodies_.rows().velocity.data(), bodies_.rows().displacement.data()};
}

template <class S> void Sequential<S>::prepare_slice(const StepContext<S>& context, const PassPlan::Slice& slice) {
  const Run& run = runs_[slice.run];
  const detail::Variant shape = detail::Variant::of(run.variant);
  const Contacts part = contacts_of(run, slice);
  const SolverBodies<S>& bodies = bodies_.rows();
  run.kernels->prepare({memory_.data() + place_of(run, slice.first), &block_bodies_[run.first_block + slice.first],
                        part.count, shape.points, shape.rolling, &order_[part.first], context.contacts.data(),
                        context.geometry.data(), bodies.velocity.data(), bodies.mass.data(), schedule_.penetration_bias,
                        detail::kMostPenetrationBias<S>});
}

template <class S> void Sequential<S>::store_slice(const StepContext<S>& context, const PassPlan::Slice& slice) {
  const Run& run = runs_[slice.run];
  const detail::Variant shape = detail::Variant::of(run.variant);
  const Contacts part = contacts_of(run, slice);
  run.kernels->store({memory_.data() + place_of(run, slice.first), part.count, shape.points, shape.rolling,
                      &order_[part.first], context.contacts.data(), context.step_impulses.data()});
}

/// Finds the lanes of carried and responding contacts in their blocks.
template <class S> void Sequential<S>::find_lanes(const StepContext<S>& context) {
  carried_.resize(context.carried.size());
  responding_.resize(context.responses.size());
  if (carried_.empty() && responding_.empty()) return;
  places_.resize(order_.size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) places_[order_[i]] = i;
  for (std::size_t i = 0; i < carried_.size(); ++i) {
    const Lane lane = lane_of(context.carried[i].contact);
    const std::size_t rolling = lane.shape.rolling ? sizeof(RollingRows<S, 1>) * lane.width : 0;
    carried_[i] = {lane.words + rolling, lane.width, lane.shape};
  }
  for (std::size_t i = 0; i < responding_.size(); ++i) responding_[i] = lane_of(context.responses[i].contact);
}
template <class S> typename Sequential<S>::Lane Sequential<S>::lane_of(std::uint32_t contact) {
  const std::uint32_t place = places_[contact];
  std::size_t r = 0;
  while (place >= runs_[r].first + runs_[r].count) ++r;
  const Run& run = runs_[r];
  const auto width = static_cast<std::uint32_t>(run.kernels->width);
  const std::uint32_t at = place - run.first;
  return {memory_.data() + place_of(run, at / width) + (at % width) * sizeof(S), width,
          detail::Variant::of(run.variant)};
}
template <class S> void Sequential<S>::carry(const StepContext<S>& context) {
  for (std::size_t i = 0; i < carried_.size(); ++i) {
    const Lane& lane = carried_[i];
    const Carried<S>& carried = context.carried[i];
    set_surface<S>(lane.words, lane.width, carried.surface(bodies_.rows()));
    if (carried.spins()) set_spin<S>(lane.words, lane.width, carried.spin);
  }
}

/// Calls `act` for each contact of a body that turns too fast. Such bodies are rare: one of them makes it visit all.
template <class S>
template <class Act>
void Sequential<S>::each_followed(const StepContext<S>& context, const Act& act) {
  if (!any_followed()) return;
  for (const Run& run : runs_) {
    const detail::Variant shape = detail::Variant::of(run.variant);
    const auto width = static_cast<std::uint32_t>(run.kernels->width);
    for (std::uint32_t at = 0; at < run.count; ++at) {
      const ContactGeometry<S>& g = context.geometry[order_[run.first + at]];
      const bool of_a = bodies_.is_followed(context, g.row_a), of_b = bodies_.is_followed(context, g.row_b);
      if (!of_a && !of_b) continue;
      unsigned char* words = memory_.data() + place_of(run, at / width) + (at % width) * sizeof(S);
      act(g, of_a, of_b, FollowedContact<S>(words, width, shape.points, shape.rolling));
    }
  }
}
template <class S> void Sequential<S>::forget_impulses(const StepContext<S>& context) {
  if (!schedule_.relaxes) return;
  each_followed(context, [](const ContactGeometry<S>&, bool, bool, const FollowedContact<S>& contact) {
    contact.forget_impulses();
  });
}
template <class S> void Sequential<S>::follow(const StepContext<S>& context) {
  const std::vector<SolverMass<S>>& mass = bodies_.rows().mass;
  each_followed(context, [&](const ContactGeometry<S>& g, bool of_a, bool of_b, const FollowedContact<S>& contact) {
    if (of_a) bodies_.renew_inertia(context, g.row_a);
    if (of_b) bodies_.renew_inertia(context, g.row_b);
    contact.turn_by(mass[g.row_a].kappa, mass[g.row_b].kappa);
  });
  respond(context);
}

/// Makes contacts of other masses use the current inertia, and sets the most that they bear in a sub-step.
template <class S> void Sequential<S>::respond(const StepContext<S>& context) {
  const std::vector<SolverMass<S>>& mass = bodies_.rows().mass;
  most_.resize(responding_.size());
  for (std::size_t i = 0; i < responding_.size(); ++i) {
    const Lane& lane = responding_[i];
    const ContactResponse<S>& response = context.responses[i];
    const ContactGeometry<S>& g = context.geometry[response.contact];
    const SolverMass<S>&a = mass[g.row_a], &b = mass[g.row_b];
    RespondingContact<S>(lane.words, lane.width, lane.shape.points, lane.shape.rolling).respond(response, a, b);
    most_[i] = response.most_impulse(a.mass, b.mass, divide_to<Step<S>>(S(1), S(schedule_.rate)));
  }
}
/// Relieves contacts that give way of what a pass left, in their order.
template <class S> void Sequential<S>::relieve(const StepContext<S>& context) {
  SolverBodies<S>& bodies = bodies_.rows();
  for (std::size_t i = 0; i < responding_.size(); ++i) {
    if (!context.responses[i].is_limited()) continue;
    const Lane& lane = responding_[i];
    const ContactGeometry<S>& g = context.geometry[context.responses[i].contact];
    MotionRow<Velocity<S>> a = bodies.velocity[g.row_a], b = bodies.velocity[g.row_b];
    RespondingContact<S>(lane.words, lane.width, lane.shape.points, lane.shape.rolling).relieve(most_[i], a, b);
    if (bodies.moves(g.row_a)) bodies.velocity[g.row_a] = a;
    if (bodies.moves(g.row_b)) bodies.velocity[g.row_b] = b;
  }
}

}  // namespace isostep
