// SPDX-License-Identifier: BSD-3-Clause
// Films have the requested format, which ffprobe reports, and their colours come back.
#include "app/film/film.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "app/process/program_main.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using test::ProgramResult;
using test::read_bytes;
using test::run_program;
using test::TemporaryFolder;

constexpr glm::ivec2 kSize{1024, 120};
constexpr int kPictures = 4;

/// Returns a grey ramp in the upper half, three colours in the lower one, less opaque to the right; in [0, 1].
glm::vec4 shown_at(int x, int y) {
  const float along = static_cast<float>(x) / static_cast<float>(kSize.x - 1);
  if (y < kSize.y / 2) return {along, along, along, 1.0f - along};
  const int patch = 3 * x / kSize.x;
  const glm::vec3 colors[]{{0.8f, 0.2f, 0.2f}, {0.2f, 0.7f, 0.3f}, {0.2f, 0.3f, 0.8f}};
  return {colors[patch], 1.0f - along};
}

std::vector<std::uint8_t> picture(const FilmPixels& pixels) {
  std::vector<std::uint8_t> bytes;
  for (int y = 0; y < kSize.y; ++y) {
    for (int x = 0; x < kSize.x; ++x) {
      for (int c = 0; c < pixels.channels; ++c) {
        const auto word =
            static_cast<unsigned>(std::lround(shown_at(x, y)[c] * (pixels.bytes == 2 ? 65535.0f : 255.0f)));
        bytes.push_back(static_cast<std::uint8_t>(word & 0xff));
        if (pixels.bytes == 2) bytes.push_back(static_cast<std::uint8_t>(word >> 8));
      }
    }
  }
  return bytes;
}

void write_film(const std::string& path, const FilmFormat& format) {
  FilmWriter film(path, Existing::refuse, kSize, 25.0, format);
  for (int n = 0; n < kPictures; ++n) film.add(picture(film.pixels()));
  film.finish();
}

/// Reads the first picture: red, green, blue, alpha in [0, 1]. decoder: of ffmpeg, whose own leaves out alpha of VP9.
std::vector<glm::vec4> first_picture(const std::string& path, const std::string& decoder = "") {
  const std::string raw = path + ".raw";
  std::vector<std::string> words{"-loglevel", "error"};
  if (!decoder.empty()) words.insert(words.end(), {"-c:v", decoder});
  words.insert(words.end(),
               {"-i", path, "-frames:v", "1", "-vf", "scale=in_color_matrix=bt709:flags=accurate_rnd+full_chroma_int",
                "-pix_fmt", "rgba64le", "-f", "rawvideo", raw});
  const ProgramResult result = run_program("/usr/bin/ffmpeg", words);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  const std::string bytes = read_bytes(raw);
  std::vector<glm::vec4> pixels(bytes.size() / 8);
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    for (int c = 0; c < 4; ++c) {
      const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(bytes[8 * n + 2 * c + at]); };
      pixels[n][c] = static_cast<float>(byte(0) + 256 * byte(1)) / 65535.0f;
    }
  }
  return pixels;
}

struct FilmCase {
  std::string name, ending;
  FilmFormat format;
  std::string codec, pixels;  // names in ffprobe
};

class FilmFormats : public ::testing::TestWithParam<FilmCase> {};

TEST_P(FilmFormats, AreWhatWasAskedFor) {
  const FilmCase& film = GetParam();
  const TemporaryFolder folder;
  const std::string path = (folder.path() / ("film" + film.ending)).string();
  const std::string again = (folder.path() / ("again" + film.ending)).string();
  write_film(path, film.format);
  write_film(again, film.format);
  EXPECT_TRUE(read_bytes(path) == read_bytes(again)) << "equal pictures make equal films";
  EXPECT_EQ(film_fault(path, kPictures), "");
  const ProgramResult probe =
      run_program("/usr/bin/ffprobe",
                  {"-v", "error", "-count_frames", "-show_entries",
                   "stream=codec_name,width,height,pix_fmt,r_frame_rate,nb_read_frames", "-of", "csv=p=0", path});
  EXPECT_EQ(probe.out, film.codec + ",1024,120," + film.pixels + ",25/1,4\n") << probe.err;

  const std::vector<glm::vec4> pixels = first_picture(path);
  ASSERT_EQ(pixels.size(), static_cast<std::size_t>(kSize.x * kSize.y));
  const bool palette = film.codec == "gif";
  std::set<long> greys;
  float worst = 0.0f, worst_alpha = 0.0f;
  for (int x = 8; x < kSize.x - 8; ++x) {
    for (const int y : {30, 90}) {
      const glm::vec4 found = pixels[y * kSize.x + x], asked = shown_at(x, y);
      if (y == 30) greys.insert(std::lround(found.y * 65535.0f));
      const bool at_edge = y == 90 && std::min(std::abs(x - 341), std::abs(x - 683)) < 16;
      if (!at_edge)
        for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(found[c] - asked[c]));
      worst_alpha = std::max(worst_alpha, std::abs(found.w - asked.w));
    }
  }
  EXPECT_LT(worst, palette ? 0.1f : 0.03f);
  const bool fine = film.pixels.ends_with("le");
  if (!palette) {
    EXPECT_EQ(greys.size() > 300, fine) << greys.size() << " greys of a ramp of 1,024";
  }
  if (film.format.codec == "prores4444") {
    EXPECT_LT(worst_alpha, 0.004f);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Of, FilmFormats,
    testing::Values(FilmCase{"mp4", ".mp4", {}, "h264", "yuv420p"}, FilmCase{"mov", ".mov", {}, "h264", "yuv420p"},
                    FilmCase{"webm", ".webm", {}, "vp9", "yuv420p"}, FilmCase{"gif", ".gif", {}, "gif", "bgra"},
                    FilmCase{"h264_10_444", ".mkv", {"h264", 12, 10, 444}, "h264", "yuv444p10le"},
                    FilmCase{"h265_10", ".mp4", {"h265", {}, 10, 0}, "hevc", "yuv420p10le"},
                    FilmCase{"vp9_10_422", ".mkv", {"vp9", {}, 10, 422}, "vp9", "yuv422p10le"},
                    FilmCase{"prores", ".mov", {"prores", {}, 0, 0}, "prores", "yuv422p10le"},
                    FilmCase{"prores4444", ".mov", {"prores4444", {}, 0, 0}, "prores", "yuva444p12le"},
                    FilmCase{"dnxhr", ".mov", {"dnxhr", {}, 0, 0}, "dnxhd", "yuv422p"},
                    FilmCase{"dnxhr_10", ".mov", {"dnxhr", {}, 10, 0}, "dnxhd", "yuv422p10le"}),
    [](const auto& film) { return film.param.name; });

