// SPDX-License-Identifier: BSD-3-Clause
// Draws the maps of light: balls, as seen from many directions.
#include "core/render/light_maps.h"

#include <bit>
#include <tuple>

#include <tbb/parallel_for.h>

#include "core/color/coloring.h"
#include "core/math/rigid_motion.h"
#include "core/math/vector_loops.h"
#include "core/queries/surface_object.h"
#include "core/shapes/shapes.h"

namespace meniscus {
namespace {

constexpr float kEmpty = -1e30f, kNone = 2.0f * kEmpty;  // heights of an empty texel, and of nothing

/// Calls add(point) for points of a line that are at most `step` apart.
template <typename Add>
void walk(const glm::dvec3& from, const glm::dvec3& to, double step, const Add& add) {
  const int count = static_cast<int>(std::ceil(glm::length(to - from) / step));
  for (int n = 0; n <= count; ++n) add(count ? glm::mix(from, to, static_cast<double>(n) / count) : from);
}

constexpr int kRun = 8;             // texels whose coverage is computed at once
constexpr float kLeastDisc = 0.5f;  // texels; larger discs of small balls would stand out of flat faces
constexpr float kLeastSoft = 1.2f;  // texels; the edges of smaller balls are not smoothed, because many overlap

/// The parts of a map's texels that its balls cover. Heights are in texels.
class Coverage {
 public:
  explicit Coverage(std::size_t texels) : whole_(texels + kRun, kEmpty), edge_(whole_), clear_(whole_.size(), 1.0f) {}

  /// Adds a ball at `count` texels. shares: of the texels that the ball covers; at most 0: nothing, at least 1: all.
  MENISCUS_VECTOR_CLONES
  void add(std::size_t first, int count, const float* __restrict heights, const float* __restrict shares) {
    float* __restrict whole = &whole_[first], * __restrict edge = &edge_[first], * __restrict clear = &clear_[first];
    for (int n = 0; n < count; ++n) {
      const float h = heights[n], share = shares[n], w = whole[n], e = edge[n], c = clear[n];
      const float all = share >= 1.0f ? h : kNone, some = share >= 1.0f ? kNone : share > 0.0f ? h : kNone;
      const float part = some > w ? some : kNone, left = some > w ? 1.0f - share : 1.0f;
      whole[n] = w < all ? all : w;
      edge[n] = e < part ? part : e;
      clear[n] = all >= e ? 1.0f : c * left;  // covers the edge
    }
  }

  /// Writes the words of light_maps.glsl, as floats of these bits. steps: of height, of a texel.
  MENISCUS_VECTOR_CLONES
  void write(float steps, std::span<float> words) const {
    const auto step = [&](float height) {  // nothing is step 0
      return static_cast<int>(std::max(height * steps + 0.5f * (kernel::kLightSteps + 1), 0.0f));
    };
    for (std::size_t at = 0; at < words.size(); ++at) {
      const int covered = step(edge_[at]) << 5 | static_cast<int>(31.5f - 31.0f * clear_[at]);
      words[at] = std::bit_cast<float>(step(whole_[at]) << 18 | (edge_[at] > whole_[at] ? covered : 0));
    }
  }

