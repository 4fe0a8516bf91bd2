// SPDX-License-Identifier: BSD-3-Clause
// Reads colour schemes and rules as users write them, and colour maps from text and JSON.
#include "core/color/color_schemes.h"

#include <cmath>
#include <functional>
#include <iterator>
#include <set>

#include <nlohmann/json.hpp>

namespace meniscus {
namespace {

using By = ColorScheme::By;

constexpr ColorSchemeMetadata kSchemes[] = {
    {"auto", By::automatic,
     "chain; rainbow in pastel for a single chain, element-cpk for small molecules; sticks, balls and spheres as "
     "chain-element. The default",
     ""},
    {"element", By::element, "chemical element in pale colours",
     "hues of element-cpk with white, so that carbon is #c8c8c8"},
    {"chain", By::chain, "chains in order of appearance, 30 colours in turn",
     "our own pastel colours, which differ for any colour vision as G. M. Machado et al. simulate it, IEEE Trans. Vis. "
     "Comput. Graph. 15, 1291 (2009)"},
    {"copy", By::copy, "copies of an @assembly@ made of atoms, 21 colours in turn", "colours of Okabe and Ito"},
    {"model", By::model, "models of the file, and each file of @add@, 21 colours in turn", "colours of Okabe and Ito"},
    {"residue", By::residue, "residue type: acidic, basic, polar, aliphatic, aromatic, sulphur, GLY and PRO; each base",
     "grouped by side chain; colours of Okabe and Ito"},
    {"kind", By::kind, "kind of patch: convex, toroidal, concave", "colours of Okabe and Ito"},
    {"component", By::component, "each closed part of the surface, 21 colours in turn", "colours of Okabe and Ito"},
    {"bfactor", By::bfactor, "B-factor in Å²; viridis, smallest to largest", ""},
    {"occupancy", By::occupancy, "occupancy; viridis, smallest to largest", ""},
    {"charge", By::charge, "partial charge in e (PQR files); red-white-blue, symmetric about 0, negative is red", ""},
    {"hydrophobicity", By::hydrophobicity,
     "hydropathy of the amino acid; blue-white-red, -4.5 (arginine, blue) to 4.5 (isoleucine, red)",
     "J. Kyte and R. F. Doolittle, J. Mol. Biol. 157, 105 (1982)"},
    {"element-cpk", By::element_cpk, "chemical element in the usual (CPK) colours",
     "after the models of R. B. Corey, L. Pauling and W. L. Koltun; metals and tones are our own"},
    {"index", By::index, "place in the file, from 0; viridis", ""},
    {"chain-element", By::chain_element, "carbon of polymers by chain, all other atoms as element-cpk",
     "colours of chain and element-cpk"},
    {"chain-okabe-ito", By::chain_okabe_ito, "chains in order of appearance, 21 strong colours in turn",
     "M. Okabe and K. Ito, Color Universal Design (2008)"},
    {"radial", By::radial, "distance from the middle of all atoms in Å, for capsids; viridis", ""},
    {"secondary", By::secondary,
     "helix, strand or coil: as the file says, else by the hydrogen bonds of the backbone, as cartoons have it",
     "W. Kabsch and C. Sander, Biopolymers 22, 2577 (1983); colours of Okabe and Ito"},
    {"rainbow", By::rainbow, "place in its chain, from blue (N-terminus or 5') to red (C-terminus or 3')",
     "colours of Okabe and Ito"},
    {"plddt", By::plddt,
     "confidence of a predicted model in the four classes of AlphaFold, from _ma_qa_metric_local or else B-factors",
     "the AlphaFold database: M. Varadi et al., Nucleic Acids Res. 50, D439 (2022)"},
    {"snfg", By::snfg, "sugars in the colours of their symbols (SNFG); all else is grey",
     "A. Varki et al., Glycobiology 25, 1323 (2015); S. Neelamegham et al., Glycobiology 29, 620 (2019)"},
    {"bead", By::bead, "class of a Martini bead: charged, polar, intermediate, apolar, water",
     "P. C. T. Souza et al., Nat. Methods 18, 382 (2021); colours of Okabe and Ito"},
    {"buried", By::buried,
     "accessible area in Å² that is buried between chains, or the groups of @by@ or @interface@; ylorrd, from 0",
     "B. Lee and F. M. Richards, J. Mol. Biol. 55, 379 (1971)"},
    {"lipophilicity", By::lipophilicity,
     "potential of a protein at each point: log P of its atoms times exp(-distance); blue-white-red, -0.3 to 0.3",
     "S. A. Wildman and G. M. Crippen, J. Chem. Inf. Comput. Sci. 39, 868 (1999); J.-L. Fauchère et al., J. Mol. "
     "Graph. 6, 203 (1988)"},
    {"relative-accessibility", By::accessibility,
     "accessible area of each residue over the greatest that it can have; viridis, 0 to 1",
     "M. Z. Tien et al., PLoS ONE 8, e80635 (2013)"},
    {"rmsf", By::rmsf, "root mean square fluctuation in Å over the frames of a run; ylorrd, from 0", ""},
    {"file", By::file, "numbers of @color-by-file@; viridis, smallest to largest", ""},
    {"conservation", By::conservation, "grades of @color-by-file@, 1 (variable) to 9 (conserved); consurf",
     "H. Ashkenazy et al., Nucleic Acids Res. 44, W344 (2016)"}};

/// True if all polymers of a structure are one chain at one place, in each of its models, which may be frames.
bool has_one_chain(const Structure& structure) {
  std::set<std::pair<std::uint32_t, std::string_view>> chains;
  for (const std::vector<Atom>* const atoms : {&structure.atoms, &structure.extra_atoms})
    for (const Atom& atom : *atoms)
      if (atom.kind == AtomClass::polymer) chains.emplace(atom.copy, atom.chain);
  return chains.size() == 1 &&
         std::ranges::all_of(structure.instances, [](const Instances& placed) { return placed.motions.size() == 1; });
}

}  // namespace

bool has_chain_color(const Atom& atom) {
  return atom.element == 0 || (atom.element == 6 && atom.kind == AtomClass::polymer);
}

std::map<std::string, std::size_t> places_of_chains(const Structure& structure) {
  std::map<std::string, std::size_t> places;
  for (const std::vector<std::string>& chains : {structure.chains, chains_of(structure.atoms)})
    for (const std::string& chain : chains) places.try_emplace(chain, places.size());
  return places;
}

std::span<const ColorSchemeMetadata> color_schemes() { return kSchemes; }

ColorScheme resolved_scheme(const Structure& structure, ColorScheme scheme) {
  if (scheme.by != By::automatic) return scheme;
  const auto any = [&](auto is_of) { return std::ranges::any_of(structure.atoms, is_of); };
  const bool polymer = any([](const Atom& atom) { return atom.kind == AtomClass::polymer; });
  scheme.by = polymer || !any([](const Atom& atom) { return atom.element != 0; }) ? By::chain : By::element_cpk;
  if (!polymer || !has_one_chain(structure)) return scheme;
  scheme.by = By::rainbow;
  if (!scheme.map) scheme.map = ColorMap::pastel;
  return scheme;
}

bool ColorScheme::uses_scale() const {
  return has_scale() || std::ranges::any_of(rules, [](const ColorRule& rule) { return rule.paint.has_scale(); });
}

bool ColorScheme::uses(By kind) const {
  return by == kind || std::ranges::any_of(rules, [kind](const ColorRule& rule) { return rule.paint.by == kind; });
}

bool ColorScheme::uses_frames() const {
  return (takes_file() && file.by_frame) || std::ranges::any_of(rules, [](const ColorRule& rule) {
           return rule.paint.takes_file() && rule.paint.file.by_frame;
         });
}

bool ColorScheme::changes_with_frames() const {
  return uses_frames() || by == By::buried || by == By::accessibility || by == By::lipophilicity || uses(By::radial) ||
         uses(By::secondary);
}

void ColorScheme::set_numbers(const NumberFile& numbers) {
  if (numbers.of_colors && takes_file() && (map || range))
    throw RequestError(message("{} has colours of its own; leave @map@ and @color-range@ out", escaped(numbers.path)));
  if (numbers.by_frame && map == ColorMap::categorical && !own_map)
    throw RequestError(
        message("@map categorical@ gives each number of a picture its own colour, which would change from frame to "
                "frame; choose another @map@"));
  if (by != By::rmsf) file = numbers;  // the numbers of rmsf were measured
  if (takes_file()) frames_range = numbers.range_of_frames();
  for (ColorRule& rule : rules) {
    if (!rule.paint.takes_file()) continue;
    rule.paint.file = numbers;
    rule.paint.frames_range = numbers.range_of_frames();
  }
}

void ColorScheme::share_scale() {
  for (ColorRule& rule : rules) {
    if (!rule.paint.has_scale()) continue;
    rule.paint.map = map;
    rule.paint.own_map = own_map;
    rule.paint.range = range;
    rule.paint.missing = missing;
  }
}

std::optional<ColorScheme> parse_color_scheme(std::string_view text) {
  ColorScheme scheme;
  if (const std::optional<glm::vec3> color = parse_color(text)) {
    scheme.by = By::fixed;
    scheme.fixed = *color;
    return scheme;
  }
  if (text == "atom") text = "index";
  const auto found = std::ranges::find(kSchemes, text, &ColorSchemeMetadata::word);
  if (found == std::end(kSchemes)) return std::nullopt;
  scheme.by = found->by;
  return scheme;
}

std::string scheme_word(const ColorScheme& color) {
  for (const ColorSchemeMetadata& scheme : kSchemes)
    if (scheme.by == color.by) return std::string(scheme.word);
  return hex_color(color.fixed);
}

std::string color_scheme_words() {
  std::string words;
  for (const ColorSchemeMetadata& scheme : kSchemes) words.append(scheme.word).append(", ");
  return words + "a name such as red, or #rrggbb";
}

ColorRule parse_color_rule(std::string_view text) {
  const std::size_t equals = text.rfind('=');
  const std::string_view word = equals == std::string_view::npos ? text : text.substr(equals + 1);
  std::optional<ColorScheme> paint = parse_color_scheme(word);
  if (equals == std::string_view::npos || !paint)
    throw RequestError("{} is not one of {}", in_quotes(word), color_scheme_words());
  if (paint->by == By::kind || paint->by == By::component || paint->by == By::accessibility || paint->of_points())
    throw RequestError("{} cannot colour some of the atoms; it colours the whole surface", in_quotes(word));
  return {parse_selection(text.substr(0, equals)), *std::move(paint)};
}

std::vector<std::string> rules_without_atoms(const Structure& structure, const ColorScheme& scheme) {
  std::vector<std::string> texts;
  const auto means_some = [](const Selection& atoms, const auto& among) {
    return std::ranges::any_of(atoms.evaluate(among), std::identity());
  };
  // Opacity applies only to the surface; sticks and other shapes have colours, too.
  for (const ColorRule& rule : scheme.rules)
    if (!means_some(rule.atoms, structure) && !means_some(rule.atoms, structure.extra_atoms))
      texts.push_back(rule.atoms.text());
  for (const OpacityRule& rule : scheme.opacities)
    if (rule.atoms && !means_some(*rule.atoms, structure)) texts.push_back(rule.atoms->text());
  return texts;
}

OpacityRule parse_opacity_rule(std::string_view text) {
  const std::size_t equals = text.rfind('=');
  const std::string_view number = equals == std::string_view::npos ? text : text.substr(equals + 1);
  double opacity = 0.0;
  if (!parse_number(number, opacity) || !(opacity >= 0.0 && opacity <= 1.0))
    throw RequestError("{} is not an opacity from 0 (hidden) to 1 (opaque), as in 'chain A=0.4' or 0.4",
                       in_quotes(number));
  OpacityRule rule;
  rule.opacity = static_cast<float>(opacity);
  if (equals != std::string_view::npos) rule.atoms = parse_selection(text.substr(0, equals));
  return rule;
}

std::optional<std::array<double, 2>> parse_color_range(std::string_view text) {
  const std::size_t colon = text.find(':');
  std::array<double, 2> range{};
  if (colon == std::string_view::npos || !parse_number(text.substr(0, colon), range[0]) ||
      !parse_number(text.substr(colon + 1), range[1]) || !(range[0] < range[1]) ||
      !std::isfinite(range[1] - range[0])) {
    return std::nullopt;
  }
  return range;
}

ColorRule named_color_rule(std::string_view text) {
  const auto parted = selection_and_text(text);
  if (!parted) return parse_color_rule(text);  // reports the error
  const std::size_t colon = parted->text.find(':');
  if (colon == std::string_view::npos) return parse_color_rule(text);
  ColorRule rule = parse_color_rule(text.substr(0, text.size() - parted->text.size() + colon));
  rule.name = parted->text.substr(colon + 1);
  if (rule.name.empty())
    throw RequestError(in_quotes(text) + " has no name after its colon; write it as in 'chain A=red:Alpha'");
  return rule;
}

std::string color_rule_text(const ColorRule& rule) {
  return rule.atoms.text() + "=" + scheme_word(rule.paint) + (rule.name.empty() ? "" : ":" + rule.name);
}

namespace {

constexpr std::size_t kMostColors = 4096;

class RampReader {
 public:
  explicit RampReader(const TextFile& file) : file_(file) {}

