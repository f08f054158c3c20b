#!/usr/bin/env python3
"""Checks what the sources include.

layers  a file includes only from its own layer or one below, and the core, which works on arrays, nothing of files;
        public headers only each other and the standard library; the command line, the C interface and the examples
        only public headers and files of their own folder, and the command line those of src/platform
        and src/text
lgpl    the product includes nothing of libraries under the GPL or LGPL; its tests may
systems only the folders of src/platform include headers of a system, or ask which system it is

usage: check_includes.py {layers,lgpl,systems} PROJECT_DIR
"""

import re
import sys
from pathlib import Path

# What each layer may include besides itself and the public headers. Keep in step with src/CMakeLists.txt.
BELOW = {
    "platform": [],
    "text": [],
    "geometry": [],
    "run": ["platform", "geometry"],
    "mesh": ["geometry"],
    "contact": ["geometry", "mesh"],
    "energy": ["geometry", "mesh", "contact"],
    "optimize": ["geometry"],
    "io": ["platform", "text", "geometry", "mesh"],
    "render": ["geometry", "mesh"],
    "scene": ["geometry", "mesh", "contact"],
    "rigid": ["geometry", "mesh", "contact"],
    "recover": ["geometry", "mesh", "contact", "energy", "optimize", "scene"],
    "untangle": ["geometry", "mesh", "contact", "energy", "optimize", "scene", "rigid", "recover"],
    "report": ["platform", "geometry", "mesh", "contact", "energy", "io", "scene", "rigid", "untangle"],
    "pipeline": ["geometry", "run", "mesh", "contact", "energy", "optimize", "io", "render", "scene", "rigid", "recover",
                 "untangle", "report"],
    "applications": ["text", "geometry", "run", "mesh", "contact", "energy", "optimize", "io", "render"],
    "samples": ["geometry", "mesh"],
}
# These layers read and write files, as the folders `files` of other layers do: they are no part of the core.
FILES = {"io", "render"}
# They use the library as its users do.
USERS = ["apps", "src/c_interface", "examples"]
MAY_USE = {"apps": ("unsnarl/", "platform/", "text/")}
THIRD_PARTY = re.compile(r"^(Eigen|CGAL|tbb|oneapi|fmt|nlohmann|CLI|png|zlib|boost|gmp|mpfr|pugixml|gtest|benchmark)\b")
OF_A_SYSTEM = re.compile(
    r"^(sys/|linux/|net/|netinet/|arpa/|mach|unistd\.h|fcntl\.h|signal\.h|csignal|pthread\.h|sched\.h|glob\.h|fnmatch\.h|"
    r"dirent\.h|dlfcn\.h|poll\.h|spawn\.h|termios\.h|malloc\.h|pwd\.h|windows\.h|psapi\.h|shellapi\.h|bcrypt\.h|io\.h|"
    r"direct\.h|process\.h|conio\.h|winsock)")
NAMES_A_SYSTEM = re.compile(
    r"^\s*#\s*(if|ifdef|ifndef|elif)\b.*\b(_WIN32|_WIN64|WIN32|__MINGW\w*__|_MSC_VER|__CYGWIN__|__linux__|__unix__|__APPLE__|"
    r"__GLIBC__|__EMSCRIPTEN__|_POSIX_\w+)\b")
LGPL = re.compile(r"^(CGAL/|gmp|mpfr|boost/multiprecision/(gmp|mpfr)|mpreal)")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def quoted_and_included(path):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if match := INCLUDE.match(line):
            yield number, match[1] == '"', match[2]


def includes(path):
    for number, _, included in quoted_and_included(path):
        yield number, included


def sources(folder):
    return sorted(p for p in folder.rglob("*") if p.suffix in {".h", ".cpp"})


def layer_of(included):
    first, _, rest = included.partition("/")
    return first if rest and (first in BELOW or f"src/{first}" in USERS) else None


def check_layers(project):
    for path in sources(project / "include"):
        for number, included in includes(path):
            if THIRD_PARTY.match(included) or layer_of(included):
                yield f"{path}:{number}: public header includes <{included}>; it may include only unsnarl/* and std"
    for layer, below in BELOW.items():
        folder = project / layer if layer == "samples" else project / "src" / layer
        for path in sources(folder):
            for number, included in includes(path):
                if included.startswith(("src/", "apps/", "tests/", "../")):
                    yield f"{path}:{number}: '{included}'; include paths are relative to src/ or include/"
                    continue
                other = layer_of(included)
                is_core = layer not in FILES and "files" not in path.relative_to(folder).parts
                if is_core and (other in FILES or "files" in Path(included).parts):
                    yield (f"{path}:{number}: '{included}'; what reads or writes files belongs in a folder `files`, "
                           "the core works on arrays")
                    continue
                if other and other != layer and other not in below:
                    yield (f"{path}:{number}: layer '{layer}' includes '{included}' of layer '{other}'; "
                           f"it may include from {', '.join([layer, *below])}")
    for user in USERS:
        for path in sources(project / user):
            for number, quoted, included in quoted_and_included(path):
                if included.startswith(MAY_USE.get(user, ("unsnarl/",))) or is_own_or_foreign(project, user, path, quoted, included):
                    continue
                yield (f"{path}:{number}: '{included}'; {user}/ may include unsnarl/* and files of its own program: "
                       "what it needs of the library becomes a public header")


def is_own_or_foreign(project, user, path, quoted, included):
    """A file beside `path` or in a folder above it of the same program, or a header of a system or foreign library."""
    if ".." in Path(included).parts:
        return False
    own = [folder for folder in path.parents if (project / user) in [folder, *folder.parents]]
    if quoted and any((folder / included).is_file() for folder in own):
        return True
    return not quoted and not any((project / root / included).exists() for root in ("", "src", "include"))


def check_lgpl(project):
    for folder in ("include", "src", "samples", "apps", "python", "examples"):
        for path in sources(project / folder):
            for number, included in includes(path):
                if LGPL.match(included):
                    yield f"{path}:{number}: includes <{included}>, which is under the LGPL or the GPL"


def check_systems(project):
    rooms = [project / "src" / "platform" / system for system in ("posix", "webassembly", "windows")]
    for folder in ("include", "src", "samples", "apps", "examples"):
        for path in sources(project / folder):
            if any(room in path.parents for room in rooms):
                continue
            for number, quoted, included in quoted_and_included(path):
                if not quoted and OF_A_SYSTEM.match(included):
                    yield f"{path}:{number}: includes <{included}> of one system; src/platform asks systems"
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                if NAMES_A_SYSTEM.match(line):
                    yield f"{path}:{number}: '{line.strip()}'; src/platform has a file a system instead"


CHECKS = {"layers": check_layers, "lgpl": check_lgpl, "systems": check_systems}


def main():
    if len(sys.argv) != 3 or sys.argv[1] not in CHECKS:
        sys.exit(__doc__)
    findings = list(CHECKS[sys.argv[1]](Path(sys.argv[2])))
    for finding in findings:
        print(finding)
    sys.exit(1 if findings else 0)


if __name__ == "__main__":
    main()
