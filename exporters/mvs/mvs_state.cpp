// SPDX-License-Identifier: BSD-3-Clause
// Writes scenes as trees of MolViewSpec's nodes, and puts them into an archive.
#include "exporters/mvs/mvs_state.h"

#include <fmt/chrono.h>

#include "core/image/color_space.h"
#include "core/image/image_codec.h"
#include "exporters/mesh_files/writers.h"

namespace meniscus::mvs {
namespace {

using nlohmann::json;

json node(const char* kind, json params) { return {{"kind", kind}, {"params", std::move(params)}}; }

/// Returns a length rounded to 0.001 Å, which has few digits as text.
double rounded(double value) { return std::round(1000.0 * value) / 1000.0; }
json place(const glm::dvec3& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

std::string hex_color(const glm::vec3& linear) {
  const glm::vec4 color = display_color(glm::vec4(linear, 1.0f), std::nullopt);
  return fmt::format("#{:02x}{:02x}{:02x}", display_byte(color.x), display_byte(color.y), display_byte(color.z));
}

/// Returns the node of a mesh. Its triangles are grouped by colour.
json mesh_node(const path_tracers::SceneMesh& mesh, const glm::dvec3& origin) {
  json vertices = json::array(), indices = json::array(), groups = json::array();
  json colors = json::object();
  std::map<std::string, std::size_t> known;
  for (const glm::vec3& position : mesh.positions)
    for (const json& coordinate : place(origin + glm::dvec3(position))) vertices.push_back(coordinate);
  for (const std::array<std::uint32_t, 3>& triangle : mesh.triangles) {
    glm::vec3 sum(0.0f);
    for (const std::uint32_t corner : triangle) {
      indices.push_back(corner);
      sum += mesh.colors[corner];
    }
    const auto [group, is_new] = known.try_emplace(hex_color(sum / 3.0f), known.size());
    if (is_new) colors[std::to_string(group->second)] = group->first;
    groups.push_back(group->second);
  }
  return node("primitive", {{"kind", "mesh"},
                            {"vertices", std::move(vertices)},
                            {"indices", std::move(indices)},
                            {"triangle_groups", std::move(groups)},
                            {"group_colors", std::move(colors)}});
}

/// Returns a motion in coordinates relative to the origin as a column-major matrix for the molecule's coordinates.
json matrix_of(const RigidMotion& copy, const glm::dvec3& origin) {
  const glm::dvec3 shift = copy.translation + origin - copy.rotation * origin;
  json matrix = json::array();
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) matrix.push_back(copy.rotation[column][row]);
    matrix.push_back(0);
  }
  for (int row = 0; row < 3; ++row) matrix.push_back(shift[row]);
  matrix.push_back(1);
  return matrix;
}

/// Returns one node for each opacity, because nodes have an opacity, and the primitives in them do not.
std::vector<json> nodes_of(const path_tracers::SceneItem& item, const glm::dvec3& origin) {
  std::map<float, json, std::greater<>> parts;
  const auto part = [&](float opacity) -> json& { return parts.try_emplace(opacity, json::array()).first->second; };
  for (const path_tracers::SceneMesh& mesh : item.meshes)
    if (!mesh.triangles.empty()) part(mesh.opacity).push_back(mesh_node(mesh, origin));
  for (const path_tracers::SceneSphere& sphere : item.spheres)
    part(sphere.paint.opacity)
        .push_back(node("primitive", {{"kind", "ellipsoid"},
                                      {"center", place(origin + sphere.center)},
                                      {"radius", rounded(sphere.radius)},
                                      {"color", hex_color(sphere.paint.color)}}));
  for (const path_tracers::SceneCylinder& cylinder : item.cylinders)
    part(cylinder.paint.opacity)
        .push_back(node("primitive", {{"kind", "tube"},
                                      {"start", place(origin + cylinder.from)},
                                      {"end", place(origin + cylinder.to)},
                                      {"radius", rounded(cylinder.radius)},
                                      {"color", hex_color(cylinder.paint.color)}}));
  std::vector<json> nodes;
  for (auto& [opacity, primitives] : parts) {
    json group = node("primitives", {{"opacity", opacity}});
    if (!item.is_placed_once()) {
      json instances = json::array();
      for (const RigidMotion& copy : item.copies) instances.push_back(matrix_of(copy, origin));
      group["params"]["instances"] = std::move(instances);
    }
    group["children"] = std::move(primitives);
    nodes.push_back(std::move(group));
  }
  return nodes;
}

/// Returns the node of a camera. Viewers multiply the distance to the target by 1 / (2 sin(fov / 2)), with a field of
/// view fov of their own. So the camera is placed where the picture is as high at the target as that of `camera`.
/// MolViewSpec cannot specify the projection.
json camera_node(const Camera& camera) {
  const double half_angle = 0.5 * camera.vertical_fov * std::numbers::pi / 180.0;
  const glm::dvec3 from_target = camera.position - camera.target;
  const double distance = camera.projection == Projection::perspective
                              ? 2.0 * std::sin(half_angle) * glm::length(from_target)
                              : camera.height;
  return node("camera", {{"target", place(camera.target)},
                         {"position", place(camera.target + distance * glm::normalize(from_target))},
                         {"up", place(view_basis(camera).up)}});
}

std::string timestamp() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(source_date())); }

}  // namespace

json tree_of(const path_tracers::PathTracerScene& scene) {
  json children = json::array({node("canvas", {{"background_color", "white"}}), camera_node(scene.camera)});
  for (const path_tracers::SceneItem& item : scene.items)
    for (json& group : nodes_of(item, scene.origin)) children.push_back(std::move(group));
  return {{"kind", "root"}, {"children", std::move(children)}};
}

std::vector<std::byte> mvsx_archive(std::span<const State> states, const std::string& title, const Sequence& sequence) {
  json whole{{"metadata", {{"title", title}, {"version", "1"}, {"timestamp", timestamp()}}}};
  if (!sequence.is_run) {
    whole["kind"] = "single";
    whole["root"] = states.front().root;
  } else {
    whole["kind"] = "multiple";
    json snapshots = json::array();
    for (std::size_t n = 0; n < states.size(); ++n)
      snapshots.push_back({{"root", states[n].root},
                           {"metadata",
                            {{"title", states[n].title},
                             {"key", fmt::format("frame_{}", n + 1)},
                             {"linger_duration_ms", sequence.milliseconds},
                             {"transition_duration_ms", 0}}}});
    whole["snapshots"] = std::move(snapshots);
  }
  ZipArchive archive;
  archive.add_deflated("index.mvsj", whole.dump(-1, ' ', false, json::error_handler_t::replace));
  return archive.finish();
}

}  // namespace meniscus::mvs
