// isostep lab springs: stiff springs as tables, JSON, and a chart where gnuplot is installed.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "gnuplot.hpp"
#include "progress.hpp"
#include "springs.hpp"
#include "tool/common/files.hpp"
#include "tool/common/tool.hpp"

namespace isostep::tool {
namespace {

using lab::SpringSample;
using lab::SpringSystem;
using lab::SpringVerdict;

const char* verdict_of(const SpringSample& sample) {
  return lab::kSpringVerdictNames[static_cast<int>(sample.verdict)];
}
const char* system_of(const SpringSample& sample) { return lab::kSpringSystemNames[static_cast<int>(sample.system)]; }

/// [particles] What a run takes is about as much.
double work_of(SpringSystem system) { return system == SpringSystem::net ? 64 : 1; }

std::vector<SpringSample> sweep(const std::vector<double>& stiffnesses, int timings) {
  std::vector<SpringSample> samples;
  const std::size_t each = scalar_names().size() * lab::kSpringMethods * stiffnesses.size();
  const double work = work_of(SpringSystem::oscillator) + work_of(SpringSystem::net);
  lab::Progress progress(true, 2 * each, work * static_cast<double>(each));
  for (const SpringSystem system : {SpringSystem::oscillator, SpringSystem::net}) {
    any_scalar([&](auto tag) {
      for (int method = 0; method < lab::kSpringMethods; ++method) {
        for (const double stiffness : stiffnesses) {
          stop_if_interrupted();
          const char* scalar = ScalarTraits<typename decltype(tag)::Type>::kName;
          samples.push_back(lab::measure_springs(system, scalar, method, stiffness, timings));
          progress.done(work_of(system),
                        std::string(system_of(samples.back())) + " " + scalar + " " + lab::spring_method_name(method));
        }
      }
      return false;
    });
  }
  return samples;
}

std::string tsv_of(const std::vector<SpringSample>& samples) {
  std::string text = "system\tscalar\tmethod\tstiffness\tverdict\tenergy\tamplitude\tstep_ns\n";
  for (const SpringSample& s : samples) {
    char line[256];
    std::snprintf(line, sizeof line, "%s\t%s\t%s\t%.6g\t%s\t%.6g\t%.6g\t%.1f\n", system_of(s), s.scalar,
                  lab::spring_method_name(s.method), s.stiffness, verdict_of(s), s.energy, s.amplitude, s.step_ns);
    text += line;
  }
  return text;
}

std::string json_of(const std::vector<SpringSample>& samples) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const SpringSample& s : samples) {
    list.push_back({{"system", system_of(s)},
                    {"scalar", s.scalar},
                    {"method", lab::spring_method_name(s.method)},
                    {"stiffness", s.stiffness},
                    {"verdict", verdict_of(s)},
                    {"energy", s.energy},
                    {"amplitude", s.amplitude},
                    {"step_ns", s.step_ns}});
  }
  return nlohmann::ordered_json{{"experiment", "springs"}, {"samples", list}}.dump(1) + "\n";
}

/// Samples of one system, scalar and method lie together, `count` of them, ascending by stiffness.
void print_table(const std::vector<SpringSample>& samples, std::size_t count) {
  std::printf(
      "Energy after 10 s, of that at the start, against k h^2 / m; behind it the largest amplitude.\n"
      "~ the energy was above 3/2 for a while, x it exploded, by then to so much.\n");
  for (std::size_t block = 0; block < samples.size(); block += count * lab::kSpringMethods) {
    const auto at = [&](int method, std::size_t i) -> const SpringSample& {
      return samples[block + static_cast<std::size_t>(method) * count + i];
    };
    std::printf("\n%s, %s\n%-9s", system_of(at(0, 0)), at(0, 0).scalar, "kh^2/m");
    for (int m = 0; m < lab::kSpringMethods; ++m) std::printf(" %19s", lab::spring_method_name(m));
    std::printf("\n");
    for (std::size_t i = 0; i < count; ++i) {
      std::printf("%-9.3g", at(0, i).stiffness);
      for (int m = 0; m < lab::kSpringMethods; ++m) {
        const SpringSample& s = at(m, i);
        const char mark = s.verdict == SpringVerdict::exploded ? 'x' : s.verdict == SpringVerdict::bounded ? '~' : ' ';
        std::printf(" %c%9.3g %8.3g", mark, s.energy, s.amplitude);
      }
      std::printf("\n");
    }
    std::printf("%-9s", "ns a step");
    for (int m = 0; m < lab::kSpringMethods; ++m) {
      std::vector<double> times;
      for (std::size_t i = 0; i < count; ++i) times.push_back(at(m, i).step_ns);
      std::sort(times.begin(), times.end());
      std::printf(" %19.0f", times[count / 2]);
    }
    std::printf("\n");
  }
}

}  // namespace

int command_lab_springs(const LabSpringsOptions& options) {
  const std::vector<double> stiffnesses = lab::spring_stiffnesses(options.quick);
  if (!options.out.empty()) {
    std::error_code error;
    std::filesystem::create_directories(options.out, error);
    if (error) throw ToolError(exit_status::kOutput, options.out + ": " + error.message());
    expect_writable(options.out + "/springs.tsv");
  }
  const std::vector<SpringSample> samples = sweep(stiffnesses, options.quick ? 1 : 5);
  if (options.json) std::cout << json_of(samples);
  else if (!options.quiet) print_table(samples, stiffnesses.size());
  if (!options.out.empty()) {
    write_file(options.out + "/springs.tsv", tsv_of(samples));
    lab::draw_chart(options.out, "springs");
  }
  return exit_status::kOk;
}

}  // namespace isostep::tool
