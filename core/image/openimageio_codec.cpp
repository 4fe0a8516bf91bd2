// SPDX-License-Identifier: BSD-3-Clause
// The module that wraps OpenImageIO: it exports one function.
#include <stdexcept>
#include <string_view>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "core/base/version.h"
#include "core/image/image_codec.h"

namespace meniscus {
namespace {

OIIO::ImageSpec spec_of(const ImageToEncode& image) {
  const auto type = image.sample == SampleType::float32 ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
  OIIO::ImageSpec spec(image.width, image.height, static_cast<int>(image.channels.size()), type);
  spec.channelnames = image.channels;
  spec.alpha_channel = image.alpha_channel;
  spec.z_channel = image.depth_channel;
  spec.attribute("oiio:ColorSpace", image.color_space);
  if (image.unassociated_alpha) spec.attribute("oiio:UnassociatedAlpha", 1);
  if (!image.compression.empty()) spec.attribute("compression", image.compression);
  if (image.png_level >= 0) spec.attribute("png:compressionLevel", image.png_level);
  if (!image.software.empty()) spec.attribute("Software", image.software);
  // Without a date OpenImageIO would write the present time; other empty texts are omitted.
  if (image.date.empty())
    spec.attribute("DateTime", 0);
  else
    spec.attribute("DateTime", image.date);
  const std::string& description = image.command.empty() ? image.scene : image.command;
  if (!description.empty()) spec.attribute("ImageDescription", description);
  for (const auto& [name, text] : image.header) spec.attribute(name, text);
  for (const auto& [name, map] : image.maps) spec.attribute(name, OIIO::TypeMatrix44, map.data());
  if (image.chromaticities.front() > 0.0f)
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), image.chromaticities.data());
  if (image.dots_per_inch > 0.0) {
    spec.attribute("XResolution", static_cast<float>(image.dots_per_inch));
    spec.attribute("YResolution", static_cast<float>(image.dots_per_inch));
    spec.attribute("ResolutionUnit", "in");
  }
  return spec;
}

/// Writes rows to memory.
class OpenImageIORows final : public RowEncoder {
 public:
  explicit OpenImageIORows(const ImageToEncode& image)
      : row_size_(static_cast<std::size_t>(image.width) * image.channels.size()) {
    const std::string name = "picture." + image.format;
    output_ = OIIO::ImageOutput::create(name, &sink_);
    if (!output_) throw std::runtime_error(OIIO::geterror());
    check(output_->open(name, spec_of(image)));
  }

  void add(std::span<const float> rows) override {
    const int end = next_row_ + static_cast<int>(rows.size() / row_size_);
    check(output_->write_scanlines(next_row_, end, 0, OIIO::TypeDesc::FLOAT, rows.data()));
    next_row_ = end;
  }

  void finish(const std::function<void(std::span<const std::byte>)>& take) override {
    check(output_->close());
    take(std::as_bytes(std::span(bytes_)));
  }

 private:
  void check(bool done) const {
    if (!done) throw std::runtime_error(output_->geterror());
  }

  std::size_t row_size_;
  std::vector<std::uint8_t> bytes_;
  OIIO::Filesystem::IOVecOutput sink_{bytes_};
  std::unique_ptr<OIIO::ImageOutput> output_;
  int next_row_ = 0;
};

class OpenImageIOCodec final : public ImageCodec {
 public:
  std::unique_ptr<RowEncoder> begin(const ImageToEncode& image) const override {
    return std::make_unique<OpenImageIORows>(image);
  }

  DecodedImage decode(const std::string& path) const override {
    // ImageBuf is not used, because its cache misses changes of a file within a second.
    const auto picture = OIIO::ImageInput::open(path);
    if (!picture) throw std::runtime_error(OIIO::geterror());
    const OIIO::ImageSpec& spec = picture->spec();
    DecodedImage decoded{spec.width, spec.height, spec.nchannels, {}};
    decoded.values.resize(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
    if (!picture->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, decoded.values.data()))
      throw std::runtime_error(picture->geterror());
    return decoded;
  }

  std::string library() const override {
    const int version = OIIO::openimageio_version();
    return "OpenImageIO " + std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
           std::to_string(version % 100);
  }
};

}  // namespace
}  // namespace meniscus

// Returns null to a program that was built with other definitions of the exchanged types.
extern "C" __attribute__((visibility("default"))) const meniscus::ImageCodec* meniscus_image_codec(
    const char* version, std::size_t image_size) {
  static const meniscus::OpenImageIOCodec codec;
  OIIO::attribute("debug", 0);  // it would print on stderr what it omits
  return version == std::string_view(MENISCUS_VERSION) && image_size == sizeof(meniscus::ImageToEncode) ? &codec
                                                                                                        : nullptr;
}
