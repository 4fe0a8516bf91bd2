// SPDX-License-Identifier: BSD-3-Clause
// Picture files are read back with their channels, alpha and colour space; wrong settings are refused.
#include "core/image/color_space.h"
#include "core/render/image_output.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <set>
#include <string>
#include <string_view>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/base/constants.h"
#include "core/base/error.h"
#include "core/image/image_codec.h"
#include "core/image/png_file.h"

namespace meniscus {
namespace {

class ImageFile : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// Four pixels: nothing, half covered, full, and brighter than white.
  static Framebuffer picture() {
    Framebuffer p;
    p.size = {2, 2};
    p.color = {{0, 0, 0, 0}, {0.25f, 0.1f, 0.05f, 0.5f}, {0.5f, 0.2f, 0.1f, 1.0f}, {2.0f, 1.0f, 0.0f, 1.0f}};
    const float inf = std::numeric_limits<float>::infinity();
    p.z = {inf, 10.5f, 11.0f, 12.0f};
    p.normal = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    p.position = {{0, 0, 0}, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
    p.atom = {kNone, 165174, 0, 5};
    p.kind = {kNone, 0, 1, 2};
    p.component = {kNone, 0, 0, 3};
    return p;
  }

  struct File {
    OIIO::ImageSpec spec;
    std::vector<float> values;
    float at(int pixel, const std::string& channel) const {
      return values[pixel * spec.nchannels + spec.channelindex(channel)];
    }
  };
  static File read(const std::filesystem::path& path) {
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // The file's own values are read.
    auto input = OIIO::ImageInput::open(path.string(), &config);
    EXPECT_TRUE(input) << OIIO::geterror();
    File file{input->spec(), std::vector<float>(input->spec().image_pixels() * input->spec().nchannels)};
    EXPECT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, file.values.data()));
    return file;
  }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("meniscus_images_" + std::to_string(::getpid()));
};

TEST_F(ImageFile, ExrHoldsEverythingInFloat) {
  write_image(folder_ / "a.exr", picture(), {});
  const File file = read(folder_ / "a.exr");
  ASSERT_EQ(file.spec.nchannels, 14);
  EXPECT_EQ(file.spec.format, OIIO::TypeDesc::FLOAT);
  EXPECT_EQ(file.at(1, "R"), 0.25f);
  EXPECT_EQ(file.at(1, "A"), 0.5f);
  EXPECT_EQ(file.at(3, "R"), 2.0f);
  EXPECT_TRUE(std::isinf(file.at(0, "Z")));
  EXPECT_EQ(file.at(1, "Z"), 10.5f);
  EXPECT_EQ(file.at(2, "N.y"), 1.0f);
  EXPECT_EQ(file.at(3, "P.z"), 9.0f);
  EXPECT_EQ(file.at(0, "atom"), -1.0f);
  EXPECT_EQ(file.at(1, "atom"), 165174.0f);
  EXPECT_EQ(file.at(2, "kind"), 1.0f);
  EXPECT_EQ(file.at(3, "component"), 3.0f);
}

TEST_F(ImageFile, PngAndTiffAreSrgbWithUnassociatedAlpha) {
  for (const char* name : {"a.png", "a.tif", "a.TIFF"}) {
    write_image(folder_ / name, picture(), {});
    const File file = read(folder_ / name);
    ASSERT_EQ(file.spec.nchannels, 4) << name;
    EXPECT_NEAR(file.at(1, "R"), srgb_from_linear(0.5f), 0.003) << name;
    EXPECT_NEAR(file.at(1, "G"), srgb_from_linear(0.2f), 0.003) << name;
    EXPECT_NEAR(file.at(1, "A"), 0.5, 0.003) << name;
    EXPECT_EQ(file.at(0, "A"), 0.0f) << name;
    EXPECT_EQ(file.at(3, "R"), 1.0f) << name;
  }
}

