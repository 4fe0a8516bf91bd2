// SPDX-License-Identifier: BSD-3-Clause
// Plain blocking sockets: there is one client, and whatever it has to wait for or we have has a limit.
#include "app/msms/serve.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <fmt/format.h>

#include "app/msms/chosen_surface.h"
#include "app/process/program_error.h"
#include "core/base/error.h"
#include "core/base/uninterrupted.h"

namespace meniscus::msms {
namespace {

constexpr int kWaitForClient = 120'000;  // milliseconds
constexpr int kWaitForBlock = 30;        // seconds
constexpr std::size_t kMostSpheres = 50'000'000;
constexpr std::size_t kSpheresTogether = 1 << 16;  // memory grows with what has come, not with what was announced
constexpr const char* kClient = "the client of -socketPort";

/// Closed with this object.
class Socket {
 public:
  explicit Socket(int descriptor) : descriptor_(descriptor) {}
  ~Socket() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

[[noreturn]] void refuse_port(std::uint16_t port) {
  throw UsageError(fmt::format("-socketPort {}: the port cannot be had: {}; try another", port, std::strerror(errno)));
}

int listening_on(std::uint16_t port) {
  const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (descriptor < 0) refuse_port(port);
  const int on = 1;
  ::setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_port = htons(port);
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::bind(descriptor, reinterpret_cast<const sockaddr*>(&here), sizeof here) != 0 || ::listen(descriptor, 1) != 0) {
    const int error = errno;
    ::close(descriptor);
    errno = error;
    refuse_port(port);
  }
  return descriptor;
}

int first_client(const Socket& listener) {
  pollfd waiting{listener.descriptor(), POLLIN, 0};
  if (uninterrupted([&] { return ::poll(&waiting, 1, kWaitForClient); }) <= 0)
    throw InputError(kClient, 0, fmt::format("did not come within {} s", kWaitForClient / 1000));
  const int client = uninterrupted([&] { return ::accept4(listener.descriptor(), nullptr, nullptr, SOCK_CLOEXEC); });
  if (client < 0) throw InputError(kClient, 0, fmt::format("is gone again: {}", std::strerror(errno)));
  const timeval limit{kWaitForBlock, 0};
  ::setsockopt(client, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  ::setsockopt(client, SOL_SOCKET, SO_SNDTIMEO, &limit, sizeof limit);
  return client;
}

template <typename T, std::size_t kExtent>
void receive(const Socket& client, std::span<T, kExtent> values) {
  std::span<std::byte> bytes = std::as_writable_bytes(values);
  while (!bytes.empty()) {
    const ssize_t got = uninterrupted([&] { return ::recv(client.descriptor(), bytes.data(), bytes.size(), 0); });
    if (got == 0) throw InputError(kClient, 0, "closed the connection before it had sent all");
    if (got < 0) throw InputError(kClient, 0, fmt::format("sends nothing more: {}", std::strerror(errno)));
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
}

void send(const Socket& client, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent =
        uninterrupted([&] { return ::send(client.descriptor(), bytes.data(), bytes.size(), MSG_NOSIGNAL); });
    if (sent <= 0) throw OutputError(kClient, fmt::format("takes nothing more: {}", std::strerror(errno)));
    bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
}

void send(const Socket& client, const std::string& text) { send(client, std::as_bytes(std::span(text))); }

template <typename T>
void send(const Socket& client, const std::vector<T>& values) {
  send(client, std::as_bytes(std::span(values)));
}

struct SentSphere {
  float x, y, z, radius;
  std::int32_t flag;  // as in files; what VMD has there is not looked at
};

Spheres receive_spheres(const Socket& client, Arguments& arguments) {
  std::array<float, 2> probe_and_density{};
  std::array<std::int32_t, 3> numbers{};  // of which the last one counts the spheres
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

void send_mesh(const Socket& client, const MsmsMesh& mesh, const Spheres& spheres) {
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
  const Socket listener(listening_on(port));
  const Socket client(first_client(listener));
  send(client, "MSMS of meniscus-msms " MENISCUS_VERSION "\n");
  Arguments arguments;
  const Spheres spheres = receive_spheres(client, arguments);
  ChosenSurface surface(arguments, spheres);
  surface.triangulate();
  send_mesh(client, surface.mesh(0), spheres);
}

}  // namespace meniscus::msms
