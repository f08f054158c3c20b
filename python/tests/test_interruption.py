"""While a repair runs, Python does: other threads, progress, Ctrl-C, exceptions."""

import os
import queue
import signal
import threading

import numpy as np
import pytest

import unsnarl
from conftest import crossing_sheets


@pytest.fixture(scope="module")
def long_work():
    return crossing_sheets(60)


def test_progress_goes_forward(sheets):
    seen, threads = [], set()

    def watch(progress):
        seen.append(progress)
        threads.add(threading.get_ident())

    result = unsnarl.repair(*sheets, progress=watch)
    assert threads == {threading.get_ident()}
    assert len(seen) >= 3
    assert all(a.fraction <= b.fraction for a, b in zip(seen, seen[1:]))
    assert all(isinstance(progress, unsnarl.Progress) for progress in seen)
    assert seen[0].pairs_left > 0 and seen[0].displacement_rel == 0
    assert seen[-1].fraction == 1 and seen[-1].pairs_left == 0
    assert seen[-1].displacement_rel == pytest.approx(result.report["displacement_max_rel"])


@pytest.mark.parametrize("error", [LookupError, queue.Empty])
def test_an_exception_in_progress_cancels_and_is_raised(long_work, error):
    calls = []

    def fail(progress):
        calls.append(progress)
        raise error("enough")

    with pytest.raises(error, match="enough"):
        unsnarl.repair(*long_work, progress=fail)
    assert len(calls) == 1


def test_a_bar(sheets, capsys):
    unsnarl.repair(*sheets, progress=True)
    written = capsys.readouterr().err
    assert written.startswith("\r") and written.endswith("\n") and written.count("\n") == 1
    assert "untangle" in written and written.split("\r")[-1].startswith("100% |##############################|")
    unsnarl.repair(*sheets, progress=False)
    assert capsys.readouterr().err == ""


def test_other_threads_run_meanwhile(sheets):
    turns, done = [], threading.Event()

    def take_turns():
        while not done.wait(0.001):
            turns.append(1)

    thread = threading.Thread(target=take_turns)
    thread.start()
    before = len(turns)
    unsnarl.repair(*sheets)
    after = len(turns)
    done.set()
    thread.join()
    assert after - before > 3


@pytest.fixture(autouse=True)
def interruptible():
    """Python ignores Ctrl-C where it was started in the background of a shell; these tests would never end."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def interrupt_soon():
    timer = threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    return timer


def test_ctrl_c(long_work):
    timer = interrupt_soon()
    with pytest.raises(KeyboardInterrupt):
        while True:
            unsnarl.repair(*long_work)
    timer.join()


def test_ctrl_c_with_progress(long_work):
    timers = []

    def watch(_):
        if not timers:
            timers.append(interrupt_soon())

    with pytest.raises(KeyboardInterrupt):
        while True:
            unsnarl.repair(*long_work, progress=watch)
    timers[0].join()


def test_a_signal_that_raises_nothing_does_not_stop_it(sheets):
    heard = []
    before = signal.signal(signal.SIGINT, lambda *_: heard.append(1))
    try:
        result = unsnarl.repair(*sheets, progress=lambda _: heard or signal.raise_signal(signal.SIGINT))
    finally:
        signal.signal(signal.SIGINT, before)
    assert heard and result.status == "embedded"


def test_same_bytes_from_several_threads_at_once(sheets):
    expected, results = unsnarl.repair(*sheets).V, []
    threads = [
        threading.Thread(target=lambda count=count: results.append(unsnarl.repair(*sheets, threads=count).V))
        for count in (1, 2)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(V, expected) for V in results) and len(results) == 2
