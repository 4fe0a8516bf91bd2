// SPDX-License-Identifier: BSD-3-Clause
// Colour options of users: numbers from a file, legends, errors, and names from a hostile file.
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using test::ProgramResult;
using test::TemporaryFolder;

/// Returns CA atoms of three glycines in chains A, B and one with a hostile name, and a water.
std::string molecule(const char* chain = "C") {
  constexpr const char* kLoop =
      "data_x\nloop_\n_atom_site.group_PDB\n_atom_site.id\n_atom_site.type_symbol\n_atom_site.label_atom_id\n"
      "_atom_site.label_comp_id\n_atom_site.label_asym_id\n_atom_site.auth_asym_id\n_atom_site.auth_seq_id\n"
      "_atom_site.Cartn_x\n_atom_site.Cartn_y\n_atom_site.Cartn_z\n_atom_site.B_iso_or_equiv\n";
  return fmt::format(
      "{}ATOM 1 C CA GLY A A 1 0 0 0 10\nATOM 2 C CA GLY B B 1 3 0 0 20\n"
      "HETATM 3 O O HOH D D 1 9 9 9 90\nATOM 4 C CA GLY C {} 1 0 3 0 30\n",
      kLoop, chain);
}

class ColorCommand : public ::testing::Test {
 protected:
  ProgramResult meniscus(std::vector<std::string> arguments) {
    return test::run_program(test::meniscus_program(), arguments);
  }
  ProgramResult render(const std::string& name, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {"render", file_, "-o", path(name), "--size", "300x200", "-q", "--force", "--no-provenance"});
    return meniscus(arguments);
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
  /// Returns the bytes of a picture.
  std::string picture(const std::vector<std::string>& arguments) {
    const ProgramResult result = render("a.png", arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return test::read_bytes(path("a.png"));
  }

  TemporaryFolder folder_;
  std::string file_ = folder_.file("m.cif", molecule());
};

TEST_F(ColorCommand, NumbersFromAFileAreThoseOfTheAtoms) {
  // The file has the numbers of the B-factors, for all atoms of the file or for the used ones.
  const std::string by_b = picture({"--color", "bfactor"});
  EXPECT_EQ(picture({"--color-by-file", folder_.file("all", "10 20 90 30\n")}), by_b);
  EXPECT_EQ(picture({"--color-by-file", folder_.file("used", "10\n20\n30\n")}), by_b);
  EXPECT_EQ(picture({"--color", "file", "--color-by-file", path("used")}), by_b);
  EXPECT_NE(picture({"--color-by-file", folder_.file("gap", "10 ? 30")}), by_b);
  EXPECT_EQ(picture({"--color", "bfactor", "--color-range", "10:30"}), by_b);
  EXPECT_EQ(picture({"--color", "bfactor", "--color-range", "auto"}), by_b);
  EXPECT_NE(picture({"--color", "bfactor", "--map", "magma"}), by_b);
}

TEST_F(ColorCommand, RulesPaintOverTheSchemeWhateverTheOrder) {
  const std::string painted = picture({"--color", "chain", "--color", "chain B=red"});
  EXPECT_NE(painted, picture({"--color", "chain"}));
  EXPECT_EQ(picture({"--color", "chain B=#ff0000", "--color", "chain"}), painted);
  EXPECT_EQ(picture({"--color", "element", "--color", "chain", "--color", "chain B=blue", "--color", "chain B=red"}),
            painted);
  EXPECT_EQ(picture({"--color", "grey", "--color", "chain A=red", "--color", "all=bfactor"}),
            picture({"--color", "bfactor"}));
  EXPECT_EQ(picture({"--color", "all=file", "--color-by-file", folder_.file("numbers", "10 20 30")}),
            picture({"--color", "bfactor"}));
  EXPECT_NE(picture({"--color", "grey", "--color", "chain B=red", "--legend"}),
            picture({"--color", "grey", "--color", "chain B=red"}));
  const ProgramResult typo = meniscus({"render", file_, "-o", path("t.png"), "--color", "chain b=red"});
  EXPECT_EQ(typo.exit_code, 0);
  EXPECT_NE(typo.err.find("'chain b' selects none of the atoms used"), std::string::npos) << typo.err;
}

/// Returns a map from -1 at x = -5 to 1 at x = 5, 20 Å wide along y and z.
std::string linear_map() {
  return "object 1 class gridpositions counts 2 2 2\norigin -5 -10 -10\ndelta 10 0 0\ndelta 0 20 0\ndelta 0 0 20\n"
         "object 2 class gridconnections counts 2 2 2\nobject 3 class array type double rank 0 items 8 data follows\n"
         "-1 -1 -1\n-1 1 1\n1 1\n";
}

TEST_F(ColorCommand, VolumeMapsColorThePointsOfTheSurface) {
  const std::string map = folder_.file("linear.dx", linear_map());
  const std::vector<std::string> plain{"--color-map-file", map, "--color-range", "-1:1"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = plain;
    all.insert(all.end(), more.begin(), more.end());
    return picture(all);
  };
  const std::string shown = with({});
  EXPECT_EQ(with({"--device", "software"}), shown);
  EXPECT_NE(with({"--map-offset", "1.4"}), shown);
  EXPECT_NE(with({"--color", "chain B=green"}), shown);
  // Colours that show numbers have their own light.
  const std::vector<std::string> light{"--ambient",        "0.4", "--ambient-occlusion", "0.5", "--depth-cue", "0",
                                       "--light-strength", "1",   "--specular",          "0"};
  std::vector<std::string> green{"--color", "green"}, all_green{"--color", "all=green"};
  green.insert(green.end(), light.begin(), light.end());
  all_green.insert(all_green.end(), light.begin(), light.end());
  EXPECT_EQ(with(all_green), picture(green));
  EXPECT_NE(with({"--legend", "--color-title", "potential", "--color-unit", "kT/e"}), with({"--legend"}));
  const std::pair<std::vector<std::string>, std::string> refused[] = {
      {{"--color-map-file", map}, "needs --color-range"},
      {{"--color-map-file", map, "--color-range", "-1:1", "--color", "chain"}, "leave out the other --color"},
      {{"--color-map-file", path("nowhere"), "--color-range", "-1:1"}, "cannot be read"},
      {{"--color-map-file", file_, "--color-range", "-1:1"}, "is not one of the volume maps"},
      {{"--map-offset", "1"}, "--color-map-file"},
      {{"--color-map-file", map, "--color-range", "-1:1", "--extent", "visible"}, "--color-map-file"}};
  for (const auto& [arguments, reason] : refused) {
    const ProgramResult result = render("refused.png", arguments);
    EXPECT_NE(result.exit_code, 0) << reason;
    EXPECT_NE(result.err.find(reason), std::string::npos) << result.err;
  }
  const auto exported = [&](const char* format, const char* name) {
    return meniscus({"export", format, file_, "-o", path(name), "--color-map-file", map, "--color-range", "-1:1"})
        .exit_code;
  };
  EXPECT_EQ(exported("povray", "e"), 0);
  EXPECT_TRUE(std::filesystem::exists(path("e") + "/surface_map.df3"));
  const ProgramResult film =
      meniscus({"export", "povray", file_, "-o", path("film"), "--color-map-file", map, "--color-range", "-1:1",
                "--map-offset", "1", "--film-opacity", "--opacity", "0.5"});
  EXPECT_EQ(film.exit_code, 2);
  EXPECT_NE(film.err.find("--map-offset: scenes for POV-Ray cannot combine it with --film-opacity"), std::string::npos)
      << film.err;
  EXPECT_EQ(exported("blender", "e.mns"), 0);
  const ProgramResult mesh =
      meniscus({"export", "ply", file_, "-o", path("m.ply"), "--color-map-file", map, "--color-range", "-1:1", "-q"});
  EXPECT_EQ(mesh.exit_code, 0) << mesh.err;
  EXPECT_NE(test::read_bytes(path("m.ply")).find("property float map_value\n"), std::string::npos);
}

TEST_F(ColorCommand, WhatAMapDoesNotReachIsSaid) {
  // A quarter of the area of a 2 Å sphere at x = 4 lies beyond x = 5. Another sphere lies far from all maps.
  const auto at = [&](const std::string& name, double x) { return folder_.file(name, fmt::format("{} 0 0 2\n", x)); };
  const std::string map = folder_.file("linear.dx", linear_map()), all = folder_.file("all.dx", [] {
    std::string text = linear_map();
    text.replace(text.find("delta 10"), 8, "delta 90");
    return text;
  }());
  const std::vector<std::pair<std::vector<std::string>, std::string>> doors{
      {{"render", "--size", "64x48"}, "reach.png"},
      {{"export", "ply"}, "reach.ply"},
      {{"export", "blender"}, "reach.mns"},
      {{"export", "povray"}, "povray"},
      {{"export", "mitsuba"}, "mitsuba"}};
  for (const auto& [door, name] : doors) {
    const auto call = [&, &door = door, &name = name](const std::string& file, const std::string& of_map) {
      std::vector<std::string> words = door;
      words.insert(words.end(), {file, "-o", path(name), "--force", "--color-map-file", of_map, "--color-range=-1:1"});
      return meniscus(words);
    };
    const ProgramResult part = call(at("part.xyzr", 4.0), map);
    EXPECT_EQ(part.exit_code, 0) << part.err;
    const std::size_t share = part.err.find(" % of the surface lies outside of this map");
    ASSERT_NE(share, std::string::npos) << part.err;
    EXPECT_NEAR(std::stod(part.err.substr(share - 2, 2)), 25.0, 1.0) << part.err;
    const ProgramResult none = call(at("off.xyzr", 40.0), map);
    EXPECT_EQ(none.exit_code, 3) << none.err;
    EXPECT_NE(none.err.find("where no part of the surface lies"), std::string::npos) << none.err;
    const ProgramResult whole = call(at("whole.xyzr", 40.0), all);
    EXPECT_EQ(whole.exit_code, 0) << whole.err;
    EXPECT_EQ(whole.err.find("warning"), std::string::npos) << whole.err;
  }
}

TEST_F(ColorCommand, ChargesThatAMapHasAndTheSurfaceHasNotAreSaid) {
  const std::string map = folder_.file("linear.dx", linear_map());
  const std::string file = folder_.file("m.pqr",
                                        "ATOM 1 CA GLY A 1 0 0 0 0.5 1.7\nATOM 2 HA GLY A 1 1 0 0 0.1 0\n"
                                        "ATOM 3 O HOH W 2 3 0 0 -0.8 1.5\nATOM 4 CA GLY B 3 -3 0 0 0 1.7\n");
  const auto said = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"render", file, "-o", path("c.png"), "--size", "64x48", "--force", "--radii", "file"});
    const ProgramResult result = meniscus(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  };
  const std::vector<std::string> by_map{"--color-map-file", map, "--color-range=-1:1"};
  const auto with = [&](std::vector<std::string> words) {
    words.insert(words.end(), by_map.begin(), by_map.end());
    return said(words);
  };
  EXPECT_NE(with({}).find("1 atom with charges is left out of the surface (1 water atom)"), std::string::npos)
      << with({});
  EXPECT_EQ(with({"--keep-water"}).find("charges"), std::string::npos);
  EXPECT_EQ(said({}).find("charges"), std::string::npos);
  // Chain B has no charge; an atom without a radius lies inside its neighbour.
  EXPECT_EQ(with({"--select", "not chain B", "--keep-water"}).find("charges"), std::string::npos);
  EXPECT_NE(with({"--select", "chain B or water"}).find("(2 not selected)"), std::string::npos);
}

