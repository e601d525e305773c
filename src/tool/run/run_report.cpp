// The figures of a run as text.
// SPDX-License-Identifier: MIT
#include "run_report.hpp"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "isostep/geometry/shape_type.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool {
namespace {

/// The time to the nanosecond: a clock has no more.
double rounded(double milliseconds) {
  return static_cast<double>(static_cast<std::int64_t>(milliseconds * 1e6 + 0.5)) / 1e6;
}

std::string line(const char* format, ...) {
  char text[256];
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return std::string(text) + "\n";
}

nlohmann::ordered_json json_of_times(const StepTimes& ms) {
  return {{"ms_median", rounded(ms.median)},
          {"ms_mean", rounded(ms.mean)},
          {"ms_p99", rounded(ms.p99)},
          {"ms_max", rounded(ms.max)},
          {"ms_median_settled", rounded(ms.median_settled)}};
}
std::string line_of_times(const StepTimes& ms) {
  return line("step          median %.4f ms, mean %.4f, p99 %.4f, max %.4f; median of the second half %.4f", ms.median,
              ms.mean, ms.p99, ms.max, ms.median_settled);
}

nlohmann::ordered_json json_of_trial(const TrialReport& r) {
  const scenes::Trial& trial = *r.trial;
  nlohmann::ordered_json json = {{"number", trial.number}, {"measure", trial.measure}, {"unit", trial.unit},
                                 {"bar", trial.bar},       {"figure", nullptr},        {"survived", nullptr}};
  if (std::isfinite(r.verdict.figure)) json["figure"] = r.verdict.figure;
  if (r.over) json["survived"] = r.verdict.survived;
  return json;
}
std::string line_of_trial(const TrialReport& r) {
  const scenes::Trial& trial = *r.trial;
  const std::string label = std::string("trial ") + trial.number,
                    unit = *trial.unit ? std::string(" ") + trial.unit : "";
  return line("%-13s %s %.3g%s, bar %.3g%s: %s", label.c_str(), trial.measure, r.verdict.figure, unit.c_str(),
              trial.bar, unit.c_str(),
              !r.over              ? "not over"
              : r.verdict.survived ? "survived"
                                   : "failed");
}

nlohmann::ordered_json json_of_blob(const BlobReport& blob) {
  return {{"shape", blob.shape},
          {"id", hex(blob.id.high) + hex(blob.id.low)},
          {"bytes", blob.bytes},
          {"memory", blob.memory},
          {"uses", blob.uses}};
}
std::string lines_of_blobs(const std::vector<BlobReport>& blobs) {
  std::string text;
  for (const char* shape : kShapeNames) {
    std::size_t count = 0, bytes = 0, memory = 0;
    for (const BlobReport& blob : blobs) {
      if (blob.shape != shape) continue;
      ++count;
      bytes += blob.bytes;
      memory += blob.memory;
    }
    if (count > 0)
      text += line("blobs         %zu of type %s: %zu bytes in files, %zu in memory", count, shape, bytes, memory);
  }
  return text;
}

}  // namespace

std::string json_of(const RunReport& r) {
  nlohmann::ordered_json json = {{"scene", r.scene},       {"scalar", r.scalar},   {"solver", r.solver},
                                 {"substeps", r.substeps}, {"threads", r.threads}, {"simd", r.simd},
                                 {"frames", r.frames},     {"hash", hex(r.hash)}};
  if (!r.projection.empty()) json["projection"] = r.projection;
  json.update(json_of_times(r.ms));
  json.update(nlohmann::ordered_json{{"contacts", r.contacts},
                                     {"points", r.points},
                                     {"bodies", r.bodies},
                                     {"awake", r.awake},
                                     {"penetration_max", r.penetration_max},
                                     {"joint_error_max", r.joint_error_max},
                                     {"signorini", r.residuals.signorini},
                                     {"coulomb", r.residuals.coulomb},
                                     {"dissipation", r.residuals.dissipation},
                                     {"energy_start", r.energy_start},
                                     {"energy_end", r.energy_end},
                                     {"asleep_at", nullptr},
                                     {"faults", r.faults}});
  if (r.asleep_at >= 0) json["asleep_at"] = r.asleep_at;
  if (r.trial) json["trial"] = json_of_trial(*r.trial);
  if (r.lost) json["lost"] = *r.lost;
  if (r.through) json["through"] = *r.through;
  for (const BlobReport& blob : r.blobs) json["blobs"].push_back(json_of_blob(blob));
  return json.dump() + "\n";
}

