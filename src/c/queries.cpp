// Queries: rays, casts, overlaps, the nearest body, one or many at once.
// SPDX-License-Identifier: MIT
#include "objects.hpp"

using namespace isostep;
using namespace isostep::c;

namespace {

/// A filter and the lists that it refers to.
struct Filtered {
  std::vector<BodyId> bodies;
  QueryFilter filter;

  iso_status take(const char* call, const CQueryFilter& from) {
    if (from.ignore_all_count != 0) ISO_C_REQUIRE(call, from.ignore_all.at);
    if (from.ignore_kinds_count != 0) ISO_C_REQUIRE(call, from.ignore_kinds.at);
    bodies.resize(from.ignore_all_count);
    for (std::size_t i = 0; i < bodies.size(); ++i) bodies[i] = id_of<BodyId>(from.ignore_all.at[i]);
    filter = {from.mask,  from.sensors,    from.ignore,
              from.group, from.back_faces, from.start_inside,
              from.per,   bodies,          {from.ignore_kinds.at, from.ignore_kinds_count}};
    return kOk;
  }
};

template <class S, class Query> QueryShape<S> shape_of(const Query& query) {
  return query.shape ? QueryShape<S>(query.shape) : QueryShape<S>(query.primitive);
}

/// Asks the world: ask(world, query, filter) returns a status.
template <class S, class Query, class Ask>
iso_status ask_world(const iso_world* world, const char* call, const void* from, const Ask& ask) {
  return in_world<S>(world, call, Access::reads, [&](auto& of) {
    Query query;
    Filtered filtered;
    iso_status status = take_sized(call, from, query);
    if (status == kOk) status = filtered.take(call, query.filter);
    return status == kOk ? ask(of.world, query, filtered.filter) : status;
  });
}
/// Finds one thing or none: find(world, query, filter) returns an optional.
template <class S, class Query, class Find>
iso_status find_one(const iso_world* world, const char* call, const void* from, void* out, uint8_t* found,
                    const Find& find) {
  return ask_world<S, Query>(world, call, from, [&](auto& w, const Query& query, const QueryFilter& filter) {
    ISO_C_REQUIRE(call, out);
    ISO_C_REQUIRE(call, found);
    const auto hit = find(w, query, filter);
    *found = hit ? 1 : 0;
    if (hit) put_plain(out, *hit);
    return kOk;
  });
}
/// Finds many: list(world, query, filter, vector) appends them.
template <class S, class Query, class Hit, class List>
iso_status find_all(const iso_world* world, const char* call, const void* from, void* out, std::size_t room,
                    std::size_t* count, const List& list) {
  return ask_world<S, Query>(world, call, from, [&](auto& w, const Query& query, const QueryFilter& filter) {
    std::vector<Hit> hits;
    list(w, query, filter, hits);
    return put_list(call, hits, out, room, count);
  });
}

/// Writes the hits of a batch, `each` of them for every query.
template <class Hit> void put_hits(const std::vector<Hit>& hits, void* out) {
  for (std::size_t i = 0; i < hits.size(); ++i) {
    put_plain(static_cast<std::uint8_t*>(out) + i * extent_of<Hit>().size, hits[i]);
  }
}

/// The most hits of one batch: a larger product of counts is more likely a mistake than memory.
constexpr std::size_t kMostHits = std::size_t{1} << 28;

/// Casts a batch: make(query, filter) is the question to the world; run(world, all, hits) puts it. The structs are as
/// large as the first of them says.
template <class S, class Query, class Cast, class Hit, class Make, class Run>
iso_status cast_many(const iso_world* world, const char* call, const void* from, std::size_t count, void* out,
                     std::size_t each, const Make& make, const Run& run) {
  return in_world<S>(world, call, Access::reads, [&](auto& of) {
    if (count == 0) return kOk;
    ISO_C_REQUIRE(call, from);
    ISO_C_REQUIRE(call, out);
    if (each == 0) return refuse(kMisused, call, "each", "1 or more");
    if (count > kMostHits / each) return refuse(kMisused, call, "count", "2^28 hits at most");
    std::uint32_t stride = 0;
    std::memcpy(&stride, from, sizeof stride);
    std::vector<Filtered> filters(count);
    std::vector<Cast> casts;
    casts.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto* const at = static_cast<const std::uint8_t*>(from) + i * stride;
      Query query;
      iso_status status = take_sized(call, at, query);
      if (status == kOk && std::memcmp(at, &stride, sizeof stride) != 0) {
        status = refuse(ISO_WRONG_SIZE, call, "size", "the same of all");
      }
      if (status == kOk) status = filters[i].take(call, query.filter);
      if (status != kOk) return status;
      casts.push_back(make(query, filters[i].filter));
    }
    std::vector<Hit> hits(count * each);
    const Inside inside(of, WorldObject::kBatch);
    run(of.world, casts, hits);
    put_hits(hits, out);
    return kOk;
  });
}

