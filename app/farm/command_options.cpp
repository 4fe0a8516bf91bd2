// SPDX-License-Identifier: BSD-3-Clause
// Reads the options of a bundled command, and refuses every word that a bundle must not have.
#include "app/farm/command_options.h"

#include <algorithm>
#include <map>
#include <regex>
#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/properties/properties.h"

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

Value value_of(const Property& property) {
  switch (property.type) {
    case ValueType::flag:
      return Value::none;
    case ValueType::file:
    case ValueType::camera:
      return Value::file;
    default:
      return property.has(value_optional) ? Value::maybe_text : Value::text;
  }
}

/// The properties that a bundle may have. None of them writes a file or starts a program.
const Options& command_table() {
  static const Options table = [] {
    Options options;
    for (const Property* property : properties()) {
      if (!property->has(in_bundle)) continue;
      options[property->long_option()] = value_of(*property);
      if (const std::size_t comma = property->option.find(','); comma != std::string_view::npos)
        options[property->option.substr(0, comma)] = value_of(*property);
    }
    return options;
  }();
  return table;
}

const Options& device_table() {
  static const Options table = [] {
    Options options;
    for (const char* key : {"surface.device", "surface.threads", "surface.require_gpu", "frames.jobs"})
      options[property_of(key).option] = value_of(property_of(key));
    return options;
  }();
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
      throw RequestError(fmt::format("{} is not supported in farm bundles{}", in_quotes(word),
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
      throw RequestError(fmt::format("{} is not an option for POV-Ray that a bundle may have", in_quotes(word)));
}

void check_blender_options(const Words& words) { Reader(words, blender_table()).read(); }

}  // namespace meniscus::farm
