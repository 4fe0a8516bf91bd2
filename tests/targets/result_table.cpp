// SPDX-License-Identifier: BSD-3-Clause
// Writes what libmeniscus makes of molecules and of ties, so that the results of two systems can be compared: decisions
// as checksums of all whole numbers, and the bits of areas, volumes and points.
//
// result_table OUTPUT FILE...: a line each for windows of 300 atoms of the files, the whole files, and hundreds of
// ties.
#include <meniscus/meniscus.h>

#include <algorithm>
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace {

[[noreturn]] void fail(const char* what) {
  std::fprintf(stderr, "%s: %s\n", what, meniscus_last_error());
  std::exit(1);
}

void check(meniscus_status status, const char* what) {
  if (status != MENISCUS_OK) fail(what);
}

/// Fowler, Noll and Vo's FNV-1a of numbers, without the padding between them.
class Checksum {
 public:
  void add(std::uint64_t number) {
    for (int n = 0; n < 8; ++n) value_ = (value_ ^ (number >> (8 * n) & 0xff)) * 0x100000001b3u;
  }
  void add(double number) { add(bits(number)); }
  template <typename... Numbers>
  void add_all(Numbers... numbers) {
    (add(numbers), ...);
  }
  void add(const double* numbers, std::size_t count) {
    for (std::size_t n = 0; n < count; ++n) add(numbers[n]);
  }
  std::uint64_t value() const { return value_; }

  static std::uint64_t bits(double number) {
    std::uint64_t result = 0;
    std::memcpy(&result, &number, sizeof result);
    return result;
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325u;
};

/// The results of a molecule, or of many.
struct Results {
  Checksum decisions, numbers, triangles, points;
  double area = 0.0, volume = 0.0;
  std::uint64_t triangle_count = 0, refused = 0;
};

template <typename Row, typename Take>
void for_rows(const meniscus_array& array, const Take& take) {
  const auto* data = static_cast<const char*>(array.data);
  for (std::size_t n = 0; n < array.count; ++n) take(*reinterpret_cast<const Row*>(data + n * array.stride));
}

std::uint64_t whole(std::uint64_t number) { return number; }

void add_tables(const meniscus_surface* surface, Results& to) {
  const auto table = [&](meniscus_surface_table_id id) {
    meniscus_array array{};
    check(meniscus_surface_table(surface, id, &array), "table");
    to.decisions.add(whole(array.count));
    return array;
  };
  for_rows<meniscus_component>(table(MENISCUS_COMPONENTS), [&](const meniscus_component& c) {
    to.decisions.add_all(whole(c.kind), static_cast<std::uint64_t>(std::int64_t{c.euler}));
    to.numbers.add_all(c.area, c.volume);
  });
  for_rows<double>(table(MENISCUS_ATOM_AREAS), [&](double area) { to.numbers.add(area); });
  for_rows<meniscus_convex>(table(MENISCUS_CONVEX), [&](const meniscus_convex& c) {
    to.decisions.add_all(whole(c.atom), whole(c.first_plane), whole(c.plane_count), whole(c.face_count));
  });
  for_rows<meniscus_toroidal>(table(MENISCUS_TOROIDAL), [&](const meniscus_toroidal& t) {
    to.decisions.add_all(whole(t.atom[0]), whole(t.atom[1]), whole(t.probe[0]), whole(t.probe[1]), whole(t.face_count),
                         whole(t.has_piece[0]), whole(t.has_piece[1]));
    to.numbers.add(t.center, 3);
    to.numbers.add_all(t.radius, t.sweep);
  });
  for_rows<meniscus_concave>(table(MENISCUS_CONCAVE), [&](const meniscus_concave& c) {
    to.decisions.add_all(whole(c.contact_count), whole(c.side_count), whole(c.cut_count), whole(c.other_count),
                         whole(c.face_count));
    to.numbers.add(c.center, 3);
  });
  for (const meniscus_surface_table_id id : {MENISCUS_CONTACTS, MENISCUS_CUTS, MENISCUS_HALF_BORDERS})
    for_rows<std::uint32_t>(table(id), [&](std::uint32_t number) { to.decisions.add(whole(number)); });
  for_rows<meniscus_border>(table(MENISCUS_BORDERS), [&](const meniscus_border& b) {
    to.decisions.add_all(whole(b.kind), whole(b.vertex[0]), whole(b.vertex[1]), whole(b.face[0]), whole(b.face[1]));
    to.numbers.add_all(b.radius, b.sweep);
  });
  for_rows<meniscus_loop>(table(MENISCUS_LOOPS),
                          [&](const meniscus_loop& l) { to.decisions.add(whole(l.half_border_count)); });
  for_rows<meniscus_face>(table(MENISCUS_FACES), [&](const meniscus_face& f) {
    to.decisions.add_all(whole(f.kind), whole(f.patch), whole(f.loop_count), whole(f.component), whole(f.tip));
    to.numbers.add(f.area);
  });
  for_rows<double[3]>(table(MENISCUS_VERTICES), [&](const double(&v)[3]) { to.numbers.add(v, 3); });
}

void add_mesh(const meniscus_surface* surface, Results& to) {
  meniscus_mesh_options options{};
  options.size = sizeof options;
  check(meniscus_default_mesh_options(&options), "options");
  options.tolerance = 0.1;
  meniscus_mesh* mesh = nullptr;
  // The refusal that no triangles exist at this tolerance is a result, too.
  if (meniscus_surface_mesh(surface, &options, &mesh) != MENISCUS_OK) {
    ++to.refused;
    return;
  }
  const auto table = [&](meniscus_mesh_table_id id) {
    meniscus_array array{};
    check(meniscus_mesh_table(mesh, id, &array), "table");
    return array;
  };
  const meniscus_array triangles = table(MENISCUS_MESH_TRIANGLES);
  to.triangle_count += triangles.count;
  for_rows<std::uint32_t[3]>(
      triangles, [&](const std::uint32_t(&t)[3]) { to.triangles.add_all(whole(t[0]), whole(t[1]), whole(t[2])); });
  for_rows<double[3]>(table(MENISCUS_MESH_POSITIONS), [&](const double(&p)[3]) { to.points.add(p, 3); });
  meniscus_mesh_release(mesh);
}

void add_molecule(const std::vector<double>& positions, const std::vector<double>& radii, double probe, Results& to) {
  meniscus_options options{};
  options.size = sizeof options;
  check(meniscus_default_options(&options), "options");
  options.probe_radius = probe;
  meniscus_computer* computer = nullptr;
  check(meniscus_computer_new(&options, &computer), "computer");
  meniscus_atoms atoms{};
  atoms.size = sizeof atoms;
  atoms.count = radii.size();
  atoms.positions = positions.data();
  atoms.radii = radii.data();
  meniscus_surface* surface = nullptr;
  check(meniscus_compute(computer, &atoms, &surface), "surface");
  meniscus_summary summary{};
  summary.size = sizeof summary;
  check(meniscus_surface_summary(surface, &summary), "summary");
  to.area += summary.area;
  to.volume += summary.volume;
  add_tables(surface, to);
  add_mesh(surface, to);
  meniscus_surface_release(surface);
  meniscus_computer_release(computer);
}

void write(std::FILE* output, const std::string& name, const Results& r) {
  std::fprintf(output,
               "%s decisions %016" PRIx64 " triangles %" PRIu64 " %016" PRIx64 " area %016" PRIx64 " volume %016" PRIx64
               " numbers %016" PRIx64 " points %016" PRIx64 " refused %" PRIu64 "\n",
               name.c_str(), r.decisions.value(), r.triangle_count, r.triangles.value(), Checksum::bits(r.area),
               Checksum::bits(r.volume), r.numbers.value(), r.points.value(), r.refused);
  std::fflush(output);
}

constexpr std::size_t kWindow = 300;
constexpr int kWindows = 200, kTies = 10000, kTiesInLine = 100;
constexpr double kProbes[] = {1.4, 1.2, 1.6, 3.0};

/// Writes the lines of a file; windows counts the windows of all files.
void write_file(std::FILE* output, const char* path, int& windows) {
  meniscus_structure* structure = nullptr;
  check(meniscus_read(path, nullptr, &structure), path);
  std::vector<double> positions, radii;
  meniscus_array table{};
  check(meniscus_structure_table(structure, MENISCUS_STRUCTURE_POSITIONS, &table), "positions");
  for_rows<double[3]>(table, [&](const double(&p)[3]) { positions.insert(positions.end(), p, p + 3); });
  check(meniscus_structure_table(structure, MENISCUS_STRUCTURE_RADII, &table), "radii");
  for_rows<double>(table, [&](double radius) { radii.push_back(radius); });
  const std::string name(std::strrchr(path, '/') ? std::strrchr(path, '/') + 1 : path);
  for (std::size_t first = 0; first == 0 || first + kWindow <= radii.size(); first += kWindow) {
    if (windows == kWindows) break;
    const std::size_t past = std::min<std::size_t>(radii.size(), first + kWindow);
    Results results;
    const auto begin = static_cast<std::ptrdiff_t>(first), end = static_cast<std::ptrdiff_t>(past);
    add_molecule({positions.begin() + 3 * begin, positions.begin() + 3 * end},
                 {radii.begin() + begin, radii.begin() + end}, kProbes[windows % 4], results);
    write(output, name + "+" + std::to_string(first), results);
    ++windows;
  }
  if (radii.size() > kWindow && radii.size() < 6000) {
    Results results;
    add_molecule(positions, radii, 1.4, results);
    write(output, name, results);
  }
  meniscus_structure_release(structure);
}

/// Draws numbers from 0 to n - 1 (xorshift64*: Vigna, ACM Trans. Math. Softw. 2016).
class Random {
 public:
  std::uint64_t below(std::uint64_t n) {
    state_ ^= state_ >> 12;
    state_ ^= state_ << 25;
    state_ ^= state_ >> 27;
    return (state_ * 0x2545f4914f6cdd1du >> 33) % n;
  }

 private:
  std::uint64_t state_ = 28;
};

/// Adds balls on a small lattice: many probes touch four and more, spheres touch, planes go through corners.
void add_tie(Random& random, Results& to) {
  const double step = 0.25 * static_cast<double>(5 + random.below(8));
  const bool equal = random.below(2) == 0;
  const std::size_t wanted = 3 + random.below(8);
  std::vector<double> positions, radii;
  std::vector<std::uint64_t> taken;
  while (radii.size() < wanted) {
    const std::uint64_t place = random.below(27);
    const double radius = equal ? 1.5 : 1.25 + 0.25 * static_cast<double>(random.below(3));
    if (std::find(taken.begin(), taken.end(), place) != taken.end()) continue;
    taken.push_back(place);
    for (const std::uint64_t n : {place % 3, place / 3 % 3, place / 9})
      positions.push_back(step * static_cast<double>(n));
    radii.push_back(radius);
  }
  add_molecule(positions, radii, 0.25 * static_cast<double>(4 + random.below(5)), to);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: result_table OUTPUT FILE...\n");
    return 2;
  }
  std::FILE* const output = std::fopen(argv[1], "wb");
  if (!output) {
    std::perror(argv[1]);
    return 1;
  }
  const char* const fewer = std::getenv("MENISCUS_TARGETS_TIES");
  const int ties = fewer ? std::atoi(fewer) : kTies;
  int windows = 0;
  for (int n = 2; n < argc; ++n) write_file(output, argv[n], windows);
  Random random;
  for (int first = 0; first < ties; first += kTiesInLine) {
    Results results;
    for (int n = 0; n < kTiesInLine; ++n) add_tie(random, results);
    write(output, "ties+" + std::to_string(first), results);
  }
  return std::fclose(output) == 0 ? 0 : 1;
}
