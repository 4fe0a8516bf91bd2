// SPDX-License-Identifier: BSD-3-Clause
// Keeps kernels that the driver has compiled in files for the next run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace meniscus {

/// The folder of kernels of one GL context. Kernels that are missing, damaged, of another driver or of other sources
/// are compiled; kernels that cannot be written are not kept; neither is an error. Files appear complete or not at all,
/// and any number of processes may share a folder. A folder has one file per kernel and driver: newer sources replace
/// older ones.
class KernelFiles {
 public:
  /// For the context current on this thread. The folder is made with its first file. Nothing is kept if the driver
  /// provides no binaries.
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

}  // namespace meniscus
