// SPDX-License-Identifier: BSD-3-Clause
// Finds the pockets of molecules, writes them as tables and JSON, gives hints, and colours the atoms around pockets.
#include "app/reports/pocket_report.h"

#include <iterator>
#include <set>

#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace meniscus {
namespace {

SurfaceRequest with_probe(SurfaceRequest computing, double probe_radius) {
  computing.kind = SurfaceKind::ses;
  computing.probe_radius = probe_radius;
  computing.planes = ClipPlanes::listed;  // planes cut out the parts
  return computing;
}

void renumber(std::vector<std::uint32_t>& atoms, const std::vector<std::uint32_t>& number) {
  for (std::uint32_t& a : atoms)
    if (a != kNone) a = number[a];
}

std::vector<LeftOutResidue> residues_of(const Structure& structure, const std::vector<bool>& left_out,
                                        const Pockets& found) {
  const PocketLocator pocket_of(found);
  std::vector<LeftOutResidue> residues;
  for (std::uint32_t a = 0; a < left_out.size(); ++a) {
    if (!left_out[a]) continue;
    const Atom& atom = structure.atoms[a];
    if (residues.empty() || structure.atoms[residues.back().first_atom].residue != atom.residue)
      residues.push_back({a, 0, std::vector<std::size_t>(found.pockets.size(), 0)});
    ++residues.back().atoms;
    if (const auto pocket = pocket_of(atom.position)) ++residues.back().in_pocket[*pocket];
  }
  return residues;
}

}  // namespace

PocketComputer::PocketComputer(SurfaceRequest computing, const PocketRequest& request)
    : request_(request),
      small_(with_probe(computing, request.probe_radius)),
      large_(with_probe(computing, request.large_probe_radius)) {}

MoleculePockets PocketComputer::compute(const Structure& structure, const std::vector<bool>& left_out) {
  std::vector<Ball> balls;
  std::vector<std::uint32_t> number;
  for (std::uint32_t a = 0; a < structure.atoms.size(); ++a) {
    if (!left_out.empty() && left_out[a]) continue;
    balls.push_back({structure.atoms[a].position, structure.atoms[a].radius});
    number.push_back(a);
  }
  if (balls.empty()) throw RequestError("{}: no atoms are left to form pockets", structure.file);
  MoleculePockets result;
  result.atom_count = balls.size();
  result.found = find_pockets(balls, request_, [this](std::span<const Ball> atoms, double probe_radius) {
    return (probe_radius == request_.large_probe_radius ? large_ : small_).compute(atoms);
  });
  for (Pocket& pocket : result.found.pockets) {
    renumber(pocket.cavity.atoms, number);
    renumber(pocket.atom, number);
  }
  result.left_out = residues_of(structure, left_out, result.found);
  return result;
}