 private:
  std::vector<float> whole_, edge_;  ///< height of what covers all of a texel, and of the highest edge above that
  std::vector<float> clear_;         ///< share of a texel that edges leave clear
};

/// Computes what a ball covers of `count` texels of a line: heights along and against the axis, and shares, which are
/// about the areas within the ball's disc. x, y: from the first texel to the ball's centre; z: of the centre.
MENISCUS_VECTOR_CLONES
void cover(float x, float y, float z, float radius, int count, float* __restrict highest, float* __restrict lowest,
           float* __restrict shares) {
  const float disc = std::max(radius, kLeastDisc), per_square = radius < kLeastSoft ? 1e6f : 0.5f / disc;
  const float middle = 0.5f + disc * disc * per_square;
  for (int n = 0; n < count; ++n) {
    const float aside = static_cast<float>(n) - x, square = aside * aside + y * y, under = radius * radius - square;
    const float height = std::sqrt(under > 0.0f ? under : 0.0f);
    highest[n] = z + height;
    lowest[n] = height - z;
    shares[n] = middle - square * per_square;
  }
}

}  // namespace

glm::dvec2 r2_point(std::size_t index) {
  const auto n = static_cast<double>(index);
  const double u = 0.5 + n * 0.7548776662466927, v = 0.5 + n * 0.5698402909980532;
  return {u - std::floor(u), v - std::floor(v)};
}

std::vector<glm::dvec3> lamp_directions(const Look& look, const ViewBasis& basis, std::size_t count) {
  const glm::dvec3 aside = glm::normalize(glm::dvec3(look.light_direction));
  const glm::dvec3 lamp = basis.right * aside.x + basis.up * aside.y - basis.forward * aside.z;
  const glm::dvec3 x =
      glm::normalize(glm::cross(lamp, std::abs(glm::dot(lamp, basis.up)) < 0.9 ? basis.up : basis.right));
  const glm::dvec3 y = glm::cross(lamp, x);
  const double disc = std::tan(static_cast<double>(look.shadow_softness) * std::numbers::pi / 180.0);
  std::vector<glm::dvec3> directions;
  for (std::size_t n = 0; n < count; ++n) {
    const glm::dvec2 point = r2_point(n);
    const double r = disc * std::sqrt(point.x), angle = 2.0 * std::numbers::pi * point.y;
    directions.push_back(glm::normalize(lamp + r * (std::cos(angle) * x + std::sin(angle) * y)));
  }
  return directions;
}

void LightMaps::add_shapes(const Shapes& shapes, const std::vector<float>& blocking, std::vector<Blocker>& balls) {
  const auto add = [&](const glm::dvec3& center, double radius, std::uint32_t atom) {
    if (blocking[atom] > 0.0f) balls.push_back({{center, radius}, blocking[atom]});
  };
  for (const SphereShape& sphere : shapes.spheres) add(sphere.center, sphere.radius, sphere.atom);
  for (const CylinderShape& stick : shapes.cylinders) {
    const glm::dvec3 middle = 0.5 * (stick.from + stick.to);
    walk(stick.from, middle, kLightMapStep, [&](const glm::dvec3& p) { add(p, stick.radius, stick.from_atom); });
    walk(middle, stick.to, kLightMapStep, [&](const glm::dvec3& p) { add(p, stick.radius, stick.to_atom); });
  }
  const MeshShape& mesh = shapes.mesh;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto sunk = [&](std::uint32_t v) {
      return mesh.positions[v] - kMeshBallRadius * glm::dvec3(mesh.normals[v]);
    };
    const glm::dvec3 corner = sunk(a), right = sunk(b) - corner, up = sunk(c) - corner;
    const double longest = std::max({glm::length(right), glm::length(up), glm::length(up - right)});
    const int parts = std::max(static_cast<int>(std::ceil(longest / kLightMapStep)), 1);
    // The triangle is divided into equal triangles, and each of them gets a ball in its middle. Every second one of a
    // row points the other way.
    for (int i = 0; i < parts; ++i)
      for (int j = 0; j < 2 * (parts - i) - 1; ++j)
        add(corner + ((i + (j % 2 + 1) / 3.0) * right + (j / 2 + (j % 2 + 1) / 3.0) * up) / static_cast<double>(parts),
            kMeshBallRadius, mesh.atoms[a]);
  }
}

void LightMaps::add(const PictureObject& object) {
  const std::vector<float> blocking = object.coloring->blocking();
  if (object.surface)
    add(object.surface->atoms, blocking);
  else
    add_shapes(*object.shapes, blocking, groups_.emplace_back().balls);
  groups_.back().planes = object.clip;
}

void LightMaps::add(const SurfaceObject& object) {
  const std::vector<float> blocking = object.coloring.blocking();
  for (const RigidMotion& motion : object.copies) {
    add(object.surface.atoms, blocking);
    for (Blocker& ball : groups_.back().balls) ball.center = motion(ball.center);
  }
}

void LightMaps::add(std::span<const Ball> balls, const std::vector<float>& blocking) {
  std::vector<Blocker>& group = groups_.emplace_back().balls;
  for (std::size_t a = 0; a < balls.size(); ++a)
    if (blocking[a] > 0.0f) group.push_back({balls[a], blocking[a]});
}

