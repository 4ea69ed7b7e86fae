#!/usr/bin/env python3
"""Spreads a sequence over a Slurm cluster: chunks of frames as an array job, failed ones again, one summary.

  scotopic_farm.py submit --frames 1-240 --chunk 10 --folder farm/shot12 --wait -- \\
      scotopic apply in.####.exr -o seen.####.exr --white-luminance 5 --adaptation-from frames

What it does, what a chunk's command is, and how other engines run the same: docs/sequences.md.
The folder must be one that all nodes see. Only Python's own library is needed, on the nodes too.
"""
import argparse
import json
import os
import re
import shlex
import subprocess
import sys
import time

SELF = os.path.abspath(__file__)
# Exit codes of scotopic that another try cannot change: usage, limit, config.
FINAL = (2, 4, 6)


def parse_frames(text):
    """The frames of "1-240", "1-240x2", "1-10,20": each once, in the order listed."""
    frames = {}
    for part in text.split(","):
        match = re.fullmatch(r"(-?\d{1,9})(?:-(-?\d{1,9})(?:x(\d{1,9}))?)?", part)
        if not match:
            sys.exit(f"scotopic_farm.py: '{part}' in --frames is not a frame or a range")
        first = int(match[1])
        last, step = int(match[2] or first), int(match[3] or 1)
        if last < first or step < 1:
            sys.exit(f"scotopic_farm.py: '{part}' in --frames runs backwards")
        frames.update(dict.fromkeys(range(first, last + 1, step)))
    return list(frames)


def list_text(frames):
    """A list that scotopic --frames reads."""
    runs = []
    for frame in frames:
        if runs and runs[-1][1] + 1 == frame:
            runs[-1][1] = frame
        else:
            runs.append([frame, frame])
    return ",".join(str(a) if a == b else f"{a}-{b}" for a, b in runs)


class Job:
    """A folder: job.json says what is to be done, files for each chunk what was."""

    def __init__(self, folder):
        self.folder = os.path.abspath(folder)
        with open(self.path("job.json"), encoding="utf-8") as file:
            self.__dict__.update(json.load(file))

    def path(self, *parts):
        return os.path.join(self.folder, *parts)

    def write(self, name, text):
        """Whole or not at all."""
        temporary = self.path(f".{name}.{os.getpid()}")
        with open(temporary, "w", encoding="utf-8") as file:
            file.write(text)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, self.path(name))

    def read(self, name):
        try:
            with open(self.path(name), encoding="utf-8", errors="replace") as file:
                return file.read()
        except OSError:
            return None

    def exit_code(self, name):
        """None: it did not get so far as to say."""
        text = self.read(name + ".exit")
        return int(text) if text else None

    def run(self, name, command):
        """Runs a command; its output goes to NAME.json and NAME.log, its exit code to NAME.exit, written last."""
        if os.path.exists(self.path(name + ".exit")):
            os.remove(self.path(name + ".exit"))
        with open(self.path(name + ".out"), "wb") as out, open(self.path(name + ".log"), "ab") as log:
            log.write(("+ " + shlex.join(command) + "\n").encode())
            log.flush()
            code = subprocess.run(command, stdout=out, stderr=log, check=False).returncode
        code = 128 - code if code < 0 else code
        os.replace(self.path(name + ".out"), self.path(name + ".json"))
        self.write(name + ".exit", str(code))
        return code


def threads(command):
    """Not more threads than Slurm gave processors."""
    cpus = os.environ.get("SLURM_CPUS_PER_TASK")
    return ["--threads", cpus] if cpus and "--threads" not in command else []


def chunk_name(index):
    return f"chunk-{index:05}"


def chunk_command(job, index):
    command = list(job.command)
    if job.meter:
        at = command.index("--adaptation-from") + 1
        command[at] = ("track:" if command[at] == "track" else "") + job.path("meter.json")
    flags = [f for f in ("--skip-existing", "--continue-on-error", "--json") if f not in command]
    return command + ["--frames", job.chunks[index]] + flags + threads(command)


