// SPDX-License-Identifier: BSD-3-Clause
// Writes TIFF files (TIFF 6.0, Adobe 1992) as strips of rows and a directory of tags, and JPEG files by TurboJPEG,
// whose Exif data is such a directory, too.
#include "core/image/print_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include <turbojpeg.h>

#include "core/base/error.h"
#include "core/image/color_space.h"
#include "core/image/png_file.h"

namespace meniscus {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The number by which files name a type of values.
enum class TiffType : std::uint8_t { text = 2, word16 = 3, word32 = 4, fraction = 5, bytes = 7 };

/// A tag of a directory: the number that says what its values are, and the values. A fraction is two values.
struct TiffTag {
  std::uint16_t number;
  TiffType type;
  std::vector<std::uint32_t> values;
};

/// Appends a number, the least significant byte first.
void add_number(Bytes& bytes, std::uint32_t number, int size) {
  for (int n = 0; n < size; ++n) bytes.push_back(static_cast<std::uint8_t>(number >> (8 * n)));
}

/// Returns the tag of a text; it has no values if the text is empty.
TiffTag text_tag(std::uint16_t number, std::string_view text) {
  TiffTag tag{number, TiffType::text, {text.begin(), text.end()}};
  if (!text.empty()) tag.values.push_back(0);
  return tag;
}

/// Returns the tags of a resolution; there are none if it is 0.
std::vector<TiffTag> resolution_tags(double dots_per_inch) {
  constexpr std::uint32_t kInch = 2, kParts = 1000;
  if (dots_per_inch <= 0.0) return {};
  const auto parts = static_cast<std::uint32_t>(std::lround(dots_per_inch * kParts));
  return {{282, TiffType::fraction, {parts, kParts}},
          {283, TiffType::fraction, {parts, kParts}},
          {296, TiffType::word16, {kInch}}};
}

/// Returns the first bytes of a file whose directory is at this place.
Bytes tiff_header(std::uint32_t directory) {
  Bytes header{'I', 'I', 42, 0};  // little-endian
  add_number(header, directory, 4);
  return header;
}

/// Returns a directory for this place in a file, of the tags that have values.
Bytes tiff_directory(std::vector<TiffTag> tags, std::uint32_t place) {
  constexpr std::size_t kTag = 12, kRoom = 4;  // values of up to four bytes are part of their tag
  constexpr std::array kSize{1, 1, 1, 2, 4, 4, 1, 1};
  std::erase_if(tags, [](const TiffTag& tag) { return tag.values.empty(); });
  std::ranges::sort(tags, {}, &TiffTag::number);
  const std::size_t end = place + 2 + kTag * tags.size() + 4;
  Bytes directory, behind;
  add_number(directory, static_cast<std::uint32_t>(tags.size()), 2);
  for (const TiffTag& tag : tags) {
    const std::size_t count = tag.values.size() / (tag.type == TiffType::fraction ? 2 : 1);
    Bytes values;
    for (const std::uint32_t value : tag.values) add_number(values, value, kSize[static_cast<std::size_t>(tag.type)]);
    values.resize(std::max(kRoom, values.size() + values.size() % 2));
    add_number(directory, tag.number, 2);
    add_number(directory, static_cast<std::uint32_t>(tag.type), 2);
    add_number(directory, static_cast<std::uint32_t>(count), 4);
    if (values.size() > kRoom) add_number(directory, static_cast<std::uint32_t>(end + behind.size()), 4);
    Bytes& to = values.size() > kRoom ? behind : directory;
    to.insert(to.end(), values.begin(), values.end());
  }
  add_number(directory, 0, 4);  // no other directory follows
  directory.insert(directory.end(), behind.begin(), behind.end());
  return directory;
}

/// Returns a whole LZW stream (TIFF 6.0, section 13): codes of 9 to 12 bits, the most significant bit first.
Bytes lzw_stream(std::span<const std::uint8_t> bytes) {
  constexpr std::uint32_t kClear = 256, kEnd = 257, kFirst = 258, kFull = 4094;
  Bytes stream;
  std::unordered_map<std::uint32_t, std::uint32_t> codes;  // keys: the code of a text and the byte that follows it
  std::uint32_t bits = 0, next = kFirst;
  int held = 0, width = 9;
  const auto put = [&](std::uint32_t code) {
    bits = bits << width | code;
    for (held += width; held >= 8; held -= 8) stream.push_back(static_cast<std::uint8_t>(bits >> (held - 8)));
  };
  const auto clear = [&] {
    put(kClear);
    codes.clear();
    next = kFirst;
    width = 9;
  };
  const auto put_text = [&](std::uint32_t code) {
    put(code);
    if (++next == kFull) return clear();
    if (next >> width != 0) ++width;
  };
  clear();
  std::uint32_t text = bytes.front();
  for (const std::uint8_t byte : bytes.subspan(1)) {
    const auto [longer, is_new] = codes.try_emplace(text << 8 | byte, next);
    text = is_new ? text : longer->second;
    if (!is_new) continue;
    put_text(text);
    text = byte;
  }
  put_text(text);
  put(kEnd);
  if (held > 0) stream.push_back(static_cast<std::uint8_t>(bits << (8 - held)));
  return stream;
}

/// Compresses rows strip by strip, and keeps the strips until the end.
class TiffRows final : public RowEncoder {
 public:
  explicit TiffRows(const ImageToEncode& image) : image_(image) {}

