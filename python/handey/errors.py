"""What can go wrong, as exceptions with every fault named.

A planner that finds no plan is not an error: it returns a result that says why. Wrong input is one:
`InvalidInput` holds all the faults that were found, each with its kind, its place and what was
expected.
"""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ["Fault", "HandeyError", "InvalidInput", "Stopped"]


@dataclass(frozen=True)
class Fault:
    """One fault of an input.

    Attributes:
        code: kind of fault, for programs: ``E_NUMBER``, ``E_UNKNOWN_KEY``, ...
        place: where it is: ``parts.bracket.pose.xyz``, ``joint 'joint2' (line 12)``; may be empty.
        message: what was found and what was expected.
        file: the file that has the fault; empty for values passed in a program.
    """

    code: str
    place: str
    message: str
    file: str = ""

    def __str__(self) -> str:
        return ": ".join(part for part in (self.file, self.place, self.message) if part)


class HandeyError(Exception):
    """Base of all errors that handey raises on purpose."""


class InvalidInput(HandeyError, ValueError):
    """Wrong numbers, names, shapes of arrays or files.

    Attributes:
        faults: all faults found, in the order of the input.
    """

    def __init__(self, faults: list[Fault] | Fault) -> None:
        self.faults: list[Fault] = [faults] if isinstance(faults, Fault) else list(faults)
        super().__init__("\n".join(str(fault) for fault in self.faults))


class Stopped(Exception):
    """Raised by a stage of the core that is told to stop; `plan` answers with a report instead.

    Attributes:
        cause: "cancelled" or "deadline".
    """

    def __init__(self, cause: str) -> None:
        self.cause = cause
        super().__init__("the deadline passed" if cause == "deadline" else "cancelled")