namespace {

using Json = nlohmann::ordered_json;

/// The version, raised when a key changes its meaning or is removed, but not for new keys.
constexpr int kPocketSchemaVersion = 1;

std::string left_out_name(const PocketReport& report, const LeftOutResidue& residue) {
  return residues_of(report.structure, {residue.first_atom});
}

std::string in_pocket(const PocketReport& report, std::size_t n) {
  std::string text;
  for (const LeftOutResidue& residue : report.pockets.left_out)
    if (2 * residue.in_pocket[n] >= residue.atoms) text += (text.empty() ? "" : " ") + left_out_name(report, residue);
  return text;
}

Json pocket_object(const PocketReport& report, std::size_t n) {
  const Pocket& pocket = report.pockets.found.pockets[n];
  Json atoms = Json::array();
  for (const std::uint32_t a : pocket.cavity.atoms) atoms.push_back(report.structure.atoms[a].index);
  const glm::dvec3 middle = pocket.cavity.middle();
  return {{"rank", n + 1},
          {"kind", pocket.kind()},
          {"volume", pocket.cavity.volume},
          {"volume_excess_at_most", report.pockets.found.volume_excess(pocket)},
          {"area", pocket.cavity.area},
          {"wall_area", pocket.wall_area()},
          {"mouth_areas", pocket.mouth_areas},
          {"depth", pocket.depth},
          {"middle", {middle.x, middle.y, middle.z}},
          {"atoms", atoms},
          {"residues", residues_of(report.structure, pocket.cavity.atoms)}};
}

Json report_object(const PocketReport& report) {
  const Pockets& found = report.pockets.found;
  const PocketRequest& request = found.request;
  Json pockets = Json::array(), left_out = Json::array();
  for (std::size_t n = 0; n < found.pockets.size(); ++n) pockets.push_back(pocket_object(report, n));
  for (const LeftOutResidue& residue : report.pockets.left_out) {
    Json places = Json::array();
    for (std::size_t n = 0; n < residue.in_pocket.size(); ++n)
      if (residue.in_pocket[n] > 0) places.push_back({{"rank", n + 1}, {"atoms", residue.in_pocket[n]}});
    left_out.push_back({{"name", left_out_name(report, residue)}, {"atoms", residue.atoms}, {"pockets", places}});
  }
  Json excluded = Json::object();
  for (const auto& [reason, count] : report.structure.report.excluded) excluded[reason] = count;
  return {{"schema_version", kPocketSchemaVersion},
          {"atoms",
           {{"read", report.structure.report.read},
            {"excluded", excluded},
            {"left_out", report.structure.atoms.size() - report.pockets.atom_count},
            {"used", report.pockets.atom_count}}},
          {"probe_radius", request.probe_radius},
          {"large_probe_radius", request.large_probe_radius},
          {"trim", request.trim},
          {"min_volume", request.min_volume},
          {"mouth_tolerance", request.tolerance},
          {"radii_set", report.structure.radii_set},
          {"volume_between", found.between_volume},
          {"probes_in_mouths", found.probe_count},
          {"pockets", pockets},
          {"left_out", left_out},
          {"device", report.device}};
}

std::string mouth_list(const Pocket& pocket) {
  std::string text;
  for (const double area : pocket.mouth_areas) text += fmt::format("{}{:.6f}", text.empty() ? "" : ";", area);
  return text;
}

constexpr const char* kPocketColumns =
    "rank,kind,volume,excess,area,wall_area,mouth_area,mouths,mouth_areas,depth,x,y,z,atoms,residues,left_out";

std::string pocket_cells(const PocketReport& report, std::size_t n) {
  const Pocket& pocket = report.pockets.found.pockets[n];
  const glm::dvec3 middle = pocket.cavity.middle();
  return fmt::format("{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6f},{},{},{:.6f},{:.3f},{:.3f},{:.3f},{},{},{}", n + 1,
                     pocket.kind(), pocket.cavity.volume, report.pockets.found.volume_excess(pocket),
                     pocket.cavity.area, pocket.wall_area(), pocket.mouth_area(), pocket.mouth_areas.size(),
                     mouth_list(pocket), pocket.depth, middle.x, middle.y, middle.z, pocket.cavity.atoms.size(),
                     csv_cell(residues_of(report.structure, pocket.cavity.atoms)), csv_cell(in_pocket(report, n)));
}

/// Returns the first few of some words, in a line for people.
std::string first_of(const std::string& words) {
  constexpr std::size_t kWidth = 48;
  if (words.size() <= kWidth) return words;
  return words.substr(0, words.rfind(' ', kWidth)) + " ...";
}

double total_volume(const PocketReport& report) {
  double sum = 0.0;
  for (const Pocket& pocket : report.pockets.found.pockets) sum += pocket.cavity.volume;
  return sum;
}

}  // namespace

