// SPDX-License-Identifier: BSD-3-Clause
// Colour schemes on a small molecule, and colour maps against the published tables.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "core/color/color_key.h"
#include "core/color/color_schemes.h"
#include "core/color/named_colors.h"
#include "core/structure/element_tables.h"
#include "tests/support/run_program.h"
#include "tests/unit/color/colored_atoms.h"

namespace meniscus {
namespace {

TEST(Colors, WordsAreReadStrictly) {
  for (const char* good :
       {"auto",      "element",   "chain",          "chain-element", "chain-okabe-ito", "residue", "bfactor",
        "occupancy", "charge",    "hydrophobicity", "kind",          "component",       "index",   "atom",
        "file",      "secondary", "rainbow",        "plddt",         "conservation",    "#00ff7F", "#0f7",
        "red"}) {
    EXPECT_TRUE(parse_color_scheme(good)) << good;
  }
  for (const char* bad : {"", "Element", "#ff", "#-ff", "#00ff7g", "#-0ff7f", "#00ff7f0", "Red", "reddish", "#"}) {
    EXPECT_FALSE(parse_color_scheme(bad)) << bad;
  }
  EXPECT_EQ((parse_color_range("-1:2.5")), (std::array<double, 2>{-1.0, 2.5}));
  for (const char* bad : {"", ":", "1", "1:1", "2:1", "1:nan", "1:2:3", "a:b"})
    EXPECT_FALSE(parse_color_range(bad)) << bad;
  for (const ColorMapMetadata& map : color_maps()) EXPECT_EQ(parse_color_map(map.name), map.map);
  for (const char* bad : {"", "Viridis", "jet", "viridis "}) EXPECT_FALSE(parse_color_map(bad)) << bad;
}

TEST(Colors, FixedAndElement) {
  EXPECT_EQ(colored("#ff0080").atom[2], glm::vec3(1.0f, 0.0f, 128.0f / 255.0f));
  const Coloring element = colored("element");
  EXPECT_EQ(element.atom[0], element.atom[3]);
  EXPECT_EQ(element.atom[2], element_color(8));
  EXPECT_FALSE(element.kind);
}

TEST(Colors, ChainsInOrderOfAppearanceDiffer) {
  const Coloring chain = colored("chain");
  EXPECT_EQ(chain.atom[0], chain.atom[1]);
  EXPECT_EQ(chain.atom[0], chain.atom[3]);
  EXPECT_NE(chain.atom[0], chain.atom[2]);
  Structure many;
  for (int n = 0; n < 21; ++n) many.atoms.emplace_back().chain = std::to_string(n);
  const Coloring colors = colored("chain", many);
  for (std::size_t i = 0; i < 21; ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(colors.atom[i], colors.atom[j]) << i << " " << j;
  }
}

TEST(Colors, AChainHasTheColourOfItsPlaceInTheFile) {
  Structure whole = four_atoms(), part = four_atoms();
  whole.chains = part.chains = {"Z", "B", "A"};
  part.atoms.erase(part.atoms.begin() + 2);  // This removes all of B.
  EXPECT_EQ(colored("chain", whole).atom[0], chain_color(2));
  EXPECT_EQ(colored("chain", whole).atom[2], chain_color(1));
  EXPECT_EQ(colored("chain", part).atom[0], chain_color(2));
  EXPECT_EQ(colored("chain-okabe-ito", part).atom[0], categorical_color(2));
  part.atoms[0].chain = "new";  // The file has no such chain.
  EXPECT_EQ(colored("chain", part).atom[0], chain_color(3));
  EXPECT_EQ(color_key(part, scheme("chain")).classes[0].color, chain_color(3));
  EXPECT_EQ(color_key(part, scheme("chain-okabe-ito")).classes[0].color, categorical_color(3));
}

TEST(Colors, AutoIsByChainForPolymersAndByElementForSmallMolecules) {
  Structure small = four_atoms(), protein = small, spheres = small;
  protein.atoms[2].kind = protein.atoms[3].kind = AtomClass::polymer;  // They belong to chains B and A.
  for (Atom& atom : spheres.atoms) atom.element = 0;
  EXPECT_EQ(colored("auto", small).atom, colored("element-cpk", small).atom);
  EXPECT_EQ(colored("auto", protein).atom, colored("chain", protein).atom);
  EXPECT_EQ(colored("auto", spheres).atom, colored("chain", spheres).atom);
  EXPECT_EQ(color_key(small, {}).title, "element") << "it is the default";
  EXPECT_EQ(color_key(protein, {}).title, "chain");
}

TEST(Colors, AutoOfASingleChainRunsAlongIt) {
  Structure structure = four_atoms();
  for (const std::size_t n : {0, 1, 3}) {
    structure.atoms[n].kind = AtomClass::polymer;
    structure.atoms[n].residue = static_cast<std::uint32_t>(n);
  }
  ColorScheme along = scheme("rainbow");
  along.map = ColorMap::pastel;
  const Coloring automatic = colored("auto", structure);
  EXPECT_EQ(automatic.atom, color_atoms(structure, along).atom);
  EXPECT_EQ(automatic.atom[0], mapped_color(ColorMap::pastel, 0.0));
  EXPECT_EQ(automatic.atom[1], mapped_color(ColorMap::pastel, 0.5));
  EXPECT_EQ(automatic.atom[3], mapped_color(ColorMap::pastel, 1.0));
  const ColorKey key = color_key(structure, {});
  ASSERT_TRUE(key.scale);
  EXPECT_EQ(key.scale->title, "place in the chain");
  EXPECT_EQ(key.scale->map, ColorMap::pastel);
  // Copies are several chains. Models may be frames, each of which is coloured as it would be alone.
  structure.instances = {{{0, 1, 2, 3}, {RigidMotion(), RigidMotion()}}};
  EXPECT_EQ(colored("auto", structure).atom, colored("chain", structure).atom);
  structure.instances.clear();
  structure.atoms[3].model = 2;
  EXPECT_EQ(colored("auto", structure).atom, color_atoms(structure, along).atom);
}

TEST(Colors, ChainElementShowsChainsByTheCarbonOfPolymers) {
  Structure structure = four_atoms();  // elements C, N, O, C
  structure.atoms[0].kind = structure.atoms[1].kind = AtomClass::polymer;
  structure.atoms[3].kind = AtomClass::ligand;
  const Coloring coloring = colored("chain-element", structure);
  EXPECT_EQ(coloring.atom, (std::vector<glm::vec3>{chain_color(0), cpk_color(7), cpk_color(8), cpk_color(6)}));
  const ColorKey key = color_key(structure, scheme("chain-element"));
  EXPECT_EQ(key.classes, (std::vector<ColorClass>{{"A", chain_color(0)}}));
  ASSERT_EQ(key.others.size(), 1u);
  EXPECT_EQ(key.others[0].title, "element");
  EXPECT_EQ(key.others[0].classes.size(), 3u);
}

TEST(Colors, CopiesOfAChainKeepItsColorUnlessCopiesAreColored) {
  Structure structure = four_atoms();
  structure.atoms[1].copy = 1;
  structure.atoms[1].chain = "A-2";
  structure.atoms[3].chain = "A-2";  // The file itself gives this name to a chain.
  const Coloring chain = colored("chain", structure), copy = colored("copy", structure);
  EXPECT_EQ(chain.atom[1], chain.atom[0]);
  EXPECT_NE(chain.atom[3], chain.atom[0]);
  EXPECT_EQ(color_key(structure, scheme("chain"), {}).classes.size(), 3u);
  EXPECT_NE(copy.atom[1], copy.atom[0]);
  EXPECT_EQ(copy.atom[3], copy.atom[0]);
  EXPECT_EQ(color_key(structure, scheme("copy"), {}).classes[1].name, "copy 2");
}

TEST(Colors, ResiduesByChemistry) {
  const Coloring residue = colored("residue");
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_NE(residue.atom[i], residue.atom[j]);
  }
}

TEST(Colors, BFactorsSpanTheMapAndMissingOnesAreGrey) {
  const Coloring automatic = colored("bfactor");
  EXPECT_EQ(automatic.atom[0], mapped_color(ColorMap::viridis, 0.0));
  EXPECT_EQ(automatic.atom[1], mapped_color(ColorMap::viridis, 0.5));
  EXPECT_EQ(automatic.atom[2], mapped_color(ColorMap::viridis, 1.0));
  EXPECT_EQ(automatic.atom[3], color_from_hex(0x808080));
  ColorScheme wish = scheme("bfactor");
  wish.range = {{20.0, 40.0}};
  wish.missing = glm::vec3(0.0f, 1.0f, 0.0f);
  wish.map = ColorMap::magma;
  const Coloring ranged = color_atoms(four_atoms(), wish);
  EXPECT_EQ(ranged.atom[0], mapped_color(ColorMap::magma, 0.0));  // below the range: its end
  EXPECT_EQ(ranged.atom[2], mapped_color(ColorMap::magma, 0.5));
  EXPECT_EQ(ranged.atom[3], glm::vec3(0.0f, 1.0f, 0.0f));
}

TEST(Colors, NamesAreThoseOfCss) {
  const std::pair<const char*, std::uint32_t> known[] = {
      {"aliceblue", 0xf0f8ff},     {"black", 0x000000},
      {"darkslategrey", 0x2f4f4f}, {"lightgoldenrodyellow", 0xfafad2},
      {"rebeccapurple", 0x663399}, {"yellowgreen", 0x9acd32},
      {"#00ff7F", 0x00ff7f},       {"#0f7", 0x00ff77}};
  for (const auto& [name, hex] : known) EXPECT_EQ(parse_color(name), color_from_hex(hex)) << name;
  EXPECT_EQ(parse_color("gray"), parse_color("grey"));
  EXPECT_FALSE(parse_color("transparent"));
}

TEST(Colors, RulesPaintTheAtomsMeantAndTheLastCounts) {
  ColorScheme wish = scheme("chain");
  for (const char* rule : {"chain A=red", "b >= 15=#00f", "resname UNX=element"})
    wish.rules.push_back(parse_color_rule(rule));
  const Coloring coloring = color_atoms(four_atoms(), wish);
  const glm::vec3 red(1, 0, 0), blue(0, 0, 1);
  EXPECT_EQ(coloring.atom, (std::vector<glm::vec3>{red, blue, blue, element_color(6)}));
  EXPECT_EQ(coloring.part, colored("chain").part);
  const std::vector<std::uint32_t> two{2, 0};
  EXPECT_EQ(color_object(four_atoms(), two, wish, 0).atom, (std::vector<glm::vec3>{blue, red}));
  const ColorKey key = color_key(four_atoms(), wish, {});
  ASSERT_EQ(key.classes.size(), 2u);  // No atom has the colour of its chain.
  EXPECT_EQ(key.classes[0].name, "chain A");
  EXPECT_EQ(key.classes[1].name, "b >= 15");
  EXPECT_EQ(key.classes[1].color, blue);
  EXPECT_EQ(key.others.at(0).title, "element");
  EXPECT_TRUE(rules_without_atoms(four_atoms(), wish).empty());
  wish.rules.push_back(parse_color_rule("chain Z=red"));
  EXPECT_EQ(rules_without_atoms(four_atoms(), wish), std::vector<std::string>{"chain Z"});
  EXPECT_EQ(color_atoms(four_atoms(), wish).atom, coloring.atom);
  Structure with_sticks = four_atoms();
  with_sticks.extra_atoms.push_back(with_sticks.atoms.front());
  with_sticks.extra_atoms.front().chain = "Z";
  EXPECT_TRUE(rules_without_atoms(with_sticks, wish).empty());
}

TEST(Colors, RulesHaveNamesAndWhatTheyLeaveIsOther) {
  ColorScheme wish = scheme("grey");
  for (const char* text : {"chain A=red:Gαs = A", "b >= 15=#0000ff"}) {
    wish.rules.push_back(named_color_rule(text));
    EXPECT_EQ(named_color_rule(color_rule_text(wish.rules.back())).name, wish.rules.back().name);
  }
  EXPECT_EQ(color_rule_text(wish.rules.front()), "chain A=#ff0000:Gαs = A");
  const auto names = [&] {
    std::vector<std::string> found;
    for (const ColorClass& entry : color_key(four_atoms(), wish, {}).classes) found.push_back(entry.name);
    return found;
  };
  EXPECT_EQ(names(), (std::vector<std::string>{"Gαs = A", "b >= 15"})) << "nothing is left";
  wish.rules.erase(wish.rules.begin());
  EXPECT_EQ(names(), (std::vector<std::string>{"b >= 15", "other"}));
  EXPECT_EQ(color_key(four_atoms(), wish, {}).classes.back().color, color_from_hex(0x808080));
  wish.rules.push_back(named_color_rule("all=white"));
  EXPECT_EQ(names(), std::vector<std::string>{"all"}) << "nothing else is left";
  EXPECT_NE(complaint([] { named_color_rule("chain A=red:"); }).find("no name"), std::string::npos);
  EXPECT_NE(complaint([] { named_color_rule("chain A=crimsom:x"); }).find("'crimsom' is not one of"),
            std::string::npos);
}

TEST(Colors, RulesByANumberTakeTheMapAndTheRange) {
  ColorScheme wish = scheme("grey");
  wish.rules.push_back(parse_color_rule("chain A=bfactor"));
  wish.range = {{0.0, 20.0}};
  wish.map = ColorMap::magma;
  EXPECT_TRUE(wish.uses_scale() && !wish.has_scale() && !wish.uses_file());
  wish.share_scale();
  const Coloring coloring = color_atoms(four_atoms(), wish);
  EXPECT_EQ(coloring.atom[0], mapped_color(ColorMap::magma, 0.5));
  EXPECT_EQ(coloring.atom[1], mapped_color(ColorMap::magma, 1.0));
  EXPECT_EQ(coloring.atom[2], color_from_hex(0x808080));
  EXPECT_EQ(coloring.atom[3], default_missing_color(ColorMap::magma));
}

TEST(Colors, RulesOfWhatAtomsHaveNotAreRefused) {
  const std::pair<const char*, const char*> reasons[] = {{"chain A=crimsom", "'crimsom' is not one of auto"},
                                                         {"chain A=", "'' is not one of auto"},
                                                         {"b>=20", "'20' is not one of auto"},
                                                         {"chain A=kind", "cannot colour some of the atoms"},
                                                         {"chain A=component", "cannot colour some of the atoms"},
                                                         {"chian A=red", "chian"}};
  for (const auto& [rule, reason] : reasons) {
    const std::string said = complaint([&, rule = rule] { parse_color_rule(rule); });
    EXPECT_NE(said.find(reason), std::string::npos) << rule << ": " << said;
  }
}

TEST(Colors, ElementsArePalerThanModels) {
  EXPECT_EQ(colored("element-cpk").atom[0], color_from_hex(0x9a9a9a));
  const glm::vec3 carbon = colored("element").atom[0];
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(carbon[c], 0xc8 / 255.0f, 0.5f / 255.0f);
  EXPECT_EQ(color_key(four_atoms(), scheme("element-cpk"), {}).title, "element");
}

TEST(Colors, RadialIsTheDistanceFromTheMiddle) {
  Structure structure = four_atoms();
  const double x[] = {-3.0, -1.0, 1.0, 3.0};
  for (std::size_t a = 0; a < 4; ++a) structure.atoms[a].position = {5.0 + x[a], 7.0, -2.0};
  const ColorScale scale = color_scale(structure, scheme("radial"));
  for (std::size_t a = 0; a < 4; ++a) EXPECT_NEAR(scale.value[a], std::abs(x[a]), 1e-12);
  EXPECT_EQ(scale.unit, "Å");
}

TEST(Colors, ConsurfHasItsNineColors) {
  const std::uint32_t grades[] = {0x10c8d1, 0x8cffff, 0xd7ffff, 0xeaffff, 0xffffff,
                                  0xfcedf4, 0xfac9de, 0xf07dab, 0xa02560};
  for (int n = 0; n < 9; ++n) EXPECT_EQ(mapped_color(ColorMap::consurf, n / 8.0), color_from_hex(grades[n]));
}

TEST(Colors, MapsOfOnesOwn) {
  const test::TemporaryFolder folder;
  const glm::vec3 red(1, 0, 0), white(1), blue(0, 0, 1);
  for (const char* text : {"red\nwhite # half way\n#00f\n", "-1 red\n0 #fff\n1 blue\n", "-1,red\n0,white\n1,blue\n",
                           "[\"red\", \"#ffffff\", \"blue\"]", "[[0, \"red\"], [2, \"white\"], [4, \"blue\"]]"}) {
    const ColorRamp ramp = read_color_ramp(folder.file("ramp", text));
    EXPECT_EQ(ramp.color(-1.0), red) << text;
    EXPECT_EQ(ramp.color(0.25), 0.5f * (red + white)) << text;
    EXPECT_EQ(ramp.color(0.5), white) << text;
    EXPECT_EQ(ramp.color(1.0), blue) << text;
  }
  EXPECT_EQ(read_color_ramp(folder.file("ramp", "0 red\n1 white\n4 blue\n")).color(0.25), white);
  const std::pair<const char*, const char*> faults[] = {{"red\nbleu\n", "ramp:2: 'bleu' is not a colour"},
                                                        {"red\n", "holds 1 colours"},
                                                        {"0 red\nblue\n", "ramp:2: some colours have a position"},
                                                        {"1 red\n1 blue\n", "ramp:2: the position 1 does not follow 1"},
                                                        {"[\"red\", 7]", "entry 2 is neither"},
                                                        {"[\"red\"", "is not valid JSON"},
                                                        {"a red blue\n", "ramp:1: "}};
  for (const auto& [text, reason] : faults) {
    const std::string said = complaint([&, text = text] { read_color_ramp(folder.file("ramp", text)); });
    EXPECT_NE(said.find(reason), std::string::npos) << text << ": " << said;
  }
  ColorScheme wish = scheme("bfactor");
  wish.own_map = std::make_shared<ColorRamp>(ColorRamp{{0.0, 1.0}, {red, blue}});
  EXPECT_EQ(color_atoms(four_atoms(), wish).atom[1], 0.5f * (red + blue));
}

TEST(Colors, OpacitiesGoToTheAtomsMeantAndTheLastCounts) {
  EXPECT_TRUE(colored("chain").opacity.empty());
  ColorScheme wish = scheme("chain");
  for (const char* rule : {"0.5", "chain A=0.25", "resname LYS or b >= 30=1", "index 3=0"})
    wish.opacities.push_back(parse_opacity_rule(rule));
  const Coloring coloring = color_atoms(four_atoms(), wish);
  EXPECT_EQ(coloring.opacity, (std::vector<float>{0.25f, 1.0f, 1.0f, 0.0f}));
  EXPECT_TRUE(coloring.shows(0) && coloring.shows(1) && !coloring.shows(3));
  EXPECT_TRUE(coloring.hides_some() && coloring.is_translucent());
  const std::vector<std::uint32_t> last_first{3, 0};
  EXPECT_EQ(color_object(four_atoms(), last_first, wish, 0).opacity, (std::vector<float>{0.0f, 0.25f}));
  wish.opacities = {parse_opacity_rule("chain B=0.5"), parse_opacity_rule("1")};
  const Coloring opaque = color_atoms(four_atoms(), wish);
  EXPECT_FALSE(opaque.hides_some() || opaque.is_translucent());
}

TEST(Colors, OpacitiesOutsideZeroToOneAreRefused) {
  for (const char* bad : {"", "=", "1.1", "chain A=-0.1", "chain A=nan", "chain A=0.5x", "chain A"})
    EXPECT_NE(complaint([&] { parse_opacity_rule(bad); }).find("is not an opacity from 0 (hidden) to 1"),
              std::string::npos)
        << bad;
  EXPECT_THROW(parse_opacity_rule("=0.5"), SelectionError);
  EXPECT_THROW(parse_opacity_rule("b>=0.5"), SelectionError);
}

TEST(Colors, WithoutAnyNumberTheReasonIsNamed) {
  Structure none = four_atoms();
  for (Atom& atom : none.atoms) {
    atom.b_factor = atom.occupancy = atom.charge = kNan;
    atom.residue_name = "HOH";
  }
  const std::pair<const char*, const char*> reasons[] = {{"bfactor", "no B-factors"},
                                                         {"occupancy", "no occupancies"},
                                                         {"charge", "no partial charges to colour by; PQR"},
                                                         {"hydrophobicity", "no amino acids"}};
  for (const auto& [word, reason] : reasons) {
    const std::string said = complaint([&, word = word] { colored(word, none); });
    EXPECT_NE(said.find(reason), std::string::npos) << word << ": " << said;
  }
  ColorScheme wish = scheme("file");
  wish.file = {"numbers", {NAN, NAN, NAN, NAN}};
  EXPECT_EQ(complaint([&] { color_atoms(none, wish); }),
            "numbers: all numbers are missing; there is nothing to colour by");
}

TEST(Colors, OneNumberForAllIsTheMiddleOfTheMap) {
  EXPECT_EQ(colored("occupancy").atom[2], mapped_color(ColorMap::viridis, 0.5));
  Structure uncharged = four_atoms();
  for (Atom& atom : uncharged.atoms) atom.charge = 0.0f;
  EXPECT_EQ(colored("charge", uncharged).atom[0], glm::vec3(1.0f));  // white, not an end of the map
}

TEST(Colors, ChargesAreSymmetricAndNegativeIsRed) {
  const ColorScale scale = color_scale(four_atoms(), scheme("charge"));
  EXPECT_EQ(scale.range, (std::array<double, 2>{-0.5, 0.5}));
  EXPECT_EQ(scale.unit, "e");
  EXPECT_EQ(scale.missing, 1u);
  const Coloring charge = colored("charge");
  EXPECT_EQ(charge.atom[0], 0.5f * color_from_hex(0xd2322a) + glm::vec3(0.5f));
  EXPECT_EQ(charge.atom[1], color_from_hex(0x2a4fd7));
  EXPECT_EQ(charge.atom[2], color_from_hex(0x808080));
  EXPECT_EQ(charge.atom[3], glm::vec3(1.0f));
}

TEST(Colors, ChargesAreSymmetricAboutZeroWhicheverSignIsLarger) {
  Structure anion = four_atoms();
  for (Atom& atom : anion.atoms) atom.charge = -atom.charge;
  EXPECT_EQ(color_scale(anion, scheme("charge")).range, (std::array<double, 2>{-0.5, 0.5}));
  EXPECT_EQ(colored("charge", anion).atom[1], color_from_hex(0xd2322a));
}

TEST(Colors, HydrophobicityIsThatOfKyteAndDoolittle) {
  const std::pair<const char*, double> table[] = {
      {"ILE", 4.5},  {"VAL", 4.2},  {"LEU", 3.8},  {"PHE", 2.8},  {"CYS", 2.5},  {"MET", 1.9},
      {"ALA", 1.8},  {"GLY", -0.4}, {"THR", -0.7}, {"SER", -0.8}, {"TRP", -0.9}, {"TYR", -1.3},
      {"PRO", -1.6}, {"HIS", -3.2}, {"GLU", -3.5}, {"GLN", -3.5}, {"ASP", -3.5}, {"ASN", -3.5},
      {"LYS", -3.9}, {"ARG", -4.5}, {"MSE", 1.9},  {"HID", -3.2}, {"CYX", 2.5}};
  for (const auto& [name, value] : table) EXPECT_EQ(hydropathy(name), value) << name;
  for (const char* name : {"", "UNX", "HOH", "A", "I", "ILE VAL"}) EXPECT_TRUE(std::isnan(hydropathy(name))) << name;
  const ColorScale scale = color_scale(four_atoms(), scheme("hydrophobicity"));
  EXPECT_EQ(scale.range, (std::array<double, 2>{-4.5, 4.5}));
  EXPECT_NE(scale.title.find("Kyte & Doolittle"), std::string::npos);
  EXPECT_EQ(scale.color(-4.5), color_from_hex(0x2a4fd7));
  EXPECT_EQ(scale.missing, 1u);
}

TEST(Colors, MapsAreThePublishedOnes) {
  // Rows 0, 128 and 255 of the tables in matplotlib 3.6; of blue-white-red our own ends.
  const std::pair<ColorMap, std::array<glm::dvec3, 3>> published[] = {
      {ColorMap::viridis,
       {{{0.267004, 0.004874, 0.329415}, {0.127568, 0.566949, 0.550556}, {0.993248, 0.906157, 0.143936}}}},
      {ColorMap::cividis,
       {{{0.0, 0.135112, 0.304751}, {0.488697, 0.485318, 0.471008}, {0.995737, 0.909344, 0.217772}}}},
      {ColorMap::magma,
       {{{0.001462, 0.000466, 0.013866}, {0.716387, 0.214982, 0.47529}, {0.987053, 0.991438, 0.749504}}}},
      {ColorMap::blue_white_red, {{{0.1647, 0.3098, 0.8431}, {0.9993, 0.9969, 0.9967}, {0.8235, 0.1961, 0.1647}}}},
  };
  for (const auto& [map, rows] : published) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 color(mapped_color(map, std::array<double, 3>{0.0, 128.0 / 255.0, 1.0}[k]));
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(color[c], rows[k][c], 0.004) << map_name(map) << " " << k << " " << c;
    }
    EXPECT_EQ(mapped_color(map, -3.0), mapped_color(map, 0.0));
    EXPECT_EQ(mapped_color(map, 7.0), mapped_color(map, 1.0));
    for (int n = 0; n <= 64; ++n)
      EXPECT_GT(glm::distance(mapped_color(map, n / 64.0), default_missing_color(map)), 0.2f) << map_name(map) << n;
  }
  EXPECT_EQ(mapped_color(ColorMap::red_white_blue, 0.25), mapped_color(ColorMap::blue_white_red, 0.75));
}

