// SPDX-License-Identifier: BSD-3-Clause
// The channels of EXR files: what each is called, what it holds of a picture, and what the header says of all.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/image/color_space.h"
#include "core/image/cryptomatte.h"
#include "core/render/picture.h"

namespace meniscus {

struct ImageToEncode;

/// The matrices of the camera of a picture.
struct ViewMatrices {
  glm::dmat4 to_camera;  ///< world_to_camera()
  glm::dmat4 to_file;    ///< as world_to_picture(), in the file: with what stands around the molecule
};

/// What EXR files have beside the layers of a picture.
struct ExrContent {
  Primaries primaries = Primaries::rec709;           ///< of the colours
  std::optional<ViewMatrices> view;                  ///< for the header, and for layers seen from the camera
  std::shared_ptr<const std::vector<Matte>> mattes;  ///< of what Framebuffer::seen names
};

/// R G B A; with AOVs Z, N.x N.y N.z and P.x P.y P.z in the world's axes, atom, kind and component (-1 where nothing is
/// hit; Z is +inf), and where the view is known Nview and Pview: x right, y up, z towards the viewer from the camera;
/// with motion forward.u and forward.v, and forward.a, which is 1 where something is hit; of each matte what
/// matte_channels() says. Compositors take what stands before the point for a layer.
class ExrChannels {
 public:
  /// background: sRGB; nothing: transparent.
  ExrChannels(const PictureLayers& layers, const std::optional<glm::vec3>& background, ExrContent content);

  const std::vector<std::string>& names() const { return names_; }
  /// Returns the values of `count` pixels from `first` on, pixel by pixel.
  std::vector<float> values(const Framebuffer& picture, std::size_t first, std::size_t count) const;
  /// Fills in what EXR files alone have.
  void describe(ImageToEncode& image) const;

 private:
  float* write_aovs(const Framebuffer& picture, std::size_t pixel, float* to) const;
  float* write_mattes_of(const Framebuffer& picture, std::size_t pixel, float* to) const;
  bool has_view() const { return layers_.aovs && content_.view; }

  const PictureLayers layers_;
  const std::optional<glm::vec3> background_;
  const ExrContent content_;
  std::vector<std::string> names_;
};

}  // namespace meniscus
