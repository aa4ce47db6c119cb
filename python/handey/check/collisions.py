"""The clauses collision, self-collision and contact: which bodies are to keep apart, and when.

Pairs: what an arm joint moves against fixtures and parts; robot bodies against each other; a held
part against all. Contacts that belong to the work get their 0.5 mm where and while the format
allows it. Parts that stand are looked at once for each place.
"""

from __future__ import annotations

import numpy as np

from handey.check.carries import Carry, World
from handey.check.cell import Body, Cell
from handey.check.kinematics import forward, joint_path
from handey.check.plan_data import PlanData, Step
from handey.check.report import CheckReport
from handey.check.self_pairs import checked_pairs
from handey.check.shapes import transformed
from handey.check.solids import Engine, Piece, Placed, pieces_of
from handey.check.sweep import Actor, Clearance, Hit, Job, Samples, Sweep
from handey.check.values import Array

__all__ = ["Collisions"]

OVERLAP = 1e-5  # of bodies that may not touch [m]: format
CONTACT = 5e-4  # of bodies that may [m]: format
AT_PLACE = 2e-3  # no point further: still at the place it stood [m]: format
TOUCHING = 6e-4  # bodies nearer than this touch where a part stands [m]: format, standing
COARSE, FINE = 12e-3, 5e-4  # motion between samples; with a part near its place [m]
MOST_SAMPLES = 400_000


