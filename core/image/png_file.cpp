// SPDX-License-Identifier: BSD-3-Clause
// Filters and compresses the rows of PNG files in chunks on all threads, and reads and writes their texts.
#include "core/image/png_file.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fstream>
#include <limits>

#include <libdeflate.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <zlib.h>

#include "core/base/error.h"
#include "core/math/vector_loops.h"

namespace meniscus {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr int kUsualLevel = 4;  // takes half the time of 6, with files three per cent larger

/// Returns a part of a stream in zlib's format that ends at a whole byte; matches may refer to `before`, too. It uses
/// zlib, because libdeflate makes only whole streams.
Bytes compressed_part(std::span<const std::uint8_t> part, std::span<const std::uint8_t> before, bool is_last,
                      int level) {
  constexpr int kNoHeader = -15, kMostMemory = 9;
  z_stream stream{};
  if (::deflateInit2(&stream, level, Z_DEFLATED, kNoHeader, kMostMemory, Z_DEFAULT_STRATEGY) != Z_OK)
    throw CapacityError("not enough memory to compress a picture");
  const std::unique_ptr<z_stream, decltype(&::deflateEnd)> end(&stream, &::deflateEnd);
  if (!before.empty()) ::deflateSetDictionary(&stream, before.data(), static_cast<uInt>(before.size()));
  constexpr std::size_t kMarker = 16;  // marker at the end of the part
  Bytes result(::deflateBound(&stream, static_cast<uLong>(part.size())) + kMarker);
  stream.next_in = const_cast<std::uint8_t*>(part.data());  // zlib only reads it
  stream.avail_in = static_cast<uInt>(part.size());
  stream.next_out = result.data();
  stream.avail_out = static_cast<uInt>(result.size());
  ::deflate(&stream, is_last ? Z_FINISH : Z_SYNC_FLUSH);
  assert(stream.avail_in == 0 && stream.avail_out > 0);
  result.resize(result.size() - stream.avail_out);
  return result;
}

}  // namespace

Bytes zlib_stream(std::span<const std::byte> bytes, int level) {
  const std::unique_ptr<libdeflate_compressor, decltype(&::libdeflate_free_compressor)> compressor(
      ::libdeflate_alloc_compressor(level), &::libdeflate_free_compressor);
  if (!compressor) throw CapacityError("not enough memory to compress a file");
  Bytes result(::libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
  result.resize(::libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), result.data(), result.size()));
  return result;
}

void add_word(Bytes& bytes, std::uint32_t word) {
  for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

void add_chunk(Bytes& file, std::string_view type, std::span<const std::uint8_t> content) {
  add_word(file, static_cast<std::uint32_t>(content.size()));
  const std::size_t first = file.size();
  file.insert(file.end(), type.begin(), type.end());
  file.insert(file.end(), content.begin(), content.end());
  add_word(file, ::libdeflate_crc32(0, &file[first], file.size() - first));
}

PngStream::PngStream(const Write& write, std::size_t size, std::size_t together, int level)
    : write_(write), in_pieces_(size > together), level_(level < 0 ? kUsualLevel : level) {
  rows_.reserve(in_pieces_ ? kPiece : size);
  // The header: a window of 32 KiB, and the level.
  if (in_pieces_) add_chunks(Bytes{0x78, 0x9c});
}

std::span<std::uint8_t> PngStream::room(std::size_t size) {
  write_pieces();
  rows_.resize(rows_.size() + size);
  return std::span(rows_).last(size);
}

void PngStream::finish() {
  if (!in_pieces_) return add_chunks(zlib_stream(std::as_bytes(std::span(rows_)), level_));
  write_pieces();
  write_piece(rows_.size(), true);
  Bytes sum;
  add_word(sum, sum_);
  add_chunks(sum);
}

void PngStream::write_pieces() {
  while (in_pieces_ && rows_.size() >= kPiece) write_piece(kPiece, false);
}

void PngStream::write_piece(std::size_t size, bool is_last) {
  const std::span<const std::uint8_t> piece = std::span(rows_).first(size);
  sum_ = ::libdeflate_adler32(sum_, piece.data(), size);
  std::vector<Bytes> parts(std::max<std::size_t>((size + kPart - 1) / kPart, 1));
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t n) {
    const std::size_t first = n * kPart;
    const std::span<const std::uint8_t> before =
        n == 0 ? std::span<const std::uint8_t>(before_) : piece.subspan(first - kWindow, kWindow);
    parts[n] = compressed_part(piece.subspan(first, std::min(kPart, size - first)), before,
                               is_last && n + 1 == parts.size(), level_);
  });
  for (const Bytes& part : parts) add_chunks(part);
  if (size >= kWindow) before_.assign(piece.end() - kWindow, piece.end());
  rows_.erase(rows_.begin(), rows_.begin() + static_cast<std::ptrdiff_t>(size));
}

