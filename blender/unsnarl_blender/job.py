# SPDX-License-Identifier: GPL-3.0-or-later
"""Work that goes on in a thread of its own while Blender stays responsive."""

import threading


class Cancelled(Exception):
    """Nobody waits for the result any more."""


class Job:
    """Runs work(progress) in a thread. `progress` is to be handed to the library, which it tells to stop."""

    def __init__(self, work):
        self.progress = None  # the library's last Progress
        self._cancelled = False
        self._result = self._error = None
        self._thread = threading.Thread(target=self._run, args=(work,), name="unsnarl", daemon=True)
        self._thread.start()

    def _run(self, work):
        try:
            self._result = work(self._tell)
        except BaseException as error:  # raised where the result is asked for
            self._error = error

    def _tell(self, progress):
        if self._cancelled:
            raise Cancelled
        self.progress = progress

    def is_done(self):
        return not self._thread.is_alive()

    def cancel(self):
        """Has the library stop at its next step. Does not wait for it: nobody sees what it comes to."""
        self._cancelled = True

    def result(self):
        """What the work returned, or raises what it raised. Waits for it."""
        self._thread.join()
        if self._error is not None:
            raise self._error
        return self._result
