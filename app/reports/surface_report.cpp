// SPDX-License-Identifier: BSD-3-Clause
// Writes the numbers of a surface and of its patches as text and JSON, and lays out axes, ticks and curves of plots.
#include "app/reports/surface_report.h"

#include <iterator>

namespace meniscus {

PatchReport patch_report(const Molecule& molecule, const Selection& selection, double least) {
  const std::vector<bool> selected = patch_atoms(selection, molecule.structure);
  PatchReport report{selection.text(), least, 0.0, 0, {}};
  for (const SurfaceObject& object : molecule.objects) {
    std::vector<bool> chosen;
    for (const std::uint32_t atom : object.atom) chosen.push_back(selected[atom]);
    for (AtomPatch& patch : atom_patches(object.surface, chosen)) {
      report.area += patch.area;
      ++report.count;
      if (patch.area < least) continue;
      for (std::uint32_t& atom : patch.atoms) atom = object.atom[atom];
      report.patches.push_back(std::move(patch));
    }
  }
  std::ranges::stable_sort(report.patches, std::greater<>(), &AtomPatch::area);
  return report;
}

nlohmann::ordered_json patch_json(const PatchReport& report, const Structure& structure) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const AtomPatch& patch : report.patches) {
    std::vector<std::uint32_t> places;
    for (const std::uint32_t atom : patch.atoms) places.push_back(structure.atoms[atom].index);
    list.push_back({{"area", patch.area},
                    {"residues", residues_of(structure, patch.atoms)},
                    {"atoms", places},
                    {"atom_areas", patch.areas}});
  }
  return {{"selection", report.selection},
          {"least_area", report.least},
          {"area", report.area},
          {"count", report.count},
          {"list", list}};
}

std::string patch_table(const PatchReport& report, const Structure& structure) {
  std::string text =
      fmt::format("\n{:>9} {:>14} {:>9}  residues of {}\n", "patch", "area Å²", "atoms", in_quotes(report.selection));
  for (std::size_t n = 0; n < report.patches.size(); ++n) {
    const AtomPatch& patch = report.patches[n];
    text += fmt::format("{:>9} {:>13.3f} {:>9}  {}\n", n + 1, patch.area, patch.atoms.size(),
                        escaped(residues_of(structure, patch.atoms)));
  }
  return text + fmt::format("{:>9} {:>13.3f}            of {} patches; listed are those of at least {} Å²\n", "all",
                            report.area, with_thousands(report.count), report.least);
}

std::string patch_csv_header() { return "patch,area,atoms,residues\n"; }

std::string patch_csv_rows(const PatchReport& report, const Structure& structure, const std::string& prefix) {
  std::string rows;
  for (std::size_t n = 0; n < report.patches.size(); ++n) {
    const AtomPatch& patch = report.patches[n];
    rows += fmt::format("{}{},{:.6f},{},{}\n", prefix, n + 1, patch.area, patch.atoms.size(),
                        csv_cell(residues_of(structure, patch.atoms)));
  }
  return rows;
}

