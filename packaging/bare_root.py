"""Small Debian systems in folders, where a package shows that it brings what it needs (mmdebstrap, chroot; as root)."""

import hashlib
import shutil
import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

TRIED = "opt/tried"  # in the root: a folder for what is tried, gone afterwards
LONGEST_NAME = 100  # characters of a root's folder; file systems take 255, some tools add to it


def make_root(folder, suite, packages):
    """A Debian of this release with its base system and these packages alone; one that is there is taken as it is."""
    name = "-".join([suite, *sorted(packages)])
    if len(name) > LONGEST_NAME:
        name = f"{suite}-{hashlib.sha256(name.encode()).hexdigest()[:12]}"
    root = Path(folder) / name
    if not root.is_dir():
        print(f"making {root} ...", file=sys.stderr)
        unfinished = root.with_name(root.name + ".part")
        shutil.rmtree(unfinished, ignore_errors=True)
        unfinished.parent.mkdir(parents=True, exist_ok=True)
        include = [f"--include={','.join(packages)}"] if packages else []
        subprocess.run(["mmdebstrap", "--quiet", "--variant=minbase", *include, suite, unfinished], check=True)
        unfinished.rename(root)
    return root


@contextmanager
def trial(root, *files, network=False):
    """A folder in the root with copies of these files and folders, and a function that runs a command there.

    It sees nothing of the system outside, and no network unless asked for.
    """
    place = root / TRIED
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    for file in map(Path, files):
        (shutil.copytree if file.is_dir() else shutil.copy)(file, place / file.name)

    def run(*command, expected=0):
        line = " ".join(f"'{c}'" for c in map(str, command))
        script = f"mount -t proc proc /proc 2>/dev/null; cd /{TRIED} && exec {line}"
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": f"/{TRIED}", "LANG": "C.UTF-8"}
        alone = ["--mount"] if network else ["--mount", "--net"]
        done = subprocess.run(["unshare", *alone, "chroot", root, "/bin/sh", "-c", script],
                              capture_output=True, text=True, env=environment)
        if done.returncode != expected:
            raise SystemExit(f"error: exit code {done.returncode}: {line}\n{done.stdout}{done.stderr}")
        return done.stdout

    try:
        yield run
    finally:
        shutil.rmtree(place, ignore_errors=True)
