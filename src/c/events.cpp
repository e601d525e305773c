// Events of the last step and poses for drawing, as arrays in C's layout.
// SPDX-License-Identifier: MIT
#include "objects.hpp"

using namespace isostep;
using namespace isostep::c;

namespace {

/// The place of a kind of events in WorldObject::events.
enum class EventKind : std::uint32_t {
  contact_begin,
  contact_end,
  sensor_begin,
  sensor_end,
  broke,
  joint_broke,
  hits,
  contacts,
  fell_asleep,
  woke
};
static_assert(WorldObject::kEventKinds == static_cast<int>(EventKind::woke) + 1);

/// Writes `all` into `words` and points to it.
template <class T, class Out>
iso_status put_array(const char* call, const std::vector<T>& all, std::vector<std::uint64_t>& words, const Out** out,
                     std::size_t* count) {
  constexpr std::size_t kSize = extent_of<T>().size;
  static_assert(kSize == sizeof(Out));
  ISO_C_REQUIRE(call, out);
  ISO_C_REQUIRE(call, count);
  words.resize((all.size() * kSize + 7) / 8);
  auto* const bytes = reinterpret_cast<std::uint8_t*>(words.data());
  for (std::size_t i = 0; i < all.size(); ++i) put_plain(bytes + i * kSize, all[i]);
  *out = reinterpret_cast<const Out*>(words.data());
  *count = all.size();
  return kOk;
}

template <class Out, class ListOf>
iso_status put_events(iso_world* world, const char* call, EventKind kind, const Out** out, std::size_t* count,
                      const ListOf& list_of) {
  return in_any_world(world, call, Access::changes, [&](auto& of) {
    return put_array(call, list_of(of.world.events()), of.events[static_cast<int>(kind)], out, count);
  });
}
template <class S, class Out, class ListOf>
iso_status put_events_of(iso_world* world, const char* call, EventKind kind, const Out** out, std::size_t* count,
                         const ListOf& list_of) {
  return in_world<S>(world, call, Access::changes, [&](auto& of) {
    return put_array(call, list_of(of.world.events()), of.events[static_cast<int>(kind)], out, count);
  });
}

}  // namespace

#define ISO_COMMON_EVENTS(name, Out, member)                                                                           \
  iso_status iso_##name(iso_world* world, const Out** out, size_t* count) {                                            \
    return put_events(                                                                                                 \
        world, #name, EventKind::member, out, count, [](const auto& events) -> const auto& { return events.member; }); \
  }
ISO_COMMON_EVENTS(contact_ends, iso_body_pair, contact_end)
ISO_COMMON_EVENTS(sensor_begins, iso_sensor_event, sensor_begin)
ISO_COMMON_EVENTS(sensor_ends, iso_sensor_event, sensor_end)
ISO_COMMON_EVENTS(fell_asleep, iso_body, fell_asleep)
ISO_COMMON_EVENTS(woke, iso_body, woke)

#define ISO_EVENTS_OF(P, S, name, Out, member)                                                                         \
  iso_status iso_##P##_##name(iso_world* world, const iso_##P##_##Out** out, size_t* count) {                          \
    return put_events_of<S>(                                                                                           \
        world, #name, EventKind::member, out, count, [](const auto& events) -> const auto& { return events.member; }); \
  }
#define ISO_EVENTS(P, S)                                            \
  ISO_EVENTS_OF(P, S, contact_begins, contact_begin, contact_begin) \
  ISO_EVENTS_OF(P, S, broke_events, broke, broke)                   \
  ISO_EVENTS_OF(P, S, joint_broke_events, joint_broke, joint_broke) \
  ISO_EVENTS_OF(P, S, contact_hits, contact_hit, hits)              \
  ISO_EVENTS_OF(P, S, contact_points, contact_point, contacts)
ISO_C_FAMILIES(ISO_EVENTS)

iso_status iso_world_poses(iso_world* world, float alpha, const iso_render_pose** out, size_t* count) {
  constexpr const char* kCall = "world_poses";
  return in_any_world(world, kCall, Access::changes, [&](auto& of) {
    if (!(alpha >= 0 && alpha <= 1)) return refuse(kMisused, kCall, "alpha", "0 to 1");
    return put_array(kCall, of.world.poses_float(alpha), of.poses, out, count);
  });
}
