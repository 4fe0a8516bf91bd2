// SPDX-License-Identifier: BSD-3-Clause
// Messages of the program about unknown words, and its assumptions where words are missing.
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <utility>

#include <gtest/gtest.h>

#include "core/base/version.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using test::ProgramResult;
using test::TemporaryFolder;

class Words : public ::testing::Test {
 protected:
  ProgramResult says(const std::vector<std::string>& words) {
    return test::run_program(test::meniscus_program(), words);
  }
  std::string fault(std::vector<std::string> options) {
    options.insert(options.begin(), {"render", molecule_, "-o", (folder_.path() / "a.png").string()});
    const ProgramResult result = says(options);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    return result.err;
  }

  TemporaryFolder folder_;
  std::string molecule_ = folder_.file("two.xyzr", "0 0 0 1.7\n2.5 0.3 0.1 1.5\n");
};

TEST_F(Words, UnknownOptionsAreNamedInTheirOrderWithTheOneThatWasMeant) {
  const std::pair<std::vector<std::string>, std::string> cases[] = {
      {{"--colour", "red"}, "meniscus render has no option '--colour'; did you mean --color?"},
      {{"--colour=red"}, "meniscus render has no option '--colour'; did you mean --color?"},
      {{"--bg", "white"}, "meniscus render has no option '--bg'; did you mean --background?"},
      {{"--ao", "1"}, "meniscus render has no option '--ao'; did you mean --ambient-occlusion?"},
      {{"--zoom", "ligand"}, "meniscus render has no option '--zoom'; did you mean --zoom-to?"},
      {{"--ray", "800"}, "meniscus render has no option '--ray'; did you mean --size?"},
      {{"--png", "b.png"}, "meniscus render has no option '--png'; did you mean --output?"},
      {{"--bg-colour", "grey"}, "meniscus render has no option '--bg-colour'; did you mean --background?"},
      {{"--rotate", "y90"}, "meniscus render has no option '--rotate'; did you mean --turn?"},
      {{"--backgroud", "white"}, "meniscus render has no option '--backgroud'; did you mean --background?"},
      {{"--quite"}, "meniscus render has no option '--quite'; did you mean --quiet?"},
      {{"--turnt", "1"}, "meniscus render has no option '--turnt'; did you mean --turntable?"},
      {{"--first", "--second"}, "meniscus render has no option '--first'; see"},
      {{"--wholly-other", "x"}, "meniscus render has no option '--wholly-other'; see"},
      {{"--samples", "0"}, "--samples"},
  };
  for (const auto& [options, sentence] : cases) {
    const std::string said = fault(options);
    EXPECT_NE(said.find(sentence), std::string::npos) << said;
    EXPECT_TRUE(said.ends_with("; see meniscus render --help\n")) << said;
  }
  const std::string below = says({"export", "ply", molecule_, "-o", "a.ply", "--colour", "chain"}).err;
  EXPECT_EQ(below,
            "meniscus: error: meniscus export ply has no option '--colour'; did you mean --color?; see meniscus export "
            "ply --help\n");
}

TEST_F(Words, UnknownCommandsAndMissingFilesAreToldApart) {
  EXPECT_EQ(says({"rendr", molecule_}).exit_code, 2);
  EXPECT_NE(says({"rendr", molecule_}).err.find("'rendr' is not a command (did you mean render?) and not a file"),
            std::string::npos);
  EXPECT_NE(says({"nowhere.pdb"})
                .err.find("'nowhere.pdb' is not a command and not a file; the commands are surface, "
                          "pockets, render"),
            std::string::npos);
}

TEST_F(Words, ACodeOfThePdbIsNotAFile) {
  const std::string advice = "; 9zzz is a PDB code, not a file; download https://files.rcsb.org/download/9zzz.cif.gz";
  EXPECT_NE(says({"9zzz"}).err.find("'9zzz' is not a command" + advice), std::string::npos) << says({"9zzz"}).err;
  const ProgramResult render = says({"render", "9zzz", "-o", (folder_.path() / "z.png").string()});
  EXPECT_EQ(render.exit_code, 3);
  EXPECT_NE(render.err.find("9zzz: cannot be read: No such file or directory" + advice), std::string::npos)
      << render.err;
  const ProgramResult other = says({"surface", "9zzz.pdb"});
  EXPECT_EQ(other.err.find("PDB code"), std::string::npos) << other.err;
}