TEST_F(ColorCommand, OurOwnTablesOfAreasColor) {
  ASSERT_EQ(meniscus({"surface", file_, "--csv-residues", path("r.csv"), "--csv", path("a.csv"), "-q"}).exit_code, 0);
  const std::string by_residue = picture({"--color-by-file", path("r.csv"), "--color-column", "sas_area"});
  EXPECT_NE(by_residue, picture({}));
  EXPECT_EQ(picture({"--color-by-file", path("a.csv"), "--color-column", "sas_area"}), by_residue);  // one atom each
  EXPECT_NE(picture({"--color-by-file", path("r.csv"), "--color-column", "sas_area", "--map-file",
                     folder_.file("ramp", "red\nblue\n")}),
            by_residue);
}

TEST_F(ColorCommand, OpacityZeroHidesAsShowDoes) {
  // --show frames the shown atoms, so all pictures use one camera.
  ASSERT_EQ(render("all.png", {"--save-camera", path("camera.json")}).exit_code, 0);
  const auto seen = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--camera", path("camera.json")});
    return picture(arguments);
  };
  const std::string part = seen({"--show", "not chain B"});
  EXPECT_NE(seen({}), part);
  EXPECT_EQ(seen({"--opacity", "chain B=0"}), part);
  EXPECT_EQ(seen({"--opacity", "0", "--opacity", "not chain B=1"}), part);
  EXPECT_EQ(seen({"--opacity", "chain B=0", "--by", "chain"}), seen({"--show", "not chain B", "--by", "chain"}));
  EXPECT_EQ(seen({"--opacity", "chain B=0", "--opacity", "1"}), seen({}));
}

