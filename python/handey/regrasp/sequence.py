"""The motions of a sequence of carries: those near obstacles, which fail most, come first.

What was found or refused for one carry serves all sequences that have it. What the planners refuse
is taken out of the graph, and grasps alike are discouraged there, so that the next cheapest
sequence is another one. Article: "Regrasping".
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from handey import _core
from handey.motion.carry import Carry, DirectOptions, Motion, Workspace
from handey.motion.pick_and_place import carry_through
from handey.motion.reach import Reach, find_reach
from handey.regrasp.graph import ORIGIN, Graph, Hop
from handey.regrasp.grasp_table import GraspTable
from handey.reporting.goal_report import Attempt

__all__ = ["Sequences", "Told"]

ALIKE = 0.9  # Choice: cosine between the directions of two hands that count as alike
_KINDS = {"Face": 0, "Edge": 1, "Vertex": 2}


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
class Sequences:
    """Plans the motions of sequences through one graph.

    Attributes:
        work: the goal, and where the arm is.
        table: grasps of the part.
        graph: the places, with the grasps that are legal there.
        told: what was tried.
        words: the sequence that was planned.
    """

    work: Workspace
    table: GraspTable
    graph: Graph
    told: Told
    words: str = ""
    _reaches: dict[tuple[int, int, int], Reach | Carry] = field(default_factory=dict)
    _pairs: dict[tuple[float, ...], _core.RankedPair] = field(default_factory=dict)

    def forgive(self) -> None:
        """What was refused is tried again: the next pass has greater budgets."""
        self._reaches = {key: it for key, it in self._reaches.items() if isinstance(it, Reach)}
        self.graph.forgive()

    def plan(self, hops: list[Hop], direct: DirectOptions) -> Carry | None:
        """All motions of a sequence; those near obstacles, which fail most, first."""
        reaches = []
        for hop in hops:
            reach = self._reach(hop, direct)
            if isinstance(reach, Carry):
                self._refuse(hop, reach, None)
                return None
            reaches.append(reach)
        motions: list[Motion] = []
        current, before = self.work.current, None
        carry = None
        for hop, reach in zip(hops, reaches, strict=True):
            is_last = hop is hops[-1]
            scene = self._scene(hop)
            home = self.work.home if is_last else None
            work = replace(self.work, scene=scene, current=current, home=home)
            carry = carry_through(work, reach, direct)
            if carry.stage != "done" or carry.end is None:
                self._refuse(hop, carry, before)
                return None
            motions += [replace(motion, X_HP=carry.X_HP) for motion in carry.motions]
            current, before = carry.end, hop
        assert carry is not None
        self.words = "; then ".join(self._describe(hop) for hop in hops)
        return replace(carry, motions=motions, regrasps=len(hops) - 1)

    def _reach(self, hop: Hop, direct: DirectOptions) -> Reach | Carry:
        """The motions near obstacles of one carry."""
        key = (hop.origin, hop.grasp, hop.target)
        if key not in self._reaches:
            self._reaches[key] = self._find_reach(hop, direct)
        return self._reaches[key]

    def _find_reach(self, hop: Hop, direct: DirectOptions) -> Reach | Carry:
        scene, row = self._scene(hop), self.table.rows[hop.grasp]
        pair = self._pair(hop.grasp)
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

    def _scene(self, hop: Hop) -> _core.GraspScene:
        """The carry as a pick-and-place of its own."""
        scene, places = self.work.scene, self.graph.places
        cell = scene.cell
        if hop.origin != ORIGIN:
            cell = cell.with_part_at(scene.part, places[hop.origin].X_WP)
        goal = places[hop.target].X_WP
        return _core.GraspScene(model=self.work.model, cell=cell, part=scene.part, X_WP_goal=goal)

    def _refuse(self, hop: Hop, carry: Carry, before: Hop | None) -> None:
        """Take out of the graph what the planners of a motion refused."""
        if carry.stage in ("approach", "depart"):
            self.graph.refuse_pick(hop.origin, hop.grasp)
            self.graph.discourage(hop.origin, self._alike(hop.grasp))
        elif carry.stage in ("deposit", "withdraw", "home"):
            self.graph.refuse_put(hop.target, hop.grasp)
            self.graph.discourage(hop.target, self._alike(hop.grasp))
        elif carry.stage == "transit":
            grasp = -1 if before is None else before.grasp
            self.graph.refuse_transit(hop.origin, grasp, hop.grasp)
        else:
            self.graph.refuse_transfer(hop.origin, hop.grasp, hop.target)
        self.told.attempts.append(Attempt(self._describe(hop), carry.stage, carry.reason))

    def _alike(self, grasp: int) -> np.ndarray:
        """Grasps on the same features from about the same side, which are likely to fail too."""
        rows = self.table.rows
        same = np.all(rows[:, :4] == rows[grasp, :4], axis=1)
        turned = np.cos(rows[:, 6] - rows[grasp, 6])
        return np.flatnonzero(same & (turned > ALIKE))

    def _describe(self, hop: Hop) -> str:
        """A carry in words."""
        places = self.graph.places
        origin, target = places[hop.origin].name, places[hop.target].name
        pair, z = self._pair(hop.grasp).pair, self.table.grasps.X_PH[hop.grasp][:3, 2]
        return (
            f"{pair}, hand along ({z[0]:+.2f}, {z[1]:+.2f}, {z[2]:+.2f}) of the part, "
            f"{origin} to {target}"
        )

    def _pair(self, grasp: int) -> _core.RankedPair:
        """The feature pair of a grasp."""
        key = tuple(self.table.rows[grasp, :4])
        if key not in self._pairs:
            scene, faces = self.work.scene, key[0] == key[2] == 0.0
            ranking = _core.rank_part_alone(
                scene.cell.parts[scene.part], scene.cell.robot, self.table.options.ranking_of(faces)
            )
            for ranked in ranking.ranked:
                a, b = ranked.pair.a, ranked.pair.b
                features = (_KINDS[a.kind.name], a.index, _KINDS[b.kind.name], b.index)
                self._pairs[tuple(float(v) for v in features)] = ranked
        return self._pairs[key]