  void add(std::span<const float> rows) override {
    const std::size_t row = static_cast<std::size_t>(image_.width) * image_.channels.size();
    for (; !rows.empty(); rows = rows.subspan(row)) {
      add_row(rows.first(row));
      if (strip_.size() == kRowsOfAStrip * row * sample_size_) end_strip();
    }
  }

  void finish(const std::function<void(std::span<const std::byte>)>& take) override {
    if (!strip_.empty()) end_strip();
    const auto place = static_cast<std::uint32_t>(kHeader + strips_.size());
    for (const Bytes& part : {tiff_header(place), std::move(strips_), tiff_directory(tags(), place)})
      take(std::as_bytes(std::span(part)));
  }

 private:
  static constexpr std::uint32_t kHeader = 8, kRowsOfAStrip = 32;

  /// Adds values, or the differences of neighbouring pixels if they are compressed.
  void add_row(std::span<const float> row) {
    const std::size_t channels = image_.channels.size();
    const float largest = sample_size_ == 2 ? 65535.0f : 255.0f;
    std::vector<std::uint32_t> left(channels, 0);
    for (std::size_t n = 0; n < row.size(); ++n) {
      const auto value = static_cast<std::uint32_t>(std::clamp(row[n], 0.0f, 1.0f) * largest + 0.5f);
      add_number(strip_, value - left[n % channels], sample_size_);
      if (image_.compression != "none") left[n % channels] = value;
    }
  }

  void end_strip() {
    constexpr int kLevel = 6;
    constexpr std::uint32_t kLargest = std::numeric_limits<std::uint32_t>::max(), kRoomOfTags = 64 << 20;
    const Bytes strip = image_.compression == "zip"   ? zlib_stream(std::as_bytes(std::span(strip_)), kLevel)
                        : image_.compression == "lzw" ? lzw_stream(strip_)
                                                      : strip_;
    if (strips_.size() + strip.size() > kLargest - kRoomOfTags)
      throw std::runtime_error("a TIFF file has at most 4 GiB");
    places_.push_back(static_cast<std::uint32_t>(kHeader + strips_.size()));
    sizes_.push_back(static_cast<std::uint32_t>(strip.size()));
    strips_.insert(strips_.end(), strip.begin(), strip.end());
    strips_.resize(strips_.size() + strips_.size() % 2);  // the directory begins at an even place
    strip_.clear();
  }

  std::vector<TiffTag> tags() const {
    using enum TiffType;
    using Values = std::vector<std::uint32_t>;
    constexpr std::uint32_t kPlain = 1, kLzw = 5, kZip = 8, kRgb = 2, kFromTop = 1, kAdjacent = 1, kDifferences = 2,
                            kUnassociated = 2;
    const auto channels = static_cast<std::uint32_t>(image_.channels.size());
    const std::uint32_t compression = image_.compression == "zip" ? kZip : image_.compression == "lzw" ? kLzw : kPlain;
    std::vector<TiffTag> tags{
        {256, word32, {static_cast<std::uint32_t>(image_.width)}},                       // ImageWidth
        {257, word32, {static_cast<std::uint32_t>(image_.height)}},                      // ImageLength
        {258, word16, Values(channels, 8u * static_cast<std::uint32_t>(sample_size_))},  // BitsPerSample
        {259, word16, {compression}},                                                    // Compression
        {262, word16, {kRgb}},                                                           // PhotometricInterpretation
        text_tag(270, image_.command.empty() ? image_.scene : image_.command),           // ImageDescription
        {273, word32, places_},                                                          // StripOffsets
        {274, word16, {kFromTop}},                                                       // Orientation
        {277, word16, {channels}},                                                       // SamplesPerPixel
        {278, word32, {kRowsOfAStrip}},                                                  // RowsPerStrip
        {279, word32, sizes_},                                                           // StripByteCounts
        {284, word16, {kAdjacent}},                                                      // PlanarConfiguration
        text_tag(305, image_.software),                                                  // Software
        text_tag(306, image_.date),                                                      // DateTime
        {317, word16, compression == kPlain ? Values{} : Values{kDifferences}},          // Predictor
        {338, word16, image_.alpha_channel < 0 ? Values{} : Values{kUnassociated}},      // ExtraSamples
        {34675, bytes, {image_.color_profile.begin(), image_.color_profile.end()}},      // InterColorProfile
    };
    std::ranges::move(resolution_tags(image_.dots_per_inch), std::back_inserter(tags));
    return tags;
  }

