"""The program, and the files it reads and writes, told apart from the package by sharing no code with it."""

import json
import os
import subprocess

import numpy as np

PROGRAM = os.environ["UNSNARL_PROGRAM"]


def run(*arguments, expected=0):
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == expected, done.stderr
    return done.stdout


def sample(path, name, *options):
    run("sample", name, "-o", path, *options)
    return read_obj(path)


def fix(source, target, *options, expected=0):
    """The positions and the report that `unsnarl fix` writes."""
    report = target.with_suffix(".json")
    run("fix", source, "-o", target, "--report", report, *options, expected=expected)
    return json.loads(report.read_text())


def read_obj(path):
    """V (n, 3), and F: (m, k) if all faces have k corners, else (corners, offsets)."""
    positions, faces = [], []
    for line in path.read_text().splitlines():
        kind, *words = line.split() or [""]
        if kind == "v":
            positions.append([float(word) for word in words])
        elif kind == "f":
            faces.append([int(word.split("/")[0]) - 1 for word in words])
    sizes = [len(face) for face in faces]
    if len(set(sizes)) == 1:
        return np.array(positions), np.array(faces)
    return np.array(positions), (np.concatenate(faces), np.cumsum([0] + sizes))


def write_ply(path, V, F):
    """Binary, float32 positions."""
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(V)}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {len(F)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    rows = np.empty(len(F), dtype=[("size", "u1"), ("ids", "<i4", F.shape[1])])
    rows["size"], rows["ids"] = F.shape[1], F
    path.write_bytes(header.encode() + V.astype("<f4").tobytes() + rows.tobytes())


def positions_of_ply(path, count):
    data = path.read_bytes()
    begin = data.index(b"end_header\n") + len("end_header\n")
    return np.frombuffer(data, "<f4", 3 * count, begin).reshape(count, 3)


def without_measurements(report):
    """What of a report has to be the same in each run, whoever asked for it."""
    kept = {key: value for key, value in report.items() if key not in ("seconds", "peak_memory_mb", "stages", "output")}
    kept["input"] = {key: value for key, value in report["input"].items() if key not in ("path", "format", "notes")}
    kept["regions"] = [{k: v for k, v in region.items() if k != "seconds"} for region in report["regions"]]
    return kept
