// SPDX-License-Identifier: BSD-3-Clause
// Read-only GPU memory that kernels fetch as texels: on llvmpipe twice as fast as a storage buffer.
#pragma once

#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "core/gpu/buffer.h"

namespace meniscus {

/// What one texel is; both arrive in the kernel as a usamplerBuffer, so that no bit of a float is touched on its way.
enum class TexelFormat { uint1, uint4 };

/// A buffer texture. Needs a current context.
class TexelBuffer {
 public:
  explicit TexelBuffer(TexelFormat format) : format_(format) {}
  ~TexelBuffer();
  TexelBuffer(const TexelBuffer&) = delete;
  TexelBuffer& operator=(const TexelBuffer&) = delete;

  /// Replaces the content. Throws CapacityError when there are more texels than the driver can address.
  template <typename T>
  void upload(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    upload_bytes(std::as_bytes(std::span<const T>(values)));
  }

  /// Shows what kernels wrote to a storage buffer; to be called again whenever that buffer was resized. The buffer must
  /// outlive this view's use. Throws CapacityError as above.
  void view(const Buffer& storage);

  /// `layout(binding = N) uniform usamplerBuffer` of the kernels.
  void bind(std::uint32_t unit) const;

 private:
  void upload_bytes(std::span<const std::byte> bytes);
  void attach(const Buffer& storage);

  TexelFormat format_;
  Buffer buffer_;
  std::uint32_t texture_ = 0;
  std::uint64_t shown_ = 0;  ///< Buffer::memory()
};

}  // namespace meniscus
