// A job type of Flamenco 3 for bundles of Meniscus. Copy it once into the manager's scripts folder and restart the
// manager; each job then names its bundle. A worker of Flamenco does one task at a time, so a task may use all of its
// machine unless "threads" says less; the bundle's flamenco_job.json gives the memory that it needs.
const JOB_TYPE = {
    label: "Meniscus Film",
    description: "Frames of a molecular surface: a bundle made by meniscus farm bundle",
    settings: [
        { key: "bundle", type: "string", subtype: "dir_path", required: true,
          description: "Folder of the bundle, as the workers see it" },
        { key: "tasks", type: "int32", required: true, default: 10,
          description: "Tasks of nearly equal numbers of frames" },
        { key: "threads", type: "int32", default: 0,
          description: "Threads of a task; 0: all of the machine" },
        { key: "meniscus", type: "string", required: true, default: "meniscus",
          description: "The program, or its path on the workers" },
    ]
};

function compileJob(job) {
    const settings = job.settings;
    const verify = author.Task("verify", "misc");
    verify.addCommand(author.Command("exec", {
        exe: settings.meniscus,
        args: ["farm", "verify", settings.bundle],
    }));
    for (let k = 1; k <= settings.tasks; k++) {
        const task = author.Task("frames-" + k, "misc");
        const args = ["work", settings.bundle, "--chunk", k + "/" + settings.tasks, "--progress", "plain"];
        task.addCommand(author.Command("exec", {
            exe: settings.meniscus,
            args: settings.threads > 0 ? args.concat(["--threads", String(settings.threads)]) : args,
        }));
        verify.addDependency(task);
        job.addTask(task);
    }
    job.addTask(verify);
}