TEST_F(ImageFile, JpegHasWhiteBehindAndWebPItsAlpha) {
  Framebuffer large = picture();  // Blocks of JPEG and WebP blur smaller areas.
  large.size = {64, 32};
  large.color.clear();
  for (int n = 0; n < 64 * 32; ++n)
    large.color.push_back(n % 64 < 32 ? glm::vec4(0.0f) : glm::vec4(0.5f, 0.2f, 0.1f, 1.0f));
  constexpr int kEmpty = 16 * 64 + 8, kFull = 16 * 64 + 50;
  for (const char* name : {"a.jpg", "a.JPEG"}) {
    write_image(folder_ / name, large, {});
    const File file = read(folder_ / name);
    ASSERT_EQ(file.spec.nchannels, 3) << name;
    EXPECT_NEAR(file.at(kEmpty, "G"), 1.0, 0.01);
    EXPECT_NEAR(file.at(kFull, "R"), srgb_from_linear(0.5f), 0.02);
    EXPECT_EQ(file.spec.get_string_attribute("jpeg:subsampling"), "4:4:4");
  }
  write_image(folder_ / "a.webp", large, {});
  const File file = read(folder_ / "a.webp");
  ASSERT_EQ(file.spec.nchannels, 4);
  EXPECT_NEAR(file.at(kEmpty, "A"), 0.0, 0.01);
  EXPECT_NEAR(file.at(kFull, "A"), 1.0, 0.01);
  EXPECT_NEAR(file.at(kFull, "G"), srgb_from_linear(0.2f), 0.02);
}

/// Colours that repeat in part, so that tables of texts are long and become full.
Framebuffer noisy(glm::ivec2 size) {
  Framebuffer picture;
  picture.size = size;
  std::uint32_t noise = 1;
  for (int n = 0; n < size.x * size.y; ++n) {
    noise = noise * 1664525u + 1013904223u;
    const float light = static_cast<float>(n % size.x) / static_cast<float>(size.x);
    picture.color.emplace_back(glm::vec3(light, static_cast<float>(noise >> 24) / 255.0f, 0.5f * light), 1.0f);
    if (n % 5 == 0) picture.color.back() *= static_cast<float>(noise >> 28) / 15.0f;
  }
  return picture;
}

TEST_F(ImageFile, TiffKeepsEveryValue) {
  for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(7, 33), glm::ivec2(301, 200)})
    for (const auto compression : {TiffCompression::none, TiffCompression::lzw, TiffCompression::zip})
      for (const int bits : {8, 16})
        for (const auto& background : {std::optional<glm::vec3>(), std::optional(glm::vec3(0.2f, 0.5f, 1.0f))}) {
          SCOPED_TRACE(fmt::format("{}x{}, {}, {} bits, {}", size.x, size.y, static_cast<int>(compression), bits,
                                   background ? "opaque" : "transparent"));
          const Framebuffer picture = noisy(size);
          ImageSettings settings{.background = background, .existing = Existing::replace};
          settings.linear_alpha = false;
          settings.tiff = {compression, bits};
          write_image(folder_ / "a.tif", picture, settings);
          OIIO::ImageSpec as_stored;
          as_stored.attribute("oiio:UnassociatedAlpha", 1);
          auto input = OIIO::ImageInput::open((folder_ / "a.tif").string(), &as_stored);
          ASSERT_TRUE(input) << OIIO::geterror();
          const auto type = bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
          EXPECT_EQ(input->spec().format, type);
          const std::vector<std::uint8_t> wanted = srgb_pixels(picture, background, bits / 8);
          std::vector<std::uint8_t> stored(wanted.size());
          ASSERT_EQ(input->spec().image_bytes(), stored.size());
          ASSERT_TRUE(input->read_image(0, 0, 0, -1, type, stored.data())) << input->geterror();
          EXPECT_TRUE(stored == wanted);
        }
}

