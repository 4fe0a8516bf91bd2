// SPDX-License-Identifier: BSD-3-Clause
// GPU memory: buffers that kernels read and write or fetch as texels, and words of several buffers in one
// read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "core/gpu/work_proof.h"

namespace meniscus {

/// A storage buffer. Its memory is undefined until uploaded, filled or written by a kernel. Needs a current context.
class Buffer {
 public:
  Buffer() = default;
  /// Throws CapacityError when the driver has no room.
  explicit Buffer(std::size_t byte_count) { resize(byte_count); }
  template <typename T>
  explicit Buffer(std::span<const T> values) {
    upload(values);
  }
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;

  /// Makes room for `byte_count` bytes; keeps the memory it has if that is enough, and loses the content if not. A
  /// buffer that had memory gets some more than it asks for, so that sizes that sway from frame to frame settle.
  void resize(std::size_t byte_count);
  /// Makes room like resize, but keeps the content.
  void grow(std::size_t byte_count);
  std::size_t byte_count() const { return byte_count_; }

  /// Resizes to the values and copies them.
  template <typename T>
  void upload(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    resize(values.size_bytes());
    write(0, values.data(), values.size_bytes());
  }
  template <typename T>
  void upload(const std::vector<T>& values) {
    upload(std::span<const T>(values));
  }
  /// Copies `count` values of type T out, from `byte_offset` on; waits for kernels to end. Throws GpuError if one of
  /// them did not (work_proof.h).
  template <typename T>
  std::vector<T> download(std::size_t count, std::size_t byte_offset = 0) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(count);
    read(byte_offset, values.data(), count * sizeof(T));
    return values;
  }
  /// Copies into existing memory; otherwise the same.
  template <typename T>
  void download(std::span<T> values, std::size_t byte_offset = 0) const {
    read(byte_offset, values.data(), values.size_bytes());
  }
  /// Copies bytes of `source` from `byte_offset` on to the place `to`, on the GPU.
  void copy(const Buffer& source, std::size_t byte_offset, std::size_t to, std::size_t byte_count);
  /// Sets every 4-byte word.
  void fill(std::uint32_t word);

  /// `layout(std430, binding = N)` of the kernels. Throws CapacityError for more bytes than a kernel can see.
  void bind(std::uint32_t binding) const;
  /// For dispatch_indirect.
  std::uint32_t gl_name() const { return name_; }
  /// Names the memory it has: another one after each allocation of any buffer, 0 for none. GL uses its names again.
  std::uint64_t memory() const { return memory_; }

  void write(std::size_t byte_offset, const void* bytes, std::size_t byte_count);
  void read(std::size_t byte_offset, void* bytes, std::size_t byte_count) const;

 private:
  std::uint32_t name_ = 0;
  std::uint64_t memory_ = 0;
  std::size_t byte_count_ = 0;  ///< what was asked for
  std::size_t capacity_ = 0;
};

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

/// When the host learns what kernels have counted.
enum class Counting {
  now,   ///< behind the kernel that counts, so that everything gets the room that it needs
  later  ///< at the end of a frame, which trusts in the sizes of the last one, and is made again if they were too small
};

/// What suits the device of the current context: a GPU should not wait between stages; software GL runs each kernel at
/// once, waits for nothing, and is better off with exact sizes than with room.
Counting suitable_counting();

/// Counts of a frame, asked for by those who made them and read together. Needs a current EglContext.
class Readback {
 public:
  /// `words` of `buffer` from `byte_offset` on; they must stay until read().
  void ask(const Buffer& buffer, std::size_t byte_offset, std::span<std::uint32_t> words) {
    pieces_.push_back({buffer.gl_name(), byte_offset, words});
  }
  /// Waits for the GPU, proves its work, and fills in what was asked for. Throws as WorkProof::verify().
  void read() const { WorkProof::current().verify(pieces_); }

 private:
  std::vector<WorkProof::Piece> pieces_;
};

}  // namespace meniscus
