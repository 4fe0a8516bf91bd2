// SPDX-License-Identifier: BSD-3-Clause
// Compiles a job type of Flamenco 3 in a bare JavaScript context with a mock of its author API, and prints its tasks as
// JSON. The arguments are the script, and settings as JSON.
"use strict";
const fs = require("fs");
const vm = require("vm");

const tasks = [];
const author = {
    Command: (name, parameters) => ({ name, parameters }),
    Task: (name, type) => {
        const task = { name, type, commands: [], dependencies: [] };
        const methods = {
            addCommand: (command) => task.commands.push(command),
            addDependency: (other) => task.dependencies.push(other.name),
        };
        return Object.assign(Object.create(methods), task);
    },
};

const context = vm.createContext({ author, print: () => {} });
vm.runInContext(fs.readFileSync(process.argv[2], "utf8") + "\nthis.JOB_TYPE = JOB_TYPE; this.compileJob = compileJob;",
    context);
const settings = {};
for (const setting of context.JOB_TYPE.settings) settings[setting.key] = setting.default;
Object.assign(settings, JSON.parse(process.argv[3] || "{}"));
context.compileJob({ settings, addTask: (task) => tasks.push(task) });
console.log(JSON.stringify({ label: context.JOB_TYPE.label, settings: context.JOB_TYPE.settings, tasks }));