TEST_F(ImageFile, JpegIsThatOfOpenImageIO) {
  const Framebuffer picture = noisy({301, 200});
  const glm::vec3 white(1.0f);
  write_image(folder_ / "a.jpg", picture, {white, Existing::refuse});
  OIIO::ImageSpec spec(301, 200, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("compression", "jpeg:95");
  spec.attribute("jpeg:subsampling", "4:4:4");
  const auto output = OIIO::ImageOutput::create("b.jpg");
  ASSERT_TRUE(output && output->open((folder_ / "b.jpg").string(), spec));
  const std::vector<std::uint8_t> pixels = srgb_pixels(picture, white, 1);
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) && output->close());
  EXPECT_EQ(read(folder_ / "a.jpg").values, read(folder_ / "b.jpg").values);
}

TEST_F(ImageFile, JpegSaysWhatItCannotHold) {
  ImageSettings settings;
  settings.scene.assign(70000, ' ');
  EXPECT_THROW(write_image(folder_ / "a.jpg", picture(), settings), OutputError);
  Framebuffer wide;
  wide.size = {65501, 1};
  wide.color.resize(65501);
  EXPECT_THROW(write_image(folder_ / "a.jpg", wide, {}), OutputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(ImageFile, TiffAndJpegHaveAProfile) {
  for (const char* name : {"a.tif", "a.jpg"}) {
    write_image(folder_ / name, picture(), {});
    const File file = read(folder_ / name);
    const OIIO::ParamValue* profile = file.spec.find_attribute("ICCProfile");
    ASSERT_TRUE(profile) << name;
    const auto* const bytes = static_cast<const std::uint8_t*>(profile->data());
    EXPECT_EQ(std::vector<std::uint8_t>(bytes, bytes + profile->type().size()), srgb_profile()) << name;
  }
}

// The curve and the matrix agree with core/image/color_space.h.
TEST(SrgbProfile, IsThatOfTheFunctions) {
  const std::vector<std::uint8_t>& profile = srgb_profile();
  const auto word = [&](std::size_t at) {
    return profile[at] << 24 | profile[at + 1] << 16 | profile[at + 2] << 8 | profile[at + 3];
  };
  const auto place_of = [&](const std::string& name) {
    for (int n = 0; n < word(128); ++n)
      if (std::equal(name.begin(), name.end(), profile.begin() + 132 + 12 * n)) return word(132 + 12 * n + 4);
    return 0;
  };
  const auto fixed = [&](int at) { return word(static_cast<std::size_t>(at)) / 65536.0; };
  EXPECT_EQ(static_cast<std::size_t>(word(0)), profile.size());
  const int curve = place_of("gTRC") + 12;
  for (const float value : {0.01f, 0.04f, 0.05f, 0.5f, 1.0f}) {
    const double linear = value >= fixed(curve + 16)
                              ? std::pow(value * fixed(curve + 4) + fixed(curve + 8), fixed(curve))
                              : value * fixed(curve + 12);
    EXPECT_NEAR(linear, linear_from_srgb(value), 5e-5) << value;
  }
  // White is D50, the illuminant of profiles.
  for (int axis = 0; axis < 3; ++axis) {
    const double sum = fixed(place_of("rXYZ") + 8 + 4 * axis) + fixed(place_of("gXYZ") + 8 + 4 * axis) +
                       fixed(place_of("bXYZ") + 8 + 4 * axis);
    EXPECT_NEAR(sum, fixed(68 + 4 * axis), 3e-4);
  }
}

TEST_F(ImageFile, ResolutionAndCommandSurvive) {
  ImageSettings settings;
  settings.dots_per_inch = 300.0;
  settings.command = "meniscus render 'Å.pdb'";
  for (const char* name : {"a.png", "a.jpg", "a.tif", "a.exr"}) {
    write_image(folder_ / name, picture(), settings);
    const OIIO::ImageSpec spec = read(folder_ / name).spec;
    EXPECT_NEAR(
        spec.get_float_attribute("XResolution") * (spec.get_string_attribute("ResolutionUnit") == "m" ? 0.0254f : 1.0f),
        300.0f, 0.01f)
        << name << " " << spec.get_string_attribute("ResolutionUnit");
    EXPECT_EQ(spec.get_string_attribute("ImageDescription"), settings.command) << name;
    EXPECT_TRUE(std::string(spec.get_string_attribute("Software")).starts_with("Meniscus ")) << name;
  }
  settings.names_program = false;
  settings.existing = Existing::replace;
  write_image(folder_ / "a.png", picture(), settings);
  EXPECT_EQ(read(folder_ / "a.png").spec.get_string_attribute("Software"), "");
}

TEST_F(ImageFile, BackgroundIsMixedInLinearLight) {
  write_image(folder_ / "a.png", picture(), {glm::vec3(1.0f), Existing::refuse});
  const File file = read(folder_ / "a.png");
  ASSERT_EQ(file.spec.nchannels, 3);
  EXPECT_EQ(file.at(0, "R"), 1.0f);
  EXPECT_NEAR(file.at(1, "R"), srgb_from_linear(0.25f + 0.5f), 0.003);
  const glm::vec3 blue(0.2f, 0.5f, 0.8f);
  write_image(folder_ / "b.png", picture(), {blue, Existing::refuse});
  const File over_blue = read(folder_ / "b.png");
  for (int n = 0; n < 3; ++n) {
    const std::string channel(1, "RGB"[n]);
    EXPECT_NEAR(over_blue.at(0, channel), blue[n], 0.003) << "the background as it was asked for";
    const float half = picture().color[1][n] + 0.5f * linear_from_srgb(blue[n]);
    EXPECT_NEAR(over_blue.at(1, channel), srgb_from_linear(half), 0.003) << channel;
  }
}

TEST_F(ImageFile, RefusesWhatItCannotDo) {
  EXPECT_THROW(write_image(folder_ / "a.gif", picture(), {}), OutputError);
  EXPECT_THROW(write_image(folder_ / "png", picture(), {}), OutputError);
  EXPECT_THROW(write_image(folder_ / "none" / "a.png", picture(), {}), OutputError);
  write_image(folder_ / "a.png", picture(), {});
  EXPECT_THROW(write_image(folder_ / "a.png", picture(), {}), OutputError);
  EXPECT_NO_THROW(write_image(folder_ / "a.png", picture(), {std::nullopt, Existing::replace}));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1) << "a temporary file was left";
}

TEST_F(ImageFile, IsWholeOrNotThereWhenTheDiskIsFull) {
  rlimit old{};
  ::getrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, SIG_IGN);
  for (const char* name : {"a.png", "a.tif", "a.exr"}) {
    write_image(folder_ / name, picture(), {});
    const auto whole = std::filesystem::file_size(folder_ / name);
    std::filesystem::remove(folder_ / name);
    // Room grows from nothing to all but the last byte, behind which directories and end marks are.
    for (rlim_t room = 0; room < whole; room += std::min<rlim_t>(13, std::max<rlim_t>(1, whole - 1 - room))) {
      const rlimit small{room, old.rlim_max};
      ::setrlimit(RLIMIT_FSIZE, &small);
      EXPECT_THROW(write_image(folder_ / name, picture(), {}), OutputError) << name << " " << room;
      ::setrlimit(RLIMIT_FSIZE, &old);
      EXPECT_TRUE(std::filesystem::is_empty(folder_)) << name << " " << room;
    }
  }
}

