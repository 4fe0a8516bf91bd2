// SPDX-License-Identifier: BSD-3-Clause
// Pictures as files: PNG, JPEG, WebP and TIFF for viewing, EXR with its channels for compositing. A file is complete or
// does not exist.
#pragma once

#include <glm/mat4x4.hpp>

#include "core/base/output_file.h"
#include "core/image/color_space.h"
#include "core/image/cryptomatte.h"
#include "core/render/picture.h"

namespace meniscus {

struct ImageToEncode;

/// The matrices of the camera of a picture.
struct ViewMatrices {
  glm::dmat4 to_camera;  ///< world_to_camera()
  glm::dmat4 to_file;    ///< world_to_picture() of the file, which includes everything around the molecule
};

/// The content of EXR files in addition to the layers of a picture.
struct ExrContent {
  Primaries primaries = Primaries::rec709;           ///< primaries of the colours
  std::optional<ViewMatrices> view;                  ///< matrices for the header and for layers seen from the camera
  std::shared_ptr<const std::vector<Matte>> mattes;  ///< the mattes that Framebuffer::seen refers to
};

/// The channels of an EXR file: R G B A; with AOVs Z, N.x N.y N.z and P.x P.y P.z in the world's axes, atom, kind and
/// component. The indices are -1 and Z is +inf where nothing is hit. If the view is known, there are Nview and Pview: x
/// right, y up, z towards the viewer from the camera. With motion there are forward.u, forward.v, and forward.a, which
/// is 1 where something is hit. Each matte adds the channels of matte_channels(). Compositors read the part of a name
/// before the point as a layer.
class ExrChannels {
 public:
  /// background: sRGB; nothing: transparent.
  ExrChannels(const PictureLayers& layers, const std::optional<glm::vec3>& background, ExrContent content);

  const std::vector<std::string>& names() const { return names_; }
  /// Returns the values of `count` pixels from `first` on, pixel by pixel.
  std::vector<float> values(const Framebuffer& picture, std::size_t first, std::size_t count) const;
  /// Adds the metadata that only EXR files have to `image`.
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

enum class TiffCompression { none, lzw, zip };

/// The encoding of TIFF files.
struct TiffFormat {
  TiffCompression compression = TiffCompression::zip;
  int bits = 16;  ///< bits per channel, 8 or 16
};

/// The settings of a picture's file.
struct ImageSettings {
  std::optional<glm::vec3> background;  ///< sRGB in [0, 1] behind the surface; nothing: transparent
  Existing existing = Existing::refuse;
  /// The alpha of PNG and TIFF files without a background. True: the share of a pixel that is covered, for programs
  /// that blend in linear light. False: an alpha for which blending in sRGB makes the same edges as on white
  /// (layout_color()).
  bool linear_alpha = true;
  double dots_per_inch = 0.0;  ///< resolution for printing; 0: not written
  bool names_program = true;   ///< the file names the program's version
  std::string command = {};    ///< the command that made the picture; empty: not written. Not in WebP files.
  std::string scene = {};      ///< the scene that the picture shows, JSON; empty: not written. Not in WebP files.
  ExrContent exr = {};         ///< content of EXR files
  TiffFormat tiff = {};
  std::string made_of = {};  ///< text of PNG files that identifies a picture of a run (kMadeOfNote); empty: not written
};

/// True if the extension names a format that can hold AOVs (.exr).
bool holds_aovs(const std::filesystem::path& path);

/// True if a file of this name is kept in memory until its last row is complete (ImageWriter).
bool is_encoded_in_memory(const std::filesystem::path& path);

/// Returns the picture in sRGB as in files, rows from the top: 3 channels on the background, or 4 with unassociated
/// alpha that blends in sRGB (layout_color()). `bytes` per channel: 1, as in PNG, or 2, little-endian, as in TIFF.
std::vector<std::uint8_t> srgb_pixels(const Framebuffer& picture, const std::optional<glm::vec3>& background,
                                      int bytes = 1);

/// Throws OutputError unless the extension is .png, .jpg, .jpeg, .webp, .tif, .tiff, .exr, .svg or .pdf, and Error if
/// this installation cannot write pictures.
void check_image_path(const std::filesystem::path& path);

/// Writes a picture row by row as it is made, so that files of any size need little memory; only .webp and .exr are
/// kept in memory until the end, .exr compressed. The extension decides the format: .png and .webp (quality 95) have 8
/// bits, .tif and .tiff the bits of TiffFormat per channel, all sRGB with unassociated alpha. .jpg and .jpeg (quality
/// 95, colours not subsampled) have 8 bits, sRGB, on white if no background is given. .exr has floats, linear,
/// associated alpha, with the channels of ExrChannels. With an opaque background there is no alpha; in EXR it is 1. The
/// file gets its final name at the end. Throws OutputError.
class ImageWriter {
 public:
  /// Opens the file. layers: the layers of the rows to come.
  ImageWriter(const std::filesystem::path& path, glm::ivec2 size, const PictureLayers& layers,
              const ImageSettings& settings);
  ~ImageWriter();

  /// Adds the next rows, as a picture of their own.
  void add(const Framebuffer& rows);
  /// Completes the file after the last row.
  void commit();

 private:
  class File;
  std::unique_ptr<File> file_;
};

/// Writes a whole picture.
void write_image(const std::filesystem::path& path, const Framebuffer& picture, const ImageSettings& settings);

}  // namespace meniscus
