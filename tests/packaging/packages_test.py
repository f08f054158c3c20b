#!/usr/bin/env python3
"""The Debian packages hold all that is installed; the tarball runs wherever it is put; both are the same bytes twice. usage: packages_test.py BUILD"""

import filecmp
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from hardening_test import weaknesses

PROJECT = Path(__file__).resolve().parents[2]
SKIPPED = 77
INSTALLED = {
    "unsnarl": [
        "bin/unsnarl", "lib/libunsnarl_c.so.0", "share/man/man1/unsnarl.1.gz", "share/doc/unsnarl/copyright",
        "share/doc/unsnarl/README.md", "share/doc/unsnarl/docs/report.md", "share/doc/unsnarl/SECURITY.md",
        "share/bash-completion/completions/unsnarl.bash", "share/zsh/vendor-completions/_unsnarl",
        "share/fish/vendor_completions.d/unsnarl.fish",
    ],
    "libunsnarl-dev": [
        "include/unsnarl/repair.h", "include/unsnarl/unsnarl.h", "include/unsnarl/version.h", "lib/libunsnarl.a",
        "lib/libunsnarl_c.so", "lib/cmake/unsnarl/unsnarl-config.cmake", "lib/pkgconfig/unsnarl.pc",
        "lib/pkgconfig/unsnarl_c.pc", "share/doc/libunsnarl-dev/copyright", "share/doc/unsnarl/examples/CMakeLists.txt",
        "share/doc/unsnarl/examples/two_calls.cpp",
    ],
}


def output(*command, **options):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, check=True, **options).stdout


def pack(target, **options):
    return output(sys.executable, "-B", PROJECT / "packaging" / "build_packages", "--build-dir", sys.argv[1], "-o", target,
                  **options).split()


def main():
    for tool in ("patchelf", "dpkg-shlibdeps", "file"):
        if not shutil.which(tool):
            print(f"{tool} is not installed")
            sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as work:
        target = Path(work) / "packages"
        target.mkdir()
        (target / "notes.txt").write_text("of somebody")
        deb, dev, tarball = pack(target)
        assert sorted(map(str, target.iterdir())) == sorted([deb, dev, tarball, str(target / "notes.txt")])
        for package in (deb, dev):
            held = {line.split()[5] for line in output("dpkg-deb", "-c", package).splitlines()}
            name = output("dpkg-deb", "-f", package, "Package").strip()
            missing = [path for path in INSTALLED[name] if f"./usr/{path}" not in held]
            assert not missing, missing
            other = [path for path in held if path.endswith((".h", ".a", ".cmake", ".pc"))]
            assert (name == "unsnarl") == (not other), other
        assert "libtbb12" in output("dpkg-deb", "-f", deb, "Depends")
        assert "-dev" not in output("dpkg-deb", "-f", deb, "Depends")
        needed = set(re.split(r", | \(= [^)]+\), |\n", output("dpkg-deb", "-f", dev, "Depends")))
        assert {"unsnarl", "libtbb-dev", "libgif-dev", "libzip-dev"} <= needed, needed

        # Packed once more, at another time and from another folder: the same bytes.
        for first, again in zip((deb, dev, tarball), pack(Path(work) / "again", umask=0o077)):
            assert filecmp.cmp(first, again, shallow=False), f"{Path(first).name} differs"

        assert "-linux-x86_64-glibc2." in tarball
        output("tar", "-xzf", tarball, "-C", work)
        (content,) = Path(work).glob("unsnarl-*")
        place = content.rename(Path(work) / "elsewhere")
        assert (place / "share/doc/unsnarl/licenses/libpugixml1v5.txt").stat().st_size > 1000
        versions = dict(line.split() for line in (place / "share/doc/unsnarl/licenses/versions.txt").read_text().splitlines())
        assert versions["libpugixml1v5"] and versions["libeigen3-dev"], versions
        for elf, built in (("bin/unsnarl", "unsnarl"), ("lib/libunsnarl_c.so.0", "src/c_interface/libunsnarl_c.so.0")):
            assert set(weaknesses(place / elf)) <= set(weaknesses(Path(sys.argv[1]) / built)), elf
        for line in output("ldd", place / "bin" / "unsnarl").splitlines():
            if "libtbb" in line or "libstdc++" in line:
                assert str(place) in os.path.normpath(line.split(" => ")[1]), line
        mesh = Path(work) / "mesh.obj"
        output(place / "bin/unsnarl", "sample", "crossing_tubes", "--resolution", "12", "-o", mesh, env={})
        output(place / "bin/unsnarl", "fix", mesh, "-o", mesh.with_name("fixed.obj"), env={})


if __name__ == "__main__":
    main()