template <class S>
iso_status cast_rays(const iso_world* world, const void* from, std::size_t count, void* out, std::size_t each) {
  return cast_many<S, CRayCast<S>, RayCast<S>, RayCastHit<S>>(
      world, "cast_rays", from, count, out, each,
      [](const CRayCast<S>& ray, const QueryFilter& filter) {
        return RayCast<S>{ray.origin, ray.translation, filter};
      },
      [](auto& w, const auto& rays, auto& hits) { w.cast_rays(rays, hits); });
}
template <class S>
iso_status cast_shapes(const iso_world* world, const void* from, std::size_t count, void* out, std::size_t each) {
  return cast_many<S, CShapeCast<S>, ShapeCast<S>, ShapeCastHit<S>>(
      world, "cast_shapes", from, count, out, each,
      [](const CShapeCast<S>& cast, const QueryFilter& filter) {
        return ShapeCast<S>{shape_of<S>(cast), cast.pose, cast.translation, filter};
      },
      [](auto& w, const auto& casts, auto& hits) { w.cast_shapes(casts, hits); });
}

template <class S>
iso_status body_contacts(const iso_world* world, iso_body body, void* out, std::size_t room, std::size_t* count) {
  constexpr const char* kCall = "body_get_contacts";
  return in_world<S>(world, kCall, Access::reads, [&](auto& of) {
    if (!of.world.contains(id_of<BodyId>(body))) {
      return refuse({Fault::stale_id, kCall, "body", "a body of this world"});
    }
    std::vector<ContactPoint<S>> points;
    of.world.contacts_of(id_of<BodyId>(body), points);
    return put_list(kCall, points, out, room, count);
  });
}

}  // namespace

