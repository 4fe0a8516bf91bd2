// SPDX-License-Identifier: BSD-3-Clause
// The comparison must see faults planted in the geometry's text, or it would prove nothing.
#include <cmath>
#include <regex>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/export/povray/exported_scene.h"

namespace meniscus::testing {
namespace {

constexpr int kWidth = 240, kHeight = 180;

// Returns a fault that applies a regular expression to the lines of one primitive ("torus" or "sphere").
Mutation on_lines(const std::string& primitive, const std::string& pattern, const std::string& replacement) {
  return [=](const std::string& text) {
    const std::regex expression(pattern);
    std::istringstream in(text);
    std::string out;
    for (std::string line; std::getline(in, line); out += '\n')
      out += line.rfind(primitive, 0) == 0 ? std::regex_replace(line, expression, replacement) : line;
    return out;
  };
}

BufferDifference with_fault(const NamedBalls& molecule, const Mutation& fault) {
  // One colour keeps all planes but those of the geometry out of the text.
  const ExportedScene scene(molecule, 1);
  const Camera camera = oblique_camera(scene.surface(), Projection::perspective, static_cast<double>(kWidth) / kHeight);
  return scene.difference(camera, kWidth, kHeight, fault);
}

const char* const kLemon = "sphere\\{<[^>]*>,[^ }]* inverse\\}";
// The pattern matches three side planes of a concave patch, then its bisectors, then its box.
const char* const kBisectors = "(clipped_by\\{(?:plane\\{[^}]*\\}){3})(?:plane\\{[^}]*\\})+(box)";

TEST(PovrayFault, NoFaultNoDifference) {
  const BufferDifference d = with_fault(cut_probes(), {});
  EXPECT_EQ(d.position + d.normal + d.kind + d.odd_layers, 0u);
}

TEST(PovrayFault, MissingLemon) {
  EXPECT_GT(with_fault(free_spindle(), on_lines("torus", kLemon, "")).position, 100u);
  EXPECT_GT(with_fault(cut_probes(), on_lines("torus", kLemon, "")).odd_layers, 10u);
}

TEST(PovrayFault, MissingBisectors) {
  EXPECT_GT(with_fault(cut_probes(), on_lines("sphere", kBisectors, "$1$2")).odd_layers, 10u);
}

TEST(PovrayFault, ReflexWedgeAsIntersection) {
  const Mutation fault = on_lines("torus", "union\\{((?:plane\\{[^}]*\\})+)\\}", "$1");
  EXPECT_GT(with_fault(wide_arc(), fault).position, 100u);
}

TEST(PovrayFault, MissingVisibilitySphere) {
  const Mutation fault = on_lines("torus", "clipped_by\\{sphere\\{[^}]*\\}", "clipped_by{");
  EXPECT_GT(with_fault(three_atoms(), fault).position, 100u);
}

TEST(PovrayFault, MissingConvexPlane) {
  const Mutation fault = on_lines("sphere", "clipped_by\\{plane\\{[^}]*\\}\\}", "");
  EXPECT_GT(with_fault(free_torus(), fault).odd_layers, 100u);
}

TEST(PovrayFault, BoxTooSmall) {
  const Mutation fault = [](const std::string& text) {
    const std::regex box("box\\{<([^,]*),([^,]*),([^>]*)>,<([^,]*),([^,]*),([^>]*)>\\}");
    std::string out;
    std::size_t end = 0;
    for (auto m = std::sregex_iterator(text.begin(), text.end(), box); m != std::sregex_iterator(); ++m) {
      out += text.substr(end, static_cast<std::size_t>(m->position()) - end) + "box{<";
      for (int n = 1; n <= 6; ++n)
        out += fmt::format("{}{}", std::stod((*m)[n]) + (n <= 3 ? 0.05 : -0.05), n == 3 ? ">,<" : n == 6 ? ">}" : ",");
      end = static_cast<std::size_t>(m->position() + m->length());
    }
    return out + text.substr(end);
  };
  EXPECT_GT(with_fault(three_atoms(), fault).position, 20u);
}

// The thresholds for proteins are tight enough: one pixel in ten thousand.
TEST(PovrayFault, ThresholdsForProteinsAreTight) {
  const NamedBalls molecule{"ubiquitin", ubiquitin()};
  const std::size_t tolerated = static_cast<std::size_t>(kWidth) * kHeight / 10000;
  EXPECT_GT(with_fault(molecule, on_lines("torus", kLemon, "")).position, tolerated);
  EXPECT_GT(with_fault(molecule, on_lines("sphere", kBisectors, "$1$2")).position, tolerated);
}

}  // namespace
}  // namespace meniscus::testing
