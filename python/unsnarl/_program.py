"""The program that comes with this package, for what takes processes of its own or keeps a record in a folder."""

from __future__ import annotations

import errno
import json
import logging
import os
import queue
import re
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple, NoReturn, Optional

from ._call import next_news
from ._documents import Parts, text_of_rule
from ._options import PROGRAM_NAMES
from ._progress import OnProgress, Progress, ProgressBar, function_of
from ._types import Rules

_log = logging.getLogger("unsnarl")
_PATH = Path(__file__).with_name("bin") / ("unsnarl.exe" if sys.platform == "win32" else "unsnarl")

#: By exit code; what is not there is an error of the program's own.
_EXCEPTIONS = {2: ValueError, 3: OSError, 4: OSError, 5: MemoryError, 9: OSError}


class Ended(NamedTuple):
    """How a run of the program ended."""

    code: int
    said: list[str]  #: what it said on the way, line by line

    def fail(self) -> NoReturn:
        """Raises what it complained of."""
        lines = [line[len("unsnarl: ") :] for line in self.said if line.startswith("unsnarl: ")]
        message = "\n".join(lines) or f"{_PATH} ended with exit code {self.code}"
        kind = _EXCEPTIONS.get(self.code, RuntimeError)
        number = _error_number(message) if kind is OSError else None
        raise kind(message) if number is None else OSError(number, message)


def _error_number(message: str) -> Optional[int]:
    """The error of the system that a message ends with, in the system's words."""
    numbers = [n for n in errno.errorcode if re.search(re.escape(os.strerror(n)) + r"\b", message)]
    return max(numbers, key=lambda n: len(os.strerror(n))) if numbers else None


def path() -> Path:
    """Where the program is. Raises RuntimeError where the package was built without it."""
    if not _PATH.exists():
        raise RuntimeError(f"{_PATH} is missing: this package was built without the program unsnarl; install its wheel")
    return _PATH


def main() -> NoReturn:
    """``unsnarl`` on the command line, where pip has installed it."""
    os.execv(path(), ["unsnarl", *sys.argv[1:]])


def run(words: Sequence[str], progress: OnProgress = None) -> Ended:
    """Runs the program. Progress that it tells as JSON goes to `progress`, all else that it says to the logger.

    Ctrl-C, or an exception in `progress`, stops it as Ctrl-C does in a shell; what was raised is raised once it has.
    """
    show = function_of(progress)
    # In a session of its own: Ctrl-C in a terminal reaches this process alone, which passes it on once.
    child = subprocess.Popen(
        [str(path()), *words], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
        start_new_session=True, text=True, encoding="utf-8", errors="surrogateescape",
    )
    news: queue.SimpleQueue[Any] = queue.SimpleQueue()  # lines; False ends them
    reader = threading.Thread(target=_read, args=(child.stderr, news), name="unsnarl program", daemon=True)
    said: list[str] = []
    raised: Optional[BaseException] = None
    line: Any = None
    try:
        reader.start()
        while line is not False:
            try:
                line = next_news(news)
                if line:
                    _take(line, show, said)
                elif line is None and isinstance(show, ProgressBar):
                    show.show_again()
            except BaseException as error:
                if raised is None:
                    raised = error
                    child.send_signal(signal.SIGINT)
                elif not isinstance(error, Exception):
                    child.kill()
                show = None
        child.wait()
    finally:
        if child.poll() is None:  # interrupted between the lines above
            child.kill()
            child.wait()
        if isinstance(show, ProgressBar):
            show.close()
    if raised is not None:
        raise raised
    return Ended(child.returncode, said)


def _read(lines: Any, news: queue.SimpleQueue[Any]) -> None:
    with lines:
        for line in lines:
            news.put(line.rstrip("\n"))
    news.put(False)


def _take(line: str, show: Any, said: list[str]) -> None:
    if not line.startswith("{"):
        said.append(line)
        _log.info("%s", line)
        return
    if show is not None:
        told = json.loads(line)
        show(Progress(told["fraction"], told["phase"], told["pairs_left"] or 0, told["displacement_rel"]))


def words_of(**options: Any) -> list[str]:
    """Options of ``unsnarl fix`` by their names in Python; those that are None, False or 0 are its defaults."""
    words: list[str] = []
    for name, value in options.items():
        option = PROGRAM_NAMES.get(name, "--" + name.replace("_", "-"))
        if value is True:
            words.append(option)
        elif value is not None and value is not False and value != 0:
            words += [option, repr(float(value)) if isinstance(value, float) else str(value)]
    return words


def words_of_parts(fix: Parts, only: Parts) -> list[str]:
    return [
        word
        for prefix, parts in (("fix", fix), ("only", only))
        for option, _, name in parts.named(prefix)
        for word in ("--" + option.replace("_", "-"), str(name))
    ]


def words_of_rules(allow: Rules) -> list[str]:
    rules = [] if allow is None else [allow] if isinstance(allow, (str, tuple)) else allow
    return [word for rule in rules for word in ("--allow", text_of_rule(rule))]


@contextmanager
def scratch_folder() -> Iterator[Path]:
    with tempfile.TemporaryDirectory(prefix="unsnarl-") as folder:
        yield Path(folder)
