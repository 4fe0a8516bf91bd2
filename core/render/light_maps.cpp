// SPDX-License-Identifier: BSD-3-Clause
// Draws the maps of light: balls, as seen from many directions.
#include "core/render/light_maps.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>

#include "core/color/coloring.h"
#include "core/math/rigid_motion.h"
#include "core/queries/surface_object.h"
#include "core/shapes/shapes.h"
#include "core/surface/primitives.h"

namespace meniscus {
namespace {

constexpr float kEmpty = -1e30f;
constexpr double kGoldenAngle = std::numbers::pi * (3.0 - 2.2360679774997896);

/// Calls add(point) for points of a line that are at most `step` apart.
template <typename Add>
void walk(const glm::dvec3& from, const glm::dvec3& to, double step, const Add& add) {
  const int count = static_cast<int>(std::ceil(glm::length(to - from) / step));
  for (int n = 0; n <= count; ++n) add(count ? glm::mix(from, to, static_cast<double>(n) / count) : from);
}

void add_balls(const Shapes& shapes, const std::vector<bool>& blocking, std::vector<Ball>& balls) {
  for (const SphereShape& sphere : shapes.spheres)
    if (blocking[sphere.atom]) balls.push_back({sphere.center, sphere.radius});
  for (const CylinderShape& stick : shapes.cylinders) {
    const glm::dvec3 middle = 0.5 * (stick.from + stick.to);
    const auto add = [&](const glm::dvec3& point) { balls.push_back({point, stick.radius}); };
    if (blocking[stick.from_atom]) walk(stick.from, middle, kLightMapStep, add);
    if (blocking[stick.to_atom]) walk(middle, stick.to, kLightMapStep, add);
  }
  const MeshShape& mesh = shapes.mesh;
  for (const auto& [a, b, c] : mesh.triangles) {
    if (!blocking[mesh.atoms[a]]) continue;
    const glm::dvec3 corner = mesh.positions[a], from = mesh.positions[b], to = mesh.positions[c];
    walk(from, to, kLightMapStep, [&](const glm::dvec3& end) {
      walk(corner, end, kLightMapStep, [&](const glm::dvec3& point) { balls.push_back({point, 0.0}); });
    });
  }
}

}  // namespace

void LightMaps::add(const PictureObject& object) {
  const std::vector<bool> blocking = object.coloring->blocking();
  if (object.surface)
    add(object.surface->atoms, blocking);
  else
    add_balls(*object.shapes, blocking, groups_.emplace_back().balls);
  groups_.back().planes = object.clip;
}

void LightMaps::add(const SurfaceObject& object) {
  const std::vector<bool> blocking = object.coloring.blocking();
  for (const RigidMotion& motion : object.copies) {
    add(object.surface.atoms, blocking);
    for (Ball& ball : groups_.back().balls) ball.center = motion(ball.center);
  }
}

void LightMaps::add(std::span<const Ball> balls, const std::vector<bool>& blocking) {
  std::vector<Ball>& group = groups_.emplace_back().balls;
  for (std::size_t a = 0; a < balls.size(); ++a)
    if (blocking[a]) group.push_back(balls[a]);
}

/// The maps of a view: heights along its axis, and against it (nullptr: none).
struct LightMaps::Raster {
  double texel;  // Å
  int edge;      // texels
  float* along;
  float* against;
};

LightMaps::View LightMaps::view_along(const glm::dvec3& axis) {
  const glm::dvec3 aside = std::abs(axis.z) < 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 right = glm::normalize(glm::cross(aside, axis));
  return {right, glm::cross(axis, right), axis};
}

bool LightMaps::same(const Group& a, const Group& b) {
  return std::ranges::equal(
             a.balls, b.balls,
             [](const Ball& x, const Ball& y) { return x.center == y.center && x.radius == y.radius; }) &&
         std::ranges::equal(a.planes, b.planes, [](const ClipPlane& x, const ClipPlane& y) {
           return x.normal == y.normal && x.offset == y.offset;
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
  for (int n = 0; n < axes; ++n) {
    // A spiral over the hemisphere (Vogel 1979): each axis has the same solid angle.
    const double z = 1.0 - (n + 0.5) / axes, across = std::sqrt(1.0 - z * z), angle = n * kGoldenAngle;
    views_.push_back(view_along({across * std::cos(angle), across * std::sin(angle), z}));
  }
}

/// Adds the places on the lamp's disc, by the same spiral.
void LightMaps::place_lamp(const Look& look, const ViewBasis& basis) {
  const glm::dvec3 aside = glm::normalize(glm::dvec3(look.light_direction));
  const glm::dvec3 lamp = basis.right * aside.x + basis.up * aside.y - basis.forward * aside.z;
  const glm::dvec3 x =
      glm::normalize(glm::cross(lamp, std::abs(glm::dot(lamp, basis.up)) < 0.9 ? basis.up : basis.right));
  const glm::dvec3 y = glm::cross(lamp, x);
  const double disc = std::tan(static_cast<double>(look.shadow_softness) * std::numbers::pi / 180.0);
  for (int n = 0; n < kernel::kMostLampPlaces; ++n) {
    const double r = disc * std::sqrt((n + 0.5) / kernel::kMostLampPlaces), angle = n * kGoldenAngle;
    views_.push_back(view_along(glm::normalize(lamp + r * (std::cos(angle) * x + std::sin(angle) * y))));
  }
}

void LightMaps::make(const Look& look, const ViewBasis& basis) {
  const int axes = look.maps_sky() ? kernel::kMostSkyAxes : 0;
  const bool keeps_sky = axes == sky_axes_ && !views_.empty() && std::ranges::equal(groups_, drawn_, same);
  if (!keeps_sky) place_sky(axes);
  views_.resize(static_cast<std::size_t>(axes));
  if (look.maps_lamp()) place_lamp(look, basis);
  const auto texels_of = [](int edge) { return static_cast<std::size_t>(edge) * edge; };
  const std::size_t sky = texels_of(sky_edge_), lamp = texels_of(lamp_edge_), sky_end = 2 * sky * axes;
  texels_.resize(keeps_sky ? sky_end : 0);
  texels_.resize(sky_end + lamp * (views_.size() - axes), kEmpty);
  tbb::parallel_for(std::size_t{keeps_sky ? static_cast<std::size_t>(axes) : 0}, views_.size(), [&](std::size_t n) {
    const auto first_lamp = static_cast<std::size_t>(axes);
    if (n < first_lamp)
      draw(views_[n], {sky_texel_, sky_edge_, &texels_[2 * n * sky], &texels_[(2 * n + 1) * sky]});
    else
      draw(views_[n], {lamp_texel_, lamp_edge_, &texels_[sky_end + (n - first_lamp) * lamp], nullptr});
  });
  drawn_ = groups_;
}

void LightMaps::draw(const View& view, const Raster& raster) const {
  const double scale = 1.0 / raster.texel, half = 0.5 * (raster.edge - 1);
  const auto put = [&](std::size_t at, float low, float high) {
    raster.along[at] = std::max(raster.along[at], high);
    if (raster.against) raster.against[at] = std::max(raster.against[at], -low);
  };
  for (const Group& group : groups_)
    for (const Ball& ball : group.balls) {
      const bool cut = std::ranges::any_of(group.planes, [&](const ClipPlane& plane) {
        return plane.offset - glm::dot(plane.normal, ball.center) < ball.radius;
      });
      const glm::dvec3 center = ball.center - middle_;
      const auto x = static_cast<float>(glm::dot(center, view.right) * scale + half),
                 y = static_cast<float>(glm::dot(center, view.up) * scale + half),
                 z = static_cast<float>(glm::dot(center, view.axis)), radius = static_cast<float>(ball.radius),
                 texel = static_cast<float>(raster.texel);
      const float reach = std::max(radius / texel, 0.71f);  // each ball has a texel
      for (int line = static_cast<int>(std::ceil(y - reach)), last = static_cast<int>(y + reach); line <= last;
           ++line) {
        const float off = static_cast<float>(line) - y, across = std::sqrt(std::max(reach * reach - off * off, 0.0f));
        const int first = static_cast<int>(std::ceil(x - across)), end = static_cast<int>(x + across) + 1;
        const std::size_t row = static_cast<std::size_t>(line) * raster.edge;
        for (int column = first; column < end; ++column) {
          const float aside = static_cast<float>(column) - x;
          const float height = std::sqrt(std::max(radius * radius - (aside * aside + off * off) * texel * texel, 0.0f));
          float low = z - height, high = z + height;
          if (cut) {
            const glm::dvec3 foot =
                middle_ + view.right * ((column - half) * raster.texel) + view.up * ((line - half) * raster.texel);
            for (const ClipPlane& plane : group.planes) {
              const double slope = glm::dot(plane.normal, view.axis);
              const double room = plane.offset - glm::dot(plane.normal, foot);
              if (slope > 0.0) high = std::min(high, static_cast<float>(room / slope));
              if (slope < 0.0) low = std::max(low, static_cast<float>(room / slope));
              if (slope == 0.0 && room < 0.0) high = -std::numeric_limits<float>::max();
            }
            if (low > high) continue;
          }
          put(row + static_cast<std::size_t>(column), low, high);
        }
      }
    }
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
    maps.rows[3 * n + 2] = row(views_[n].axis, 1.0, 0.0);
  }
  return maps;
}

}  // namespace meniscus