TEST(Colors, TheCategoricalMapGivesEachNumberAColorOfItsOwn) {
  ColorScheme wish = scheme("file");
  wish.map = ColorMap::categorical;
  wish.file = {"clusters", {3.0, -1.0, 3.0, NAN}};
  const Coloring coloring = color_atoms(four_atoms(), wish);
  EXPECT_EQ(coloring.atom[1], categorical_color(0));
  EXPECT_EQ(coloring.atom[0], categorical_color(1));
  EXPECT_EQ(coloring.atom[2], categorical_color(1));
  EXPECT_EQ(coloring.atom[3], color_from_hex(0x808080));
  Structure many = four_atoms();
  many.atoms.resize(22);
  wish.file.numbers.clear();
  for (int n = 0; n < 22; ++n) wish.file.numbers.push_back(n);
  EXPECT_EQ(complaint([&] { color_atoms(many, wish); }),
            "four: has 22 different numbers, but the categorical map has 21 colours; choose another --map");
}

TEST(Colors, KindAndOrder) {
  const Coloring kind = colored("kind");
  ASSERT_TRUE(kind.kind);
  EXPECT_NE((*kind.kind)[0], (*kind.kind)[1]);
  EXPECT_EQ(kind.atom.size(), 4u);
  const Coloring order = colored("atom");
  EXPECT_EQ(order.atom.front(), mapped_color(ColorMap::viridis, 0.0));
  EXPECT_EQ(order.atom.back(), mapped_color(ColorMap::viridis, 1.0));
}