std::string pocket_table(const PocketReport& report) {
  const Pockets& found = report.pockets.found;
  const PocketRequest& request = found.request;
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "molecule      {} ({})\n", escaped(report.structure.file), report.structure.format);
  fmt::format_to(out, "atoms         {}", report.structure.report.sentence());
  if (const std::size_t taken_out = report.structure.atoms.size() - report.pockets.atom_count; taken_out > 0)
    fmt::format_to(out, "; {} of them taken out as ligands", with_thousands(taken_out));
  fmt::format_to(out, "\npockets       space for a {} Å probe, at least {} Å below the surface of a {} Å probe\n",
                 request.probe_radius, request.trim, request.large_probe_radius);
  fmt::format_to(out,
                 "between       {:.3f} Å³ between the solids of both probes; {:.3f} in {} pockets of {} Å³ or more\n",
                 found.between_volume, total_volume(report), found.pockets.size(), request.min_volume);
  fmt::format_to(out, "mouths        closed by {} large probes, at most {} Å too far out\ndevice        {}\n",
                 with_thousands(found.probe_count), request.tolerance, report.device);
  fmt::format_to(out, "\n{:>5}  {:<7} {:>13} {:>11} {:>11} {:>7} {:>11} {:>9} {:>6}  {}\n", "rank", "kind", "volume Å³",
                 "less up to", "wall Å²", "mouths", "mouth Å²", "depth Å", "atoms", "residues");
  for (std::size_t n = 0; n < found.pockets.size(); ++n) {
    const Pocket& pocket = found.pockets[n];
    fmt::format_to(out, "{:>5}  {:<7} {:>12.3f} {:>11.3f} {:>10.3f} {:>7} {:>10.3f} {:>8.3f} {:>6}  {}\n", n + 1,
                   pocket.kind(), pocket.cavity.volume, found.volume_excess(pocket), pocket.wall_area(),
                   pocket.mouth_areas.size(), pocket.mouth_area(), pocket.depth, pocket.cavity.atoms.size(),
                   escaped(first_of(residues_of(report.structure, pocket.cavity.atoms))));
  }
  for (const LeftOutResidue& residue : report.pockets.left_out) {
    std::string places;
    for (std::size_t n = 0; n < residue.in_pocket.size(); ++n)
      if (residue.in_pocket[n] > 0)
        places += places.empty()
                      ? fmt::format("{} of {} atoms in pocket {}", residue.in_pocket[n], residue.atoms, n + 1)
                      : fmt::format(", {} in pocket {}", residue.in_pocket[n], n + 1);
    if (places.empty()) places = fmt::format("none of {} atoms in a pocket", residue.atoms);
    fmt::format_to(out, "{}ligand {}: {}\n", &residue == &report.pockets.left_out.front() ? "\n" : "",
                   escaped(left_out_name(report, residue)), places);
  }
  return text;
}

