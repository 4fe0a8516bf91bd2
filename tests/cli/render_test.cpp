// SPDX-License-Identifier: BSD-3-Clause
// `meniscus render` for users: files, cameras, and errors.
#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>

#include "tests/support/run_program.h"

namespace meniscus {
namespace {

using test::ProgramResult;
using test::TemporaryFolder;

constexpr const char* kTwoAtoms = "0 0 0 1.7\n2.5 0.3 0.1 1.5\n";

class RenderCommand : public ::testing::Test {
 protected:
  ProgramResult render(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"render", molecule_, "--size", "40x30"});
    // Pictures are compared by their bytes, so they lack the options that made them.
    if (std::ranges::find(arguments, "--provenance") == arguments.end()) arguments.emplace_back("--no-provenance");
    return test::run_program(test::meniscus_program(), arguments);
  }
  std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  TemporaryFolder folder_;
  std::string molecule_ = folder_.file("two.xyzr", kTwoAtoms);
};

TEST_F(RenderCommand, WritesEveryFormatAndNamesTheDevice) {
  for (const char* name : {"a.png", "a.jpg", "a.webp", "a.tif", "a.exr"}) {
    const ProgramResult result = render({"-o", path(name), "--verbose"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find("picture on "), std::string::npos) << result.err;
    EXPECT_GT(test::read_bytes(path(name)).size(), 500u);
  }
  EXPECT_EQ(render({"-o", path("b.exr"), "--aovs", "-q"}).err, "");
  EXPECT_GT(test::read_bytes(path("b.exr")).size(), test::read_bytes(path("a.exr")).size());
}

TEST_F(RenderCommand, TellsHowFarALongPictureIs) {
  const std::string far_apart = folder_.file("far.xyzr", "0 0 0 1.7\n400 0 0 1.7\n");
  const std::vector<std::string> many_rays{"--size", "2400x1800", "--samples", "105", "--device", "cpu"};
  const auto told = [&](std::vector<std::string> words) {
    words.insert(words.end(), many_rays.begin(), many_rays.end());
    words.insert(words.begin(), {"render", far_apart});
    const ProgramResult result = test::run_program(test::meniscus_program(), words);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  };
  const std::string err = told({"-o", path("told.png")});
  for (const char* part : {"picture: 0 of 100 (0 %)\n", "picture: 100 of 100 (100 %)\n"})
    EXPECT_NE(err.find(part), std::string::npos) << err;
  EXPECT_GT(std::ranges::count(err, '%'), 5) << err;
  EXPECT_EQ(told({"-o", path("quiet.png"), "-q"}), "");
  EXPECT_EQ(render({"-o", path("short.png")}).err.find(" of 100 "), std::string::npos);
}

TEST_F(RenderCommand, ASavedCameraTakesTheSamePicture) {
  for (const char* projection : {"perspective", "orthographic"}) {
    const std::string camera = path(std::string(projection) + ".json");
    EXPECT_EQ(render({"-o", path("a.png"), "--force", "--projection", projection, "--save-camera", camera}).exit_code,
              0);
    EXPECT_EQ(render({"-o", path("b.png"), "--force", "--camera", camera}).exit_code, 0);
    EXPECT_EQ(test::read_bytes(path("a.png")), test::read_bytes(path("b.png")));
  }
}

TEST_F(RenderCommand, FiguresAreChecked) {
  for (const auto& [option, value, why] : {std::tuple{"--clip", "x=3", "there is no < or >"},
                                           {"--clip", "q<3", "three numbers"},
                                           {"--clip", "x<1<2", "one number"},
                                           {"--cap-color", "crimsonish", "neither atom nor a colour"},
                                           {"--cap-hatching", "-1", "--cap-hatching"},
                                           {"--opacity", "2", "--opacity"},
                                           {"--sticks", "resid", "--sticks"},
                                           {"--stick-radius", "0", "--stick-radius"}}) {
    const ProgramResult result = render({"-o", path("c.png"), option, value});
    EXPECT_EQ(result.exit_code, 2) << option << " " << value;
    EXPECT_NE(result.err.find(option), std::string::npos) << result.err;
    EXPECT_NE(result.err.find(why), std::string::npos) << result.err;
  }
  for (const char* option : {"--clip=x<3", "--opacity=0.5", "--film-opacity", "--sticks=all"}) {
    const ProgramResult result = render({"-o", path("c.png"), "--extent", "visible", "--device", "software", option});
    EXPECT_EQ(result.exit_code, 2) << option;
    EXPECT_NE(result.err.find("leave out --extent"), std::string::npos) << result.err;
  }
  EXPECT_FALSE(std::filesystem::exists(path("c.png")));
}

TEST_F(RenderCommand, FiguresAreOtherPicturesOfTheSameSize) {
  std::set<std::string> pictures;
  const std::vector<std::vector<std::string>> figures{{},
                                                      {"--clip", "depth>0.5"},
                                                      {"--clip", "x<1", "--cap-color", "#ff0000"},
                                                      {"--opacity", "0.4"},
                                                      {"--opacity", "0.4", "--film-opacity"},
                                                      {"--opacity", "0.4", "--spheres", "all"}};
  for (const std::vector<std::string>& figure : figures) {
    std::vector<std::string> arguments{"-o", path("f.png"), "--force"};
    arguments.insert(arguments.end(), figure.begin(), figure.end());
    const ProgramResult result = render(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    pictures.insert(test::read_bytes(path("f.png")));
  }
  EXPECT_EQ(pictures.size(), figures.size());
}

TEST_F(RenderCommand, OpacityIsOfTheSurfaceAndNotOfWhatStandsBesideIt) {
  const std::string nothing = "the picture shows nothing";
  EXPECT_NE(render({"-o", path("a.png"), "--opacity", "0"}).err.find(nothing), std::string::npos);
  const ProgramResult beside = render({"-o", path("b.png"), "--opacity", "0", "--spheres", "all"});
  EXPECT_EQ(beside.exit_code, 0) << beside.err;
  EXPECT_EQ(beside.err.find(nothing), std::string::npos) << beside.err;
}

TEST_F(RenderCommand, LooksAreChecked) {
  for (const auto& [option, value] : {std::pair{"--light", "0,0,0"},
                                      {"--light", "1,2"},
                                      {"--light", "1,nan,2"},
                                      {"--light-strength", "-1"},
                                      {"--ambient-occlusion", "1.5"},
                                      {"--ambient-occlusion-radius", "0"},
                                      {"--silhouettes", "17"},
                                      {"--silhouettes", "1furlong"},
                                      {"--silhouettes", "6pt"},
                                      {"--legend-size", "1pt"},
                                      {"--outer-lines", "-1"},
                                      {"--shininess", "0"},
                                      {"--preset", "pretty"},
                                      {"--depth-cue", "x"}}) {
    const ProgramResult result = render({"-o", path("c.png"), option, value});
    EXPECT_EQ(result.exit_code, 2) << option << " " << value;
    EXPECT_NE(result.err.find(option), std::string::npos) << result.err;
  }
  // A point is a 72nd of an inch.
  EXPECT_EQ(render({"-o", path("pt.png"), "--silhouettes", "1.5pt", "--dpi", "144"}).exit_code, 0);
  EXPECT_EQ(render({"-o", path("px.png"), "--silhouettes", "3", "--dpi", "144"}).exit_code, 0);
  EXPECT_EQ(test::read_bytes(path("pt.png")), test::read_bytes(path("px.png")));
  // Without shade, its radius has no effect.
  EXPECT_EQ(render({"-o", path("a.png"), "--ambient-occlusion", "0"}).exit_code, 0);
  EXPECT_EQ(render({"-o", path("b.png"), "--ambient-occlusion-radius", "3", "--ambient-occlusion", "0"}).exit_code, 0);
  EXPECT_EQ(test::read_bytes(path("a.png")), test::read_bytes(path("b.png")));
}

TEST_F(RenderCommand, OptionsChangeThePicture) {
  EXPECT_EQ(render({"-o", path("a.png")}).exit_code, 0);
  const std::vector<std::vector<std::string>> changes{
      {"--color", "kind"},    {"--background", "#204060"}, {"--samples", "1"},           {"--probe", "0.5"},
      {"--light", "1,0,0.5"}, {"--light-strength", "2"},   {"--ambient-occlusion", "0"}, {"--silhouettes", "2"},
      {"--depth-cue", "0.5"}, {"--ambient", "0.2"},        {"--roughness", "1"},         {"--specular", "0.8"},
      {"--shininess", "3"},   {"--outer-lines", "4"},      {"--linear-alpha"},           {"--preset", "flat"},
      {"--preset", "classic"}};
  for (const auto& change : changes) {
    std::vector<std::string> arguments{"-o", path("b.png"), "--force"};
    arguments.insert(arguments.end(), change.begin(), change.end());
    EXPECT_EQ(render(arguments).exit_code, 0);
    EXPECT_NE(test::read_bytes(path("a.png")), test::read_bytes(path("b.png"))) << change[0];
  }
}

TEST_F(RenderCommand, OptionsChangeAPresetWhateverTheirOrder) {
  EXPECT_EQ(render({"-o", path("a.png"), "--preset", "flat", "--silhouettes", "3", "--ambient", "0.5"}).exit_code, 0);
  EXPECT_EQ(render({"-o", path("b.png"), "--ambient", "0.5", "--silhouettes", "3", "--preset", "flat"}).exit_code, 0);
  EXPECT_EQ(test::read_bytes(path("a.png")), test::read_bytes(path("b.png")));
  EXPECT_EQ(render({"-o", path("c.png"), "--preset", "flat"}).exit_code, 0);
  EXPECT_NE(test::read_bytes(path("a.png")), test::read_bytes(path("c.png")));
  EXPECT_EQ(render({"-o", path("d.png")}).exit_code, 0);
  EXPECT_EQ(render({"-o", path("e.png"), "--preset", "publication", "--samples", "9"}).exit_code, 0);
  EXPECT_EQ(test::read_bytes(path("d.png")), test::read_bytes(path("e.png"))) << "what is not asked for";
}

TEST_F(RenderCommand, WhatAViewNeedsMakesTheSamePicture) {
  for (const char* projection : {"perspective", "orthographic"}) {
    EXPECT_EQ(render({"-o", path("a.png"), "--force", "--projection", projection, "--device", "software"}).exit_code,
              0);
    for (const char* extent : {"visible", "complete"}) {
      const ProgramResult result =
          render({"-o", path("b.png"), "--force", "--projection", projection, "--extent", extent});
      EXPECT_EQ(result.exit_code, 0) << result.err;
      EXPECT_EQ(test::read_bytes(path("a.png")), test::read_bytes(path("b.png"))) << extent;
    }
  }
  const ProgramResult result = render({"-o", path("c.png"), "--extent", "paper", "--stats"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("1 visible atoms"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("2 of 2 atoms"), std::string::npos) << result.err;
}

TEST_F(RenderCommand, PatchesAreOutlinedInPicturesAndViews) {
  const auto picture = [&](std::vector<std::string> options) {
    options.insert(options.end(), {"-o", path("a.png"), "--force"});
    const ProgramResult result = render(options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return test::read_bytes(path("a.png"));
  };
  const std::string plain = picture({}), outlined = picture({"--patches", "index 1"});
  EXPECT_NE(outlined, plain);
  EXPECT_EQ(picture({"--patches", "index 1", "--min-patch", "9999"}), plain);
  EXPECT_EQ(picture({"--patches", "all"}), plain) << "they have no border";
  EXPECT_EQ(picture({"--patches", "index 1", "--patch-lines", "0"}), plain);
  EXPECT_NE(picture({"--patches", "index 1", "--patch-line-color", "red"}), outlined);
  EXPECT_NE(picture({"--patches", "index 1", "--opacity", "0.5"}), picture({"--opacity", "0.5"}));
  const std::vector<std::string> on_gl{"--patches", "index 1", "--min-patch", "0", "--device", "software"};
  std::vector<std::string> view = on_gl;
  view.insert(view.end(), {"--extent", "visible"});
  EXPECT_EQ(picture(on_gl), picture(view));
  EXPECT_EQ(render({"-o", path("b.png"), "--patches", "element Zn"}).exit_code, 2);
}

TEST_F(RenderCommand, AViewRefusesWhatOnlyACompleteSurfaceKnows) {
  const std::vector<std::vector<std::string>> needs{
      {"--by", "chain"},        {"--by", "component"}, {"--cavities", "drop"},   {"--verify"},
      {"--color", "component"}, {"--surface", "sas"},  {"--patches", "index 1"}, {"--aovs", "-o", "a.exr"}};
  for (const auto& need : needs) {
    std::vector<std::string> arguments{"--extent", "visible"};
    arguments.insert(arguments.end(), need.begin(), need.end());
    if (need.size() < 3) arguments.insert(arguments.end(), {"-o", path("a.png")});
    const ProgramResult result = render(arguments);
    EXPECT_EQ(result.exit_code, 2) << need[0];
    EXPECT_NE(result.err.find(need[0]), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("complete surface"), std::string::npos) << result.err;
  }
  EXPECT_EQ(render({"-o", path("a.png"), "--extent", "some"}).exit_code, 2);
  EXPECT_EQ(render({"-o", path("a.png"), "--extent", "visible", "--device", "cpu"}).exit_code, 2);
  EXPECT_EQ(render({"-o", path("a.png"), "--stats"}).exit_code, 2);
}

TEST_F(RenderCommand, KeepsWhatExists) {
  const std::string existing = folder_.file("a.png", "precious");
  EXPECT_EQ(render({"-o", existing}).exit_code, 6);
  EXPECT_EQ(test::read_bytes(existing), "precious");
  const std::string camera = folder_.file("c.json", "precious");
  EXPECT_EQ(render({"-o", path("b.png"), "--save-camera", camera}).exit_code, 6);
  EXPECT_EQ(test::read_bytes(camera), "precious");
  EXPECT_EQ(folder_.entries(), (std::vector<std::string>{"a.png", "c.json", "two.xyzr"}));
  EXPECT_EQ(render({"-o", existing, "--force"}).exit_code, 0);
  EXPECT_NE(test::read_bytes(existing), "precious");
}

TEST_F(RenderCommand, RefusesWithTheRightExitCode) {
  const std::string camera = folder_.file("bad.json", "{\"position\":[0,0,0]");
  const std::vector<std::pair<int, std::vector<std::string>>> cases{
      {2, {"-o", path("a.png"), "--aovs"}},
      {2, {"-o", path("a.png"), "--background", "plaid"}},
      {2, {"-o", path("a.png"), "--samples", "0"}},
      {2, {"-o", path("a.png"), "--size", "0x5"}},
      {3, {"-o", path("a.png"), "--camera", camera}},
      {3, {"-o", path("a.png"), "--camera", path("missing.json")}},
      {4, {"-o", path("a.png"), "--device", "gpu:77"}},
      {2, {"-o", path("a.gif")}},
      {6, {"-o", path("none/a.png")}}};
  for (const auto& [code, arguments] : cases) {
    const ProgramResult result = render(arguments);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_NE(result.err.find("meniscus: error: "), std::string::npos);
  }
  EXPECT_EQ(folder_.entries(), (std::vector<std::string>{"bad.json", "two.xyzr"}));
}

}  // namespace
}  // namespace meniscus
