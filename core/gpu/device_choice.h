// SPDX-License-Identifier: BSD-3-Clause
// The user's choice of a GL device, and the devices of a machine that fit it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// A choice such as "auto", "gpu", "gpu:1", "gpu:GPU-8a2d1c5e" or "software".
struct DeviceChoice {
  enum class Kind {
    automatic,  ///< hardware if any works, else software GL; code that does not need GL then uses the CPU
    gpu,        ///< hardware only
    software    ///< software GL only
  };
  Kind kind = Kind::automatic;
  std::optional<int> index;  ///< gpu: its number among visible hardware GPUs, from 0. Nothing: any
  std::string name{};        ///< gpu: the beginning of its UUID, or its PCI address. Empty: any

  /// The value of CUDA_VISIBLE_DEVICES, if set: the visible NVIDIA GPUs in order, by CUDA's index or by UUID. As in
  /// CUDA, entries after an invalid one are ignored. GPUs of other vendors follow.
  std::optional<std::string> cuda_visible{};
  /// The folder for kernels as the driver has compiled them (KernelFiles); empty: none.
  std::string kernel_folder{};
  /// The number of this worker: among several suitable GPUs, worker k takes number k first, modulo their count.
  int worker = 0;
};

/// EGL's description of one device.
struct GlDevice {
  int egl_index = 0;              ///< index in EGL's own list
  bool software = false;          ///< according to EGL; the renderer may still turn out to be software
  std::string name;               ///< driver file, or EGL's extension names; only for people
  std::optional<int> cuda_index;  ///< index of NVIDIA devices (EGL_NV_device_cuda)
  std::string uuid;               ///< UUID in CUDA's notation, "GPU-8a2d1c5e-..."; empty if EGL does not report it
  std::string pci;                ///< "0000:3b:00.0"; empty if the system does not report it
};

struct DeviceAttempt {
  GlDevice device;
  bool hardware_only = false;  ///< true if a software renderer is to be rejected
};

/// Parses a choice in the words above; nothing for any other text. A name is a UUID with or without "GPU-", at least 8
/// digits of it, or a PCI address.
std::optional<DeviceChoice> parse_device_choice(std::string_view text);

/// Formats kind, index and name of a choice: "auto", "gpu", "gpu:0", "software".
std::string to_string(const DeviceChoice& choice);

/// True if an EGL with these client extensions (EGL_EXTENSIONS of no display) can list its devices and open one.
/// EGL_EXT_device_base is the older name of EGL_EXT_device_query and EGL_EXT_device_enumeration together, and the only
/// one that NVIDIA's driver reports.
bool can_list_devices(std::string_view client_extensions);

/// Returns the visible hardware GPUs in the order of "gpu:N".
std::vector<GlDevice> visible_gpus(const DeviceChoice& choice, std::span<const GlDevice> devices);

/// Returns the devices to try for this choice, best first; empty if there is none.
std::vector<DeviceAttempt> device_attempts(const DeviceChoice& choice, std::span<const GlDevice> devices);

}  // namespace meniscus
