// SPDX-License-Identifier: BSD-3-Clause
// Commands that list chains, ligands and residues, locate atoms, and hide, show or cut open atoms.
#include <cctype>

#include <fmt/ranges.h>

#include "app/preview/commands.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/color/color_schemes.h"
#include "core/color/named_colors.h"
#include "core/scene/cut.h"
#include "core/scene/representations.h"
#include "core/scene/scene_values.h"
#include "core/structure/residue_names.h"
#include "core/structure/selection/selection_words.h"

namespace meniscus {
namespace {

using Json = nlohmann::json;
using ShapeKind = RepresentationRequest::Kind;

constexpr std::size_t kMostListed = 1000;      // entries in a list of contents
constexpr std::size_t kMostResidues = 20'000;  // residues in a sequence
constexpr std::size_t kMostOfOneName = 20;     // ligands or ions of one name that have an entry each
constexpr std::size_t kMostPoints = 300;       // positions in one reply

/// Returns a name as a value of a selection, in quotes if the name could mean something else.
std::string quoted_if_needed(const std::string& name) {
  const bool is_plain = !name.empty() && name.front() != '\'' && std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '\'';
  });
  if (is_plain && (name.size() == 1 || !find_selection_word(name))) return name;
  return name.find('"') == std::string::npos ? fmt::format("\"{}\"", name) : fmt::format("'{}'", name);
}

std::string number_text(const Atom& atom) {
  return atom.insertion_code == ' ' ? fmt::format("{}", atom.residue_number)
                                    : fmt::format("{}{}", atom.residue_number, atom.insertion_code);
}

/// Writes selections of atoms, residues and chains by their names.
class Namer {
 public:
  explicit Namer(const std::vector<Atom>& atoms) {
    for (const Atom& atom : atoms) {
      has_copies_ |= atom.copy > 0;
      has_models_ |= atom.model != atoms.front().model;
    }
  }

  /// Returns the words that all selections of a chain begin with, such as "chain A".
  std::string chain(const Atom& atom) const {
    const std::string name = has_copies_ && atom.copy == 0 ? atom.chain + "-1" : atom.chain;
    const std::string words = "chain " + quoted_if_needed(name);
    return has_models_ ? fmt::format("model {} and {}", atom.model, words) : words;
  }
  std::string residue(const Atom& atom) const {
    if (atom.kind == AtomClass::unclassified) return "all";
    return fmt::format("{} and resid {} and resname {}", chain(atom), number_text(atom),
                       quoted_if_needed(atom.residue_name));
  }
  std::string atom(const Atom& atom) const {
    if (atom.kind == AtomClass::unclassified) return fmt::format("index {}", atom.index);
    const std::string altloc = atom.altloc == ' ' ? "" : fmt::format(" and altloc {}", atom.altloc);
    return fmt::format("{} and name {}{}", residue(atom), quoted_if_needed(atom.name), altloc);
  }
  /// Returns the selection of a polymer's chain, or of all residues with the name of a smaller molecule.
  std::string molecule(const Atom& atom) const {
    if (atom.kind == AtomClass::unclassified) return "all";
    if (atom.kind == AtomClass::water) return "water";
    if (atom.kind == AtomClass::polymer) return chain(atom) + " and polymer";
    return fmt::format("{} and resname {}", class_name(atom.kind), quoted_if_needed(atom.residue_name));
  }
  /// Returns the name of a chain or residue for people, such as "HEM A 401".
  std::string title(const Atom& atom, const std::string& first, const std::string& last) const {
    std::vector<std::string> words;
    for (const std::string& word : {first, atom.chain, last})
      if (!word.empty()) words.push_back(word);
    return fmt::format("{}{}", fmt::join(words, " "), has_models_ ? fmt::format(" of model {}", atom.model) : "");
  }

 private:
  bool has_copies_ = false, has_models_ = false;
};

/// An entry of the list of contents.
struct Entry {
  std::string name, selection;
  std::string_view kind;
  std::size_t atoms = 0, residues = 0;
  std::size_t shown = 0;                ///< number of its atoms in the picture
  std::optional<glm::vec3> color = {};  ///< sRGB colour of its first atom in the picture that belongs to the surface
};

constexpr std::array<std::string_view, 9> kKindWords{"protein", "DNA",   "RNA", "polymer", "ligand",
                                                     "glycan",  "lipid", "ion", "water"};

