"""Do two bodies keep apart during a motion? A proof in continuous time, not a sample.

Between two samples no point of one body moves further, seen from the other, than the sum over the
joints between them of |dq| times its reach. Where spheres and boxes prove that this motion cannot
close the gap, nothing is asked; elsewhere the engine is, and the answer is good until the motion
has used it up. What stays open is cut finer, down to 0.01 mm of motion. So an overlap of more than
tolerance + 0.005 mm is always found.
"""

from __future__ import annotations

import heapq
import itertools
import math
from dataclasses import dataclass, field

import numpy as np

from handey.check.kinematics import Frames, forward, joint_path
from handey.check.robot import Joint, Robot
from handey.check.solids import Engine, Piece, Placed
from handey.check.values import Array

__all__ = ["HORIZON", "Actor", "Clearance", "Hit", "Job", "Samples", "Sweep", "lower_bounds"]

FLOOR = 1e-5  # of motion between two samples, where cutting ends [m]
HORIZON = 0.1  # clearances above this are not looked for [m]


@dataclass
class Samples:
    """Configurations in time order; interval k leads straight from sample k to k + 1.

    `step` (n - 1,) is for each interval the index of the plan's step that it is part of.
    """

    q: Array
    opening: Array
    time: Array
    step: np.ndarray
    frames: Frames


@dataclass
class Actor:
    """A body in the sweep: rigid in a body of the robot, or (`body` is None) in the world."""

    name: str
    pieces: list[Piece]
    body: int | None
    pose: Array = field(default_factory=lambda: np.eye(4))

    def __post_init__(self) -> None:
        centres = np.vstack([piece.centres for piece in self.pieces])
        radii = np.concatenate([piece.radii for piece in self.pieces])
        self.centre = (centres.min(axis=0) + centres.max(axis=0)) / 2
        self.radius = float((np.linalg.norm(centres - self.centre, axis=1) + radii).max())
        self._is_body = np.array_equal(self.pose, np.eye(4))

    def poses(self, frames: Frames) -> tuple[Array, Array]:
        """Rotations (n, 3, 3) and positions (n, 3); n is 1 for what stands."""
        if self.body is None:
            return self.pose[None, :3, :3], self.pose[None, :3, 3]
        R, p = frames.R[self.body], frames.p[self.body]
        if self._is_body:
            return R, p
        return R @ self.pose[:3, :3], R @ self.pose[:3, 3] + p


@dataclass
class Job:
    """A pair of actors, and what is demanded of them in each interval.

    Attributes:
        live: (n - 1,) intervals that count for this pair.
        tolerance: (n - 1,) overlap that is allowed [m].
        clears: (n - 1,) intervals that count for the least clearance.
        ways: (k, 3) directions in the world that may part them.
    """

    a: Actor
    b: Actor
    live: np.ndarray
    tolerance: Array
    clears: np.ndarray
    ways: Array | None = None


@dataclass
class Clearance:
    """The least distance met so far."""

    least: float = HORIZON
    between: tuple[str, str] | None = None
    time: float | None = None
    share: float = 0.9  # of the least: what is proven

    def wanted(self) -> float:
        """The distance that need not be looked below [m]."""
        return self.share * self.least - 5e-5


@dataclass
class Hit:
    """An overlap deeper than allowed."""

    a: str
    b: str
    time: float
    step: int
    tolerance: float
    depth: float