  ColorRamp read() {
    if (trimmed(file_.text).starts_with('['))
      read_json();
    else
      read_lines();
    if (ramp_.colors.size() < 2)
      throw InputError(file_.path, 0, "holds {} colours; a map has at least two", ramp_.colors.size());
    finish_places();
    return std::move(ramp_);
  }

 private:
  void add(std::size_t line, const std::optional<double>& place, std::string_view color) {
    const auto fail = [&](const std::string& what) { throw InputError(file_.path, line, what); };
    const std::optional<glm::vec3> read = parse_color(color);
    if (!read) fail(fmt::format("{} is not a colour; write #rrggbb, #rgb or a name such as red", in_quotes(color)));
    if (ramp_.colors.size() == kMostColors) fail(fmt::format("a map has at most {} colours", kMostColors));
    if (!ramp_.colors.empty() && place.has_value() == ramp_.places.empty())
      fail("some colours have a position, others do not");
    if (place && !ramp_.places.empty() && !(*place > ramp_.places.back()))
      fail(fmt::format("the position {:g} does not follow {:g}; positions must increase", *place, ramp_.places.back()));
    if (place) ramp_.places.push_back(*place);
    ramp_.colors.push_back(*read);
  }

  void read_lines() {
    LineReader lines(file_);
    std::string_view line;
    while (lines.next(line)) {
      std::string text(line.substr(0, line.find("# ")));
      std::ranges::replace_if(
          text, [](char c) { return c == ',' || c == ';'; }, ' ');
      const std::vector<std::string_view> fields = fields_of(text, 3);
      if (fields.empty() || fields[0] == "#") continue;
      std::optional<double> place;
      if (double number = 0.0; fields.size() == 2 && parse_number(fields[0], number)) place = number;
      if (fields.size() > 2 || (fields.size() == 2 && !place))
        throw lines.error("{} is neither a colour nor a position and a colour", in_quotes(trimmed(line)));
      add(lines.number(), place, fields.back());
    }
  }

