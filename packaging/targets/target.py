"""What the scripts of all targets have in common: a bare Debian root, the sources and a build in it, its tests."""

import argparse
import filecmp
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "packaging"))
from bare_root import make_root, runner  # noqa: E402
from output import put  # noqa: E402

#: Where sources and builds lie in a root: a build that is there already is continued.
PLACE = "opt/unsnarl"
#: Tests of the core, by layer.
CORE_TESTS = ["text", "geometry", "parallel_by_threads", "run", "mesh", "contact", "energy", "optimize", "scene", "rigid",
              "recover", "untangle", "pipeline", "property", "applications", "same_bytes"]
#: Options of CMake for the core alone, where neither oneTBB nor CGAL is.
CORE = ["-DUNSNARL_BUILD_IO=OFF", "-DUNSNARL_BUILD_APPS=OFF", "-DUNSNARL_USE_TBB=OFF", "-DUNSNARL_TEST_ORACLE=OFF"]
#: Packages of headers alone, and what every build uses.
HEADERS = ["libboost-dev", "libcli11-dev", "libeigen3-dev", "nlohmann-json3-dev"]
TOOLS = ["cmake", "ninja-build", "python3"]
#: Packages of libraries, which are of one processor; those that only tests ask.
LIBRARIES = ["libfmt-dev", "libgif-dev", "libgtest-dev", "libpng-dev", "libpugixml-dev", "libtbb-dev",
             "libzip-dev", "zlib1g-dev"]
ORACLES = ["libcgal-dev", "libgmp-dev", "libmpfr-dev"]
#: What is built in a root for a target that Debian has no libraries for, and is found there.
PREFIX = f"/{PLACE}/prefix"


def options_of(description, tests, output=None):
    """A parser of the command line: roots, which of these tests are wanted, and a folder where there is something to
    put into it."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--roots", type=Path, default=PROJECT / "out" / "roots", metavar="FOLDER",
                        help="where the root is made, or was made before")
    parser.add_argument("--tests", nargs="+", default=tests, choices=tests, metavar="LAYER",
                        help="build and run these alone")
    if output:
        parser.add_argument("-o", "--output", type=Path, default=output, metavar="FOLDER",
                            help="where packages are put")
    return parser


def root_with_sources(roots, packages, architectures=(), environment={}):
    """A root with these packages and what git knows of the project, and a function that runs a command beside it."""
    root = make_root(roots.resolve(), "bookworm", packages, architectures)
    copy_sources(root / PLACE / "project")
    installed = runner(root, "/")("dpkg-query", "-W", "-f", "${Installed-Size}\n").splitlines()
    size = sum(int(kB or 0) for kB in installed) / 1e6
    print(f"root: {len(installed)} packages of bookworm, {size:.1f} GB", flush=True)
    return root, runner(root, f"/{PLACE}", environment=environment)


def timed(what, command, *arguments, **named):
    """Calls a function and says on standard error how long it took."""
    print(f"{what} ...", end=" ", file=sys.stderr, flush=True)
    start = time.monotonic()
    result = command(*arguments, **named)
    print(f"{time.monotonic() - start:.0f} s", file=sys.stderr)
    return result


def copy_sources(target):
    """Brings a folder to what git knows of the project. Files that are the same stay as old as they are."""
    listed = subprocess.run(["git", "ls-files", "-coz", "--exclude-standard"], cwd=PROJECT, capture_output=True,
                            text=True, check=True).stdout
    names = {name for name in listed.split("\0") if (PROJECT / name).is_file()}
    for file in [file for file in target.rglob("*") if file.is_file() and str(file.relative_to(target)) not in names]:
        file.unlink()
    for name in names:
        if not (target / name).is_file() or not filecmp.cmp(PROJECT / name, target / name, shallow=False):
            (target / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(PROJECT / name, target / name)


def toolchain(name):
    """The option that takes this toolchain file of ours."""
    return f"-DCMAKE_TOOLCHAIN_FILE=/{PLACE}/project/packaging/targets/{name}.cmake"


def build_googletest(run, *options):
    """GoogleTest of the package's sources, by this compiler."""
    run("cmake", "-S", "/usr/src/googletest", "-B", "googletest", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
        "-DBUILD_GMOCK=OFF", f"-DCMAKE_INSTALL_PREFIX={PREFIX}", "-DCMAKE_INSTALL_LIBDIR=lib", *options)
    timed("building GoogleTest", run, "cmake", "--build", "googletest", "--target", "install")


def build(run, folder, targets, *options):
    """Configures a release in this folder and builds these targets, several files at once."""
    run("cmake", "-S", "project", "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_UNITY_BUILD=ON",
        "-DCMAKE_GTEST_DISCOVER_TESTS_DISCOVERY_MODE=PRE_TEST", *options)
    timed(f"building {' '.join(targets)}", run, "cmake", "--build", folder, "--target", *targets)


def print_sizes(root, *files):
    """Sizes of what was built, given by path from the project's place in the root."""
    for file in files:
        print(f"built: {Path(file).name}, {(root / PLACE / file).stat().st_size / 1e6:.2f} MB", flush=True)


def pack_wheel(root, run, target):
    """The wheel of what is in the folder `build`. Returns where it lies in the folder `target`."""
    run("rm", "-rf", "wheel")
    timed("packing the wheel", run, "python3", "-B", "project/packaging/build_wheel", "--build-dir", f"/{PLACE}/build",
          "-o", "wheel")
    (wheel,) = (root / PLACE / "wheel").glob("*.whl")
    target.mkdir(parents=True, exist_ok=True)
    wheel = put(wheel, target)
    print(f"built: {wheel.name}, {wheel.stat().st_size / 1e6:.2f} MB", flush=True)
    return wheel


def run_tests(run, folder, names, emulator=(), ending="", left_out={}):
    """Runs GoogleTest programs, prints a line for each, and returns the lines of those tests that failed.

    emulator: what runs the program. left_out: by program a filter of tests that are not run, as GoogleTest takes it.
    """
    failed = []
    for name in names:
        start = time.monotonic()
        without = f"--gtest_filter=-{left_out[name]}" if name in left_out else "--gtest_brief=0"
        written = run(*emulator, f"{folder}/tests/test_{name}{ending}", without, expected=None)
        seconds = time.monotonic() - start
        passed = re.search(r"\[  PASSED  \] (\d+) test", written)
        skipped = re.search(r"\[  SKIPPED \] (\d+) test", written)
        broken = re.findall(r"^\[  FAILED  \] ([\w./]+)(?:, where.*)?$", written, re.MULTILINE)
        if not passed and not broken:
            broken.append("ended early: " + " / ".join(written.splitlines()[-3:]))
        failed += [f"test_{name}: {test}" for test in broken]
        print(f"tested: test_{name}, {passed[1] if passed else 0} passed"
              + (f", {skipped[1]} skipped" if skipped else "") + (f", {len(broken)} FAILED" if broken else "")
              + (f", left out {left_out[name]}" if name in left_out else "") + f", {seconds:.1f} s", flush=True)
    return failed


def end(options, tests, failed, not_tested):
    """Says what was not tested, and ends with exit code 1 where a test failed."""
    left = [f"test_{name}" for name in tests if name not in options.tests]
    for line in [*([", ".join(left)] if left else []), *not_tested]:
        print(f"not tested: {line}")
    for line in failed:
        print(f"FAILED: {line}")
    sys.exit(1 if failed else 0)
