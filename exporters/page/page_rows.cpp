// SPDX-License-Identifier: BSD-3-Clause
// Predicts the rows of patches from atoms and from rows before them.
#include "exporters/page/page_rows.h"

#include <bit>
#include <numbers>
#include <tuple>

#include "core/render/ray_geometry.h"

namespace meniscus::page {
namespace {

constexpr double kTurnSteps = 1 << 18;  // of angles, in a radian

class RowPredictor {
 public:
  RowPredictor(const RayCastPack& scene, std::vector<glm::vec4> balls, double probe)
      : scene_(scene), balls_(std::move(balls)), probe_(probe), words_(scene.rows.size()) {
    for (std::size_t n = 0; n < words_.size(); ++n) words_[n] = std::bit_cast<RowWords>(scene.rows[n]);
  }

  std::vector<RowWords> run() {
    for (const bool convex : {true, false})  // rows of convex patches have the exact centres of their atoms
      for (const ray_cast::Primitive& primitive : scene_.primitives)
        if ((primitive.kind == ray_cast::kConvex) == convex) predict(primitive);
    for (RowWords& row : words_)
      for (std::uint32_t& word : row) word = word << 1 ^ (word >> 31 ? ~0u : 0u);
    return sorted();
  }

 private:
  glm::dvec3 vector(std::uint32_t row) const { return glm::dvec3(glm::vec3(scene_.rows[row])); }

  void predict(std::uint32_t row, std::initializer_list<double> values, double step = kRounding) {
    std::size_t n = 0;
    for (const double value : values) {
      const double known = std::isfinite(value) ? value : 0.0;
      words_[row][n++] -= std::bit_cast<std::uint32_t>(static_cast<float>(std::floor(known / step + 0.5) * step));
    }
  }

  void predict(const ray_cast::Primitive& primitive) {
    const std::uint32_t first = primitive.first_row;
    if (primitive.kind == ray_cast::kConvex) {
      glm::vec4& ball = balls_[primitive.atom];
      predict(first, {ball.x, ball.y, ball.z, ball.w});
      ball = scene_.rows[first];
    }
    if (primitive.kind == ray_cast::kToroidal)
      predict_toroidal(first, balls_[primitive.atom], balls_[primitive.second_atom]);
    if (primitive.kind == ray_cast::kConcave) predict_concave(first, primitive.plane_count, primitive.atom);
  }

  void predict_toroidal(std::uint32_t first, const glm::dvec4& a, const glm::dvec4& b) {
    const glm::dvec3 between = glm::dvec3(b) - glm::dvec3(a);
    const double distance = std::sqrt(glm::dot(between, between)), a_out = a.w + probe_, b_out = b.w + probe_;
    const double a_z = -0.5 * (distance + (a_out - b_out) * (a_out + b_out) / distance), b_z = a_z + distance;
    const glm::dvec3 center = glm::dvec3(a) - between / distance * a_z;
    predict(first, {center.x, center.y, center.z, std::sqrt(std::max((a_out - a_z) * (a_out + a_z), 0.0))});
    predict(first + 2, {between.x / distance, between.y / distance, between.z / distance});
    const auto shape = geometry::saddle_shape(a_z, b_z, a.w, b.w, double{scene_.rows[first].w}, probe_);
    predict(first + 3, {shape.contact_z[0], shape.contact_z[1], shape.clip_z, shape.clip_radius});
    predict(first + 4, {a_z, a_out, b_z, b_out});
    // The start is perpendicular to the axis, so that one angle gives it; another is that from start to end.
    const glm::dvec3 axis = vector(first + 2), start = vector(first + 1), x = perpendicular_to(axis);
    const auto steps = [](double sine, double cosine) {
      const double angle = std::atan2(sine, cosine);
      return static_cast<std::uint32_t>(std::lround((angle < 0 ? angle + 2 * std::numbers::pi : angle) * kTurnSteps));
    };
    words_[first + 1] = {steps(glm::dot(glm::cross(axis, x), start), glm::dot(x, start)),
                         steps(scene_.rows[first + 2].w, scene_.rows[first + 1].w), 0, 0};
    words_[first + 2][3] = 0;
  }

  /// Returns a vector at a right angle to the axis and to the coordinate axis that is farthest from it.
  static glm::dvec3 perpendicular_to(const glm::dvec3& axis) {
    const glm::dvec3 size = glm::abs(axis);
    glm::dvec3 far(0.0);
    far[size.x <= size.y && size.x <= size.z ? 0 : size.y <= size.z ? 1 : 2] = 1.0;
    return unit(glm::cross(axis, far));
  }
  static glm::dvec3 unit(const glm::dvec3& v) { return v * (1.0 / std::sqrt(glm::dot(v, v))); }

  void predict_concave(std::uint32_t first, std::uint32_t planes, std::uint32_t contacts) {
    predict(first, {0.0, 0.0, 0.0, probe_});
    std::vector<glm::dvec3> directions;
    for (std::uint32_t row = first + 1 + planes; row < first + 1 + planes + contacts; ++row) {
      const auto atom = std::bit_cast<std::uint32_t>(scene_.rows[row].w);
      const glm::dvec3 d = directions.emplace_back(unit(glm::dvec3(balls_[atom]) - vector(first)));
      predict(row, {d.x, d.y, d.z}, kColorRounding);
    }
    for (std::uint32_t n = 0; n < contacts; ++n) {
      const glm::dvec3 side = unit(glm::cross(directions[n], directions[n + 1 < contacts ? n + 1 : 0]));
      predict(first + 1 + n, {side.x, side.y, side.z});
    }
  }

  std::vector<RowWords> sorted() const {
    std::array<std::vector<RowWords>, 25> groups;
    const auto& primitives = scene_.primitives;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      const auto& [kind, planes, contacts] =
          std::tie(primitives[p].kind, primitives[p].plane_count, primitives[p].atom);
      const std::size_t end = p + 1 < primitives.size() ? primitives[p + 1].first_row : words_.size();
      for (std::size_t row = primitives[p].first_row, n = 0; row < end; ++row, ++n) {
        const std::size_t part = kind == ray_cast::kConcave && n > 1 ? (n > planes     ? 4
                                                                        : n > contacts ? 3
                                                                                       : 1)
                                 : kind == ray_cast::kConvex         ? std::min<std::size_t>(n, 1)
                                                                     : std::min<std::size_t>(n, 4);
        groups[5 * kind + part].push_back(words_[row]);
      }
    }
    std::vector<RowWords> all;
    all.reserve(words_.size());
    for (const std::vector<RowWords>& group : groups) all.insert(all.end(), group.begin(), group.end());
    return all;
  }

  const RayCastPack& scene_;
  std::vector<glm::vec4> balls_;
  double probe_;
  std::vector<RowWords> words_;
};

}  // namespace

std::vector<RowWords> row_differences(const RayCastPack& scene, std::vector<glm::vec4> balls, double probe) {
  return RowPredictor(scene, std::move(balls), probe).run();
}

}  // namespace meniscus::page