TEST(ColorSpace, RoundTrips) {
  for (int i = 0; i <= 255; ++i) EXPECT_NEAR(srgb_from_linear(linear_from_srgb(i / 255.0f)), i / 255.0f, 1e-6);
  EXPECT_NEAR(linear_from_srgb(0.5f), 0.21404f, 1e-5);
}

// Films get their pixels from srgb_pixels(), equal to the bit to those of a PNG file.
TEST_F(ImageFile, PixelsOfFilmsAreThoseOfPng) {
  Framebuffer ramp;
  ramp.size = {4096, 1};
  for (int n = 0; n < ramp.size.x; ++n)
    ramp.color.emplace_back(glm::vec3(static_cast<float>(n) / 4095.0f) * glm::vec3(1.0f, 0.37f, 1.1f), 1.0f);
  const glm::vec3 white(1.0f);
  const std::vector<std::uint8_t> pixels = srgb_pixels(ramp, white);
  write_image(folder_ / "ramp.png", ramp, {white, Existing::refuse});
  auto input = OIIO::ImageInput::open((folder_ / "ramp.png").string());
  ASSERT_TRUE(input);
  std::vector<std::uint8_t> stored(pixels.size());
  ASSERT_EQ(input->spec().nchannels, 3);
  ASSERT_TRUE(input->read_image(0, 0, 0, -1, OIIO::TypeDesc::UINT8, stored.data()));
  EXPECT_EQ(pixels, stored);
}

