// SPDX-License-Identifier: BSD-3-Clause
// The table of codecs, with the limits of ffmpeg's encoders of the same names, as Debian builds them.
#include "app/film/film_format.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/process/program_error.h"

namespace meniscus {
namespace {

using Strings = std::vector<std::string>;

/// Says when a codec keeps transparency: `asked` means only where a film is to be transparent.
enum class Alpha { never, asked, always };

struct Codec {
  std::string name;
  Strings endings;                 // endings of the containers that hold it
  Strings arguments;               // arguments of ffmpeg
  std::vector<int> bits, chromas;  // the first is its own choice
  int rate_factor = 0, worst = 0;  // its own choice, and the largest; 0 if the codec has no rate factor
  Alpha alpha = Alpha::never;

  bool keeps_alpha(const FilmFormat& format) const {
    return alpha == Alpha::always || (alpha == Alpha::asked && format.transparent);
  }
};

const std::vector<Codec>& codecs() {
  static const std::vector<Codec> table{
      {"h264", {".mp4", ".mov", ".mkv"}, {"libx264", "-preset", "medium"}, {8, 10}, {420, 422, 444}, 18, 51},
      // The encoder does not report on standard error, nor write its version into the stream.
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
       Alpha::asked},
      {"prores", {".mov", ".mkv"}, {"prores_ks", "-profile:v", "hq"}, {10}, {422}},
      {"prores4444", {".mov", ".mkv"}, {"prores_ks", "-profile:v", "4444"}, {10}, {444}, 0, 0, Alpha::always},
      {"dnxhr", {".mov", ".mkv"}, {"dnxhd", "-profile:v"}, {8, 10}, {422, 444}},
      {"gif", {".gif"}, {"gif"}, {8}, {444}, 0, 0, Alpha::asked},
  };
  return table;
}

std::string ending_of(const std::string& path) {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(dot);
}

bool holds(const auto& list, const auto& value) { return std::ranges::find(list, value) != list.end(); }

/// Returns the first codec that the container of this name holds and that keeps transparency where it is wanted.
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
        fmt::format("--background transparent: {} keeps no transparency; name a .webm, .mov, .gif or pictures, or "
                    "choose a colour, such "
                    "as --background white",
                    format.codec.empty() ? "a " + ending + " film" : format.codec));
  throw UsageError(fmt::format("--codec {}: {} films hold {}", format.codec, ending, fmt::join(fitting, ", ")));
}

/// Returns the requested value if the codec has it; its own choice if the request is 0.
int chosen(const Codec& codec, const char* option, const std::vector<int>& possible, int asked) {
  if (asked == 0) return possible.front();
  if (holds(possible, asked)) return asked;
  throw UsageError(fmt::format("{} {}: {} has {}", option, asked, codec.name, fmt::join(possible, " or ")));
}

int rate_factor_of(const Codec& codec, const FilmFormat& format) {
  const int asked = format.rate_factor.value_or(codec.rate_factor);
  if (codec.worst == 0) throw UsageError(fmt::format("--crf {}: {} has no rate factor", asked, codec.name));
  if (asked < 0 || asked > codec.worst)
    throw UsageError(fmt::format("--crf {}: for {} give 0 (best) to {}", asked, codec.name, codec.worst));
  return asked;
}

/// DNxHR names bits and chroma together; at 8 bits it has no 4:4:4.
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
    // A palette a picture: one for all would need all of them at once.
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

}  // namespace meniscus