TEST_F(ColorCommand, WhatCannotBeIsRefusedWithItsReason) {
  const std::string five = folder_.file("five", "1 2 3 4 5"), words = folder_.file("words", "1\n2\nred\n"),
                    gone = folder_.file("gone", "nan ? -");
  const struct {
    std::vector<std::string> arguments;
    int exit_code;
    std::string reason;
  } cases[] = {
      {{"--color", "bleu"}, 2, "'bleu' is not one of auto"},
      {{"--color", "file"}, 2, "needs --color-by-file"},
      {{"--color", "chain", "--color-by-file", five}, 2, "leave out the other --color"},
      {{"--map", "magma"}, 2, "is for colours by a number"},
      {{"--color", "chain", "--color-range", "1:2"}, 2, "is for colours by a number"},
      {{"--missing-color", "#102030"}, 2, "is for colours by a number"},
      {{"--color", "bfactor", "--map", "jet"}, 2, "'jet' is not one of viridis"},
      {{"--color", "bfactor", "--color-range", "2:1"}, 2, "lo < hi"},
      {{"--color", "bfactor", "--missing-color", "gery"}, 2, "is not a colour: give a name"},
      {{"--color", "charge"}, 3, "no partial charges"},
      {{"--color", "occupancy"}, 3, "no occupancies"},
      {{"--color-by-file", five}, 3, "holds 5 numbers"},
      {{"--color-by-file", five}, 3, "holds 4 atoms, of which 3 are used"},
      {{"--color-by-file", words}, 3, "words:3: 'red' is not a finite number"},
      {{"--color-by-file", gone}, 3, "all numbers are missing"},
      {{"--color-by-file", path("nowhere")}, 3, "cannot be read"},
      {{"--color", "chain A=bleu"}, 2, "--color: 'bleu' is not one of auto"},
      {{"--color", "chain A and=red"}, 2, "--color: "},
      {{"--color", "kind", "--color", "chain A=red"}, 2, "kind colours patches"},
      {{"--color", "chain A=file"}, 2, "needs --color-by-file"},
      {{"--color", "#102030", "--legend"}, 2, "nothing to explain"},
      {{"--color", "chain A=lipophilicity"}, 2, "'lipophilicity' cannot colour some of the atoms"},
      {{"--color", "lipophilicity", "--extent", "visible"}, 2, "--color lipophilicity needs the complete surface"},
      {{"--color", "relative-accessibility"}, 3, "has no complete amino acids"},
      {{"--color", "relative-accessibility", "--probe", "1.5"}, 2, "is defined for a probe of 1.4 Å"},
      {{"--color", "relative-accessibility", "--surface", "vdw"}, 2, "leave out --probe and --surface vdw"},
      {{"--color", "chain A=relative-accessibility"}, 2, "it colours the whole surface"},
      {{"--object", R"({"representation": "surface", "selection": "all", "color": "lipophilicity"})"},
       2,
       "cannot be lipophilicity"},
      {{"--opacity", "chain A=1.5"}, 2, "'1.5' is not an opacity from 0"},
      {{"--opacity", "chian A=0.5"}, 2, "--opacity: "},
  };
  for (const auto& c : cases) {
    const ProgramResult result = render("refused.png", c.arguments);
    EXPECT_EQ(result.exit_code, c.exit_code) << c.reason;
    EXPECT_NE(result.err.find(c.reason), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(path("refused.png")));
  }
  const ProgramResult small = meniscus({"render", file_, "-o", path("small.png"), "--size", "40x30", "--legend"});
  EXPECT_EQ(small.exit_code, 2);
  EXPECT_NE(small.err.find("does not fit into 40 x 30 pixels"), std::string::npos) << small.err;
}

