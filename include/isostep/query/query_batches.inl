// Bodies of cast_queries.hpp: many rays or casts at once, on the threads that the game lends.
// SPDX-License-Identifier: MIT
#pragma once

#include "isostep/query/cast_queries.hpp"
#include "isostep/query/hit_list.hpp"
#include "isostep/query/query_probes.hpp"

namespace isostep {

/// The pieces of a batch, by index. Each query writes its own hits, and only reads the world.
template <class S> template <class Work> struct CastQueries<S>::Batch {
  const Work& work;
  std::size_t pieces;

  static void run_piece(void* data, std::uint32_t, std::uint32_t piece) {
    const Batch& batch = *static_cast<const Batch*>(data);
    const std::size_t count = batch.work.size();
    for (std::size_t i = count * piece / batch.pieces; i < count * (piece + 1) / batch.pieces; ++i) batch.work.run(i);
  }
};

namespace detail {
/// The fewest queries for which waking threads is worth it.
inline constexpr std::size_t kLeastSharedQueries = 16;

/// The work of a batch. Each query gets hits.size() / asked.size() hits, its nearest. Those left over have no body.
template <class Asked, class Hit, class Fault, class Gather> struct BatchWork {
  std::span<const Asked> asked;
  std::span<Hit> hits;
  const Fault& fault;
  const Gather& gather;

  std::size_t size() const { return asked.size(); }
  void run(std::size_t i) const {
    const std::size_t share = hits.size() / asked.size();
    const std::span<Hit> own = hits.subspan(i * share, share);
    const std::size_t found = fault(i) == isostep::Fault::none ? gather(asked[i], own) : 0;
    for (std::size_t k = found; k < share; ++k) own[k] = Hit{};
  }
};
template <class Asked, class Hit, class Fault, class Gather>
BatchWork(std::span<const Asked>, std::span<Hit>, const Fault&, const Gather&) -> BatchWork<Asked, Hit, Fault, Gather>;
}  // namespace detail

/// The reported fault is that of the first refused query, however many threads there are.
template <class S>
template <class Work>
bool CastQueries<S>::run_batch(const char* name, const Work& work, const TaskRunner& runner) const {
  if (work.size() == 0) return true;
  const bool fits = work.hits.size() >= work.size();
  if (!fits) return faults_.refuse_call(name, {Fault::bad_argument, "", "hits", "room for one hit or more a query"});
  const bool shared = runner.threads > 1 && work.size() >= detail::kLeastSharedQueries;
  Batch<Work> batch = {work, shared ? min(4 * static_cast<std::uint32_t>(runner.threads), kMaxPieces) : 1u};
  const auto pieces = static_cast<std::uint32_t>(batch.pieces);
  if (shared) run_stages(runner, {&pieces, 1}, &Batch<Work>::run_piece, &batch);
  else Batch<Work>::run_piece(&batch, 0, 0);
  for (std::size_t i = 0; i < work.size(); ++i) {
    const FaultReport fault = work.fault(i);
    if (fault != Fault::none) return faults_.refuse_call(name, fault);
  }
  return true;
}

template <class S>
bool CastQueries<S>::cast_rays(std::span<const RayCast<S>> rays, std::span<RayCastHit<S>> hits,
                               const TaskRunner& runner) const {
  const auto fault = [&](std::size_t i) { return fault_of_ray(rays[i].origin, rays[i].translation); };
  const auto gather_one = [&](const RayCast<S>& ray, std::span<RayCastHit<S>> out) {
    detail::NearestHits<S, S> list(out);
    gather(detail::RayProbe<S>(ray.origin, ray.translation, ray.filter), ray.filter, list);
    return list.count();
  };
  return run_batch("cast_rays", detail::BatchWork{rays, hits, fault, gather_one}, runner);
}

template <class S>
bool CastQueries<S>::cast_shapes(std::span<const ShapeCast<S>> casts, std::span<ShapeCastHit<S>> hits,
                                 const TaskRunner& runner) const {
  const auto fault = [&](std::size_t i) { return fault_of_cast(casts[i]); };
  const auto gather_one = [&](const ShapeCast<S>& cast, std::span<ShapeCastHit<S>> out) {
    detail::NearestHits<S, Unit<S>> list(out);
    gather_cast(cast, list);
    return list.count();
  };
  return run_batch("cast_shapes", detail::BatchWork{casts, hits, fault, gather_one}, runner);
}

}  // namespace isostep
