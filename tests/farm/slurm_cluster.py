# SPDX-License-Identifier: BSD-3-Clause
"""A whole Slurm cluster of one machine, on loopback, for as long as a test runs."""

import getpass
import os
import pathlib
import shutil
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue")


def why_not():
    """Returns what a cluster here is missing, or an empty text."""
    if os.geteuid() != 0:
        return f"Slurm's daemons are started as root only; this is {getpass.getuser()}"
    if not os.path.ismount("/sys/fs/cgroup"):
        return "slurmd needs control groups at /sys/fs/cgroup"
    missing = [name for name in PROGRAMS if not shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin")]
    return f"not installed: {', '.join(missing)}" if missing else ""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


class SlurmCluster:
    """Starts munge, the controller and one node; ends them in the opposite order. `environment` finds the cluster."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.daemons = []
        self.environment = dict(os.environ, SLURM_CONF=str(self.folder / "slurm.conf"),
                                PATH=os.environ["PATH"] + ":/usr/sbin")

    def __enter__(self):
        try:
            self._start_munge()
            self._write_configuration()
            self._start("slurmctld", "-D", "-i")
            self._start("slurmd", "-D")
            self._await_idle()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        subprocess.run(["scancel", "--user=root"], env=self.environment, capture_output=True)
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def _start(self, *command):
        with open(self.folder / f"{command[0]}.out", "wb") as log:
            self.daemons.append(subprocess.Popen(command, env=self.environment, stdout=log, stderr=log,
                                                 stdin=subprocess.DEVNULL))

    def _start_munge(self):
        run = self.folder / "munge"
        run.mkdir(mode=0o755)
        key = run / "key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        self.socket = run / "socket"
        self._start("munged", "--foreground", "--force", f"--key-file={key}", f"--socket={self.socket}",
                    f"--pid-file={run}/pid", f"--log-file={run}/log", f"--seed-file={run}/seed")
        self._await(self.socket.exists, "munge's socket")

    def _write_configuration(self):
        host = socket.gethostname().split(".")[0]
        controller, node = free_ports(2)
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        (self.folder / "gres.conf").write_text("Name=gpu File=/dev/zero\n")
        (self.folder / "slurm.conf").write_text(f"""ClusterName=loopback
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket={self.socket}
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
SlurmctldPort={controller}
SlurmdPort={node}
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc={self.folder}/jobs.txt
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1
ReturnToService=2
GresTypes=gpu
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000 Gres=gpu:1
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
""")

    def _await(self, condition, what, seconds=30.0):
        deadline = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > deadline or any(daemon.poll() is not None for daemon in self.daemons):
                logs = "\n".join(f"{path.name}:\n{path.read_text(errors='replace')[-2000:]}"
                                 for path in self.folder.glob("*.log"))
                raise RuntimeError(f"waited in vain for {what}\n{logs}")
            time.sleep(0.05)

    def _await_idle(self):
        def idle():
            said = subprocess.run(["sinfo", "-h", "-o", "%t"], env=self.environment, capture_output=True, text=True)
            return said.stdout.strip() == "idle"
        self._await(idle, "an idle node")

    def run(self, *command, **more):
        return subprocess.run(list(map(str, command)), env=dict(self.environment, **more), capture_output=True,
                              text=True, timeout=60)

    def job(self, number):
        """Returns the controller's record of a job, or of one task of an array ("12_3")."""
        text = self.run("scontrol", "show", "job", "-o", number).stdout.splitlines()
        return dict(word.split("=", 1) for word in (text[0].split() if text else []) if "=" in word)

    def tasks(self, array):
        """Returns the controller's record of each task of an array, by its number."""
        found = {}
        for line in self.run("scontrol", "show", "job", "-o", array).stdout.splitlines():
            task = dict(word.split("=", 1) for word in line.split() if "=" in word)
            if task.get("ArrayTaskId", "").isdigit():
                found[int(task["ArrayTaskId"])] = task
        return found