/// Returns the molecule with all atoms of its file, waters and ions too. They are read once and kept.
std::shared_ptr<const Structure> everything(const Surroundings& around) {
  Exporter& exporter = around.exporter;
  if (exporter.everything) return exporter.everything;
  const ShownMolecule& molecule = around.molecule;
  if (!exporter.context.read_shown || !molecule.structure().instances.empty() ||
      molecule.structure().file == "standard input")
    return std::make_shared<const Structure>(molecule.annotated_structure());
  FigureRequest all;
  all.representations.requests.push_back({ShapeKind::spheres, parse_selection("all or water or ion")});
  exporter.everything = std::make_shared<const Structure>(exporter.context.read_shown(all, around.state.frame));
  return exporter.everything;
}

/// Returns the key of an atom that is the same in all structures of one file.
std::uint64_t key_of(const Atom& atom) { return std::uint64_t{atom.copy} << 32 | atom.index; }

/// Returns the bits of Atom::shown of atoms that are drawn next to the surface. The ends of dashed lines are not drawn.
std::uint32_t drawn_bits(const FigureRequest& figure) {
  std::uint32_t bits = ~(1u << kHiddenCompanion);
  std::size_t mark = figure.representations.requests.size();
  for (const FigureObjectRequest& object : figure.objects)
    for (int side = 0; side < (object.partners ? 2 : 1); ++side, ++mark)
      if (object.is_dashed()) bits &= ~(1u << mark);
  return bits;
}

/// Returns the atoms in the picture by key_of(), with the sRGB colours of those that belong to the surface.
std::unordered_map<std::uint64_t, std::optional<glm::vec3>> visible_atoms(const Surroundings& around) {
  std::unordered_map<std::uint64_t, std::optional<glm::vec3>> visible;
  const Structure seen = around.molecule.annotated_structure();
  const Coloring coloring = around.molecule.coloring(around.state);
  for (const Atom& atom : shown_atoms(seen))
    if (atom.shown & drawn_bits(around.state.figure)) visible[key_of(atom)] = {};
  for (std::uint32_t n = 0; n < seen.atoms.size(); ++n)
    if (!around.state.figure.hides_surface && coloring.shows(n)) visible[key_of(seen.atoms[n])] = coloring.atom[n];
  return visible;
}

/// Calls visit(first, last) for the atoms of each residue.
template <typename Visit>
void for_each_residue(const std::vector<Atom>& atoms, const Visit& visit) {
  for (std::size_t first = 0, last = 0; first < atoms.size(); first = last) {
    const auto same = [&](const Atom& atom) {
      return atom.residue == atoms[first].residue && atom.copy == atoms[first].copy &&
             atom.residue_name == atoms[first].residue_name;
    };
    while (last < atoms.size() && same(atoms[last])) ++last;
    visit(first, last);
  }
}

/// Puts residues into the entries of the list.
class Contents {
 public:
  explicit Contents(const std::vector<Atom>& atoms) : atoms_(atoms), namer_(atoms) {
    const auto with = [&](const char* word) { return parse_selection(word).evaluate(atoms_); };
    is_protein_ = with("protein"), is_nucleic_ = with("nucleic"), is_glycan_ = with("glycan"),
    is_lipid_ = with("lipid");
    for_each_residue(atoms_, [&](std::size_t first, std::size_t) { ++count_[molecule_of(first)]; });
  }

  std::vector<Entry> entries(const Surroundings& around) const {
    const auto visible = visible_atoms(around);
    std::vector<Entry> entries;
    std::map<std::string, std::size_t> places;  // indices of entries by their selections
    for_each_residue(atoms_, [&](std::size_t first, std::size_t last) {
      Entry fresh = entry_of(first);
      const auto [place, is_new] = places.try_emplace(fresh.selection, entries.size());
      if (is_new) entries.push_back(std::move(fresh));
      Entry& entry = entries[place->second];
      ++entry.residues;
      entry.atoms += last - first;
      for (std::size_t n = first; n < last; ++n) {
        const auto seen = visible.find(key_of(atoms_[n]));
        if (seen == visible.end()) continue;
        ++entry.shown;
        if (!entry.color) entry.color = seen->second;
      }
    });
    std::ranges::stable_sort(entries, {}, [](const Entry& entry) { return std::ranges::find(kKindWords, entry.kind); });
    return entries;
  }

