// SPDX-License-Identifier: BSD-3-Clause
// Serves one client, with a limit on every wait and every size.
#include "app/msms/serve.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/msms/chosen_surface.h"
#include "app/msms/socket_server.h"
#include "app/process/program_error.h"
#include "core/base/error.h"
#include "core/base/version.h"

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
    throw UsageError(
        fmt::format("-socketPort {}: the port is not available: {}; try another", port, LocalSocket::last_error()));
  return std::move(*listener);
}

LocalSocket first_client(const LocalSocket& listener) {
  if (!listener.has_caller(kWaitForClient))
    throw InputError(kClient, 0, fmt::format("did not come within {} s", kWaitForClient / 1000));
  std::optional<LocalSocket> client = listener.caller(kWaitForBlock);
  if (!client) throw InputError(kClient, 0, fmt::format("is gone again: {}", LocalSocket::last_error()));
  return std::move(*client);
}

template <typename T, std::size_t kExtent>
void receive(const LocalSocket& client, std::span<T, kExtent> values) {
  std::span<std::byte> bytes = std::as_writable_bytes(values);
  while (!bytes.empty()) {
    const std::ptrdiff_t got = client.receive(bytes);
    if (got == 0) throw InputError(kClient, 0, "closed the connection before it had sent all");
    if (got < 0) throw InputError(kClient, 0, fmt::format("stopped sending: {}", LocalSocket::last_error()));
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
}

void send(const LocalSocket& client, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const std::ptrdiff_t sent = client.send(bytes);
    if (sent <= 0) throw OutputError(kClient, fmt::format("stopped receiving: {}", LocalSocket::last_error()));
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
  std::int32_t flag;  // as in files; VMD's value is ignored
};

Spheres receive_spheres(const LocalSocket& client, Arguments& arguments) {
  std::array<float, 2> probe_and_density{};
  std::array<std::int32_t, 3> numbers{};  // the last one is the number of spheres
  receive(client, std::span(probe_and_density));
  receive(client, std::span(numbers));
  arguments.probe_radius = probe_and_density[0];
  arguments.density = probe_and_density[1];
  if (!is_probe_radius(arguments.probe_radius) || !is_density(arguments.density))
    throw InputError(
        kClient, 0,
        fmt::format("asks for a probe of {} Å and {} vertices per Å²", probe_and_density[0], probe_and_density[1]));
  if (numbers[2] < 1 || static_cast<std::size_t>(numbers[2]) > kMostSpheres)
    throw InputError(kClient, 0, fmt::format("announces {} spheres; 1 to {} are read", numbers[2], kMostSpheres));
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
