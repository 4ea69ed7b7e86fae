#!/usr/bin/env python3
"""A shot on a real Slurm: one task is killed while it works, one frame is broken. slurm_test.py SCOTOPIC WORK"""
import json
import os
import shutil
import subprocess
import sys
import time

import one_node

FARM = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts", "farm", "scotopic_farm.py")
FRAMES, CHUNK = 12, 3


def make_frames(folder, size):
    """Noise, a little brighter from frame to frame."""
    for frame in range(1, FRAMES + 1):
        subprocess.run(["oiiotool", "--create", f"{size}x{size}", "3", "--noise:type=uniform:min=0.01:max=0.5:seed=%d" % frame,
                        "--mulc", str(1 + frame / 10), "-d", "half", "--compression", "zip", "-o",
                        os.path.join(folder, f"in.{frame:04}.exr")], check=True)


def farm(*arguments):
    done = subprocess.run([sys.executable, FARM, "submit", *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    print(done.stdout, end="", flush=True)
    return done


def wait_for(what, ready, patience=120):
    end = time.monotonic() + patience
    while not ready():
        if time.monotonic() > end:
            sys.exit("slurm_test.py: waited in vain for " + what)
        time.sleep(0.02)


def expect(truth, what):
    if not truth:
        sys.exit("slurm_test.py: not so: " + what)
    print("ok: " + what, flush=True)


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return json.load(file)


def outputs(work, prefix):
    return sorted(n for n in os.listdir(work) if n.startswith(prefix))


def a_killed_task_is_tried_again(scotopic, work):
    """Chunk 1 (frames 4-6) is killed by Slurm after its first frame."""
    command = [scotopic, "apply", os.path.join(work, "in.####.exr"), "-o"]
    rest = ["--white-luminance", "0.5", "--adaptation-from", "frames", "--ppd", "240", "--acuity", "--frames-at-once", "1"]
    folder = os.path.join(work, "farm")
    farm("--frames", f"1-{FRAMES}", "--chunk", str(CHUNK), "--folder", folder, "--", *command, os.path.join(work, "seen.####.exr"), *rest)
    array = read(folder, "rounds.json")[0]["array"]
    wait_for("frame 4", lambda: os.path.exists(os.path.join(work, "seen.0004.exr")))
    subprocess.run(["scancel", "--signal=KILL", "--full", f"{array}_1"], check=True)
    expect(not os.path.exists(os.path.join(work, "seen.0006.exr")), "the task was killed between its first frame and its last")
    wait_for("the summary", lambda: os.path.exists(os.path.join(folder, "summary.json")))
    summary = read(folder, "summary.json")
    with open(os.path.join(folder, "summary.txt"), encoding="utf-8") as file:
        print("summary: " + file.read(), end="")
    expect(summary["exitCode"] == 0 and summary["failed"] == 0 and summary["unknown"] == 0, "the shot is done")
    expect(summary["retried"] == 1 and summary["rounds"][1]["chunks"] == [1], "the killed chunk, and no other, was tried again")
    again = {f["frame"]: f["status"] for f in read(folder, "chunk-00001.json")["frames"]}
    expect(again[4] == "skipped" and again[6] == "written", "it left the frame that was done, and made the others: " + str(again))
    expect(summary["written"] + summary["skipped"] == FRAMES, "every frame is accounted for")

    subprocess.run(command + [os.path.join(work, "alone.####.exr"), "--frames", f"1-{FRAMES}", "-q", *rest], check=True)
    same = [pixels(work, "seen", f) == pixels(work, "alone", f) for f in range(1, FRAMES + 1)]
    expect(all(same), "all frames have the pixels and the adaptation that one process gives them")


def pixels(work, prefix, frame):
    """Hash of the pixels, and the adaptation, as oiiotool reads them."""
    name = os.path.join(work, f"{prefix}.{frame:04}.exr")
    info = subprocess.run(["oiiotool", "--info", "-v", "--hash", name], capture_output=True, text=True, check=True).stdout
    lines = [l.strip() for l in info.splitlines() if "SHA-1" in l or "scotopic:adaptation" in l]
    if len(lines) < 2:
        sys.exit("slurm_test.py: oiiotool tells no hash of " + name)
    return lines


def a_broken_frame_is_told(scotopic, work):
    """It fails, is tried as often as asked, and the others are there."""
    with open(os.path.join(work, "in.0008.exr"), "r+b") as file:
        file.truncate(1000)
    folder = os.path.join(work, "farm-broken")
    done = farm("--frames", f"7-{FRAMES}", "--chunk", str(CHUNK), "--folder", folder, "--retries", "1", "--wait", "--", scotopic, "apply",
                os.path.join(work, "in.%04d.exr"), "-o", os.path.join(work, "b.%04d.exr"), "--adaptation", "0.1", "--white-luminance", "1")
    summary = read(folder, "summary.json")
    expect(done.returncode == 3 == summary["exitCode"], "the submission ends with the failure's code")
    expect(summary["failedFrames"] == "8" and summary["retried"] == 1, "frame 8 failed, its chunk was tried twice")
    expect(len(outputs(work, "b.")) == FRAMES - 7, "the other frames are there")


def main():
    scotopic, work = os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2])
    gone = one_node.missing() + ([] if shutil.which("oiiotool") else ["oiiotool"])
    if gone:
        print("skipped: not installed: " + ", ".join(gone) + " (scripts/farm/test.sh installs them)")
        return 77
    shutil.rmtree(work, ignore_errors=True)
    os.makedirs(work)
    make_frames(work, 700)
    with one_node.OneNode():
        a_killed_task_is_tried_again(scotopic, work)
        a_broken_frame_is_told(scotopic, work)
    shutil.rmtree(work, ignore_errors=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
