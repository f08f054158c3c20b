"""Small Debian systems in folders, where a package shows that it brings what it needs (mmdebstrap, chroot; as root)."""

import hashlib
import shutil
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path

MADE = "etc/made_for_trials"  # in a root: that it is ours, to install to and to remove from
LONGEST_NAME = 100  # characters of a root's folder; file systems take 255, some tools add to it


def make_root(folder, suite, packages):
    """A Debian of this release with its base system and these packages alone; one that was made before is taken as it is."""
    name = "-".join([suite, *sorted(packages)])
    if len(name) > LONGEST_NAME:
        name = f"{suite}-{hashlib.sha256(name.encode()).hexdigest()[:12]}"
    root = Path(folder) / name
    if not root.is_dir():
        print(f"making {root} ...", file=sys.stderr)
        root.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=f"{name}.", dir=root.parent) as beside:
            unfinished = Path(beside) / name
            include = [f"--include={','.join(packages)}"] if packages else []
            subprocess.run(["mmdebstrap", "--quiet", "--variant=minbase", *include, suite, unfinished], check=True)
            (unfinished / MADE).touch()
            unfinished.rename(root)
    if not (root / MADE).exists():
        sys.exit(f"error: {root} was not made by this script; name another folder with --roots")
    return root


@contextmanager
def trial(root, *files, network=False):
    """A new folder in the root with copies of these files and folders, and a function that runs a command there.

    It sees nothing of the system outside, and no network unless asked for. `run.place` is the folder, seen from
    outside; it is gone afterwards.
    """
    (root / "opt").mkdir(exist_ok=True)
    place = Path(tempfile.mkdtemp(prefix="tried-", dir=root / "opt"))
    inside = f"/opt/{place.name}"
    for file in map(Path, files):
        (shutil.copytree if file.is_dir() else shutil.copy)(file, place / file.name)

    def run(*command, expected=0):
        line = " ".join(f"'{c}'" for c in map(str, command))
        script = f"mount -t proc proc /proc 2>/dev/null; cd {inside} && exec {line}"
        environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": inside, "LANG": "C.UTF-8"}
        alone = ["--mount"] if network else ["--mount", "--net"]
        done = subprocess.run(["unshare", *alone, "chroot", root, "/bin/sh", "-c", script],
                              capture_output=True, text=True, env=environment)
        if done.returncode != expected:
            raise SystemExit(f"error: exit code {done.returncode}: {line}\n{done.stdout}{done.stderr}")
        return done.stdout

    run.place = place
    try:
        yield run
    finally:
        shutil.rmtree(place, ignore_errors=True)
