// SPDX-License-Identifier: BSD-3-Clause
// Declares the options of figures in the order in which the help shows them.
#include "app/options/figure_command.h"

#include "app/options/figure_options.h"
#include "app/options/picture_options.h"
#include "app/options/scene_file.h"
#include "core/scene/settled_selections.h"

namespace meniscus {

void add_shown_options(CLI::App& command, FigureCommand& figure) {
  add_molecule_options(command, figure.molecule);
  add_figure_options(command, figure.molecule, figure.figure);
  add_interface_option(command, figure.molecule);
}

void add_run_options(CLI::App& command, FigureCommand& figure) {
  add_picture_options(command, figure.picture);
  add_trajectory_argument(command);
  add_frame_options(command, figure.frames);
  add_run_camera_options(command, figure.run_camera);
}

FigureCommand& with_settled_selections(FigureCommand& command) {
  settle_selections(command.molecule, command.frames,
                    {.figure = &command.figure, .view = &command.picture, .motion = &command.run_camera});
  return command;
}

void run_export(const CLI::App& command, FigureCommand& figure, const std::function<void()>& run) {
  // Of a run each frame's molecule has what stands beside it, else the figure has.
  if (figure.frames.asked())
    figure.molecule.representations = figure.figure.representations;
  else
    figure.figure.ask_for(figure.molecule.reading);
  take_interface(command, figure.molecule, figure.picture);
  SceneOutput scene(command, figure.save_scene, figure.output.existing());
  run();
  scene.commit();
}

}  // namespace meniscus
