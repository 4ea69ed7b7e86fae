"""A Slurm cluster of one node, this machine: munged, slurmctld and slurmd with files, ports and keys of their own."""
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel", "sinfo")


def missing():
    path = os.environ.get("PATH", "") + ":/usr/sbin:/sbin"
    return [p for p in PROGRAMS if not shutil.which(p, path=path)]


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for s in sockets:
        s.bind(("127.0.0.1", 0))
    ports = [s.getsockname()[1] for s in sockets]
    for s in sockets:
        s.close()
    return ports


class OneNode:
    """With-statement: the cluster runs inside. Slurm's own paths are short: its sockets' names have a limit."""

    def __enter__(self):
        os.environ["PATH"] += ":/usr/sbin:/sbin"
        self.folder = tempfile.mkdtemp(prefix="scotopic-slurm-")
        os.chmod(self.folder, 0o755)
        self.daemons = []
        os.environ["SLURM_CONF"] = self.path("slurm.conf")
        try:
            self.write_configuration()
            self.start("munged", "--foreground", "--force", "--socket", self.path("munge.socket"), "--key-file", self.path("munge.key"),
                       "--log-file", self.path("munged.log"), "--pid-file", self.path("munged.pid"),
                       "--seed-file", self.path("munge.seed"), "--num-threads", "2")
            self.wait_for("munge", lambda: os.path.exists(self.path("munge.socket")))
            self.start("slurmctld", "-D", "-i", "-f", self.path("slurm.conf"))
            self.start("slurmd", "-D", "-N", "node", "-f", self.path("slurm.conf"))
            self.wait_for("an idle node", lambda: "idle" in self.command("sinfo", "--noheader", "--format", "%T"))
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.send_signal(signal.SIGTERM)
        for daemon in reversed(self.daemons):
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write_configuration(self):
        with open(self.path("munge.key"), "wb") as key:
            key.write(os.urandom(128))
        os.chmod(self.path("munge.key"), 0o400)
        for name in ("state", "spool"):
            os.mkdir(self.path(name))
        controller, node = free_ports(2)
        user = subprocess.run(["id", "-un"], capture_output=True, text=True, check=True).stdout.strip()
        with open(self.path("slurm.conf"), "w", encoding="utf-8") as file:
            file.write(f"""ClusterName=scotopictest
SlurmctldHost={socket.gethostname()}(127.0.0.1)
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={self.path('munge.socket')}
CredType=cred/munge
SlurmctldPort={controller}
SlurmdPort={node}
StateSaveLocation={self.path('state')}
SlurmdSpoolDir={self.path('spool')}
SlurmctldPidFile={self.path('slurmctld.pid')}
SlurmdPidFile={self.path('slurmd.pid')}
SlurmctldLogFile={self.path('slurmctld.log')}
SlurmdLogFile={self.path('slurmd.log')}
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
SwitchType=switch/none
MailProg=/bin/true
ReturnToService=2
KillWait=2
SchedulerParameters=sched_interval=2,bf_interval=2
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
NodeName=node NodeAddr=127.0.0.1 NodeHostname={socket.gethostname()} CPUs=2 State=UNKNOWN
PartitionName=all Nodes=node Default=YES MaxTime=INFINITE State=UP
""")
        with open(self.path("cgroup.conf"), "w", encoding="utf-8") as file:
            file.write("CgroupAutomount=no\n")

    def start(self, *command):
        log = open(self.path(command[0] + ".out"), "wb")  # pylint: disable=consider-using-with
        self.daemons.append(subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log))

    def command(self, *command):
        return subprocess.run(command, capture_output=True, text=True, check=False).stdout

    def wait_for(self, what, ready, patience=60):
        end = time.monotonic() + patience
        while not ready():
            if time.monotonic() > end or any(d.poll() is not None for d in self.daemons):
                logs = "".join(f"--- {n}\n" + open(self.path(n), errors="replace").read()[-3000:]
                               for n in sorted(os.listdir(self.folder)) if n.endswith((".out", ".log")))
                raise RuntimeError(f"no {what}\n{logs}")
            time.sleep(0.1)