TEST_F(ColorCommand, NamesOfCssAreReadWhereverAColourIs) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> options{
      {{"--background"}, "@"},
      {{"--color"}, "@"},
      {{"--color"}, "chain B=@"},
      {{"--clip", "depth>0.4", "--cap-color"}, "@"},
      {{"--color-by-file", folder_.file("gap", "10 ? 30"), "--missing-color"}, "@"},
      {{"--color", "bfactor", "--map-file"}, "white\n@\n"},
      {{"--object"}, R"({"representation": "spheres", "selection": "chain B", "color": "@"})"},
  };
  for (const auto& [words, value] : options) {
    const auto with = [&, &words = words, &value = value](const char* color) {
      std::vector<std::string> arguments = words;
      const std::size_t place = value.find('@');
      const std::string filled = value.substr(0, place) + color + value.substr(place + 1);
      arguments.push_back(words.back() == "--map-file" ? folder_.file("ramp", filled) : filled);
      return picture(arguments);
    };
    const std::string by_name = with("slategrey");
    EXPECT_TRUE(by_name == with("#708090")) << words.back() << " " << value;
    EXPECT_TRUE(by_name == with("slategray")) << words.back() << " " << value;
    EXPECT_TRUE(by_name != with("gold")) << words.back() << " " << value;
  }
}

