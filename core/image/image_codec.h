// SPDX-License-Identifier: BSD-3-Clause
// Encodes and decodes pictures with OpenImageIO, which is loaded when the first picture is made.
//
// OpenImageIO brings two hundred libraries, a quarter of a second and a hundred megabytes before main(); most commands
// make no picture. So what needs it is a module of its own (openimageio_codec.cpp), found beside the program.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace meniscus {

enum class SampleType : std::uint8_t { uint8, uint16, float32 };

/// A picture as a file will hold it, but for its pixels. Rows from the top, channels of a pixel together.
struct ImageToEncode {
  std::string format;  ///< "png", "jpeg", "webp", "tiff" or "exr"
  std::string file;    ///< TIFF: written under this name, for OpenImageIO 2.4 cannot write it to memory
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  SampleType sample = SampleType::uint8;
  int alpha_channel = -1;                       ///< -1: none
  int depth_channel = -1;                       ///< likewise
  std::string color_space;                      ///< "sRGB" or "Linear"
  bool unassociated_alpha = false;              ///< colours are not multiplied by alpha
  std::string compression;                      ///< "" for the format's own
  int png_level = -1;                           ///< of 9; -1 for the usual
  std::string software;                         ///< written into the file; "" for nothing
  std::string command;                          ///< how it was made, likewise
  std::string scene;                            ///< what it was made of (JSON), likewise
  std::string made_of;                          ///< PNG: kMadeOfNote, likewise
  std::string date;                             ///< "YYYY:MM:DD HH:MM:SS", in EXR and TIFF; "" for none
  double dots_per_inch = 0.0;                   ///< likewise; 0 for nothing
  std::span<const std::uint8_t> color_profile;  ///< ICC; empty for none

  // Further attributes of the header of EXR files.
  std::vector<std::pair<std::string, std::string>> header;          ///< names of more attributes, and their texts
  std::vector<std::pair<std::string, std::array<float, 16>>> maps;  ///< of points, row after row, for row vectors
  std::array<float, 8> chromaticities{};  ///< x and y of red, green, blue and white; zeros: not said
};

/// A picture read from a file: floats in [0, 1], colours multiplied by their alpha.
struct DecodedImage {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> values;
};

/// The size in bytes of the pixels alone, not compressed.
std::size_t pixel_bytes(const ImageToEncode& image);

/// Encodes a picture row after row. Of WebP it keeps them all.
class RowEncoder {
 public:
  virtual ~RowEncoder() = default;
  /// The next rows, any whole number of them: floats in [0, 1] (EXR: any).
  virtual void add(std::span<const float> rows) = 0;
  /// Behind the last row: the bytes of the file; of TIFF none, they are in ImageToEncode::file.
  virtual std::vector<std::uint8_t> finish() = 0;
};

/// What the module gives. Reading and writing throw std::runtime_error with OpenImageIO's words.
class ImageCodec {
 public:
  virtual ~ImageCodec() = default;
  virtual std::unique_ptr<RowEncoder> begin(const ImageToEncode& image) const = 0;
  virtual DecodedImage decode(const std::string& path) const = 0;
  /// "OpenImageIO 2.4.7", as it is loaded.
  virtual std::string library() const = 0;
};

/// Loads the module at the first call; from any thread. Throws Error where it is missing or of another build,
/// CapacityError where the system cannot load it.
const ImageCodec& image_codec();

}  // namespace meniscus