def is_option(word):
    return re.match(r"--?[A-Za-z]", word) is not None


def meter_command(job):
    """explain, with those options of apply that it has too: what is seen, and how the input is read."""
    program = job.command[0]
    told = subprocess.run([program, "explain", "--help"], stdout=subprocess.PIPE, text=True, check=False).stdout
    known = set(re.findall(r"(?<![\w-])--?[A-Za-z][\w-]*", told)) - {"--adaptation-from", "--json"}
    command, keep = [program, "explain", job.command[2]], False
    for word in job.command[3:]:
        if is_option(word):
            keep = word.split("=")[0] in known
        if keep:
            command.append(word)
    return command + ["--frames", job.frames, "--json"] + threads(command)


def sbatch(job, name, task, *options):
    """Submits this script with another task; returns Slurm's job id."""
    log = job.path("slurm-%j.log").replace("%", "%%").replace("%%j", "%j")
    wrapped = "exec " + shlex.join([sys.executable, SELF, task, job.folder])
    command = ["sbatch", "--parsable", "--job-name", name, "--output", log, *options, *job.sbatch, "--wrap", wrapped]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        sys.exit("scotopic_farm.py: sbatch: " + done.stderr.strip())
    return done.stdout.strip().split(";")[0]


def submit_round(job, chunks):
    """The chunks as an array, after the meter where there is one to run, and the gatherer after them."""
    before = []
    if job.meter and job.exit_code("meter") != 0:
        before = ["--dependency", "afterok:" + sbatch(job, job.name + "-meter", "meter"), "--kill-on-invalid-dep=yes"]
    array = sbatch(job, job.name, "chunk", "--array", list_text(chunks), *before)
    gather = sbatch(job, job.name + "-gather", "gather", "--dependency", "afterany:" + array)
    rounds = json.loads(job.read("rounds.json") or "[]") + [{"chunks": chunks, "array": array, "gather": gather}]
    job.write("rounds.json", json.dumps(rounds))
    return array, gather


def submit(options):
    command = options.command[1:] if options.command[:1] == ["--"] else options.command
    if len(command) < 3 or command[1] not in ("apply", "lmsr") or command[2].startswith("-"):
        sys.exit("scotopic_farm.py: after -- comes a command: scotopic apply|lmsr IN -o OUT [options]")
    if any(w.split("=")[0] == "--frames" for w in command):
        sys.exit("scotopic_farm.py: --frames comes before the --, not after it")
    frames = parse_frames(options.frames)
    chunks = [list_text(frames[i:i + options.chunk]) for i in range(0, len(frames), options.chunk)]
    meter = "--adaptation-from" in command and command[command.index("--adaptation-from") + 1:][:1] in (["frames"], ["track"])
    os.makedirs(options.folder, exist_ok=True)
    if os.path.exists(os.path.join(options.folder, "job.json")):
        sys.exit(f"scotopic_farm.py: {options.folder} holds a job already; give it a folder of its own")
    with open(os.path.join(options.folder, "job.json"), "w", encoding="utf-8") as file:
        json.dump({"name": options.name, "command": command, "frames": options.frames, "chunks": chunks, "meter": meter,
                   "retries": options.retries, "sbatch": options.sbatch}, file, indent=1)
    job = Job(options.folder)
    array, gather = submit_round(job, list(range(len(chunks))))
    print(f"{len(frames)} frames in {len(chunks)} chunks: array job {array}, then {gather}; in {job.folder}")
    return wait(job) if options.wait else 0


def wait(job):
    """Until the summary is there; its exit code. A chain of jobs that somebody cancelled never writes one."""
    gone = 0
    while job.read("summary.json") is None:
        time.sleep(1)
        last = json.loads(job.read("rounds.json"))[-1]["gather"]
        queued = subprocess.run(["squeue", "--noheader", "--jobs", last], capture_output=True, text=True, check=False)
        gone = gone + 1 if not queued.stdout.strip() else 0
        if gone > 15:
            sys.exit(f"scotopic_farm.py: job {last}, which should have written a summary, is gone")
    print(job.read("summary.txt"), end="")
    return json.loads(job.read("summary.json"))["exitCode"]


