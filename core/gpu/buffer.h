// SPDX-License-Identifier: BSD-3-Clause
// GPU memory: buffers that kernels read and write or fetch as texels, and reads of words from several buffers at once.
#pragma once

#include <type_traits>
#include <vector>

#include "core/gpu/work_proof.h"

namespace meniscus {

/// A storage buffer. Its memory is undefined until it is written. A GL context must be current.
class Buffer {
 public:
  Buffer() = default;
  /// Throws CapacityError when the driver is out of memory.
  explicit Buffer(std::size_t byte_count) { resize(byte_count); }
  template <typename T>
  explicit Buffer(std::span<const T> values) {
    upload(values);
  }
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;

  /// Makes room for `byte_count` bytes. Keeps the memory if it is large enough; otherwise the content is lost. A buffer
  /// that grows gets some spare room, so that sizes that vary from frame to frame settle.
  void resize(std::size_t byte_count);
  /// Makes room like resize(), but keeps the content.
  void grow(std::size_t byte_count);
  std::size_t byte_count() const { return byte_count_; }

  /// Resizes the buffer to the values and copies them.
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
  /// Returns `count` values of type T from `byte_offset` on; waits for kernels to end. Throws GpuError if one of them
  /// did not finish (work_proof.h).
  template <typename T>
  std::vector<T> download(std::size_t count, std::size_t byte_offset = 0) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(count);
    read(byte_offset, values.data(), count * sizeof(T));
    return values;
  }
  /// Copies into existing memory; otherwise like the function above.
  template <typename T>
  void download(std::span<T> values, std::size_t byte_offset = 0) const {
    read(byte_offset, values.data(), values.size_bytes());
  }
  /// Copies bytes of `source` from `byte_offset` on to the offset `to`, on the GPU.
  void copy(const Buffer& source, std::size_t byte_offset, std::size_t to, std::size_t byte_count);
  /// Sets every 4-byte word to `word`.
  void fill(std::uint32_t word);

  /// Binds the buffer as `layout(std430, binding = N)` of kernels. Throws CapacityError if it is larger than a kernel
  /// can see.
  void bind(std::uint32_t binding) const;
  /// Returns the GL name, for dispatch_indirect().
  std::uint32_t gl_name() const { return name_; }
  /// Returns a number for the buffer's memory: a new one after each allocation, 0 for none. GL names are reused.
  std::uint64_t memory() const { return memory_; }

  void write(std::size_t byte_offset, const void* bytes, std::size_t byte_count);
  void read(std::size_t byte_offset, void* bytes, std::size_t byte_count) const;

 private:
  std::uint32_t name_ = 0;
  std::uint64_t memory_ = 0;
  std::size_t byte_count_ = 0;  ///< the requested size
  std::size_t capacity_ = 0;
};

/// The format of one texel. Kernels read both formats as a usamplerBuffer, so that all bits of a float are preserved.
enum class TexelFormat { uint1, uint4 };

/// A buffer texture. A GL context must be current.
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

  /// Shows the contents of a storage buffer, which must outlive the use of this view; call it again whenever that
  /// buffer was resized. Throws CapacityError like upload().
  void view(const Buffer& storage);

  /// Binds the texture as `layout(binding = N) uniform usamplerBuffer` of kernels.
  void bind(std::uint32_t unit) const;

 private:
  void upload_bytes(std::span<const std::byte> bytes);
  void attach(const Buffer& storage);

  TexelFormat format_;
  Buffer buffer_;
  std::uint32_t texture_ = 0;
  std::uint64_t shown_ = 0;  ///< Buffer::memory()
};

/// The time at which the host reads the counts of kernels.
enum class Counting {
  now,   ///< right after the kernel that counts, so that each buffer gets exactly the room that it needs
  later  ///< at the end of a frame, which assumes the sizes of the last frame and is repeated if they were too small
};

/// Returns the faster choice for the device of the current context. A GPU should not wait between stages; software GL
/// runs each kernel at once, waits for nothing, and is faster with exact sizes.
Counting suitable_counting();

/// Counts of a frame, registered by the code that made them and read together. An EglContext must be current.
class Readback {
 public:
  /// Registers `words` of `buffer` from `byte_offset` on; the span must stay valid until read().
  void request(const Buffer& buffer, std::size_t byte_offset, std::span<std::uint32_t> words) {
    pieces_.push_back({buffer.gl_name(), byte_offset, words});
  }
  /// Waits for the GPU, verifies its work, and fills the registered words. Throws like WorkProof::verify().
  void read() const { WorkProof::current().verify(pieces_); }

 private:
  std::vector<WorkProof::Piece> pieces_;
};

}  // namespace meniscus
