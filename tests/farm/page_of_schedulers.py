# SPDX-License-Identifier: BSD-3-Clause
"""The files on the page of schedulers, docs/reference/schedulers.md, and the commands of each task as the queue would
run them."""

import json
import pathlib
import re

PAGE = pathlib.Path(__file__).resolve().parents[2] / "docs" / "reference" / "schedulers.md"
TASKS = 10
BUNDLE = "/mnt/film"


def files(heading):
    """Returns the texts between the fences below a heading."""
    section = re.split(r"^## ", PAGE.read_text(), flags=re.M)
    (found,) = [part for part in section if part.startswith(heading)]
    return re.findall(r"^```\w*\n(.*?)^```$", found, re.M | re.S)


def settings(text, separator="="):
    """Returns a dictionary from lines of the form name = value."""
    return dict((part.strip() for part in line.split(separator, 1)) for line in text.splitlines() if line.strip() and separator in line)


def condor_file():
    (text,) = files("HTCondor")
    return text


def condor_tasks():
    """Returns each task of a submit description: $(Process) and $(NAME) by their text, $INT(NAME) by its sum."""
    text = condor_file()
    assert f"queue {TASKS}\n" in text
    given = settings(text)

    def expanded(value, process):
        def whole(found):
            first, second = re.fullmatch(r"(\d+) \+ (\d+)", expanded(given[found.group(1)], process)).groups()
            return str(int(first) + int(second))

        return re.sub(r"\$INT\((\w+)\)", whole, value).replace("$(Process)", str(process))

    return [("meniscus " + expanded(given["arguments"], process), {}) for process in range(TASKS)]


def batch_definition():
    (text,) = files("AWS Batch")
    return json.loads(text)


def batch_tasks():
    shell, option, command = batch_definition()["containerProperties"]["command"]
    assert (shell, option) == ("sh", "-c")
    return [(command, {"AWS_BATCH_JOB_ARRAY_INDEX": str(index)}) for index in range(TASKS)]


def deadline_tasks():
    job, plugin = map(settings, files("Deadline"))
    assert (job["Plugin"], job["Frames"], job["ChunkSize"]) == ("CommandLine", f"1-{TASKS}", "1")
    return [("meniscus " + plugin["Arguments"].replace("<STARTFRAME>", str(frame)), {}) for frame in range(1, TASKS + 1)]


def array_tasks():
    """Returns the tasks, whose numbers have the three schedulers' names in turn."""
    (script,) = files("Grid Engine")
    names = ("SGE_TASK_ID", "PBS_ARRAY_INDEX", "LSB_JOBINDEX")
    return [(script, {names[k % 3]: str(k + 1)}) for k in range(TASKS)]


TASKS_OF = {"HTCondor": condor_tasks, "AWS Batch": batch_tasks, "Deadline": deadline_tasks, "Grid Engine": array_tasks}
