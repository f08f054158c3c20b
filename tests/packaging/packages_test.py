#!/usr/bin/env python3
"""The Debian package holds all that is installed; the tarball runs wherever it is put. usage: packages_test.py BUILD"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
SKIPPED = 77
INSTALLED = [
    "bin/unsnarl", "include/unsnarl/repair.h", "include/unsnarl/unsnarl.h", "lib/libunsnarl.a", "lib/libunsnarl_c.so",
    "lib/cmake/unsnarl/unsnarl-config.cmake", "share/man/man1/unsnarl.1.gz", "share/doc/unsnarl/copyright",
    "share/bash-completion/completions/unsnarl.bash", "share/zsh/vendor-completions/_unsnarl",
    "share/fish/vendor_completions.d/unsnarl.fish",
]


def output(*command, **options):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, check=True, **options).stdout


def main():
    for tool in ("patchelf", "dpkg-shlibdeps"):
        if not shutil.which(tool):
            print(f"{tool} is not installed")
            sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as work:
        target = Path(work) / "packages"
        target.mkdir()
        (target / "notes.txt").write_text("of somebody")
        made = output(sys.executable, "-B", PROJECT / "packaging" / "build_packages", "--build-dir", sys.argv[1], "-o",
                      target)
        deb, tarball = made.split()
        assert sorted(map(str, target.iterdir())) == sorted([deb, tarball, str(target / "notes.txt")])
        held = {line.split()[5] for line in output("dpkg-deb", "-c", deb).splitlines()}
        missing = [path for path in INSTALLED if f"./usr/{path}" not in held]
        assert not missing, missing
        assert "libtbb12" in output("dpkg-deb", "-f", deb, "Depends")

        assert "-linux-x86_64-glibc2." in tarball
        output("tar", "-xzf", tarball, "-C", work)
        (content,) = Path(work).glob("unsnarl-*")
        place = content.rename(Path(work) / "elsewhere")
        assert (place / "share/doc/unsnarl/licenses/libgmp10.txt").stat().st_size > 1000
        for line in output("ldd", place / "bin" / "unsnarl").splitlines():
            if "libtbb" in line or "libstdc++" in line:
                assert str(place) in os.path.normpath(line.split(" => ")[1]), line
        mesh = Path(work) / "mesh.obj"
        output(place / "bin/unsnarl", "sample", "crossing_tubes", "--resolution", "12", "-o", mesh, env={})
        output(place / "bin/unsnarl", "fix", mesh, "-o", mesh.with_name("fixed.obj"), env={})


if __name__ == "__main__":
    main()