void PngStream::add_chunks(std::span<const std::uint8_t> stream) {
  constexpr std::size_t kChunk = 8192;
  Bytes chunks;
  for (std::size_t first = 0; first < stream.size(); first += kChunk)
    add_chunk(chunks, "IDAT", stream.subspan(first, std::min(kChunk, stream.size() - first)));
  write_(chunks);
}

namespace {

void add_text(Bytes& bytes, std::string_view text) { bytes.insert(bytes.end(), text.begin(), text.end()); }

void add_note(Bytes& file, std::string_view key, std::string_view text) {
  Bytes content;
  add_text(content, key);
  content.push_back(0);
  add_text(content, text);
  add_chunk(file, "tEXt", content);
}

/// Appends Unicode text (iTXt, section 11.3.4.5), uncompressed, without a language.
void add_unicode_note(Bytes& file, std::string_view key, std::string_view text) {
  Bytes content;
  add_text(content, key);
  content.insert(content.end(), 5, 0);  // end of the key, no compression, its method, no language, no translated key
  add_text(content, text);
  add_chunk(file, "iTXt", content);
}

/// Appends the printed size of a pixel.
void add_resolution(Bytes& file, double dots_per_inch) {
  constexpr double kMetersPerInch = 0.0254;
  const auto per_meter = static_cast<std::uint32_t>(std::lround(dots_per_inch / kMetersPerInch));
  Bytes content;
  add_word(content, per_meter);
  add_word(content, per_meter);
  content.push_back(1);  // the unit is the metre
  add_chunk(file, "pHYs", content);
}

/// Appends the sizes, then the meaning of sRGB: its gamma and primaries.
void add_header(Bytes& file, const ImageToEncode& image) {
  constexpr std::array<std::uint8_t, 5> kColorType{0, 0, 4, 2, 6};  // one for each number of channels
  Bytes header;
  add_word(header, static_cast<std::uint32_t>(image.width));
  add_word(header, static_cast<std::uint32_t>(image.height));
  for (const std::uint8_t byte :
       {std::uint8_t{8}, kColorType[image.channels.size()], std::uint8_t{0}, std::uint8_t{0}, std::uint8_t{0}})
    header.push_back(byte);
  add_chunk(file, "IHDR", header);
  Bytes gamma, primaries;
  add_word(gamma, 45455);
  for (const std::uint32_t word : {31270u, 32900u, 64000u, 33000u, 30000u, 60000u, 15000u, 6000u})
    add_word(primaries, word);
  add_chunk(file, "gAMA", gamma);
  add_chunk(file, "sRGB", Bytes{3});  // absolute colorimetric
  add_chunk(file, "cHRM", primaries);
  add_chunk(file, "oFFs", Bytes(9, 0));
}

/// Returns a filter's prediction of a byte from the bytes at the left, above, and above at the left (section 9.2). It
/// uses 16 bits and no branches, so that compilers vectorize the loop.
template <int filter>
std::int16_t predicted(std::int16_t left, std::int16_t above, std::int16_t corner) {
  if constexpr (filter == 0) return 0;
  if constexpr (filter == 1) return left;
  if constexpr (filter == 2) return above;
  if constexpr (filter == 3) return static_cast<std::int16_t>((left + above) / 2);
  const auto size = [](int difference) { return static_cast<std::int16_t>(difference < 0 ? -difference : difference); };
  const std::int16_t to_left = size(above - corner), to_above = size(left - corner);
  const std::int16_t to_corner = size(left + above - 2 * corner);
  const std::int16_t other = to_above <= to_corner ? above : corner;
  return ((to_left <= to_above) & (to_left <= to_corner)) ? left : other;
}

/// Returns the sum of the absolute values of bytes that encode -128 to 127.
std::size_t sum_of_differences(const Bytes& bytes) {
  constexpr std::size_t kTogether = 1 << 16;  // a sum of this many fits into 32 bits
  std::size_t sum = 0;
  for (std::size_t first = 0; first < bytes.size(); first += kTogether) {
    std::uint32_t part = 0;
    const std::size_t end = std::min(first + kTogether, bytes.size());
    for (std::size_t n = first; n < end; ++n)
      part += std::min(bytes[n], static_cast<std::uint8_t>(256u - bytes[n]));  // 0 wraps to 0
    sum += part;
  }
  return sum;
}

/// One row of a picture and the row above it.
struct Row {
  const std::uint8_t* bytes;
  const std::uint8_t* above;
  std::size_t size, pixel;  // bytes
};

/// Takes the row by value, because written bytes might otherwise alias it.
template <int filter>
void write_filtered(const Row row, std::uint8_t* out) {
  for (std::size_t n = 0; n < row.pixel; ++n)
    out[n] = static_cast<std::uint8_t>(row.bytes[n] - predicted<filter>(0, row.above[n], 0));
  MENISCUS_INDEPENDENT_STEPS
  for (std::size_t n = row.pixel; n < row.size; ++n)
    out[n] = static_cast<std::uint8_t>(
        row.bytes[n] - predicted<filter>(row.bytes[n - row.pixel], row.above[n], row.above[n - row.pixel]));
}

MENISCUS_VECTOR_CLONES
void write_filtered(const Row& row, int filter, std::uint8_t* out) {
  switch (filter) {
    case 0:
      return write_filtered<0>(row, out);
    case 1:
      return write_filtered<1>(row, out);
    case 2:
      return write_filtered<2>(row, out);
    case 3:
      return write_filtered<3>(row, out);
    default:
      return write_filtered<4>(row, out);
  }
}

/// Writes the number and the output of the filter with the smallest sum of absolute differences (section 12.8).
void write_best(const Row& row, std::uint8_t* out, Bytes& trial, bool averages) {
  constexpr int kFilters = 5;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (int filter = 0; filter < kFilters && least > 0; ++filter) {
    if (filter == 3 && !averages) continue;
    write_filtered(row, filter, trial.data());
    const std::size_t sum = sum_of_differences(trial);
    if (sum >= least) continue;
    least = sum;
    out[0] = static_cast<std::uint8_t>(filter);
    std::ranges::copy(trial, out + 1);
  }
}

Bytes header(const ImageToEncode& image) {
  Bytes file{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  add_header(file, image);
  add_note(file, "oiio:ColorSpace", image.color_space);
  if (image.dots_per_inch > 0.0) add_resolution(file, image.dots_per_inch);
  if (!image.software.empty()) add_note(file, "Software", image.software);
  if (!image.command.empty()) add_unicode_note(file, "Description", image.command);
  if (!image.scene.empty()) add_unicode_note(file, kSceneNote, image.scene);
  if (!image.made_of.empty()) add_unicode_note(file, kMadeOfNote, image.made_of);
  return file;
}

}  // namespace

PngEncoder::PngEncoder(const ImageToEncode& image, Write write, std::size_t together)
    : write_(std::move(write)),
      pixel_(image.channels.size()),
      row_size_(pixel_ * static_cast<std::size_t>(image.width)),
      averages_(image.width > 1 && image.height > 1),  // like libpng, which does not use it for single rows and columns
      last_row_(row_size_) {
  write_(header(image));
  const std::size_t size = (row_size_ + 1) * static_cast<std::size_t>(image.height);
  stream_ = std::make_unique<PngStream>(write_, size, together, image.png_level);
}

PngEncoder::~PngEncoder() = default;

void PngEncoder::add(std::span<const std::uint8_t> rows, int byte_stride) {
  const auto stride = static_cast<std::size_t>(byte_stride);
  if (stride == pixel_) return filter(rows);
  Bytes packed(rows.size() / stride * pixel_);
  for (std::size_t from = 0, to = 0; to < packed.size(); from += stride, to += pixel_)
    std::copy_n(&rows[from], pixel_, &packed[to]);
  filter(packed);
}

void PngEncoder::filter(std::span<const std::uint8_t> rows) {
  if (rows.empty()) return;
  const std::size_t count = rows.size() / row_size_;
  const std::span<std::uint8_t> filtered = stream_->room(count * (row_size_ + 1));
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
    Bytes trial(row_size_);
    for (std::size_t y = range.begin(); y < range.end(); ++y) {
      const std::uint8_t* const first = &rows[y * row_size_];
      write_best({first, y > 0 ? first - row_size_ : last_row_.data(), row_size_, pixel_},
                 &filtered[y * (row_size_ + 1)], trial, averages_);
    }
  });
  std::ranges::copy(rows.last(row_size_), last_row_.begin());
}