TEST(Colors, AnObjectHasTheColorsOfTheWholeMolecule) {
  const Structure structure = four_atoms();
  const std::vector<std::uint32_t> last{2, 3};
  for (const char* word : {"element", "chain", "residue", "bfactor", "charge", "index", "#102030"}) {
    const Coloring whole = colored(word), part = color_object(structure, last, scheme(word), 1);
    ASSERT_EQ(part.atom.size(), 2u);
    EXPECT_EQ(part.atom[0], whole.atom[2]) << word;
    EXPECT_EQ(part.atom[1], whole.atom[3]) << word;
  }
  EXPECT_TRUE(color_object(structure, last, scheme("kind"), 1).kind);
  EXPECT_EQ(color_object(structure, last, scheme("component"), 3).atom[1], categorical_color(3));
}

TEST(Colors, TheKeyNamesWhatOccurs) {
  const Structure structure = four_atoms();
  const ColorKey chain = color_key(structure, scheme("chain"), {});
  ASSERT_EQ(chain.classes.size(), 2u);
  EXPECT_EQ(chain.classes[1].name, "B");
  EXPECT_EQ(chain.classes[1].color, colored("chain").atom[2]);
  for (const char* word : {"element", "residue"}) {
    const ColorKey key = color_key(structure, scheme(word), {});
    const Coloring coloring = colored(word);
    for (const glm::vec3& color : coloring.atom)
      EXPECT_TRUE(std::ranges::any_of(key.classes, [&](const ColorClass& c) { return c.color == color; })) << word;
  }
  EXPECT_EQ(color_key(structure, scheme("element"), {}).classes[0].name, "C");
  EXPECT_EQ(color_key(structure, scheme("kind"), {}).classes.size(), 3u);
  const std::vector<AtomGroup> objects{{"one", {0}}, {"two", {1}}};
  EXPECT_EQ(color_key(structure, scheme("component"), {.objects = objects}).classes[1].color, categorical_color(1));
  EXPECT_EQ(color_key(structure, scheme("bfactor"), {}).scale->unit, "Å²");
  EXPECT_TRUE(color_key(structure, scheme("#000000"), {}).classes.empty());
}

}  // namespace
}  // namespace meniscus
