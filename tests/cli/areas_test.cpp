// SPDX-License-Identifier: BSD-3-Clause
// The report of `meniscus surface` about parts: kinds of surface, cavities, chains, components, atoms and residues.
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/run_program.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::TemporaryFolder;

ProgramResult surface(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"surface", "-q", "--device", "cpu"});
  return test::run_program(test::meniscus_program(), arguments);
}

json surface_json(std::vector<std::string> arguments) {
  arguments.push_back("--json");
  const ProgramResult result = surface(std::move(arguments));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  return json::parse(result.out, nullptr, false);
}

using Table = std::vector<std::map<std::string, std::string>>;

// Parses CSV whose cells have no quotes.
Table parse_csv(const std::string& text) {
  std::istringstream lines(text);
  std::string line, cell;
  std::vector<std::string> names;
  Table rows;
  while (std::getline(lines, line)) {
    std::vector<std::string> cells;
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

double sum(const Table& rows, const std::string& column) {
  double total = 0.0;
  for (const auto& row : rows) total += std::stod(row.at(column));
  return total;
}

TEST(Kinds, AccessibleSurfaceIsTheUnionOfGrownBallsAndVdwHasNoProbe) {
  const json ses = surface_json({kUbiquitin}), sas = surface_json({kUbiquitin, "--surface", "sas"});
  const json vdw = surface_json({kUbiquitin, "--surface", "vdw"}), probe_0 = surface_json({kUbiquitin, "--probe", "0"});
  EXPECT_EQ(ses["surface"], "ses");
  EXPECT_EQ(sas["surface"], "sas");
  EXPECT_EQ(sas["probe_radius"], 1.4);
  EXPECT_NEAR(sas["area"].get<double>(), ses["sas_area"].get<double>(), 1e-6);
  EXPECT_NEAR(sas["sas_area"].get<double>(), sas["area"].get<double>(), 1e-6);
  EXPECT_NEAR(vdw["area"].get<double>(), probe_0["area"].get<double>(), 1e-9);
  EXPECT_NEAR(vdw["vdw_area"].get<double>(), vdw["area"].get<double>(), 1e-6);
  EXPECT_FALSE(vdw.contains("sas_area"));
}

TEST(Cavities, DropAndOnlyMakeUpTheWhole) {
  const json keep = surface_json({kToxin}), drop = surface_json({kToxin, "--cavities", "drop"});
  const json only = surface_json({kToxin, "--cavities", "only"});
  for (const char* key : {"area", "volume", "ses_area", "sas_area"})
    EXPECT_NEAR(keep[key].get<double>(), drop[key].get<double>() + only[key].get<double>(), 1e-6) << key;
  for (const json& component : drop["components"]) EXPECT_EQ(component["kind"], "outer");
  EXPECT_EQ(drop["components"].size() + only["components"].size(), keep["components"].size());
}

// The test uses sixty atoms, because freesasa needs 100,000 slices per atom for areas that are exact to 1e-4 Å².
TEST(Csv, AccessibleAreasAreThoseOfFreesasa) {
  const TemporaryFolder folder;
  std::istringstream file(test::read_bytes(kUbiquitin));
  std::string line, text;
  for (int atoms = 0; atoms < 60 && std::getline(file, line);)
    if (line.starts_with("ATOM  ")) {
      text += line + "\n";
      ++atoms;
    }
  const ProgramResult ours = surface({folder.file("few.pdb", text), "--csv", "-"});
  ASSERT_EQ(ours.exit_code, 0) << ours.err;
  const Table rows = parse_csv(ours.out);
  ASSERT_EQ(rows.size(), 60u);
  // The same atoms have our radii in the column from which freesasa takes radii.
  std::istringstream again(text);
  std::string with_radii;
  for (const auto& row : rows) {
    std::getline(again, line);
    with_radii += line.replace(54, 6, fmt::format("{:6.2f}", std::stod(row.at("radius")))) + "\n";
  }
  const ProgramResult theirs =
      test::run_program("/usr/bin/freesasa",
                        {"--lee-richards", "--resolution=100000", "--radius-from-occupancy", "--no-warnings",
                         "--format=json", "--depth=atom", folder.file("radii.pdb", with_radii)},
                        250);
  ASSERT_EQ(theirs.exit_code, 0) << theirs.err;
  const json result = json::parse(theirs.out, nullptr, false);
  std::size_t n = 0;
  for (const json& chain : result["results"][0]["structure"][0]["chains"])
    for (const json& residue : chain["residues"])
      for (const json& atom : residue["atoms"]) {
        ASSERT_LT(n, rows.size());
        EXPECT_NEAR(std::stod(rows[n].at("sas_area")), atom["area"].get<double>(), 1e-4) << rows[n].at("name");
        ++n;
      }
  EXPECT_EQ(n, 60u);
}

TEST(Context, WhatOneChainBuriesOfAnother) {
  const auto areas = [](const std::string& select, const std::string& context) {
    std::vector<std::string> arguments{kToxin, "--select", select};
    if (!context.empty()) arguments.insert(arguments.end(), {"--context", context});
    return surface_json(arguments);
  };
  const json a = areas("chain D", "chain E"), d = areas("chain E", "chain D"), both = areas("chain D or chain E", "");
  EXPECT_EQ(a["context"]["atoms"], 740);
  for (const std::string kind : {"ses_area", "sas_area"}) {
    const auto number = [&](const json& of, const char* suffix) { return of[kind + suffix].get<double>(); };
    EXPECT_NEAR(number(a, "_in_context") + number(d, "_in_context"), number(both, ""), 1e-6);
    EXPECT_NEAR(number(a, "") - number(a, "_in_context"), number(a, "_buried"), 1e-6);
    EXPECT_GT(number(a, "_buried"), 100.0);
  }
  EXPECT_EQ(surface({kToxin, "--context", "chain D"}).exit_code, 2);
  EXPECT_EQ(surface({kToxin, "--select", "chain A", "--context", "chain"}).exit_code, 2);
}

TEST(Cavities, AMoleculeWithoutAnyLeavesNothing) {
  const TemporaryFolder folder;
  const ProgramResult result = surface({folder.file("one.xyzr", "0 0 0 1.7\n"), "--cavities", "only"});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.err.find("no cavities"), std::string::npos) << result.err;
}

TEST(Objects, ChainsAreComputedAlone) {
  const json whole = surface_json({kToxin}), chains = surface_json({kToxin, "--by", "chain"});
  double area = 0.0, alone = 0.0;
  int objects = 0;
  for (const json& group : chains["groups"]) {
    if (group["by"] == "chain") area += group["ses_area"].get<double>();
    if (group["by"] != "object") continue;
    ++objects;
    alone += group["area"].get<double>();
    EXPECT_NEAR(group["ses_area"].get<double>(), group["area"].get<double>(), 1e-6);
    EXPECT_EQ(group["name"].get<std::string>().substr(0, 6), "chain ");
  }
  EXPECT_EQ(objects, 7);
  EXPECT_NEAR(area, alone, 1e-6);
  EXPECT_NEAR(chains["area"].get<double>(), alone, 1e-6);
  EXPECT_GT(alone, whole["area"].get<double>() + 1000.0);  // the interfaces are open
}

TEST(Objects, ComponentsOfOneSurfaceAddUp) {
  const json whole = surface_json({kToxin}), parts = surface_json({kToxin, "--by", "component"});
  EXPECT_EQ(parts["components"].size(), whole["components"].size());
  for (const char* key : {"area", "volume", "ses_area", "sas_area"})
    EXPECT_NEAR(parts[key].get<double>(), whole[key].get<double>(), 1e-6) << key;
  std::size_t objects = 0;
  for (const json& group : parts["groups"]) objects += group["by"] == "object";
  EXPECT_EQ(objects, whole["components"].size());
}

TEST(Csv, AtomsAndResiduesAddUpToTheSurface) {
  const TemporaryFolder folder;
  const std::string atoms = folder.path() / "atoms.csv", residues = folder.path() / "residues.csv";
  const ProgramResult result = surface({kToxin, "--json", "--csv", atoms, "--csv-residues", residues});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const json numbers = json::parse(result.out, nullptr, false);
  const Table by_atom = parse_csv(test::read_bytes(atoms)), by_residue = parse_csv(test::read_bytes(residues));
  EXPECT_EQ(by_atom.size(), 5469u);
  for (const char* column : {"ses_area", "sas_area"}) {
    EXPECT_NEAR(sum(by_atom, column), numbers[column].get<double>(), 5e-3);  // six digits each
    EXPECT_NEAR(sum(by_residue, column), numbers[column].get<double>(), 5e-3);
  }
  EXPECT_NEAR(sum(by_residue, "atoms"), 5469.0, 0.0);
  EXPECT_EQ(by_atom.front().at("chain"), "D");
  EXPECT_EQ(by_atom.front().at("class"), "polymer");
  EXPECT_EQ(by_atom.front().at("element"), "N");

  EXPECT_EQ(surface({kToxin, "--csv", atoms}).exit_code, 6);  // the file exists already
  EXPECT_EQ(surface({kToxin, "--csv", atoms, "--force"}).exit_code, 0);
  EXPECT_EQ(surface({kToxin, "--csv", "-", "--json"}).exit_code, 2);
  EXPECT_EQ(surface({kToxin, "--csv", "same", "--csv-residues", "same"}).exit_code, 2);
}

// freesasa computes the areas; it divides them by those of Gly-X-Gly in one conformation.
TEST(Csv, RelativeAccessibilityIsAccessibleAreaOverTheGreatest) {
  const std::map<std::string, double> greatest{// M. Z. Tien et al., PLoS ONE 8, e80635 (2013), table 1, theoretical
                                               {"ALA", 129}, {"ARG", 274}, {"ASN", 195}, {"ASP", 193}, {"GLN", 225},
                                               {"GLU", 223}, {"GLY", 104}, {"HIS", 224}, {"ILE", 197}, {"LEU", 201},
                                               {"LYS", 236}, {"MET", 224}, {"PHE", 240}, {"PRO", 159}, {"SER", 155},
                                               {"THR", 172}, {"TYR", 263}, {"VAL", 174}};
  const auto residues = [](std::vector<std::string> more) {
    more.insert(more.begin(), {"--csv-residues", "-"});
    const ProgramResult result = surface(more);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return parse_csv(result.out);
  };
  const Table ours = residues({kUbiquitin, "--radii", "protor"});
  const ProgramResult theirs = test::run_program(
      "/usr/bin/freesasa", {"--lee-richards", "--resolution=1000", "--format=rsa", "--no-warnings", kUbiquitin}, 250);
  ASSERT_EQ(theirs.exit_code, 0) << theirs.err;
  std::istringstream lines(theirs.out);
  std::size_t n = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string record, residue, chain, number;
    double area = 0.0;
    if (!(words >> record >> residue >> chain >> number >> area) || record != "RES") continue;
    ASSERT_LT(n, ours.size());
    EXPECT_NEAR(std::stod(ours[n++].at("relative_sas_area")), area / greatest.at(residue), 1e-3) << line;
  }
  EXPECT_EQ(n, 76u);
  // Relative areas are also those of the accessible surface, but never of another surface or probe.
  for (std::size_t k = 0; const auto& row : residues({kUbiquitin, "--radii", "protor", "--surface", "sas"}))
    EXPECT_NEAR(std::stod(row.at("relative_sas_area")), std::stod(ours[k++].at("relative_sas_area")), 2e-6);
  for (std::vector<std::string> other :
       {std::vector<std::string>{"--surface", "vdw"}, {"--probe", "1.5"}, {"--surface", "sas", "--probe", "1.5"}}) {
    other.insert(other.begin(), kUbiquitin);
    EXPECT_FALSE(residues(other).front().contains("relative_sas_area"));
  }
  // A context gives areas among others, and buried areas; parts of residues and other molecules have none.
  for (const auto& row : residues({kToxin, "--select", "chain D", "--context", "chain E"}))
    EXPECT_NEAR(std::stod(row.at("relative_sas_area")) - std::stod(row.at("relative_sas_area_in_context")),
                std::stod(row.at("relative_sas_area_buried")), 2e-6);
  for (const auto& row : residues({kUbiquitin, "--keep-water", "--select", "water or name N CA"}))
    EXPECT_EQ(row.at("relative_sas_area"), "");
}