 private:
  std::string molecule_of(std::size_t n) const { return namer_.molecule(atoms_[n]); }

  Entry entry_of(std::size_t n) const {
    const Atom& atom = atoms_[n];
    const std::string chain = namer_.chain(atom);
    if (atom.kind == AtomClass::unclassified) return {"All atoms", "all", "ligand"};
    if (atom.kind == AtomClass::water) return {"Water", "water", "water"};
    if (atom.kind == AtomClass::polymer) {
      const bool is_dna = atom.residue_name.starts_with('D');
      return {namer_.title(atom, atom.chain.empty() ? "Chain without a name" : "Chain", ""), molecule_of(n),
              is_protein_[n]   ? "protein"
              : is_nucleic_[n] ? (is_dna ? "DNA" : "RNA")
                               : "polymer"};
    }
    if (is_glycan_[n]) return {namer_.title(atom, "Glycans of chain", ""), chain + " and glycan and ligand", "glycan"};
    const char* const kind = atom.kind == AtomClass::ion ? "ion" : is_lipid_[n] ? "lipid" : "ligand";
    if (count_.at(molecule_of(n)) > kMostOfOneName) return {atom.residue_name, molecule_of(n), kind};
    return {namer_.title(atom, atom.residue_name, number_text(atom)), namer_.residue(atom), kind};
  }

  const std::vector<Atom>& atoms_;
  Namer namer_;
  std::vector<bool> is_protein_, is_nucleic_, is_glycan_, is_lipid_;
  std::map<std::string, std::size_t> count_;  ///< number of residues of each molecule
};

/// Returns the letter, the number and the name of each residue of the selected atoms.
Json sequence_of(const std::vector<Atom>& atoms, const std::vector<bool>& chosen) {
  Json residues = Json::array();
  std::size_t count = 0;
  for_each_residue(atoms, [&](std::size_t first, std::size_t) {
    if (!chosen[first] || ++count > kMostResidues) return;
    const Atom& atom = atoms[first];
    residues.push_back(
        {std::string(1, residue_letter(atom.residue_name)), number_text(atom), escaped(atom.residue_name)});
  });
  return {{"residues", residues}, {"left_out", count - residues.size()}};
}

/// Returns a request that draws atoms as companions of the surface are drawn.
FigureObjectRequest companion_object(const Selection& atoms, ShapeKind kind) {
  ColorScheme color;
  color.by = ColorScheme::By::element_cpk;
  color.rules.push_back(parse_color_rule("element C=#45a878"));
  FigureObjectRequest object{.atoms = atoms, .shapes = kind, .color = color};
  if (kind == ShapeKind::sticks) object.radius = kCompanionRadius;
  return object;
}

/// Adds an object to the figure. Throws RequestError if there is no room for it.
void add_object(PreviewFigure& figure, FigureObjectRequest object) {
  if (figure.figure.representations.requests.size() + figure.figure.objects.size() >= kMostShown)
    throw RequestError("at most {} sets of atoms can be drawn in addition to the surface; remove one", kMostShown);
  figure.figure.objects.push_back(std::move(object));
}

/// Draws the selected atoms next to the surface, unless some of them are drawn there already.
void draw_beside(const Selection& selection, PreviewFigure& figure, const Surroundings& around) {
  const Structure seen = around.molecule.annotated_structure();
  const std::vector<Atom> atoms = shown_atoms(seen), all = shown_atoms(*everything(around));
  const std::vector<bool> drawn = selection.evaluate(atoms), chosen = selection.evaluate(all);
  for (std::size_t n = 0; n < atoms.size(); ++n)
    if (drawn[n] && (atoms[n].shown & drawn_bits(around.state.figure))) return;
  bool is_small = true, is_empty = true;  // is_small: the atoms are ions and water only
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (!chosen[n]) continue;
    is_empty = false;
    is_small = is_small && (all[n].kind == AtomClass::ion || all[n].kind == AtomClass::water);
  }
  if (!is_empty) add_object(figure, companion_object(selection, is_small ? ShapeKind::spheres : ShapeKind::sticks));
}