class Sweep:
    """Proves jobs one after the other."""

    def __init__(self, robot: Robot, base: Array, engine: Engine) -> None:
        self.robot, self.base, self.engine = robot, base, engine
        self.samples = 0
        self._paths = {i: joint_path(robot, i) for i in range(len(robot.bodies))}
        self._arm = {joint.name: i for i, joint in enumerate(robot.joints)}
        self._motions: dict[tuple[int, int, str], tuple[Array, Samples, Actor]] = {}

    def run(self, samples: Samples, jobs: list[Job], clearance: Clearance) -> list[Hit]:
        """All jobs; the nearest pairs first, so that the least clearance is known early."""
        self.samples += len(samples.q)
        self._motions.clear()
        waiting: list[tuple[float, int, Job, tuple[int, int] | None, Array, Array]] = []

        def wait(job: Job, pair: tuple[int, int] | None, bound: Array, motion: Array) -> None:
            least = np.minimum(bound[:-1], bound[1:])[job.live].min()
            heapq.heappush(waiting, (float(least), next(serial), job, pair, bound, motion))

        serial = itertools.count()
        for job in jobs:
            if job.live.any():
                wait(job, None, _rough(samples.frames, job), self.motion(samples, job))
        hits: list[Hit] = []
        while waiting:
            _, _, job, pair, bound, motion = heapq.heappop(waiting)
            if pair is not None:
                hits += self._prove(samples, job, pair, bound, motion, clearance)
                continue
            unproven = _unproven(job, bound, motion, clearance)
            if len(unproven):
                for i, j, finer in _bounds(samples.frames, job, bound, unproven):
                    wait(job, (i, j), finer, motion)
        return hits

    def motion(self, samples: Samples, job: Job) -> Array:
        """Bound on the motion of the two actors against each other, for every interval (n - 1,)."""
        paths: list[list[Joint]] = [
            [] if actor.body is None else self._paths[actor.body] for actor in (job.a, job.b)
        ]
        total = np.zeros(len(samples.q) - 1)
        for actor, path, other in ((job.a, paths[0], paths[1]), (job.b, paths[1], paths[0])):
            common = {joint.name for joint in other}
            own = [joint for joint in path if joint.name not in common]
            if own:
                total += self._motion_by(samples, actor, own)
        return total

    def _motion_by(self, samples: Samples, actor: Actor, own: list[Joint]) -> Array:
        """Bound on the motion of an actor by some joints of its path, the outermost last."""
        key = (id(samples), id(actor), own[0].name)
        if key in self._motions:
            return self._motions[key][0]
        turn = np.abs(np.diff(samples.q, axis=0))
        slide = np.abs(np.diff(samples.opening)) / 2
        R, p = actor.poses(samples.frames)
        centre = (R @ actor.centre + p)[:-1]
        # Joints further out change the distance to an axis within the interval: add their motion.
        outer = np.zeros(len(turn))
        for joint in reversed(own):
            if joint.prismatic:
                outer = outer + slide
                continue
            i = self._arm[joint.name]
            off = _cross(samples.frames.axis[i, :-1], centre - samples.frames.axis_point[i, :-1])
            reach = np.sqrt(np.einsum("ni,ni->n", off, off)) + actor.radius
            outer = outer + turn[:, i] * (reach + outer)
        self._motions[key] = (outer, samples, actor)  # kept alive: an id is not given twice
        return outer

    def _prove(
        self, samples: Samples, job: Job, pair: tuple[int, int], bound: Array, motion: Array,
        clearance: Clearance,
    ) -> list[Hit]:  # fmt: skip
        lowest = -job.tolerance
        unproven = _unproven(job, bound, motion, clearance)
        if len(unproven) == 0:
            return []
        run = _Run(self.engine, samples, job, pair, clearance)
        run.value(
            int(unproven[np.argmin(bound[unproven])]), int(unproven[np.argmin(bound[unproven])])
        )
        along = np.concatenate([[0.0], np.cumsum(motion)])
        reach, bad_step = -math.inf, -1
        hits: list[Hit] = []
        still_open: list[tuple[int, float]] = []

        def target(k: int) -> float:  # what interval k must keep; falls as nearer pairs are met
            least = float(lowest[k])
            return max(least, clearance.wanted()) if job.clears[k] else least

        for k in map(int, unproven):
            if samples.step[k] == bad_step or along[k + 1] + target(k) <= reach:
                continue
            near = run.value(k, k)
            reach = max(reach, along[k] + near)
            if along[k + 1] + target(k) <= reach:
                continue
            far = run.value(k + 1, k)
            if min(near, far) < lowest[k] - 1e-12:
                bad_step = samples.step[k]
                hits.append(run.hit(k if near < lowest[k] - 1e-12 else k + 1, k))
                continue
            reach = max(reach, along[k + 1] + far)
            if motion[k] > FLOOR:
                still_open.append((k, near + far))
        still_open = [
            (k, gaps - 2 * target(k)) for k, gaps in still_open if gaps < motion[k] + 2 * target(k)
        ]
        if still_open:
            hits += self._finer(samples, job, pair, motion, still_open, clearance)
        return hits

    def _finer(
        self, samples: Samples, job: Job, pair: tuple[int, int], motion: Array,
        intervals: list[tuple[int, float]], clearance: Clearance,
    ) -> list[Hit]:  # fmt: skip
        """The same for these intervals only, cut as finely as their gaps ask for."""
        index, share, cut = [], [], []
        for k, room in intervals:
            count = int(np.clip(math.ceil(motion[k] / max(0.7 * room, FLOOR)), 2, 256))
            index += [k] * (count + 1)
            share += list(np.arange(count + 1) / count)
            cut += [True] * count + [False]
        at, s = np.array(index), np.array(share)
        q = samples.q[at] * (1 - s)[:, None] + samples.q[at + 1] * s[:, None]
        opening = samples.opening[at] * (1 - s) + samples.opening[at + 1] * s
        time = samples.time[at] * (1 - s) + samples.time[at + 1] * s
        frames = forward(self.robot, self.base, q, opening)
        finer = Samples(q, opening, time, samples.step[at[:-1]], frames)
        self.samples += len(q)
        fine_job = Job(
            job.a, job.b, np.array(cut[:-1]), job.tolerance[at[:-1]], job.clears[at[:-1]], job.ways
        )
        nothing = np.full(len(q), -math.inf)
        fine_motion = np.where(fine_job.live, self.motion(finer, fine_job), 0.0)
        # Blocks are not neighbours: what was proven in one says nothing of the next.
        fine_motion[~fine_job.live] = 1e3
        return self._prove(finer, fine_job, pair, nothing, fine_motion, clearance)


