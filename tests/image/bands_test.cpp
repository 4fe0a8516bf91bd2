// SPDX-License-Identifier: BSD-3-Clause
// Pictures that are made and written in bands have the bits of the whole picture, and the bytes of its file.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include "core/camera/camera.h"
#include "core/image/png_file.h"
#include "core/queries/copies.h"
#include "core/render/cpu/cpu_renderer.h"
#include "core/render/picture_file.h"
#include "core/scene/cut.h"
#include "core/surface/compute_surface.h"
#include "tests/support/molecules.h"

namespace meniscus {
namespace {

/// A protein in two colours.
struct Subject {
  Surface surface = compute_surface_cpu(testing::ubiquitin(), 1.4);
  Coloring coloring;
  Camera camera = frame_camera(surface.atoms, 230.0 / 330.0);
  RenderSettings settings;
  std::vector<PictureObject> objects;

  Subject() {
    for (std::size_t n = 0; n < surface.atoms.size(); ++n) {
      coloring.atom.push_back(n % 2 ? glm::vec3(0.8f, 0.25f, 0.2f) : glm::vec3(0.3f, 0.5f, 0.9f));
      coloring.part.push_back(static_cast<std::uint32_t>(n / 200));
    }
    settings.size = {230, 330};  // The sides are no whole numbers of tiles.
    settings.samples = 2;
    objects.emplace_back();
    objects[0].surface = &surface;
    objects[0].coloring = &coloring;
  }
  Subject(const Subject&) = delete;
  Subject& operator=(const Subject&) = delete;

  Framebuffer whole(bool aovs) const {
    RenderSettings all = settings;
    all.aovs = aovs;
    return CpuRenderer().render(objects, camera, all);
  }
};

Look drawing() {
  Look look;
  look.ambient_occlusion = 0.9f;
  look.silhouettes = 3.0f;
  look.depth_cue = 0.5f;
  return look;
}

void append(auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); }

/// Puts bands of 48 rows together again.
struct Gathered {
  Framebuffer picture;
  int bands = 0;

