"""Small Debian systems in folders, where a package shows that it brings what it needs (mmdebstrap, chroot; as root)."""

import hashlib
import shlex
import shutil
import subprocess
import sys
import tempfile
from contextlib import contextmanager
from pathlib import Path

MADE = "etc/made_for_trials"  # in a root: that it is ours, to install to and to remove from
LONGEST_NAME = 100  # characters of a root's folder; file systems take 255, some tools add to it


def make_root(folder, suite, packages, architectures=(), options=("--variant=minbase",)):
    """A Debian of this release with its base system and these packages alone; one that was made before is taken as it is.

    architectures: those that packages may be of ("name:arm64"), this machine's first; none: this machine's alone.
    options: what else mmdebstrap is told.
    """
    name = "-".join([suite, *architectures, *sorted(packages)])
    if len(name) > LONGEST_NAME:
        name = f"{suite}-{hashlib.sha256(name.encode()).hexdigest()[:12]}"
    root = Path(folder) / name
    if not root.is_dir():
        print(f"making {root} ...", file=sys.stderr)
        root.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=f"{name}.", dir=root.parent) as beside:
            unfinished = Path(beside) / name
            include = [f"--include={','.join(packages)}"] if packages else []
            kinds = [f"--architectures={','.join(architectures)}"] if architectures else []
            subprocess.run(["mmdebstrap", "--quiet", *options, *kinds, *include, suite, unfinished], check=True)
            (unfinished / MADE).touch()
            unfinished.rename(root)
    if not (root / MADE).exists():
        sys.exit(f"error: {root} was not made by this script; name another folder with --roots")
    return root


def runner(root, inside, network=False, environment={}):
    """A function that runs a command in this folder of the root and returns what it wrote to standard output.

    It sees nothing of the system outside, and no network unless asked for. environment: variables beside PATH, HOME
    and LANG.
    """
    environment = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": inside, "LANG": "C.UTF-8", **environment}

    def run(*command, expected=0):
        line = shlex.join(map(str, command))
        terminals = "mount -t devpts -o newinstance,ptmxmode=0666 devpts /dev/pts 2>/dev/null"
        script = f"mount -t proc proc /proc 2>/dev/null; {terminals}; cd {inside} && exec {line}"
        alone = ["--mount"] if network else ["--mount", "--net"]
        done = subprocess.run(["unshare", *alone, "chroot", root, "/bin/sh", "-c", script],
                              capture_output=True, text=True, errors="replace", env=environment)
        if expected is not None and done.returncode != expected:
            raise SystemExit(f"error: exit code {done.returncode}: {line}\n{done.stdout}{done.stderr}")
        return done.stdout

    return run


@contextmanager
def trial(root, *files, network=False):
    """A new folder in the root with copies of these files and folders, and a function that runs a command there (see
    runner). `run.place` is the folder, seen from outside; it is gone afterwards.
    """
    (root / "opt").mkdir(exist_ok=True)
    place = Path(tempfile.mkdtemp(prefix="tried-", dir=root / "opt"))
    for file in map(Path, files):
        (shutil.copytree if file.is_dir() else shutil.copy)(file, place / file.name)
    run = runner(root, f"/opt/{place.name}", network)
    run.place = place
    try:
        yield run
    finally:
        shutil.rmtree(place, ignore_errors=True)
