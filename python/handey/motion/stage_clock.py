"""How long does each stage of planning take, and which one is under way?"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

__all__ = ["StageClock"]


class StageClock:
    """CPU seconds by stage, counted by `with clock("approach"):`; stages do not nest.

    Attributes:
        seconds: by stage.
        trying: what is tried now: "goal 0, grasp 3 of 12".
    """

    def __init__(self, progress: Callable[[str, str], None] | None = None) -> None:
        """`progress` is told each stage as it begins, and what of it is tried."""
        self.seconds: dict[str, float] = {}
        self.trying = ""
        self._stage, self._progress = "", progress

    def tell(self, detail: str = "") -> None:
        """Tell how far the stage is: "window 2 of 5"."""
        if self._progress is not None:
            self._progress(self._stage, ", ".join(t for t in (self.trying, detail) if t))

    @contextmanager
    def __call__(self, stage: str) -> Iterator[None]:
        """Count the time of the block for `stage`."""
        self._stage = stage
        self.tell()
        begin = time.process_time()
        try:
            yield
        finally:
            self.seconds[stage] = self.seconds.get(stage, 0.0) + time.process_time() - begin
