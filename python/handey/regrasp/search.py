"""Which sequence of carries brings a part to its goal, put down on the way and taken again?

The grasps of the part (a table) are tested where it stands and where it is to go; the table tells
through which resting poses the two sets can be joined. Places for these are chosen on the supports,
the cheapest sequence of carries through them is planned, motion by motion, as a direct one is; what
its planners refuse is taken out of the graph and the search goes on.
Not guaranteed: that a sequence that exists is found. Article: "Regrasping".
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from handey import _core
from handey.motion.pick_and_place import (
    Carry,
    DirectOptions,
    Motion,
    Reach,
    Workspace,
    carry_through,
    find_reach,
)
from handey.regrasp.graph import ORIGIN, Graph, Hop, Place
from handey.regrasp.grasp_table import GraspTable
from handey.regrasp.places import PlaceFinder, comfortable
from handey.reporting.goal_report import Attempt

__all__ = ["RegraspOptions", "RegraspSearch", "Told", "clears_ground", "compatible"]

ALIKE = 0.9  # Choice: cosine between the directions of two hands that count as alike
# Choice: the hand is within so far of the part, level; a face wider than that all round is a plane
# that the hand cannot get below [m].
HAND_REACH = 0.35


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
class Told:
    """What a search has to say: counts, reasons, attempts."""

    counts: dict[str, int] = field(default_factory=dict)
    reasons: list[str] = field(default_factory=list)
    attempts: list[Attempt] = field(default_factory=list)

    def count(self, what: str, more: int = 1) -> None:
        """Add to a count."""
        self.counts[what] = self.counts.get(what, 0) + more

    def reason(self, reason: str) -> None:
        """Tell a reason, once."""
        if reason not in self.reasons:
            self.reasons.append(reason)


@dataclass
class RegraspSearch:
    """The search for one goal; passes with greater budgets go on from those before.

    Attributes:
        work: the goal, and where the arm is.
        table: grasps and resting poses of the part.
        options: budgets.
        seed: of the samples.
        words: the sequence that was planned.
        told: what was looked at.
    """

    work: Workspace
    table: GraspTable
    options: RegraspOptions
    seed: int
    reaches: dict[tuple[int, int, int], Reach | Carry] = field(default_factory=dict)
    pairs: dict[tuple[float, ...], _core.RankedPair] = field(default_factory=dict)
    looked: set[tuple[bool, int]] = field(default_factory=set)
    words: str = ""
    tried: int = 0
    told: Told = field(default_factory=lambda: Told())

    def __post_init__(self) -> None:
        scene = self.work.scene
        cell, part = scene.cell, scene.part
        rng = np.random.default_rng([self.seed, 7])
        # Choice: alike grasps are mixed, so that the first few are not all next to each other.
        self.order = np.argsort(-(self.table.merit + 0.2 * rng.random(len(self.table.merit))))
        with self.work.clock("regrasp"):
            ends = np.array([cell.parts[part].X_WB, scene.X_WP_goal])
            at_ends = []
            for X_WP in ends:
                clear = clears_ground(self.work, self.table, X_WP)[self.order]
                at_ends += self.compatible([self.order[clear].tolist()], X_WP[None], 0)
        self.at_ends = at_ends
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
        places = [self.place(*it) for it in zip(names, ends, at_ends, strict=True)]
        self.graph = Graph(velocity, self.work.current.q, self.work.home, places)
        self.sets = [self.mask(found) for found in at_ends]
        count = self.told.count
        count("grasps of the part", len(self.order))
        for name, found in zip(names, at_ends, strict=True):
            count(f"legal at the {name}", len(found.legal))
        count("resting poses", len(self.table.rests))

    def forgive(self) -> None:
        """What was refused is tried again: the next pass has greater budgets."""
        self.reaches = {key: it for key, it in self.reaches.items() if isinstance(it, Reach)}
        self.graph.forgive()

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
        needs = self.needs(regrasps)
        if not needs:
            return None
        for level in range(len(self.options.samples)):
            if self.tried >= stop_at:
                break
            self.add_places(needs, regrasps, level)
            carry = self.try_sequences(regrasps, direct, stop_at)
            if carry is not None:
                return carry
        return None

    def needs(self, regrasps: int) -> list[_Needs]:
        """Resting poses through which so many regrasps join the ends, by the table alone."""
        clear = self.table.clear
        forth, back = [self.sets[0]], [self.sets[1]]
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

    def add_places(self, needs: list[_Needs], regrasps: int, level: int) -> None:
        """Choose places for the resting poses and test the needed grasps there."""
        samples, most = self.options.samples[level], self.options.places[level]
        if (regrasps > 1, level) in self.looked:
            return
        self.looked.add((regrasps > 1, level))
        # With one put-down a few grasps of each group will do; with more, they must match.
        wanted = self.options.grasps if regrasps == 1 else 10 * self.options.grasps
        for need in needs:
            groups = [self.order[group[self.order]].tolist() for group in need.groups]
            with self.work.clock("regrasp"):
                few = [group[: self.options.grasps] for group in groups]
                candidates, why = self.finder.best(need.rest, few, samples, most)
                if not candidates:
                    self.told.reason(f"resting pose {need.rest}: {why}")
                    continue
                X_WP = np.array([candidate.X_WP for candidate in candidates])
                for candidate, found in zip(
                    candidates, self.compatible(groups, X_WP, wanted), strict=True
                ):
                    name = f"on {candidate.on}, resting pose {need.rest}"
                    self.told.count("placements looked at")
                    if found.legal:
                        self.graph.places.append(self.place(name, candidate.X_WP, found))
                    else:
                        self.told.reason(f"{name}: {found.worst_reason or 'out of reach'}")

    def try_sequences(self, regrasps: int, direct: DirectOptions, stop_at: int) -> Carry | None:
        """Plan the cheapest sequences, one after the other."""
        while self.tried < stop_at:
            with self.work.clock("regrasp"):
                hops = self.graph.cheapest(regrasps)
            if hops is None:
                return None
            self.tried += 1
            self.told.count("regrasp sequences tried")
            carry = self.plan(hops, direct)
            if carry is not None:
                return carry
        return None

    def plan(self, hops: list[Hop], direct: DirectOptions) -> Carry | None:
        """All motions of a sequence; those near obstacles, which fail most, first."""
        reaches = []
        for hop in hops:
            reach = self.reach(hop, direct)
            if isinstance(reach, Carry):
                self.refuse(hop, reach, None)
                return None
            reaches.append(reach)
        motions: list[Motion] = []
        current, before = self.work.current, None
        carry = None
        for hop, reach in zip(hops, reaches, strict=True):
            is_last = hop is hops[-1]
            scene = self.scene(hop)
            home = self.work.home if is_last else None
            work = replace(self.work, scene=scene, current=current, home=home)
            carry = carry_through(work, reach, direct)
            if carry.stage != "done" or carry.end is None:
                self.refuse(hop, carry, before)
                return None
            motions += [replace(motion, X_HP=carry.X_HP) for motion in carry.motions]
            current, before = carry.end, hop
        assert carry is not None
        self.words = "; then ".join(self.describe(hop) for hop in hops)
        return replace(carry, motions=motions, regrasps=len(hops) - 1)

    def reach(self, hop: Hop, direct: DirectOptions) -> Reach | Carry:
        """The motions near obstacles of one carry."""
        key = (hop.origin, hop.grasp, hop.target)
        if key not in self.reaches:
            self.reaches[key] = self._find_reach(hop, direct)
        return self.reaches[key]

    def _find_reach(self, hop: Hop, direct: DirectOptions) -> Reach | Carry:
        scene, row = self.scene(hop), self.table.rows[hop.grasp]
        pair = self.pair(hop.grasp)
        pose = _core.PlanarPose(row[4], row[5], row[6])
        with self.work.clock("legal grasps"):
            legal = _core.test_grasp_pose(
                scene, self.work.solver, pair, pose, bool(row[7]), self.table.options.legality
            )
        if not legal.poses:
            return Carry("transfer", legal.worst_reason)
        aim = legal.poses[0]
        work = replace(self.work, scene=scene)
        nearest = sorted(aim.q_pick, key=lambda q: float(np.max(np.abs(q - hop.q_pick))))
        for q_pick in nearest[:2]:
            found = find_reach(work, pair, aim, q_pick, direct)
            if isinstance(found, Reach):
                self.told.count("approached")
                return found
        return found

    def scene(self, hop: Hop) -> _core.GraspScene:
        """The carry as a pick-and-place of its own."""
        scene, places = self.work.scene, self.graph.places
        cell = scene.cell
        if hop.origin != ORIGIN:
            cell = cell.with_part_at(scene.part, places[hop.origin].X_WP)
        goal = places[hop.target].X_WP
        return _core.GraspScene(model=self.work.model, cell=cell, part=scene.part, X_WP_goal=goal)

    def refuse(self, hop: Hop, carry: Carry, before: Hop | None) -> None:
        """Take out of the graph what the planners of a motion refused."""
        if carry.stage in ("approach", "depart"):
            self.graph.refuse_pick(hop.origin, hop.grasp)
            self.graph.discourage(hop.origin, self.alike(hop.grasp))
        elif carry.stage in ("deposit", "withdraw", "home"):
            self.graph.refuse_put(hop.target, hop.grasp)
            self.graph.discourage(hop.target, self.alike(hop.grasp))
        elif carry.stage == "transit":
            grasp = -1 if before is None else before.grasp
            self.graph.refuse_transit(hop.origin, grasp, hop.grasp)
        else:
            self.graph.refuse_transfer(hop.origin, hop.grasp, hop.target)
        self.told.attempts.append(Attempt(self.describe(hop), carry.stage, carry.reason))

    def alike(self, grasp: int) -> np.ndarray:
        """Grasps on the same features from about the same side, which are likely to fail too."""
        rows = self.table.rows
        same = np.all(rows[:, :4] == rows[grasp, :4], axis=1)
        turned = np.cos(rows[:, 6] - rows[grasp, 6])
        return np.flatnonzero(same & (turned > ALIKE))

    def describe(self, hop: Hop) -> str:
        """A carry in words."""
        places = self.graph.places
        origin, target = places[hop.origin].name, places[hop.target].name
        pair, z = self.pair(hop.grasp).pair, self.table.grasps.X_PH[hop.grasp][:3, 2]
        return (
            f"{pair}, hand along ({z[0]:+.2f}, {z[1]:+.2f}, {z[2]:+.2f}) of the part, "
            f"{origin} to {target}"
        )

    def pair(self, grasp: int) -> _core.RankedPair:
        """The feature pair of a grasp."""
        key = tuple(self.table.rows[grasp, :4])
        if key not in self.pairs:
            scene, faces = self.work.scene, key[0] == key[2] == 0.0
            ranking = _core.rank_part_alone(
                scene.cell.parts[scene.part], scene.cell.robot, self.table.options.ranking_of(faces)
            )
            for ranked in ranking.ranked:
                a, b = ranked.pair.a, ranked.pair.b
                features = (_KINDS[a.kind.name], a.index, _KINDS[b.kind.name], b.index)
                self.pairs[tuple(float(v) for v in features)] = ranked
        return self.pairs[key]

    def compatible(
        self, groups: list[list[int]], places: np.ndarray, most: int
    ) -> list[_core.CompatibleGrasps]:
        """Which grasps are legal at some places."""
        return compatible(self.work, self.table, groups, places, most)

    def place(self, name: str, X_WP: np.ndarray, found: _core.CompatibleGrasps) -> Place:
        """A node of the graph for each legal grasp, with its two best configurations."""
        rows = [(item.grasp, q, item.margin) for item in found.legal for q in item.q[:2]]
        dof = self.work.scene.cell.robot.dof
        grasps = np.array([grasp for grasp, *_ in rows], dtype=int)
        charge = np.array([1.0 - margin for *_, margin in rows])
        # Choice: a full pad at the centre of mass is worth as much as one second.
        charge = charge + (0.7 - self.table.merit[grasps]) if len(rows) else charge
        q = np.array([q for _, q, _ in rows]).reshape(len(rows), dof)
        return Place(name, X_WP, grasps, q, charge)

    def mask(self, found: _core.CompatibleGrasps) -> np.ndarray:
        """The legal grasps as a mask of all."""
        mask = np.zeros(len(self.table.rows), dtype=bool)
        mask[[item.grasp for item in found.legal]] = True
        return mask

    @property
    def joins_ends(self) -> bool:
        """Is a grasp legal at each end?"""
        return bool(self.sets[0].any() and self.sets[1].any())

    def _tell_illegal_ends(self) -> None:
        total = len(self.table.rows)
        for name, found in zip(("origin", "destination"), self.at_ends, strict=True):
            if found.legal or not total:
                continue
            fallen = {
                "below what the part stands on": total - found.tried,
                "out of reach": found.unreachable,
                f"in collision ({found.worst_reason})": found.collides,
            }
            why = ", ".join(f"{count} {text}" for text, count in fallen.items() if count)
            self.told.reason(f"no grasp is legal at the {name}: of {total} hand poses {why}")


_KINDS = {"Face": 0, "Edge": 1, "Vertex": 2}


def compatible(
    work: Workspace, table: GraspTable, groups: list[list[int]], places: np.ndarray, most: int
) -> list[_core.CompatibleGrasps]:
    """Which grasps of a table are legal at some places (n, 4, 4); of each group `most`, 0: all."""
    scene, legality = work.scene, table.options.legality
    return list(
        _core.find_compatible_grasps(
            work.model,
            scene.cell,
            scene.part,
            work.solver,
            table.grasps,
            groups,
            places,
            open_clearance=legality.open_clearance,
            clearance=legality.clearance,
            most=most,
        )
    )


def clears_ground(work: Workspace, table: GraspTable, X_WP: np.ndarray) -> np.ndarray:
    """At which grasps the hand stays above a wide face that the part stands on, shape (n,).

    All of them, if there is no such face: only sure collisions are told.
    """
    scene = work.scene
    clear = np.ones(len(table.rows), dtype=bool)
    there = scene.cell.with_part_at(scene.part, X_WP)
    for touched in _core.touching_bodies(work.model, there, scene.part):
        for face in _core.support_faces(there.body(touched)):
            X_SP = np.linalg.inv(face.X_WS) @ X_WP
            point = X_SP[:2, 3]
            if _holds(face.region, point) and _stands_on(scene.cell.parts[scene.part], X_SP):
                clear &= _core.clears_plane(
                    scene.cell.robot, table.grasps, X_SP, table.options.legality
                )
    return clear


def _holds(region: _core.Region, point: np.ndarray) -> bool:
    """Does the region hold all that is within the hand's reach of the point?"""
    return region.contains(point) and _core.boundary_distance(region, point) > HAND_REACH


def _stands_on(part: _core.Body, X_SP: np.ndarray) -> bool:
    lowest = min(
        float(((X_SP[:3, :3] @ np.asarray(_core.hull_points(shape)).T).T + X_SP[:3, 3])[:, 2].min())
        for shape in part.shapes
    )
    return abs(lowest) < 1e-3
