"""How far the moving bodies keep from all others along a plan: a curve, with the nearest pair.

Sampled, by the pairs and the engine of the check: what may touch (fingers and the part they take, a
part and what it stands on) does not count while it may. The least of the curve is a picture; what
holds between the samples is for the check to prove.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from handey.check.carries import find_carries
from handey.check.cell import Cell
from handey.check.collisions import Collisions
from handey.check.kinematics import forward
from handey.check.plan_data import PlanData, Step
from handey.check.report import CheckReport
from handey.check.solids import Engine, Placed
from handey.check.sweep import HORIZON, Actor, Job, Samples, lower_bounds
from handey.check.values import Array

__all__ = ["ClearanceCurve", "clearance_along"]

MOST_SAMPLES, EVERY = 150, 0.02  # of one step; between two samples [s]
FINER = 40  # more about the least


@dataclass
class ClearanceCurve:
    """Clearance by time.

    Attributes:
        time: of the samples (n,) [s].
        distance: to the nearest body, 0.1 m where none is nearer (n,) [m].
        between: index into `pairs` by sample, -1 where nothing is near (n,).
        pairs: names of two bodies.
    """

    time: Array
    distance: Array
    between: np.ndarray
    pairs: list[tuple[str, str]]


def clearance_along(cell: Cell, plan: PlanData) -> ClearanceCurve | None:
    """The curve of a plan, valid or not; None for one without motion."""
    if not plan.steps:
        return None
    carries, world = find_carries(plan, cell)
    collisions = Collisions(cell, plan, carries, world, CheckReport())
    times = [(step, _times(step)) for step in plan.steps]
    curve = _curve(cell, collisions, times)
    # Once more about the least, which is the figure that is told.
    at = float(curve.time[int(np.argmin(curve.distance))])
    near = [(step, _about(at, own)) for step, own in times if own[0] <= at <= own[-1]]
    return _merged(curve, _curve(cell, collisions, near))


def _times(step: Step) -> Array:
    first, last = step.time[0], step.time[-1]
    count = int(np.clip(np.ceil((last - first) / EVERY) + 1, 2, MOST_SAMPLES))
    return np.linspace(first, last, count)


def _about(at: float, times: Array) -> Array:
    k = int(np.argmin(np.abs(times - at)))
    return np.linspace(times[max(k - 1, 0)], times[min(k + 1, len(times) - 1)], FINER)


def _merged(a: ClearanceCurve, b: ClearanceCurve) -> ClearanceCurve:
    time = np.concatenate([a.time, b.time])
    order = np.argsort(time, kind="stable")
    between = np.where(b.between < 0, -1, b.between + len(a.pairs))
    return ClearanceCurve(
        time[order],
        np.concatenate([a.distance, b.distance])[order],
        np.concatenate([a.between, between])[order],
        a.pairs + b.pairs,
    )


def _curve(cell: Cell, collisions: Collisions, times: list[tuple[Step, Array]]) -> ClearanceCurve:
    samples = _samples(cell, times)
    nearest = _Nearest(samples, collisions.engine)
    for job in collisions.jobs(samples):
        nearest.add(job)
    return nearest.curve()


def _samples(cell: Cell, times: list[tuple[Step, Array]]) -> Samples:
    """Configurations at the times of each step; the last twice, as the end of its interval."""
    rows, openings, owner = [], [], []
    for step, wanted in times:
        rows.append(np.column_stack([np.interp(wanted, step.time, q) for q in step.q.T]))
        openings.append(np.interp(wanted, step.time, step.opening))
        owner += [step.index] * len(wanted)
    q, opening = np.vstack(rows), np.concatenate(openings)
    time = np.concatenate([wanted for _, wanted in times])
    q, opening, time = (np.concatenate([a, a[-1:]]) for a in (q, opening, time))
    return Samples(q, opening, time, np.array(owner), forward(cell.robot, cell.base, q, opening))


class _Nearest:
    """The nearest pair at each sample; the engine is asked only where bounds leave it open."""

    def __init__(self, samples: Samples, engine: Engine) -> None:
        self.samples, self.engine = samples, engine
        count = len(samples.step)
        self.least = np.full(count, HORIZON)
        self.between = np.full(count, -1)
        self.pairs: list[tuple[str, str]] = []
        self._waiting: list[tuple[Job, int, int, Array]] = []

    def add(self, job: Job) -> None:
        """A pair of bodies, where it counts."""
        counts = job.live & job.clears
        for i, j, bound in lower_bounds(self.samples.frames, job, counts, HORIZON):
            self._waiting.append((job, i, j, np.where(counts, bound[:-1], np.inf)))

    def curve(self) -> ClearanceCurve:
        """Asks, the nearest bounds first."""
        if self._waiting:
            bounds = np.array([bound for *_, bound in self._waiting])
            order = np.argsort(bounds, axis=0)
            for k in range(bounds.shape[1]):
                for which in order[:, k]:
                    if bounds[which, k] >= self.least[k]:
                        break
                    self._ask(k, *self._waiting[which][:3])
        return ClearanceCurve(self.samples.time[:-1], self.least, self.between, self.pairs)

    def _ask(self, k: int, job: Job, i: int, j: int) -> None:
        a, b = self._placed(job.a, i, k), self._placed(job.b, j, k)
        found = 0.0 if self.engine.contains(a, b) else max(self.engine.distance(a, b), 0.0)
        if found < self.least[k]:
            names = (job.a.name, job.b.name)
            if names not in self.pairs:
                self.pairs.append(names)
            self.least[k], self.between[k] = found, self.pairs.index(names)

    def _placed(self, actor: Actor, piece: int, k: int) -> Placed:
        R, p = actor.poses(self.samples.frames)
        at = k if len(R) > 1 else 0
        return Placed(actor.pieces[piece], R[at], p[at])
