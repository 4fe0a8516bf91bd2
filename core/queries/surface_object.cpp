// SPDX-License-Identifier: BSD-3-Clause
// Compares the tables of two surfaces row by row; both are sorted the same way.
#include "core/queries/surface_object.h"

#include <fmt/format.h>

namespace meniscus {
namespace {

constexpr double kLength = 1e-9;  // Å
constexpr double kShare = 1e-9;   // relative difference of areas, volumes and angles

bool near(double a, double b) { return std::abs(a - b) <= kShare * std::max({1.0, std::abs(a), std::abs(b)}); }
bool near(const glm::dvec3& a, const glm::dvec3& b) { return glm::distance(a, b) <= kLength; }

class Comparison {
 public:
  Comparison(const Surface& a, const Surface& b) : a_(a), b_(b) {}

  std::vector<std::string> run() {
    rows("convex patch", a_.convex, b_.convex, [&](const ConvexPatch& x, const ConvexPatch& y) {
      return x.atom == y.atom && x.plane_count == y.plane_count && x.face_count == y.face_count;
    });
    rows("toroidal patch", a_.toroidal, b_.toroidal, [&](const ToroidalPatch& x, const ToroidalPatch& y) {
      return x.atom == y.atom && x.probe == y.probe && near(x.center, y.center) && near(x.radius, y.radius) &&
             near(x.start, y.start) && near(x.sweep, y.sweep);
    });
    rows("concave patch", a_.concave, b_.concave, [&](const ConcavePatch& x, const ConcavePatch& y) {
      return near(x.center, y.center) && x.face_count == y.face_count &&
             std::equal(a_.contacts.begin() + x.first_contact, a_.contacts.begin() + x.first_contact + x.contact_count,
                        b_.contacts.begin() + y.first_contact,
                        b_.contacts.begin() + y.first_contact + y.contact_count) &&
             std::equal(a_.cuts.begin() + x.first_cut, a_.cuts.begin() + x.first_cut + x.cut_count,
                        b_.cuts.begin() + y.first_cut, b_.cuts.begin() + y.first_cut + y.cut_count);
    });
    rows("border", a_.borders, b_.borders, [&](const Border& x, const Border& y) {
      return x.kind == y.kind && x.vertex == y.vertex && x.face == y.face && near(x.center, y.center) &&
             near(x.radius, y.radius) && near(x.sweep, y.sweep);
    });
    rows("plane", a_.planes, b_.planes,
         [&](const Plane& x, const Plane& y) { return near(x.normal, y.normal) && near(x.offset, y.offset); });
    rows("vertex", a_.vertices, b_.vertices, [&](const glm::dvec3& x, const glm::dvec3& y) { return near(x, y); });
    rows("component", a_.components, b_.components, [&](const Component& x, const Component& y) {
      return x.kind == y.kind && x.euler == y.euler && near(x.area, y.area) && near(x.volume, y.volume);
    });
    if (!near(a_.area, b_.area)) found_.push_back(fmt::format("area {} Å² and {} Å²", a_.area, b_.area));
    if (!near(a_.volume, b_.volume)) found_.push_back(fmt::format("volume {} Å³ and {} Å³", a_.volume, b_.volume));
    return std::move(found_);
  }

 private:
  /// Compares the rows of two tables.
  template <typename Row, typename Equal>
  void rows(const char* what, const std::vector<Row>& a, const std::vector<Row>& b, Equal&& equal) {
    if (a.size() != b.size()) found_.push_back(fmt::format("{} {}s and {}", a.size(), what, b.size()));
    for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n)
      if (!equal(a[n], b[n])) found_.push_back(fmt::format("{} {} differs", what, n));
  }

  const Surface& a_;
  const Surface& b_;
  std::vector<std::string> found_;
};

}  // namespace

std::vector<std::string> differences(const Surface& a, const Surface& b) { return Comparison(a, b).run(); }

}  // namespace meniscus