class _Run:
    """Measured values of one pair of pieces along one set of samples."""

    def __init__(
        self,
        engine: Engine,
        samples: Samples,
        job: Job,
        pair: tuple[int, int],
        clearance: Clearance,
    ) -> None:
        self.engine, self.samples, self.job, self.clearance = engine, samples, job, clearance
        self.a, self.b = job.a.pieces[pair[0]], job.b.pieces[pair[1]]
        self.poses_a, self.poses_b = job.a.poses(samples.frames), job.b.poses(samples.frames)
        self.known: dict[tuple[int, float], float] = {}

    def placed(self, k: int) -> tuple[Placed, Placed]:
        result = []
        for piece, (R, p) in ((self.a, self.poses_a), (self.b, self.poses_b)):
            i = k if len(R) > 1 else 0
            result.append(Placed(piece, R[i], p[i]))
        return result[0], result[1]

    def value(self, k: int, interval: int) -> float:
        """Signed distance at sample k under the rules of an interval."""
        tolerance = float(self.job.tolerance[interval])
        if (k, tolerance) not in self.known:
            value = self.engine.signed(*self.placed(k), tolerance, self.job.ways)
            self.known[k, tolerance] = value
        value = self.known[k, tolerance]
        if self.job.clears[interval] and value < self.clearance.least:
            self.clearance.least = max(value, 0.0)
            self.clearance.between = (self.job.a.name, self.job.b.name)
            self.clearance.time = float(self.samples.time[k])
        return value

    def hit(self, k: int, interval: int) -> Hit:
        return Hit(
            self.job.a.name, self.job.b.name, float(self.samples.time[k]),
            int(self.samples.step[interval]),
            float(self.job.tolerance[interval]), self.engine.depth(*self.placed(k)),
        )  # fmt: skip


