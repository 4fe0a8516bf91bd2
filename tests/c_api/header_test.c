/* SPDX-License-Identifier: BSD-3-Clause */
/* The header is C99 without a warning, and its example has the promised result. */
#include <meniscus/meniscus.h>

#include <stdio.h>
#include <string.h>

int main(void) {
  const double positions[6] = {0.0, 0.0, 0.0, 4.0, 0.0, 0.0};
  const double radii[2] = {1.7, 1.7};
  meniscus_computer* computer = NULL;
  meniscus_surface* surface = NULL;
  meniscus_summary summary = {.size = sizeof summary};
  meniscus_atoms atoms = {.size = sizeof atoms, .count = 2, .positions = positions, .radii = radii};
  meniscus_atoms none = {.size = sizeof none};
  meniscus_options options = MENISCUS_OPTIONS_INIT;
  meniscus_options zeros = {.size = sizeof zeros};
  const meniscus_read_options reading = MENISCUS_READ_OPTIONS_INIT;
  const meniscus_pocket_options pockets = MENISCUS_POCKET_OPTIONS_INIT;
  const meniscus_mesh_options mesh = MENISCUS_MESH_OPTIONS_INIT;
  const meniscus_mesh_file file = MENISCUS_MESH_FILE_INIT;
  int failures = 0;

  options.probe_radius = 1.5;
  if (meniscus_computer_new(&options, &computer) || meniscus_compute(computer, &atoms, &surface) ||
      meniscus_surface_summary(surface, &summary)) {
    fprintf(stderr, "%s\n", meniscus_last_error());
    return 1;
  }
  failures += summary.atoms != 2 || summary.convex != 2 || summary.toroidal != 1 || summary.concave != 0;
  failures += !(summary.area > 60.0 && summary.area < 80.0) || summary.probe_radius != 1.5;
  failures += reading.model != 1 || pockets.trim != 1.0 || mesh.split_colors != 1 || file.scale != 1.0;
  failures += meniscus_computer_new(&zeros, &computer) != MENISCUS_INPUT;
  failures += meniscus_compute(computer, &none, &surface) != MENISCUS_INPUT || strlen(meniscus_last_error()) == 0;
  failures += strcmp(meniscus_version(), MENISCUS_VERSION) != 0;
  meniscus_surface_release(surface);
  meniscus_computer_release(computer);
  printf("failures %d\n", failures);
  return failures;
}
