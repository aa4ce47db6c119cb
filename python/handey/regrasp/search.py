"""Which sequence of carries brings a part to its goal, put down on the way and taken again?

The grasps of the part (a table) are tested where it stands and where it is to go; the table tells
through which resting poses the two sets can be joined. Places for these are chosen on the supports,
the cheapest sequence of carries through them is planned, motion by motion, as a direct one is; what
its planners refuse is taken out of the graph and the search goes on.
Not guaranteed: that a sequence that exists is found. Article: "Regrasping".
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from handey import _core
from handey.motion.carry import Carry, DirectOptions, Workspace
from handey.regrasp.graph import Graph, Place
from handey.regrasp.grasp_table import GraspTable
from handey.regrasp.legal_grasps import clears_ground, compatible
from handey.regrasp.places import PlaceFinder, comfortable
from handey.regrasp.sequence import Sequences, Told

__all__ = ["NO_SUPPORT", "RegraspOptions", "RegraspSearch"]


@dataclass(frozen=True)
class RegraspOptions:
    """Budgets of the search for a sequence of grasps and placements.

    Attributes:
        most_regrasps: the part is put down on the way no more often; 0: never.
        samples: places looked at for each resting pose on each support, pass after pass.
        places: the best of these that are kept for each resting pose, pass after pass.
        grasps: legal grasps of each group wanted at a place (one put-down on the way).
        sequences: whose motions are planned: in the first round of attempts, which is cheap, and in
            each further one.
    """

    most_regrasps: int = 4
    samples: tuple[int, ...] = (48, 256)
    places: tuple[int, ...] = (3, 8)
    grasps: int = 12
    sequences: tuple[int, ...] = (40, 8, 4)


NO_SUPPORT = "nothing is a support on which the part could be put down on the way"


@dataclass
class _Needs:
    """What one resting pose is for, with so many regrasps: groups of grasps, all of them needed."""

    rest: int
    groups: list[np.ndarray]


@dataclass
class RegraspSearch:
    """The search for one goal; passes with greater budgets go on from those before.

    Attributes:
        work: the goal, and where the arm is.
        table: grasps and resting poses of the part.
        options: budgets.
        seed: of the samples.
        told: what was looked at.
        tried: sequences whose motions were planned, or refused.
    """

    work: Workspace
    table: GraspTable
    options: RegraspOptions
    seed: int
    told: Told = field(default_factory=Told)
    tried: int = 0
    _looked: set[tuple[bool, int]] = field(default_factory=set)

    def __post_init__(self) -> None:
        scene = self.work.scene
        cell, part = scene.cell, scene.part
        rng = np.random.default_rng([self.seed, 7])
        # Choice: alike grasps are mixed, so that the first few are not all next to each other.
        self._order = np.argsort(-(self.table.merit + 0.2 * rng.random(len(self.table.merit))))
        with self.work.clock("regrasp"):
            ends = np.array([cell.parts[part].X_WB, scene.X_WP_goal])
            at_ends = []
            for X_WP in ends:
                clear = clears_ground(self.work, self.table, X_WP)[self._order]
                at_ends += compatible(
                    self.work, self.table, [self._order[clear].tolist()], X_WP[None], 0
                )
        self._at_ends = at_ends
        self.finder = PlaceFinder(
            self.work.model,
            cell,
            part,
            self.work.solver,
            self.table.grasps,
            self.table.rests,
            comfortable(cell, *ends),
            self.seed,
        )
        velocity = np.array([joint.limit.velocity for joint in cell.robot.joints])
        names = ("origin", "destination")
        places = [self._place(*it) for it in zip(names, ends, at_ends, strict=True)]
        self._graph = Graph(velocity, self.work.current.q, self.work.home, places)
        self._sequences = Sequences(self.work, self.table, self._graph, self.told)
        self._sets = [self._mask(found) for found in at_ends]
        count = self.told.count
        count("grasps of the part", len(self._order))
        for name, found in zip(names, at_ends, strict=True):
            count(f"legal at the {name}", len(found.legal))
        count("resting poses", len(self.table.rests))

    @property
    def words(self) -> str:
        """The sequence that was planned; empty without one."""
        return self._sequences.words

    def forgive(self) -> None:
        """What was refused is tried again: the next pass has greater budgets."""
        self._sequences.forgive()

    def run(self, regrasps: int, direct: DirectOptions, most: int) -> Carry | None:
        """A sequence with so many regrasps, planned with these budgets; None if there is none.

        The motions of at most `most` sequences are planned.
        """
        stop_at = self.tried + most
        if not self.joins_ends:
            self._tell_illegal_ends()
            return None
        if not self.finder.has_support:
            self.told.reason(NO_SUPPORT)
            return None
        needs = _rests_that_join(self.table.clear, self._sets, regrasps)
        if not needs:
            return None
        for level in range(len(self.options.samples)):
            if self.tried >= stop_at:
                break
            self._add_places(needs, regrasps, level)
            carry = self._try_sequences(regrasps, direct, stop_at)
            if carry is not None:
                return carry
        return None

    def _add_places(self, needs: list[_Needs], regrasps: int, level: int) -> None:
        """Choose places for the resting poses and test the needed grasps there."""
        samples, most = self.options.samples[level], self.options.places[level]
        if (regrasps > 1, level) in self._looked:
            return
        self._looked.add((regrasps > 1, level))
        # With one put-down a few grasps of each group will do; with more, they must match.
        wanted = self.options.grasps if regrasps == 1 else 10 * self.options.grasps
        for need in needs:
            groups = [self._order[group[self._order]].tolist() for group in need.groups]
            with self.work.clock("regrasp"):
                few = [group[: self.options.grasps] for group in groups]
                candidates, why = self.finder.best(need.rest, few, samples, most)
                if not candidates:
                    self.told.reason(f"resting pose {need.rest}: {why}")
                    continue
                X_WP = np.array([candidate.X_WP for candidate in candidates])
                for candidate, found in zip(
                    candidates, compatible(self.work, self.table, groups, X_WP, wanted), strict=True
                ):
                    name = f"on {candidate.on}, resting pose {need.rest}"
                    self.told.count("placements looked at")
                    if found.legal:
                        self._graph.places.append(self._place(name, candidate.X_WP, found))
                    else:
                        self.told.reason(f"{name}: {found.worst_reason or 'out of reach'}")

    def _try_sequences(self, regrasps: int, direct: DirectOptions, stop_at: int) -> Carry | None:
        """Plan the cheapest sequences, one after the other."""
        while self.tried < stop_at:
            with self.work.clock("regrasp"):
                hops = self._graph.cheapest(regrasps)
            if hops is None:
                return None
            self.tried += 1
            self.told.count("regrasp sequences tried")
            carry = self._sequences.plan(hops, direct)
            if carry is not None:
                return carry
        return None

    def _place(self, name: str, X_WP: np.ndarray, found: _core.CompatibleGrasps) -> Place:
        """A node of the graph for each legal grasp, with its two best configurations."""
        rows = [(item.grasp, q, item.margin) for item in found.legal for q in item.q[:2]]
        dof = self.work.scene.cell.robot.dof
        grasps = np.array([grasp for grasp, *_ in rows], dtype=int)
        charge = np.array([1.0 - margin for *_, margin in rows])
        # Choice: a full pad at the centre of mass is worth as much as one second.
        charge = charge + (0.7 - self.table.merit[grasps]) if len(rows) else charge
        q = np.array([q for _, q, _ in rows]).reshape(len(rows), dof)
        return Place(name, X_WP, grasps, q, charge)

    def _mask(self, found: _core.CompatibleGrasps) -> np.ndarray:
        """The legal grasps as a mask of all."""
        mask = np.zeros(len(self.table.rows), dtype=bool)
        mask[[item.grasp for item in found.legal]] = True
        return mask

    @property
    def joins_ends(self) -> bool:
        """Is a grasp legal at each end?"""
        return bool(self._sets[0].any() and self._sets[1].any())

    def _tell_illegal_ends(self) -> None:
        total = len(self.table.rows)
        for name, found in zip(("origin", "destination"), self._at_ends, strict=True):
            if found.legal or not total:
                continue
            fallen = {
                "below what the part stands on": total - found.tried,
                "out of reach": found.unreachable,
                f"in collision ({found.worst_reason})": found.collides,
            }
            why = ", ".join(f"{count} {text}" for text, count in fallen.items() if count)
            self.told.reason(f"no grasp is legal at the {name}: of {total} hand poses {why}")


def _rests_that_join(clear: np.ndarray, ends: list[np.ndarray], regrasps: int) -> list[_Needs]:
    """What resting poses are for through which so many regrasps join the ends, by the table alone.

    Args:
        clear: which grasps are clear of the ground at each resting pose, (rests, grasps).
        ends: which grasps are legal at the origin and at the destination, (grasps,) each.
        regrasps: at least one.
    """
    forth, back = [ends[0]], [ends[1]]
    for sets in (forth, back):
        for _ in range(regrasps):
            through = [k for k in range(len(clear)) if (clear[k] & sets[-1]).any()]
            sets.append(np.any(clear[through], axis=0))
    found = []
    for k in range(len(clear)):
        layers = [
            i
            for i in range(1, regrasps + 1)
            if (clear[k] & forth[i - 1]).any() and (clear[k] & back[regrasps - i]).any()
        ]
        if layers:
            first = np.any([forth[i - 1] for i in layers], axis=0) & clear[k]
            then = np.any([back[regrasps - i] for i in layers], axis=0) & clear[k]
            found.append(_Needs(k, [first, then]))
    return found
