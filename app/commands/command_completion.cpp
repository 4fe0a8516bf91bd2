// SPDX-License-Identifier: BSD-3-Clause
// `meniscus completion SHELL`: prints the script with which a shell completes the command line.
#include <iostream>
#include <memory>

#include "app/commands/command_table.h"
#include "app/options/command_tree.h"
#include "app/options/property_options.h"
#include "app/process/program_error.h"
#include "app/reports/shell_completion.h"
#include "core/base/text.h"

namespace meniscus {
namespace {

struct Shell {
  const char* name;
  std::string (*completion)(const CommandEntry& program);
};

constexpr Shell kShells[] = {{"bash", bash_completion}, {"zsh", zsh_completion}, {"fish", fish_completion}};

void run(const CLI::App& program, const std::string& name) {
  for (const Shell& shell : kShells) {
    if (name != shell.name) continue;
    std::cout << shell.completion(command_tree(program));
    return;
  }
  throw UsageError(in_quotes(name) + " is not a supported shell; choose bash, zsh or fish");
}

}  // namespace

void add_completion(CLI::App& command) {
  describe(command,
           "  source <(meniscus completion bash)                 in ~/.bashrc\n"
           "  meniscus completion zsh >~/.zfunc/_meniscus        a folder of $fpath\n"
           "  meniscus completion fish >~/.config/fish/completions/meniscus.fish\n\n"
           "The package of a system installs all three.");
  auto shell = std::make_shared<std::string>();
  command.add_option("SHELL", *shell, "bash, zsh or fish")
      ->required()
      ->check(proposes({"bash", "zsh", "fish"}))
      ->type_name("");
  command.callback([shell, &command] { run(*command.get_parent(), *shell); });
}

}  // namespace meniscus
