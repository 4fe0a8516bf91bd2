// SPDX-License-Identifier: BSD-3-Clause
// Colour schemes: by a property of the atoms, by a number or one colour for all, their rules as users write them, and
// the colours of atoms by them.
#pragma once

#include "core/color/color_maps.h"
#include "core/color/named_colors.h"
#include "core/structure/atom_numbers.h"
#include "core/structure/selection/selection.h"

namespace meniscus {

struct Structure;

/// The opacity of some atoms.
struct OpacityRule {
  std::optional<Selection> atoms;  ///< nothing: all
  float opacity = 1.0f;            ///< opacity in [0, 1]
};

struct ColorRule;

/// A scheme such as "chain" or "#e69f00", and rules for some atoms.
struct ColorScheme {
  enum class By : std::uint8_t {
    automatic,  ///< the scheme that resolved_scheme() returns
    element,
    element_cpk,
    chain,
    chain_element,    ///< carbon atoms of polymers by chain, all other atoms by element
    chain_okabe_ito,  ///< chains in other colours
    residue,          ///< type of residue, by chemistry
    copy,             ///< copy in an assembly made of atoms
    model,            ///< model of the file, and each added file
    kind,             ///< kind of patch
    component,        ///< objects in turn: closed parts of the surface, chains, ...
    fixed,            ///< one colour
    secondary,        ///< helix, strand, coil
    plddt,            ///< confidence of a predicted model, in four classes
    snfg,             ///< sugars, as their symbols
    bead,             ///< classes of Martini's beads
    bfactor,          ///< this and all later schemes are numbers with a map and a range
    occupancy,
    charge,
    hydrophobicity,  ///< Kyte & Doolittle 1982
    index,           ///< index in the file
    rainbow,         ///< position in its chain
    radial,          ///< distance from the middle of all atoms
    buried,          ///< accessible area that is buried between groups of atoms; the numbers come with the surface
    rmsf,            ///< fluctuation over the frames of a run; the numbers come with the run
    accessibility,   ///< relative accessibility of residues; the numbers come with the surface
    file,            ///< numbers of a file of the user's own
    conservation,    ///< grades 1 to 9 of the user's own file
    volume,          ///< a volume map, at each point of the surface
    lipophilicity    ///< the lipophilicity potential of the atoms, at each point of the surface
  };
  By by = By::automatic;
  glm::vec3 fixed{0.8f};                       ///< sRGB in [0, 1], for By::fixed
  std::optional<ColorMap> map;                 ///< nothing: the default of the scheme (color_scale)
  std::shared_ptr<const ColorRamp> own_map;    ///< replaces `map`, if set
  std::optional<std::array<double, 2>> range;  ///< numbers at both ends of the map; nothing: automatic (color_scale)
  /// The smallest and largest number in all frames, if numbers change from frame to frame. They replace an automatic
  /// range.
  std::optional<std::array<double, 2>> frames_range;
  std::optional<glm::vec3> missing;           ///< colour of atoms without a number; nothing: default_missing_color
  NumberFile file;                            ///< used if takes_file(), or for the numbers of atoms if is_measured()
  std::shared_ptr<const VolumePaint> volume;  ///< used if of_points(); that of lipophilicity comes with the surface
  std::string title, unit;                    ///< title and unit of the scale; empty: the default
  std::vector<ColorRule> rules;               ///< override the scheme; of several rules for an atom the last one counts
  std::vector<OpacityRule> opacities;         ///< the last of several rules for an atom counts

