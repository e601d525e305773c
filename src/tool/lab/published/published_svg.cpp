// The picture of the published tests: marks on logarithmic scales, a line an engine.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <span>

#include "published_page.hpp"
#include "standing.hpp"
#include "tool/lab/articulated_run.hpp"
#include "tool/lab/report/html.hpp"

namespace isostep::tool::lab {
namespace {

using scenes::PublishedTest;

// [px]
constexpr int kLeft = 168, kHead = 72, kTop = 74, kLine = 21, kPanel = 206, kScale = 128, kBottom = 34, kMargin = 16;
constexpr std::size_t kPanelsInBand = 6;
constexpr double kDecades = 6;  // below what we must reach: a smaller error stands at the edge

constexpr const char* kInk = "#24292f";
constexpr const char* kMuted = "#57606a";

std::string line_at(double x1, double y1, double x2, double y2, const char* more) {
  char text[224];
  std::snprintf(text, sizeof text, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>\n", x1, y1, x2, y2,
                more);
  return text;
}

/// The step of a test's panel: the longest for which we promise something.
int rate_of(const PublishedTest& test) { return test.bars.front().hz; }

/// Ours with a world's own settings, an articulation in double, and all others.
std::vector<Standing> drawn_of(const PublishedTest& test, const std::vector<LabResult>& results) {
  std::vector<Standing> all = standings_of(test, rate_of(test), results);
  const auto is_drawn = [](const Standing& s) {
    return !s.ours || (s.is_default && (!s.is_articulation || s.scalar == "double"));
  };
  std::erase_if(all, [&](const Standing& s) { return !is_drawn(s); });
  for (Standing& s : all) {
    if (s.ours) s.engine = "isostep " + (s.is_articulation ? std::string(kArticulation) : s.scalar);
  }
  return all;
}

/// Ours, then peers, then what was published.
std::vector<std::string> engines_of(std::span<const PublishedTest> tests, const std::vector<LabResult>& results) {
  std::vector<std::string> names[3];
  for (const PublishedTest& test : tests) {
    for (const Standing& s : drawn_of(test, results)) {
      std::vector<std::string>& of = names[s.ours ? 0 : s.published ? 2 : 1];
      if (std::find(of.begin(), of.end(), s.engine) == of.end()) of.push_back(s.engine);
    }
  }
  std::vector<std::string> all;
  for (std::vector<std::string>& of : names) {
    std::sort(of.begin(), of.end());
    all.insert(all.end(), of.begin(), of.end());
  }
  return all;
}

/// Errors from left to right: decades, or plain where nothing is the aim.
class Scale {
 public:
  Scale(const PublishedTest& test, const std::vector<Standing>& standings) : plain_(test.bars.front().must == 0) {
    for (const Standing& s : standings) {
      if (s.ended && std::isfinite(s.figure)) most_ = std::max(most_, s.figure);
    }
    if (plain_) return;
    low_ = std::floor(std::log10(test.bars.front().must)) - kDecades;
    high_ = std::max(std::ceil(std::log10(most_)), low_ + kDecades);
  }
  /// From 0 to 1.
  double at(double figure) const {
    if (plain_) return most_ > 0 ? figure / most_ : 0;
    const double decade = figure > 0 ? std::log10(figure) : low_;
    return std::clamp((decade - low_) / (high_ - low_), 0.0, 1.0);
  }
  bool is_beyond(double figure) const { return !plain_ && !(figure > std::pow(10, low_)); }
  std::vector<double> ticks() const {
    if (plain_) return {0, most_ / 2, most_};
    std::vector<double> values;
    const double step = std::ceil((high_ - low_) / 3);
    for (double decade = low_; decade <= high_; decade += step) values.push_back(std::pow(10, decade));
    return values;
  }

