// SPDX-License-Identifier: BSD-3-Clause
// A GL 4.5 core context without any window, and the files of kernels that its driver has compiled.
#pragma once

#include <filesystem>

#include "core/gpu/context_description.h"
#include "core/gpu/device_choice.h"
#include "core/gpu/work_proof.h"

namespace meniscus {

/// The folder of kernels of one GL context. Kernels that are missing, damaged, of another driver or of other sources
/// are compiled; kernels that cannot be written are not kept; neither is an error. Files appear complete or not at all,
/// and any number of processes may share a folder. A folder has one file per kernel and driver: newer sources replace
/// older ones.
class KernelFiles {
 public:
  /// Keeps the kernels of the context current on this thread. The folder is made with its first file. Nothing is kept
  /// if the driver provides no binaries.
  explicit KernelFiles(std::filesystem::path folder);
  ~KernelFiles();
  KernelFiles(const KernelFiles&) = delete;
  KernelFiles& operator=(const KernelFiles&) = delete;

  /// Returns the folder of the EglContext current on this thread; nullptr if it has none.
  static KernelFiles* current();
  /// Must be called when its context has been made current on this thread; nullptr: the context has no folder.
  static void make_current(KernelFiles* files);

  /// Loads into the GL program the binary kept under this name for exactly this text; false if there is none that the
  /// driver accepts.
  bool load(std::uint32_t program, const std::string& name, std::string_view text) const;
  /// Saves a linked program.
  void save(std::uint32_t program, const std::string& name, std::string_view text) const;

 private:
  std::filesystem::path path_of(const std::string& name) const;

  std::filesystem::path folder_;
  std::string driver_;
  bool offered_ = false;
};

/// Lists all devices that EGL_EXT_device_enumeration offers. Throws GpuError if EGL cannot enumerate devices.
std::vector<GlDevice> list_gl_devices();

/// Owns one GL 4.5 core context, current on the thread that made it. All GL calls of the library need one current.
class EglContext {
 public:
  /// Creates a context on the first device that fits `choice`, has GL 4.5 and, where hardware is required, does not
  /// draw on the CPU: its renderer is checked, because EGL's list may take Mesa's software for a GPU. Throws GpuError
  /// that names the devices that were tried.
  explicit EglContext(const DeviceChoice& choice = {});
  ~EglContext();
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  /// Makes the context current on the calling thread. Throws GpuError.
  void make_current();

  bool is_software() const { return description_.software; }
  const std::string& vendor() const { return description_.vendor; }
  const std::string& renderer() const { return description_.renderer; }
  const std::string& version() const { return description_.version; }

 private:
  bool try_device(const DeviceAttempt& attempt, const std::string& kernel_folder, std::string& why_not);
  void abandon();
  bool adopt_context(void* display, void* context, const std::string& kernel_folder, std::string& why_not);

  void* display_ = nullptr;
  void* context_ = nullptr;
  ContextDescription description_;
  std::optional<WorkProof> proof_;
  std::optional<KernelFiles> kernel_files_;
};

}  // namespace meniscus