class Collisions:
    """One check of one plan."""

    def __init__(
        self, cell: Cell, plan: PlanData, carries: list[Carry], world: World, report: CheckReport
    ) -> None:
        self.cell, self.plan, self.carries, self.world, self.report = (
            cell,
            plan,
            carries,
            world,
            report,
        )
        self.engine = Engine()
        self.robot = cell.robot
        self.pieces: dict[str, list[Piece]] = {
            body.name: pieces_of(body.shapes) for body in cell.fixtures + cell.parts
        }
        self.links = [
            Actor(body.name, pieces_of(body.shapes), i) if body.shapes else None
            for i, body in enumerate(self.robot.bodies)
        ]
        self.fingers = {finger.child for finger in self.robot.fingers}
        self.sweep = Sweep(self.robot, cell.base, self.engine)

    def check(self) -> None:
        """Notes all faults and the least clearance in the report."""
        self._static()
        if self.plan.steps:
            samples = self._samples()
            if samples is None:
                return
            clearance = Clearance()
            hits = self.sweep.run(samples, self.jobs(samples), clearance)
            own = Clearance(share=0.7)
            self_hits = self.sweep.run(samples, self._self(samples), own)
            self._note(hits, "collision")
            self._note(self_hits, "self-collision")
            if clearance.between is not None:
                self.report.least_clearance = clearance.least
                self.report.least_clearance_between = clearance.between
                self.report.least_clearance_time = clearance.time
            if hits:
                self.report.least_clearance = 0.0
            if own.between is not None:
                self.report.least_self_clearance = 0.0 if self_hits else own.least
        self.report.samples = self.sweep.samples
        self.report.distance_queries = self.engine.queries

    def jobs(self, samples: Samples) -> list[Job]:
        """All pairs but those of the robot with itself, and what is demanded of them when."""
        return self._against_fixtures(samples) + self._against_parts(samples) + self._held(samples)

    def _note(self, hits: list[Hit], clause: str) -> None:
        """The deepest hit of each pair and step becomes a fault."""
        worst: dict[tuple[str, str, int], Hit] = {}
        for hit in sorted(hits, key=lambda h: h.time):
            worst.setdefault((hit.a, hit.b, hit.step), hit)
        for hit in worst.values():
            step = self.plan.steps[hit.step]
            touching = hit.tolerance > OVERLAP
            text = (
                f"{hit.a} and {hit.b} overlap by about {hit.depth * 1e3:.3g} mm "
                f"({hit.tolerance * 1e3:g} mm {'of contact ' if touching else ''}allowed)"
            )
            self.report.add(
                "contact" if touching else clause, text, step.index, hit.time, step.action
            )

    # ------------------------------------------------------------------------------------- samples

    def _samples(self) -> Samples | None:
        """The plan's rows, cut so that nothing moves further than 12 mm (0.5 mm near a place)."""
        q = np.vstack([step.q for step in self.plan.steps])
        opening = np.concatenate([step.opening for step in self.plan.steps])
        time = np.concatenate([step.time for step in self.plan.steps])
        row_step = np.concatenate([np.full(len(step.time), step.index) for step in self.plan.steps])
        if len(q) == 1:  # a robot that only stands is looked at, too
            q, opening, time, row_step = (np.repeat(a, 2, 0) for a in (q, opening, time, row_step))
        turn, slide = np.abs(np.diff(q, axis=0)), np.abs(np.diff(opening)) / 2
        bound = turn @ self._reaches() + slide
        actions = np.array([step.action for step in self.plan.steps])
        action = actions[row_step[1:]]
        limit = np.where(np.isin(action, ("depart", "deposit")), FINE, COARSE)
        limit = np.where(np.isin(action, ("grasp", "release")), CONTACT / 4, limit)
        count = np.maximum(np.ceil(bound / limit), 1)
        if count.sum() > MOST_SAMPLES:
            text = f"the motion is too long to be checked: {bound.sum():.0f} m of joint motion"
            self.report.add("format", text)
            return None
        count = count.astype(int)
        at = np.append(np.repeat(np.arange(len(count)), count), len(q) - 1)
        starts = np.concatenate([[0], np.cumsum(count)])
        s = np.append(
            (np.arange(count.sum()) - np.repeat(starts[:-1], count)) / np.repeat(count, count), 0.0
        )
        after = np.minimum(at + 1, len(q) - 1)

        def between(rows: Array) -> Array:
            share = s if rows.ndim == 1 else s[:, None]
            return np.asarray(rows[at] * (1 - share) + rows[after] * share)

        # Between the last row of a step and the first of the next nothing moves: the later step has
        # it.
        step = row_step[after[:-1]]
        q_all, opening_all = between(q), between(opening)
        frames = forward(self.robot, self.cell.base, q_all, opening_all)
        return Samples(q_all, opening_all, between(time), step, frames)

    def _reaches(self) -> Array:
        """For each arm joint, how far from its axis any point of robot or part can be (joints,)."""
        extent = {}
        for i, link in enumerate(self.robot.bodies):
            points = [np.linalg.norm(shape.points(), axis=1).max() for shape in link.shapes]
            extent[i] = float(max(points, default=0.0))
        for carry in self.carries:
            part = next(part for part in self.cell.parts if part.name == carry.part)
            held = transformed(self.robot.grasp_frame @ carry.X_HP, part.points())
            extent[self.robot.hand] = max(
                extent[self.robot.hand], float(np.linalg.norm(held, axis=1).max())
            )
        reaches = []
        for joint in self.robot.joints:
            most = 0.0
            for body in range(len(self.robot.bodies)):
                path = joint_path(self.robot, body)
                names = [j.name for j in path]
                if joint.name in names:
                    rest = path[names.index(joint.name) + 1 :]
                    length = sum(float(np.linalg.norm(j.origin[:3, 3])) for j in rest)
                    length += self.robot.opening[1] / 2 * any(j.prismatic for j in rest)
                    most = max(most, length + extent[body])
            reaches.append(most)
        return np.array(reaches)

    # ---------------------------------------------------------------------------------------- jobs

    def _job(self, samples: Samples, a: Actor, b: Actor, live: np.ndarray) -> Job:
        n = len(samples.q) - 1
        return Job(a, b, live, np.full(n, OVERLAP), np.ones(n, dtype=bool))

    def _moving_links(self) -> list[Actor]:
        return [link for link in self.links[1:] if link is not None]

    def _against_fixtures(self, samples: Samples) -> list[Job]:
        live = np.ones(len(samples.q) - 1, dtype=bool)
        return [
            self._job(
                samples, link, Actor(body.name, self.pieces[body.name], None, body.pose), live
            )
            for body in self.cell.fixtures
            for link in self._moving_links()
        ]

    def _against_parts(self, samples: Samples) -> list[Job]:
        """The robot against parts that stand; fingers may close on the one they take."""
        jobs = []
        for name, pose, first, last in self._stays():
            live = (samples.step >= first) & (samples.step <= last)
            actor = Actor(name, self.pieces[name], None, pose)
            for link in self._moving_links():
                job = self._job(samples, link, actor, live)
                if link.body in self.fingers:
                    self._allow_fingers(samples, job, name)
                jobs.append(job)
        return jobs

    def _stays(self) -> list[tuple[str, Array, int, int]]:
        """Each part's standing places, and the steps in which it stands there."""
        result: list[tuple[str, Array, int, int]] = []
        last = len(self.plan.steps) - 1
        for part in self.cell.parts:
            pose, first = part.pose, 0
            for carry in self.carries:
                if carry.part == part.name:
                    if carry.first > first:
                        result.append((part.name, pose, first, carry.first - 1))
                    pose, first = carry.put, carry.last + 1
            if first <= last:
                result.append((part.name, pose, first, last))
        return result

    def _allow_fingers(self, samples: Samples, job: Job, name: str) -> None:
        opening = np.minimum(samples.opening[:-1], samples.opening[1:])
        step = samples.step
        for carry in self.carries:
            if carry.part != name:
                continue
            for index, action in ((carry.first - 1, "grasp"), (carry.last + 1, "release")):
                if 0 <= index < len(self.plan.steps) and self.plan.steps[index].action == action:
                    here = step == index
                    job.clears &= ~here
                    closed = here & (opening <= carry.opening + 2 * CONTACT)
                    job.tolerance = np.where(closed, CONTACT, job.tolerance)
        job.ways = self._closing_axes(samples)

    def _closing_axes(self, samples: Samples) -> Array:
        """The closing axis at each grasp and release, in the world (k, 3)."""
        R = samples.frames.R[self.robot.hand] @ self.robot.grasp_frame[:3, 1]
        first = np.flatnonzero(np.diff(samples.step, prepend=-1))
        actions = [self.plan.steps[samples.step[k]].action for k in first]
        chosen = [
            k for k, action in zip(first, actions, strict=True) if action in ("grasp", "release")
        ]
        return np.asarray(R[chosen])

    def _held(self, samples: Samples) -> list[Job]:
        """What is in the hand against fixtures, standing parts and the robot."""
        jobs = []
        hand = self.robot.hand
        for carry in self.carries:
            step = samples.step
            live = (step >= carry.first) & (step <= carry.last)
            X_BP = self.robot.grasp_frame @ carry.X_HP
            held = Actor(carry.part, self.pieces[carry.part], hand, X_BP)
            standing = self.world.standing[carry.first]
            bodies = [(body, body.pose) for body in self.cell.fixtures]
            bodies += [
                (part, standing[part.name]) for part in self.cell.parts if part.name in standing
            ]
            places = self._at_places(samples, held, carry)
            for body, pose in bodies:
                job = self._job(
                    samples, held, Actor(body.name, self.pieces[body.name], None, pose), live
                )
                job.ways = np.array([[0.0, 0.0, 1.0]])
                for at_place, place, nearby in places:
                    if self._touches(carry.part, place, body, pose):
                        job.tolerance = np.where(at_place, CONTACT, job.tolerance)
                        job.clears = job.clears & ~np.isin(step, nearby)
                jobs.append(job)
            for link in self.links:
                if link is None:
                    continue
                job = self._job(samples, held, link, live)
                if link.body in self.fingers:
                    job.tolerance[:] = CONTACT
                    job.clears[:] = False
                    job.ways = self._closing_axes(samples)
                elif link.body == hand:
                    job.clears[:] = False
                jobs.append(job)
        return jobs

    def _at_places(
        self, samples: Samples, held: Actor, carry: Carry
    ) -> list[tuple[np.ndarray, Array, list[int]]]:
        """Intervals in which the part is still (or already) where it stood (will stand)."""
        part = next(part for part in self.cell.parts if part.name == carry.part)
        low, high = part.points().min(axis=0), part.points().max(axis=0)
        corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
        corners = low + corners * (high - low)
        R, p = held.poses(samples.frames)
        result = []
        for place, nearby in ((carry.origin, [carry.first]), (carry.put, [carry.last])):
            moved = (corners @ (np.swapaxes(R, 1, 2) - place[:3, :3].T)) + (p - place[:3, 3])[
                :, None
            ]
            off = np.linalg.norm(moved, axis=2).max(axis=1)
            # A convex function of the point: the farthest point of the box is a corner.
            # Where samples are coarse, both ends of an interval must be near the place.
            nearer, farther = np.minimum(off[:-1], off[1:]), np.maximum(off[:-1], off[1:])
            fine = np.isin(samples.step, [carry.first, carry.last])
            result.append((np.where(fine, nearer, farther) <= AT_PLACE, place, nearby))
        return result

    def _touches(self, name: str, place: Array, body: Body, pose: Array) -> bool:
        return any(
            self.engine.distance(a, b) <= TOUCHING or self.engine.contains(a, b)
            for a, b in self._placed_pairs(name, place, body.name, pose)
        )

    def _placed_pairs(self, a: str, X_a: Array, b: str, X_b: Array) -> list[tuple[Placed, Placed]]:
        return [
            (Placed(i, X_a[:3, :3], X_a[:3, 3]), Placed(j, X_b[:3, :3], X_b[:3, 3]))
            for i in self.pieces[a]
            for j in self.pieces[b]
        ]

    def _self(self, samples: Samples) -> list[Job]:
        """Robot bodies against each other, but for pairs that the format leaves out."""
        live = np.ones(len(samples.q) - 1, dtype=bool)
        return [
            self._job(samples, a, b, live)
            for a, b in checked_pairs(self.robot, self.links, self.cell.base, self.engine)
        ]

    # ------------------------------------------------------------------------------------ standing

    def _static(self) -> None:
        """Parts where they stand, against everything that stands: no deeper than contact."""
        done: set[tuple[str, str]] = set()
        places = {part.name: part.pose for part in self.cell.parts}
        for name in places:
            self._stands(name, places, None, done)
        for carry in self.carries:
            step = self.plan.steps[min(carry.last + 1, len(self.plan.steps) - 1)]
            places = {**self.world.standing[carry.last], carry.part: carry.put}
            self._stands(carry.part, places, step, set())

    def _stands(
        self,
        name: str,
        places: dict[str, Array],
        step: Step | None,
        done: set[tuple[str, str]],
    ) -> None:
        pose = places[name]
        others = [(body.name, body.pose) for body in self.cell.fixtures]
        others += [(other, place) for other, place in places.items() if other != name]
        pairs = [(other, self._placed_pairs(name, pose, other, place)) for other, place in others]
        base = self.links[0]
        if base is not None:
            X = self.cell.base
            a = [Placed(piece, pose[:3, :3], pose[:3, 3]) for piece in self.pieces[name]]
            b = [Placed(piece, X[:3, :3], X[:3, 3]) for piece in base.pieces]
            pairs.append((base.name, [(i, j) for i in a for j in b]))
        for other, placed in pairs:
            key = (min(name, other), max(name, other))
            if key not in done:
                done.add(key)
                self._static_pair(name, other, placed, step)

    def _static_pair(
        self, name: str, other: str, placed: list[tuple[Placed, Placed]], step: Step | None
    ) -> None:
        up = np.array([[0.0, 0.0, 1.0]])
        for a, b in placed:
            if self.engine.signed(a, b, CONTACT, up) < -CONTACT:
                depth = self.engine.depth(a, b) * 1e3
                text = f"{name} and {other} overlap where {name} stands by about {depth:.3g} mm"
                if step is None:
                    self.report.add("contact", text + " at the start", None, 0.0)
                else:
                    self.report.add("contact", text, step.index, float(step.time[0]), step.action)
                return