TEST_F(ColorCommand, ConfidenceSaysWhereItIsFromAndDoubtsBFactors) {
  const ProgramResult model = render("m.png", {"--color", "plddt", "--legend"});
  EXPECT_EQ(model.exit_code, 0) << model.err;
  const auto said = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", file_, "-o", path("s.png"), "--size", "64x48", "--force"});
    const ProgramResult result = meniscus(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  };
  EXPECT_NE(said({"--color", "plddt"}).find("pLDDT is that of B-factors"), std::string::npos);
  EXPECT_EQ(said({"--color", "plddt"}).find("warning"), std::string::npos);
  EXPECT_EQ(said({}).find("pLDDT"), std::string::npos);
  file_ = folder_.file("m.pdb",
                       "EXPDTA    X-RAY DIFFRACTION\n"
                       "ATOM      1  CA  GLY A   1       0.000   0.000   0.000  1.00 20.00           C\n"
                       "ATOM      2  CA  GLY B   2       4.000   0.000   0.000  1.00 20.00           C\n");
  for (const char* color : {"plddt", "chain A=plddt"}) {
    const std::string err = said({"--color", color});
    const std::size_t warning = err.find("warning: ");
    ASSERT_NE(warning, std::string::npos) << err;
    EXPECT_NE(err.find("by experiment (X-RAY DIFFRACTION)"), std::string::npos) << err;
    EXPECT_EQ(err.find("warning: ", warning + 1), std::string::npos) << "one line: " << err;
  }
}