/// Removes chosen atoms from shapes next to the surface; returns true if there were some. atoms: all in the picture.
bool remove_shapes(const Selection& selection, PreviewFigure& figure, const std::vector<Atom>& atoms) {
  const std::vector<bool> chosen = selection.evaluate(atoms);
  bool changes = false;
  /// Removes the chosen atoms from a selection and returns true if no atom is left.
  const auto without = [&](Selection& of) {
    const std::vector<bool> drawn = of.evaluate(atoms);
    bool loses = false, keeps = false;
    for (std::size_t n = 0; n < atoms.size(); ++n)
      if (drawn[n]) (chosen[n] ? loses : keeps) = true;
    changes = changes || loses;
    if (loses && keeps) of = parse_selection(fmt::format("({}) and not ({})", of.text(), selection.text()));
    return loses && !keeps;
  };
  std::erase_if(figure.figure.representations.requests, [&](auto& request) { return without(request.atoms); });
  std::erase_if(figure.figure.objects, [&](auto& object) { return !object.is_dashed() && without(object.atoms); });
  // Companions are drawn all or none, so those that stay become objects.
  const Namer namer(atoms);
  std::map<std::size_t, std::vector<std::string>> stays{{kCompanionSticks, {}}, {kCompanionSpheres, {}}};
  bool loses = false;
  for_each_residue(atoms, [&](std::size_t first, std::size_t last) {
    for (auto& [bit, residues] : stays) {
      if (!(atoms[first].shown & 1u << bit)) continue;
      const bool goes = std::any_of(chosen.begin() + static_cast<std::ptrdiff_t>(first),
                                    chosen.begin() + static_cast<std::ptrdiff_t>(last), [](bool yes) { return yes; });
      loses = loses || goes;
      if (!goes) residues.push_back("(" + namer.residue(atoms[first]) + ")");
    }
  });
  if (!loses) return changes;
  figure.figure.bare = true;
  for (const auto& [bit, residues] : stays)
    if (!residues.empty())
      add_object(figure, companion_object(parse_selection(fmt::format("{}", fmt::join(residues, " or "))),
                                          bit == kCompanionSticks ? ShapeKind::sticks : ShapeKind::spheres));
  return true;
}

/// Returns what hide_surface() adds to the expression of the shown atoms.
std::string exclusion(const Selection& selection) { return fmt::format(" and not ({})", selection.text()); }

/// Hides the surface of the selected atoms.
void hide_surface(const Selection& selection, PreviewFigure& figure) {
  const std::string shown = figure.molecule.show ? figure.molecule.show->text() : "all";
  const bool is_list =
      shown == "all" || (shown.starts_with("all and not (") && shown.find(" or ") == std::string::npos);
  figure.molecule.show = parse_selection((is_list ? shown : fmt::format("({})", shown)) + exclusion(selection));
}

/// Shows the surface of the selected atoms again.
void show_surface(const Selection& selection, PreviewFigure& figure) {
  if (std::exchange(figure.figure.hides_surface, false) || !figure.molecule.show) {
    figure.molecule.show = selection;
    return;
  }
  std::string shown = figure.molecule.show->text();
  const std::string part = exclusion(selection);
  if (const std::size_t at = shown.find(part); at != std::string::npos)
    figure.molecule.show = parse_selection(shown.erase(at, part.size()));
  else
    figure.molecule.show = either(*figure.molecule.show, selection);
}

/// Returns how many of the surface's atoms the expression selects, and how many of these the picture shows.
std::array<std::size_t, 2> surface_counts(const Selection& selection, const PreviewFigure& figure,
                                          const Surroundings& around) {
  const std::vector<bool> chosen = selection.evaluate(around.molecule.annotated_structure());
  const Coloring coloring = around.molecule.coloring(figure);
  std::array<std::size_t, 2> counts{0, 0};
  for (std::uint32_t n = 0; n < around.molecule.atoms().size(); ++n) {
    counts[0] += chosen[n];
    counts[1] += chosen[n] && !figure.figure.hides_surface && coloring.shows(n);
  }
  return counts;
}

}  // namespace

Json place_selections(const Atom& atom, const ShownMolecule& molecule) {
  const Namer namer(molecule.atoms_in_view());
  return {{"atom", escaped(namer.atom(atom))},
          {"residue", escaped(namer.residue(atom))},
          {"molecule", escaped(namer.molecule(atom))}};
}

