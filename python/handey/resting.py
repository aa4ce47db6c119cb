"""Where can a part be put down? A stream of placements, the best first.

The part may rest on any of its stable faces, on any upward horizontal face of the bodies that carry
parts, anywhere and turned anyhow: positions and turns are samples of a low-discrepancy sequence,
denser from round to round. Each placement is clear of all other bodies and stands stably by the
rule of the format. Within a round those come first that the hand reaches, that have room round
about, and that are near to where the caller says.
Not guaranteed: that a grasp reaches a placement. Article: "Regrasping", the choice of placements.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from handey import _core
from handey.errors import Fault, InvalidInput
from handey.placement import TOUCHING, examine_standing

__all__ = ["Placement", "PlacementOptions", "Sought", "placements", "same_rest"]

# Choice: on more than this, the corners of round shapes and rounding make no difference [m].
SURE_WIDTH, SURE_MARGIN = 5e-3, 1e-3


@dataclass(frozen=True)
class Placement:
    """A part put down.

    Attributes:
        X_WP: the part in the world (4, 4).
        on: name of the body that it stands on.
        rest: index in `_core.resting_poses(part)`, or in the rests that the caller gave.
        margin: of the centre of mass within what it stands on [m].
        room: it is at least so far from all that is not under it [m].
    """

    X_WP: np.ndarray
    on: str
    rest: int
    margin: float
    room: float = 0.0


@dataclass(frozen=True)
class PlacementOptions:
    """What bounds and steers the stream.

    Attributes:
        seed: of the sequence.
        first_round: samples of the first round, over all faces and rests; each further round has
            twice as many.
        rounds: after so many the stream ends.
        within: half of the samples are taken this near to where the caller says; twice as far in
            each further round [m].
        enough_room: more room than this is no better [m].
    """

    seed: int = 0
    first_round: int = 96
    rounds: int = 6
    within: float = 0.15
    enough_room: float = 0.03


@dataclass
class Sought:
    """What became of the samples of a stream so far, for reports."""

    tried: int = 0
    lack: str = "there is no upward horizontal face on which the part can stand"
    fallen: Counter[str] = field(default_factory=Counter)
    met: Counter[str] = field(default_factory=Counter)

    def reason(self) -> str:
        """Why there are no more placements, in words."""
        if not self.tried:
            return self.lack
        counts = ", ".join(f"{count} {why}" for why, count in self.fallen.most_common() if count)
        met = self.met.most_common(1)
        return f"{self.tried} places: {counts}" + (f"; most met {met[0][0]}" if met else "")


def same_rest(part: _core.Body, X_WP: np.ndarray) -> list[_core.RestingPose]:
    """The rest in which a part stands at X_WP (4, 4), and no other; of a round side any roll."""
    return [_core.resting_pose(part, np.asarray(X_WP)[2, :3])]


def placements(
    cell: _core.Cell,
    model: _core.CollisionModel,
    part: int,
    *,
    on: Sequence[str] | None = None,
    rests: Sequence[_core.RestingPose] | None = None,
    only: Sequence[int] | None = None,
    region: np.ndarray | None = None,
    inside: bool = False,
    near: np.ndarray | None = None,
    solver: _core.SphericalWristSolver | None = None,
    robot: _core.Configuration | None = None,
    options: PlacementOptions | None = None,
    sought: Sought | None = None,
) -> Iterator[Placement]:
    """Placements of a part, lazily, the best first; the same for the same arguments.

    Args:
        cell: where the other bodies are; where the part itself is does not matter.
        model: collision geometry of the cell.
        part: index in the cell's parts.
        on: names of the bodies to put it on; None: all fixtures and parts with `support`.
        rests: ways to rest; None: all stable ones of the part.
        only: indices into `rests`; None: all.
        region: least x, y; greatest x, y in the world (2, 2), that all it stands on lies in.
        inside: within the walls of the bodies that it is put on.
        near: a point (2,) or (3,) or a pose (4, 4) that it should be near to.
        solver: places that the hand cannot reach from above come last.
        robot: where the robot stands and is kept clear of; None: at the cell's start.
        options: bounds.
        sought: is told what became of the samples.

    Raises:
        InvalidInput: E_REF, if there is no body of a name.
    """
    options, sought = options or PlacementOptions(), sought if sought is not None else Sought()
    faces = _faces(cell, part, on, inside)
    chosen = list(rests) if rests is not None else _core.resting_poses(cell.parts[part])
    indices = list(range(len(chosen))) if only is None else list(only)
    target = None if near is None else _point(np.asarray(near, dtype=float))
    grounds = [(name, face, rest) for rest in indices for name, face in faces]
    if inside:
        sought.lack = f"no walls of {' or '.join(on or ['the supports'])} enclose a horizontal face"
    if not grounds:
        return
    first = 0
    for round_ in range(options.rounds):
        count = max(4, (options.first_round << round_) // len(grounds))
        found = []
        for name, face, rest in grounds:
            places = _core.find_standing_places(
                model,
                cell,
                part,
                chosen[rest],
                face,
                _core.StandingPlaceOptions(
                    first=first,
                    count=count,
                    seed=options.seed,
                    near_point=target,
                    within=options.within * 2**round_,
                    region=region,
                    inside=inside,
                    robot=robot or cell.start,
                ),
            )
            _tell(sought, places)
            found += [
                Placement(place.X_WP, name, rest, place.margin, place.room)
                for place in places.places
            ]
        first += count
        # A stable sort: equals stay in the order of rests, faces and samples.
        found.sort(key=lambda place: _cost(place, chosen[place.rest], target, options))
        unreached = []
        for place in found:
            if solver is not None and not _reaches_over(cell, solver, place, chosen[place.rest]):
                unreached.append(place)
            elif _stands(cell, model, part, place, chosen[place.rest]):
                yield place
        for place in unreached:
            if _stands(cell, model, part, place, chosen[place.rest]):
                yield place


def _faces(
    cell: _core.Cell, part: int, on: Sequence[str] | None, inside: bool
) -> list[tuple[str, _core.SupportFace]]:
    """Name and face of all that the part may be put on, by body, highest first."""
    held = None if cell.held is None else cell.held.part
    others = [body for i, body in enumerate(cell.parts) if i not in (part, held)]
    bodies = [*cell.fixtures, *others]
    if on is None:
        bodies = [body for body in bodies if body.support]
    else:
        names = [body.name for body in bodies]
        for name in on:
            if name not in names:
                message = f"no body '{name}' to stand on; there are: {', '.join(names)}"
                raise InvalidInput(Fault("E_REF", "on", message))
        bodies = [body for body in bodies if body.name in on]
    faces = [(body.name, face) for body in bodies for face in _core.support_faces(body)]
    return [(name, face) for name, face in faces if not inside or not face.enclosed.empty()]


def _point(near: np.ndarray) -> np.ndarray:
    return near[:2, 3] if near.shape == (4, 4) else near[:2]


def _cost(
    place: Placement,
    rest: _core.RestingPose,
    target: np.ndarray | None,
    options: PlacementOptions,
) -> float:
    """Small for a placement that is steady, roomy and near."""
    # Choice: no room costs as much as half a metre of way, and as a rest that tips by a push.
    narrow = 1.0 - min(place.room / options.enough_room, 1.0)
    shaky = 1.0 - min(rest.tip_angle / 0.5, place.margin / 0.01, 1.0)
    centre = place.X_WP @ np.linalg.inv(rest.X_SP)[:, 3]
    far = 0.0 if target is None else float(np.linalg.norm(centre[:2] - target)) / 0.5
    return narrow + shaky + far


def _tell(sought: Sought, places: _core.StandingPlaces) -> None:
    sought.tried += places.tried
    sought.fallen["off the face"] += places.off_the_face
    sought.fallen["outside the region"] += places.outside_the_region
    sought.fallen["not within walls"] += places.outside_the_walls
    sought.fallen["not clear"] += places.not_clear
    if places.in_the_way:
        sought.met[places.in_the_way] += places.not_clear


def _reaches_over(
    cell: _core.Cell,
    solver: _core.SphericalWristSolver,
    place: Placement,
    rest: _core.RestingPose,
) -> bool:
    """Does the hand reach the part from above, in one of two turns? A hint, no proof."""
    centre = place.X_WP @ np.linalg.inv(rest.X_SP) @ np.array([0.0, 0.0, rest.height, 1.0])
    for turn in (0.0, 0.5 * math.pi):
        X_WH = np.eye(4)
        X_WH[:3, :3] = [
            [math.cos(turn), math.sin(turn), 0.0],
            [math.sin(turn), -math.cos(turn), 0.0],
            [0.0, 0.0, -1.0],
        ]
        X_WH[:3, 3] = centre[:3]
        if solver.solve(np.linalg.inv(cell.X_WR) @ X_WH, cell.start.q).solutions:
            return True
    return False


def _stands(
    cell: _core.Cell,
    model: _core.CollisionModel,
    part: int,
    place: Placement,
    rest: _core.RestingPose,
) -> bool:
    """By the rule of the format; what is far from its bounds was seen to be by the core."""
    if rest.width > SURE_WIDTH and place.margin > SURE_MARGIN:
        return True
    there = cell.with_part_at(part, place.X_WP)
    near = _core.touching_bodies(model, there, part, TOUCHING)
    return examine_standing(cell, part, place.X_WP, near).stable
