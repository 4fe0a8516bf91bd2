// SPDX-License-Identifier: BSD-3-Clause
// Numbers from trajectories: tables of frames, atoms, residues and cavities.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"

namespace meniscus::test {
namespace {

using Words = std::vector<std::string>;
using Rows = std::vector<std::map<std::string, std::string>>;

/// Returns the cells of rows; cells in quotes may have spaces, but no commas.
Rows rows_of(const std::string& text) {
  std::istringstream lines(text);
  std::string line, cell;
  Words names;
  Rows rows;
  while (std::getline(lines, line)) {
    Words cells;
    std::istringstream parts(line + ",");
    while (std::getline(parts, cell, ',')) cells.push_back(cell);
    if (names.empty()) {
      names = cells;
      continue;
    }
    EXPECT_EQ(cells.size(), names.size()) << line;
    rows.emplace_back();
    for (std::size_t n = 0; n < std::min(cells.size(), names.size()); ++n) rows.back()[names[n]] = cells[n];
  }
  return rows;
}

std::string pdb_line(int serial, const char* name, const char* residue, char chain, int number, double x, double y,
                     double z, const char* element) {
  return fmt::format("ATOM  {:>5} {:<4} {:<3} {}{:>4}    {:>8.3f}{:>8.3f}{:>8.3f}  1.00 10.00          {:>2}\n", serial,
                     name, residue, chain, number, x, y, z, element);
}

/// Returns carbon atoms on a sphere around `x`, so close together that no probe gets through.
std::string cage(int& serial, char chain, double x, double radius) {
  std::string text;
  const int count = 48;
  for (int n = 0; n < count; ++n) {
    const double z = 1 - (2 * n + 1.0) / count, turn = 2.399963 * n, flat = std::sqrt(1 - z * z);
    text += pdb_line(++serial, " C1", "CAG", chain, 1 + n / 8, x + radius * flat * std::cos(turn),
                     radius * flat * std::sin(turn), radius * z, "C");
  }
  return text;
}

/// Returns two distant cages in chains A and B, the first too narrow for a probe in the middle frames; and water.
std::string cages(bool with_water) {
  std::string text;
  for (int frame = 0; frame < 5; ++frame) {
    int serial = 0;
    text += fmt::format("MODEL     {:>4}\n", frame + 1);
    text += cage(serial, 'A', 0.0, frame == 2 ? 2.9 : 4.2 + 0.02 * frame) + cage(serial, 'B', 14.0, 4.5);
    if (with_water)
      for (int n = 0; n < 3; ++n)
        text += fmt::format("HETATM{:>5}  O   HOH W{:>4}    {:>8.3f}{:>8.3f}{:>8.3f}  1.00 10.00           O\n",
                            ++serial, n + 1, 40.0 + 4 * n, 0.0, 0.0);
    text += "ENDMDL\n";
  }
  return text + "END\n";
}

class Series : public ::testing::Test {
 protected:
  ProgramResult meniscus(Words words) {
    words.insert(words.begin(), {"surface", "-q", "--device", "cpu"});
    return run_program(meniscus_program(), words);
  }
  Rows table(Words words, const std::string& option) {
    words.insert(words.end(), {option, "-"});
    const ProgramResult result = meniscus(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return rows_of(result.out);
  }
  nlohmann::json one(Words words) {
    words.push_back("--json");
    const ProgramResult result = meniscus(words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return nlohmann::json::parse(result.out, nullptr, false);
  }
  void expect_error(Words words, int code, const std::string& sentence) {
    const ProgramResult result = meniscus(words);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_NE(result.err.find(sentence), std::string::npos) << result.err;
    EXPECT_EQ(result.out, "");
  }

  TemporaryFolder folder_;
  std::string dry_ = folder_.file("dry.pdb", cages(false)), wet_ = folder_.file("wet.pdb", cages(true));
};

TEST_F(Series, ARowAFrameHasTheNumbersOfItsModel) {
  const Rows rows = table({dry_, "--frames", "all"}, "--csv-series");
  ASSERT_EQ(rows.size(), 5u);
  for (int n = 0; n < 5; ++n) {
    const nlohmann::json model = one({dry_, "--model", std::to_string(n + 1)});
    auto row = rows[static_cast<std::size_t>(n)];
    EXPECT_EQ(row["frame"], std::to_string(n));
    EXPECT_NEAR(std::stod(row["ses_area"]), model["area"], 1e-6);
    EXPECT_NEAR(std::stod(row["sas_area"]), model["sas_area"], 1e-6);
    EXPECT_NEAR(std::stod(row["volume"]), model["volume"], 1e-6);
    EXPECT_EQ(std::stoul(row["components"]), model["components"].size());
    double volume = 0.0;
    int cavities = 0;
    for (const auto& component : model["components"]) {
      if (component["kind"] != "cavity") continue;
      ++cavities;
      volume += component["volume"].get<double>();
    }
    EXPECT_EQ(cavities, n == 2 ? 1 : 2);
    EXPECT_EQ(std::stoi(row["cavities"]), cavities);
    EXPECT_NEAR(std::stod(row["cavity_volume"]), volume, 1e-6);
  }
}

// The volume of a cavity is the same, and positive, in every output.
TEST_F(Series, CavitiesHaveOneSignEverywhere) {
  const Words frame{dry_, "--frames", "0"};
  auto series = table(frame, "--csv-series").at(0);
  std::vector<double> volumes;
  for (auto row : table(frame, "--csv-cavities")) volumes.push_back(std::stod(row["volume"]));
  ASSERT_EQ(volumes.size(), 2u);
  for (const double volume : volumes) EXPECT_GT(volume, 1.0);
  const double sum = volumes[0] + volumes[1], solid = std::stod(series["volume"]);
  EXPECT_NEAR(std::stod(series["cavity_volume"]), sum, 1e-5);
  for (const Words& words : {Words{dry_}, frame}) {  // a JSON object, and a JSON line of a run
    const nlohmann::json surface = one(words);
    EXPECT_NEAR(surface["cavity_volume"], sum, 1e-5);
    EXPECT_EQ(surface["cavities"], 2);
    EXPECT_NEAR(surface["volume"], solid, 1e-5);
    double of_cavities = 0.0, of_all = 0.0;
    for (const auto& component : surface["components"]) {
      EXPECT_GT(component["volume"], 1.0);
      of_all += component["signed_volume"].get<double>();
      if (component["kind"] == "cavity") of_cavities += component["volume"].get<double>();
    }
    EXPECT_NEAR(of_cavities, sum, 1e-5);
    EXPECT_NEAR(of_all, solid, 1e-5);
  }
  const ProgramResult printed = meniscus({dry_});
  for (const double volume : volumes)
    EXPECT_NE(printed.out.find(fmt::format(" {:.3f} ", volume)), std::string::npos) << printed.out;
  EXPECT_EQ(printed.out.find(" -"), std::string::npos) << printed.out;
  // The pockets are these two, with their whole volume, and a third void between the cages.
  const ProgramResult pockets = run_program(
      meniscus_program(),
      {"pockets", dry_, "-q", "--device", "cpu", "--ligand", "none", "--trim", "0", "--min-volume", "0", "--csv", "-"});
  const Rows found = rows_of(pockets.out);
  ASSERT_GE(found.size(), 2u) << pockets.err;
  EXPECT_NEAR(std::stod(found[0].at("volume")) + std::stod(found[1].at("volume")), sum, 1e-5);
}

TEST_F(Series, AtomsAndResiduesOfEachFrameAddUp) {
  const std::string series = (folder_.path() / "s.csv").string(), atoms = (folder_.path() / "a.csv").string(),
                    residues = (folder_.path() / "r.csv").string();
  const ProgramResult result = meniscus({dry_, "--frames", "0-2", "--csv-series", series, "--csv", atoms,
                                         "--csv-residues", residues, "--select", "chain A", "--context", "chain B"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("frame"), std::string::npos);  // the table is printed as usual
  const Rows frames = rows_of(read_bytes(series)), of_atoms = rows_of(read_bytes(atoms)),
             of_residues = rows_of(read_bytes(residues));
  ASSERT_EQ(frames.size(), 3u);
  ASSERT_EQ(of_atoms.size(), 3u * 48);
  ASSERT_EQ(of_residues.size(), 3u * 6);
  for (auto frame : frames)
    for (const char* column : {"ses_area", "sas_area", "sas_area_in_context", "sas_area_buried"})
      for (const Rows* rows : {&of_atoms, &of_residues}) {
        double sum = 0.0;
        for (auto row : *rows)
          if (row["frame"] == frame["frame"]) sum += std::stod(row[column]);
        EXPECT_NEAR(sum, std::stod(frame[column]), 1e-3) << column;
      }
  const nlohmann::json model = one({dry_, "--model", "2", "--select", "chain A", "--context", "chain B"});
  auto second = frames[1];
  EXPECT_NEAR(std::stod(second["ses_area_buried"]), model["ses_area_buried"], 1e-6);
  EXPECT_NE(std::stod(second["sas_area_buried"]), 0.0);
  // JSON lines have the same.
  const ProgramResult lines =
      meniscus({dry_, "--frames", "1", "--json", "--select", "chain A", "--context", "chain B"});
  ASSERT_EQ(lines.exit_code, 0) << lines.err;
  EXPECT_EQ(nlohmann::json::parse(lines.out)["sas_area_buried"], model["sas_area_buried"]);
}

TEST_F(Series, CavitiesKeepTheirNumbersUntilTheyClose) {
  const Rows rows = table({dry_, "--frames", "all"}, "--csv-cavities");
  std::string told;
  for (auto row : rows) {
    told += fmt::format("{}:{} {}; ", row["frame"], row["cavity"], row["event"]);
    EXPECT_EQ(row["volume"] == "0", row["event"] == "closed");
  }
  EXPECT_EQ(told,
            "0:1 born; 0:2 born; 1:1 kept; 1:2 kept; 2:1 kept; 2:2 closed; 3:1 kept; 3:3 born; 4:1 kept; 4:3 kept; ");
  auto first = rows[0];  // the larger cavity
  EXPECT_NEAR(std::stod(first["x"]), 14.0, 0.2);
  EXPECT_EQ(first["residues"].find("\"B:CAG:1 "), 0u) << first["residues"];
  EXPECT_EQ(std::count(first["residues"].begin(), first["residues"].end(), 'B'), 6);
  expect_error({dry_, "--frames", "all", "--only", "2", "--csv-cavities", "-"}, 2, "--only");
  expect_error({dry_, "--frames", "all", "--surface", "sas", "--csv-cavities", "-"}, 2, "solvent-excluded");
  expect_error({dry_, "--frames", "all", "--by", "chain", "--csv-cavities", "-"}, 2, "one surface");
  expect_error({dry_, "--csv-cavities", "-"}, 2, "run of frames");
}

/// Returns three atoms per frame, farther apart from frame to frame, with their own times.
std::string timed_gro(int frames) {
  std::string text;
  for (int n = 0; n < frames; ++n) {
    text += fmt::format("a run t= {:.5f} step= {}\n    3\n", 2.5 * n + 10, 50 * n);
    for (int atom = 0; atom < 3; ++atom)
      text += fmt::format("    1LIG     C{}    {}{:8.3f}{:8.3f}{:8.3f}\n", atom + 1, atom + 1, atom * 0.05 * (n + 1),
                          0.0, 0.0);
    text += "   9.00000   9.00000   9.00000\n";
  }
  return text;
}

// Each row has the numbers of its frame with its own number and time, however many frames are made at once.
TEST_F(Series, EachRowHasItsOwnTimeAndNumbers) {
  const std::string file = folder_.file("timed.gro", timed_gro(9));
  for (const char* jobs : {"1", "2", "3"}) {
    const Rows rows = table({file, "--frames", "all", "--jobs", jobs}, "--csv-series");
    ASSERT_EQ(rows.size(), 9u);
    for (int n = 0; n < 9; ++n) {
      const auto& row = rows[static_cast<std::size_t>(n)];
      EXPECT_EQ(row.at("frame"), std::to_string(n));
      EXPECT_DOUBLE_EQ(std::stod(row.at("time")), 2.5 * n + 10);
      const nlohmann::json model = one({file, "--model", std::to_string(n + 1)});
      EXPECT_NEAR(std::stod(row.at("sas_area")), model["sas_area"], 1e-6);
      if (n > 0) {
        EXPECT_GT(std::stod(row.at("sas_area")), std::stod(rows[static_cast<std::size_t>(n - 1)].at("sas_area")));
      }
    }
    const Rows atoms = table({file, "--frames", "4-5", "--jobs", jobs}, "--csv");
    ASSERT_EQ(atoms.size(), 6u);
    EXPECT_EQ(atoms[3].at("frame"), "5");
    EXPECT_EQ(atoms[3].at("time"), "22.5");
  }
}

TEST_F(Series, OutputsThatGetIntoEachOthersWay) {
  expect_error({dry_, "--frames", "0", "--csv-series", "-", "--json"}, 2, "one thing at a time");
  expect_error({dry_, "--frames", "0", "--csv-series", "-", "--csv", "-"}, 2, "one thing at a time");
  const std::string path = folder_.file("there.csv", "old");
  expect_error({dry_, "--frames", "0", "--csv-series", path, "--csv", path}, 2,
               "--csv and --csv-series name the same file");
  expect_error({dry_, "--frames", "0", "--csv-series", path}, 6, "exists");
  EXPECT_EQ(read_bytes(path), "old");
  expect_error({dry_, "--csv-series", path}, 2, "run of frames");
}

TEST_F(Series, AFrameThatFailsIsMissedAndTheOthersAreKept) {
  std::string text = cages(false);
  const std::size_t second = text.find("MODEL        2"), atom = text.find("ATOM", second);
  text.replace(atom + 30, 8, "     nan");
  const std::string path = (folder_.path() / "part.csv").string();
  const ProgramResult result = meniscus({folder_.file("bad.pdb", text), "--frames", "0-2", "--csv-series", path});
  EXPECT_EQ(result.exit_code, 3) << result.err;
  const Rows rows = rows_of(read_bytes(path));
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1].at("frame"), "2");
}

TEST_F(Series, TrajectoriesOfAPartOfTheAtoms) {
  const Rows expected = table({dry_, "--frames", "all"}, "--csv-series");
  expect_error({wet_, dry_}, 3, "choose --trajectory-atoms 'not water'");
  EXPECT_EQ(table({wet_, dry_, "--trajectory-atoms", "not water"}, "--csv-series"), expected);
  expect_error({wet_, dry_, "--trajectory-atoms", "chain A"}, 3, "its frames have 96 atoms");
  expect_error({wet_, dry_, "--trajectory-atoms", "chain Q"}, 3, "there is no chain 'Q'");
  expect_error({wet_, dry_, "--trajectory-atoms", "radius > 1"}, 3, "--trajectory-atoms");
  expect_error({wet_, "--frames", "all", "--trajectory-atoms", "not water"}, 2, "--trajectory-atoms");
  const ProgramResult told = run_program(meniscus_program(), {"surface", wet_, dry_, "--trajectory-atoms", "not water",
                                                              "--frames", "0", "--device", "cpu"});
  EXPECT_NE(told.err.find("3 not in the trajectory"), std::string::npos) << told.err;
}

TEST_F(Series, SeveralTrajectoriesInARow) {
  const Rows once = table({dry_, "--frames", "all"}, "--csv-series");
  Rows twice = table({dry_, dry_, "--trajectory", dry_}, "--csv-series");
  ASSERT_EQ(twice.size(), 10u);
  for (std::size_t n = 0; n < 10; ++n) {
    EXPECT_EQ(twice[n]["frame"], std::to_string(n));
    EXPECT_EQ(twice[n]["ses_area"], once[n % 5].at("ses_area"));
  }
  EXPECT_EQ(table({dry_, dry_, dry_}, "--csv-series"), twice);
  EXPECT_EQ(table({"--trajectory", dry_, dry_, "--trajectory", dry_}, "--csv-series"), twice);
  EXPECT_EQ(table({dry_, dry_, dry_, "--frames", "7,last"}, "--csv-series"), (Rows{twice[7], twice[9]}));
  expect_error({dry_, dry_, wet_}, 3, "its frames have 99 atoms, but frames of ");
  expect_error({dry_, dry_, (folder_.path() / "nowhere.dcd").string()}, 3, "nowhere.dcd");
}

TEST_F(Series, FramesFromTheEnd) {
  const Rows all = table({dry_, "--frames", "all"}, "--csv-series");
  EXPECT_EQ(table({dry_, "--frames", "-2-"}, "--csv-series"), (Rows{all[3], all[4]}));
  EXPECT_EQ(table({dry_, "--begin", "-2"}, "--csv-series"), (Rows{all[3], all[4]}));
  EXPECT_EQ(table({dry_, "--begin", "1", "--end", "-4"}, "--csv-series"), (Rows{all[1]}));
  EXPECT_EQ(table({dry_, "--begin", "last"}, "--csv-series"), (Rows{all[4]}));
  EXPECT_EQ(table({dry_, "--frames", "4", "--superpose", "chain B", "--reference", "last"}, "--csv-series").size(), 1u);
  expect_error({dry_, "--frames", "0", "--reference", "5"}, 2, "--reference");
  expect_error({dry_, "--begin", "-6"}, 2, "--begin");
  expect_error({dry_, "--frames", "-6"}, 2, "from -1 to -5");
}

}  // namespace
}  // namespace meniscus::test
