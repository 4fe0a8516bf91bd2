# SPDX-License-Identifier: BSD-3-Clause
"""smaller_command.py PROGRAM WORD...: runs a command of the manual with small pictures, few frames and files that are there."""

import os
import sys

# Names of molecules that Debian lacks, and the stand-ins that recipes_test.py gives to them.
STAND_INS = {"1ake.cif": "1ake.pdb", "1aon.cif": "1aon.pdb", "adk.psf": "adk.pdb"}
WRITERS = ("render", "export", "surface", "pockets")


def smaller(words):
    """Returns the command with other values of options: lists of words in and out."""
    words = [STAND_INS.get(word, word) for word in words]
    if words[:2] == ["farm", "bundle"]:
        inner = words.index("--") + 1
        return [*words[:inner], *(word for word in smaller(words[inner:]) if word != "--force")]
    if words[:1] == ["work"] and "--frames" in words:
        place = words.index("--frames") + 1
        return [*words[:place], "1", *words[place + 1:]]
    is_short = words and words[0].endswith((".pdb", ".json"))
    if not is_short and not (words and words[0] in WRITERS):
        return words
    values = {"--smooth": "3", "--repeat": "2", "--tolerance": "0.5", "--density": "0.5"}
    if "adk.pdb" in words:
        values["--frames"] = "0-1"
    if "adk.dcd" in words and "--frames" not in words:
        words += ["--frames", "0-1"]
    if words[0] == "export" and words[1] in ("mesh", "blender") and not {"--tolerance", "--density", "--camera"}.intersection(words):
        words += ["--tolerance", "0.5"]
    if "--even" in words:
        words += ["--select", "chain C"]
    if is_short or words[0] == "render":
        values.update({"--size": "240x180", "--samples": "1", "--dpi": "72", "--width": "60mm"})
        if not {"--width", "--height", "--size", "--scene"}.intersection(words) and not words[0].endswith(".json"):
            words += ["--size", "240x180"]
        words += ["--samples", "1"]
    for place, word in enumerate(words[:-1]):
        words[place + 1] = values.get(word, words[place + 1])
    # Readers of a tutorial give no --force, so none of its commands may need it.
    return [*words, *([] if "IS_TUTORIAL" in os.environ else ["--force"])]


if __name__ == "__main__":
    program, given = sys.argv[1], sys.argv[2:]
    # Words behind a second -- belong to the renderer of a bundle.
    renderer = given[given.index("--", given.index("--") + 1):] if given.count("--") > 1 else []
    os.execv(program, [program, *smaller(given[: len(given) - len(renderer)]), *renderer])
