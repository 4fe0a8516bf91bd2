// SPDX-License-Identifier: BSD-3-Clause
// Expands included shader files into one text, and translates the positions in a compiler's log back.
#include "core/gpu/shader_source.h"

#include <algorithm>
#include <regex>

#include <fmt/format.h>

#include "core/base/error.h"

namespace meniscus {
namespace {

/// Returns the first word and the rest of a preprocessor line; both are empty for any other line.
std::pair<std::string_view, std::string_view> split_directive(std::string_view line) {
  constexpr std::string_view kSpace = " \t\r";
  const auto skip_space = [&](std::string_view s) {
    const auto n = s.find_first_not_of(kSpace);
    return n == s.npos ? std::string_view{} : s.substr(n);
  };
  line = skip_space(line);
  if (line.empty() || line.front() != '#') return {};
  line = skip_space(line.substr(1));
  const auto end = std::min(line.find_first_of(" \t\r\"<"), line.size());
  return {line.substr(0, end), skip_space(line.substr(end))};
}

class Expander {
 public:
  Expander(const ShaderFinder& find, const ShaderDefines& defines) : find_(find), defines_(defines) {}

  /// epilogue: a file to append after the last line, or nothing.
  ShaderSource expand(std::string_view path, std::string_view epilogue) {
    const auto text = find_(path);
    if (!text) throw GpuError("{}: no such shader", path);
    append_file(std::string(path), *text);
    if (!has_version_) throw GpuError("{}: a shader needs a #version line", path);
    if (!epilogue.empty()) append_file(std::string(epilogue), *find_(epilogue));
    return std::move(source_);
  }

 private:
  void append_file(const std::string& path, std::string_view text) {
    const std::size_t number = source_.files.size();
    source_.files.push_back(path);
    open_files_.push_back(path);
    if (number > 0) append_position(1, number);
    std::size_t line_number = 0;
    while (!text.empty()) {
      const auto end = std::min(text.find('\n'), text.size());
      append_line(text.substr(0, end), path, ++line_number, number);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    open_files_.pop_back();
  }

  void append_line(std::string_view line, const std::string& path, std::size_t line_number, std::size_t file) {
    const auto [directive, argument] = split_directive(line);
    if (directive == "include") {
      append_include(argument, path, line_number);
      append_position(line_number + 1, file);
      return;
    }
    if (directive == "version") {
      if (file > 0) throw GpuError("{}:{}: #version in an included file", path, line_number);
      has_version_ = true;
    }
    source_.text.append(line).push_back('\n');
    if (directive == "version") {
      for (const auto& [name, value] : defines_) source_.text += fmt::format("#define {} {}\n", name, value);
      append_position(line_number + 1, file);
    }
  }

  void append_include(std::string_view argument, const std::string& path, std::size_t line_number) {
    const auto fail = [&](const std::string& why) { throw GpuError("{}:{}: {}", path, line_number, why); };
    const auto close = argument.size() < 2 || argument.front() != '"' ? argument.npos : argument.find('"', 1);
    if (close == argument.npos) fail("an include needs a file name in double quotes");
    const std::string included(argument.substr(1, close - 1));
    if (std::find(open_files_.begin(), open_files_.end(), included) != open_files_.end())
      fail(fmt::format("'{}' includes itself", included));
    if (std::find(source_.files.begin(), source_.files.end(), included) != source_.files.end()) return;
    const auto text = find_(included);
    if (!text) fail(fmt::format("no such shader: '{}'", included));
    append_file(included, *text);
  }

  void append_position(std::size_t line, std::size_t file) { source_.text += fmt::format("#line {} {}\n", line, file); }

  const ShaderFinder& find_;
  const ShaderDefines& defines_;
  ShaderSource source_;
  std::vector<std::string> open_files_;
  bool has_version_ = false;
};

}  // namespace

ShaderSource expand_shader(std::string_view path, const ShaderFinder& find, const ShaderDefines& defines) {
  return Expander(find, defines).expand(path, {});
}

ShaderSource expand_embedded_shader(std::string_view path, const ShaderDefines& defines) {
  const auto find = [](std::string_view wanted) -> std::optional<std::string_view> {
    for (const EmbeddedShader& shader : embedded_shaders())
      if (shader.path == wanted) return shader.text;
    return std::nullopt;
  };
  ShaderDefines renamed = defines;
  renamed.emplace_back("main", "kernel_main");
  return Expander(find, renamed).expand(path, "gpu_shaders/shared/finished_groups.glsl");
}

std::string translate_shader_log(std::string_view log, const std::vector<std::string>& files) {
  static const std::regex kPosition(R"(^((?:ERROR|WARNING): )?(\d+)(?::(\d+)(?:\(\d+\))?|\((\d+)\))\s*:\s*)");
  std::string translated;
  while (!log.empty()) {
    const auto end = std::min(log.find('\n'), log.size());
    const std::string line(log.substr(0, end));
    log.remove_prefix(std::min(end + 1, log.size()));
    std::smatch match;
    const bool found = std::regex_search(line, match, kPosition) && match[2].length() < 9;
    const std::size_t file = found ? std::stoul(match[2]) : 0;
    if (found && file < files.size()) {
      const std::string line_number = match[3].matched ? match[3] : match[4];
      translated += fmt::format("{}:{}: {}{}\n", files[file], line_number, match[1].str(), match.suffix().str());
    } else {
      translated += line + "\n";
    }
  }
  return translated;
}

}  // namespace meniscus
