// SPDX-License-Identifier: BSD-3-Clause
// Pictures as files: PNG, JPEG, WebP and TIFF to look at, EXR with its channels for compositing; complete or not at
// all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "core/base/output_file.h"
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

struct ImageSettings {
  std::optional<glm::vec3> background;  ///< sRGB in [0, 1] behind the surface; nothing: transparent
  Existing existing = Existing::refuse;
  /// Of PNG and TIFF without a background. True: alpha is the share of a pixel that is covered, for programs that blend
  /// in linear light. False: that by which blending in sRGB makes the same edges as on white (layout_color()).
  bool linear_alpha = true;
  double dots_per_inch = 0.0;  ///< for programs that print; 0: not said
  bool names_program = true;   ///< the program's version is in the file
  std::string command = {};    ///< how it was made, in words; empty: not said. Not in WebP.
  std::string scene = {};      ///< what it was made of, JSON; likewise
  ExrContent exr = {};         ///< in EXR files
  std::string made_of = {};    ///< of PNG: by which a picture of a run is known again (kMadeOfNote); empty: nothing
};

/// True if the extension names a format that can hold AOVs (.exr).
bool holds_aovs(const std::filesystem::path& path);

/// True if files of this name are in memory until the last row is there (ImageWriter).
bool is_encoded_in_memory(const std::filesystem::path& path);

/// The picture in sRGB, rows from the top, as files would have it: 3 channels on the background, or 4 with alpha that
/// is not multiplied in and blends in sRGB (layout_color()). `bytes` of a channel: 1, as PNG, or 2 little-endian, as
/// TIFF.
std::vector<std::uint8_t> srgb_pixels(const Framebuffer& picture, const std::optional<glm::vec3>& background,
                                      int bytes = 1);

/// Throws OutputError unless the extension is .png, .jpg, .jpeg, .webp, .tif, .tiff, .exr, .svg or .pdf, Error if this
/// installation writes no pictures.
void check_image_path(const std::filesystem::path& path);

/// A picture that is written as its rows come, so that files of any size need little memory: all but .webp and .exr,
/// which are in memory until the end, .exr compressed. By extension: .png and .webp (quality 95) 8 bit, .tif and .tiff
/// 16 bit, all sRGB with unassociated alpha; .jpg and .jpeg (quality 95, colours not subsampled) 8 bit sRGB before
/// white where no background is given; .exr float, linear, associated alpha, with the channels of ExrChannels. An
/// opaque background leaves no alpha, in EXR alpha 1. Nothing is under the final name before the end. Throws
/// OutputError.
class ImageWriter {
 public:
  /// layers: those of its rows.
  ImageWriter(const std::filesystem::path& path, glm::ivec2 size, const PictureLayers& layers,
              const ImageSettings& settings);
  ~ImageWriter();

  /// The next rows, as a picture of their own.
  void add(const Framebuffer& rows);
  /// Behind the last row.
  void commit();

 private:
  class File;
  std::unique_ptr<File> file_;
};

/// A whole picture.
void write_image(const std::filesystem::path& path, const Framebuffer& picture, const ImageSettings& settings);

}  // namespace meniscus
