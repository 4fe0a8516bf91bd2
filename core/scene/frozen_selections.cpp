// SPDX-License-Identifier: BSD-3-Clause
// Collects all selections, and evaluates them in the first frame.
#include "core/scene/frame_run.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/scene/scene.h"

namespace meniscus {
namespace {

/// Selections by the atoms that they are evaluated on: all atoms of the file, or the atoms of the surface and those
/// drawn in addition.
struct Expressions {
  std::vector<Selection*> of_file, of_surface;

  void add(std::optional<Selection>& selection, std::vector<Selection*>& list) {
    if (selection) list.push_back(&*selection);
  }

  void add(ColorScheme& color) {
    for (ColorRule& rule : color.rules) of_surface.push_back(&rule.atoms);
    for (OpacityRule& rule : color.opacities) add(rule.atoms, of_surface);
  }

  void add(Representations& representations) {
    for (RepresentationRequest& request : representations.requests) of_file.push_back(&request.atoms);
  }

  void add(MoleculeRequest& molecule) {
    add(molecule.reading.selection, of_file);
    for (ShownAtoms& shown : molecule.reading.shown) of_file.push_back(&shown.atoms);
    for (RadiusOverride& radius : molecule.reading.radii.overrides) of_surface.push_back(&radius.atoms);
    add(molecule.show, of_surface);
    add(molecule.patches, of_surface);
    add(molecule.color);
  }

  void add(std::vector<Cut>& cuts) {
    for (Cut& cut : cuts) add(cut.atoms, of_surface);
  }

  void add(FigureRequest& figure) {
    add(figure.representations);
    add(figure.cuts);
    for (FigureObjectRequest& object : figure.objects) {
      of_file.push_back(&object.atoms);
      add(object.partners, of_file);
      add(object.show, of_surface);
      add(object.cuts);
      if (object.color) add(*object.color);
      for (OpacityRule& rule : object.opacities) add(rule.atoms, of_surface);
    }
  }

  void keep_by_positions() {
    for (std::vector<Selection*>* list : {&of_file, &of_surface})
      std::erase_if(*list, [](const Selection* selection) { return !selection->uses_positions(); });
  }
};

void freeze(const std::vector<Selection*>& selections, const std::vector<Atom>& atoms) {
  for (Selection* selection : selections) *selection = selection->fixed(atoms, selection->evaluate(atoms));
}

}  // namespace

void freeze_selections(Scene& scene, const std::vector<Selection*>& of_atoms) {
  if (!scene.frames.select_once) return;
  Expressions expressions;
  expressions.add(scene.molecule);
  expressions.add(scene.frames.context, expressions.of_file);
  expressions.add(scene.figure);
  expressions.add(scene.picture.zoom_to, expressions.of_surface);
  expressions.add(scene.run_camera.follow, expressions.of_surface);
  for (Selection* selection : of_atoms) expressions.of_surface.push_back(selection);
  expressions.keep_by_positions();
  const bool backbones = scene.molecule.reading.secondary_structure;
  if (expressions.of_file.empty() && expressions.of_surface.empty() && !backbones)
    throw RequestError(message("@select-once@: no selection of this run depends on where atoms are; leave it out"));
  RunRequest first = scene.frames;
  first.select_once = false;
  FrameRun frames(scene.molecule, first);
  freeze(expressions.of_file, frames.all_atoms());
  freeze(expressions.of_surface, shown_atoms(frames.structure()));
}

}  // namespace meniscus