def _unproven(job: Job, bound: Array, motion: Array, clearance: Clearance) -> np.ndarray:
    """The intervals in which the bounds leave it open whether the pair keeps what is asked."""
    aim = np.where(job.clears, np.maximum(-job.tolerance, clearance.wanted()), -job.tolerance)
    return np.flatnonzero(job.live & (bound[:-1] + bound[1:] < motion + 2 * aim))


def lower_bounds(
    frames: Frames, job: Job, counts: np.ndarray, below: float
) -> list[tuple[int, int, Array]]:
    """For every pair of pieces a lower bound of the distance at each sample (n,).

    Looked at closely only at samples where intervals that count begin or end and the rough bound is
    below `below`; empty if there are none.
    """
    rough = _rough(frames, job)
    near = np.flatnonzero(counts & (np.minimum(rough[:-1], rough[1:]) < below))
    return _bounds(frames, job, rough, near) if len(near) else []


def _rough(frames: Frames, job: Job) -> Array:
    """A lower bound of the distance: the ball round one actor against the other's boxes (n,)."""
    R_a, p_a = job.a.poses(frames)
    R_b, p_b = job.b.poses(frames)
    n = frames.R.shape[1]
    centre = np.broadcast_to(_local(R_b, R_a @ job.a.centre + p_a - p_b), (n, 3))
    least = np.full(n, math.inf)
    for piece in job.b.pieces:
        local = (centre - piece.pose[:3, 3]) @ piece.pose[:3, :3] - piece.box_centre
        outside = np.maximum(np.abs(local) - piece.box_half, 0.0)
        least = np.minimum(least, np.sqrt(np.einsum("ni,ni->n", outside, outside)))
    return np.asarray(least - job.a.radius)


def _bounds(
    frames: Frames, job: Job, rough: Array, intervals: np.ndarray
) -> list[tuple[int, int, Array]]:
    """For every pair of pieces a lower bound of the distance: spheres against a box (n,).

    Looked at closely where one of the intervals begins or ends; elsewhere it is the rough one.
    """
    at = np.unique(np.concatenate([intervals, intervals + 1]))
    R_a, p_a = (rows[at] if len(rows) > 1 else rows for rows in job.a.poses(frames))
    R_b, p_b = (rows[at] if len(rows) > 1 else rows for rows in job.b.poses(frames))
    n = len(at)
    R = np.broadcast_to(np.swapaxes(R_b, 1, 2) @ R_a, (n, 3, 3))
    p = np.broadcast_to(_local(R_b, p_a - p_b), (n, 3))
    centres = np.vstack([piece.centres for piece in job.a.pieces])
    radii = np.concatenate([piece.radii for piece in job.a.pieces])
    starts = np.cumsum([0] + [len(piece.radii) for piece in job.a.pieces])[:-1]
    world = centres @ np.swapaxes(R, 1, 2) + p[:, None]  # (n, spheres, 3) in b's body frame
    result = []
    for j, piece in enumerate(job.b.pieces):
        local = (world - piece.pose[:3, 3]) @ piece.pose[:3, :3] - piece.box_centre
        outside = np.maximum(np.abs(local) - piece.box_half, 0.0)
        gap = np.sqrt(np.einsum("nki,nki->nk", outside, outside)) - radii
        least = np.minimum.reduceat(gap, starts, axis=1)
        for i in range(len(starts)):
            bound = rough.copy()
            bound[at] = np.maximum(bound[at], least[:, i])
            result.append((i, j, bound))
    return result


def _cross(a: Array, b: Array) -> Array:
    """Cross products of rows (n, 3); numpy's own is slower."""
    (a0, a1, a2), (b0, b1, b2) = a.T, b.T
    return np.stack([a1 * b2 - a2 * b1, a2 * b0 - a0 * b2, a0 * b1 - a1 * b0], axis=1)


def _local(R: Array, vectors: Array) -> Array:
    """Each vector seen from a frame turned by R: R^T v, broadcast over the samples."""
    return np.asarray((np.swapaxes(R, 1, 2) @ vectors[:, :, None])[:, :, 0])
