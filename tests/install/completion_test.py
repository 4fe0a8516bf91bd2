# SPDX-License-Identifier: BSD-3-Clause
"""The installed completion scripts: shells read them, and they propose the words of the help."""

import shutil
import unittest

from installation import Installation

PLACES = {"bash": "bash-completion/completions/meniscus", "zsh": "zsh/vendor-completions/_meniscus",
          "fish": "fish/vendor_completions.d/meniscus.fish"}

# Scripts complete a line like the shell, without its files, and print the proposals.
ASK = {
    "bash": """source "$1"; shift
               compopt() { [[ $* == '-o default' ]] && echo FILES; }
               COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
               _meniscus; printf '%s\\n' "${COMPREPLY[@]}" """,
    "fish": """source $argv[1]; cd (mktemp -d); complete -C (string join -- ' ' $argv[2..-1]) | string split -f 1 \\t; true""",
}


def missing(shell):
    return unittest.skipUnless(shutil.which(shell), f"{shell} is not installed")


class Completion(Installation):
    def script(self, shell):
        return self.prefix / "share" / PLACES[shell]

    def proposed(self, shell, *words):
        words = ["meniscus", *words]
        if shell == "bash":
            done = self.good("bash", "--norc", "-c", ASK["bash"], "-", self.script("bash"), *words)
        else:
            done = self.good("fish", "--no-config", "-c", ASK["fish"], self.script("fish"), *words)
        return set(done.stdout.split())

    def check_parses(self, shell):
        self.assertEqual(self.good(shell, "-n", self.script(shell)).stderr, "")

    def check_proposals(self, shell):
        commands = self.commands()
        self.assertGreater(len(commands), 15)
        for words in commands:
            below = {other[-1] for other in commands if other[:-1] == words and other}
            self.assertLessEqual(below, self.proposed(shell, *words, ""), words)
            long = {name for name in self.options(words) if name.startswith("--")}
            self.assertEqual(long, self.proposed(shell, *words, "--"), words)
        self.assertEqual(self.proposed(shell, "surface", "--surface", ""), {"ses", "sas", "vdw"})
        self.assertEqual(self.proposed(shell, "export", "povray", "--proj"), {"--projection"})
        self.assertEqual(self.proposed(shell, "render", "x.pdb", "--color", "b"), {"bead", "bfactor", "buried"})
        self.assertIn("selections", self.proposed(shell, "help", "s"))
        self.assertIn("zsh", self.proposed(shell, "completion", ""))

    @missing("bash")
    def test_bash_reads_the_script(self):
        self.check_parses("bash")

    @missing("zsh")
    def test_zsh_reads_the_script(self):
        self.check_parses("zsh")

    @missing("fish")
    def test_fish_reads_the_script(self):
        self.check_parses("fish")

    @missing("bash")
    def test_bash_proposes_what_the_help_tells(self):
        self.check_proposals("bash")
        self.assertEqual(self.proposed("bash", "surface", ""), {"FILES"})
        self.assertEqual(self.proposed("bash", "render", "x.pdb", "--camera", ""), {"FILES"})
        self.assertEqual(self.proposed("bash", "render", "x.pdb", "--samples", ""), set())

    @missing("fish")
    def test_fish_proposes_what_the_help_tells(self):
        self.check_proposals("fish")

    @missing("zsh")
    def test_zsh_gets_every_option_of_every_command(self):
        # The stand-in for zsh's own function prints its arguments.
        ask = """compdef() { }; _arguments() { print -rl -- "$@" }; source "$1"; $2"""
        for words in self.commands():
            specifications = self.good("zsh", "-f", "-c", ask, "-", self.script("zsh"),
                                       "_" + "_".join(["meniscus", *words])).stdout
            for name in self.options(words):
                self.assertIn(f"\n*{name}[", specifications, words)


if __name__ == "__main__":
    unittest.main()