TEST_F(Words, ABackgroundMayHaveAnyNameOfAColour) {
  const auto picture = [&](const std::string& color) {
    const std::string output = (folder_.path() / (color + ".png")).string();
    const ProgramResult result = says({"render", molecule_, "-o", output, "--size", "40x30", "--samples", "1",
                                       "--no-provenance", "--force", "--background", color});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return test::read_bytes(output);
  };
  EXPECT_EQ(picture("grey"), picture("gray"));
  EXPECT_EQ(picture("grey"), picture("#808080"));
  EXPECT_NE(picture("white"), picture("gainsboro"));
  EXPECT_NE(fault({"--background", "plaid"}).find("'plaid' is neither transparent nor a colour: give a name"),
            std::string::npos);
}

TEST_F(Words, TheLastOfARepeatedOptionCounts) {
  const auto picture = [&](std::vector<std::string> options) {
    const std::string path = (folder_.path() / "p.png").string();
    options.insert(options.begin(),
                   {"render", molecule_, "-o", path, "--force", "-q", "--size", "40x30", "--no-provenance"});
    const ProgramResult result = says(options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return test::read_bytes(path);
  };
  const std::string kind = picture({"--color", "kind", "--light", "1,0,0.5"});
  EXPECT_EQ(picture({"--color", "#ff0000", "--light", "0,1,0", "--color", "kind", "--light", "1,0,0.5"}), kind);
  EXPECT_NE(picture({"--color", "kind", "--light", "1,0,0.5", "--color", "#ff0000"}), kind);
  // Options that add up still do.
  EXPECT_NE(picture({"--turn", "y40", "--turn", "x30"}), picture({"--turn", "x30"}));
}

TEST_F(Words, APictureNeedsNoNameAndNoCommand) {
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path());
  const ProgramResult first = says({"two.xyzr", "--size", "40x30"});
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_NE(first.err.find("the picture goes to two.png"), std::string::npos) << first.err;
  const std::string bytes = test::read_bytes((folder_.path() / "two.png").string());
  EXPECT_EQ(says({"render", "two.xyzr", "--size", "40x30"}).exit_code, 6);  // the file exists
  EXPECT_EQ(says({"render", "two.xyzr", "--size", "40x30", "--force"}).exit_code, 0);
  EXPECT_EQ(test::read_bytes((folder_.path() / "two.png").string()), bytes);
  EXPECT_EQ(says({"render", "two.xyzr", "--frames", "all"}).exit_code, 2);
  EXPECT_EQ(says({"render", "-"}).exit_code, 2);
  EXPECT_EQ(says({"-"}).err, says({"render", "-"}).err);  // - is standard input, which gives no name
  EXPECT_NE(says({"-"}).err.find("-o is missing: name the picture"), std::string::npos);
  std::filesystem::current_path(here);
}

TEST_F(Words, HelpBeginsWithThePictureAndFitsTwoScreens) {
  const std::string help = says({"render", "--help"}).out, all = says({"render", "--help-all"}).out;
  EXPECT_LE(std::ranges::count(help, '\n'), 100);
  EXPECT_LT(help.find("--output"), help.find("--select"));
  EXPECT_LT(help.find("--color "), help.find("--select"));
  EXPECT_LT(help.find("--size"), help.find("--probe"));
  EXPECT_EQ(help.find("--shininess"), std::string::npos);
  EXPECT_EQ(help.find("--radii-file"), std::string::npos);
  EXPECT_NE(help.find("meniscus render --help-all"), std::string::npos) << help;
  for (const char* command : {"surface", "pockets", "preview"})
    EXPECT_LE(std::ranges::count(says({command, "--help"}).out, '\n'), 100) << command;
  for (const char* option : {"--superpose", "--radii-file", "--assembly", "--size", "--output"})
    EXPECT_NE(all.find(option), std::string::npos) << option;
}