 private:
  bool plain_;
  double low_ = 0, high_ = 0;  // decades
  double most_ = 1e-300;
};

std::string tick_text(double value) {
  if (value == 0 || (value >= 0.01 && value < 1e4)) return short_number(value);
  char text[16];
  std::snprintf(text, sizeof text, "1e%d", static_cast<int>(std::lround(std::log10(value))));
  return text;
}

/// What stands in place of a mark where there is no error.
const char* sign_of(const Standing& s) {
  if (s.state == kRefused) return "–";
  return s.state == kLeftOut || s.state == kHung ? "…" : "×";
}
std::string mark_of(const Standing& s, double x, double y) {
  const char* const colour = s.ours ? "#009e73" : s.published ? kMuted : "#d55e00";
  char text[192];
  std::snprintf(text, sizeof text,
                "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4.5\" fill=\"%s\" stroke=\"%s\" stroke-width=\"1.6\"/>\n", x, y,
                s.published ? "#ffffff" : colour, colour);
  return text;
}

/// The words in lines that a panel holds.
std::vector<std::string> lines_of(const std::string& words) {
  constexpr std::size_t kColumns = 32;
  std::vector<std::string> lines(1);
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end = std::min(words.find(' ', at), words.size());
    if (!lines.back().empty() && kColumns < lines.back().size() + 1 + end - at) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + words.substr(at, end - at);
    at = end + 1;
  }
  return lines;
}

std::string panel(const PublishedTest& test, const std::vector<LabResult>& results,
                  const std::vector<std::string>& engines, int left, int top) {
  const std::vector<Standing> standings = drawn_of(test, results);
  const Scale scale(test, standings);
  const double low = top + kLine * static_cast<double>(engines.size());
  const auto x_of = [&](double figure) { return left + kScale * scale.at(figure); };
  std::string text =
      svg_text(left, top - 66, test.trial.number, std::string("font-weight=\"bold\" fill=\"") + kInk + "\"");
  const std::string small = std::string("font-size=\"11\" fill=\"") + kMuted + "\"";
  double line = top - 52;
  for (const std::string& words :
       lines_of(std::string(test.trial.measure) + " [" + test.trial.unit + "], steps of " + step_text(rate_of(test)))) {
    text += svg_text(left, line, words, small);
    line += 13;
  }
  for (const double tick : scale.ticks()) {
    text += line_at(x_of(tick), top - 4, x_of(tick), low, "stroke=\"#d0d7de\" stroke-width=\"1\"");
    text += svg_text(x_of(tick), low + 15, tick_text(tick), small + " text-anchor=\"middle\"");
  }
  const double must = x_of(test.bars.front().must);
  text += line_at(must, top - 4, must, low, "stroke=\"#0072b2\" stroke-width=\"1.4\" stroke-dasharray=\"4 3\"");
  for (std::size_t n = 0; n < engines.size(); ++n) {
    const double y = top + kLine * (static_cast<double>(n) + 0.5);
    const auto s =
        std::find_if(standings.begin(), standings.end(), [&](const Standing& of) { return of.engine == engines[n]; });
    if (s == standings.end()) continue;
    if (!s->ended) {
      text +=
          "<g><title>" + escaped(s->reason) + "</title>" +
          svg_text(left + kScale, y + 4, sign_of(*s), "text-anchor=\"middle\" font-weight=\"bold\" fill=\"#cf222e\"") +
          "</g>\n";
      continue;
    }
    text += "<g><title>" + escaped(s->engine + ": " + short_number(s->figure)) + "</title>" +
            mark_of(*s, x_of(s->figure), y) + "</g>\n";
    if (scale.is_beyond(s->figure)) text += svg_text(left - 11, y + 4, "‹", small);
    if (!s->published)
      text += svg_text(left + kScale + 8, y + 4, short_number(1000 * s->seconds) + " ms",
                       "font-size=\"10\" fill=\"" + std::string(kMuted) + "\"");
  }
  return text;
}

std::string legend() {
  struct Item {
    const char *fill, *ink, *words;
  };
  constexpr Item kItems[] = {{"#009e73", "#009e73", "isostep, its own settings"},
                             {"#d55e00", "#d55e00", "other engines, run here"},
                             {"#ffffff", "#57606a", "as published, with the year"}};
  std::string text;
  double x = kMargin + 6;
  for (const Item& item : kItems) {
    char dot[160];
    std::snprintf(dot, sizeof dot,
                  "<circle cx=\"%.1f\" cy=\"48\" r=\"4.5\" fill=\"%s\" stroke=\"%s\" stroke-width=\"1.6\"/>\n", x,
                  item.fill, item.ink);
    text += dot + svg_text(x + 10, 52, item.words, std::string("font-size=\"12\" fill=\"") + kInk + "\"");
    x += 196;
  }
  text += line_at(x, 48, x + 18, 48, "stroke=\"#0072b2\" stroke-width=\"1.4\" stroke-dasharray=\"4 3\"");
  text += svg_text(x + 24, 52, "bar of this project", std::string("font-size=\"12\" fill=\"") + kInk + "\"");
  text += svg_text(x + 160, 52, "× diverged   … too long   – refused   ‹ below the scale",
                   std::string("font-size=\"12\" fill=\"") + kInk + "\"");
  return text;
}

/// A row of panels with the names of their engines; `top` moves on to the next.
std::string band(std::span<const PublishedTest> tests, const std::vector<LabResult>& results, int width, int& top) {
  const std::vector<std::string> engines = engines_of(tests, results);
  const int first = top + kTop;
  std::string text;
  for (std::size_t n = 0; n < engines.size(); ++n) {
    const double y = first + kLine * (static_cast<double>(n) + 0.5);
    text += line_at(kMargin, y, width - kMargin, y, "stroke=\"#eaeef2\" stroke-width=\"1\"");
    text += svg_text(kLeft - 16, y + 4, engines[n],
                     std::string("text-anchor=\"end\" font-size=\"12\" fill=\"") + kInk + "\"");
  }
  for (std::size_t n = 0; n < tests.size(); ++n) {
    text += panel(tests[n], results, engines, kLeft + kPanel * static_cast<int>(n), first);
  }
  top = first + kLine * static_cast<int>(engines.size()) + kBottom;
  return text;
}

}  // namespace

std::span<const PublishedTest> tests_of_first_source() {
  const std::span<const PublishedTest> all = scenes::published_tests();
  const auto end =
      std::find_if(all.begin(), all.end(), [&](const PublishedTest& test) { return test.year != all.front().year; });
  return all.first(static_cast<std::size_t>(end - all.begin()));
}

std::string published_svg(std::span<const PublishedTest> tests, const std::vector<LabResult>& results) {
  const int width = kLeft + kPanel * static_cast<int>(std::min(kPanelsInBand, tests.size())) + kMargin;
  int height = kHead;
  std::string bands;
  for (std::size_t at = 0; at < tests.size(); at += kPanelsInBand) {
    bands += band(tests.subspan(at, std::min(kPanelsInBand, tests.size() - at)), results, width, height);
  }
  char head[256];
  std::snprintf(
      head, sizeof head,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%d\" height=\"%d\" viewBox=\"0 0 %d %d\" "
      "font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
      width, height, width, height);
  std::string text = head;
  text +=
      svg_text(kMargin, 26,
               "Published tests: error of every engine, left is better; beside it the CPU time of a simulated second",
               std::string("font-size=\"16\" fill=\"") + kInk + "\"");
  return text + legend() + bands + "</svg>\n";
}

}  // namespace isostep::tool::lab
