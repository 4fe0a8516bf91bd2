// SPDX-License-Identifier: BSD-3-Clause
// Writes colours of atoms by their places in the file: no text of the molecule's comes into the scene.
#include "app/reports/pocket_figure.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/color/named_colors.h"

namespace meniscus {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kOfOthers = "#d9d9d9";

/// A rule for --color.
std::string rule_of(const Structure& structure, const Pocket& pocket, std::size_t rank) {
  std::string rule = "index";
  for (const std::uint32_t a : pocket.cavity.atoms) rule += fmt::format(" {}", structure.atoms[a].index);
  return rule + "=" + hex_color(categorical_color(rank));
}

}  // namespace

std::string pocket_figure(const PocketReport& report, const std::string& scene, const std::string& left_out) {
  Json figure = Json::parse(scene);
  const std::vector<Pocket>& pockets = report.pockets.found.pockets;
  Json colors = Json::array({kOfOthers});
  // Of several rules that speak of an atom the last counts.
  for (std::size_t n = pockets.size(); n-- > 0;) colors.push_back(rule_of(report.structure, pockets[n], n));
  Json& molecule = figure["molecule"];
  const bool some_left_out = report.pockets.atom_count < report.structure.atoms.size();
  if (some_left_out) {
    const std::string rest = fmt::format("not ({})", left_out);
    molecule["select"] =
        molecule.contains("select") ? fmt::format("({}) and {}", molecule["select"].get<std::string>(), rest) : rest;
  }
  Json surface{{"representation", "surface"}, {"color", colors}};
  if (figure["objects"].is_array())
    for (const auto& [key, value] : figure["objects"].front().items())
      if (!surface.contains(key)) surface[key] = value;
  figure["objects"] = Json::array({surface});
  if (some_left_out)
    figure["objects"].push_back({{"representation", "sticks"}, {"selection", left_out}, {"color", "element"}});
  figure.erase("mesh");
  return figure.dump(2) + "\n";
}

}  // namespace meniscus
