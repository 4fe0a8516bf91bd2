// SPDX-License-Identifier: BSD-3-Clause
// A real GPU's compiler reports registers, spilled memory and time of the kernels. The compiler is Mesa's RADV for
// AMD's Navi 21, which needs no such GPU.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <vulkan/vulkan.h>

#include "tests/gpu/kernel_variants.h"
#include "tests/support/sample_files.h"

namespace meniscus {
namespace {

const std::string kDriver = vulkan_driver("radeon");

/// First binding of each kind of resource: GL counts them for each kind, Vulkan for all together.
constexpr std::uint32_t kStorage = 0, kTexels = 32, kBlocks = 64, kImages = 96, kOfAKind = 16;

/// Compiles the kernel to SPIR-V.
std::vector<std::uint32_t> compile_to_spirv(const ShaderSource& source, const std::filesystem::path& folder) {
  const auto file = folder / "shader.comp", binary = folder / "shader.spv";
  std::ofstream(file) << source.text;
  const std::string command = fmt::format(
      "{} -V --shift-ssbo-binding {} --shift-texture-binding {} --shift-sampler-binding {} --shift-UBO-binding {} "
      "--shift-image-binding {} -o {} {} > {}",
      GLSLANG_VALIDATOR, kStorage, kTexels, kTexels, kBlocks, kImages, binary.string(), file.string(),
      (folder / "log").string());
  if (std::system(command.c_str()) != 0) return {};
  std::ifstream stream(binary, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  std::vector<std::uint32_t> words(bytes.size() / 4);
  std::copy_n(bytes.data(), bytes.size(), reinterpret_cast<char*>(words.data()));
  return words;
}

/// Returns a Vulkan structure of this type, zero but for the type.
template <typename Structure>
Structure begun(VkStructureType type) {
  Structure structure{};
  structure.sType = type;
  return structure;
}

/// Numbers of a compiled kernel by the driver's own names, such as "VGPRs".
struct CompiledKernel {
  std::map<std::string, std::uint64_t> numbers;
  double seconds = 0.0;
};

/// A device that compiles and never runs.
class CompilingDevice {
 public:
  CompilingDevice() {
    auto application = begun<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.apiVersion = VK_API_VERSION_1_2;
    auto instance = begun<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    instance.pApplicationInfo = &application;
    if (vkCreateInstance(&instance, nullptr, &instance_) != VK_SUCCESS) return;
    std::uint32_t count = 1;
    VkPhysicalDevice physical = nullptr;
    vkEnumeratePhysicalDevices(instance_, &count, &physical);
    if (count == 0) return;
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical, &properties);
    name_ = properties.deviceName;
    create_device(physical);
  }
  ~CompilingDevice() {
    if (device_) {
      vkDestroyPipelineLayout(device_, layout_, nullptr);
      vkDestroyDescriptorSetLayout(device_, set_layout_, nullptr);
      vkDestroyDevice(device_, nullptr);
    }
    if (instance_) vkDestroyInstance(instance_, nullptr);
  }
  CompilingDevice(const CompilingDevice&) = delete;
  CompilingDevice& operator=(const CompilingDevice&) = delete;

  bool works() const { return layout_ != nullptr; }
  const std::string& name() const { return name_; }

  CompiledKernel compile(const std::vector<std::uint32_t>& spirv) const {
    auto module_info = begun<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    module_info.codeSize = spirv.size() * sizeof(std::uint32_t);
    module_info.pCode = spirv.data();
    VkShaderModule module = nullptr;
    vkCreateShaderModule(device_, &module_info, nullptr, &module);
    auto info = begun<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = module;
    info.stage.pName = "main";
    info.layout = layout_;
    VkPipeline pipeline = nullptr;
    CompiledKernel kernel;
    const auto begin = std::chrono::steady_clock::now();
    const VkResult made = vkCreateComputePipelines(device_, nullptr, 1, &info, nullptr, &pipeline);
    kernel.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (made == VK_SUCCESS) kernel.numbers = statistics(pipeline);
    vkDestroyPipeline(device_, pipeline, nullptr);
    vkDestroyShaderModule(device_, module, nullptr);
    return kernel;
  }

 private:
  void create_device(VkPhysicalDevice physical) {
    auto statistics = begun<VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR);
    statistics.pipelineExecutableInfo = VK_TRUE;
    auto features = begun<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    vkGetPhysicalDeviceFeatures2(physical, &features);
    features.pNext = &statistics;
    const float priority = 1.0f;
    auto queue = begun<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    const char* const extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
    auto info = begun<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.pNext = &features;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
    if (vkCreateDevice(physical, &info, nullptr, &device_) == VK_SUCCESS) create_layout();
  }