  /// True for schemes that colour by a number.
  bool has_scale() const { return by >= By::bfactor; }
  /// True for schemes that colour each point of a surface by a number of its own.
  bool of_points() const { return by >= By::volume; }
  /// True if this scheme or a rule colours by a number.
  bool uses_scale() const;
  /// True for schemes that colour by the numbers of a file.
  bool takes_file() const { return by == By::file || by == By::conservation; }
  /// True for schemes whose numbers come from surfaces or runs, not from atoms.
  bool is_measured() const { return by == By::buried || by == By::rmsf || by == By::accessibility; }
  /// True if this scheme or a rule is of this kind.
  bool uses(By kind) const;
  /// True if this scheme or a rule colours by the numbers of a file.
  bool uses_file() const { return uses(By::file) || uses(By::conservation); }
  /// True if these numbers differ from frame to frame of a run.
  bool uses_frames() const;
  /// True if uses_frames(), or if this scheme or a rule colours by positions of atoms or by buried areas.
  bool changes_with_frames() const;
  /// Sets the numbers of this scheme and of all rules. Numbers of frames have one scale, whose default range is that of
  /// all frames. Throws RequestError for them if the map gives each number a colour of its own.
  void set_numbers(const NumberFile& numbers);
  /// Applies this map, range and colour of missing numbers also to rules that colour by a number.
  void share_scale();
};

/// The colours of some atoms, by a scheme that has no rules and needs only atoms (no patches, no parts).
struct ColorRule {
  Selection atoms;
  ColorScheme paint;
  std::string name{};  ///< name in legends; empty: the expression
};

/// The description of a scheme for users.
struct ColorSchemeMetadata {
  std::string_view word;  ///< word for --color
  ColorScheme::By by;
  std::string_view description;
  std::string_view source;  ///< source of its colours or numbers; empty if it needs none
};

/// Returns all schemes but the fixed colour, in the order of the help.
std::span<const ColorSchemeMetadata> color_schemes();

/// Returns the scheme that By::automatic means for these atoms: `rainbow` in ColorMap::pastel if all their polymers are
/// one chain, `chain` if they are several or if no atom has a known element, else `element_cpk`. Returns any other
/// scheme as it is.
ColorScheme resolved_scheme(const Structure& structure, ColorScheme scheme);

/// Parses "auto", "element", ..., "file", "atom" (the same as "index") or a colour that parse_color reads; nothing for
/// any other text.
std::optional<ColorScheme> parse_color_scheme(std::string_view text);

/// Formats a scheme without its rules as parse_color_scheme reads it: a word, or "#rrggbb".
std::string scheme_word(const ColorScheme& color);

/// Returns all words that parse_color_scheme reads, for messages: "auto, ..., a name such as red, or #rrggbb".
std::string color_scheme_words();

/// Parses "EXPR=red", split at the last "=", with the part after it as in parse_color_scheme. Throws RequestError for
/// text that is not a colour or cannot be a rule's, SelectionError.
ColorRule parse_color_rule(std::string_view text);

/// Returns the expressions of rules that select none of these atoms, for warnings.
std::vector<std::string> rules_without_atoms(const Structure& structure, const ColorScheme& scheme);

/// Parses "EXPR=0.4", split at the last "=", or "0.4" for all atoms. Throws RequestError for a number outside [0, 1],
/// SelectionError.
OpacityRule parse_opacity_rule(std::string_view text);

/// True if By::chain_element gives this atom the colour of its chain.
bool has_chain_color(const Atom& atom);

/// Returns the index of each chain among the chains of the file, which decides its colour; chains that the file does
/// not list follow, as in a structure without a file.
std::map<std::string, std::size_t> places_of_chains(const Structure& structure);

/// Parses "lo:hi" with lo < hi and a finite difference; nothing for any other text.
std::optional<std::array<double, 2>> parse_color_range(std::string_view text);

/// Parses "EXPR=red" or "EXPR=red:Name"; the part before the colon as parse_color_rule does. Throws RequestError,
/// SelectionError.
ColorRule named_color_rule(std::string_view text);

/// Formats a rule as named_color_rule reads it.
std::string color_rule_text(const ColorRule& rule);

struct Coloring;

/// Returns one colour per atom of the structure, for a surface that is one object. Rules override the scheme, except
/// where it colours by kind of patch. Throws InputError if colours are by a number and no atom has one, if a file has a
/// different number of numbers than there are atoms, and if the categorical map has fewer colours than there are
/// different numbers.
Coloring color_atoms(const Structure& structure, const ColorScheme& scheme);

/// Returns the colours of one of several objects. atom: per atom of the object, its index into structure.atoms.
/// object_number: its index in the list of objects, by which By::component colours. Ranges are those of the whole
/// structure. Parts are chains.
Coloring color_object(const Structure& structure, std::span<const std::uint32_t> atom, const ColorScheme& scheme,
                      std::size_t object_number);

/// Returns the distance of each point from the mean of all points, by which By::radial colours.
std::vector<double> distances_from_middle(std::span<const glm::dvec3> points);

/// Returns the scale of a scheme that has one. Automatic ranges are the smallest and the largest number, of all frames
/// where these are known; for charges symmetric about 0; for hydrophobicity, rainbow and conservation the ends of their
/// scales. Default maps: charge red-white-blue (negative is red), hydrophobicity blue-white-red, ..., others viridis.
/// Throws like color_atoms.
ColorScale color_scale(const Structure& structure, const ColorScheme& scheme);

}  // namespace meniscus
