// SPDX-License-Identifier: BSD-3-Clause
// An incomplete film is detected wherever it ends and whichever part it lacks.
#include "app/film/film.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/run_program.h"

namespace meniscus {
namespace {

namespace fs = std::filesystem;
using test::read_bytes;
using test::TemporaryFolder;

constexpr int kPictures = 5;

class Film : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    constexpr glm::ivec2 kSize{32, 24};
    FilmWriter film(path_.string(), Existing::refuse, kSize, 25.0);
    std::vector<std::uint8_t> picture(std::size_t{3} * kSize.x * kSize.y);
    for (int n = 0; n < kPictures; ++n) {
      for (std::size_t at = 0; at < picture.size(); ++at) picture[at] = static_cast<std::uint8_t>(at * (n + 7));
      film.add(picture);
    }
    film.finish();
  }

  TemporaryFolder folder_;
  fs::path path_ = folder_.path() / (std::string("film.") + GetParam());
};

TEST_P(Film, IsWhole) {
  EXPECT_EQ(film_fault(path_, kPictures), "");
  EXPECT_EQ(film_fault(path_, kPictures + 1), "holds 5 of 6 pictures");
}

TEST_P(Film, CutAnywhereIsBroken) {
  for (auto size = fs::file_size(path_); size-- > 0;) {
    fs::resize_file(path_, size);
    ASSERT_NE(film_fault(path_, kPictures), "") << size;
  }
}

TEST_P(Film, MoreThanAFilmIsBroken) {
  folder_.file(path_.filename().string(), read_bytes(path_) + "tail");
  EXPECT_NE(film_fault(path_, kPictures), "");
}

INSTANTIATE_TEST_SUITE_P(Containers, Film, testing::Values("mp4", "mov", "mkv", "webm", "gif"),
                         [](const auto& film) { return std::string(film.param); });

// Matroska is written from front to back; its size and the cues come last.
TEST(FilmCheck, MatroskaThatWasNotFinished) {
  const TemporaryFolder folder;
  const std::string header("\x1a\x45\xdf\xa3\x80", 5),
      open_segment("\x18\x53\x80\x67\x01\xff\xff\xff\xff\xff\xff\xff", 12);
  EXPECT_EQ(film_fault(folder.file("open.mkv", header + open_segment), 0),
            "was not finished: the size at byte 9 is left open");
  const std::string empty_segment("\x18\x53\x80\x67\x80", 5);
  EXPECT_EQ(film_fault(folder.file("empty.mkv", header + empty_segment), 0), "has no cues");
}

TEST(FilmCheck, WhatIsNoFilm) {
  const TemporaryFolder folder;
  EXPECT_NE(film_fault(folder.file("a.mp4", "this is not a film, but it is long enough"), 0), "");
  EXPECT_NE(film_fault(folder.file("b.mp4", ""), 0), "");
  EXPECT_NE(film_fault(folder.path() / "missing.mkv", 0), "");
}

}  // namespace
}  // namespace meniscus
