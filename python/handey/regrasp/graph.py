"""The graph of grasps and placements: which sequence of carries is cheapest?

A node is a grasp that is legal at a place, with the arm's configurations there. A transfer joins
the nodes of one grasp at two places, a transit those of two grasps at one place. A sequence picks
the part up at its origin, puts it down at so many places on the way, and ends at its destination;
its cost is the time of the arm's motions, each as if straight in joint space, with what a node is
charged for little room at its joint limits. What motion planning refuses is taken out, and the
search goes on. Exact over the places and configurations that it is given. Article: "Regrasping".
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from handey import _core

__all__ = ["Graph", "Hop", "Place"]

DISCOURAGED = 1.5  # Choice: what a node likely to be refused costs more [s]
ORIGIN, DESTINATION = 0, 1  # indices of the first two places


@dataclass(frozen=True, eq=False)
class Place:
    """Where the part stands, and the grasps that are legal there.

    Attributes:
        name: in words: "origin", "on table".
        X_WP: the part in the world (4, 4).
        grasps: one per row, ascending (n,).
        q: configurations of the arm, one per row (n, dof) [rad].
        charge: seconds that a row costs on top of its motions (n,).
    """

    name: str
    X_WP: np.ndarray
    grasps: np.ndarray
    q: np.ndarray
    charge: np.ndarray


@dataclass(frozen=True)
class Hop:
    """One carry: a grasp, between two places (indices), and where the arm is at both."""

    grasp: int
    origin: int
    target: int
    q_pick: np.ndarray
    q_place: np.ndarray


@dataclass
class _Layer:
    """Least cost of each row of each place, and the row before (place, row)."""

    cost: list[np.ndarray]
    before: list[np.ndarray]


@dataclass
class Graph:
    """Places and what of them is left.

    Attributes:
        velocity: of the joints (dof,) [rad/s].
        start: where the arm is (dof,).
        end: where it returns to (dof,), or None.
        places: origin, destination, and those on the way.
    """

    velocity: np.ndarray
    start: np.ndarray
    end: np.ndarray | None
    places: list[Place]
    refused: set[tuple[str, int, int, int]] = field(default_factory=set)
    _transfers: dict[tuple[int, int], tuple[np.ndarray, np.ndarray, np.ndarray]] = field(
        default_factory=dict
    )
    _transits: dict[int, np.ndarray] = field(default_factory=dict)

    def refuse_pick(self, place: int, grasp: int) -> None:
        """The hand gets to no such grasp there, or the part not off what it stands on."""
        self.refused.add(("pick", place, grasp, 0))

    def refuse_put(self, place: int, grasp: int) -> None:
        """The part cannot be put down there in such a grasp, or the hand not be drawn back."""
        self.refused.add(("put", place, grasp, 0))

    def refuse_transit(self, place: int, before: int, after: int) -> None:
        """There is no way from one grasp to the other there; before the first: -1."""
        self.refused.add(("transit", place, before, after))
        self._transits.pop(place, None)

    def refuse_transfer(self, origin: int, grasp: int, target: int) -> None:
        """There is no way to carry the part from one place to the other."""
        self.refused.add(("transfer", origin, grasp, target))
        self._transfers.pop((origin, target), None)

    def discourage(self, place: int, grasps: np.ndarray) -> None:
        """What is like a grasp that was refused there costs more."""
        node = self.places[place]
        node.charge[np.isin(node.grasps, grasps)] += DISCOURAGED
        self._transits.pop(place, None)

    def forgive(self) -> None:
        """Nothing is refused any more."""
        self.refused.clear()
        self._transfers.clear()
        self._transits.clear()

    def cheapest(self, regrasps: int) -> list[Hop] | None:
        """The cheapest sequence with exactly so many regrasps; None if there is none."""
        layers = [self._first()]
        for _ in range(regrasps):
            put = self._put(layers[-1], range(2, len(self.places)))
            layers += [put, self._pick(put)]
        last = self._put(layers[-1], [DESTINATION])
        cost = last.cost[DESTINATION]
        if self.end is not None and len(cost):
            cost = cost + self._times(self.places[DESTINATION].q, self.end)
        if not len(cost) or not np.isfinite(cost.min()):
            return None
        return self._walk_back([*layers, last], int(np.argmin(cost)))

    def _first(self) -> _Layer:
        layer = self._empty()
        place = self.places[ORIGIN]
        cost = self._times(place.q, self.start) + place.charge
        for row, grasp in enumerate(place.grasps):
            if self._is_refused("pick", ORIGIN, int(grasp)) or self._is_refused(
                "transit", ORIGIN, -1, int(grasp)
            ):
                cost[row] = np.inf
        layer.cost[ORIGIN] = cost
        return layer

    def _put(self, held: _Layer, targets: range | list[int]) -> _Layer:
        layer = self._empty()
        for target in targets:
            place = self.places[target]
            banned = [self._is_refused("put", target, int(grasp)) for grasp in place.grasps]
            for origin in range(len(self.places)):
                _core.throw_if_stopped()
                if origin in (target, DESTINATION) or not np.isfinite(held.cost[origin]).any():
                    continue
                rows, there, times = self._transfer(origin, target)
                cost = held.cost[origin][rows] + times
                for row, to, value in zip(rows, there, cost, strict=True):
                    if value < layer.cost[target][to]:
                        layer.cost[target][to] = value
                        layer.before[target][to] = (origin, row)
            layer.cost[target] = np.where(banned, np.inf, layer.cost[target] + place.charge)
        return layer

    def _pick(self, put: _Layer) -> _Layer:
        layer = self._empty()
        for index, place in enumerate(self.places):
            _core.throw_if_stopped()
            if index < 2 or not np.isfinite(put.cost[index]).any():
                continue
            total = put.cost[index][:, None] + self._transit(index)
            best = np.argmin(total, axis=0)
            layer.cost[index] = total[best, np.arange(len(best))]
            layer.before[index] = np.stack([np.full(len(best), index), best], axis=1)
            for row, grasp in enumerate(place.grasps):
                if self._is_refused("pick", index, int(grasp)):
                    layer.cost[index][row] = np.inf
        return layer

    def _walk_back(self, layers: list[_Layer], row: int) -> list[Hop]:
        hops, place = [], DESTINATION
        for depth in range(len(layers) - 1, 0, -2):
            origin, held = (int(v) for v in layers[depth].before[place][row])
            target, here = self.places[place], self.places[origin]
            grasp = int(target.grasps[row])
            hops.append(Hop(grasp, origin, place, here.q[held], target.q[row]))
            place = origin
            if depth > 1:
                row = int(layers[depth - 1].before[place][held][1])
        return hops[::-1]

    def _transfer(self, origin: int, target: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Rows of both places with the same grasp, and the times between them [s]."""
        known = self._transfers.get((origin, target))
        if known is None:
            a, b = self.places[origin], self.places[target]
            rows, there = np.nonzero(a.grasps[:, None] == b.grasps[None, :])
            times = self._times(a.q[rows], b.q[there])
            for i, row in enumerate(rows):
                if self._is_refused("transfer", origin, int(a.grasps[row]), target):
                    times[i] = np.inf
            known = self._transfers[origin, target] = rows, there, times
        return known

    def _transit(self, index: int) -> np.ndarray:
        """Times between all rows of a place, infinite between those of one grasp [s]."""
        known = self._transits.get(index)
        if known is None:
            place = self.places[index]
            known = self._times(place.q[:, None, :], place.q[None, :, :]) + place.charge[None, :]
            known[place.grasps[:, None] == place.grasps[None, :]] = np.inf
            for kind, at, before, after in self.refused:
                if kind == "transit" and at == index:
                    banned = (place.grasps[:, None] == before) & (place.grasps[None, :] == after)
                    known[banned] = np.inf
            self._transits[index] = known
        return known

    def _times(self, a: np.ndarray, b: np.ndarray) -> np.ndarray:
        if not a.size:
            return np.zeros(a.shape[:-1])
        return np.asarray(np.max(np.abs(a - b) / self.velocity, axis=-1))

    def _is_refused(self, kind: str, a: int, b: int, c: int = 0) -> bool:
        return (kind, a, b, c) in self.refused

    def _empty(self) -> _Layer:
        return _Layer(
            [np.full(len(place.grasps), np.inf) for place in self.places],
            [np.full((len(place.grasps), 2), -1) for place in self.places],
        )