TEST(Csv, NamesWithCommasAndQuotesStayInTheirCells) {
  const TemporaryFolder folder;
  const ProgramResult result = surface(
      {folder.file("odd.pdb", "ATOM      1  C\",\"ALA A   1       0.000   0.000   0.000  1.00  0.00           C\n"),
       "--csv", "-"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find(",\"C\"\",\",C,"), std::string::npos) << result.out;
}

TEST(Patches, AddUpToTheAreasOfTheirAtoms) {
  const std::string atoms = "hydrophobicity > 1.5";
  const json report = surface_json({kUbiquitin, "--patches", atoms, "--min-patch", "0"}), patches = report["patches"];
  EXPECT_EQ(patches["selection"], atoms);
  ASSERT_EQ(patches["list"].size(), patches["count"]);
  double listed = 0.0, before = patches["list"][0]["area"];
  for (const json& patch : patches["list"]) {
    EXPECT_LE(patch["area"], before);
    before = patch["area"];
    listed += before;
  }
  const std::string hydrophobic = " ALA CYS ILE LEU MET PHE VAL ";
  double wanted = 0.0;
  for (const auto& row : parse_csv(surface({kUbiquitin, "--csv", "-"}).out))
    if (hydrophobic.find(" " + row.at("residue") + " ") != std::string::npos) wanted += std::stod(row.at("ses_area"));
  EXPECT_NEAR(patches["area"], wanted, 1e-3);
  EXPECT_NEAR(listed, wanted, 1e-3);
  const Table rows = parse_csv(surface({kUbiquitin, "--patches", atoms, "--csv-patches", "-"}).out);
  ASSERT_FALSE(rows.empty());
  EXPECT_NEAR(std::stod(rows[0].at("area")), patches["list"][0]["area"], 1e-6);
  EXPECT_GE(std::stod(rows.back().at("area")), 10.0);
  EXPECT_NE(surface({kUbiquitin, "--patches", "resname XYZ"}).err.find("selects none of the 602 atoms"),
            std::string::npos);
  EXPECT_EQ(surface({kUbiquitin, "--csv-patches", "p.csv"}).exit_code, 2);
}

}  // namespace
}  // namespace meniscus