/// Returns the chunks before the pixels, which hold sizes, colours and notes. Those of Exif are left out:
/// OpenImageIO 2.5 repeats notes there, and orders chunks anew.
std::set<std::string> chunks_before_pixels(const std::vector<std::uint8_t>& png) {
  constexpr std::size_t kSignature = 8, kBesideContent = 12;  // size, type and checksum
  const std::string bytes(png.begin(), png.end());
  std::set<std::string> chunks;
  for (std::size_t at = kSignature, size = 0; bytes.compare(at + 4, 4, "IDAT") != 0; at += size) {
    size = kBesideContent + (std::size_t{png[at + 2]} << 8 | png[at + 3]);
    if (bytes.compare(at + 4, 4, "eXIf") != 0) chunks.insert(bytes.substr(at, size));
  }
  return chunks;
}

TEST_F(ImageFile, PngIsThatOfOpenImageIO) {
  const std::vector<glm::ivec2> sizes{{1, 1},   {1, 30},  {30, 1},  {2, 2},    {9, 10},
                                      {40, 41}, {63, 64}, {66, 65}, {300, 200}};
  for (const glm::ivec2 size : sizes)
    for (const std::size_t channels : {3u, 4u}) {
      SCOPED_TRACE(fmt::format("{}x{}, {} channels", size.x, size.y, channels));
      std::vector<std::uint8_t> pixels;
      for (int n = 0; n < size.x * size.y * 4; ++n)
        pixels.push_back(n % 7 ? static_cast<std::uint8_t>(127 + 120 * std::sin(0.1 * n)) : 255);
      ImageToEncode image;
      image.format = "png";
      image.width = size.x;
      image.height = size.y;
      image.channels = {"R", "G", "B", "A"};
      image.channels.resize(channels);
      image.alpha_channel = channels == 4 ? 3 : -1;
      image.color_space = "sRGB";
      image.unassociated_alpha = true;
      image.software = "Meniscus";
      std::vector<float> values;
      for (std::size_t n = 0; n < pixels.size(); ++n)
        if (n % 4 < channels) values.push_back(static_cast<float>(pixels[n]) / 255.0f);
      const std::unique_ptr<RowEncoder> encoder = image_codec().begin(image);
      encoder->add(values);
      // A picture of three channels has no use for the fourth byte.
      std::vector<std::uint8_t> theirs;
      encoder->finish([&](std::span<const std::byte> bytes) {
        for (const std::byte byte : bytes) theirs.push_back(std::to_integer<std::uint8_t>(byte));
      });
      const std::vector<std::uint8_t> ours = encode_png(image, pixels, 4);
      EXPECT_EQ(chunks_before_pixels(ours), chunks_before_pixels(theirs));
      EXPECT_LT(ours.size(), theirs.size() + theirs.size() / 10 + 100);
      const std::string file = (folder_ / "p.png").string();
      std::ofstream(file, std::ios::binary).write(reinterpret_cast<const char*>(ours.data()), std::ssize(ours));
      std::vector<std::uint8_t> stored, wanted;
      for (const float value : read(file).values) stored.push_back(display_byte(value));
      for (std::size_t n = 0; n < pixels.size(); ++n)
        if (n % 4 < channels) wanted.push_back(pixels[n]);
      EXPECT_EQ(stored, wanted);
    }
}

