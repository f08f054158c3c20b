"""What the benchmarks share: capped runs of the program, and meshes to run it on."""

import hashlib
import os
import re
import resource
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

PROJECT = Path(__file__).resolve().parent.parent
FORMATS = {".obj", ".off", ".ply", ".stl", ".glb", ".gltf"}


def digest(*parts):
    h = hashlib.sha256()
    for part in parts:
        h.update(part.read_bytes() if isinstance(part, Path) else str(part).encode())
        h.update(b"\0")
    return h.hexdigest()[:16]


class Run:
    """One capped process: exit code (negative: the signal), wall-clock and CPU seconds, peak memory, what it wrote."""

    def __init__(self, command, time_limit_s, memory_limit_mb, cwd=None):
        def cap():
            os.setsid()
            cpu_s = int(time_limit_s * (os.cpu_count() or 1)) + 1
            resource.setrlimit(resource.RLIMIT_CPU, (cpu_s, cpu_s))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            if memory_limit_mb:
                resource.setrlimit(resource.RLIMIT_AS, (memory_limit_mb << 20,) * 2)

        start = time.monotonic()
        process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                   preexec_fn=cap, cwd=cwd)
        self.timed_out = False

        def stop():
            self.timed_out = True
            os.killpg(process.pid, signal.SIGKILL)

        output = {}
        readers = [threading.Thread(target=lambda name=name, pipe=pipe: output.update({name: pipe.read()}))
                   for name, pipe in (("out", process.stdout), ("err", process.stderr))]
        timer = threading.Timer(time_limit_s, stop)
        timer.start()
        for reader in readers:
            reader.start()
        _, wait_status, usage = os.wait4(process.pid, 0)
        timer.cancel()
        for reader in readers:
            reader.join()
        process.stdout.close()
        process.stderr.close()
        self.seconds = time.monotonic() - start
        self.exit_code = process.returncode = os.waitstatus_to_exitcode(wait_status)
        self.cpu_s = usage.ru_utime + usage.ru_stime
        self.peak_memory_mb = usage.ru_maxrss / 1024
        self.stdout = output["out"].decode(errors="replace")
        self.stderr = output["err"].decode(errors="replace")


MADE_BY = ".made_by_bench"  # a file in each folder of results: which script's it is


def results_folder(path):
    """The folder for the results of the script that runs, made where there is none.

    The script may delete in it and write over what is there. So it ends the process instead where the folder holds
    anything and the same script has not made it.
    """
    path, script = Path(path).absolute(), Path(sys.argv[0]).name
    mark = path / MADE_BY
    if path.exists() and (not path.is_dir() or any(path.iterdir())):
        if not mark.is_file() or mark.read_text().strip() != script:
            sys.exit(f"error: {path} is not empty, and bench/{script} has not made it. Nothing was changed. "
                     "Name a new folder with -o, or an empty one.")
    path.mkdir(parents=True, exist_ok=True)
    mark.write_text(script + "\n")
    return path


def find_meshes(roots):
    """(dataset, name, path) of every mesh among files and below folders, in a fixed order. A dataset is the first
    folder below the one given, or the one given where meshes lie in it directly."""
    found = []
    for root in map(Path, roots):
        if root.is_file():
            found.append((root.resolve().parent.name, root.name, root))
            continue
        if not root.is_dir():
            sys.exit(f"{root} is neither a folder nor a file")
        for path in sorted(root.rglob("*")):
            if path.suffix.lower() in FORMATS and path.is_file():
                inside = path.relative_to(root)
                dataset = inside.parts[0] if len(inside.parts) > 1 else root.resolve().name
                name = Path(*inside.parts[1:]) if len(inside.parts) > 1 else inside
                found.append((dataset, name.as_posix(), path))
    return found


def sample_names(program):
    listing = subprocess.run([program, "sample", "--list"], capture_output=True, text=True)
    if listing.returncode:
        sys.exit(f"'{program} sample --list' failed:\n{listing.stderr}")
    # One sample a line, its name first; headings and continued lines do not begin with a name.
    return re.findall(r"^ {0,2}([a-z][a-z0-9_]*)\s", listing.stdout + "\n", re.MULTILINE)


def make_samples(program, folder, names=None):
    """Writes the built-in samples (or those named) into a folder, as NAME.obj; returns their paths. `names` may be a
    dictionary name -> resolution."""
    folder.mkdir(parents=True, exist_ok=True)
    if names is None:
        names = sample_names(program)
    paths = []
    for name in names:
        path = folder / f"{name}.obj"
        path.unlink(missing_ok=True)
        resolution = ["--resolution", str(names[name])] if isinstance(names, dict) else []
        run = subprocess.run([program, "sample", name, "-o", path, *resolution], capture_output=True, text=True)
        if run.returncode:
            sys.exit(f"'unsnarl sample {name}' failed:\n{run.stderr}")
        paths.append(path)
    return paths
