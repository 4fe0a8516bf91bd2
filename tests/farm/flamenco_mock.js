// SPDX-License-Identifier: BSD-3-Clause
// Compiles a job type of Flamenco 3 in a bare JavaScript context with a mock of its author API; prints its tasks as JSON.
// A mock: no manager has seen this job. Arguments: the script, and settings as JSON.
"use strict";
const fs = require("fs");
const vm = require("vm");

const tasks = [];
const author = {
    Command: (name, parameters) => ({ name, parameters }),
    Task: (name, type) => {
        const task = { name, type, commands: [], dependencies: [] };
        return Object.assign(Object.create({
            addCommand(command) { task.commands.push(command); this.commands = task.commands; },
            addDependency(other) { this.dependencies.push(other.name); },
        }), task);
    },
};

// "0-9,12" by fours: "0-3", "4-7", "8-9,12".
function frameChunker(ranges, size) {
    const frames = ranges.split(",").flatMap((part) => {
        const [first, last] = part.split("-").map(Number);
        return Array.from({ length: (last === undefined ? first : last) - first + 1 }, (_, n) => first + n);
    });
    const chunks = [];
    for (let begin = 0; begin < frames.length; begin += size) {
        const chunk = frames.slice(begin, begin + size);
        const parts = [];
        for (let n = 0; n < chunk.length;) {
            let last = n;
            while (last + 1 < chunk.length && chunk[last + 1] === chunk[last] + 1) last++;
            parts.push(last > n ? `${chunk[n]}-${chunk[last]}` : `${chunk[n]}`);
            n = last + 1;
        }
        chunks.push(parts.join(","));
    }
    return chunks;
}

const context = vm.createContext({ author, frameChunker, print: () => {} });
vm.runInContext(fs.readFileSync(process.argv[2], "utf8") + "\nthis.JOB_TYPE = JOB_TYPE; this.compileJob = compileJob;",
    context);
const settings = {};
for (const setting of context.JOB_TYPE.settings) settings[setting.key] = setting.default;
Object.assign(settings, JSON.parse(process.argv[3] || "{}"));
context.compileJob({ settings, addTask: (task) => tasks.push(task) });
console.log(JSON.stringify({ label: context.JOB_TYPE.label, settings: context.JOB_TYPE.settings, tasks }));
