// SPDX-License-Identifier: BSD-3-Clause
// Include expansion and log translation of shaders, without GL.
#include "core/gpu/shader_source.h"

#include <map>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace meniscus {
namespace {

using Files = std::map<std::string, std::string, std::less<>>;

ShaderSource expand(const Files& files, const ShaderDefines& defines = {}) {
  const auto find = [&](std::string_view path) -> std::optional<std::string_view> {
    const auto file = files.find(path);
    if (file == files.end()) return std::nullopt;
    return file->second;
  };
  return expand_shader("main.comp", find, defines);
}

std::string error_of(const Files& files) {
  try {
    expand(files);
  } catch (const GpuError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ShaderSource, PutsDefinesAfterTheVersionAndKeepsLineNumbers) {
  const auto source =
      expand({{"main.comp", "// a\n#version 450 core\nvoid main() {}\n"}}, {{"SIZE", "64"}, {"FAST", ""}});
  EXPECT_EQ(source.text, "// a\n#version 450 core\n#define SIZE 64\n#define FAST \n#line 3 0\nvoid main() {}\n");
  EXPECT_EQ(source.files, std::vector<std::string>{"main.comp"});
}

TEST(ShaderSource, IncludesEachFileOnceHoweverItIsReached) {
  const auto source = expand({{"main.comp", "#version 450\n#include \"a.glsl\"\n  # include  \"b.glsl\" // why\nend\n"},
                              {"a.glsl", "#include \"b.glsl\"\na"},
                              {"b.glsl", "b\n"}});
  EXPECT_EQ(source.text, "#version 450\n#line 2 0\n#line 1 1\n#line 1 2\nb\n#line 2 1\na\n#line 3 0\n#line 4 0\nend\n");
  EXPECT_EQ(source.files, (std::vector<std::string>{"main.comp", "a.glsl", "b.glsl"}));
}

TEST(ShaderSource, NamesTheIncluderOfWhatIsMissing) {
  EXPECT_EQ(error_of({{"main.comp", "#version 450\n#include \"a.glsl\"\n"}, {"a.glsl", "\n\n#include \"b.glsl\"\n"}}),
            "a.glsl:3: no such shader: 'b.glsl'");
  EXPECT_EQ(error_of({}), "main.comp: no such shader");
  EXPECT_EQ(error_of({{"main.comp", "#version 450\n#include a.glsl\n"}}),
            "main.comp:2: an include needs a file name in double quotes");
}

TEST(ShaderSource, RefusesCyclesAndMisplacedVersions) {
  EXPECT_EQ(error_of({{"main.comp", "#version 450\n#include \"a.glsl\"\n"},
                      {"a.glsl", "#include \"b.glsl\"\n"},
                      {"b.glsl", "\n#include \"a.glsl\"\n"}}),
            "b.glsl:2: 'a.glsl' includes itself");
  EXPECT_EQ(error_of({{"main.comp", "void main() {}\n"}}), "main.comp: a shader needs a #version line");
  EXPECT_EQ(error_of({{"main.comp", "#version 450\n#include \"a.glsl\"\n"}, {"a.glsl", "#version 450\n"}}),
            "a.glsl:1: #version in an included file");
}

TEST(ShaderSource, TranslatesTheLogsOfAllCompilers) {
  const std::vector<std::string> files{"main.comp", "gpu_shaders/geometry/a.glsl"};
  EXPECT_EQ(translate_shader_log("1:12(5): error: x undeclared\n", files),
            "gpu_shaders/geometry/a.glsl:12: error: x undeclared\n");
  EXPECT_EQ(translate_shader_log("0(7) : error C1008: undefined\n", files), "main.comp:7: error C1008: undefined\n");
  EXPECT_EQ(translate_shader_log("ERROR: 1:3: 'y' : undeclared identifier", files),
            "gpu_shaders/geometry/a.glsl:3: ERROR: 'y' : undeclared identifier\n");
  EXPECT_EQ(translate_shader_log("9:3: no such file\nplain words", files), "9:3: no such file\nplain words\n");
}

}  // namespace
}  // namespace meniscus
