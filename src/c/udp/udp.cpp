// Sessions across UDP in C: an EnetTransport, and a session by what isostep.h says of it.
// SPDX-License-Identifier: MIT
#include <cstring>
#include <memory>
#include <string_view>

#include "flat_struct.hpp"
#include "include/isostep_udp.h"
#include "live_handles.hpp"
#include "public_session.hpp"
#include "transport/enet_transport.hpp"
#include "transport/pump.hpp"

using isostep::transport::EnetSettings;
using isostep::transport::EnetStatistics;
using isostep::transport::EnetTransport;

struct iso_udp {
  EnetTransport transport;
};

namespace isostep::c {
namespace {

using Ports = LiveHandles<iso_udp>;

/// Nothing is thrown across the interface.
template <class Work> iso_status guarded(const Work& work) {
#if defined(__cpp_exceptions)
  try {
    return work();
  } catch (...) {
    return ISO_NO_MEMORY;
  }
#else
  return work();
#endif
}

template <class F> iso_status call(const iso_udp* udp, F&& function) {
  if (udp == nullptr) return ISO_NULL;
  if (!Ports::has(udp)) return ISO_NOT_ALIVE;
  return guarded([&] { return function(); });
}

iso_udp_settings defaults() {
  const EnetSettings from;
  iso_udp_settings to{};
  to.size = sizeof to;
  to.max_peers = from.max_peers;
  to.max_peers_an_address = from.max_peers_an_address;
  to.events_per_poll = from.events_per_poll;
  to.datagrams_per_peer = from.datagrams_per_peer;
  to.timeout = from.timeout;
  to.unacknowledged_cap = from.unacknowledged_cap;
  return to;
}

void say(std::string_view text, char* problem, std::size_t room) {
  if (problem != nullptr && room > 0) problem[text.copy(problem, room - 1)] = 0;
}

/// `open(settings)` gives a Result<EnetTransport>.
template <class F>
iso_status make(const iso_udp_settings* asked, iso_udp** out, char* problem, std::size_t room, F&& open) {
  say("", problem, room);
  if (out == nullptr) return ISO_NULL;
  *out = nullptr;
  iso_udp_settings from = defaults();
  if (asked != nullptr) {
    if (const iso_status status = take(asked, from); status != ISO_OK) return status;
  }
  const bool ends = std::memchr(from.bind_address, 0, sizeof from.bind_address) != nullptr;
  if (!ends || from.max_peers < 1 || from.max_peers > 0xfff || from.max_peers_an_address > 0xfff) {
    say("settings: max_peers 1 to 4095, max_peers_an_address at most 4095, bind_address at most 71 characters", problem,
        room);
    return ISO_REFUSED;
  }
  EnetSettings settings;
  settings.max_peers = static_cast<PeerId>(from.max_peers);
  settings.max_peers_an_address = static_cast<PeerId>(from.max_peers_an_address);
  settings.bind_address = from.bind_address;
  settings.timeout = from.timeout;
  settings.events_per_poll = from.events_per_poll;
  settings.datagrams_per_peer = from.datagrams_per_peer;
  settings.unacknowledged_cap = static_cast<std::size_t>(from.unacknowledged_cap);
  std::memcpy(settings.key.data(), from.key, settings.key.size());
  Result<EnetTransport> opened = open(settings);
  if (!opened) {
    const Error& error = opened.error();
    say(ShortText<192>(error.place.view()).append(": ").append(error.message.view()).view(), problem, room);
    return ISO_REFUSED;
  }
  auto made = std::make_unique<iso_udp>(iso_udp{std::move(opened.value())});
  Ports::add(made.get());
  *out = made.release();
  return ISO_OK;
}

iso_status status_of(const Result<void>& result) {
  if (result) return ISO_OK;
  return ISO_REFUSED;
}

}  // namespace
}  // namespace isostep::c

using namespace isostep::c;

extern "C" {

iso_status iso_udp_settings_init_sized(iso_udp_settings* settings, size_t size) {
  return start(defaults(), settings, size);
}

iso_status iso_udp_listen(uint16_t port, const iso_udp_settings* settings, iso_udp** out, char* problem, size_t room) {
  return guarded([&] {
    return make(settings, out, problem, room,
                [&](const EnetSettings& its) { return EnetTransport::listen(port, its); });
  });
}

iso_status iso_udp_connect(const char* address, uint16_t port, const iso_udp_settings* settings, iso_udp** out,
                           char* problem, size_t room) {
  if (address == nullptr) return ISO_NULL;
  return guarded([&] {
    return make(settings, out, problem, room,
                [&](const EnetSettings& its) { return EnetTransport::connect(address, port, its); });
  });
}

iso_status iso_udp_destroy(iso_udp* udp) {
  if (udp == nullptr) return ISO_OK;
  if (!Ports::has(udp)) return ISO_NOT_ALIVE;
  Ports::remove(udp);
  delete udp;
  return ISO_OK;
}

iso_status iso_udp_connect_to(iso_udp* udp, const char* address, uint16_t port) {
  if (address == nullptr) return ISO_NULL;
  return call(udp, [&] { return status_of(udp->transport.connect_to(address, port)); });
}
iso_status iso_udp_connect_again(iso_udp* udp) {
  return call(udp, [&] { return status_of(udp->transport.connect_again()); });
}
uint16_t iso_udp_port(const iso_udp* udp) { return udp != nullptr && Ports::has(udp) ? udp->transport.port() : 0; }

iso_status iso_udp_deliver(iso_udp* udp, iso_session* session, uint64_t now) {
  if (session == nullptr) return ISO_NULL;
  return call(udp, [&] {
    PublicSession one{session};
    udp->transport.poll();
    isostep::transport::deliver(udp->transport, one, now);
    return one.status;
  });
}
iso_status iso_udp_dispatch(iso_udp* udp, iso_session* session, uint64_t now) {
  if (session == nullptr) return ISO_NULL;
  return call(udp, [&] {
    PublicSession one{session};
    isostep::transport::dispatch(udp->transport, one, now);
    udp->transport.flush();
    return one.status;
  });
}

iso_status iso_udp_wait(iso_udp* udp, uint64_t longest) {
  return call(udp, [&] {
    udp->transport.wait(longest);
    return ISO_OK;
  });
}

iso_status iso_udp_get_statistics(const iso_udp* udp, iso_udp_statistics* out) {
  return call(udp, [&]() -> iso_status {
    if (const iso_status status = can_give(out); status != ISO_OK) return status;
    const EnetStatistics& from = udp->transport.statistics();
    iso_udp_statistics to{};
#define ISO_COPY(name) to.name = from.name;
    ISO_COPY(packets_sent)
    ISO_COPY(bytes_sent)
    ISO_COPY(packets_received)
    ISO_COPY(bytes_received)
    ISO_COPY(implausible)
    ISO_COPY(refused) ISO_COPY(flooded) ISO_COPY(socket_errors)
#undef ISO_COPY
        give(to, out);
    return ISO_OK;
  });
}
}