def chunk(job):
    index = int(os.environ["SLURM_ARRAY_TASK_ID"])
    return job.run(chunk_name(index), chunk_command(job, index))


def meter_shot(job):
    return job.run("meter", meter_command(job))


def gather(job):
    """What is not done is tried again, unless trying is of no use; else the summary is written."""
    rounds = json.loads(job.read("rounds.json"))
    codes = {i: job.exit_code(chunk_name(i)) for i in range(len(job.chunks))}
    metered = job.exit_code("meter") if job.meter else 0
    again = [i for i, code in codes.items() if code != 0 and code not in FINAL]
    if again and len(rounds) <= job.retries and metered not in FINAL:
        submit_round(job, again)
        return 0
    return write_summary(job, rounds, codes, metered)


def frames_of_chunk(job, index):
    try:
        return {f["frame"]: f for f in json.loads(job.read(chunk_name(index) + ".json") or "{}").get("frames", [])}
    except ValueError:
        return {}


def write_summary(job, rounds, codes, metered):
    counts = {"written": 0, "skipped": 0, "failed": 0, "unknown": 0}
    lines, failed = [], []
    for index, text in enumerate(job.chunks):
        told = frames_of_chunk(job, index) if codes[index] is not None else {}
        for frame in parse_frames(text):
            status = told.get(frame, {}).get("status", "unknown")
            counts[status] += 1
            if status in ("failed", "unknown"):
                failed.append(frame)
            if status == "failed":
                lines.append(f"frame {frame}: {told[frame]['input']}: {told[frame]['message']}")
        if codes[index] is None:
            lines.append(f"frames {text}: the task ended without a report; see {job.path(chunk_name(index) + '.log')}")
    if metered != 0:
        lines.append(f"the shot could not be metered; see {job.path('meter.log')}")
    bad = [c for c in [metered, *codes.values()] if c != 0]
    # A task that did not get to say was killed, as far as anybody can tell.
    code = 0 if not bad else 137 if bad[0] is None else bad[0]
    tries = sum(len(r["chunks"]) for r in rounds) - len(job.chunks)
    head = (f"{counts['written']} frames written, {counts['skipped']} there already, "
            f"{counts['failed']} failed, {counts['unknown']} unknown; {tries} chunks tried again")
    job.write("summary.txt", "\n".join([head, *lines]) + "\n")
    job.write("summary.json", json.dumps({**counts, "failedFrames": list_text(failed), "retried": tries,
                                          "rounds": rounds, "exitCode": code}, indent=1))
    return code


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    tasks = parser.add_subparsers(dest="task", required=True)
    sub = tasks.add_parser("submit", help="split the frames and hand them to Slurm")
    sub.add_argument("--frames", required=True, help="1-240, 1-240x2, 1-10,20")
    sub.add_argument("--chunk", type=int, default=10, help="frames of one task (default 10)")
    sub.add_argument("--retries", type=int, default=2, help="times that failed chunks are tried again (default 2)")
    sub.add_argument("--folder", required=True, help="for logs, reports and the summary; all nodes must see it")
    sub.add_argument("--name", default="scotopic", help="of the jobs")
    sub.add_argument("--sbatch", action="append", default=[], metavar="OPTION", help="passed on, as --sbatch=--partition=night")
    sub.add_argument("--wait", action="store_true", help="until all is done; exit with the first failure's code")
    sub.add_argument("command", nargs=argparse.REMAINDER, help="-- scotopic apply|lmsr IN -o OUT [options]")
    for name in ("chunk", "meter", "gather"):
        tasks.add_parser(name, help="what the jobs run").add_argument("folder")
    options = parser.parse_args()
    if options.task == "submit":
        if options.chunk < 1 or options.retries < 0:
            parser.error("--chunk is at least 1, --retries at least 0")
        return submit(options)
    return {"chunk": chunk, "meter": meter_shot, "gather": gather}[options.task](Job(options.folder))


if __name__ == "__main__":
    sys.exit(main())