  void ask(RenderSettings& settings) {
    settings.block_edge = 48;
    settings.take_band = [this](const Framebuffer& band, int first_row) {
      EXPECT_EQ(first_row, picture.size.y);
      EXPECT_EQ(band.color.size(), static_cast<std::size_t>(band.size.x) * band.size.y);
      picture.size = {band.size.x, picture.size.y + band.size.y};
      append(picture.color, band.color);
      append(picture.z, band.z);
      append(picture.normal, band.normal);
      append(picture.position, band.position);
      append(picture.atom, band.atom);
      append(picture.kind, band.kind);
      append(picture.component, band.component);
      append(picture.object, band.object);
      ++bands;
    };
  }
};

void expect_same_bits(const Framebuffer& a, const Framebuffer& b, const std::string& name) {
  EXPECT_EQ(a.size, b.size) << name;
  EXPECT_EQ(a.color, b.color) << name;
  EXPECT_EQ(a.z, b.z) << name;
  EXPECT_EQ(a.normal, b.normal) << name;
  EXPECT_EQ(a.position, b.position) << name;
  EXPECT_EQ(a.atom, b.atom) << name;
  EXPECT_EQ(a.kind, b.kind) << name;
  EXPECT_EQ(a.component, b.component) << name;
  EXPECT_EQ(a.object, b.object) << name;
}

void expect_same_in_bands(const Subject& subject, const std::string& name) {
  for (const bool aovs : {false, true}) {
    const Framebuffer whole = subject.whole(aovs);
    RenderSettings settings = subject.settings;
    settings.aovs = aovs;
    Gathered gathered;
    gathered.ask(settings);
    const Framebuffer rest = CpuRenderer().render(subject.objects, subject.camera, settings);
    EXPECT_EQ(rest.size, settings.size) << name;
    EXPECT_TRUE(rest.color.empty() && rest.z.empty()) << name;
    EXPECT_EQ(gathered.bands, 7) << name;
    expect_same_bits(whole, gathered.picture, name);
  }
}

TEST(Bands, MakeTheWholePicture) {
  Subject subject;
  expect_same_in_bands(subject, "plain");
  subject.settings.look = drawing();
  expect_same_in_bands(subject, "shade, lines and air");
  subject.coloring.opacity.assign(subject.surface.atoms.size(), 0.4f);
  expect_same_in_bands(subject, "seen through");
  subject.objects[0].clip.push_back(clip_plane(parse_cut("depth>0.4"), subject.camera, subject.surface.atoms));
  expect_same_in_bands(subject, "seen through and cut");
  subject.coloring.opacity.clear();
  subject.objects.push_back(subject.objects[0]);
  subject.objects[1].clip = {clip_plane(parse_cut("depth<0.4"), subject.camera, subject.surface.atoms)};
  expect_same_in_bands(subject, "two objects, both cut");
}

TEST(Bands, OfCopiesMakeTheWholePicture) {
  Subject subject;
  subject.settings.look = drawing();
  std::vector<SurfaceObject> objects(1);
  objects[0].surface = subject.surface;
  objects[0].coloring = subject.coloring;
  objects[0].copies.resize(3);
  for (std::size_t n = 0; n < 3; ++n) objects[0].copies[n].translation = glm::dvec3(0.0, 30.0 * n, 5.0 * n);
  const Camera camera = frame_camera(placed_balls(objects), 230.0 / 330.0);
  RenderSettings settings = subject.settings;
  settings.aovs = true;
  const Framebuffer whole = CpuRenderer().render_copies(objects, camera, settings);
  Gathered gathered;
  gathered.ask(settings);
  CpuRenderer().render_copies(objects, camera, settings);
  EXPECT_EQ(gathered.bands, 7);
  expect_same_bits(whole, gathered.picture, "copies");
}

// Wide pictures have lower bands, so that they take as much memory.
TEST(Bands, AreLowerTheWiderThePictureIs) {
  Subject subject;
  subject.settings.samples = 1;
  subject.settings.size = {20000, 40};
  subject.settings.aovs = true;
  int highest = 0;
  subject.settings.take_band = [&](const Framebuffer& band, int) { highest = std::max(highest, band.size.y); };
  CpuRenderer().render(subject.objects, subject.camera, subject.settings);
  EXPECT_EQ(highest, 40);
  subject.settings.size = {300000, 40};
  highest = 0;
  const Surface ball = compute_surface_cpu(testing::Balls{{{0, 0, 0}, 1.7}}, 1.4);
  const Coloring gray{.atom = {glm::vec3(0.5f)}};
  CpuRenderer().render(whole_surface(ball, gray), frame_camera(ball.atoms, 7500.0), subject.settings);
  EXPECT_EQ(highest, 16);
}

ColorKey chains() {
  ColorKey key{"chain", {}, {}};
  for (const char* const name : {"A", "B", "C"}) key.classes.push_back({name, glm::vec3(0.0f, 1.0f, 0.0f)});
  return key;
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

class BandFile : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("meniscus_bands_" + std::to_string(::getpid()));
};

TEST_F(BandFile, IsThatOfTheWholePictureWithAllThatIsWrittenIntoIt) {
  Subject subject;
  subject.settings.look = drawing();
  Annotations annotations;
  annotations.panel = "B";
  annotations.time = "3 ns";
  annotations.scale_bar = true;
  for (const std::size_t atom : {5u, 100u, 300u, 500u})
    annotations.labels.push_back({"Atom " + std::to_string(atom), subject.surface.atoms[atom].center});
  annotations.curve = Curve{"area", {1.0, 3.0, 2.0, 5.0}, 2};
  for (const auto place : {LegendStyle::Place::right, LegendStyle::Place::below})
    for (const char* const name : {"a.png", "a.tif", "a.exr", "a.jpg", "a.webp"}) {
      SCOPED_TRACE(std::string(name) + (place == LegendStyle::Place::right ? " right" : " below"));
      const std::optional<Legend> legend(std::in_place, chains(), glm::ivec2(420, 330), LegendStyle{{}, {}, place});
      RenderSettings settings = subject.settings;
      settings.samples = 1;
      settings.size = legend->molecule_size();
      settings.aovs = holds_aovs(name);
      Framebuffer whole = CpuRenderer().render(subject.objects, subject.camera, settings);
      annotate(whole, annotations, subject.camera, {});
      // The molecule is in the upper left corner of the file, whose header leads to it.
      const glm::dvec2 molecule(settings.size), share = molecule / glm::dvec2(legend->picture_size());
      const glm::dmat4 into_file({share.x, 0, 0, 0}, {0, share.y, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1});
      ImageSettings image;
      image.exr.view = ViewMatrices{world_to_camera(subject.camera),
                                    into_file * world_to_picture(subject.camera, molecule.x / molecule.y)};
      write_image(folder_ / name, legend->add_to(whole, {}), image);
      const std::string expected = bytes_of(folder_ / name);
      settings.block_edge = 48;
      PictureFile file(folder_ / (std::string("b") + name), {annotations, legend}, subject.camera, {}, settings);
      CpuRenderer().render(subject.objects, subject.camera, settings);
      file.commit();
      EXPECT_TRUE(file.shows_something());
      EXPECT_FALSE(expected.empty());
      EXPECT_TRUE(expected == bytes_of(folder_ / (std::string("b") + name)));
      std::filesystem::remove(folder_ / name);
      std::filesystem::remove(folder_ / (std::string("b") + name));
    }
}

/// Returns whether the pixels' chunks are a stream of so many bytes with their checksum, which readers of PNG ignore.
bool is_whole_stream(const std::vector<std::uint8_t>& png, std::size_t size) {
  std::vector<std::uint8_t> stream, rows(size);
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const std::size_t length = png[at] << 24 | png[at + 1] << 16 | png[at + 2] << 8 | png[at + 3];
    const auto content = png.begin() + static_cast<std::ptrdiff_t>(at + 8);
    if (std::string(content - 4, content) == "IDAT")
      stream.insert(stream.end(), content, content + static_cast<std::ptrdiff_t>(length));
    at += length + 12;
  }
  uLongf filled = size;
  return ::uncompress(rows.data(), &filled, stream.data(), stream.size()) == Z_OK && filled == size;
}

