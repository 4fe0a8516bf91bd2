// SPDX-License-Identifier: BSD-3-Clause
// Keeps kernels that the driver has compiled in files for the next run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace meniscus {

/// The folder of one GL context. Whatever is missing, damaged, of another driver or of other sources is compiled; what
/// cannot be written is not kept; neither is an error. Files appear complete or not at all, and any number of processes
/// may share a folder. A folder holds one file for each kernel and driver: newer sources replace older ones.
class KernelFiles {
 public:
  /// For the context current on this thread; made when something is to be kept. Nothing is kept where the driver gives
  /// no binaries.
  explicit KernelFiles(std::filesystem::path folder);
  ~KernelFiles();
  KernelFiles(const KernelFiles&) = delete;
  KernelFiles& operator=(const KernelFiles&) = delete;

  /// That of the EglContext current on this thread; nullptr if it keeps none.
  static KernelFiles* current();
  /// To be called when its context has been made current on this thread; nullptr: a context that keeps none.
  static void make_current(KernelFiles* files);

  /// Gives the GL program what was kept under this name for this very text; false if there is nothing that the driver
  /// takes.
  bool load(std::uint32_t program, const std::string& name, std::string_view text) const;
  /// Keeps a linked program.
  void save(std::uint32_t program, const std::string& name, std::string_view text) const;

 private:
  std::filesystem::path path_of(const std::string& name) const;

  std::filesystem::path folder_;
  std::string driver_;
  bool offered_ = false;
};

}  // namespace meniscus