LightMaps::View LightMaps::view_along(const glm::dvec3& axis) {
  const glm::dvec3 aside = std::abs(axis.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 right = glm::normalize(glm::cross(aside, axis));
  return {right, glm::cross(axis, right), axis};
}

bool LightMaps::Group::has_planes_of(const Group& other) const {
  return std::ranges::equal(planes, other.planes, [](const ClipPlane& x, const ClipPlane& y) {
    return x.normal == y.normal && x.offset == y.offset;
  });
}

bool LightMaps::same(const Group& a, const Group& b) {
  return a.has_planes_of(b) && std::ranges::equal(a.balls, b.balls, [](const Blocker& x, const Blocker& y) {
           return x.center == y.center && x.radius == y.radius && x.share == y.share;
         });
}

/// Sets the size of the maps by the extent of all balls, and the axes of the sky.
void LightMaps::place_sky(int axes) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const Group& group : groups_)
    for (const Ball& ball : group.balls) {
      low = glm::min(low, ball.center);
      high = glm::max(high, ball.center);
    }
  middle_ = low.x <= high.x ? 0.5 * (low + high) : glm::dvec3(0.0);
  double radius = 1.0;
  for (const Group& group : groups_)
    for (const Ball& ball : group.balls) radius = std::max(radius, glm::length(ball.center - middle_) + ball.radius);
  const auto fit = [radius](const LightMapSize& size, double& texel, int& edge) {
    texel = std::max(size.finest_texel, 2.0 * radius / (size.largest_edge - 2 * kLightMapMargin));
    edge = static_cast<int>(std::ceil(2.0 * radius / texel)) + 2 * kLightMapMargin;
  };
  fit(kSkyMapSize, sky_texel_, sky_edge_);
  fit(kLampMapSize, lamp_texel_, lamp_edge_);
  sky_axes_ = axes;
  views_.clear();
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int n = 0; n < axes; ++n) {
    // A spiral over the hemisphere (Vogel 1979): each axis has the same solid angle.
    const double z = 1.0 - (n + 0.5) / axes, across = std::sqrt(1.0 - z * z), angle = n * golden_angle;
    views_.push_back(view_along({across * std::cos(angle), across * std::sin(angle), z}));
  }
}

void LightMaps::put_in_order() {
  std::vector<Group> joined;
  for (Group& group : groups_) {
    const auto with_planes =
        std::ranges::find_if(joined, [&](const Group& other) { return other.has_planes_of(group); });
    if (with_planes == joined.end())
      joined.push_back(std::move(group));
    else
      with_planes->balls.insert(with_planes->balls.end(), group.balls.begin(), group.balls.end());
  }
  groups_ = std::move(joined);
  const auto place = [](const Blocker& ball) {
    const glm::dvec3& p = ball.center;
    return std::tuple(p.x, p.y, p.z, ball.radius, ball.share);
  };
  for (Group& group : groups_) std::ranges::sort(group.balls, {}, place);
  std::ranges::sort(groups_, {}, [&](const Group& group) {
    return std::pair(group.balls.size(), group.balls.empty() ? place({}) : place(group.balls.front()));
  });
}

void LightMaps::make(const Look& look, const ViewBasis& basis) {
  put_in_order();
  const int axes = look.maps_sky() ? kernel::kMostSkyAxes : 0;
  const bool keeps_sky = axes == sky_axes_ && !views_.empty() && std::ranges::equal(groups_, drawn_, same);
  if (!keeps_sky) place_sky(axes);
  views_.resize(static_cast<std::size_t>(axes));
  if (look.maps_lamp())
    for (const glm::dvec3& way : lamp_directions(look, basis, kernel::kMostLampPlaces))
      views_.push_back(view_along(way));
  const auto texels_of = [](int edge) { return static_cast<std::size_t>(edge) * edge; };
  const std::size_t sky = texels_of(sky_edge_), lamp = texels_of(lamp_edge_), sky_end = 2 * sky * axes;
  texels_.resize(sky_end + lamp * (views_.size() - axes));
  tbb::parallel_for(std::size_t{keeps_sky ? static_cast<std::size_t>(axes) : 0}, views_.size(), [&](std::size_t n) {
    const auto first_lamp = static_cast<std::size_t>(axes);
    // The least shares of maps that look in neighbouring directions are distant.
    const double place = (static_cast<double>(n) + 0.5) * std::numbers::sqrt3, least_share = place - std::floor(place);
    if (n < first_lamp)
      draw(views_[n], {sky_texel_, sky_edge_, least_share, &texels_[2 * n * sky], &texels_[(2 * n + 1) * sky]});
    else
      draw(views_[n], {lamp_texel_, lamp_edge_, least_share, &texels_[sky_end + (n - first_lamp) * lamp], nullptr});
  });
  drawn_ = groups_;
}

