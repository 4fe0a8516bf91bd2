// SPDX-License-Identifier: BSD-3-Clause
// A session of the preview that draws on the CPU, and functions to use it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/preview/session.h"
#include "core/structure/formats/read_structure.h"
#include "tests/support/run_program.h"

namespace meniscus::test {

using Json = nlohmann::json;

/// Returns a function that reads a file again with the atoms that are drawn next to its surface.
inline ReadShown reader_of(const std::string& file, const ReadOptions& reading) {
  return [file, reading](const FigureRequest& figure, std::size_t) {
    ReadOptions shown = reading;
    figure.mark_atoms(shown);
    return read_structure(file, shown);
  };
}

class SessionCase : public ::testing::Test {
 protected:
  /// Begins a session whose pictures have 80 x 60 pixels.
  void begin(Structure structure, const SessionContext& context = {}, PreviewState view = {}) {
    view.size = {80, 60};
    session_ = std::make_unique<PreviewSession>(make_cpu_preview_renderer(), std::move(structure), view, std::nullopt,
                                                folder_.path(), std::nullopt, context);
  }

  Json apply(const std::string& command) { return session_->apply(Json::parse(command)); }
  Json state() { return apply(R"({"command":"state"})"); }
  Json values() { return state()["values"]; }
  void expect_ok(const std::string& command) {
    const Json reply = apply(command);
    EXPECT_TRUE(reply["ok"]) << command << " -> " << reply;
  }
  std::vector<std::uint8_t> picture() {
    session_->render(Quality::full);
    return session_->rgba();
  }

  TemporaryFolder folder_;
  std::unique_ptr<PreviewSession> session_;
};

/// A session of a peptide bond, a water and a ligand, which are read again from their file.
class PeptideSession : public SessionCase {
 protected:
  explicit PeptideSession(const std::optional<Selection>& selection = parse_selection("polymer"),
                          bool writes_scenes = false) {
    const std::string file =
        folder_.file("three.pdb",
                     R"(ATOM      1  N   ALA A   1       0.000   0.000   0.000  1.00 10.00           N
ATOM      2  CA  ALA A   1       1.458   0.000   0.000  1.00 20.00           C
ATOM      3  C   ALA A   1       2.009   1.420   0.000  1.00 30.00           C
ATOM      4  O   ALA A   1       1.251   2.390   0.000  1.00 40.00           O
HETATM    5  C1  LIG B   2       6.000   0.000   0.000  1.00 40.00           C
HETATM    6  O1  LIG B   2       7.200   0.000   0.000  1.00 40.00           O
HETATM    7  O   HOH B   3       4.000   5.000   0.000  1.00 40.00           O
END
)");
    ReadOptions reading;
    reading.selection = selection;
    SessionContext context;
    context.writes_scenes = writes_scenes;
    context.read_shown = reader_of(file, reading);
    PreviewState view;
    view.molecule.file = file;
    view.molecule.reading = reading;
    begin(read_structure(file, reading), context, view);
  }
};

}  // namespace meniscus::test