TEST_F(Words, HelpShowsPagesOfTheManual) {
  EXPECT_NE(says({"help"}).out.find("figures"), std::string::npos);
  EXPECT_TRUE(says({"help", "figures"}).out.starts_with("# ")) << says({"help", "figures"}).out.substr(0, 80);
  // help shows the page of a command that has one, with the place of its options, and otherwise the command's help.
  const std::string pockets = says({"help", "pockets"}).out;
  EXPECT_TRUE(pockets.starts_with("# ")) << pockets.substr(0, 80);
  EXPECT_TRUE(pockets.ends_with("The options of the command: meniscus pockets --help\n"));
  EXPECT_NE(says({"help", "surface"}).out.find("Usage: meniscus surface"), std::string::npos);
  const std::string scenes = says({"help", "scenes"}).out;
  EXPECT_NE(scenes.find("## What it looks like"), std::string::npos);
  EXPECT_NE(scenes.find("--silhouettes"), std::string::npos);
  const ProgramResult wrong = says({"help", "figurs"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("did you mean figures?"), std::string::npos) << wrong.err;
}

/// Returns the first two answers of each kind: commands, pages of the manual, options.
std::string first_answers(const std::string& help) {
  std::istringstream lines(help);
  std::string line, first;
  for (int count = 0; std::getline(lines, line);) {
    if (!line.starts_with(' ')) count = 0;
    if (line.starts_with("  meniscus ")) ++count;
    if (count <= 2) first += line + "\n";
  }
  return first;
}

TEST_F(Words, HelpIsSearchedByTheWordsOfUsers) {
  const std::pair<const char*, const char*> cases[] = {
      {"movie", "meniscus film "},
      {"gromacs", "--trajectory"},
      {"stl", "export mesh"},
      {"sasa", "--surface"},
      {"apbs", "--color-map-file"},
      {"charge", "--color"},
      {"overwrite", "--force"},
      {"blur", "--motion-blur"},
      {"3d print", "export mesh"},
      {"powerpoint", "help labels"},
      {"jupyter", "help notebooks"},
      {"slurm", "meniscus farm"},
      {"hydrogen bond", "--hydrogen-bonds"},
      {"antialias", "--samples"},
      {"fog", "--depth-cue"},
      {"rotate", "--turntable"},
      {"gif", "meniscus film "},
      {"mp4", "meniscus film "},
      {"tunnel", "meniscus pockets"},
      {"void", "cavit"},
      {"obj", "export mesh"},
      {"gltf", "export mesh"},
      {"docking", "help ligands"},
      {"namd", "--trajectory"},
      {"amber", "help trajectories"},
      {"multimer", "--assembly"},
      {"contact", "help interfaces"},
      {"crop", "--margin"},
      {"dpi", "help journals"},
      {"quality", "--samples"},
      {"cartoon", "--tube"},
      {"licorice", "--sticks"},
      {"cluster", "meniscus farm"},
      {"plddt", "help alphafold"},
      {"conservation", "help colors"},
      {"scale bar", "--scale-bar"},
      {"legend", "--legend"},
      {"nucleotide bases", "--bases"},
      {"alpha", "--opacity"},
      {"journal", "help journals"},
      {"spin", "--turntable"},
      {"glycan", "--glycans"},
      {"cavity", "help pockets"},
      {"volume", "meniscus surface"},
      {"pocket", "meniscus pockets"},
      {"interface", "help interfaces"},
      {"ligand", "help ligands"},
      {"rainbow", "help colors"},
      {"transparent", "--opacity"},
      {"outline", "--silhouettes"},
      {"black and white", "help figures"},
      {"resume", "--resume"},
      {"headless", "help commands"},
      {"docker", "help farm"},
      {"python", "help numbers-in-python"},
      {"povray", "meniscus export povray"},
      {"usd", "help studios"},
      {"trajectory", "help trajectories"},
      {"pbc", "--whole"},
      {"unit cell", "help assemblies"},
      {"assembly", "help capsids"},
      {"b-factor", "--color"},
      {"hydrophobic", "help patches"},
      {"label", "help labels"},
      {"fetch", "help first-figure"},
      {"supercomputer", "meniscus farm"},
      {"cuda", "--device"},
      {"license", "help platforms"},
  };
  for (const auto& [word, found] : cases) {
    const ProgramResult result = says({"help", word});
    EXPECT_EQ(result.exit_code, 0) << word << ": " << result.err;
    EXPECT_NE(first_answers(result.out).find(found), std::string::npos) << word << ": " << result.out;
  }
}

TEST_F(Words, CitesThePaperToo) {
  const std::string cited = says({"--cite"}).out;
  EXPECT_NE(cited.find("Krone, Michael"), std::string::npos) << cited;
  EXPECT_NE(cited.find(MENISCUS_VERSION), std::string::npos) << cited;
}

TEST_F(Words, AWrongChainIsToldWithThoseThatAreThere) {
  const std::string chains =
      folder_.file("ab.pdb",
                   "ATOM      1  C   ALA A   1       0.000   0.000   0.000  1.00  0.00           C\n"
                   "ATOM      2  C   ALA B   1       9.000   0.000   0.000  1.00  0.00           C\n");
  const auto said = [&](const std::string& option, const std::string& expression) {
    const ProgramResult result =
        says({"render", chains, "-o", (folder_.path() / "c.png").string(), option, expression});
    EXPECT_NE(result.exit_code, 0);
    return result.err;
  };
  EXPECT_NE(said("--select", "chain a").find("there is no chain 'a', only A, B"), std::string::npos);
  EXPECT_NE(said("--show", "chain b").find("there is no chain 'b', only A, B"), std::string::npos);
  EXPECT_NE(said("--zoom-to", "chain C and name C").find("there is no chain 'C', only A, B"), std::string::npos);
  EXPECT_NE(said("--select", "chain A and name CA").find("case-sensitive"), std::string::npos);
  EXPECT_NE(said("--zoom-to", "chain A and name CA").find("--zoom-to 'chain A and name CA': selects none"),
            std::string::npos);
}

TEST_F(Words, ACameraThatSeesNothingIsToldBeforeTheSurfaceIsComputed) {
  const std::string camera = folder_.file(
      "away.json",
      R"({"position":[0,0,50],"target":[0,0,90],"up":[0,1,0],"projection":"perspective","vertical_fov":30})");
  const ProgramResult result =
      says({"render", molecule_, "-o", (folder_.path() / "d.png").string(), "--camera", camera});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::size_t warning = result.err.find("this camera does not see the molecule");
  ASSERT_NE(warning, std::string::npos) << result.err;
  EXPECT_LT(warning, result.err.find("surface on"));
}

/// Returns the width and height of a PNG, and the bytes after the name of a chunk or a key.
std::string behind(const std::string& png, const std::string& name, std::size_t count) {
  const std::size_t at = png.find(name);
  return at == std::string::npos ? "" : png.substr(at + name.size(), count);
}

std::uint32_t word_at(const std::string& bytes, std::size_t place) {
  std::uint32_t word = 0;
  for (std::size_t n = 0; n < 4; ++n) word = word << 8 | static_cast<unsigned char>(bytes.at(place + n));
  return word;
}

TEST_F(Words, SizesMayBeLengths) {
  const std::string path = (folder_.path() / "s.png").string();
  const auto header = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"render", molecule_, "-o", path, "--force", "-q", "--samples", "1"});
    const ProgramResult result = says(options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::string bytes = test::read_bytes(path), size = behind(bytes, "IHDR", 8), scale = behind(bytes, "pHYs", 9);
    std::vector<std::uint32_t> numbers{word_at(size, 0), word_at(size, 4)};
    if (!scale.empty()) numbers.push_back(word_at(scale, 0));
    return numbers;
  };
  using Numbers = std::vector<std::uint32_t>;
  EXPECT_EQ(header({"--size", "40x30"}), (Numbers{40, 30}));
  EXPECT_EQ(header({"--size", "40x30", "--dpi", "100"}), (Numbers{40, 30, 3937}));
  EXPECT_EQ(header({"--width", "25.4mm"}), (Numbers{300, 225, 11811}));
  EXPECT_EQ(header({"--width", "1in", "--dpi", "72"}), (Numbers{72, 54, 2835}));
  EXPECT_EQ(header({"--dpi", "72", "--height", "2.54cm"}), (Numbers{96, 72, 2835}));
  EXPECT_EQ(header({"--width", "64px", "--height", "64"}), (Numbers{64, 64}));
  EXPECT_NE(fault({"--width", "9ft"}).find("'9ft' is not a length such as 85mm"), std::string::npos);
  EXPECT_NE(fault({"--width", "0.01mm"}).find("makes 0 pixels"), std::string::npos);
  EXPECT_NE(fault({"--width", "9in", "--size", "3x3"}).find("excludes"), std::string::npos);
}