void LightMaps::draw(const View& view, const Raster& raster) const {
  const double scale = 1.0 / raster.texel, half = 0.5 * (raster.edge - 1);
  const std::size_t texels = static_cast<std::size_t>(raster.edge) * raster.edge;
  Coverage along(texels), against(raster.against ? texels : 0);
  // These are values of the texels of one line: the heights of a ball along and against the axis, and the shares that
  // it covers.
  std::vector<float> highest(static_cast<std::size_t>(raster.edge) + kRun), lowest(highest), shares(highest);
  for (const Group& group : groups_)
    for (const Blocker& ball : group.balls) {
      if (static_cast<double>(ball.share) <= raster.least_share) continue;
      const bool cut = std::ranges::any_of(group.planes, [&](const ClipPlane& plane) {
        return plane.offset - glm::dot(plane.normal, ball.center) < ball.radius;
      });
      // Keeps the part of column n of a run that is not cut.
      const auto keep = [&](int column, int line, int n) {
        const glm::dvec3 foot =
            middle_ + view.right * ((column - half) * raster.texel) + view.up * ((line - half) * raster.texel);
        for (const ClipPlane& plane : group.planes) {
          const double slope = glm::dot(plane.normal, view.axis) * raster.texel;
          const double room = plane.offset - glm::dot(plane.normal, foot);
          if (slope > 0.0) highest[n] = std::min(highest[n], static_cast<float>(room / slope));
          if (slope < 0.0) lowest[n] = std::min(lowest[n], static_cast<float>(-room / slope));
          if ((slope == 0.0 && room < 0.0) || -lowest[n] > highest[n]) shares[n] = 0.0f;
        }
      };
      const glm::dvec3 center = (ball.center - middle_) * scale;
      const auto x = static_cast<float>(glm::dot(center, view.right) + half),
                 y = static_cast<float>(glm::dot(center, view.up) + half),
                 z = static_cast<float>(glm::dot(center, view.axis)), radius = static_cast<float>(ball.radius * scale);
      const float reach = std::max(radius, kLeastDisc) + (radius < kLeastSoft ? 0.0f : 0.5f);
      const int first = static_cast<int>(std::ceil(x - reach)), last = static_cast<int>(y + reach);
      const int count = (static_cast<int>(x + reach) - first + kRun) / kRun * kRun;
      for (int line = static_cast<int>(std::ceil(y - reach)); line <= last; ++line) {
        const float off = static_cast<float>(line) - y;
        cover(x - static_cast<float>(first), off, z, radius, count, highest.data(), lowest.data(), shares.data());
        for (int n = 0; cut && n < count; ++n) keep(first + n, line, n);
        const std::size_t at = static_cast<std::size_t>(line) * raster.edge + static_cast<std::size_t>(first);
        along.add(at, count, highest.data(), shares.data());
        if (raster.against) against.add(at, count, lowest.data(), shares.data());
      }
    }
  const float steps = static_cast<float>(kernel::kLightSteps) / static_cast<float>(raster.edge);
  along.write(steps, {raster.along, texels});
  if (raster.against) against.write(steps, {raster.against, texels});
}

kernel::LightMapParameters LightMaps::parameters(const PictureFrame& frame) const {
  kernel::LightMapParameters maps{};
  maps.sky_texel = static_cast<float>(sky_texel_);
  maps.lamp_texel = static_cast<float>(lamp_texel_);
  maps.sky_edge = sky_edge_;
  maps.lamp_edge = lamp_edge_;
  maps.sky_axes = sky_axes_;
  maps.lamp_places = static_cast<int>(views_.size()) - sky_axes_;
  maps.first_lamp_texel = 2 * sky_axes_ * sky_edge_ * sky_edge_;
  // The camera's position, or the point before the pivot in an orthographic picture, is the origin of its axes.
  const ViewBasis& basis = frame.basis;
  const glm::dvec3 eye = frame.pivot - basis.forward * frame.eye_distance - middle_;
  const auto row = [&](const glm::dvec3& v, double scale, double offset) {
    return glm::vec4(scale * glm::dvec3(glm::dot(v, basis.right), glm::dot(v, basis.up), -glm::dot(v, basis.forward)),
                     scale * glm::dot(v, eye) + offset);
  };
  for (std::size_t n = 0; n < views_.size(); ++n) {
    const bool sky = n < static_cast<std::size_t>(sky_axes_);
    const double scale = 1.0 / (sky ? sky_texel_ : lamp_texel_), half = 0.5 * ((sky ? sky_edge_ : lamp_edge_) - 1);
    maps.rows[3 * n] = row(views_[n].right, scale, half);
    maps.rows[3 * n + 1] = row(views_[n].up, scale, half);
    maps.rows[3 * n + 2] = row(views_[n].axis, scale, 0.0);
  }
  return maps;
}

}  // namespace meniscus
