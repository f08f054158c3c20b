"""What programs and DLLs of Windows ask for, and the licences of what mingw-w64 has compiled into them."""

import re
import subprocess
from pathlib import Path

#: What every Windows 10 has.
WINDOWS = {"ADVAPI32.dll", "bcrypt.dll", "KERNEL32.dll", "msvcrt.dll", "ole32.dll", "PSAPI.DLL", "SHELL32.dll", "USER32.dll",
           "WS2_32.dll"}
#: Of Debian, whose runtime is linked statically: of the compiler, and of the C library for Windows.
RUNTIME = ["g++-mingw-w64-x86-64-posix", "mingw-w64-x86-64-dev"]


def check_windows_alone(files):
    """Raises unless each of these asks for DLLs of Windows alone."""
    for file in files:
        listed = subprocess.run(["x86_64-w64-mingw32-objdump", "-p", str(file)], capture_output=True, text=True, check=True)
        if foreign := {name for name in re.findall(r"DLL Name: (\S+)", listed.stdout) if name not in WINDOWS}:
            raise SystemExit(f"error: {Path(file).name} asks for {', '.join(sorted(foreign))}")


def strip(file):
    subprocess.run(["x86_64-w64-mingw32-strip", "--strip-unneeded", str(file)], check=True)


def windows_licences_of(build):
    """By name of a package, its copyright file: of what packaging/targets/static_dependencies has put where this build
    finds it, and of the runtime."""
    cache = (Path(build) / "CMakeCache.txt").read_text()
    prefix = Path(re.search(r"^UNSNARL_TARGET_PREFIX:\w+=(.*)$", cache, re.MULTILINE)[1])
    found = {file.stem: file for file in sorted((prefix / "share" / "licenses").iterdir())}
    found.update({name: Path("/usr/share/doc") / name / "copyright" for name in RUNTIME})
    return found
