// SPDX-License-Identifier: BSD-3-Clause
// The complete surface of each frame, ray cast and laid over its background.
#include "core/view/frame_renderer.h"

#include <cassert>
#include <cmath>
#include <utility>

#include <epoxy/gl.h>
#include <glm/common.hpp>

#include "core/reference/exhaustive.h"
#include "core/render/color_space.h"
#include "core/render/ray_caster.h"
#include "core/surface/surface.h"

namespace meniscus {

struct FrameRenderer::State {
  std::vector<Ball> atoms;
  Coloring coloring;
  RayCaster caster;
  Framebuffer picture;
  std::vector<std::uint8_t> rgba;
  GLuint texture = 0;

  ~State() { glDeleteTextures(1, &texture); }

  void finish(const Look& look) {
    const glm::vec3 background = linear_from_srgb(look.background);
    rgba.clear();
    rgba.reserve(picture.color.size() * 4);
    for (const glm::vec4& pixel : picture.color) {
      const glm::vec3 srgb = srgb_from_linear(glm::vec3(pixel) + background * (1.0f - pixel.w));
      for (int c = 0; c < 3; ++c)
        rgba.push_back(static_cast<std::uint8_t>(std::lround(255.0f * glm::clamp(srgb[c], 0.0f, 1.0f))));
      rgba.push_back(255);
    }
    glDeleteTextures(1, &texture);
    glCreateTextures(GL_TEXTURE_2D, 1, &texture);
    glTextureStorage2D(texture, 1, GL_RGBA8, picture.size.x, picture.size.y);
    glTextureSubImage2D(texture, 0, 0, 0, picture.size.x, picture.size.y, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  }
};

FrameRenderer::FrameRenderer() : state_(std::make_unique<State>()) {}
FrameRenderer::~FrameRenderer() = default;

void FrameRenderer::set_atoms(std::vector<Ball> atoms) {
  assert(!atoms.empty());
  state_->atoms = std::move(atoms);
}

void FrameRenderer::set_coloring(Coloring coloring) { state_->coloring = std::move(coloring); }

void FrameRenderer::render(const FrameRequest& request) {
  assert(state_->coloring.atom.size() == state_->atoms.size());
  clock_.restart();
  Surface surface;
  {
    const auto stage = clock_.stage("reduced surface");
    const ReducedSurface reduced = enumerate_reduced_surface(state_->atoms, request.probe_radius);
    surface = assemble_surface(state_->atoms, request.probe_radius, reduced, &clock_);
  }
  require_closed(surface);
  RenderSettings settings;
  settings.size = request.size;
  settings.samples = request.samples;
  settings.aovs = true;
  state_->picture = state_->caster.render(surface, state_->coloring, request.camera, settings);
  for (const StageTime& stage : state_->caster.times()) clock_.add(stage.name, stage.milliseconds);
  const auto stage = clock_.stage("finish");
  state_->finish(request.look);
}

std::vector<std::uint8_t> FrameRenderer::rgba() const { return state_->rgba; }
std::uint32_t FrameRenderer::texture() const { return state_->texture; }
glm::ivec2 FrameRenderer::size() const { return state_->picture.size; }

std::optional<PickedPoint> FrameRenderer::pick(glm::ivec2 pixel) const {
  const Framebuffer& picture = state_->picture;
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= picture.size.x || pixel.y >= picture.size.y) return {};
  const std::size_t at = static_cast<std::size_t>(pixel.y) * picture.size.x + pixel.x;
  if (picture.atom[at] == kNone) return {};
  return PickedPoint{picture.atom[at], static_cast<PatchKind>(picture.kind[at]), picture.position[at]};
}

}  // namespace meniscus
