// SPDX-License-Identifier: BSD-3-Clause
// Plots series over the frames of a run as curves: a plain SVG, one panel below the other.
#pragma once

#include <string>
#include <vector>

namespace meniscus {

/// A curve in a panel of its own.
struct PlotPanel {
  std::string title;           ///< a word of this program with its unit, never text of a file
  std::vector<double> values;  ///< one per SeriesPlot::x
};

struct SeriesPlot {
  std::string x_title;
  std::vector<double> x;  ///< in any order, at least one
  std::vector<PlotPanel> panels;
};

/// Returns the plot as SVG 1.1 that consists only of lines and text; it ends with a line feed. Ticks are at 1, 2 or 5
/// times a power of ten; curves fill their panels.
std::string plot_svg(const SeriesPlot& plot);

}  // namespace meniscus
