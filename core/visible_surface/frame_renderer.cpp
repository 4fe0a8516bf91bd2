// SPDX-License-Identifier: BSD-3-Clause
// What a view needs of each frame, ray cast and laid over its background.
#include "core/visible_surface/frame_renderer.h"

#include <cassert>
#include <utility>

#include <glm/geometric.hpp>

#include "core/gpu/gpu_stage.h"
#include "core/render/presenter.h"
#include "core/render/ray_caster.h"

namespace meniscus {

struct FrameRenderer::State {
  ViewPipeline pipeline;
  RayCaster caster;
  GpuScene scene;
  PictureFrame frame;  // of the last picture
  Presenter presenter;
};

FrameRenderer::FrameRenderer() : state_(std::make_unique<State>()) {}
FrameRenderer::~FrameRenderer() = default;

void FrameRenderer::set_atoms(std::vector<Ball> atoms) { state_->pipeline.set_atoms(std::move(atoms)); }

void FrameRenderer::set_coloring(Coloring coloring) { upload_coloring(coloring, state_->scene); }

bool FrameRenderer::render(const FrameRequest& request) {
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
  if (!state_->caster.cast(state_->scene, state_->frame, request.samples, request.look, request.stop)) return false;
  for (const auto* times : {&state_->pipeline.times(), &state_->caster.times()})
    for (const StageTime& stage : *times) clock_.add(stage.name, stage.milliseconds);
  const GpuStage stage(clock_, "finish");
  state_->presenter.present(state_->caster.picture(), request.size, request.samples, request.look.background);
  return true;
}

std::vector<std::uint8_t> FrameRenderer::rgba() const { return state_->presenter.rgba(); }
std::uint32_t FrameRenderer::texture() const { return state_->presenter.texture(); }
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
      state_->scene.primitives.buffer.download<ray_cast::Primitive>(1, hit.primitive * sizeof(ray_cast::Primitive))
          .front();
  const Ray ray = pixel_ray(frame.camera, frame.size, glm::dvec2(pixel) + 0.5);
  // The kernel counts from the plane through the pivot.
  const double depth = hit.t + frame.eye_distance / glm::dot(ray.direction, frame.basis.forward);
  return PickedPoint{hit.atom, static_cast<PatchKind>(primitive.kind), ray.origin + ray.direction * depth};
}

}  // namespace meniscus
