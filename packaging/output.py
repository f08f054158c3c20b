"""What all packages have in common: they go into a folder of which nothing else is touched, and the same sources give
the same bytes, whenever and wherever they are packed."""

import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from datetime import datetime, timezone

#: The time of everything inside, unless SOURCE_DATE_EPOCH says another: 2026-01-01, as seconds since 1970.
DATE = os.environ.setdefault("SOURCE_DATE_EPOCH", "1767225600")
os.environ["TZ"] = "UTC"
os.umask(0o022)


def put(package, folder):
    """Moves a finished file into a folder that may hold anything, in place of a file of its name. Returns its place."""
    place = folder / package.name
    with tempfile.TemporaryDirectory(prefix=".unfinished-", dir=folder) as beside:  # on the same file system
        os.replace(shutil.move(package, beside), place)
    return place


def pack_tar(folder, archive):
    """Packs a folder under its own name."""
    subprocess.run(["tar", "-C", folder.parent, "--format=ustar", "--sort=name", f"--mtime=@{DATE}", "--owner=0",
                    "--group=0", "--numeric-owner", "--mode=u=rwX,go=rX", "--use-compress-program=gzip -9n", "-cf", archive,
                    folder.name], check=True)


def pack_zip(folder, archive):
    """Packs a folder under its own name."""
    time = datetime.fromtimestamp(int(DATE), timezone.utc).timetuple()[:6]
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as packed:
        for file in sorted(path for path in folder.rglob("*") if path.is_file()):
            packed.writestr(zipfile.ZipInfo(str(file.relative_to(folder.parent)), time), file.read_bytes(), zipfile.ZIP_DEFLATED)


def require_tools(debian_packages):
    """Ends the process where one of these programs is missing. By program the Debian package that has it."""
    missing = [package for program, package in debian_packages.items() if not shutil.which(program)]
    if missing:
        sys.exit(f"error: missing on this machine. Debian: apt-get install --no-install-recommends {' '.join(missing)}")
