// SPDX-License-Identifier: BSD-3-Clause
// The program `meniscus-msms`: the command line, files, socket and output of MSMS for exact surfaces.
#include "app/msms/socket_server.h"

#include <chrono>
#include <iostream>

#include "app/msms/arguments.h"
#include "app/msms/drop_in.h"
#include "app/process/program_main.h"
#include "app/process/system_process.h"
#include "core/base/error.h"
#include "core/base/output_file.h"
#include "core/base/system_file.h"
#include "core/base/text.h"
#include "core/base/version.h"
#include "core/surface/reduced_components.h"
#include "exporters/msms/msms_files.h"

namespace meniscus::msms {
namespace {

constexpr int kWaitForClient = 120'000;  // milliseconds
constexpr int kWaitForBlock = 30;        // seconds
constexpr std::size_t kMostSpheres = 50'000'000;
constexpr std::size_t kSpheresTogether = 1 << 16;  // memory grows with received data, not with announced sizes
constexpr const char* kClient = "the client of -socketPort";

LocalSocket listening_on(std::uint16_t port) {
  std::optional<LocalSocket> listener = LocalSocket::listening_on(port);
  if (!listener)
    throw UsageError("-socketPort {}: the port is not available: {}; try another", port, LocalSocket::last_error());
  return std::move(*listener);
}

LocalSocket first_client(const LocalSocket& listener) {
  if (!listener.has_caller(kWaitForClient))
    throw InputError(kClient, 0, "did not come within {} s", kWaitForClient / 1000);
  std::optional<LocalSocket> client = listener.caller(kWaitForBlock);
  if (!client) throw InputError(kClient, 0, "is gone again: {}", LocalSocket::last_error());
  return std::move(*client);
}

template <typename T, std::size_t kExtent>
void receive(const LocalSocket& client, std::span<T, kExtent> values) {
  std::span<std::byte> bytes = std::as_writable_bytes(values);
  while (!bytes.empty()) {
    const std::ptrdiff_t got = client.receive(bytes);
    if (got == 0) throw InputError(kClient, 0, "closed the connection before it had sent all");
    if (got < 0) throw InputError(kClient, 0, "stopped sending: {}", LocalSocket::last_error());
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
}

void send(const LocalSocket& client, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const std::ptrdiff_t sent = client.send(bytes);
    if (sent <= 0) throw OutputError(kClient, "stopped receiving: {}", LocalSocket::last_error());
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
}

void send(const LocalSocket& client, const std::string& text) { send(client, std::as_bytes(std::span(text))); }

template <typename T>
void send(const LocalSocket& client, const std::vector<T>& values) {
  send(client, std::as_bytes(std::span(values)));
}

struct SentSphere {
  float x, y, z, radius;
  std::int32_t flag;  // the flag of files; VMD's value is ignored
};

Spheres receive_spheres(const LocalSocket& client, Arguments& arguments) {
  std::array<float, 2> probe_and_density{};
  std::array<std::int32_t, 3> numbers{};  // the last one is the number of spheres
  receive(client, std::span(probe_and_density));
  receive(client, std::span(numbers));
  arguments.probe_radius = probe_and_density[0];
  arguments.density = probe_and_density[1];
  if (!is_probe_radius(arguments.probe_radius) || !is_density(arguments.density))
    throw InputError(kClient, 0, "asks for a probe of {} Å and {} vertices per Å²", probe_and_density[0],
                     probe_and_density[1]);
  if (numbers[2] < 1 || static_cast<std::size_t>(numbers[2]) > kMostSpheres)
    throw InputError(kClient, 0, "announces {} spheres; 1 to {} are read", numbers[2], kMostSpheres);
  const auto count = static_cast<std::size_t>(numbers[2]);
  std::vector<Ball> balls;
  for (std::vector<SentSphere> part; balls.size() < count;) {
    part.resize(std::min(kSpheresTogether, count - balls.size()));
    receive(client, std::span(part));
    for (const SentSphere& s : part) balls.push_back({{s.x, s.y, s.z}, s.radius});
  }
  return spheres_of(std::move(balls), {}, kClient);
}

void send_mesh(const LocalSocket& client, const MsmsMesh& mesh, const Spheres& spheres) {
  send(client, "MSMS RCF\n");
  send(client,
       std::vector{static_cast<std::int32_t>(mesh.triangles.size()), static_cast<std::int32_t>(mesh.vertices.size())});
  std::vector<std::int32_t> rows;
  rows.reserve(5 * mesh.triangles.size());
  for (const MsmsTriangle& t : mesh.triangles) {
    for (const std::uint32_t corner : t.corner) rows.push_back(static_cast<std::int32_t>(corner));
    rows.push_back(static_cast<std::int32_t>(t.kind));
    rows.push_back(static_cast<std::int32_t>(t.face));
  }
  send(client, rows);
  std::vector<float> points;
  points.reserve(6 * mesh.vertices.size());
  rows.clear();
  for (const MsmsVertex& v : mesh.vertices) {
    for (const glm::dvec3& x : {v.normal, v.position})
      for (int axis = 0; axis < 3; ++axis) points.push_back(static_cast<float>(x[axis]));
    rows.push_back(static_cast<std::int32_t>(spheres.rows.of_atom[v.atom]));
  }
  send(client, points);
  send(client, rows);
  send(client, "MSMS END\n");
}

/// The version of MSMS with these files and lines.
constexpr const char* kAnswersAs = "2.6.1";

/// Returns the program's name, the version that it emulates, and the machine.
std::string banner() {
  const std::string host = system_process::host();
  return fmt::format(
      "MSMS {} started on {}\n"
      "Copyright of the Meniscus developers: this is meniscus-msms " MENISCUS_VERSION
      ", which answers as MSMS does\n"
      "Compilation flags none\n",
      kAnswersAs, host.empty() ? "localhost" : host);
}

/// Returns the lines INPUT and PARAM.
std::string input_lines(const Arguments& arguments, std::size_t spheres, double smallest_radius,
                        double largest_radius) {
  return fmt::format(
      "INPUT  {} {} spheres 0 collision only, radii {:6.3f} to {:6.3f}\n"
      "PARAM  Probe_radius {:6.3f} density {:6.3f} hdensity {:6.3f}\n",
      escaped(arguments.spheres), spheres, smallest_radius, largest_radius, arguments.probe_radius, arguments.density,
      arguments.hdensity);
}

/// Returns one line for each component above number 0, which have files of their own.
std::string component_lines(std::size_t count) {
  std::string lines;
  for (std::size_t c = 1; c < count; ++c) lines += fmt::format("    RS component {} identified\n", c);
  return lines;
}

/// Returns the areas of each component, in closed form.
std::string analytic_table(double probe_radius, std::span<const ReducedComponentSize> sizes) {
  std::string table =
      "ANALYTICAL SURFACE AREA :\n    Comp. probe_radius,   reent,    toric,   contact    SES       SAS\n";
  for (std::size_t c = 0; c < sizes.size(); ++c)
    table += fmt::format("{:7d} {:11.3f} {:11.3f} {:9.3f} {:9.3f} {:9.3f} {:9.3f}\n", c, probe_radius,
                         sizes[c].reentrant, sizes[c].toroidal, sizes[c].contact, sizes[c].area(), sizes[c].accessible);
  return table;
}

/// Returns volume and area of each component, and the sum of volumes, in closed form; MSMS takes them from triangles.
std::string numeric_table(double probe_radius, std::span<const ReducedComponentSize> sizes) {
  std::string table = "NUMERICAL VOLUMES AND AREA\n    Comp. probe_radius SES_volume SES_area)\n";
  double total = 0;
  for (std::size_t c = 0; c < sizes.size(); ++c) {
    table += fmt::format("{:8d} {:9.2f} {:12.3f} {:10.3f}\n", c, probe_radius, sizes[c].volume, sizes[c].area());
    total += sizes[c].volume;
  }
  return table + fmt::format("    Total ses_volume: {:9.3f}\n", total);
}

/// Returns the last two lines: the time since `start`, and the processor time since the process began.
std::string ending(std::chrono::steady_clock::time_point start) {
  const system_process::ProcessorTime used = system_process::processor_time();
  const std::chrono::duration<double> real = std::chrono::steady_clock::now() - start;
  return fmt::format("MSMS terminated normally\nTotal Time real: {:.2f} user: {:.2f} sys: {:.2f}\n", real.count(),
                     used.user, used.system);
}

std::string with_extension(const std::string& path, const std::string& extension) {
  return path.ends_with(extension) ? path : path + extension;
}

/// Returns P.vert for component 0, and P_k.vert for component k.
std::string mesh_path(const Arguments& arguments, std::size_t component, const char* extension) {
  return arguments.mesh_files + (component ? "_" + std::to_string(component) : "") + extension;
}

void run(const Arguments& arguments, std::chrono::steady_clock::time_point start) {
  const bool mesh_wanted = arguments.mesh && !arguments.mesh_files.empty();
  // Files are opened before the work begins, so that errors come early.
  OutputFiles files;
  protect_input(path_of_text(arguments.spheres));
  if (mesh_wanted)
    for (const char* extension : {".vert", ".face"}) files.begin(mesh_path(arguments, 0, extension));
  const std::string area_path = arguments.area_file.empty() ? "" : with_extension(arguments.area_file, ".area");
  if (!area_path.empty()) files.begin(area_path);

  Spheres spheres = read_spheres(arguments.spheres);
  if (!arguments.hydrogens) leave_out_hydrogens(spheres);
  std::cout << input_lines(arguments, spheres.rows.count, spheres.smallest_radius, spheres.largest_radius);
  ChosenSurface surface(arguments, spheres);
  if (arguments.all_components) std::cout << component_lines(surface.component_count());
  const std::vector<ReducedComponentSize> sizes = surface.sizes();
  if (arguments.area) std::cout << analytic_table(arguments.probe_radius, sizes);
  if (!area_path.empty()) files.write(area_path, area_text(surface.areas(), spheres.rows));
  if (mesh_wanted) {
    surface.triangulate();
    const MsmsHeader header{arguments.header, arguments.density, arguments.probe_radius};
    for (std::size_t c = 0; c < surface.component_count(); ++c) {
      const MsmsMesh mesh = surface.mesh(c);
      files.write(mesh_path(arguments, c, ".vert"), vert_text(mesh, spheres.rows, header));
      files.write(mesh_path(arguments, c, ".face"), face_text(mesh, spheres.rows, header));
    }
  }
  if (arguments.mesh) std::cout << numeric_table(arguments.probe_radius, sizes);
  files.commit();
  std::cout << ending(start);
}

ExitCode run(std::span<const char* const> words) {
  const auto start = std::chrono::steady_clock::now();
  const Arguments arguments = parse_arguments(words);
  if (arguments.help) {
    std::cerr << help_text();
    return kExitOk;
  }
  std::cout << banner();
  if (arguments.port) {
    std::cout.flush();
    serve(*arguments.port);
  } else if (arguments.spheres.empty()) {
    std::cerr << "MSMS: No input stream specified\n";
    return kExitUsage;
  } else {
    run(arguments, start);
  }
  finish_standard_output();
  return kExitOk;
}

}  // namespace

void serve(std::uint16_t port) {
  const LocalSocket listener = listening_on(port);
  const LocalSocket client = first_client(listener);
  send(client, "MSMS of meniscus-msms " MENISCUS_VERSION "\n");
  Arguments arguments;
  const Spheres spheres = receive_spheres(client, arguments);
  ChosenSurface surface(arguments, spheres);
  surface.triangulate();
  send_mesh(client, surface.mesh(0), spheres);
}

}  // namespace meniscus::msms

int main(int argc, char** argv) {
  using namespace meniscus;
  return program_main("meniscus-msms", [=] { return msms::run(system_process::words(argc, argv).subspan(1)); });
}
