/* SPDX-License-Identifier: BSD-3-Clause */
/* The header is C99 without a warning, and its example does what it says. */
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
  int failures = 0;

  if (meniscus_computer_new(NULL, &computer) || meniscus_compute(computer, &atoms, &surface) ||
      meniscus_surface_summary(surface, &summary)) {
    fprintf(stderr, "%s\n", meniscus_last_error());
    return 1;
  }
  failures += summary.atoms != 2 || summary.convex != 2 || summary.toroidal != 1 || summary.concave != 0;
  failures += !(summary.area > 60.0 && summary.area < 80.0);
  failures += meniscus_compute(computer, &none, &surface) != MENISCUS_INPUT || strlen(meniscus_last_error()) == 0;
  failures += strcmp(meniscus_version(), MENISCUS_VERSION) != 0;
  meniscus_surface_release(surface);
  meniscus_computer_release(computer);
  printf("failures %d\n", failures);
  return failures;
}
