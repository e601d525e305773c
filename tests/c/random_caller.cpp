// Calls every function of isostep.h with random arguments: living, dead and wrong handles, ids of all worlds, structs
// with random members and sizes, damaged bytes. Each call has a known status; one that is refused changes nothing.
// SPDX-License-Identifier: MIT
//
// c_random_caller: ISOSTEP_RANDOM_CALLS calls (100000), seed ISOSTEP_RANDOM_SEED (1). Exits 1 on the first wrong one.

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "random_drawer.hpp"

namespace {

using namespace isostep::test;

struct Call {
  const char* name;
  bool has_status;
  iso_status (*call)(Drawer&);
};
/// The order in which a compiler draws the arguments is of no account: the draws of one do not depend on another's.
const std::vector<Call>& all_calls() {
  static const std::vector<Call> calls = {
#define ISO_P(type, to, is_const, name) static_cast<type>(drawer.pointer(to, is_const, name))
#define ISO_V(type, name) drawer.value<type>(name)
#define ISO_CALL(f, ...) {#f, true, []([[maybe_unused]] Drawer& drawer) { return f(__VA_ARGS__); }},
#define ISO_ASK(f, ...) \
  {#f, false, []([[maybe_unused]] Drawer& drawer) { return (void)f(__VA_ARGS__), iso_status{0}; }},
#include "calls.inl"
  };
  return calls;
}

/// Calls that are drawn more often than others: what makes bodies and what names them.
struct Often {
  std::vector<const Call*> bodies, all;

  Often() {
    for (const Call& call : all_calls()) {
      const std::string name = call.name;
      const auto has = [&](const char* part) { return name.find(part) != std::string::npos; };
      if (has("_body_create") || has("_add_box") || has("_add_sphere") || has("_create_six_axis"))
        bodies.push_back(&call);
      const bool makes = has("_body_create") || has("_add_") || (has("_create_") && !has("blob_") && !has("replay_"));
      if (makes) all.push_back(&call);
    }
  }
  const Call& draw(Dice& dice) const {
    if (dice.one_in(6)) return *bodies[dice.below(bodies.size())];
    return dice.one_in(3) ? *all[dice.below(all.size())] : all_calls()[dice.below(all_calls().size())];
  }
};

/// A recording of forty frames of a world with a body, and the file of a hull.
void keep_files(Drawer& drawer) {
  iso_q32_settings settings;
  iso_q32_settings_init(&settings);
  iso_world* world = nullptr;
  iso_tape* tape = nullptr;
  if (iso_q32_world_create(&settings, &world) != ISO_OK || iso_tape_create(&tape) != ISO_OK) return;
  iso_world_record(world, tape, "drawn");
  iso_q32_box box;
  iso_q32_box_init(&box);
  const std::int64_t one = iso_q32_from_double(1);
  box.half_extents = {one, one, one};
  iso_q32_body_definition definition;
  iso_q32_body_definition_init(&definition);
  definition.type = ISO_BODY_TYPE_DYNAMIC;
  iso_q32_add_box(world, &box, &definition.shape);
  iso_body body = 0;
  iso_q32_body_create(world, &definition, &body);
  for (int i = 0; i < 40; ++i) {
    iso_world_step(world, nullptr);
    iso_tape_end_frame(tape);
  }
  iso_tape_finish(tape);
  const void* bytes = nullptr;
  std::size_t size = 0;
  iso_tape_bytes(tape, &bytes, &size);
  const auto* const first = static_cast<const std::uint8_t*>(bytes);
  for (int i = 0; i < 4; ++i) drawer.keep_for_ever({first, first + size});
  iso_tape_destroy(tape);
  iso_world_destroy(world);
  const iso_q32_vec3 points[] = {{0, 0, 0}, {one, 0, 0}, {0, one, 0}, {0, 0, one}};
  iso_blob* hull = nullptr;
  std::vector<std::uint8_t> file(kRegion);
  size = file.size();
  if (iso_q32_blob_create_hull(points, 4, ISO_BLOB_HOME_CARRIED, &hull) != ISO_OK) return;
  iso_blob_write(hull, file.data(), &size);
  file.resize(size);
  for (int i = 0; i < 4; ++i) drawer.keep_for_ever(file);
  iso_blob_destroy(hull);
}

/// States and logs of a world, and recordings, for calls that read bytes.
void keep_bytes_of(const iso_world* world, Drawer& drawer) {
  std::vector<std::uint8_t> state(kRegion);
  std::size_t size = state.size();
  if (iso_world_write(world, state.data(), &size) == ISO_OK) {
    state.resize(size);
    drawer.keep_bytes(state);
  }
  const void* log = nullptr;
  if (iso_world_log(world, &log, &size) == ISO_OK && size != 0) {
    drawer.keep_bytes({static_cast<const std::uint8_t*>(log), static_cast<const std::uint8_t*>(log) + size});
  }
}

std::uint64_t setting(const char* name, std::uint64_t otherwise) {
  const char* const text = std::getenv(name);
  return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

}  // namespace

int main() {
  const std::uint64_t count = setting("ISOSTEP_RANDOM_CALLS", 100000), seed = setting("ISOSTEP_RANDOM_SEED", 1);
  const Facts facts;
  Drawer drawer(facts, seed);
  const std::vector<Call>& calls = all_calls();
  std::map<std::string, std::uint64_t> succeeded;
  std::map<iso_status, std::uint64_t> statuses;
  int selfchecks = 0;
  const Often often;
  keep_files(drawer);
  for (std::uint64_t i = 0; i < count; ++i) {
    const Call& call = often.draw(drawer.dice());
    const std::string name = call.name;
    if (name == "iso_selfcheck" && ++selfchecks > 1) continue;  // half a second
    drawer.begin(call.name);
    const bool looks = drawer.dice().one_in(4) && drawer.world() != nullptr;
    const std::uint64_t before = looks ? iso_world_hash(drawer.world()) : 0;
    const iso_status status = call.call(drawer);
    if (call.has_status) ++statuses[status];
    if (std::strcmp(iso_status_text(status), "unknown status") == 0) {
      return std::printf("call %llu, %s: status %d\n", static_cast<unsigned long long>(i), call.name, status), 1;
    }
    // Of commands as bytes, what comes before the damage was done; a ragdoll that is taken back has used up ids.
    const bool leaves_traces = name == "iso_world_apply" || name.find("add_ragdoll") != std::string::npos;
    if (status != ISO_OK && looks && !leaves_traces && iso_world_hash(drawer.world()) != before) {
      return std::printf("call %llu, %s: refused, and the world is another: %s\n", static_cast<unsigned long long>(i),
                         call.name, iso_last_error()),
             1;
    }
    if (status == ISO_OK) ++succeeded[name];
    drawer.end(status);
    if (i % 50 == 0 && drawer.world() != nullptr) keep_bytes_of(drawer.world(), drawer);
  }
  std::printf("%llu calls; of %zu functions %zu succeeded at least once\n", static_cast<unsigned long long>(count),
              calls.size(), succeeded.size());
  for (const auto& [status, times] : statuses) {
    std::printf("%9llu %s\n", static_cast<unsigned long long>(times), iso_status_text(status));
  }
  for (const Call& call : calls) {
    if (succeeded.find(call.name) == succeeded.end()) std::printf("never: %s\n", call.name);
  }
  return succeeded.size() * 10 < calls.size() * 8 ? 1 : 0;
}
