// SPDX-License-Identifier: BSD-3-Clause
// Colour schemes: by a property of the atoms, by a number, or one colour for all.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "core/structure/atom_numbers.h"
#include "core/color/color_maps.h"
#include "core/color/named_colors.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

struct Structure;

/// How much of what lies behind them some atoms cover.
struct OpacityRule {
  std::optional<Selection> atoms;  ///< nothing: all
  float opacity = 1.0f;            ///< in [0, 1]
};

struct ColorRule;
struct VolumePaint;

/// A wish such as "chain" or "#e69f00", and what some atoms get instead.
struct ColorScheme {
  enum class By : std::uint8_t {
    element,
    element_cpk,
    chain,
    residue,    ///< type of residue, by chemistry
    copy,       ///< of an assembly made of atoms
    model,      ///< of the file, and each added file
    kind,       ///< of patch
    component,  ///< objects in turn: closed parts of the surface, chains, ...
    fixed,      ///< one colour
    secondary,  ///< helix, strand, coil
    plddt,      ///< confidence of a predicted model, in four classes
    snfg,       ///< sugars, as their symbols
    bead,       ///< classes of Martini's beads
    bfactor,    ///< this one and those below are numbers, with a map and a range
    occupancy,
    charge,
    hydrophobicity,  ///< Kyte & Doolittle 1982
    index,           ///< place in the file
    rainbow,         ///< place in its chain
    radial,          ///< distance from the middle of all atoms
    buried,          ///< accessible area that is buried between groups of atoms; numbers come with the surface
    rmsf,            ///< fluctuation over the frames of a run, likewise
    accessibility,   ///< relative, of residues, likewise
    file,            ///< numbers of a file of the user's own
    conservation,    ///< grades 1 to 9 of such a file
    volume,          ///< a volume map, at each point of the surface
    lipophilicity    ///< the potential of the atoms, likewise
  };
  By by = By::element;
  glm::vec3 fixed{0.8f};                       ///< sRGB in [0, 1], for By::fixed
  std::optional<ColorMap> map;                 ///< nothing: that of the scheme (color_scale)
  std::shared_ptr<const ColorRamp> own_map;    ///< instead of `map`, if there is one
  std::optional<std::array<double, 2>> range;  ///< numbers at both ends of the map; nothing: automatic (color_scale)
  /// Of numbers that change from frame to frame of a run the least and the greatest of all frames, instead of an
  /// automatic range.
  std::optional<std::array<double, 2>> frames_range;
  std::optional<glm::vec3> missing;           ///< of atoms without a number; nothing: default_missing_color
  NumberFile file;                            ///< for takes_file(); for is_measured() the numbers of the atoms
  std::shared_ptr<const VolumePaint> volume;  ///< for of_points(); of lipophilicity it comes with the surface
  std::string title, unit;                    ///< of the scale; empty: its own
  std::vector<ColorRule> rules;               ///< over all this; of several that speak of an atom the last counts
  std::vector<OpacityRule> opacities;         ///< and so here

  /// True for schemes that colour by a number.
  bool has_scale() const { return by >= By::bfactor; }
  /// True for schemes that colour each point of a surface by a number of its own.
  bool of_points() const { return by >= By::volume; }
  /// The same as has_scale(), or that some rule colours by a number.
  bool uses_scale() const;
  /// True for schemes that colour by the numbers of a file.
  bool takes_file() const { return by == By::file || by == By::conservation; }
  /// True for schemes whose numbers come from surfaces or runs, not from atoms.
  bool is_measured() const { return by == By::buried || by == By::rmsf || by == By::accessibility; }
  /// Whether this or a rule is of this kind.
  bool uses(By kind) const;
  /// The same of those that colour by the numbers of a file.
  bool uses_file() const { return uses(By::file) || uses(By::conservation); }
  /// Whether these differ from frame to frame of a run.
  bool uses_frames() const;
  /// The same, or that this or a rule colours by where atoms are or what they bury.
  bool changes_with_frames() const;
  /// Numbers, for this and for all rules. Those of frames have one scale: without a range that of all of them. Throws
  /// RequestError for them where the map gives each number a colour of its own.
  void set_numbers(const NumberFile& numbers);
  /// Of what rules colour by a number this map, range and colour of missing ones hold, too.
  void share_scale();
};

/// The colours of some atoms: of a scheme that neither has rules nor needs more than atoms (no patches, no parts).
struct ColorRule {
  Selection atoms;
  ColorScheme paint;
  std::string name{};  ///< in legends; empty: the expression
};

/// What a scheme is, in words users can look up.
struct ColorSchemeMetadata {
  std::string_view word;  ///< for --color
  ColorScheme::By by;
  std::string_view description;
  std::string_view source;  ///< of its colours or numbers; empty where it needs none
};

/// All schemes but the fixed colour, in the order the help names them.
std::span<const ColorSchemeMetadata> color_schemes();

/// Reads "element", ..., "file", "atom" (the same as "index") or what parse_color reads; nothing for any other text.
std::optional<ColorScheme> parse_color_scheme(std::string_view text);

/// What parse_color_scheme reads as this scheme, without its rules: a word, or "#rrggbb".
std::string scheme_word(const ColorScheme& color);

/// All words parse_color_scheme reads, for messages: "element, chain, ..., a name such as red, or #rrggbb".
std::string color_scheme_words();

/// Reads "EXPR=red": split at the last "=", and what is behind it is read as parse_color_scheme does. Throws
/// RequestError for what is not a colour or cannot be a rule's, SelectionError.
ColorRule parse_color_rule(std::string_view text);

/// The rules' expressions that select none of these atoms, for warnings.
std::vector<std::string> rules_without_atoms(const Structure& structure, const ColorScheme& scheme);

/// Reads "EXPR=0.4", split at the last "=", or "0.4" for all atoms. Throws RequestError for a number outside [0, 1],
/// SelectionError.
OpacityRule parse_opacity_rule(std::string_view text);

/// The place of each chain among those of the file, which has its colour by it; chains that the file does not list come
/// behind, as in a structure that is of no file.
std::map<std::string, std::size_t> places_of_chains(const Structure& structure);

/// Reads "lo:hi" with lo < hi and a finite difference; nothing for any other text.
std::optional<std::array<double, 2>> parse_color_range(std::string_view text);

}  // namespace meniscus
