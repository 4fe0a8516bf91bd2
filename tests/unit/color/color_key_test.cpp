// SPDX-License-Identifier: BSD-3-Clause
// Legends against atoms: every colour of an atom that is drawn is explained, and every colour explained is drawn, for
// every pair of schemes.
#include "core/color/color_key.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/color/color_schemes.h"
#include "core/color/named_colors.h"
#include "tests/unit/color/colored_atoms.h"

namespace meniscus {
namespace {

using By = ColorScheme::By;

/// Returns atoms that differ in all that schemes colour by, some without a number: two residues of amino acids in each
/// of three chains, two of them copies, a sugar, and an atom of unknown element.
Structure many_atoms() {
  Structure structure;
  structure.file = "many.pdb";
  const char* const residues[] = {"ASP", "LEU", "LYS", "TRP", "MET", "GLY", "NAG", "UNX"};
  for (std::uint32_t n = 0; n < 32; ++n) {
    Atom& atom = structure.atoms.emplace_back();
    const std::uint32_t residue = n / 4;
    atom.index = n;
    atom.position = glm::dvec3(1.5 * n, n % 3, n % 5);
    atom.residue = residue;
    atom.residue_number = static_cast<std::int32_t>(residue);
    atom.residue_name = residues[residue];
    atom.chain = residue < 3 ? "A" : residue < 6 ? "B" : "C";
    atom.model = residue < 4 ? 1 : 2;
    atom.copy = residue == 7 ? 1 : 0;
    if (atom.copy > 0) atom.chain += "-2";
    atom.kind = residue < 6 ? AtomClass::polymer : AtomClass::ligand;
    const char* const names[] = {"N", "CA", "C", "O"};
    const std::uint8_t elements[] = {7, 6, 6, 8};
    atom.name = names[n % 4];
    atom.element = residue == 7 ? std::uint8_t{0} : n == 17 ? std::uint8_t{16} : elements[n % 4];
    atom.secondary = residue < 2   ? SecondaryStructure::helix
                     : residue < 3 ? SecondaryStructure::strand
                                   : SecondaryStructure::coil;
    if (residue < 7) atom.b_factor = static_cast<float>(30 + 2 * n);
    if (n != 9) atom.charge = n % 2 ? 0.25f : -0.5f;
    if (n != 3) atom.occupancy = n % 2 ? 1.0f : 0.5f;
  }
  structure.report.read = structure.report.used = structure.atoms.size();
  return structure;
}

/// Returns a scheme, with numbers if it needs those of a file, a surface or a run.
ColorScheme ready(const ColorSchemeMetadata& about, const Structure& structure) {
  ColorScheme scheme = parse_color_scheme(about.word).value();
  NumberFile numbers{.path = "numbers"};
  for (std::size_t n = 0; n < structure.atoms.size(); ++n) numbers.numbers.push_back(n == 5 ? kNan : 1.0 + n % 9);
  if (scheme.takes_file() || scheme.is_measured()) scheme.file = numbers;
  return scheme;
}

/// Returns schemes that colour atoms by more than patches, parts and points.
std::vector<ColorScheme> schemes_of_atoms(const Structure& structure) {
  std::vector<ColorScheme> schemes{parse_color_scheme("#123456").value()};
  for (const ColorSchemeMetadata& about : color_schemes())
    if (about.by != By::kind && about.by != By::component && about.by != By::lipophilicity)
      schemes.push_back(ready(about, structure));
  return schemes;
}

/// Returns all colours that a legend of this key shows.
std::vector<glm::vec3> explained(const ColorKey& key) {
  std::vector<glm::vec3> colors;
  for (const ColorKey* const part : key.parts()) {
    for (const ColorClass& entry : part->classes) colors.push_back(entry.color);
    if (!part->scale) continue;
    for (const double number : part->scale->value)
      if (!std::isnan(number)) colors.push_back(part->scale->color(number));
    if (part->scale->missing > 0) colors.push_back(part->scale->missing_color);
  }
  return colors;
}

bool has(const std::vector<glm::vec3>& colors, const glm::vec3& color) {
  return std::ranges::find(colors, color) != colors.end();
}

/// Checks legends both ways for the atoms drawn.
void expect_true(const Structure& structure, const ColorScheme& scheme, const std::vector<bool>& drawn) {
  const ColorKey key = color_key(structure, scheme, {.atoms = drawn});
  const std::vector<glm::vec3> all = color_atoms(structure, scheme).atom, told = explained(key);
  std::vector<glm::vec3> seen;
  for (std::size_t a = 0; a < all.size(); ++a)
    if (drawn.empty() || drawn[a]) seen.push_back(all[a]);
  const bool one_color = std::ranges::all_of(seen, [&](const glm::vec3& color) { return color == seen.front(); });
  if (told.empty() && one_color) return;  // Such a picture needs no legend.
  for (const glm::vec3& color : seen) EXPECT_TRUE(has(told, color)) << hex_color(color) << " is drawn, not explained";
  for (const glm::vec3& color : told) EXPECT_TRUE(has(seen, color)) << hex_color(color) << " is explained, not drawn";
  for (const ColorKey* const part : key.parts())
    if (part->scale) {
      EXPECT_TRUE(std::ranges::any_of(part->scale->value, [](double number) { return !std::isnan(number); }));
    }
}

TEST(ColorKey, OfEveryPairOfSchemesExplainsWhatIsDrawnAndNoMore) {
  const Structure structure = many_atoms();
  std::vector<bool> some(structure.atoms.size());
  for (std::size_t a = 0; a < some.size(); ++a) some[a] = a > 5 && a < 27;
  std::size_t pairs = 0;
  for (const ColorScheme& base : schemes_of_atoms(structure))
    for (const ColorScheme& paint : schemes_of_atoms(structure))
      for (const char* const atoms : {"element C", "chain A", "resname UNX", "all", "chain Z"})
        for (const std::vector<bool>& drawn : {std::vector<bool>{}, some}) {
          SCOPED_TRACE(scheme_word(base) + " with " + atoms + "=" + scheme_word(paint));
          ColorScheme scheme = base;
          scheme.rules = {{parse_selection(atoms), paint}, {parse_selection("name O and chain B"), base}};
          expect_true(structure, scheme, drawn);
          ++pairs;
        }
  EXPECT_EQ(pairs, 26u * 26u * 5u * 2u);
}

TEST(ColorKey, RulesOfASchemeHaveItsTitleAndEntries) {
  ColorScheme carbons = parse_color_scheme("element").value();
  carbons.rules.push_back(parse_color_rule("element C=chain"));
  const ColorKey key = color_key(many_atoms(), carbons);
  const auto names = [](const ColorKey& part) {
    std::vector<std::string> found;
    for (const ColorClass& entry : part.classes) found.push_back(entry.name);
    return found;
  };
  EXPECT_EQ(names(key), (std::vector<std::string>{"N", "O", "S", "unknown"})) << "no carbon has its own colour";
  ASSERT_EQ(key.others.size(), 1u);
  EXPECT_EQ(key.others[0].title, "chain");
  EXPECT_EQ(names(key.others[0]), (std::vector<std::string>{"A", "B", "C"}));
  ColorScheme grey = parse_color_scheme("lightgrey").value();
  grey.rules.push_back(parse_color_rule("chain A=bfactor"));
  const ColorKey with_bar = color_key(many_atoms(), grey);
  EXPECT_EQ(names(with_bar), std::vector<std::string>{"other"});
  ASSERT_EQ(with_bar.others.size(), 1u);
  EXPECT_EQ(with_bar.others[0].scale->title, "B-factor");
  // Names with two colours are distinguished.
  ColorScheme twice = parse_color_scheme("element").value();
  twice.rules.push_back(named_color_rule("chain A=element-cpk:Alpha"));
  EXPECT_EQ(color_key(many_atoms(), twice).others.at(0).title, "element, Alpha");
}

TEST(ColorKey, PatchesAreNotPaintedByRules) {
  ColorScheme kinds = parse_color_scheme("kind").value();
  kinds.rules.push_back(parse_color_rule("chain A=red"));
  EXPECT_EQ(color_key(many_atoms(), kinds).classes.size(), 3u);
  ColorScheme parts = parse_color_scheme("component").value();
  const std::vector<AtomGroup> objects{{"one", {0, 1, 2}}, {"two", {3, 4, 5}}};
  EXPECT_EQ(color_key(many_atoms(), parts, {.objects = objects}).classes.size(), 2u);
  parts.rules.push_back(parse_color_rule("index 3 to 5=red"));
  const ColorKey key = color_key(many_atoms(), parts, {.objects = objects});
  ASSERT_EQ(key.classes.size(), 2u);
  EXPECT_EQ(key.classes[0].name, "one");
  EXPECT_EQ(key.classes[1].name, "index 3 to 5");
}

TEST(ColorKey, OfARunCountsAtomsOfRulesThatMove) {
  ColorScheme near = parse_color_scheme("chain").value();
  near.rules.push_back(parse_color_rule("x > 1000=red"));
  EXPECT_EQ(color_key(many_atoms(), near).classes.size(), 3u);
  EXPECT_EQ(color_key(many_atoms(), near, {.in_a_run = true}).classes.size(), 4u);
}

TEST(ColorConflicts, AreToldOfColoursAndOfThings) {
  const auto red = glm::vec3(1, 0, 0), blue = glm::vec3(0, 0, 1);
  const auto key = [](const char* title, std::vector<ColorClass> classes) { return ColorKey{title, {}, classes, {}}; };
  const auto found = [](const ColorKey& a, const ColorKey& b) {
    const std::vector<ColorKey> keys{a, b};
    return color_conflicts(keys, "panel");
  };
  const ColorKey a = key("chain", {{"A", red}, {"B", blue}});
  EXPECT_EQ(found(a, a), "");
  EXPECT_EQ(found(a, key("chain", {{"B", blue}})), "") << "one of them has less";
  EXPECT_EQ(found(a, key("chain", {{"C", glm::vec3(0.5f)}})), "");
  EXPECT_EQ(found(a, key("chain", {{"A", blue}})),
            "chain 'A' is #ff0000 in panel 1 and #0000ff in panel 2; 1 more colours differ");
  EXPECT_EQ(found(a, key("chain", {{"C", red}})), "#ff0000 is chain 'A' in panel 1 and chain 'C' in panel 2");
  EXPECT_EQ(found(a, key("residue type", {{"acidic", red}})), "") << "each has a legend of its own";
  EXPECT_EQ(found(a, key("", {{"loop", red}})), "#ff0000 is chain 'A' in panel 1 and 'loop' in panel 2");
  EXPECT_EQ(found(key("", {{"other", red}}), key("", {{"other", blue}})), "");
  ColorKey low, high;
  low.scale.emplace().title = high.scale.emplace().title = "B-factor";
  high.scale->range = {5.0, 80.0};
  EXPECT_EQ(found(low, low), "");
  EXPECT_EQ(found(low, high), "the colours of B-factor show 0 to 1 in panel 1, but 5 to 80 in panel 2");
  ColorKey inside = key("element", {});
  inside.others.push_back(key("chain", {{"A", blue}}));
  EXPECT_NE(found(a, inside).find("chain 'A'"), std::string::npos) << "parts of a key count, too";
}

}  // namespace
}  // namespace meniscus
