// SPDX-License-Identifier: BSD-3-Clause
// Reads scenes word by word, against lists of the words that this program writes.
#include "app/farm/check_scene.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/farm/bundle.h"
#include "app/farm/inner_path.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/structure/formats/read_structure.h"

namespace meniscus::farm {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = std::size_t{1} << 32;  // of a file of a scene

constexpr std::size_t kLongestText = 200;  // of a string, and of a setting: the matcher recurses by the letter

// Sorted, as those below.
constexpr std::string_view kDirectives[] = {"break", "case",   "declare", "else",  "end",   "error",  "for",    "if",
                                            "ifdef", "ifndef", "include", "local", "macro", "switch", "version"};

// The part of the language that scenes of this program use. No function of strings but concat and str, none of files
// but file_exists and the reader of density files.
constexpr std::string_view kWords[] = {"abs",
                                       "adaptive",
                                       "adc_bailout",
                                       "ambient",
                                       "aoi",
                                       "area_light",
                                       "array",
                                       "assumed_gamma",
                                       "average",
                                       "background",
                                       "blue",
                                       "box",
                                       "boxed",
                                       "brilliance",
                                       "camera",
                                       "circular",
                                       "clipped_by",
                                       "color",
                                       "color_map",
                                       "concat",
                                       "conserve_energy",
                                       "cylinder",
                                       "density_file",
                                       "df3",
                                       "diffuse",
                                       "dimension_size",
                                       "direction",
                                       "emission",
                                       "face_indices",
                                       "fade_color",
                                       "fade_distance",
                                       "fade_power",
                                       "file_exists",
                                       "filter",
                                       "finish",
                                       "floor",
                                       "frame_number",
                                       "fresnel",
                                       "function",
                                       "global_settings",
                                       "gradient",
                                       "green",
                                       "image_height",
                                       "image_width",
                                       "int",
                                       "interior",
                                       "interior_texture",
                                       "interpolate",
                                       "intersection",
                                       "inverse",
                                       "ior",
                                       "light_source",
                                       "location",
                                       "matrix",
                                       "max",
                                       "max_trace_level",
                                       "mesh2",
                                       "min",
                                       "mm_per_unit",
                                       "mod",
                                       "no_shadow",
                                       "normal_vectors",
                                       "object",
                                       "on",
                                       "open",
                                       "orthographic",
                                       "parallel",
                                       "pattern",
                                       "perspective",
                                       "pi",
                                       "pigment",
                                       "pigment_map",
                                       "plane",
                                       "point_at",
                                       "pow",
                                       "radians",
                                       "red",
                                       "reflection",
                                       "rgb",
                                       "rgbt",
                                       "right",
                                       "roughness",
                                       "samples",
                                       "scale",
                                       "select",
                                       "shadowless",
                                       "sin",
                                       "sky_sphere",
                                       "slope",
                                       "specular",
                                       "sphere",
                                       "sqrt",
                                       "srgb",
                                       "str",
                                       "subsurface",
                                       "tan",
                                       "texture",
                                       "texture_list",
                                       "torus",
                                       "transform",
                                       "translate",
                                       "translucency",
                                       "transmit",
                                       "union",
                                       "up",
                                       "vcross",
                                       "vertex_vectors",
                                       "vlength",
                                       "vnormalize",
                                       "x",
                                       "y",
                                       "z"};

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n'; }

template <typename List>
bool has(const List& list, std::string_view word) {
  return std::ranges::binary_search(list, word);
}

// Names of macros' arguments and of what is local; all letters of the language's own words are small.
constexpr std::string_view kNames[] = {"A", "B",    "C",     "Covers", "D",     "Dark",   "E",       "F",      "H",
                                       "I", "Kind", "Last",  "Lets",   "Light", "N",      "Outside", "Passes", "Q",
                                       "R", "S",    "Shown", "Side",   "Step",  "Tinted", "V"};

// Names of our own begin like this; the language has no word that does.
bool is_own_name(std::string_view word) {
  return word.starts_with("Meniscus_") || word.starts_with("object_") || has(kNames, word);
}

/// Names of files in the folder, parts of them, or sentences of error messages: none can be joined to a path out of the
/// folder, or to a file of POV-Ray's library, which has no blanks and nothing that begins with "surface".
bool is_harmless_string(std::string_view text) {
  static const std::regex harmless(R"(surface[A-Za-z0-9_]*(\.inc|\.df3)?|\.inc|([^/\\]|\\n)* ([^/\\]|\\n)*)");
  return text.size() < kLongestText && std::regex_match(text.begin(), text.end(), harmless);
}

/// Goes through a text; each step takes something off its front.
class SceneReader {
 public:
  explicit SceneReader(std::string_view text) : rest_(text) {}