  /// Makes one layout for all kernels, with every possible binding.
  void create_layout() {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (const auto& [first, type] : {std::pair{kStorage, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                                      {kTexels, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER},
                                      {kBlocks, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER},
                                      {kImages, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}})
      for (std::uint32_t n = 0; n < kOfAKind; ++n)
        bindings.push_back({first + n, type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    auto set = begun<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    set.bindingCount = static_cast<std::uint32_t>(bindings.size());
    set.pBindings = bindings.data();
    vkCreateDescriptorSetLayout(device_, &set, nullptr, &set_layout_);
    auto layout = begun<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layout.setLayoutCount = 1;
    layout.pSetLayouts = &set_layout_;
    vkCreatePipelineLayout(device_, &layout, nullptr, &layout_);
  }

  std::map<std::string, std::uint64_t> statistics(VkPipeline pipeline) const {
    const auto get = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
        vkGetDeviceProcAddr(device_, "vkGetPipelineExecutableStatisticsKHR"));
    auto executable = begun<VkPipelineExecutableInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR);
    executable.pipeline = pipeline;
    std::uint32_t count = 0;
    get(device_, &executable, &count, nullptr);
    std::vector<VkPipelineExecutableStatisticKHR> found(
        count, begun<VkPipelineExecutableStatisticKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR));
    get(device_, &executable, &count, found.data());
    std::map<std::string, std::uint64_t> numbers;
    for (const VkPipelineExecutableStatisticKHR& statistic : found)
      if (statistic.format == VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR)
        numbers[statistic.name] = statistic.value.u64;
    return numbers;
  }

  VkInstance instance_ = nullptr;
  VkDevice device_ = nullptr;
  VkDescriptorSetLayout set_layout_ = nullptr;
  VkPipelineLayout layout_ = nullptr;
  std::string name_;
};

ShaderSource without_proof_of_work(const EmbeddedShader& shader, const ShaderDefines& defines) {
  const auto find = [](std::string_view path) -> std::optional<std::string_view> {
    const auto found = std::ranges::find(embedded_shaders(), path, &EmbeddedShader::path);
    if (found == embedded_shaders().end()) return {};
    return found->text;
  };
  return expand_shader(shader.path, find, defines);  // Vulkan lacks the atomic counters of the proof of work.
}

/// Returns the most registers of an invocation, out of 256: with more, fewer groups run at once and memory is waited
/// for. Most kernels need a third; those that cut circles or patches in double precision hold two of them at once.
std::uint64_t most_registers(std::string_view path) {
  const std::map<std::string_view, std::uint64_t> kMore{
      {"gpu_shaders/primitives/spurious_arcs.comp", 136}, {"gpu_shaders/primitives/toroidal.comp", 168},
      {"gpu_shaders/primitives/concave.comp", 104},       {"gpu_shaders/ray_cast/ray_cast.comp", 104},
      {"gpu_shaders/reduced_surface/circles.comp", 136},  {"gpu_shaders/test_support/contour.comp", 136}};
  const auto found = kMore.find(path);
  return found == kMore.end() ? 80 : found->second;
}

TEST(Registers, EveryKernelFitsIntoThoseOfAGpu) {
  if (!std::filesystem::exists(kDriver)) GTEST_SKIP() << "no RADV: install mesa-vulkan-drivers";
  ::setenv("VK_ICD_FILENAMES", kDriver.c_str(), 1);
  ::setenv("RADV_FORCE_FAMILY", "NAVI21", 1);
  ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
  const CompilingDevice device;
  ASSERT_TRUE(device.works()) << device.name();
  const auto folder = std::filesystem::temp_directory_path() / fmt::format("meniscus_registers_{}", ::getpid());
  std::filesystem::create_directories(folder);
  constexpr std::uint64_t kMostCode = 48'000;  // Larger code leaves the instruction cache.
  constexpr double kMostSeconds = 30.0;        // time for all; an idle machine takes a tenth of it
  std::size_t kernels = 0;
  double seconds = 0.0;
  for (const EmbeddedShader& shader : embedded_shaders()) {
    if (!shader.path.ends_with(".comp")) continue;
    for (const ShaderDefines& defines : variants_of(shader)) {
      SCOPED_TRACE(
          fmt::format("{} {}", shader.path, defines.empty() ? "" : defines[0].first + "=" + defines[0].second));
      const std::vector<std::uint32_t> spirv = compile_to_spirv(without_proof_of_work(shader, defines), folder);
      ASSERT_FALSE(spirv.empty());
      CompiledKernel kernel = device.compile(spirv);
      ASSERT_TRUE(kernel.numbers.contains("VGPRs"));
      ++kernels;
      seconds += kernel.seconds;
      EXPECT_LE(kernel.numbers["VGPRs"], most_registers(shader.path));
      EXPECT_LE(kernel.numbers["Code size"], kMostCode);
      for (const char* const none : {"Spilled VGPRs", "Scratch size"}) {
        ASSERT_TRUE(kernel.numbers.contains(none));
        EXPECT_EQ(kernel.numbers[none], 0u) << none;
      }
    }
  }
  std::filesystem::remove_all(folder);
  EXPECT_GT(kernels, 40u);
  EXPECT_LT(seconds, kMostSeconds);
}

}  // namespace
}  // namespace meniscus
