// SPDX-License-Identifier: BSD-3-Clause
// The lists, and the one way to read words by them.
#include "app/farm/command_options.h"

#include <algorithm>
#include <map>
#include <regex>
#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"

namespace meniscus::farm {
namespace {

using Words = std::vector<std::string>;

enum class Value {
  none,
  text,       ///< one word that names no file
  file,       ///< one word: a file to read
  maybe_text  ///< one word, or none
};

constexpr std::size_t kLongestWord = 100;  // the matcher recurses by the letter

using Options = std::map<std::string_view, Value>;

const Options& command_table() {
  static const Options table{
      // atoms
      {"--model", Value::text},
      {"--altloc", Value::text},
      {"--select", Value::text},
      {"--show", Value::text},
      {"--keep-water", Value::none},
      {"--keep-ions", Value::none},
      {"--unknown-element", Value::text},
      {"--hydrogens", Value::text},
      {"--radii", Value::text},
      {"--radii-file", Value::file},
      {"--radius", Value::text},
      {"--warnings", Value::text},
      {"-q", Value::none},
      {"--quiet", Value::none},
      {"--assembly", Value::text},
      {"--instances", Value::text},
      // surface
      {"--surface", Value::text},
      {"--probe", Value::text},
      {"--verify", Value::none},
      {"--by", Value::text},
      {"--interface", Value::text},
      {"--cavities", Value::text},
      {"--tolerance", Value::text},
      {"--tolerance-pixels", Value::text},
      // colour and look
      {"--color", Value::text},
      {"--color-by-file", Value::file},
      {"--color-column", Value::text},
      {"--color-map-file", Value::file},
      {"--map-offset", Value::text},
      {"--color-title", Value::text},
      {"--color-unit", Value::text},
      {"--map", Value::text},
      {"--map-file", Value::file},
      {"--color-range", Value::text},
      {"--missing-color", Value::text},
      {"--opacity", Value::text},
      {"--film-opacity", Value::none},
      {"--object", Value::text},
      {"--hide-surface", Value::none},
      {"--clip", Value::text},
      {"--cap-color", Value::text},
      {"--cap-hatching", Value::text},
      {"--sticks", Value::text},
      {"--balls", Value::text},
      {"--spheres", Value::text},
      {"--stick-radius", Value::text},
      {"--preset", Value::text},
      {"--tube", Value::text},
      {"--tube-radius", Value::text},
      {"--light", Value::text},
      {"--light-strength", Value::text},
      {"--ambient-occlusion", Value::text},
      {"--ambient-occlusion-radius", Value::text},
      {"--silhouettes", Value::text},
      {"--outer-lines", Value::text},
      {"--inner-lines", Value::text},
      {"--part-lines", Value::text},
      {"--ambient", Value::text},
      {"--roughness", Value::text},
      {"--specular", Value::text},
      {"--shininess", Value::text},
      {"--linear-alpha", Value::none},
      {"--depth-cue", Value::text},
      {"--material", Value::text},
      {"--comments", Value::none},
      // picture
      {"--size", Value::text},
      {"--dpi", Value::text},
      {"--width", Value::text},
      {"--height", Value::text},
      {"--provenance", Value::none},
      {"--no-provenance", Value::none},
      {"--camera", Value::file},
      {"--projection", Value::text},
      {"--view", Value::text},
      {"--turn", Value::text},
      {"--zoom-to", Value::text},
      {"--samples", Value::text},
      {"--background", Value::text},
      {"--legend", Value::none},
      {"--legend-title", Value::text},
      {"--legend-size", Value::text},
      {"--legend-place", Value::text},
      {"--panel", Value::text},
      {"--scale-bar", Value::maybe_text},
      {"--label", Value::text},
      {"--time-stamp", Value::none},
      {"--curve", Value::file},
      {"--curve-column", Value::text},
      {"--extent", Value::text},
      // frames
      {"--trajectory", Value::file},
      {"--trajectory-atoms", Value::text},
      {"--trust-atom-order", Value::none},
      {"--repeat", Value::text},
      {"--frames", Value::text},
      {"--stride", Value::text},
      {"--begin", Value::text},
      {"--end", Value::text},
      {"--select-once", Value::none},
      {"--whole", Value::maybe_text},
      {"--superpose", Value::text},
      {"--center", Value::text},
      {"--reference", Value::text},
      {"--smooth", Value::text},
      {"--camera-path", Value::file},
      {"--turntable", Value::text},
      {"--follow", Value::text},
      {"--fps", Value::text},
  };
  return table;
}

const Options& device_table() {
  static const Options table{
      {"--device", Value::text}, {"--threads", Value::text}, {"--require-gpu", Value::none}, {"--jobs", Value::text}};
  return table;
}

const Options& blender_table() {
  static const Options table{{"--mode", Value::text},       {"--motion-blur", Value::text}, {"--size", Value::text},
                             {"--scale", Value::text},      {"--samples", Value::text},     {"--style", Value::text},
                             {"--transparent", Value::none}};
  return table;
}

// --light 1 2 3 is the same as --light 1,2,3.
bool has_three_numbers(std::string_view value) { return std::ranges::count(value, ',') >= 2; }

class Reader {
 public:
  Reader(const Words& words, const Options& table) : words_(words), table_(table) {}