namespace {

using Json = nlohmann::ordered_json;

/// The version, raised when a key changes its meaning or is removed, but not for new keys.
constexpr int kSchemaVersion = 2;

const char* kind_name(ComponentKind kind) { return kind == ComponentKind::outer ? "outer" : "cavity"; }

/// Returns the volume of a component, positive also for a cavity.
double volume_of(const Component& component) {
  return component.kind == ComponentKind::cavity ? -component.volume : component.volume;
}

/// Sums over all copies of all objects.
struct Totals {
  SurfaceCounts counts;
  double area = 0.0, volume = 0.0, cavity_area = 0.0, cavity_volume = 0.0;
  std::size_t cavities = 0;
};

Totals totals_of(const std::vector<SurfaceObject>& objects) {
  Totals sum;
  for (const SurfaceObject& object : objects) {
    const SurfaceCounts counts = object.surface.counts();
    const std::size_t copies = object.copies.size();
    const auto add = [&](std::size_t SurfaceCounts::*count) { sum.counts.*count += counts.*count * copies; };
    for (const auto count :
         {&SurfaceCounts::convex, &SurfaceCounts::toroidal, &SurfaceCounts::concave, &SurfaceCounts::free_edges,
          &SurfaceCounts::spindle, &SurfaceCounts::fixed_probes, &SurfaceCounts::arcs})
      add(count);
    sum.area += object.surface.area * static_cast<double>(copies);
    sum.volume += object.surface.volume * static_cast<double>(copies);
    for (const Component& component : object.surface.components) {
      if (component.kind != ComponentKind::cavity) continue;
      sum.cavities += copies;
      sum.cavity_area += component.area * static_cast<double>(copies);
      sum.cavity_volume += volume_of(component) * static_cast<double>(copies);
    }
  }
  return sum;
}

Json component_list(const std::vector<SurfaceObject>& objects) {
  Json list = Json::array();
  for (std::size_t n = 0; n < objects.size(); ++n)
    for (const Component& component : objects[n].surface.components) {
      list.push_back({{"kind", kind_name(component.kind)},
                      {"area", component.area},
                      {"volume", volume_of(component)},
                      {"signed_volume", component.volume},
                      {"euler", component.euler}});
      if (objects.size() > 1) list.back()["object"] = n;
    }
  return list;
}

/// Returns the area of a chain, the n-th in order, Å².
double area_of(const AreaColumn& column, const AtomGroup& chain, std::size_t n) {
  return column.sums.empty() ? column.total_of(chain) : column.sums[n];
}

/// Returns the list of chains, always, and of objects, if there are several, with the numbers of their own surfaces.
Json group_list(const SurfaceReport& report) {
  Json list = Json::array();
  const Structure& structure = report.molecule.structure;
  const std::vector<AtomGroup> chains = group_atoms(structure, Grouping::chain);
  for (std::size_t n = 0; n < chains.size(); ++n) {
    const AtomGroup& group = chains[n];
    const Atom& first = structure.atoms[group.atoms.front()];
    list.push_back({{"by", "chain"},
                    {"name", group.name},
                    {"model", first.model},
                    {"chain", first.chain},
                    {"atoms", group.atoms.size()}});
    for (const AreaColumn& column : report.columns) list.back()[column.name] = area_of(column, group, n);
  }
  const auto& objects = report.molecule.objects;
  for (std::size_t n = 0; n < objects.size() && objects.size() > 1; ++n) {
    const SurfaceObject& object = objects[n];
    list.push_back({{"by", "object"},
                    {"name", object.name},
                    {"object", n},
                    {"atoms", object.atom.size()},
                    {"copies", object.copies.size()},
                    {"area", object.surface.area},
                    {"volume", object.surface.volume}});
    for (const AreaColumn& column : area_totals({object}, report.options.surface.kind))
      list.back()[column.name] = column.total;
  }
  return list;
}

std::string surface_words(const SurfaceRequest& computing) {
  switch (computing.kind) {
    case SurfaceKind::sas:
      return fmt::format("solvent-accessible, probe {} Å", computing.probe_radius);
    case SurfaceKind::vdw:
      return "van der Waals";
    default:
      return fmt::format("solvent-excluded, probe {} Å", computing.probe_radius);
  }
}

const char* cavity_words(Cavities cavities) {
  constexpr const char* kWords[] = {"", "; cavities dropped", "; cavities only"};
  return kWords[static_cast<std::size_t>(cavities)];
}

std::string object_table(const SurfaceReport& report) {
  std::string text =
      fmt::format("\n{:>9} {:>9} {:>14} {:>16}  {}\n", "object", "atoms", "area Å²", "volume Å³", "name");
  for (std::size_t n = 0; n < report.molecule.objects.size(); ++n) {
    const SurfaceObject& object = report.molecule.objects[n];
    text += fmt::format("{:>9} {:>9} {:>13.3f} {:>15.3f}  {}", n, with_thousands(object.atom.size()),
                        object.surface.area, object.surface.volume, escaped(object.name));
    if (object.copies.size() > 1) text += fmt::format(" ({} copies)", object.copies.size());
    text += "\n";
  }
  return text;
}

std::string component_table(const Surface& surface) {
  std::string text =
      fmt::format("\n{:>9}  {:<7} {:>14} {:>16} {:>6}\n", "component", "kind", "area Å²", "volume Å³", "Euler");
  for (std::size_t c = 0; c < surface.components.size(); ++c) {
    const Component& component = surface.components[c];
    text += fmt::format("{:>9}  {:<7} {:>13.3f} {:>15.3f} {:>6}\n", c, kind_name(component.kind), component.area,
                        volume_of(component), component.euler);
  }
  return text;
}

/// Returns a row of areas for each chain, and their totals if the lines above do not contain them all.
std::string chain_table(const SurfaceReport& report) {
  const std::vector<AtomGroup> chains = group_atoms(report.molecule.structure, Grouping::chain);
  if (chains.size() == 1 && !report.context) return {};
  std::string text = fmt::format("\n{:>9}", "atoms");
  const auto width = [](const AreaColumn& column) { return std::max<std::size_t>(column.name.size(), 11) + 1; };
  for (const AreaColumn& column : report.columns) text += fmt::format(" {:>{}}", column.name, width(column));
  text += "\n";
  std::size_t atoms = 0;
  std::vector<double> sums(report.columns.size(), 0.0);
  const auto add_row = [&](std::size_t count, const std::vector<double>& areas, const std::string& name) {
    text += fmt::format("{:>9}", with_thousands(count));
    for (std::size_t c = 0; c < areas.size(); ++c)
      text += fmt::format(" {:>{}.3f}", areas[c], width(report.columns[c]));
    text += "  " + name + "\n";
  };
  for (std::size_t n = 0; n < chains.size(); ++n) {
    std::vector<double> areas;
    for (const AreaColumn& column : report.columns) areas.push_back(area_of(column, chains[n], n));
    for (std::size_t c = 0; c < areas.size(); ++c) sums[c] += areas[c];
    atoms += chains[n].atoms.size();
    add_row(chains[n].atoms.size(), areas, escaped(chains[n].name));
  }
  if (chains.size() > 1) add_row(atoms, sums, "all");
  return text;
}

Json added_json(const AddedFile& added) {
  Json json{{"file", added.file}, {"model", added.model}, {"atoms", added.atoms}};
  if (!added.fit) return json;
  const RigidMotion& motion = added.fit->motion;
  Json rows = Json::array();
  for (int row = 0; row < 3; ++row)
    rows.push_back(
        {motion.rotation[0][row], motion.rotation[1][row], motion.rotation[2][row], motion.translation[row]});
  json["superposition"] = {{"atoms", added.fit->atoms}, {"rmsd", added.fit->rmsd}, {"matrix", rows}};
  return json;
}

Json report_object(const SurfaceReport& report) {
  const Structure& structure = report.molecule.structure;
  const Totals totals = totals_of(report.molecule.objects);
  const SurfaceCounts& counts = totals.counts;
  Json excluded = Json::object();
  for (const auto& [reason, count] : structure.report.excluded) excluded[reason] = count;
  Json stages = Json::array();
  for (const StageTime& stage : report.molecule.stages)
    stages.push_back({{"name", stage.name}, {"ms", stage.milliseconds}});
  Json json = {{"schema_version", kSchemaVersion},
               {"atoms", {{"read", structure.report.read}, {"excluded", excluded}, {"used", structure.report.used}}},
               {"surface", kind_word(report.options.surface.kind)},
               {"probe_radius", report.options.surface.probe_radius},
               {"radii_set", structure.radii_set},
               {"counts",
                {{"convex", counts.convex},
                 {"toroidal", counts.toroidal},
                 {"concave", counts.concave},
                 {"free_edges", counts.free_edges},
                 {"spindle", counts.spindle},
                 {"fixed_probes", counts.fixed_probes},
                 {"arcs", counts.arcs}}},
               {"area", totals.area},
               {"volume", totals.volume},
               {"cavities", totals.cavities},
               {"cavity_area", totals.cavity_area},
               {"cavity_volume", totals.cavity_volume}};
  for (const auto& [reason, names] : structure.report.residues) json["atoms"]["excluded_residues"][reason] = names;
  for (const AddedFile& added : structure.added) json["added"].push_back(added_json(added));
  for (const AreaColumn& column : report.columns) json[column.name] = column.total;
  if (report.context) json["context"] = {{"selection", report.context->selection}, {"atoms", report.context->atoms}};
  if (report.patches) json["patches"] = patch_json(*report.patches, structure);
  json["components"] = component_list(report.molecule.objects);
  json["groups"] = group_list(report);
  const RadiiChange change = change_of_radii(report.molecule.objects);
  json["certificate"] = {
      {"closed", true}, {"open_atoms", Json::array()}, {"exact_for_radii_within", change.exact_within}};
  if (change.grown_by > 0) json["certificate"]["radii_grown_by"] = change.grown_by;
  json["device"] = report.molecule.device;
  json["stages"] = stages;
  return json;
}

}  // namespace

