// SPDX-License-Identifier: BSD-3-Clause
// Context, buffers, programs, folded dispatch and timers on whatever GL this machine has.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <random>
#include <span>
#include <thread>
#include <vector>

#include <unistd.h>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/gpu/kernel_lists.h"
#include "core/gpu/buffer.h"
#include "core/gpu/egl_context.h"
#include "core/gpu/shader_source.h"
#include "core/gpu/program.h"
#include "core/gpu/kernel_records.h"
#include "core/gpu/context_description.h"
#include "tests/gpu/kernel_variants.h"

namespace meniscus {
namespace {

const ShaderDefines kFactor3{{"FACTOR", "3"}};

class GpuCore : public ::testing::Test {
 protected:
  EglContext context_;
};

TEST_F(GpuCore, ReportsItsDevice) {
  EXPECT_FALSE(context_.renderer().empty());
  EXPECT_FALSE(context_.vendor().empty());
  EXPECT_GE(context_.version(), "4.5");
  const auto devices = list_gl_devices();
  ASSERT_FALSE(devices.empty());
  bool hardware = false;
  for (const GlDevice& device : devices) hardware |= !device.software;
  EXPECT_EQ(context_.is_software(), !hardware) << context_.renderer();
}

TEST_F(GpuCore, HonoursTheChoiceOrSaysWhyNot) {
  EXPECT_THROW(EglContext({DeviceChoice::Kind::gpu, 99}), GpuError);
  for (const GlDevice& device : list_gl_devices())
    if (device.software) {
      EXPECT_TRUE(EglContext({DeviceChoice::Kind::software, 0}).is_software());
    }
}

TEST_F(GpuCore, HardwareAskedForIsHardwareOrAnError) {
  try {
    EXPECT_FALSE(EglContext({.kind = DeviceChoice::Kind::gpu, .index = {}}).is_software());
  } catch (const GpuError& error) {
    EXPECT_NE(std::string(error.what()).find("'gpu'"), std::string::npos) << error.what();
  }
}

TEST_F(GpuCore, HearsOfResets) { EXPECT_NO_THROW(require_living_context()) << "there was none"; }

TEST_F(GpuCore, KernelsNeedAContextThatKeepsAccounts) {
  bool refused = false;
  std::thread([&] {
    try {
      WorkProof::current();
    } catch (const GpuError&) {
      refused = true;
    }
  }).join();
  EXPECT_TRUE(refused);
}

TEST_F(GpuCore, MovesToAnotherThread) {
  Buffer buffer(64);
  buffer.fill(7);
  check_gl("filling");
  { EglContext other; }  // leaves this thread without a current context
  std::thread([&] {
    context_.make_current();
    EXPECT_EQ(buffer.download<std::uint32_t>(16), std::vector<std::uint32_t>(16, 7));
    buffer = Buffer();
  }).join();
}

TEST_F(GpuCore, BuffersReturnWhatTheyWereGiven) {
  for (const std::size_t count : {0u, 1u, 3u, 1000u, 100000u}) {
    std::vector<std::uint32_t> words(count);
    std::iota(words.begin(), words.end(), 5u);
    Buffer buffer{std::span<const std::uint32_t>(words)};
    EXPECT_EQ(buffer.byte_count(), count * 4);
    EXPECT_EQ(buffer.download<std::uint32_t>(count), words);
    buffer.fill(9);
    EXPECT_EQ(buffer.download<std::uint32_t>(count), std::vector<std::uint32_t>(count, 9));
  }
  Buffer buffer{std::span<const std::uint32_t>(std::vector<std::uint32_t>{1, 2, 3, 4})};
  EXPECT_EQ(buffer.download<std::uint32_t>(2, 8), (std::vector<std::uint32_t>{3, 4}));
  Buffer large(query_gpu_limits().storage_block_bytes + 1);
  EXPECT_THROW(large.bind(0), CapacityError) << "kernels cannot see it; texel fetches can";
}

TEST_F(GpuCore, DispatchFoldsManyGroups) {
  const Program program("gpu_shaders/test_support/scale.comp", kFactor3);
  for (const auto& [count, longest_row] :
       {std::pair{1u, 0u}, {1000u, 0u}, {1000u, 1u}, {100000u, 100u}, {5000000u, 0u}}) {
    Buffer words(count * 4), surplus(4);
    words.fill(0);
    surplus.fill(0);
    words.bind(0);
    surplus.bind(1);
    program.set(kernel::ScaleParameters{.count = count, .offset = 11});
    program.dispatch((count + 63) / 64, longest_row);
    std::vector<std::uint32_t> expected(count);
    for (std::uint32_t i = 0; i < count; ++i) expected[i] = i * 3 + 11;
    EXPECT_EQ(words.download<std::uint32_t>(count), expected) << count;
    EXPECT_LT(surplus.download<std::uint32_t>(1)[0], 64u * 256u) << "a rectangle much larger than the work";
  }
}

TEST_F(GpuCore, DispatchBeyondTheLimitIsAnErrorNotSilence) {
  const Program program("gpu_shaders/test_support/scale.comp", kFactor3);
  const std::uint32_t limit = query_gpu_limits().group_count;
  if (limit == 0x7fffffffu) GTEST_SKIP() << "this driver takes any group count";
  EXPECT_THROW(program.dispatch_2d(limit + 1, 1), GpuError);
}

TEST_F(GpuCore, IndirectDispatchReadsItsCounts) {
  const Program program("gpu_shaders/test_support/scale.comp");
  Buffer words(128 * 4), surplus(4), counts{std::span<const std::uint32_t>(std::vector<std::uint32_t>{9, 2, 1, 1})};
  words.fill(0);
  words.bind(0);
  surplus.bind(1);
  program.set(kernel::ScaleParameters{.count = 128, .offset = 1});
  program.dispatch_indirect(counts, 4);
  EXPECT_EQ(words.download<std::uint32_t>(128).back(), 128u);
}

TEST_F(GpuCore, CompilerErrorsNameOurFiles) {
  const auto find = [](std::string_view path) -> std::optional<std::string_view> {
    if (path == "t.comp")
      return "#version 450 core\nlayout(local_size_x = 1) in;\n#include \"gpu_shaders/test_support/broken.glsl\"\n"
             "layout(std430, binding = 0) buffer B { float b; };\nvoid main() { b = broken(); }\n";
    for (const EmbeddedShader& shader : embedded_shaders())
      if (shader.path == path) return shader.text;
    return std::nullopt;
  };
  try {
    Program program("t.comp", expand_shader("t.comp", find));
    FAIL() << "a broken shader compiled";
  } catch (const GpuError& error) {
    EXPECT_NE(std::string(error.what()).find("gpu_shaders/test_support/broken.glsl:4: "), std::string::npos)
        << error.what();
  }
}

TEST_F(GpuCore, CacheCompilesOnce) {
  ProgramCache cache;
  const Program& first = cache.get("gpu_shaders/test_support/scale.comp", kFactor3);
  EXPECT_EQ(&first, &cache.get("gpu_shaders/test_support/scale.comp", kFactor3));
  EXPECT_NE(&first, &cache.get("gpu_shaders/test_support/scale.comp"));
}

// The host acts like a kernel: it counts all records, and writes those that have a place.
TEST_F(GpuCore, AppendedRecordsAllFindTheirPlace) {
  constexpr std::size_t kHeader = 16;
  AppendList numbers(sizeof(std::uint32_t), 4, kHeader), others(sizeof(std::uint32_t), 2);
  Buffer counters;
  std::uint32_t next = 0;
  int runs = 0;
  const auto append = [&](std::uint32_t count, std::uint32_t other_count) {
    const std::uint32_t first = numbers.count();
    std::array<std::uint32_t, 3> counted{};  // The last counter belongs to no list.
    append_all({&numbers, &others}, counters, counted, [&] {
      ++runs;
      const auto before = counters.download<std::uint32_t>(3);
      EXPECT_EQ(before, (std::vector<std::uint32_t>{first, others.count(), 0}));
      EXPECT_GE(numbers.buffer.byte_count(), kHeader + numbers.capacity() * sizeof(std::uint32_t));
      for (std::uint32_t n = 0; n < count && first + n < numbers.capacity(); ++n) {
        const std::uint32_t number = next + n;
        numbers.buffer.write(kHeader + (first + n) * sizeof number, &number, sizeof number);
      }
      const std::uint32_t after[] = {before[0] + count, before[1] + other_count, 7};
      counters.write(0, after, sizeof after);
    });
    next += count;
    EXPECT_EQ(counted[2], 7u);
  };
  append(3, 0);
  EXPECT_EQ(runs, 1);
  append(100, 1);  // too many records for the first list
  EXPECT_EQ(runs, 3);
  append(1, 50);  // too many records for the second list, which makes both run again
  EXPECT_EQ(runs, 5);
  append(0, 0);
  EXPECT_EQ(runs, 6);
  EXPECT_EQ(others.count(), 51u);
  std::vector<std::uint32_t> by_host(1000);
  std::iota(by_host.begin(), by_host.end(), next);
  numbers.append(std::span<const std::uint32_t>(by_host));
  ASSERT_EQ(numbers.count(), next + 1000);
  const auto found = numbers.buffer.download<std::uint32_t>(numbers.count(), kHeader);
  for (std::uint32_t n = 0; n < found.size(); ++n) ASSERT_EQ(found[n], n);
  numbers.clear();
  EXPECT_EQ(numbers.count(), 0u);
}

// Both ways of scanning are tried around the lengths of their chunks and rows of chunks.
TEST_F(GpuCore, ScansOfAllKindsAgree) {
  ProgramCache programs;
  PrefixSum serial(programs, ScanKind::serial), parallel(programs, ScanKind::parallel);
  std::mt19937 random(7);
  for (const std::uint32_t count :
       {0u, 1u, 3u, 4u, 5u, 255u, 511u, 512u, 513u, 1023u, 1024u, 1025u, 70000u, 262143u, 262144u, 262145u, 700001u})
    for (const std::uint32_t limit : {~0u, count / 2 * 3, 0u}) {
      std::vector<std::uint32_t> words(count + 1), expected(count + 1);
      std::generate(words.begin(), words.end(), [&] { return random() % 7; });
      std::exclusive_scan(words.begin(), words.end(), expected.begin(), 0u);
      for (std::uint32_t& sum : expected) sum = std::min(sum, limit);
      for (PrefixSum* scan : {&serial, &parallel}) {
        Buffer buffer{std::span<const std::uint32_t>(words)};
        (*scan)(buffer, count, limit);
        ASSERT_EQ(buffer.download<std::uint32_t>(count + 1), expected)
            << count << " words, limit " << limit << (scan == &serial ? ", serial" : ", parallel");
      }
    }
}

TEST_F(GpuCore, ExactStagesWaitForTheGpu) {
  const Program program("gpu_shaders/test_support/scale.comp", kFactor3);
  Buffer words(4000000), surplus(4);
  words.bind(0);
  surplus.bind(1);
  program.set(kernel::ScaleParameters{.count = 1000000, .offset = 0});
  StageClock clock(StageTiming::exact);
  for (const char* name : {"scale", "idle", "scale"}) {
    const GpuStage stage(clock, name);
    if (std::string(name) == "scale") program.dispatch(15625);
  }
  const auto& times = clock.times();
  ASSERT_EQ(times.size(), 2u);
  EXPECT_EQ(times[0].name, "scale");
  EXPECT_GT(times[0].milliseconds, times[1].milliseconds);
  EXPECT_LT(times[0].milliseconds, 10000.0);
}

TEST_F(GpuCore, LoopsEndWhereTheyShouldOrSaySo) {
  const Program program("gpu_shaders/test_support/long_loop.comp");
  for (const auto& [outer, inner] : {std::pair{100u, 100u}, {10u, 6000u}, {2000u, 100u}, {1u, 200000u}}) {
    Buffer found(2 * sizeof(std::uint32_t));
    found.fill(0);
    found.bind(0);
    program.set(kernel::LoopParameters{.outer = outer, .inner = inner});
    program.dispatch(1);
    const auto counts = found.download<std::uint32_t>(2);
    EXPECT_EQ(counts[0] != outer * inner, counts[1] != 0u) << outer << " x " << inner << ": " << counts[0];
  }
}

TEST(Shaders, PassTheReferenceCompilerAndValidator) {
  const auto folder = std::filesystem::temp_directory_path() / ("meniscus_shaders_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  std::size_t entry_count = 0, variant_count = 0;
  for (const EmbeddedShader& shader : embedded_shaders()) {
    if (!shader.path.ends_with(".comp")) continue;
    ++entry_count;
    for (const ShaderDefines& defines : variants_of(shader)) {
      ++variant_count;
      const ShaderSource source = expand_embedded_shader(shader.path, defines);
      const auto file = folder / "shader.comp", binary = folder / "shader.spv", log = folder / "log";
      std::ofstream(file) << source.text;
      const std::string command = "(" GLSLANG_VALIDATOR " -G --aml -o " + binary.string() + " " + file.string() +
                                  " && " SPIRV_VAL " --target-env opengl4.5 " + binary.string() + ") > " +
                                  log.string() + " 2>&1";
      const int status = std::system(command.c_str());
      std::ifstream log_stream(log);
      const std::string text{std::istreambuf_iterator<char>(log_stream), {}};
      EXPECT_EQ(status, 0) << shader.path << (defines.empty() ? "" : " with " + defines[0].first) << "\n"
                           << translate_shader_log(text, source.files);
    }
  }
  EXPECT_GT(entry_count, 0u);
  EXPECT_GT(variant_count, entry_count + 5);
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace meniscus