void PngEncoder::finish() {
  stream_->finish();
  Bytes end;
  add_chunk(end, "IEND", Bytes{});
  write_(end);
}

std::vector<std::uint8_t> encode_png(const ImageToEncode& image, std::span<const std::uint8_t> pixels,
                                     int byte_stride) {
  Bytes file;
  PngEncoder encoder(image,
                     [&](std::span<const std::uint8_t> bytes) { file.insert(file.end(), bytes.begin(), bytes.end()); });
  encoder.add(pixels, byte_stride);
  encoder.finish();
  return file;
}

namespace {

constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view kLastChunk("\0\0\0\0IEND\xae\x42\x60\x82", 12);
constexpr std::uint32_t kLongestNote = 16u << 20;

std::uint32_t word_at(const char* bytes) {
  std::uint32_t word = 0;
  for (int n = 0; n < 4; ++n) word = word << 8 | static_cast<unsigned char>(bytes[n]);
  return word;
}

}  // namespace

bool is_png(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 8> head{};
  return file.read(head.data(), head.size()) && std::string_view(head.data(), head.size()) == kSignature;
}

std::optional<std::string> png_note(const std::filesystem::path& path, std::string_view key) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 8> head{};
  if (!file.read(head.data(), head.size()) || std::string_view(head.data(), head.size()) != kSignature) return {};
  // Returns key, its end, compression, its method, and the ends of language and translated key.
  std::string start(key);
  start.append(5, '\0');
  while (file.read(head.data(), head.size())) {
    const std::uint32_t length = word_at(head.data());
    const std::string_view kind(head.data() + 4, 4);
    if (kind == "IDAT" || kind == "IEND") return {};  // our texts come before the pixels
    if (kind == "iTXt" && length <= kLongestNote) {
      std::string content(length, '\0');
      if (!file.read(content.data(), length)) return {};
      if (content.starts_with(start)) return content.substr(start.size());
      file.seekg(4, std::ios::cur);
    } else {
      file.seekg(static_cast<std::streamoff>(length) + 4, std::ios::cur);
    }
  }
  return {};
}

bool ends_as_png(const std::filesystem::path& path) {
  std::string end(kLastChunk.size(), '\0');
  std::ifstream file(path, std::ios::binary);
  file.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  return file.read(end.data(), static_cast<std::streamsize>(end.size())) && end == kLastChunk;
}

std::optional<std::string> png_without_time(std::string_view file) {
  constexpr std::array<std::string_view, 4> kDropped{"tIME", "tEXt", "zTXt", "iTXt"};
  constexpr std::size_t kAround = 12;  // bytes of a chunk in addition to its data: length, type, CRC
  if (!file.starts_with(kSignature)) return {};
  std::string result(kSignature);
  file.remove_prefix(kSignature.size());
  for (std::string_view type; type != "IEND";) {
    if (file.size() < kAround) return {};
    const std::size_t size = kAround + word_at(file.data());
    if (file.size() < size) return {};
    type = file.substr(4, 4);
    if (std::ranges::find(kDropped, type) == kDropped.end()) result.append(file.substr(0, size));
    file.remove_prefix(size);
  }
  return result;
}

}  // namespace meniscus