TEST(DisplayColor, BytesOfATableAreThoseOfTheFormula) {
  std::vector<glm::vec4> pixels;
  const auto add = [&](float light) { pixels.emplace_back(light, 0.5f * light, 1.25f * light, 1.0f); };
  for (int n = 0; n <= 100000; ++n) add(static_cast<float>(n) / 100000.0f);
  for (int byte = 1; byte < 256; ++byte) {  // Values lie on both sides of each step.
    float light = linear_from_srgb((static_cast<float>(byte) - 0.5f) / 255.0f);
    for (int n = 0; n < 200; ++n) light = std::nextafter(light, 0.0f);
    for (int n = 0; n < 400; ++n) add(light = std::nextafter(light, 1.0f));
  }
  for (std::size_t n = 0; n < pixels.size(); n += 3) pixels[n] *= 0.3f;  // Alpha is multiplied in.
  pixels.emplace_back(0.0f);
  struct Case {
    std::optional<glm::vec3> background;
    std::size_t channels;
  };
  for (const auto& [background, channels] :
       {Case{{}, 4}, Case{glm::vec3(0.2f, 0.9f, 1.0f), 3}, Case{glm::vec3(1.0f), 4}}) {
    std::vector<std::uint8_t> bytes(pixels.size() * channels), wanted;
    display_bytes(pixels, background, channels, bytes.data());
    for (const glm::vec4& pixel : pixels) {
      const glm::vec4 color = display_color(pixel, background);
      for (std::size_t channel = 0; channel < channels; ++channel)
        wanted.push_back(display_byte(color[static_cast<int>(channel)]));
    }
    EXPECT_EQ(bytes, wanted);
  }
}

TEST(DisplayColor, EdgesForLayoutAreOnAPageWhatTheyAreOnWhite) {
  std::vector<glm::vec4> pixels{{0.0f, 0.0f, 0.0f, 0.0f}, {0.2f, 0.5f, 0.9f, 1.0f}};
  for (int n = 1; n < 20; ++n) {
    const float alpha = static_cast<float>(n) / 20.0f;
    for (const glm::vec3& color : {glm::vec3(0.0f), glm::vec3(1.0f), glm::vec3(0.3f), glm::vec3(0.9f, 0.05f, 0.2f)})
      pixels.emplace_back(color * alpha, alpha);
  }
  std::vector<std::uint8_t> bytes(4 * pixels.size());
  layout_bytes(pixels, bytes.data());
  float before = 0.0f;
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    const glm::vec4 stored = layout_color(pixels[n]), linear = display_color(pixels[n], {});
    const glm::vec4 white = display_color(pixels[n], glm::vec3(1.0f)),
                    black = display_color(pixels[n], glm::vec3(0.0f));
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(stored[c], -1e-5f);
      EXPECT_LE(stored[c], 1.0f + 1e-5f);
      // A program that blends the file's values computes this.
      EXPECT_NEAR(stored[c] * stored.w + 1.0f - stored.w, white[c], 1e-5f);
      if (pixels[n].x == pixels[n].y && pixels[n].y == pixels[n].z) {
        EXPECT_NEAR(stored[c] * stored.w, black[c], 1e-5f);
      }
      before = std::max(before, std::abs(linear[c] * linear.w + 1.0f - linear.w - white[c]));
    }
    for (int c = 0; c < 4; ++c) EXPECT_EQ(bytes[4 * n + c], display_byte(stored[c]));
  }
  EXPECT_GT(before, 0.2f) << "what linear alpha does there";
}

}  // namespace
}  // namespace meniscus
