// The page, filled in.
// SPDX-License-Identifier: MIT
#include "page.hpp"

#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "assets.hpp"

namespace isostep::tool::page {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kPointRoom = 2'000'000;  // [bytes] of all runs' contact points
constexpr const char* kTypeNames[] = {"static", "kinematic", "dynamic"};

/// The number to the fifth digit: what is drawn needs no more.
double short_of(float x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", double{x});
  return std::strtod(text, nullptr);
}
template <std::size_t N> Json list(const std::array<float, N>& v) {
  Json json = Json::array();
  for (const float x : v) json.push_back(short_of(x));
  return json;
}

/// `places`: of the run's surfaces in the page; kNone: without triangles.
using Places = std::vector<std::uint32_t>;

Json json_of(const Part& part, const Places& places) {
  if (part.surface != Surfaces::kNone && places[part.surface] != Surfaces::kNone) {
    return {{"type", kShapeNames[static_cast<std::size_t>(part.type)]},
            {"surface", places[part.surface]},
            {"at", list(part.at)},
            {"turn", list(part.turn)}};
  }
  return {{"type", kShapeNames[static_cast<std::size_t>(part.type)]},
          {"half", list(part.half)},
          {"radius", short_of(part.radius)},
          {"at", list(part.at)},
          {"turn", list(part.turn)},
          {"outward", list(part.outward)}};
}
Json json_of(const Actor& actor, const Places& places) {
  const char* const type = actor.wheel ? "wheel" : kTypeNames[static_cast<std::size_t>(actor.type)];
  Json json = {{"id", actor.slot}, {"type", type}};
  if (actor.generation != 0) json["generation"] = actor.generation;
  if (actor.sensor) json["sensor"] = true;
  if (actor.parts.empty()) json["radius"] = short_of(actor.radius);
  else json["parts"] = Json::array();
  for (const Part& part : actor.parts) json["parts"].push_back(json_of(part, places));
  return json;
}
Json json_of(const Bond& bond) {
  return {{"kind", bond.kind},       {"a", bond.a},         {"b", bond.b},      {"at_a", list(bond.at_a)},
          {"at_b", list(bond.at_b)}, {"first", bond.first}, {"last", bond.last}};
}
/// One number stands alone.
Json json_of(const Effect& effect) {
  Json json = {{"kind", effect.kind}, {"actor", effect.actor}, {"first", effect.first}, {"last", effect.last}};
  for (const auto& [name, numbers] : effect.numbers) {
    if (numbers.size() == 1) json[name] = numbers[0];
    else json[name] = numbers;
  }
  return json;
}
Json json_of(const Scenery& scenery) {
  return {{"plane", scenery.plane},
          {"outward", list(scenery.outward)},
          {"from", list(scenery.from)},
          {"to", list(scenery.to)},
          {"radius", short_of(scenery.radius)}};
}

template <class T, class... More> Json list_of(const std::vector<T>& all, const More&... more) {
  Json json = Json::array();
  for (const T& one : all) json.push_back(json_of(one, more...));
  return json;
}

Json json_of(const Recording& run, const Packed& packed, Surfaces& surfaces) {
  Places places;
  for (const Surface& surface : run.surfaces.all())
    places.push_back(surface.triangles.empty() ? Surfaces::kNone : surfaces.merge(surface));
  return {{"scalar", run.scalar},
          {"solver", run.solver},
          {"hz", run.hz},
          {"substeps", run.substeps},
          {"particles", run.particles},
          {"grid", kGrid},
          {"frames", run.frames.size()},
          {"points_low", list(packed.points_low)},
          {"points_size", list(packed.points_size)},
          {"points_every", packed.points_every},
          {"actors", list_of(run.actors, places)},
          {"bonds", list_of(run.bonds)},
          {"strongest", packed.strongest},
          {"effects", list_of(run.effects)},
          {"scenery", list_of(run.scenery)}};
}

Json json_of(const Film& film) {
  Json json = {{"tolerance", film.tolerance}, {"frame", film.divergence.frame}};
  if (film.divergence.frame != Divergence::kNever) {
    json["id"] = film.divergence.slot;
    json["generation"] = film.divergence.generation;
    json["distance"] = film.divergence.distance;
  }
  json["apart"] = Json::array();
  for (const double apart : film.divergence.apart) json["apart"].push_back(short_of(static_cast<float>(apart)));
  return json;
}

/// The text for inside an element: no '<' that a browser could take for a tag's.
std::string harmless(const std::string& text, const char* less) {
  std::string out;
  for (const char c : text) {
    if (c == '<') out += less;
    else out += c;
  }
  return out;
}

/// The template with every {{name}} that is in the list replaced; what is put in is not looked at again.
std::string filled(std::string_view text, const std::vector<std::pair<std::string_view, std::string_view>>& values) {
  std::string out;
  while (!text.empty()) {
    const std::size_t open = text.find("{{");
    out += text.substr(0, open);
    if (open == std::string_view::npos) break;
    const std::size_t close = text.find("}}", open);
    const std::string_view name = text.substr(open + 2, close - open - 2);
    for (const auto& [key, value] : values) {
      if (key == name) out += value;
    }
    text.remove_prefix(close + 2);
  }
  return out;
}

}  // namespace

bool available() { return !assets::kThree.empty(); }
std::string how_to_get() {
  const std::string build(assets::kBuildDir);
  return "this build has no three.js, which npm brings: install npm, then run `cmake " + build + " && cmake --build " +
         build + "`";
}

std::string page_of(const Film& film) {
  const bool two = !film.beside.frames.empty();
  const std::size_t room = two ? kPointRoom / 2 : kPointRoom;
  const Packed packed = pack(film.run, room);
  Json json = {{"scene", film.scene}, {"every", film.every}, {"runs", Json::array()}};
  Surfaces surfaces;  // of both runs
  json["runs"].push_back(json_of(film.run, packed, surfaces));
  std::string beside;
  if (two) {
    const Packed packed_beside = pack(film.beside, room);
    json["runs"].push_back(json_of(film.beside, packed_beside, surfaces));
    json["divergence"] = json_of(film);
    beside = base64(packed_beside.bytes);
  }
  return filled(assets::kPage, {{"title", harmless(film.scene, "&lt;")},
                                {"style", assets::kStyle},
                                {"three", assets::kThree},
                                {"script", assets::kScript},
                                {"film", harmless(json.dump(), "\\u003c")},
                                {"surfaces", base64(pack(surfaces))},
                                {"run", base64(packed.bytes)},
                                {"beside", beside}});
}

}  // namespace isostep::tool::page
