// SPDX-License-Identifier: BSD-3-Clause
// The devices that a choice leads to, on invented machines.
#include "core/gpu/device_choice.h"

#include <gtest/gtest.h>

#include "core/gpu/context_description.h"

namespace meniscus {
namespace {

using Kind = DeviceChoice::Kind;

DeviceChoice wish(const char* text) { return parse_device_choice(text).value(); }

GlDevice nvidia(int egl_index, int cuda_index, const char* uuid, const char* pci) {
  return {egl_index, false, "/dev/dri/card", cuda_index, uuid, pci};
}

/// Returns two NVIDIA GPUs, not in CUDA's order, with one of another maker between, and Mesa's software.
std::vector<GlDevice> workstation() {
  return {nvidia(0, 1, "GPU-11111111-aaaa-bbbb-cccc-000000000001", "0000:3b:00.0"),
          {1, false, "/dev/dri/card1", {}, "", "0000:00:02.0"},
          nvidia(2, 0, "GPU-22222222-aaaa-bbbb-cccc-000000000002", "0000:af:00.0"),
          {3, true, "EGL_MESA_device_software", {}, "", ""}};
}

/// Returns places in EGL's list, in the order of trial; a place is negative, less one, where software does not suffice.
std::vector<int> tried(const DeviceChoice& choice, const std::vector<GlDevice>& devices) {
  std::vector<int> places;
  for (const DeviceAttempt& attempt : device_attempts(choice, devices))
    places.push_back(attempt.hardware_only ? -1 - attempt.device.egl_index : attempt.device.egl_index);
  return places;
}

TEST(DeviceChoice, ReadsEveryFormAndNothingElse) {
  for (const char* text : {"auto", "gpu", "gpu:0", "gpu:12", "software", "gpu:GPU-8a2d1c5e", "gpu:0000:3b:00.0"})
    EXPECT_EQ(to_string(wish(text)), text);
  for (const char* text : {"", "gpu:", "gpu:-1", "gpu:1x", "cpu", "Auto", "gpu:8a2d", "gpu:GPU-", "gpu:GPU-8a2d1c5x"})
    EXPECT_FALSE(parse_device_choice(text)) << text;
}

TEST(DeviceChoice, AutomaticTriesHardwareThenSoftware) {
  EXPECT_EQ(tried(wish("auto"), workstation()), (std::vector{-1, -2, -3, 3}));
  EXPECT_EQ(tried(wish("auto"), {{0, true, "", {}, "", ""}}), std::vector{0});
  EXPECT_TRUE(tried(wish("auto"), {}).empty());
}

TEST(DeviceChoice, GpuIsNeverSoftware) {
  EXPECT_EQ(tried(wish("gpu"), workstation()), (std::vector{-1, -2, -3}));
  EXPECT_EQ(tried(wish("gpu:1"), workstation()), std::vector{-2});
  EXPECT_TRUE(tried(wish("gpu:3"), workstation()).empty());
  EXPECT_TRUE(tried(wish("gpu"), {{0, true, "", {}, "", ""}}).empty());
  EXPECT_EQ(tried(wish("software"), workstation()), std::vector{3});
}

TEST(DeviceChoice, NamesAGpuByUuidOrPciAddress) {
  EXPECT_EQ(tried(wish("gpu:GPU-22222222"), workstation()), std::vector{-3});
  EXPECT_EQ(tried(wish("gpu:11111111-AAAA"), workstation()), std::vector{-1});
  EXPECT_EQ(tried(wish("gpu:0000:00:02.0"), workstation()), std::vector{-2});
  EXPECT_TRUE(tried(wish("gpu:0000:ff:00.0"), workstation()).empty());
}

TEST(DeviceChoice, SeesWhatCudaSees) {
  const auto seen = [](const char* list, const char* text = "gpu") {
    DeviceChoice choice = wish(text);
    choice.cuda_visible = list;
    return tried(choice, workstation());
  };
  EXPECT_EQ(seen("0,1"), (std::vector{-3, -1, -2}));  // CUDA's order comes first, other makers' devices follow.
  EXPECT_EQ(seen("1"), (std::vector{-1, -2}));
  EXPECT_EQ(seen("1", "gpu:0"), std::vector{-1});
  EXPECT_EQ(seen(" GPU-22222222 , 1"), (std::vector{-3, -1, -2}));
  EXPECT_EQ(seen("1,-1,0"), (std::vector{-1, -2}));  // Entries behind a wrong one do not count.
  EXPECT_EQ(seen("MIG-1c2d3e4f"), std::vector{-2});
  EXPECT_EQ(seen(""), std::vector{-2});
  EXPECT_EQ(seen("", "auto"), (std::vector{-2, 3}));
}

TEST(DeviceChoice, WorkersTakeTurns) {
  const auto first = [](int worker, const char* text) {
    DeviceChoice choice = wish(text);
    choice.worker = worker;
    return tried(choice, workstation()).front();
  };
  EXPECT_EQ(first(0, "gpu"), -1);
  EXPECT_EQ(first(1, "gpu"), -2);
  EXPECT_EQ(first(2, "auto"), -3);
  EXPECT_EQ(first(7, "gpu"), -2);
  EXPECT_EQ(first(2, "gpu:0"), -1) << "a number given by hand stands";
}

TEST(DeviceChoice, KnowsSoftwareByItsName) {
  for (const char* name : {"llvmpipe (LLVM 15.0.6, 256 bits)", "zink (llvmpipe (LLVM 15.0.6, 256 bits))", "softpipe",
                           "Google SwiftShader", "zink Vulkan 1.3(lavapipe)", "SWR (LLVM 11.0.0, 256 bits)",
                           "D3D12 (Microsoft Basic Render Driver)", "Apple Software Renderer"})
    EXPECT_TRUE(is_software_renderer(name)) << name;
  for (const char* name : {"NVIDIA H100 PCIe/PCIe/SSE2", "AMD Radeon RX 6800 (navi21, LLVM 15.0.6, DRM 3.49)",
                           "Mesa Intel(R) Arc(tm) A770 Graphics (DG2)", "zink (NVIDIA GeForce RTX 3080)"})
    EXPECT_FALSE(is_software_renderer(name)) << name;
}

TEST(DeviceChoice, NvidiaListsDevicesByTheOlderExtensionAlone) {
  constexpr const char* kNvidia580 =
      "EGL_EXT_platform_base EGL_EXT_device_base EGL_KHR_client_get_all_proc_addresses EGL_EXT_client_extensions "
      "EGL_KHR_debug EGL_KHR_platform_x11 EGL_EXT_platform_x11 EGL_EXT_platform_device EGL_MESA_platform_surfaceless "
      "EGL_EXT_explicit_device";
  EXPECT_TRUE(can_list_devices(kNvidia580));
  EXPECT_TRUE(can_list_devices("EGL_EXT_device_enumeration EGL_EXT_device_query EGL_EXT_platform_device"));
  EXPECT_FALSE(can_list_devices("EGL_EXT_device_base EGL_EXT_platform_device_drm"));
  EXPECT_FALSE(can_list_devices("EGL_EXT_platform_device EGL_EXT_device_query"));
  EXPECT_FALSE(can_list_devices(""));
}

}  // namespace
}  // namespace meniscus
