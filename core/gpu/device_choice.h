// SPDX-License-Identifier: BSD-3-Clause
// Which GL device a user asks for, and which of a machine's devices that can be.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meniscus {

/// A wish such as "auto", "gpu", "gpu:1", "gpu:GPU-8a2d1c5e" or "software".
struct DeviceChoice {
  enum class Kind {
    automatic,  ///< hardware if any works, else software GL; what can do without GL takes the CPU then
    gpu,        ///< hardware, nothing else
    software    ///< software GL, nothing else
  };
  Kind kind = Kind::automatic;
  std::optional<int> index;  ///< gpu: this one only; counts hardware GPUs that are visible, from 0. Nothing: any
  std::string name{};        ///< gpu: the one whose UUID begins so, or that has this PCI address. Empty: any

  /// CUDA_VISIBLE_DEVICES, if the caller has it: the NVIDIA GPUs that count, in this order, by CUDA's index or by UUID;
  /// what follows an entry that names none does not count either, as CUDA has it. Other makers' GPUs come behind.
  std::optional<std::string> cuda_visible{};
  /// Where kernels are kept as the driver has compiled them (kernel_files.h); empty: nowhere.
  std::string kernel_folder{};
  /// Of several GPUs that would do, worker k takes number k first, counted around.
  int worker = 0;
};

/// What EGL says about one device.
struct GlDevice {
  int egl_index = 0;              ///< place in EGL's own list
  bool software = false;          ///< only what EGL says: a renderer may turn out to be software all the same
  std::string name;               ///< driver file, or EGL's extension words; only for people to read
  std::optional<int> cuda_index;  ///< of NVIDIA's (EGL_NV_device_cuda)
  std::string uuid;               ///< as CUDA writes it, "GPU-8a2d1c5e-..."; empty if EGL does not say
  std::string pci;                ///< "0000:3b:00.0"; empty if the system does not say
};

/// A device to try.
struct DeviceAttempt {
  GlDevice device;
  bool hardware_only = false;  ///< to be given up if its renderer is software
};

/// Reads the words above; nothing for any other text. A name is a UUID with or without "GPU-", at least 8 digits of it,
/// or a PCI address.
std::optional<DeviceChoice> parse_device_choice(std::string_view text);

/// The inverse, of kind, index and name: "auto", "gpu", "gpu:0", "software".
std::string to_string(const DeviceChoice& choice);

/// Whether an EGL with these client extensions (EGL_EXTENSIONS of no display) can list its devices and open one.
/// EGL_EXT_device_base is the older name of EGL_EXT_device_query and EGL_EXT_device_enumeration together, and the only
/// one that NVIDIA's driver gives.
bool can_list_devices(std::string_view client_extensions);

/// The hardware GPUs that count, in the order of "gpu:N".
std::vector<GlDevice> visible_gpus(const DeviceChoice& choice, std::span<const GlDevice> devices);

/// What to try for this wish, best first; empty if there is nothing.
std::vector<DeviceAttempt> device_attempts(const DeviceChoice& choice, std::span<const GlDevice> devices);

}  // namespace meniscus
