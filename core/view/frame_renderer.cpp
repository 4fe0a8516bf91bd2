// SPDX-License-Identifier: BSD-3-Clause
// What a view needs of each frame, ray cast and laid over its background.
#include "core/view/frame_renderer.h"

#include <cassert>
#include <cmath>
#include <utility>

#include <epoxy/gl.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/render/color_space.h"
#include "core/render/ray_caster.h"

namespace meniscus {

struct FrameRenderer::State {
  ViewPipeline pipeline;
  RayCaster caster;
  GpuScene scene;
  PictureFrame frame;  // of the last picture
  std::vector<std::uint8_t> rgba;
  GLuint texture = 0;

  ~State() { glDeleteTextures(1, &texture); }

  void finish(const Look& look, int samples) {
    const glm::vec3 background = linear_from_srgb(look.background);
    const std::size_t count = static_cast<std::size_t>(frame.size.x) * frame.size.y;
    rgba.clear();
    rgba.reserve(count * 4);
    for (const glm::vec4& sum : caster.picture().download<glm::vec4>(count)) {
      const glm::vec4 pixel = sum / static_cast<float>(samples);
      const glm::vec3 srgb = srgb_from_linear(glm::vec3(pixel) + background * (1.0f - pixel.w));
      for (int c = 0; c < 3; ++c)
        rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0f * glm::clamp(srgb[c], 0.0f, 1.0f))));
      rgba.push_back(255);
    }
    glDeleteTextures(1, &texture);
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGBA8, frame.size.x, frame.size.y);
    glTextureSubImage2D(texture, 0, 0, 0, frame.size.x, frame.size.y, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  }
};

FrameRenderer::FrameRenderer() : state_(std::make_unique<State>()) {}
FrameRenderer::~FrameRenderer() = default;

void FrameRenderer::set_atoms(std::vector<Ball> atoms) { state_->pipeline.set_atoms(std::move(atoms)); }

void FrameRenderer::set_coloring(Coloring coloring) { upload_coloring(coloring, state_->scene); }

void FrameRenderer::render(const FrameRequest& request) {
  const std::vector<Ball>& atoms = state_->pipeline.atoms();
  assert(state_->scene.atom_count == atoms.size());
  validate_camera(request.camera, "camera");
  clock_.restart();
  {
    const auto stage = clock_.stage("frame");
    state_->frame = make_picture_frame(atoms, request.camera, request.size);
  }
  state_->pipeline.run(state_->frame, request.probe_radius, request.extent, state_->scene);
  state_->caster.restart_times();
  state_->caster.cast(state_->scene, state_->frame, request.samples);
  for (const auto* times : {&state_->pipeline.times(), &state_->caster.times()})
    for (const StageTime& stage : *times) clock_.add(stage.name, stage.milliseconds);
  const auto stage = clock_.stage("finish");
  state_->finish(request.look, request.samples);
}

std::vector<std::uint8_t> FrameRenderer::rgba() const { return state_->rgba; }
std::uint32_t FrameRenderer::texture() const { return state_->texture; }
glm::ivec2 FrameRenderer::size() const { return state_->frame.size; }
const ViewStats& FrameRenderer::stats() const { return state_->pipeline.stats(); }
const Buffer& FrameRenderer::samples() const { return state_->caster.picture(); }
const Buffer& FrameRenderer::hits() const { return state_->caster.hits(); }

std::optional<PickedPoint> FrameRenderer::pick(glm::ivec2 pixel) const {
  const PictureFrame& frame = state_->frame;
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= frame.size.x || pixel.y >= frame.size.y) return {};
  const std::size_t at = static_cast<std::size_t>(pixel.y) * frame.size.x + pixel.x;
  const ray_cast::Hit hit = hits().download<ray_cast::Hit>(1, at * sizeof(ray_cast::Hit)).front();
  if (hit.primitive == ray_cast::kNoPrimitive) return {};
  const auto primitive =
      state_->scene.primitives.download<ray_cast::Primitive>(1, hit.primitive * sizeof(ray_cast::Primitive)).front();
  const Ray ray = pixel_ray(frame.camera, frame.size, glm::dvec2(pixel) + 0.5);
  // The kernel counts from the plane through the pivot.
  const double depth = hit.t + frame.eye_distance / glm::dot(ray.direction, frame.basis.forward);
  return PickedPoint{hit.atom, static_cast<PatchKind>(primitive.kind), ray.origin + ray.direction * depth};
}

}  // namespace meniscus
