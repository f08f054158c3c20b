"""The folders that the server of unsnarl.mcp may reach: it reads and writes nothing outside of them."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path


class Refused(Exception):
    """A name that is not served, or not as asked; the text says what to do."""


class Folders:
    """Folders and all below them, by their real paths: links that lead out of them lead nowhere."""

    def __init__(self, names: Sequence[str]) -> None:
        """Raises Refused where one of the names is no folder."""
        for name in names:
            if not Path(name).is_dir():
                raise Refused(f"{name} is no folder")
        self.roots = [Path(os.path.realpath(name)) for name in names]

    def existing(self, name: str) -> Path:
        """The real path of a file that is there. Relative names are looked for in each folder in turn.

        Raises Refused where it lies outside, or is not there, or is no file.
        """
        for path in self._inside(name):
            if path.is_file():
                return path
        raise Refused(f"There is no file {name!r} in {self}")

    def new(self, name: str) -> Path:
        """The real path of a file or folder that is to be made. Relative names are taken in the first folder.

        Raises Refused where it lies outside, is there already, or its folder is missing.
        """
        path = self._inside(name)[0]
        if os.path.lexists(path):
            raise Refused(f"{name!r} exists already, and nothing is ever overwritten; choose another name")
        if not path.parent.is_dir():
            raise Refused(f"The folder of {name!r} does not exist; choose one that does")
        return path

    def _inside(self, name: str) -> list[Path]:
        if "\0" in name or not name:
            raise Refused("A name is empty, or has a zero byte in it")
        paths = [Path(os.path.realpath(root / name)) for root in self.roots]  # an absolute name stays what it is
        inside = [path for path in paths if any(path.is_relative_to(root) for root in self.roots)]
        if not inside:
            raise Refused(f"{name!r} is outside of what this server may reach: {self}")
        return inside

    def __str__(self) -> str:
        return ", ".join(map(str, self.roots))


@contextmanager
def written_beside(output: Path) -> Iterator[Path]:
    """Where a file or folder is to be written first: what is found there in the end comes to its place, together with
    the files that were written beside it. Raises Refused where one of them exists by then; nothing is replaced."""
    with tempfile.TemporaryDirectory(prefix=".unsnarl-", dir=output.parent) as folder:
        yield Path(folder) / output.name
        written = sorted(Path(folder).iterdir())
        for path in written:
            if os.path.lexists(output.parent / path.name):
                raise Refused(f"{output.parent / path.name} exists already, and nothing is ever overwritten; choose "
                              "another folder")
        for path in written:
            path.rename(output.parent / path.name)