TEST_F(ColorCommand, GradesOfConservationComeFromATable) {
  const std::string grades = folder_.file("grades.tsv", "chain\tresid\tgrade\nA\t1\t1\nB\t1\t9\nC\t1\t5\n");
  const std::string shown = picture({"--color", "conservation", "--color-by-file", grades});
  EXPECT_EQ(shown, picture({"--color-by-file", grades, "--map", "consurf", "--color-range", "1:9"}));
  EXPECT_EQ(shown, picture({"--color", "grey", "--color", "all=conservation", "--color-by-file", grades}));
  EXPECT_NE(picture({"--color", "conservation", "--color-by-file", grades, "--legend"}), shown);
  const std::string scores = folder_.file("scores.csv", "chain;resid;score\nA;1;-0,7\nB;1;1,2\nC;1;0\n");
  const ProgramResult refused = render("r.png", {"--color", "conservation", "--color-by-file", scores});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("holds -0.7; --color conservation takes ConSurf's grades"), std::string::npos);
  const ProgramResult without = render("r.png", {"--color", "conservation"});
  EXPECT_EQ(without.exit_code, 2);
  EXPECT_NE(without.err.find("conservation needs --color-by-file"), std::string::npos) << without.err;
}

TEST_F(ColorCommand, RelativeAccessibilityIsThatOfTheTable) {
  file_ = "/usr/share/freesasa/test-data/1ubq.pdb";
  const ProgramResult table = meniscus({"surface", file_, "--csv-residues", path("residues.csv"), "-q"});
  ASSERT_EQ(table.exit_code, 0) << table.err;
  const std::string shown = picture({"--color", "relative-accessibility"});
  // The table is rounded, but steps of colours do not show this.
  EXPECT_EQ(picture({"--color", "relative-accessibility", "--map", "consurf"}),
            picture({"--color-by-file", path("residues.csv"), "--color-column", "relative_sas_area", "--color-range",
                     "0:1", "--map", "consurf"}));
  EXPECT_EQ(shown, picture({"--color", "relative-accessibility", "--surface", "ses", "--color-range", "0:1"}));
  EXPECT_NE(picture({"--color", "relative-accessibility", "--legend"}), shown);
  picture({"--color", "relative-accessibility", "--sticks", "resname LYS", "--spheres", "water and resid 77-90"});
}

TEST_F(ColorCommand, LegendsGoWithEveryScheme) {
  for (const char* scheme : {"element", "chain", "residue", "kind", "component", "bfactor", "hydrophobicity", "index",
                             "secondary", "rainbow", "plddt", "lipophilicity"})
    EXPECT_NE(picture({"--color", scheme, "--legend", "--samples", "1"}),
              picture({"--color", scheme, "--samples", "1"}));
}

TEST_F(ColorCommand, NamesFromTheFileStayOutOfOtherProgramsSource) {
  const std::string name = "x\"}#include*/";
  file_ = folder_.file("hostile.cif", molecule(("'" + name + "'").c_str()));
  const ProgramResult scene = meniscus({"export", "povray", file_, "-o", path("scene"), "--color", "chain", "-q"});
  ASSERT_EQ(scene.exit_code, 0) << scene.err;
  int with_name = 0;
  for (const auto& entry : std::filesystem::directory_iterator(path("scene"))) {
    if (test::read_bytes(entry.path()).find("#include*/") == std::string::npos) continue;
    EXPECT_EQ(entry.path().filename(), "surface_objects.json");
    ++with_name;
  }
  EXPECT_EQ(with_name, 1);  // this proves that the name was read
  EXPECT_EQ(render("legend.png", {"--color", "chain", "--legend"}).exit_code, 0);
}

TEST_F(ColorCommand, SchemesAndMapsAreListedWithTheirSources) {
  const ProgramResult list = meniscus({"colors"});
  EXPECT_EQ(list.exit_code, 0);
  for (const char* word : {"hydrophobicity", "Kyte", "viridis", "cividis", "magma", "CC0", "Okabe", "#808080"})
    EXPECT_NE(list.out.find(word), std::string::npos) << word;
}

}  // namespace
}  // namespace meniscus