  void read_json() {
    const nlohmann::json list = is_nested_too_deep(file_.text) ? nlohmann::json(nlohmann::json::value_t::discarded)
                                                               : nlohmann::json::parse(file_.text, nullptr, false);
    if (list.is_discarded()) throw InputError(file_.path, 0, "begins as a JSON list, but is not valid JSON");
    for (const nlohmann::json& entry : list) {
      const bool pair = entry.is_array() && entry.size() == 2 && entry[0].is_number() && entry[1].is_string();
      if (!pair && !entry.is_string())
        throw InputError(file_.path, 0,
                         "entry {} is neither a colour such as \"#ff0000\" nor a pair of a position and a colour",
                         ramp_.colors.size() + 1);
      add(0, pair ? std::optional(entry[0].get<double>()) : std::nullopt,
          pair ? entry[1].get<std::string>() : entry.get<std::string>());
    }
  }

  void finish_places() {
    const double first = ramp_.places.empty() ? 0.0 : ramp_.places.front();
    const double width = ramp_.places.empty() ? 1.0 : ramp_.places.back() - first;
    if (ramp_.places.empty())
      for (std::size_t n = 0; n < ramp_.colors.size(); ++n)
        ramp_.places.push_back(static_cast<double>(n) / static_cast<double>(ramp_.colors.size() - 1));
    for (double& place : ramp_.places) place = (place - first) / width;
  }

  const TextFile& file_;
  ColorRamp ramp_;
};

}  // namespace

ColorRamp read_color_ramp(const std::string& path) {
  const TextFile file = read_text_file(path, std::size_t{1} << 20);
  return RampReader(file).read();
}

}  // namespace meniscus