  std::string_view wrong() {
    while (!rest_.empty()) {
      const std::string_view word = next();
      if (!word.empty()) return word;
    }
    return {};
  }

 private:
  std::string_view take(std::size_t count) {
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  template <typename Condition>
  std::string_view take_while(const Condition& condition) {
    return take(static_cast<std::size_t>(std::ranges::find_if_not(rest_, condition) - rest_.begin()));
  }

  /// Takes one piece; gives it back if it is wrong.
  std::string_view next() {
    const char c = rest_.front();
    if (is_blank(c)) return take_while(is_blank), std::string_view{};
    if (rest_.starts_with("//")) return comment();
    if (rest_.starts_with("/*") || rest_.starts_with("*/")) return take(2);
    if (c == '#') return directive();
    if (c == '"') return string();
    if (is_digit(c)) return number();
    if (is_letter(c)) {
      const std::string_view word = identifier();
      return is_own_name(word) || has(kWords, word) ? std::string_view{} : word;
    }
    constexpr std::string_view kSigns = "{}()<>[],;.=+-*/!&|?:";
    return kSigns.find(c) == std::string_view::npos ? take(1) : (take(1), std::string_view{});
  }
  std::string_view identifier() {
    return take_while([](char c) { return is_letter(c) || is_digit(c); });
  }
  // 12, 1.5, 2e-7: an exponent is not the beginning of a word.
  std::string_view number() {
    take_while([](char c) { return is_digit(c) || c == '.'; });
    if (!rest_.empty() && rest_.front() == 'e') {
      take(1);
      if (!rest_.empty() && (rest_.front() == '-' || rest_.front() == '+')) take(1);
      take_while(is_digit);
    }
    return {};
  }
  // Anything but control characters, which might end it for others.
  std::string_view comment() {
    const std::string_view text = take_while([](char c) { return c != '\n'; });
    const auto control = std::ranges::find_if(text, [](unsigned char c) { return c < 0x20 || c == 0x7f; });
    return control == text.end() ? std::string_view{} : text;
  }
  std::string_view directive() {
    const std::string_view begin = rest_;
    take(1);
    take_while(is_blank);
    const std::string_view word = identifier();
    return has(kDirectives, word) ? std::string_view{} : begin.substr(0, 1 + std::max<std::size_t>(word.size(), 20));
  }
  std::string_view string() {
    const std::string_view begin = rest_;
    take(1);
    const std::string_view text = take_while([](unsigned char c) { return c != '"' && c >= 0x20 && c < 0x7f; });
    const bool ends = take(1) == "\"";
    return ends && is_harmless_string(text) ? std::string_view{} : begin.substr(0, text.size() + 2);
  }

  std::string_view rest_;
};

bool is_scene_file(const std::string& name) {
  static const std::regex known(R"(surface[A-Za-z0-9_]*\.(ini|pov|inc|json|df3))");
  // Begun by a worker that was killed; nothing names it.
  const bool unfinished = name.starts_with('.') && name.find(".part") != std::string::npos;
  return unfinished || std::regex_match(name, known);
}

/// For an error message: what is not ASCII might not be text at all.
std::string beginning(std::string_view word) {
  constexpr std::size_t kShown = 60;
  std::string text(word.substr(0, kShown));
  std::ranges::replace_if(
      text, [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
  return text;
}

std::string checked_text(const fs::path& folder, const fs::path& inner, std::string_view (*wrong)(std::string_view)) {
  std::optional<std::string> text = inner_text(folder, inner, kMostBytes);
  const std::string path = (folder / inner).string();
  if (!text) throw InputError(path, 0, "is missing; run the step surface first");
  const std::string_view word = wrong(*text);
  if (!word.empty())
    throw InputError(
        path, 0,
        fmt::format(
            "has {}, which this program does not write; remove scene/ and state/ and run the step surface again",
            in_quotes(beginning(word))));
  return std::move(*text);
}

void write_bytes(const fs::path& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush();
  if (!file) throw OutputError(path.string(), std::string("cannot be written: ") + std::strerror(errno));
}

constexpr const char* kSettings = "surface.ini";
constexpr const char* kShared[] = {"surface.pov", "surface_style.inc", "surface_aov.inc"};

std::string include_name(std::string_view part, std::uint64_t frame) {
  return fmt::format("surface_{}_{}.inc", part, frame_digits(frame));
}

/// Of those that scene/ has; what a frame must have is among them.
std::vector<std::string> includes_of(const fs::path& folder, std::uint64_t frame) {
  std::vector<std::string> parts{"geometry", "colors", "shapes", "caps"}, names;
  for (std::size_t n = 1; n <= kMostShown; ++n) parts.push_back(fmt::format("object_{}", n));
  for (const std::string& part : parts)
    if (const std::string name = include_name(part, frame);
        inner_entry(folder, fs::path("scene") / name) != Entry::nothing)
      names.push_back(name);
  // A frame without a surface has colours of its own.
  const std::string geometry = include_name("geometry", frame), colors = include_name("colors", frame);
  if (std::ranges::find(names, colors) == names.end() && std::ranges::find(names, geometry) == names.end())
    names.push_back(geometry);
  return names;
}

}  // namespace

std::string_view wrong_in_scene(std::string_view text) { return SceneReader(text).wrong(); }

std::string_view wrong_in_settings(std::string_view text) {
  static const std::regex harmless(
      R"(;.*|\[[a-z]+\]|)"
      R"((Width|Height|Initial_Frame|Final_Frame|Subset_(Start|End)_Frame|Frame_Step|Antialias_Depth|Sampling_Method|Bits_Per_Color)=[0-9]+|)"
      R"((Antialias_Threshold|File_Gamma)=[0-9.]+|(Antialias|Display|Output_Alpha)=(On|Off)|Output_File_Type=N|)"
      R"(Declare=Meniscus_[A-Za-z_]+=[0-9]+|Input_File_Name=surface\.pov|Output_File_Name=surface[a-z_]*\.png)");
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const bool fits = line.size() < kLongestText && std::regex_match(line.begin(), line.end(), harmless);
    if (!line.empty() && !fits) return line;
  }
  return {};
}

void check_scene(const fs::path& folder) {
  if (inner_entry(folder, "scene") != Entry::folder)
    throw InputError((folder / "scene").string(), 0, "is missing; run the step surface first");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "scene")) {
    const fs::path inner = fs::path("scene") / entry.path().filename();
    const Entry found = inner_entry(folder, inner);
    if (found == Entry::nothing) continue;  // got its name in the meantime
    if (found != Entry::file || !is_scene_file(entry.path().filename().string()))
      throw InputError(entry.path().string(), 0, "was not written by this program; remove it");
  }
  checked_text(folder, fs::path("scene") / kSettings, wrong_in_settings);
  for (const char* shared : kShared) checked_text(folder, fs::path("scene") / shared, wrong_in_scene);
}

void copy_checked_scene(const fs::path& folder, std::uint64_t frame, const fs::path& to) {
  const fs::path scene("scene");
  const auto copy = [&](const std::string& name, std::string_view (*wrong)(std::string_view)) {
    write_bytes(to / name, checked_text(folder, scene / name, wrong));
  };
  copy(kSettings, wrong_in_settings);
  for (const char* shared : kShared) copy(shared, wrong_in_scene);
  for (const std::string& include : includes_of(folder, frame)) copy(include, wrong_in_scene);
  // Density files hold numbers, whatever is in them. Other frames may have maps of their own.
  const std::string own_map = fmt::format("surface_map_{}.df3", frame_digits(frame));
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / scene)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(".df3") || (name.starts_with("surface_map_") && name != own_map)) continue;
    if (const std::optional<std::string> bytes = inner_text(folder, scene / name, kMostBytes))
      write_bytes(to / name, *bytes);
  }
}

}  // namespace meniscus::farm
