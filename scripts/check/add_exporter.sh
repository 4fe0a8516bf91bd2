#!/usr/bin/env bash
# Adds an exporter to a copy of the tree, as a folder of exporters and one command, and uses it: help, completion,
# manual, scenes, selections and runs follow from its row. Ends with `cases N failures M`.
set -euo pipefail
source "$(dirname "$0")/copied_tree.sh"
git init -q . && git add -A

mkdir exporters/balls
cat >>exporters/CMakeLists.txt <<'CMAKE'
add_library(meniscus_balls STATIC balls/balls_file.cpp)
target_link_libraries(meniscus_balls PUBLIC meniscus_scene_picture PRIVATE fmt::fmt)
set_property(GLOBAL APPEND PROPERTY MENISCUS_EXPORTERS meniscus_balls)
CMAKE
cat >exporters/balls/balls_file.h <<'HEADER'
// SPDX-License-Identifier: BSD-3-Clause
// Text files of balls: one a line.
#pragma once

#include <string>

#include "core/scene/molecule.h"

namespace meniscus {

/// Returns center and radius of each atom of the surface, Å.
std::string balls_of(const Molecule& molecule);

}  // namespace meniscus
HEADER
cat >exporters/balls/balls_file.cpp <<'SOURCE'
// SPDX-License-Identifier: BSD-3-Clause
// Writes balls as text.
#include "exporters/balls/balls_file.h"

#include <fmt/format.h>

namespace meniscus {

std::string balls_of(const Molecule& molecule) {
  std::string text;
  for (const SurfaceObject& object : molecule.objects)
    for (const std::uint32_t index : object.atom) {
      const Atom& atom = molecule.structure.atoms[index];
      text += fmt::format("{} {} {} {}\n", atom.position.x, atom.position.y, atom.position.z, atom.radius);
    }
  return text;
}

}  // namespace meniscus
SOURCE
cat >app/commands/export_balls.cpp <<'COMMAND'
// SPDX-License-Identifier: BSD-3-Clause
// `meniscus export balls`: writes the balls of a surface as text.
#include <memory>
#include <span>

#include "app/commands/command_table.h"
#include "app/options/scene_options.h"
#include "app/reports/notes.h"
#include "core/base/output_file.h"
#include "exporters/balls/balls_file.h"

namespace meniscus {
namespace {

void declare_balls(CLI::App& command) {
  describe(command, "  meniscus export balls 1tii.pdb -o 1tii.balls");
  auto declared = std::make_shared<DeclaredCommand<>>(command, run_properties().with({"output.file"}));
  declared->options.describe_output("File to write");
  command.callback([declared] {
    declared->options.take();
    const std::string text = balls_of(load_molecule(declared->state));
    OutputFile file(declared->state.scene.output, declared->state.existing());
    file.write(std::as_bytes(std::span(text)));
    file.commit();
  });
}

const ExportCommand kBalls("balls", "Write balls that only this test knows", declare_balls);

}  // namespace
}  // namespace meniscus
COMMAND
git add -A

build meniscus

printf '1 0 0 1.7\n3 0 0 1.5\n' >two.xyzr
# The drawing of the folders lacks the new one until Graphviz draws it again; another test checks the order of folders.
expect "its place among the folders" python3 tests/docs/include_graph_test.py IncludeGraph.test_every_file_has_its_place \
  IncludeGraph.test_no_arrow_runs_back IncludeGraph.test_no_files_include_each_other
expect "the file" "$program" export balls two.xyzr -o two.balls -q
expect "what it holds" test "$(cat two.balls)" = $'1 0 0 1.7\n3 0 0 1.5'
expect "a file that exists" says "exists already; use --force to replace it" "$program" export balls two.xyzr -o two.balls
expect "no output" says "-o" "$program" export balls two.xyzr
expect "a selection" "$program" export balls two.xyzr -o one.balls -q --select 'index 1'
expect "what was selected" test "$(cat one.balls)" = '3 0 0 1.5'
expect "the help of export" says "balls .*this test knows" "$program" export --help
expect "its own help" says "--select EXPR" "$program" export balls --help
expect "completion" says "balls" "$program" completion bash
expect "manual pages" "$program" help --man man
expect "a manual page of it" test -s man/meniscus-export-balls.1
expect "a scene" bash -c "echo '{\"meniscus_scene\": 1, \"molecule\": {\"file\": \"two.xyzr\"}}' >a.json; '$program' export balls --scene a.json -o scene.balls -q"
finish
