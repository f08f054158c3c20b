#!/usr/bin/env python3
"""Dask: parts as tasks, on a cluster of this machine's processes or on one that runs (--scheduler tcp://host:8786).

  dask_batch.py MESHES OUTDIR --parts 100

A part whose process or whose worker is killed is started again, up to three times, and goes on where it stopped.
"""

import argparse
import subprocess

from distributed import Client, LocalCluster, as_completed


def repair_part(meshes, out, part, parts):
    """Exit code 1 is no failure: all meshes of the part have been worked on; results.csv says which are not embedded."""
    run = subprocess.run(["unsnarl", "batch", meshes, "-o", out, "--shard", f"{part}/{parts}", "--jobs", "1",
                          "--quiet"], capture_output=True, text=True)
    if run.returncode not in (0, 1):
        raise RuntimeError(f"part {part} ended with exit code {run.returncode}: {run.stderr}")
    return part


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("meshes", help="a folder or a list")
    parser.add_argument("out", help="a folder that all workers see")
    parser.add_argument("--parts", type=int, default=8)
    parser.add_argument("--scheduler", help="address; by default a cluster of its own")
    parser.add_argument("--workers", type=int, help="of the cluster of its own; by default as many as processors")
    options = parser.parse_args()
    with Client(options.scheduler or LocalCluster(n_workers=options.workers, threads_per_worker=1,
                                                  dashboard_address=None)) as client:
        futures = client.map(lambda part: repair_part(options.meshes, options.out, part, options.parts),
                             range(options.parts), retries=3, pure=False)
        for done, future in enumerate(as_completed(futures), 1):
            print(f"part {future.result()} done, {done} of {options.parts}", flush=True)
    subprocess.run(["unsnarl", "batch", options.meshes, "-o", options.out, "--summary"])


if __name__ == "__main__":
    main()
