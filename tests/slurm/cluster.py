"""A Slurm cluster of two nodes on this machine, in a folder of its own. It runs munged, slurmctld and two slurmd with ports of their own. It needs
root, because slurmd does, and Debian's packages slurm-wlm and munge, but not systemd."""
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

CONFIGURATION = """ClusterName=one
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmdPort={node_port}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/munge.sock
CryptoType=crypto/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.%n.pid
SlurmctldLogFile={folder}/log/slurmctld.log
SlurmdLogFile={folder}/log/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=2,bf_interval=2,max_rpc_cnt=0
MinJobAge=3600
KillWait=10
SlurmdTimeout=10
ReturnToService=2
RequeueExit=75
JobRequeue=1
MailProg=/bin/true
NodeName=n[1-2] NodeHostname={host} NodeAddr=127.0.0.1 Port=[{node_port}-{last_port}] CPUs=2 RealMemory=2000 State=UNKNOWN
PartitionName=render Nodes=n[1-2] Default=YES MaxTime=INFINITE State=UP DefMemPerCPU=200
"""


def missing():
    """Returns what this machine lacks for a cluster. The text is empty if it lacks nothing."""
    if os.geteuid() != 0:
        return "slurmd must run as root"
    lost = [p for p in ("munged", "slurmctld", "slurmd", "sbatch", "runuser") if not shutil.which(p, path=os.environ["PATH"] + ":/usr/sbin")]
    return f"{', '.join(lost)} not found: ./dev slurm installs Debian's packages slurm-wlm and munge" if lost else ""


class Cluster:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.daemons = {}
        for name in ("munge", "state", "spool/n1", "spool/n2", "log"):
            (self.folder / name).mkdir(parents=True)
        for path in (self.folder, self.folder.parent):
            path.chmod(0o755)  # The user munge must be able to enter these folders.
        key = self.folder / "munge/munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        for path in (self.folder / "munge", key):
            shutil.chown(path, "munge", "munge")
        port = 17000 + os.getpid() % 2000 * 4
        host = socket.gethostname().split(".")[0]
        configuration = self.folder / "slurm.conf"
        configuration.write_text(CONFIGURATION.format(folder=self.folder, host=host, port=port, node_port=port + 1, last_port=port + 2))
        os.environ["SLURM_CONF"] = str(configuration)
        os.environ["PATH"] += ":/usr/sbin"

    def start(self):
        munge = self.folder / "munge"
        self.begin("munged", "runuser", "-u", "munge", "--", "/usr/sbin/munged", "-F", f"--key-file={munge}/munge.key", f"--socket={munge}/munge.sock",
                   f"--pid-file={munge}/munged.pid", f"--log-file={munge}/munged.log", f"--seed-file={munge}/munged.seed")
        end = time.monotonic() + 60
        while not (munge / "munge.sock").exists():
            if time.monotonic() > end or self.daemons["munged"].poll() is not None:
                raise RuntimeError("munged does not start: " + (self.folder / "log/munged.out").read_text())
            time.sleep(0.05)
        self.begin("slurmctld", "slurmctld", "-D", "-c")
        for node in ("n1", "n2"):
            self.begin(node, "slurmd", "-D", "-N", node)
        while self.say("sinfo", "-h", "-N", "-o", "%T").split() != ["idle", "idle"]:
            if time.monotonic() > end:
                raise RuntimeError("the nodes do not become idle: " + self.say("sinfo", "-N", "-l"))
            time.sleep(0.2)

    def begin(self, name, *command):
        out = (self.folder / f"log/{name}.out").open("w")
        self.daemons[name] = subprocess.Popen(command, stdout=out, stderr=out, start_new_session=True)

    @staticmethod
    def say(*command):
        return subprocess.run(command, capture_output=True, text=True).stdout

    def kill_node(self, name):
        """Kills a node as if its machine lost power: the daemon, the step daemons that it has started, and the tasks."""
        daemon = self.daemons.pop(name)
        for number in self.below(daemon.pid) + self.steps_of(name):
            try:
                os.kill(number, signal.SIGKILL)
            except ProcessLookupError:
                pass
        daemon.kill()
        daemon.wait()

    def steps_of(self, node):
        """Returns the step daemons of a node and their tasks: processes with the node's spool folder in their environment or command."""
        found = []
        for process in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if f"SLURMD_NODENAME={node}\0".encode() in (process / "environ").read_bytes() and str(self.folder).encode() in (process / "environ").read_bytes():
                    found.append(int(process.name))
            except OSError:
                pass
        return found

    @classmethod
    def below(cls, parent):
        children = [int(line) for line in subprocess.run(["ps", "-o", "pid=", "--ppid", str(parent)], capture_output=True, text=True).stdout.split()]
        return children + [deeper for child in children for deeper in cls.below(child)]

    def stop(self):
        for name in list(self.daemons)[::-1]:
            daemon = self.daemons[name]
            for number in self.below(daemon.pid) + [daemon.pid]:
                try:
                    os.kill(number, signal.SIGTERM)
                except ProcessLookupError:
                    pass
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