std::string table_of(const RunReport& r) {
  std::string text;
  const std::string solver = r.projection.empty() ? r.solver : r.solver + " " + r.projection;
  text += line("%s in %s, %s (%d sub-steps, %s lanes), %d frames", r.scene.c_str(), r.scalar.c_str(), solver.c_str(),
               r.substeps, r.simd.c_str(), r.frames);
  if (r.threads > 1) text += line("threads       %d; times are real, not of one thread", r.threads);
  text += line("hash          %s", hex(r.hash).c_str());
  text += line_of_times(r.ms);
  text +=
      line("at the end    %u bodies, %u awake, %u contacts with %u points", r.bodies, r.awake, r.contacts, r.points);
  text += line("penetration   %.3f mm worst, %.3f mm mean of pairs closer than 1 cm", 1e3 * r.penetration_max,
               1e3 * r.penetration_mean);
  text += line("joint error   %.4f mm worst over the run", 1e3 * r.joint_error_max);
  text += line("contact laws  Signorini %.2g, Coulomb %.2g, dissipation %.2g m/s off", r.residuals.signorini,
               r.residuals.coulomb, r.residuals.dissipation);
  text += line("energy        %.6g J at the start, %.6g J at the end; unrest %.3g J/kg", r.energy_start, r.energy_end,
               r.unrest);
  text += r.asleep_at < 0 ? line("asleep        no") : line("asleep        at frame %d", r.asleep_at);
  text += line("faults        %llu", static_cast<unsigned long long>(r.faults));
  if (r.lost) text += line("lost          %d", *r.lost);
  if (r.through) text += line("through       %d", *r.through);
  text += lines_of_blobs(r.blobs);
  if (r.trial) text += line_of_trial(*r.trial);
  return text;
}

std::string json_of(const ParticleRunReport& r) {
  nlohmann::ordered_json json = {{"scene", r.scene},           {"scalar", r.scalar},     {"solver", r.solver},
                                 {"integrator", r.integrator}, {"stepping", r.stepping}, {"substeps", r.substeps},
                                 {"threads", r.threads},       {"simd", r.simd},         {"frames", r.frames},
                                 {"hash", hex(r.hash)}};
  json.update(json_of_times(r.ms));
  json.update(nlohmann::ordered_json{{"particles", r.counts.particles},
                                     {"pinned", r.counts.pinned},
                                     {"springs", r.counts.springs},
                                     {"forces", r.counts.forces},
                                     {"links", r.counts.links},
                                     {"colliders", r.counts.colliders},
                                     {"contacts", r.counts.contacts},
                                     {"penetration_max", r.penetration_max},
                                     {"speed_max", r.speed_max},
                                     {"link_error_max", r.link_error_max},
                                     {"energy_start", r.energy_start},
                                     {"energy_end", r.energy_end},
                                     {"unresolved", r.unresolved},
                                     {"faults", r.faults}});
  return json.dump() + "\n";
}

std::string table_of(const ParticleRunReport& r) {
  std::string text;
  text += line("%s in %s, %s, %s, %s steps (%d sub-steps, %s lanes), %d frames", r.scene.c_str(), r.scalar.c_str(),
               r.solver.c_str(), r.integrator.c_str(), r.stepping.c_str(), r.substeps, r.simd.c_str(), r.frames);
  text += line("hash          %s", hex(r.hash).c_str());
  text += line_of_times(r.ms);
  text +=
      line("at the end    %u particles, %u of them pinned, %u contacts, %u springs, %u links, %u forces",
           r.counts.particles, r.counts.pinned, r.counts.contacts, r.counts.springs, r.counts.links, r.counts.forces);
  text += line("penetration   %.3f mm worst", 1e3 * r.penetration_max);
  text += line("link error    %.4f mm worst over the run", 1e3 * r.link_error_max);
  text += line("energy        %.6g J at the start, %.6g J at the end; fastest %.3g m/s", r.energy_start, r.energy_end,
               r.speed_max);
  if (r.unresolved > 0) text += line("unresolved    %llu", static_cast<unsigned long long>(r.unresolved));
  text += line("faults        %llu", static_cast<unsigned long long>(r.faults));
  return text;
}

}  // namespace isostep::tool