std::string report_json(const SurfaceReport& report) {
  return report_object(report).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string report_json_line(const SurfaceReport& report, const FrameNote& note) {
  Json json{{"frame", note.frame}, {"time", note.time ? Json(*note.time) : Json()}};
  json.update(report_object(report));
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string report_row_header(const MoleculeRequest& options) {
  return fmt::format("{:>9} {:>12} {:>14} {:>16} {:>10} {}\n", "frame", "time ps", "area Å²", "volume Å³", "components",
                     options.surface.kind == SurfaceKind::ses ? " accessible Å²" : "");
}

std::string report_row(const SurfaceReport& report, const FrameNote& note) {
  const Totals totals = totals_of(report.molecule.objects);
  std::size_t components = 0;
  for (const SurfaceObject& object : report.molecule.objects)
    components += object.surface.components.size() * object.copies.size();
  std::string row =
      fmt::format("{:>9} {:>12} {:>13.3f} {:>15.3f} {:>10}", note.frame,
                  note.time ? fmt::format("{:.3f}", *note.time) : "-", totals.area, totals.volume, components);
  if (report.options.surface.kind == SurfaceKind::ses) row += fmt::format(" {:>14.3f}", report.columns[1].total);
  return row + "\n";
}

std::string report_table(const SurfaceReport& report) {
  const Structure& structure = report.molecule.structure;
  const auto& objects = report.molecule.objects;
  const Totals totals = totals_of(objects);
  const SurfaceCounts& counts = totals.counts;
  const auto n = [](std::size_t count) { return with_thousands(count); };
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "molecule      {} ({})\n", escaped(structure.file), structure.format);
  for (const AddedFile& added : structure.added) fmt::format_to(out, "added         {}\n", escaped(added.sentence()));
  fmt::format_to(out, "atoms         {}\n", structure.report.sentence());
  fmt::format_to(out, "surface       {}{}\n", surface_words(report.options.surface),
                 cavity_words(report.options.division.cavities));
  fmt::format_to(out, "radii         {}\n", structure.radii_set == "file" ? "of the file" : structure.radii_set);
  fmt::format_to(out, "patches       {} convex, {} toroidal ({} spindle, {} free), {} concave\n", n(counts.convex),
                 n(counts.toroidal), n(counts.spindle), n(counts.free_edges), n(counts.concave));
  fmt::format_to(out, "reduced       {} fixed probes, {} arcs\n", n(counts.fixed_probes), n(counts.arcs));
  fmt::format_to(out, "area          {:.3f} Å²\n", totals.area);
  if (report.options.surface.kind == SurfaceKind::ses)
    fmt::format_to(out, "accessible    {:.3f} Å²\n", report.columns[1].total);
  fmt::format_to(out, "volume        {:.3f} Å³\nclosed        yes\n", totals.volume);
  if (const RadiiChange change = change_of_radii(objects); change.exact_within > 0)
    fmt::format_to(out, "ties          exact for radii that differ from these by up to {:.2g} Å\n",
                   change.exact_within);
  if (report.context)
    fmt::format_to(out, "context       {} atoms: {}\n", n(report.context->atoms), escaped(report.context->selection));
  fmt::format_to(out, "device        {}\n", report.molecule.device);
  for (const StageTime& stage : report.timed ? report.molecule.stages : std::vector<StageTime>{})
    fmt::format_to(out, "time          {:>9.2f} ms  {}\n", stage.milliseconds, stage.name);
  text += chain_table(report);
  text += objects.size() > 1 ? object_table(report) : component_table(objects.front().surface);
  return report.patches ? text + patch_table(*report.patches, structure) : text;
}

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
