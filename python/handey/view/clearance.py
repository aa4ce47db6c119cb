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
from handey.check.solids import Placed
from handey.check.sweep import HORIZON, Actor, Job, Samples, Sweep, lower_bounds
from handey.check.values import Array

__all__ = ["ClearanceCurve", "clearance_along"]

MOST_SAMPLES, EVERY = 150, 0.02  # of one step; between two samples [s]
MANY, SLOW = 3000, 0.06  # triangles of a surface that takes long; between samples then [s]
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
    every = SLOW if _is_slow(cell) else EVERY
    times = [(step, _times(step, every)) for step in plan.steps]
    curve = _curve(cell, collisions, times)
    # Once more about the least, which is the figure that is told.
    at = float(curve.time[int(np.argmin(curve.distance))])
    near = [(step, _about(at, own)) for step, own in times if own[0] <= at <= own[-1]]
    return _merged(curve, _curve(cell, collisions, near))


def _times(step: Step, every: float) -> Array:
    first, last = step.time[0], step.time[-1]
    count = int(np.clip(np.ceil((last - first) / every) + 1, 2, MOST_SAMPLES))
    return np.linspace(first, last, count)


def _is_slow(cell: Cell) -> bool:
    """Does the cell have surfaces of so many triangles that an answer takes milliseconds?"""
    bodies = [*cell.fixtures, *cell.parts]
    return any(len(shape.faces) > MANY for body in bodies for shape in body.shapes)


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
    nearest = _Nearest(samples, collisions.sweep)
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
    """The nearest pair at each sample; the engine is asked only where bounds leave it open.

    Bounds are from balls and boxes, and from the answer at an earlier sample less what the pair has
    moved since.
    """

    def __init__(self, samples: Samples, sweep: Sweep) -> None:
        self.samples, self.sweep = samples, sweep
        count = len(samples.step)
        self.least = np.full(count, HORIZON)
        self.between = np.full(count, -1)
        self.pairs: list[tuple[str, str]] = []
        self._pieces: list[tuple[Job, int, int]] = []
        self._bounds: list[Array] = []
        self._along: list[Array] = []  # by pair of pieces, motion up to each sample [m]

    def add(self, job: Job) -> None:
        """A pair of bodies, where it counts."""
        counts = job.live & job.clears
        found = lower_bounds(self.samples.frames, job, counts, HORIZON)
        if not found:
            return
        along = np.concatenate([[0.0], np.cumsum(self.sweep.motion(self.samples, job)[:-1])])
        for i, j, bound in found:
            self._pieces.append((job, i, j))
            self._bounds.append(np.where(counts, bound[:-1], np.inf))
            self._along.append(along)

    def curve(self) -> ClearanceCurve:
        """Asks, the nearest bounds first."""
        if self._pieces:
            self._ask_all(np.array(self._bounds), np.array(self._along))
        return ClearanceCurve(self.samples.time[:-1], self.least, self.between, self.pairs)

    def _ask_all(self, bounds: Array, along: Array) -> None:
        known = np.full(len(bounds), -np.inf)  # answer, plus the motion up to there
        for k in range(bounds.shape[1]):
            here = np.maximum(bounds[:, k], known - along[:, k])
            for which in np.argsort(here, kind="stable"):
                if here[which] >= self.least[k]:
                    break
                job, i, j = self._pieces[which]
                found = self._distance(k, job, i, j)
                known[which] = found + along[which, k]
                if found < self.least[k]:
                    self.least[k], self.between[k] = found, self._pair(job)

    def _pair(self, job: Job) -> int:
        names = (job.a.name, job.b.name)
        if names not in self.pairs:
            self.pairs.append(names)
        return self.pairs.index(names)

    def _distance(self, k: int, job: Job, i: int, j: int) -> float:
        a, b, engine = self._placed(job.a, i, k), self._placed(job.b, j, k), self.sweep.engine
        return 0.0 if engine.contains(a, b) else max(engine.distance(a, b), 0.0)

    def _placed(self, actor: Actor, piece: int, k: int) -> Placed:
        R, p = actor.poses(self.samples.frames)
        at = k if len(R) > 1 else 0
        return Placed(actor.pieces[piece], R[at], p[at])
