// SPDX-License-Identifier: BSD-3-Clause
// Lays out axes, ticks and curves.
#include "app/reports/series_plot.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include <fmt/format.h>

namespace meniscus {
namespace {

constexpr double kPlotWidth = 720, kPanel = 150, kLeft = 84, kRight = 18, kTop = 30, kBelow = 22, kFoot = 26;

/// A range of values and its ticks.
struct PlotAxis {
  double low, high, step;
  int decimals;

  /// `most`: largest number of ticks.
  PlotAxis(const std::vector<double>& values, int most, bool with_margin) {
    const auto [least, greatest] = std::ranges::minmax(values);
    const double size = std::max({greatest - least, 1e-6 * std::abs(greatest), 1e-9});
    const double margin = with_margin || greatest == least ? 0.06 * size : 0.0;
    low = least - margin;
    high = greatest + margin;
    step = std::pow(10.0, std::floor(std::log10((high - low) / most)));
    for (const double factor : {2.0, 2.5, 2.0})
      if ((high - low) / step > most) step *= factor;
    decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  }

  std::vector<double> ticks() const {
    std::vector<double> ticks;
    for (double n = std::ceil(low / step - 1e-9); n * step <= high + 1e-9 * step; n += 1) ticks.push_back(n * step);
    return ticks;
  }
  /// Formats a tick; -0 becomes 0.
  std::string label(double tick) const { return fmt::format("{:.{}f}", tick == 0.0 ? 0.0 : tick, decimals); }
  double part(double value) const { return (value - low) / (high - low); }
};

class PlotWriter {
 public:
  explicit PlotWriter(const SeriesPlot& plot) : plot_(plot), x_(plot.x, 8, false), order_(plot.x.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::ranges::stable_sort(order_, {}, [&](std::size_t n) { return plot.x[n]; });
  }

  std::string write() {
    const double height = static_cast<double>(plot_.panels.size()) * (kTop + kPanel + kBelow) + kFoot;
    fmt::format_to(
        out(),
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
        "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
        kPlotWidth, height);
    double top = kTop;
    for (const PlotPanel& panel : plot_.panels) {
      add(panel, top);
      top += kTop + kPanel + kBelow;
    }
    text(kLeft + inner_width() / 2, height - 8, "middle", plot_.x_title);
    return svg_ + "</svg>\n";
  }

 private:
  std::back_insert_iterator<std::string> out() { return std::back_inserter(svg_); }
  static double inner_width() { return kPlotWidth - kLeft - kRight; }
  double across(double x) const { return kLeft + x_.part(x) * inner_width(); }

  void text(double x, double y, const char* anchor, const std::string& words) {
    fmt::format_to(out(), "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, words);
  }
  void line(double x1, double y1, double x2, double y2, const char* color) {
    fmt::format_to(out(), "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\"/>\n", x1, y1, x2,
                   y2, color);
  }

  void add(const PlotPanel& panel, double top) {
    const PlotAxis y(panel.values, 5, true);
    const double bottom = top + kPanel;
    const auto up = [&](double value) { return bottom - y.part(value) * kPanel; };
    text(kLeft, top - 8, "start", panel.title);
    for (const double tick : x_.ticks()) {
      line(across(tick), top, across(tick), bottom, "#e4e4e4");
      text(across(tick), bottom + 15, "middle", x_.label(tick));
    }
    for (const double tick : y.ticks()) {
      line(kLeft, up(tick), kPlotWidth - kRight, up(tick), "#e4e4e4");
      text(kLeft - 6, up(tick) + 4, "end", y.label(tick));
    }
    fmt::format_to(out(), "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#808080\"/>\n",
                   kLeft, top, inner_width(), kPanel);
    if (order_.size() == 1) {
      fmt::format_to(out(), "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"2.5\" fill=\"#1f4e79\"/>\n",
                     across(plot_.x.front()), up(panel.values.front()));
      return;
    }
    svg_ += "<polyline fill=\"none\" stroke=\"#1f4e79\" stroke-width=\"1.2\" stroke-linejoin=\"round\" points=\"";
    for (const std::size_t n : order_) fmt::format_to(out(), "{:.2f},{:.2f} ", across(plot_.x[n]), up(panel.values[n]));
    svg_.back() = '"';
    svg_ += "/>\n";
  }

  const SeriesPlot& plot_;
  PlotAxis x_;
  std::vector<std::size_t> order_;
  std::string svg_;
};

}  // namespace

std::string plot_svg(const SeriesPlot& plot) { return PlotWriter(plot).write(); }

}  // namespace meniscus
