"""What programs and libraries are linked with, and how they are made to carry it with them (patchelf, binutils)."""

import os
import re
import shutil
import subprocess
from pathlib import Path

#: What every Linux with a GNU C library has, by PEP 600.
GLIBC = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "librt.so.1", "ld-linux-x86-64.so.2",
         "ld-linux-aarch64.so.1"}
#: What comes with it wherever there is a compiled program at all. One copy of it has to serve a whole process.
RUNTIME = {"libstdc++.so.6", "libgcc_s.so.1"}
#: The newest libstdc++ beside a glibc 2.x in the distributions that PEP 600 goes by (auditwheel's policies).
_LIBSTDCXX_BESIDE_GLIBC = {34: (3, 4, 29), 35: (3, 4, 30), 36: (3, 4, 30)}

#: Packages of headers that leave code in what is compiled with them and whose licences ask for their text beside it.
_COMPILED_IN = ["libcli11-dev", "libeigen3-dev", "nlohmann-json3-dev"]


def _output(*command):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, check=True).stdout


def machine_of(path):
    """The processor that a file is for, as tags of wheels and Debian's names of folders and tools begin."""
    (machine,) = re.findall(r"Machine:\s+(.*)", _output("readelf", "-h", path))
    return {"Advanced Micro Devices X86-64": "x86_64", "AArch64": "aarch64"}[machine]


def _tool(name, path):
    """The one of Debian's binutils that is for this file's processor."""
    return f"{machine_of(path)}-linux-gnu-{name}"


def needed(path):
    """Names of the shared libraries that a file asks for."""
    return set(re.findall(r"\(NEEDED\).*\[(.*)\]", _output("readelf", "-d", path)))


def closure(paths, without):
    """Files of all libraries of Debian that are loaded for these, by name, but for those named and what only they ask for."""
    todo, seen = list(paths), {}
    while todo:
        path = todo.pop()
        for name in needed(path) - without - set(seen):
            found = [folder / name for folder in _folders(path) if (folder / name).exists()]
            if not found:
                raise SystemExit(f"error: Debian's folders of libraries have no {name}, which {Path(path).name} asks for")
            seen[name] = found[0]
            todo.append(found[0])
    return dict(sorted(seen.items()))


def _folders(path):
    """Where Debian has the libraries of this file's processor."""
    return [Path(above) / f"{machine_of(path)}-linux-gnu" for above in ("/lib", "/usr/lib")]


def _newest(path, prefix):
    versions = re.findall(rf"\(?{prefix}_([\d.]+)\)?\s", _output(_tool("objdump", path), "-T", path))
    return max((tuple(map(int, v.split("."))) for v in versions), default=(0,))


def oldest_glibc(paths):
    """x of the oldest glibc 2.x that has every symbol that these files ask for, and beside which libstdc++ has."""
    x = max(_newest(path, "GLIBC") for path in paths)[1]
    asks = [path for path in paths if "libstdc++.so.6" in needed(path)]
    libstdcxx = max((_newest(path, "GLIBCXX") for path in asks), default=(0,))
    fitting = [y for y, newest in _LIBSTDCXX_BESIDE_GLIBC.items() if y >= x and newest >= libstdcxx]
    if not fitting:
        raise SystemExit(f"error: no known distribution has glibc 2.{x} and GLIBCXX {libstdcxx}")
    return min(fitting)


def bundle(files, folder, without, suffix=""):
    """Copies the libraries of these files into `folder` and has them find them there, wherever all are put together.

    suffix: goes into the names of the copies, for a process that may load others of the same names.
    Returns the files of which copies were made.
    """
    libraries = closure(files, without)
    folder.mkdir(parents=True, exist_ok=True)
    names = {name: re.sub(r"\.so\b", f"{suffix}.so", name, count=1) for name in libraries}
    copies = [folder / name for name in names.values()]
    for source, copy in zip(libraries.values(), copies):
        shutil.copyfile(source, copy)
        copy.chmod(0o755)
    for elf in [*files, *copies]:
        subprocess.run([_tool("strip", elf), "--strip-unneeded", elf], check=True)
        way = os.path.relpath(folder, elf.parent)
        changes = [("--replace-needed", name, names[name]) for name in sorted(needed(elf) & set(names)) if suffix]
        changes += [("--set-soname", elf.name)] if elf in copies else []
        changes += [("--set-rpath", "$ORIGIN" if way == "." else f"$ORIGIN/{way}")]
        for change in changes:  # patchelf 0.14 mixes them up in one call
            subprocess.run(["patchelf", *change, elf], check=True)
    return list(libraries.values())


def check_self_contained(folder, without):
    """Raises unless every program and library below `folder` asks for nothing but these and what lies there."""
    files = [p for p in folder.rglob("*") if p.is_file() and not p.is_symlink() and p.read_bytes()[:4] == b"\x7fELF"]
    inside = {p.name for p in files}
    for path in files:
        if foreign := needed(path) - without - inside:
            raise SystemExit(f"error: {path.name} asks for {', '.join(sorted(foreign))}")
    return files


def _packages_of(files):
    """The Debian packages that these files are of, and those that leave code in what is compiled."""
    found = set(_COMPILED_IN)
    for path in files:
        names = {str(path), str(path.resolve()), str(path.resolve()).removeprefix("/usr"), f"/usr{path}"}
        listed = subprocess.run(["dpkg", "-S", *names], capture_output=True, text=True).stdout
        if not listed:
            raise SystemExit(f"error: no package has {path}")
        found.add(listed.split(":")[0])
    return sorted(found)


def licences_of(files):
    """The copyright files of the Debian packages that these files are of, and of what is compiled in, by package."""
    return {package: Path("/usr/share/doc") / package / "copyright" for package in _packages_of(files)}


def versions_of(files):
    """A line for each of the same packages: its name and its version in Debian, to be held against Debian's advisories."""
    return "".join(sorted(_output("dpkg-query", "-W", "-f", "${Package} ${Version}\n", *_packages_of(files))
                          .splitlines(keepends=True)))
