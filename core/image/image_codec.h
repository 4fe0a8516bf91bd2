// SPDX-License-Identifier: BSD-3-Clause
// Encodes pictures row by row and decodes them, and the time that files bear.
//
// OpenImageIO writes WebP and EXR and reads everything. It loads two hundred libraries, a quarter of a second and a
// hundred megabytes before main(), and most commands do not need it. So the code that does is a module of its own
// (openimageio_codec.cpp), found near the program.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

enum class SampleType : std::uint8_t { uint8, uint16, float32 };

/// The description of a picture file without its pixels. Rows are ordered from the top, channels of a pixel are
/// adjacent.
struct ImageToEncode {
  std::string format;  ///< "png", "jpeg", "webp", "tiff" or "exr"
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  SampleType sample = SampleType::uint8;
  int alpha_channel = -1;                       ///< -1: none
  int depth_channel = -1;                       ///< -1: none
  std::string color_space;                      ///< "sRGB" or "Linear"
  bool unassociated_alpha = false;              ///< true if colours are not premultiplied
  std::string compression;                      ///< "" for the format's default
  int png_level = -1;                           ///< up to 9; -1 for the default
  std::string software;                         ///< text in the file; "" for none
  std::string command;                          ///< the command that made the picture; "" for none
  std::string scene;                            ///< the scene of the picture (JSON); "" for none
  std::string made_of;                          ///< PNG: kMadeOfNote; "" for none
  std::string date;                             ///< "YYYY:MM:DD HH:MM:SS", in EXR and TIFF; "" for none
  double dots_per_inch = 0.0;                   ///< resolution in EXR and TIFF; 0 for none
  std::span<const std::uint8_t> color_profile;  ///< ICC; empty for none

  // Further attributes of the header of EXR files.
  std::vector<std::pair<std::string, std::string>> header;  ///< names of more attributes, and their texts
  std::vector<std::pair<std::string, std::array<float, 16>>>
      maps;                               ///< transforms of points, row after row, for row vectors
  std::array<float, 8> chromaticities{};  ///< x and y of red, green, blue and white; zeros: not set
};

/// A picture read from a file: floats in [0, 1], premultiplied.
struct DecodedImage {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> values;
};

/// Encodes a picture row after row.
class RowEncoder {
 public:
  virtual ~RowEncoder() = default;
  /// Adds the next rows, any whole number of them: floats in [0, 1] (EXR: any).
  virtual void add(std::span<const float> rows) = 0;
  /// Must be called after the last row. Hands the bytes of the file on to `take`, piece by piece.
  virtual void finish(const std::function<void(std::span<const std::byte>)>& take) = 0;
};

/// The functions of the module. Reading and writing throw std::runtime_error with OpenImageIO's message.
class ImageCodec {
 public:
  virtual ~ImageCodec() = default;
  virtual std::unique_ptr<RowEncoder> begin(const ImageToEncode& image) const = 0;
  virtual DecodedImage decode(const std::string& path) const = 0;
  /// Returns the loaded version: "OpenImageIO 2.4.7".
  virtual std::string library() const = 0;
};

/// Returns the codec, and loads the module at the first call; from any thread. Throws Error if it is missing or of
/// another build, CapacityError if the system cannot load it.
const ImageCodec& image_codec();

/// Returns the time in SOURCE_DATE_EPOCH (reproducible-builds.org), or 0, so that a command always writes the same
/// bytes.
std::time_t source_date();

}  // namespace meniscus