TEST_F(BandFile, OfALargePngIsCompressedInPieces) {
  ImageToEncode image;
  image.format = "png";
  image.width = 3000;
  image.height = 2000;
  image.channels = {"R", "G", "B"};
  image.color_space = "sRGB";
  std::vector<std::uint8_t> pixels(std::size_t{3} * 3000 * 2000);
  std::uint32_t noise = 1;
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    noise = noise * 1664525u + 1013904223u;
    pixels[n] = static_cast<std::uint8_t>(n / 3 % 3000 / 12 + (n / 9000 % 16 == 0 ? noise >> 30 : 0));
  }
  const std::vector<std::uint8_t> whole = encode_png(image, pixels, 3);
  const auto in_pieces = [&](std::size_t rows) {
    std::vector<std::uint8_t> file;
    PngEncoder encoder(
        image, [&](std::span<const std::uint8_t> bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); }, 0);
    const std::size_t step = 3 * 3000 * rows;
    for (std::size_t first = 0; first < pixels.size(); first += step)
      encoder.add(std::span(pixels).subspan(first, std::min(step, pixels.size() - first)), 3);
    encoder.finish();
    return file;
  };
  const std::vector<std::uint8_t> file = in_pieces(128);
  EXPECT_EQ(file, in_pieces(2000)) << "whatever rows come at once";
  EXPECT_LT(file.size(), whole.size() + whole.size() / 4);
  EXPECT_TRUE(is_whole_stream(file, (3 * 3000 + 1) * std::size_t{2000}));
  std::ofstream(folder_ / "p.png", std::ios::binary)
      .write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
  const DecodedImage decoded = image_codec().decode((folder_ / "p.png").string());
  ASSERT_EQ(decoded.values.size(), pixels.size());
  std::size_t wrong = 0;
  for (std::size_t n = 0; n < pixels.size(); ++n)
    wrong += std::lround(255.0f * decoded.values[n]) != static_cast<long>(pixels[n]);
  EXPECT_EQ(wrong, 0u);
}

// The second write may be within one second, which is as fine as some caches look at a file's time.
TEST_F(BandFile, APictureThatIsWrittenAgainIsReadAgain) {
  for (const int size : {16, 64, 8}) {
    ImageToEncode image;
    image.format = "png";
    image.width = image.height = size;
    image.channels = {"R", "G", "B"};
    const std::vector<std::uint8_t> file = encode_png(
        image, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * size * size), static_cast<std::uint8_t>(size)),
        3);
    std::ofstream(folder_ / "p.png", std::ios::binary)
        .write(reinterpret_cast<const char*>(file.data()), static_cast<std::streamsize>(file.size()));
    const DecodedImage decoded = image_codec().decode((folder_ / "p.png").string());
    ASSERT_EQ(decoded.width, size);
    EXPECT_EQ(std::lround(255.0f * decoded.values.at(0)), size);
  }
}

}  // namespace
}  // namespace meniscus