TEST(FilmFormats, TransparencyIsKeptIfAskedFor) {
  const TemporaryFolder folder;
  FilmFormat format;
  format.transparent = true;
  const struct {
    const char *ending, *decoder;
    float error;
  } films[] = {
      {".webm", "libvpx-vp9", 0.02f}, {".mkv", "libvpx-vp9", 0.02f}, {".mov", "", 0.004f}, {".gif", "", 0.51f}};
  for (const auto& [ending, decoder, error] : films) {
    const std::string path = (folder.path() / ("film" + std::string(ending))).string();
    write_film(path, format);
    EXPECT_EQ(film_fault(path, kPictures), "") << ending;
    const std::vector<glm::vec4> pixels = first_picture(path, decoder);
    ASSERT_EQ(pixels.size(), static_cast<std::size_t>(kSize.x * kSize.y)) << ending;
    float worst = 0.0f;
    for (int x = 8; x < kSize.x - 8; ++x)
      worst = std::max(worst, std::abs(pixels[30 * kSize.x + x].w - shown_at(x, 30).w));
    EXPECT_LT(worst, error) << ending;
  }
}

TEST(FilmFormats, RefusedAreToldWhatFits) {
  const auto fault = [](const std::string& path, const FilmFormat& format) {
    try {
      film_encoder(path, format);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(fault("a.mp4", {"prores", {}, 0, 0}), "--codec prores: .mp4 films hold h264, h265");
  EXPECT_EQ(fault("a.webm", {"h264", {}, 0, 0}), "--codec h264: .webm films hold vp9");
  EXPECT_EQ(fault("a.mov", {"prores", {}, 8, 0}), "--bits 8: prores has 10");
  EXPECT_EQ(fault("a.gif", {"", {}, 0, 420}), "--chroma 420: gif has 444");
  EXPECT_EQ(fault("a.mov", {"prores", 3, 0, 0}), "--crf 3: prores has no rate factor");
  EXPECT_EQ(fault("a.gif", {"", 3, 0, 0}), "--crf 3: gif has no rate factor");
  EXPECT_EQ(fault("a.mp4", {"", 52, 0, 0}), "--crf 52: for h264 give 0 (best) to 51");
  EXPECT_EQ(fault("a.mp4", {"", -1, 0, 0}), "--crf -1: for h264 give 0 (best) to 51");
  EXPECT_EQ(fault("a.mov", {"dnxhr", {}, 0, 444}), "--chroma 444: dnxhr has it with --bits 10 only");
  const std::string opaque = fault("a.mp4", {"", {}, 0, 0, 25.0, true});
  EXPECT_NE(opaque.find("a .mp4 film keeps no transparency"), std::string::npos) << opaque;
  EXPECT_NE(fault("a.mov", {"h264", {}, 0, 0, 25.0, true}).find("h264 keeps no transparency"), std::string::npos);
  EXPECT_EQ(fault("a.webm", {"", {}, 10, 0, 25.0, true}), "--bits 10: vp9 has 8");
  EXPECT_EQ(fault("a.webm", {"", {}, 0, 0}), "");
  const FilmEncoder odd = film_encoder("a.mp4", {"", {}, 0, 444});
  EXPECT_NO_THROW(check_film_size(odd, {63, 47}));
  EXPECT_THROW(check_film_size(film_encoder("a.mp4", {}), {64, 47}), UsageError);
  EXPECT_THROW(check_film_size(film_encoder("a.mov", {"dnxhr", {}, 0, 0}), {240, 160}), UsageError);
  EXPECT_NO_THROW(check_film_size(film_encoder("a.mov", {"prores", {}, 0, 0}), {64, 47}));
}

}  // namespace
}  // namespace meniscus