std::string pocket_json(const PocketReport& report) {
  return report_object(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string pocket_json_line(const PocketReport& report, const FrameNote& note) {
  Json json{{"frame", note.frame}, {"time", note.time ? Json(*note.time) : Json()}};
  json.update(report_object(report));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string pocket_csv_header() { return std::string(kPocketColumns) + "\n"; }

std::string pocket_csv_rows(const PocketReport& report) {
  std::string text;
  for (std::size_t n = 0; n < report.pockets.found.pockets.size(); ++n) text += pocket_cells(report, n) + "\n";
  return text;
}

std::string pocket_series_header() { return fmt::format("{},pocket,event,other,{}\n", kFrameColumns, kPocketColumns); }

std::string pocket_series_rows(const PocketReport& report, const FrameNote& note,
                               const std::vector<CavityStep>& steps) {
  std::string text;
  for (const CavityStep& step : steps) {
    text += fmt::format("{},{},{},{},", frame_cells(note), step.id, event_word(step.event),
                        step.other ? fmt::format("{}", *step.other) : "");
    text += step.cavity == kNone ? ",,0,0,0,0,0,0,,,,,,0,,\n" : pocket_cells(report, step.cavity) + "\n";
  }
  return text;
}

std::string pocket_row_header() {
  return fmt::format("{:>9} {:>12} {:>8} {:>14} {:>16} {:>12}  {}\n", "frame", "time ps", "pockets", "volume Å³",
                     "largest Å³", "its depth Å", "its residues");
}

std::string pocket_row(const PocketReport& report, const FrameNote& note) {
  const std::vector<Pocket>& pockets = report.pockets.found.pockets;
  std::string row =
      fmt::format("{:>9} {:>12} {:>8} {:>13.3f}", note.frame, note.time ? fmt::format("{:.3f}", *note.time) : "-",
                  pockets.size(), total_volume(report));
  if (pockets.empty()) return row + "\n";
  return row + fmt::format(" {:>15.3f} {:>11.3f}  {}\n", pockets.front().cavity.volume, pockets.front().depth,
                           escaped(first_of(residues_of(report.structure, pockets.front().cavity.atoms))));
}

namespace {

std::string unplaced_ligands(const PocketReport& report) {
  std::vector<std::string> names;
  for (const LeftOutResidue& residue : report.pockets.left_out)
    if (std::ranges::none_of(residue.in_pocket, [&](std::size_t atoms) { return 2 * atoms >= residue.atoms; }))
      names.push_back(residues_of(report.structure, {residue.first_atom}));
  if (names.empty()) return {};
  constexpr std::size_t kNamed = 5;
  const std::size_t count = names.size();
  names.resize(std::min(count, kNamed));
  return fmt::format("less than half of {}{} lies in one pocket; a --large-probe above {} Å may reach shallower sites",
                     fmt::join(names, ", "),
                     count > kNamed ? fmt::format(" and {} more ligands", with_thousands(count - kNamed)) : "",
                     report.pockets.found.request.large_probe_radius);
}

/// Returns the names of chains of at most 30 residues next to one at least three times as long, such as bound peptides,
/// that were not left out; in the order of the file.
std::vector<std::string> short_chains(const PocketReport& report) {
  constexpr std::size_t kShort = 30, kTimes = 3;
  std::set<std::uint32_t> taken;
  for (const LeftOutResidue& residue : report.pockets.left_out)
    taken.insert(report.structure.atoms[residue.first_atom].residue);
  std::vector<std::string> order;
  std::map<std::string, std::set<std::uint32_t>> residues;
  for (const Atom& atom : report.structure.atoms) {
    if (atom.kind != AtomClass::polymer || taken.contains(atom.residue)) continue;
    const auto [chain, added] = residues.try_emplace(atom.chain);
    if (added) order.push_back(atom.chain);
    chain->second.insert(atom.residue);
  }
  std::size_t longest = 0;
  for (const auto& [chain, members] : residues) longest = std::max(longest, members.size());
  std::erase_if(order, [&](const std::string& chain) {
    const std::size_t count = residues[chain].size();
    return count > kShort || kTimes * count > longest;
  });
  return order;
}

std::string filling_chains(const PocketReport& report) {
  const std::vector<std::string> chains = short_chains(report);
  if (chains.empty()) return {};
  std::string selection = "ligand";
  for (const std::string& chain : chains) selection += fmt::format(" or chain \"{}\"", chain);
  return fmt::format(
      "short chains stay in the molecule and fill the pockets they are bound in: {}; take them out by "
      "--ligand '{}'",
      fmt::join(chains, ", "), selection);
}

constexpr const char* kOfOthers = "#d9d9d9";

/// Returns a rule for --color.
std::string rule_of(const Structure& structure, const Pocket& pocket, std::size_t rank) {
  std::string rule = "index";
  for (const std::uint32_t a : pocket.cavity.atoms) rule += fmt::format(" {}", structure.atoms[a].index);
  return rule + "=" + hex_color(categorical_color(rank));
}

}  // namespace

std::vector<std::string> pocket_hints(const PocketReport& report) {
  std::vector<std::string> hints;
  for (std::string hint : {unplaced_ligands(report), filling_chains(report)})
    if (!hint.empty()) hints.push_back(std::move(hint));
  return hints;
}

std::string pocket_figure(const PocketReport& report, const std::string& scene, const std::string& left_out) {
  Json figure = Json::parse(scene);
  const std::vector<Pocket>& pockets = report.pockets.found.pockets;
  Json colors = Json::array({kOfOthers});
  // The last of several rules for an atom counts.
  for (std::size_t n = pockets.size(); n-- > 0;) colors.push_back(rule_of(report.structure, pockets[n], n));
  Json& molecule = figure["molecule"];
  const bool some_left_out = report.pockets.atom_count < report.structure.atoms.size();
  if (some_left_out) {
    const std::string rest = fmt::format("not ({})", left_out);
    molecule["select"] =
        molecule.contains("select") ? fmt::format("({}) and {}", molecule["select"].get<std::string>(), rest) : rest;
  } else if (!molecule.contains("select") && std::ranges::any_of(report.structure.atoms, [](const Atom& atom) {
               return atom.kind == AtomClass::ligand;
             })) {
    molecule["select"] = "all";
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