TEST_F(Words, PicturesTellHowTheyWereMadeIfAsked) {
  const std::string path = (folder_.path() / "my picture.png").string();
  const auto bytes = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"render", molecule_, "-o", path, "--force", "-q", "--size", "8x8"});
    EXPECT_EQ(says(options).exit_code, 0);
    return test::read_bytes(path);
  };
  EXPECT_NE(bytes({}).find("Software"), std::string::npos);
  EXPECT_EQ(bytes({}).find("my picture"), std::string::npos);
  EXPECT_EQ(bytes({"--no-provenance"}).find("Software"), std::string::npos);
  const std::string told = bytes({"--provenance", "--color", "#ff0000"});
  EXPECT_NE(told.find("iTXtDescription"), std::string::npos);
  EXPECT_NE(told.find("meniscus 'render' '" + molecule_ + "' '-o' '" + path + "' '--force'"), std::string::npos);
}

TEST_F(Words, SidesAndTurnsAreChecked) {
  EXPECT_NE(fault({"--view", "up"}).find("'up' is not one of front, back"), std::string::npos);
  EXPECT_NE(fault({"--turn", "90"}).find("'90' is not an axis of the picture"), std::string::npos);
  EXPECT_NE(fault({"--view", "symmetry"}).find("there is no axis"), std::string::npos);
  EXPECT_EQ(fault({"--camera", "x.json", "--view", "x"}).find("internal"), std::string::npos);
}

}  // namespace
}  // namespace meniscus
