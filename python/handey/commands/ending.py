"""How commands end: their exit statuses, deadlines and Ctrl-C."""

from __future__ import annotations

import argparse
import contextlib
import queue
import signal
import threading
import time
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, TypeVar

from handey.commands.terminal import complain, tell

if TYPE_CHECKING:
    from handey._core import CancelToken

__all__ = [
    "BAD_INPUT",
    "DEADLINE",
    "INTERNAL",
    "INTERRUPTED",
    "NOT_VALID",
    "NO_PLAN",
    "OK",
    "DeadlinePassedError",
    "deadline_passed",
    "interrupts",
    "within",
]

OK, NOT_VALID, BAD_INPUT, NO_PLAN, INTERNAL, DEADLINE, INTERRUPTED = 0, 1, 2, 3, 70, 124, 130
# Choice: after Ctrl-C the report of a planner that is told to stop is waited for so long [s].
TIME_TO_STOP = 1.0
Result = TypeVar("Result")


@contextlib.contextmanager
def interrupts() -> Iterator[threading.Event]:
    """Inside, Ctrl-C sets the event instead of raising `KeyboardInterrupt`.

    An exception that is raised while a module is imported may be lost; an event is not.
    """
    pressed = threading.Event()
    if threading.current_thread() is not threading.main_thread():  # where no signal arrives
        yield pressed
        return
    before = signal.signal(signal.SIGINT, lambda *_: pressed.set())
    try:
        yield pressed
    finally:
        signal.signal(signal.SIGINT, before)


class DeadlinePassedError(Exception):
    """The time given on the command line is over."""


def within(
    seconds: float | None, work: Callable[[], Result], cancel: CancelToken | None = None
) -> Result:
    """The result of `work`, done in a thread so that a deadline and Ctrl-C end the wait at once.

    Args:
        seconds: how long it is waited for.
        work: what is to be done.
        cancel: cancelled on Ctrl-C; then the work is given a moment to come to its end. The second
            Ctrl-C is not waited for.

    Raises:
        DeadlinePassedError: after `seconds`.
        Exception: whatever `work` raises.
    """
    answers: queue.SimpleQueue[tuple[Result | None, BaseException | None]] = queue.SimpleQueue()

    def answer() -> None:
        try:
            answers.put((work(), None))
        except BaseException as error:
            answers.put((None, error))

    threading.Thread(target=answer, daemon=True, name="handey-plan").start()
    try:
        result, error = answers.get(timeout=None if seconds is None else max(0.0, seconds))
    except queue.Empty:
        raise DeadlinePassedError from None
    except KeyboardInterrupt:
        if cancel is None:
            raise
        cancel.cancel()
        try:
            result, error = answers.get(timeout=TIME_TO_STOP)
        except queue.Empty:
            raise KeyboardInterrupt from None
    if error is not None:
        raise error
    return result  # type: ignore[return-value]


def deadline_passed(options: argparse.Namespace, start: float) -> int:
    """Tells that the time given on the command line is over."""
    summary = {
        "verdict": "unknown",
        "cpu_s": time.process_time(),
        "wall_s": time.monotonic() - start,
        "duration_s": None,
        "regrasps": None,
        "stages": {},
        "reasons": [f"the deadline of {options.deadline:g} s passed"],
    }
    tell(options, summary, [])
    complain(f"{options.cell}: the deadline of {options.deadline:g} s passed")
    return DEADLINE