#define ISO_QUERIES(P, S)                                                                                              \
  iso_status iso_##P##_cast_ray(const iso_world* world, const iso_##P##_ray_cast* ray, iso_##P##_ray_hit* out,         \
                                uint8_t* found) {                                                                      \
    return find_one<S, CRayCast<S>>(world, "cast_ray", ray, out, found, [](auto& w, const auto& q, const auto& f) {    \
      return w.cast_ray(q.origin, q.translation, f);                                                                   \
    });                                                                                                                \
  }                                                                                                                    \
  iso_status iso_##P##_cast_ray_all(const iso_world* world, const iso_##P##_ray_cast* ray, iso_##P##_ray_hit* out,     \
                                    size_t room, size_t* count) {                                                      \
    return find_all<S, CRayCast<S>, RayCastHit<S>>(                                                                    \
        world, "cast_ray_all", ray, out, room, count,                                                                  \
        [](auto& w, const auto& q, const auto& f, auto& hits) { w.cast_ray_all(q.origin, q.translation, hits, f); });  \
  }                                                                                                                    \
  iso_status iso_##P##_cast_shape(const iso_world* world, const iso_##P##_shape_cast* cast, iso_##P##_shape_hit* out,  \
                                  uint8_t* found) {                                                                    \
    return find_one<S, CShapeCast<S>>(                                                                                 \
        world, "cast_shape", cast, out, found,                                                                         \
        [](auto& w, const auto& q, const auto& f) { return w.cast_shape(shape_of<S>(q), q.pose, q.translation, f); }); \
  }                                                                                                                    \
  iso_status iso_##P##_cast_shape_all(const iso_world* world, const iso_##P##_shape_cast* cast,                        \
                                      iso_##P##_shape_hit* out, size_t room, size_t* count) {                          \
    return find_all<S, CShapeCast<S>, ShapeCastHit<S>>(                                                                \
        world, "cast_shape_all", cast, out, room, count, [](auto& w, const auto& q, const auto& f, auto& hits) {       \
          w.cast_shape_all(shape_of<S>(q), q.pose, q.translation, hits, f);                                            \
        });                                                                                                            \
  }                                                                                                                    \
  iso_status iso_##P##_cast_rays(const iso_world* world, const iso_##P##_ray_cast* rays, size_t count,                 \
                                 iso_##P##_ray_hit* out, size_t each) {                                                \
    return cast_rays<S>(world, rays, count, out, each);                                                                \
  }                                                                                                                    \
  iso_status iso_##P##_cast_shapes(const iso_world* world, const iso_##P##_shape_cast* casts, size_t count,            \
                                   iso_##P##_shape_hit* out, size_t each) {                                            \
    return cast_shapes<S>(world, casts, count, out, each);                                                             \
  }                                                                                                                    \
  iso_status iso_##P##_closest_point(const iso_world* world, const iso_##P##_point_query* query,                       \
                                     iso_##P##_closest_body* out, uint8_t* found) {                                    \
    return find_one<S, CPointQuery<S>>(                                                                                \
        world, "closest_point", query, out, found,                                                                     \
        [](auto& w, const auto& q, const auto& f) { return w.closest_point(q.point, q.max_distance, f); });            \
  }                                                                                                                    \
  iso_status iso_##P##_overlap_first(const iso_world* world, const iso_##P##_overlap_query* query,                     \
                                     iso_overlap_hit* out, uint8_t* found) {                                           \
    return find_one<S, COverlapQuery<S>>(                                                                              \
        world, "overlap_first", query, out, found,                                                                     \
        [](auto& w, const auto& q, const auto& f) { return w.overlap_first(shape_of<S>(q), q.pose, f); });             \
  }                                                                                                                    \
  iso_status iso_##P##_overlap_shape(const iso_world* world, const iso_##P##_overlap_query* query,                     \
                                     iso_overlap_hit* out, size_t room, size_t* count) {                               \
    return find_all<S, COverlapQuery<S>, OverlapHit>(                                                                  \
        world, "overlap_shape", query, out, room, count,                                                               \
        [](auto& w, const auto& q, const auto& f, auto& hits) { w.overlap_shape(shape_of<S>(q), q.pose, hits, f); });  \
  }                                                                                                                    \
  iso_status iso_##P##_overlap_box(const iso_world* world, const iso_##P##_box_query* query, iso_body* out,            \
                                   size_t room, size_t* count) {                                                       \
    return find_all<S, CBoxQuery<S>, BodyId>(                                                                          \
        world, "overlap_box", query, out, room, count,                                                                 \
        [](auto& w, const auto& q, const auto& f, auto& bodies) { w.overlap_aabb(q.box, bodies, f); });                \
  }                                                                                                                    \
  iso_status iso_##P##_body_get_contacts(const iso_world* world, iso_body body, iso_##P##_contact_point* out,          \
                                         size_t room, size_t* count) {                                                 \
    return body_contacts<S>(world, body, out, room, count);                                                            \
  }
ISO_C_FAMILIES(ISO_QUERIES)
