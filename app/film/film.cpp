// SPDX-License-Identifier: BSD-3-Clause
// Chooses the arguments of ffmpeg, passes pictures to it, and checks that the film has all frames.
#include "app/film/film.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/binary_file.h"
#include "core/base/error.h"

namespace meniscus {
namespace {

using Strings = std::vector<std::string>;

/// The transparency of a codec; `on_request`: it is kept only if a film is to be transparent.
enum class Alpha { never, on_request, always };

struct Codec {
  std::string name;
  Strings endings;                 // endings of the containers that hold it
  Strings arguments;               // arguments of ffmpeg
  std::vector<int> bits, chromas;  // the first ones are the defaults
  int rate_factor = 0, worst = 0;  // the default and the largest factor; 0 if the codec has no rate factor
  Alpha alpha = Alpha::never;

  bool keeps_alpha(const FilmFormat& format) const {
    return alpha == Alpha::always || (alpha == Alpha::on_request && format.transparent);
  }
};

const std::vector<Codec>& codecs() {
  static const std::vector<Codec> table{
      {"h264", {".mp4", ".mov", ".mkv"}, {"libx264", "-preset", "medium"}, {8, 10}, {420, 422, 444}, 18, 51},
      // The encoder neither reports on standard error nor writes its version into the stream.
      {"h265",
       {".mp4", ".mov", ".mkv"},
       {"libx265", "-preset", "medium", "-tag:v", "hvc1", "-x265-params", "log-level=error:info=0"},
       {8, 10},
       {420, 422, 444},
       20,
       51},
      {"vp9",
       {".webm", ".mkv"},
       {"libvpx-vp9", "-b:v", "0", "-row-mt", "1"},
       {8, 10},
       {420, 422, 444},
       24,
       63,
       Alpha::on_request},
      {"prores", {".mov", ".mkv"}, {"prores_ks", "-profile:v", "hq"}, {10}, {422}},
      {"prores4444", {".mov", ".mkv"}, {"prores_ks", "-profile:v", "4444"}, {10}, {444}, 0, 0, Alpha::always},
      {"dnxhr", {".mov", ".mkv"}, {"dnxhd", "-profile:v"}, {8, 10}, {422, 444}},
      {"gif", {".gif"}, {"gif"}, {8}, {444}, 0, 0, Alpha::on_request},
  };
  return table;
}

std::string ending_of(const std::string& path) {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(dot);
}

bool holds(const auto& list, const auto& value) { return std::ranges::find(list, value) != list.end(); }

/// Returns the first codec that the container of this name holds and that keeps transparency if it is wanted.
const Codec& codec_of(const std::string& path, const FilmFormat& format) {
  const std::string ending = ending_of(path);
  Strings fitting;
  bool is_opaque = false;
  for (const Codec& codec : codecs()) {
    if (!holds(codec.endings, ending)) continue;
    fitting.push_back(codec.name);
    if (!format.codec.empty() && format.codec != codec.name) continue;
    if (!format.transparent || codec.keeps_alpha(format)) return codec;
    is_opaque = true;
  }
  if (is_opaque)
    throw UsageError(
        "--background transparent: {} keeps no transparency; name a .webm, .mov, .gif or pictures, or "
        "choose a colour, such "
        "as --background white",
        format.codec.empty() ? "a " + ending + " film" : format.codec);
  throw UsageError("--codec {}: {} films hold {}", format.codec, ending, fmt::join(fitting, ", "));
}

/// Returns the requested value if the codec has it; its default if the request is 0.
int chosen(const Codec& codec, const char* option, const std::vector<int>& possible, int requested) {
  if (requested == 0) return possible.front();
  if (holds(possible, requested)) return requested;
  throw UsageError("{} {}: {} has {}", option, requested, codec.name, fmt::join(possible, " or "));
}

int rate_factor_of(const Codec& codec, const FilmFormat& format) {
  const int requested = format.rate_factor.value_or(codec.rate_factor);
  if (codec.worst == 0) throw UsageError("--crf {}: {} has no rate factor", requested, codec.name);
  if (requested < 0 || requested > codec.worst)
    throw UsageError("--crf {}: for {} give 0 (best) to {}", requested, codec.name, codec.worst);
  return requested;
}

/// Returns the profile of DNxHR, which combines bits and chroma; at 8 bits it has no 4:4:4.
std::string profile_of_dnxhr(int bits, int chroma) {
  if (chroma == 444 && bits == 8) throw UsageError("--chroma 444: dnxhr has it with --bits 10 only");
  return chroma == 444 ? "dnxhr_444" : bits == 10 ? "dnxhr_hqx" : "dnxhr_hq";
}

}  // namespace

bool is_film_path(const std::string& path) {
  return std::ranges::any_of(codecs(), [&](const Codec& codec) { return holds(codec.endings, ending_of(path)); });
}

FilmEncoder film_encoder(const std::string& path, const FilmFormat& format) {
  const Codec& codec = codec_of(path, format);
  const bool keeps_alpha = codec.keeps_alpha(format);
  // Encoders with alpha have one pixel format.
  const auto possible = [&](std::vector<int> all) {
    if (keeps_alpha) all.resize(1);
    return all;
  };
  const int bits = chosen(codec, "--bits", possible(codec.bits), format.bits);
  const int chroma = chosen(codec, "--chroma", possible(codec.chromas), format.chroma);
  FilmEncoder encoder;
  Strings& arguments = encoder.arguments;
  const auto append = [&](const Strings& more) { arguments.insert(arguments.end(), more.begin(), more.end()); };
  encoder.pixels = {keeps_alpha ? 4 : 3, bits > 8 ? 2 : 1};
  if (codec.name == "gif") {
    // Each picture has a palette, because one for all would need all of them at once.
    append({"-filter_complex", "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1", "-c:v"});
    append(codec.arguments);
    if (format.rate_factor) rate_factor_of(codec, format);
    return encoder;
  }
  // Players expect BT.709.
  append({"-vf", "scale=out_color_matrix=bt709:out_range=tv", "-c:v"});
  append(codec.arguments);
  if (codec.name == "dnxhr") append({profile_of_dnxhr(bits, chroma)});
  if (codec.name == "vp9" && keeps_alpha) append({"-auto-alt-ref", "0"});  // libvpx has no such frames with alpha
  if (codec.worst > 0 || format.rate_factor) append({"-crf", fmt::format("{}", rate_factor_of(codec, format))});
  append({"-pix_fmt", fmt::format("yuv{}{}p{}", keeps_alpha ? "a" : "", chroma, bits > 8 ? "10le" : ""), "-colorspace",
          "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv"});
  if (ending_of(path) == ".mp4" || ending_of(path) == ".mov") append({"-movflags", "+faststart"});
  encoder.unit = {chroma == 444 ? 1 : 2, chroma == 420 ? 2 : 1};
  if (codec.name == "dnxhr") encoder.least = {256, 120};
  return encoder;
}

std::vector<std::string> film_codec_names() {
  Strings names;
  for (const Codec& codec : codecs()) names.push_back(codec.name);
  return names;
}

namespace {

using Size = std::uint64_t;

/// A box of MP4 or an element of Matroska: its kind, and the range of its content.
struct Part {
  Size kind = 0, begin = 0, end = 0;
};

/// Reads an unsigned big-endian number of up to 8 bytes.
Size number(const BinaryFile& file, Size offset, Size bytes) {
  std::array<std::byte, 8> raw{};
  file.read(offset, std::span(raw).last(bytes));
  Size value = 0;
  for (const std::byte byte : raw) value = value << 8 | std::to_integer<Size>(byte);
  return value;
}

[[noreturn]] void cut_short(Size offset) { throw Error("is cut short at byte {}", offset); }

Part first_of(const std::vector<Part>& parts, Size kind, std::string_view name) {
  const auto found = std::ranges::find(parts, kind, &Part::kind);
  if (found == parts.end()) throw Error("has no {}", name);
  return *found;
}

constexpr Size four_letters(std::string_view name) {
  Size value = 0;
  for (const char letter : name) value = value << 8 | static_cast<unsigned char>(letter);
  return value;
}

std::vector<Part> boxes(const BinaryFile& file, Size begin, Size end) {
  std::vector<Part> found;
  while (begin < end) {
    Size header = 8;
    if (end - begin < header) cut_short(begin);
    Size size = number(file, begin, 4);
    if (size == 1) {  // too large for 32 bits: the size follows
      header = 16;
      if (end - begin < header) cut_short(begin);
      size = number(file, begin + 8, 8);
    }
    if (size < header || size > end - begin) cut_short(begin);
    found.push_back({number(file, begin + 4, 4), begin + header, begin + size});
    begin += size;
  }
  return found;
}

Size pictures_of_mp4(const BinaryFile& file) {
  const std::vector<Part> top = boxes(file, 0, file.size());
  const Part data = first_of(top, four_letters("mdat"), "mdat box");
  Part box = first_of(top, four_letters("moov"), "moov box");
  for (const std::string_view name : {"trak", "mdia", "minf", "stbl", "stsz"})
    box = first_of(boxes(file, box.begin, box.end), four_letters(name), fmt::format("{} box", name));
  constexpr Size kSizes = 12;  // the sizes follow version and flags, the size of all samples or 0, and their count
  if (box.end - box.begin < kSizes) cut_short(box.begin);
  const Size equal = number(file, box.begin + 4, 4), count = number(file, box.begin + 8, 4);
  if (equal == 0 && box.end - box.begin < kSizes + 4 * count) cut_short(box.begin);
  Size bytes = equal * count;
  for (Size n = 0; equal == 0 && n < count; ++n) bytes += number(file, box.begin + kSizes + 4 * n, 4);
  if (bytes > data.end - data.begin) throw Error("lacks {} bytes of its pictures", bytes - (data.end - data.begin));
  return count;
}

/// Returns the elements of EBML (RFC 8794). Leading zero bits give the length of an identifier or a size.
std::vector<Part> elements(const BinaryFile& file, Size begin, Size end) {
  std::vector<Part> found;
  const auto length_at = [&](Size offset, Size longest) {
    const Size length = offset < end ? 1 + std::countl_zero(static_cast<std::uint8_t>(number(file, offset, 1))) : 0;
    if (length == 0 || length > longest || length > end - offset) cut_short(offset);
    return length;
  };
  while (begin < end) {
    const Size id_length = length_at(begin, 4), size_at = begin + id_length, size_length = length_at(size_at, 8);
    const Size unknown = (Size{1} << (7 * size_length)) - 1;
    const Size size = number(file, size_at, size_length) & unknown, content = size_at + size_length;
    if (size == unknown) throw Error("was not finished: the size at byte {} is left open", size_at);
    if (size > end - content) cut_short(begin);
    found.push_back({number(file, begin, id_length), content, content + size});
    begin = content + size;
  }
  return found;
}

Size pictures_of_matroska(const BinaryFile& file) {
  constexpr Size kSegment = 0x18538067, kCluster = 0x1f43b675, kCues = 0x1c53bb6b;
  constexpr Size kSimpleBlock = 0xa3, kBlockGroup = 0xa0;
  const Part segment = first_of(elements(file, 0, file.size()), kSegment, "segment");
  const std::vector<Part> parts = elements(file, segment.begin, segment.end);
  first_of(parts, kCues, "cues");
  Size count = 0;
  for (const Part& part : parts) {
    if (part.kind != kCluster) continue;
    count += std::ranges::count_if(elements(file, part.begin, part.end), [](const Part& block) {
      return block.kind == kSimpleBlock || block.kind == kBlockGroup;
    });
  }
  return count;
}

/// Returns the end of a block's data: pieces of up to 255 bytes, each after its length; a piece of 0 bytes ends them.
Size end_of_pieces(const BinaryFile& file, Size at) {
  while (at < file.size()) {
    const Size length = number(file, at, 1);
    at += 1 + length;
    if (length == 0) return at;
  }
  cut_short(file.size());
}

Size pictures_of_gif(const BinaryFile& file) {
  constexpr Size kHeader = 13, kDescriptor = 10, kExtension = 0x21, kPicture = 0x2c, kTrailer = 0x3b;
  // The lowest bits of the flags are one less than the binary logarithm of the number of colours.
  const auto palette = [](Size flags) { return (flags & 0x80) != 0 ? Size{3} << ((flags & 7) + 1) : 0; };
  if (file.size() < kHeader) cut_short(file.size());
  Size at = kHeader + palette(number(file, 10, 1)), count = 0;
  while (at < file.size()) {
    const Size kind = number(file, at, 1);
    if (kind == kTrailer) {
      if (at + 1 != file.size()) throw Error("continues after its end at byte {}", at);
      return count;
    }
    if (kind == kExtension) {
      at = end_of_pieces(file, at + 2);
    } else if (kind == kPicture) {
      if (file.size() - at < kDescriptor) cut_short(at);
      at = end_of_pieces(file, at + kDescriptor + palette(number(file, at + 9, 1)) + 1);
      ++count;
    } else {
      throw Error("has no block at byte {}", at);
    }
  }
  cut_short(file.size());
}

std::string pixel_format(const FilmPixels& pixels) {
  return fmt::format("rgb{}{}", pixels.channels == 4 ? "a" : "",
                     pixels.bytes == 2 ? (pixels.channels == 4 ? "64le" : "48le") : (pixels.channels == 4 ? "" : "24"));
}

std::vector<std::string> arguments(const FilmEncoder& encoder, const std::string& output, glm::ivec2 size,
                                   double frames_per_second) {
  std::vector<std::string> words{"ffmpeg", "-hide_banner", "-loglevel", "error", "-xerror", "-y",
                                 // The pictures have no container.
                                 "-f", "rawvideo", "-pixel_format", pixel_format(encoder.pixels), "-video_size",
                                 fmt::format("{}x{}", size.x, size.y), "-framerate",
                                 fmt::format("{}", frames_per_second), "-i", "pipe:0"};
  words.insert(words.end(), encoder.arguments.begin(), encoder.arguments.end());
  // The film contains no names, dates or versions.
  words.insert(words.end(), {"-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1", output});
  return words;
}

std::string in_one_line(std::string_view text) {
  std::string line(text.substr(0, text.find_last_not_of(" \r\n") + 1));
  std::ranges::replace(line, '\n', ';');
  return line;
}

}  // namespace

std::string film_fault(const std::filesystem::path& path, std::uint64_t pictures) {
  try {
    const BinaryFile file(path.string());
    const auto ending = path.extension();
    const Size found = ending == ".gif"                        ? pictures_of_gif(file)
                       : ending == ".mkv" || ending == ".webm" ? pictures_of_matroska(file)
                                                               : pictures_of_mp4(file);
    return found == pictures ? "" : fmt::format("holds {} of {} pictures", found, pictures);
  } catch (const Error& error) {
    return error.what();
  }
}

void check_film_size(const FilmEncoder& encoder, glm::ivec2 size) {
  if (size.x < encoder.least.x || size.y < encoder.least.y)
    throw UsageError("--size {}x{}: a film of this codec has at least {}x{}", size.x, size.y, encoder.least.x,
                     encoder.least.y);
  if (size.x % encoder.unit.x == 0 && size.y % encoder.unit.y == 0) return;
  throw UsageError("--size {}x{}: this film needs {}; one with --chroma 444 does not", size.x, size.y,
                   encoder.unit.y == 1 ? "an even width" : "even numbers");
}

FilmWriter::FilmWriter(const std::string& path, Existing existing, glm::ivec2 size, double frames_per_second,
                       const FilmFormat& format)
    : file_(path, existing) {
  const FilmEncoder encoder = film_encoder(path, format);
  pixels_ = encoder.pixels;
  check_film_size(encoder, size);
  try {
    encoder_.emplace(arguments(encoder, file_.temporary_path().string(), size, frames_per_second));
  } catch (const Error& error) {
    throw OutputError(path, "films need the program ffmpeg, which {}; install it, or write pictures: frame_#####.png",
                      error.what());
  }
}

/// Returns why the film failed; on a full disk ffmpeg may end with 0, and reports the fault on standard error only.
std::string FilmWriter::fault() {
  const int code = encoder_->finish();
  const std::string said = in_one_line(encoder_->complaints());
  if (!said.empty()) return "ffmpeg failed: " + said;
  if (code > kSignalCode) return fmt::format("ffmpeg was ended by signal {}", code - kSignalCode);
  if (code != 0) return fmt::format("ffmpeg failed with exit code {}", code);
  const std::string broken = film_fault(file_.temporary_path(), added_);
  return broken.empty() ? "" : fmt::format("ffmpeg reported no error, but its file {}", broken);
}

void FilmWriter::add(std::span<const std::uint8_t> picture) {
  if (!encoder_->feed(picture)) {
    const std::string why = fault();
    throw OutputError(file_.target().string(), why.empty() ? "ffmpeg stopped reading pictures" : why);
  }
  ++added_;
}

void FilmWriter::finish() {
  if (const std::string why = fault(); !why.empty()) throw OutputError(file_.target().string(), why);
  file_.commit();
}

}  // namespace meniscus