  ImageToEncode image_;
  int sample_size_ = image_.sample == SampleType::uint16 ? 2 : 1;  // in bytes
  Bytes strip_, strips_;                                           // uncompressed rows; the complete strips of the file
  std::vector<std::uint32_t> places_, sizes_;                      // offsets and sizes of the strips, in bytes
};

/// Appends a segment: its marker, its size, a text that names its content, and the content.
void add_segment(Bytes& file, std::uint8_t marker, std::string_view name, std::span<const std::uint8_t> content) {
  const std::size_t size = 2 + name.size() + content.size();
  if (size > 0xffff) throw std::runtime_error("a text of a JPEG file has at most 64 KiB");
  for (const std::size_t byte : {std::size_t{0xff}, std::size_t{marker}, size >> 8, size & 0xff})
    file.push_back(static_cast<std::uint8_t>(byte));
  file.insert(file.end(), name.begin(), name.end());
  file.insert(file.end(), content.begin(), content.end());
}

/// Keeps all rows until the end, because TurboJPEG takes whole pictures.
class JpegRows final : public RowEncoder {
 public:
  explicit JpegRows(const ImageToEncode& image) : image_(image) {
    constexpr int kLargest = 65500;
    if (std::max(image.width, image.height) > kLargest)
      throw std::runtime_error("a JPEG file has at most 65,500 pixels a side");
  }

  void add(std::span<const float> rows) override {
    for (const float value : rows) pixels_.push_back(display_byte(value));
  }

  void finish(const std::function<void(std::span<const std::byte>)>& take) override {
    using namespace std::string_view_literals;
    constexpr std::uint8_t kExif = 0xe1, kProfile = 0xe2, kComment = 0xfe;
    constexpr std::size_t kUnit = 13, kBegin = 20;  // the offset of JFIF's resolution, and the end of JFIF's segment
    const Bytes picture = encode_jpeg(pixels_, image_.width, image_.height, JpegUse::file);
    Bytes file(picture.begin(), picture.begin() + kBegin);
    if (image_.dots_per_inch > 0.0) {
      const auto density = static_cast<std::uint16_t>(std::min(std::lround(image_.dots_per_inch), 0xffffL));
      const auto high = static_cast<std::uint8_t>(density >> 8), low = static_cast<std::uint8_t>(density & 0xff);
      std::ranges::copy(std::array<std::uint8_t, 5>{1, high, low, high, low}, file.begin() + kUnit);
    }
    std::vector<TiffTag> tags = resolution_tags(image_.dots_per_inch);
    tags.push_back(text_tag(305, image_.software));
    Bytes exif = tiff_header(8);
    std::ranges::copy(tiff_directory(tags, 8), std::back_inserter(exif));
    const bool has_tags = std::ranges::any_of(tags, [](const TiffTag& tag) { return !tag.values.empty(); });
    if (has_tags) add_segment(file, kExif, "Exif\0\0"sv, exif);
    if (!image_.color_profile.empty()) add_segment(file, kProfile, "ICC_PROFILE\0\1\1"sv, image_.color_profile);
    if (const std::string& text = image_.command.empty() ? image_.scene : image_.command; !text.empty())
      add_segment(file, kComment, text, {});
    take(std::as_bytes(std::span(file)));
    take(std::as_bytes(std::span(picture).subspan(kBegin)));
  }

 private:
  ImageToEncode image_;
  Bytes pixels_;
};

}  // namespace

std::vector<std::uint8_t> encode_jpeg(std::span<const std::uint8_t> pixels, int width, int height, JpegUse use) {
  struct Settings {
    int quality, colors, flags;  // quality: 0 to 100
  };
  constexpr std::array<Settings, 3> kSettings{
      {{80, TJSAMP_420, TJFLAG_FASTDCT}, {80, TJSAMP_444, 0}, {95, TJSAMP_444, TJFLAG_ACCURATEDCT}}};
  const Settings& settings = kSettings[static_cast<std::size_t>(use)];
  const bool has_fourth = pixels.size() > 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::unique_ptr<void, int (*)(void*)> compressor(tjInitCompress(), tjDestroy);
  if (!compressor) throw Error(std::string("JPEG: ") + tjGetErrorStr2(nullptr));
  unsigned char* bytes = nullptr;
  unsigned long count = 0;
  const int failed = tjCompress2(compressor.get(), pixels.data(), width, 0, height, has_fourth ? TJPF_RGBX : TJPF_RGB,
                                 &bytes, &count, settings.colors, settings.quality, settings.flags);
  Bytes result;
  if (!failed) result.assign(bytes, bytes + count);
  tjFree(bytes);
  if (failed) throw Error(std::string("JPEG: ") + tjGetErrorStr2(compressor.get()));
  return result;
}

std::unique_ptr<RowEncoder> begin_rows(const ImageToEncode& image) {
  if (image.format == "tiff") return std::make_unique<TiffRows>(image);
  if (image.format == "jpeg") return std::make_unique<JpegRows>(image);
  return image_codec().begin(image);
}

}  // namespace meniscus
