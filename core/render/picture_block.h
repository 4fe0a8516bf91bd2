// SPDX-License-Identifier: BSD-3-Clause
// A part of a picture, and what both ways of casting it are told.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

#include "core/gpu/kernel_parameters.h"
#include "core/gpu/kernel_records.h"
#include "core/render/gpu_scene.h"
#include "core/render/look.h"
#include "core/render/ray_cast_scene.h"
#include "core/render/render_settings.h"

namespace meniscus {

using kernel::kTileEdge;

/// A part of a picture, in pixels; the origin is a multiple of kTileEdge.
struct PictureBlock {
  glm::ivec2 origin{0}, size{0};
};

/// Columns and rows of tiles.
inline glm::ivec2 tile_counts(const PictureBlock& block) { return (block.size + (kTileEdge - 1)) / kTileEdge; }

/// The whole picture as the map of depths sees it that shade is found from (gpu_shaders/look/occlusion.glsl).
PictureFrame shade_map_frame(const PictureFrame& frame);

/// Whether a block of a picture has that map among its own depths: its first sample's are those of the whole picture.
bool holds_shade_map(const PictureBlock& block, glm::ivec2 picture_size);

/// Whether such a map has to be made before the blocks of a picture, of which `first` is the first.
inline bool needs_shade_map(const PictureBlock& first, const RenderSettings& settings) {
  return settings.look.ambient_occlusion > 0.0f && !holds_shade_map(first, settings.size);
}

/// Where sample `index` lies in its pixel, in pixels from the centre: the R2 sequence (Roberts 2018), centre first.
glm::vec2 sample_offset(int index);

/// The block as a sample of each of its pixels sees it.
kernel::BlockView block_view(const PictureFrame& frame, const PictureBlock& block, const glm::vec2& sample_offset);

/// For lists of tiles that nothing bounds.
kernel::TileListParameters tile_list_parameters(const PictureFrame& frame, const PictureBlock& block,
                                                std::uint32_t primitive_count);

/// Of the first sample; without tiles.
kernel::RayCastParameters cast_parameters(const ScenePlacement& scene, const Look& look, std::uint32_t atom_count,
                                          bool color_by_kind);

/// Of sample `sample` of each pixel.
kernel::OcclusionParameters occlusion_parameters(const Look& look, glm::ivec2 picture_size, int sample);
kernel::FinishParameters finish_parameters(const Look& look, const ScenePlacement& scene, glm::ivec2 picture_size,
                                           int sample, bool has_parts);

}  // namespace meniscus