  std::vector<CommandOption> read() {
    std::vector<CommandOption> options;
    while (next_ < words_.size()) options.push_back(option());
    return options;
  }

 private:
  CommandOption option() {
    const std::string& word = words_[next_];
    const std::size_t equals = word.find('=');
    CommandOption option;
    option.name = word.substr(0, equals);
    option.place = next_++;
    const auto known = table_.find(option.name);
    if (known == table_.end())
      throw RequestError(fmt::format("{} is no option that a bundle may have{}", in_quotes(word),
                                     word.starts_with('-') ? "" : "; name trajectories by --trajectory"));
    option.reads_file = known->second == Value::file;
    option.joined = equals != std::string::npos;
    if (option.joined) {
      option.value = word.substr(equals + 1);
      if (known->second == Value::none) throw RequestError(fmt::format("{} takes no value", option.name));
    } else {
      take_value(known->second, option);
    }
    if (option.name == "--camera" && option.value && option.value->starts_with('{')) option.reads_file = false;
    if (option.value && option.value->empty()) throw RequestError(fmt::format("{} has an empty value", option.name));
    return option;
  }

  void take_value(Value kind, CommandOption& option) {
    const bool is_there = next_ < words_.size();
    if (kind == Value::none || (kind == Value::maybe_text && (!is_there || words_[next_].starts_with('-')))) return;
    if (!is_there) throw RequestError(fmt::format("{} needs a value", option.name));
    option.place = next_;
    option.value = words_[next_++];
    while (option.name == "--light" && !has_three_numbers(*option.value) && next_ < words_.size())
      *option.value += "," + words_[next_++];
  }

  const Words& words_;
  const Options& table_;
  std::size_t next_ = 0;
};

}  // namespace

std::vector<CommandOption> read_command_options(const Words& words) { return Reader(words, command_table()).read(); }

Words as_words(const std::vector<CommandOption>& options) {
  Words words;
  for (const CommandOption& option : options)
    words.push_back(option.value ? option.name + "=" + *option.value : option.name);
  return words;
}

std::vector<CommandOption> read_device_options(const Words& words) { return Reader(words, device_table()).read(); }

void check_povray_options(const Words& words) {
  // Switches by POV-Ray's reference, 3.2 "Command-line and INI-file options": sizes, anti-aliasing, quality, bounding,
  // threads, alpha and colour depth. Those that name files (+I +O +L +G +HI ...), shell-outs and other .ini files are
  // not among them.
  static const std::regex harmless(
      R"(surface\.ini(\[[A-Za-z0-9_]+\])?)"
      R"(|[+-](A|AM|AG|J|R|Q|W|H|UA|UL|UV|UR|SU|MB|WT|BS|K|V|FN)[0-9]*(\.[0-9]+)?)"
      R"(|(Antialias|Antialias_Depth|Antialias_Threshold|Antialias_Gamma|Sampling_Method|Jitter|Jitter_Amount|Quality)"
      R"(|Width|Height|Output_Alpha|Bits_Per_Color|Dither|Dither_Method|Work_Threads|Bounding|Bounding_Threshold)"
      R"(|Bounding_Method|Remove_Bounds|Split_Unions|Vista_Buffer|Light_Buffer|File_Gamma|Display_Gamma|Render_Block_Size)"
      R"(|Verbose|Warning_Level)=[A-Za-z0-9.]+)"
      R"(|Declare=[A-Za-z_][A-Za-z0-9_]*=-?[0-9]+(\.[0-9]+)?)");
  // Frames have their numbers in the trajectory, of which each process is given one.
  static const std::regex chooses_frame(R"(.*\[film\]|Declare=Meniscus_(By_Place|Frame)=.*)", std::regex::icase);
  for (const std::string& word : words)
    if (word.size() < 2 || word.size() > kLongestWord || !std::regex_match(word, harmless) ||
        std::regex_match(word, chooses_frame))
      throw RequestError(fmt::format("{} is no option for POV-Ray that a bundle may have", in_quotes(word)));
}

void check_blender_options(const Words& words) { Reader(words, blender_table()).read(); }

}  // namespace meniscus::farm
