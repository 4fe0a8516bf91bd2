/* SPDX-License-Identifier: BSD-3-Clause */
/* Reads atoms as lines "x y z radius" (Å) and prints the numbers of their solvent-excluded surface, in C99.
 *
 *   cc areas.c $(pkg-config --cflags --libs meniscus) -o areas && ./areas < molecule.xyzr */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include <meniscus/meniscus.h>

/* Reads rows of x, y, z and radius to the end of the standard input. The caller frees the result. */
static double* read_rows(size_t* count) {
  size_t room = 0;
  double* rows = NULL;
  double row[4];
  *count = 0;
  while (scanf("%lf %lf %lf %lf", &row[0], &row[1], &row[2], &row[3]) == 4) {
    if (*count == room) {
      double* more;
      room = room ? 2 * room : 256;
      more = realloc(rows, room * sizeof row);
      if (!more) break;
      rows = more;
    }
    for (int n = 0; n < 4; ++n) rows[4 * *count + (size_t)n] = row[n];
    ++*count;
  }
  return rows;
}

/* Prints the numbers of a surface. */
static meniscus_status print_measures(const meniscus_surface* surface) {
  meniscus_summary summary = {.size = sizeof summary};
  meniscus_array array;
  double accessible = 0.0;
  meniscus_status status = meniscus_surface_summary(surface, &summary);
  if (status) return status;
  status = meniscus_surface_table(surface, MENISCUS_ATOM_SAS_AREAS, &array);
  if (status) return status;
  for (size_t n = 0; n < array.count; ++n)
    accessible += *(const double*)((const char*)array.data + n * array.stride);
  printf("atoms %" PRIu64 ", patches %" PRIu64 " + %" PRIu64 " + %" PRIu64 ", components %" PRIu64 "\n", summary.atoms,
         summary.convex, summary.toroidal, summary.concave, summary.components);
  printf("area %.17g, volume %.17g, accessible area %.17g\n", summary.area, summary.volume, accessible);
  return MENISCUS_OK;
}

int main(void) {
  meniscus_computer* computer = NULL;
  meniscus_surface* surface = NULL;
  meniscus_atoms atoms = {.size = sizeof atoms};
  double* const rows = read_rows(&atoms.count);
  meniscus_status status;
  atoms.positions = rows;
  atoms.radii = rows ? rows + 3 : NULL;
  atoms.positions_stride = atoms.radii_stride = 4 * sizeof *rows;
  status = meniscus_computer_new(NULL, &computer);
  if (!status) status = meniscus_compute(computer, &atoms, &surface);
  if (!status) status = print_measures(surface);
  if (status) fprintf(stderr, "areas: %s\n", meniscus_last_error());
  meniscus_surface_release(surface);
  meniscus_computer_release(computer);
  free(rows);
  return (int)status;
}