Json get_contents(const CommandReader& command, const Surroundings& around) {
  const std::vector<Atom> atoms = shown_atoms(*everything(around));
  if (command.has("selection")) return sequence_of(atoms, command.selection().evaluate(atoms));
  const std::vector<Entry> entries = Contents(atoms).entries(around);
  Json list = Json::array();
  for (const Entry& entry : entries) {
    if (list.size() == kMostListed) break;
    list.push_back({{"name", escaped(entry.name)},
                    {"kind", entry.kind},
                    {"atoms", entry.atoms},
                    {"residues", entry.residues},
                    {"shown", entry.shown},
                    {"color", entry.color ? Json(hex_color(*entry.color)) : Json(nullptr)},
                    {"selection", escaped(entry.selection)}});
  }
  return {{"entries", list}, {"left_out", entries.size() - list.size()}};
}

Json locate(const CommandReader& command, const Surroundings& around) {
  const ShownMolecule& molecule = around.molecule;
  const std::vector<Atom> atoms = molecule.atoms_in_view();
  const std::vector<bool> chosen = command.selection().evaluate(atoms);
  std::vector<std::size_t> found;
  Json places = Json::array(), points = Json::array();
  for (std::size_t n = 0; n < atoms.size(); ++n) {
    if (!chosen[n]) continue;
    found.push_back(n);
    if (n > 0 && chosen[n - 1])
      places.back()[1] = places.back()[1].get<std::size_t>() + 1;
    else
      places.push_back({n, 1});
  }
  const std::size_t step = (found.size() + kMostPoints - 1) / kMostPoints;
  for (std::size_t n = 0; n < found.size(); n += step) {
    const glm::dvec3& point = atoms[found[n]].position;
    points.push_back({point.x, point.y, point.z});
  }
  const glm::ivec2 size = molecule.picture_size(around.state);
  return {{"atoms", found.size()}, {"places", places}, {"points", points}, {"picture", {size.x, size.y}}};
}

Outcome look_into(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const SessionContext& context = around.exporter.context;
  if (!context.aim || !context.read_shown)
    throw RequestError("look_into: this molecule cannot be read again, so nothing can be drawn inside its surface");
  const Selection selection = command.selection();
  std::erase_if(state.figure.cuts, [](const Cut& cut) { return cut.place == Cut::Place::before; });
  command.naming([&] { draw_beside(selection, state, around); });
  Scene scene = rendered_scene(state, {state.size});
  scene.picture.camera_file.clear();
  scene.picture.projection = state.camera.projection;
  set_value(scene, property_of("camera.look_into"), std::array{selection.text()});
  state.figure.cuts = scene.figure.cuts;
  const Structure structure = context.read_shown(state.figure, state.frame);
  const std::vector<bool> chosen = selection.evaluate(shown_atoms(structure));
  const auto count = static_cast<std::size_t>(std::ranges::count(chosen, true));
  if (count == 0) throw RequestError("look_into: no atom of this frame is " + in_quotes(selection.text()));
  state.camera = context.aim(scene, structure);
  state.overview = false;
  return {std::move(state), Renewal::shapes, {{"atoms", count}}};
}

Outcome take_away(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const Selection selection = command.selection(), all = parse_selection("all");
  const bool was_beside =
      command.naming([&] { return remove_shapes(selection, state, around.molecule.atoms_in_view()); });
  if (surface_counts(selection, state, around)[1] > 0) hide_surface(selection, state);
  const std::size_t left = surface_counts(all, state, around)[1];
  if (!state.figure.hides_surface && left == 0) {
    state.figure.hides_surface = true;
    state.molecule.show.reset();
  }
  return {std::move(state), was_beside ? Renewal::shapes : Renewal::colors, {{"atoms", left}}};
}

Outcome bring_back(const CommandReader& command, PreviewState state, const Surroundings& around) {
  const Selection selection = command.selection(), all = parse_selection("all");
  const auto [count, shown] = surface_counts(selection, state, around);
  if (shown < count) show_surface(selection, state);
  if (count == 0) command.naming([&] { draw_beside(selection, state, around); });
  const auto [whole, seen] = surface_counts(all, state, around);
  if (whole == seen) state.molecule.show.reset();
  return {std::move(state), count == 0 ? Renewal::shapes : Renewal::colors};
}

}  // namespace meniscus
