// The matrix of survival, drawn by hand: it is all text and squares.
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdio>

#include "charts.hpp"
#include "html.hpp"

namespace isostep::tool::lab {
namespace {

// [px]
constexpr int kWide = 27, kHigh = 19, kLeft = 176, kTop = 206, kGap = 8, kMargin = 16;

struct Paint {
  const char* fill;
  const char* ink;
};
/// Colours after Okabe and Ito; signs say the same for those who see no colours.
Paint paint_of(Fate fate) {
  switch (fate) {
    case Fate::survived: return {"#009e73", "#ffffff"};
    case Fate::failed: return {"#d55e00", "#ffffff"};
    case Fate::open: return {"#f0c75e", "#24292f"};
    case Fate::refused: return {"#eaeef2", "#57606a"};
    default: return {"#ffffff", "#57606a"};
  }
}

/// The left edges of columns, with a gap where the scalar changes.
std::vector<int> edges_of(const Matrix& matrix) {
  std::vector<int> edges;
  int x = kLeft;
  for (std::size_t i = 0; i < matrix.columns.size(); ++i) {
    if (i > 0 && matrix.columns[i].scalar != matrix.columns[i - 1].scalar) x += kGap;
    edges.push_back(x);
    x += kWide;
  }
  edges.push_back(x);
  return edges;
}

std::string square(int x, int y, const MatrixCell& cell) {
  const Paint paint = paint_of(cell.fate);
  char text[256];
  std::snprintf(text, sizeof text, "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"%s\"/>\n", x + 1, y + 1,
                kWide - 2, kHigh - 2, paint.fill);
  const std::string style = std::string("text-anchor=\"middle\" font-size=\"11\" fill=\"") + paint.ink + "\"";
  return text + svg_text(x + kWide / 2.0, y + kHigh / 2.0 + 4, sign_of(cell), style);
}

std::string heads_of(const Matrix& matrix, const std::vector<int>& edges) {
  std::string text;
  for (std::size_t i = 0; i < matrix.columns.size(); ++i) {
    const MatrixColumn& column = matrix.columns[i];
    char turn[128];
    const double x = edges[i] + kWide / 2.0 + 4;
    std::snprintf(turn, sizeof turn, "transform=\"rotate(-60 %.1f %d)\" font-size=\"12\" fill=\"#24292f\"", x,
                  kTop - 8);
    text += svg_text(x, kTop - 8, column.is_ours() ? column.solver : column.engine, turn);
    const bool first = i == 0 || matrix.columns[i - 1].scalar != column.scalar;
    if (!first) continue;
    text += svg_text(edges[i] + 34, kTop - 92, column.is_ours() ? column.scalar : "other engines",
                     "font-size=\"13\" font-weight=\"bold\" fill=\"#24292f\"");
  }
  return text;
}

std::string legend() {
  struct Item {
    const char *fill, *ink, *sign, *words;
  };
  constexpr Item kItems[] = {{"#009e73", "#ffffff", "8", "survived, with so many sub-steps"},
                             {"#009e73", "#ffffff", "240", "or with so many steps a second"},
                             {"#009e73", "#ffffff", "✓", "survived, by defaults"},
                             {"#009e73", "#ffffff", "+", "only by its best settings"},
                             {"#d55e00", "#ffffff", "×", "failed with any"},
                             {"#f0c75e", "#24292f", "…", "too long"},
                             {"#eaeef2", "#57606a", "–", "refused"}};
  constexpr int kRow = 22, kEnd = 560;  // [px] from row to row; where one is full
  std::string text;
  int x = kMargin, y = 38;
  for (const Item& item : kItems) {
    if (x > kEnd) {
      x = kMargin;
      y += kRow;
    }
    char box[160];
    std::snprintf(box, sizeof box, "<rect x=\"%d\" y=\"%d\" width=\"%d\" height=\"%d\" fill=\"%s\"/>\n", x, y,
                  kWide - 2, kHigh - 2, item.fill);
    const std::string style = std::string("text-anchor=\"middle\" font-size=\"11\" fill=\"") + item.ink + "\"";
    text += box + svg_text(x + kWide / 2.0 - 1, y + 13, item.sign, style);
    text += svg_text(x + kWide + 3, y + 13, item.words, "font-size=\"12\" fill=\"#57606a\"");
    x += kWide + 24 + static_cast<int>(std::string(item.words).size()) * 7;
  }
  return text;
}

}  // namespace

std::string survival_svg(const Matrix& matrix) {
  const std::vector<int> edges = edges_of(matrix);
  const int width = std::max(edges.back() + 70, 760);
  const int height = kTop + static_cast<int>(matrix.rows.size()) * kHigh + kMargin;
  char head[256];
  std::snprintf(head, sizeof head,
                "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\" height=\"%d\" "
                "font-family=\"sans-serif\">\n<rect width=\"%d\" height=\"%d\" fill=\"#ffffff\"/>\n",
                width, height, width, height, width, height);
  std::string text = head;
  text += svg_text(kMargin, 28, "Who survives where methods fail", "font-size=\"19\" fill=\"#24292f\"");
  text += legend() + heads_of(matrix, edges);
  for (std::size_t r = 0; r < matrix.rows.size(); ++r) {
    const int y = kTop + static_cast<int>(r) * kHigh;
    text += svg_text(kLeft - 8, y + kHigh / 2.0 + 4, matrix.rows[r].trial,
                     "text-anchor=\"end\" font-size=\"12\" fill=\"#24292f\"");
    for (std::size_t i = 0; i < matrix.columns.size(); ++i) {
      text += square(edges[i], y, matrix.rows[r].cells[i]);
    }
  }
  return text + "</svg>\n";
}

}  // namespace isostep::tool::lab
