"""
The compiled core of handey. Metres, radians, seconds. Poses are 4 x 4 arrays.
"""

from __future__ import annotations
import collections.abc
import numpy
import numpy.typing
import os
import typing

__all__: list[str] = [
    "Allowance",
    "ApproachOptions",
    "ApproachPlanner",
    "ApproachResult",
    "ApproachStatus",
    "ArmJoint",
    "ArmPlane",
    "ArmTable",
    "ArmTableOptions",
    "BlockedCells",
    "BlockedProof",
    "Body",
    "BlockedPoses",
    "BodyRef",
    "Box",
    "BumpLine",
    "CancelToken",
    "Cell",
    "CellKind",
    "CertificateOptions",
    "ClearancePath",
    "CollisionChecker",
    "CollisionModel",
    "CompatibleGrasp",
    "CompatibleGrasps",
    "Configuration",
    "Cylinder",
    "DepartureOptions",
    "DepartureResult",
    "DepthImage",
    "DepthMapOptions",
    "Diagnosis",
    "EdgeResult",
    "EdgeStatus",
    "Exhaustion",
    "ExhaustionOptions",
    "FallKind",
    "Fallen",
    "Feature",
    "FeatureKind",
    "FeatureOptions",
    "FeaturePair",
    "FeaturePairs",
    "FingerJoint",
    "FreeSpaceOptions",
    "GraspEnd",
    "GraspObstacle",
    "GraspPose",
    "GraspScene",
    "Gripper",
    "GripperOutline",
    "GrossOptions",
    "HandPathOptions",
    "HandPathResult",
    "HeightMap",
    "HeldPart",
    "Hit",
    "IllegalCause",
    "IllegalKind",
    "InscribedCircle",
    "InverseResult",
    "InverseSolution",
    "InverseStatus",
    "JoinedScene",
    "JointLimit",
    "Lattice",
    "LayerOptions",
    "LegalGraspSearch",
    "LegalGrasps",
    "LegalityOptions",
    "LoadedMesh",
    "LoadedRobot",
    "MeasuredBody",
    "MeshShape",
    "MotionGrid",
    "MotionResult",
    "MotionStatus",
    "NearbyBody",
    "OutlinePiece",
    "Overlap",
    "PairChoice",
    "PairKind",
    "PartEdge",
    "PartGrasps",
    "PartVertex",
    "PlanarArm",
    "PlanarFace",
    "PlanarPose",
    "PlaneSearchOptions",
    "PoseBlock",
    "QuasipotentialOptions",
    "RankedPair",
    "Ranking",
    "RankingOptions",
    "ReachBall",
    "Region",
    "RejectedPair",
    "Rejection",
    "RestingOptions",
    "RestingPose",
    "RetreatOptions",
    "RetreatResult",
    "Robot",
    "RobotBody",
    "RobotDescription",
    "SamplingOptions",
    "Scene",
    "SceneHull",
    "SceneMover",
    "SceneObstacle",
    "SceneOptions",
    "SearchOptions",
    "SearchResult",
    "Separation",
    "SeparationOptions",
    "Shape",
    "ShortcutOptions",
    "ShutIn",
    "ShutInOptions",
    "SingularityMargin",
    "Slab",
    "Slice",
    "SliceLayer",
    "SliceMode",
    "SliceOptions",
    "SlideResult",
    "SlideStatus",
    "Sphere",
    "SphericalWristSolver",
    "StandingPlace",
    "StandingPlaceOptions",
    "StandingPlaces",
    "SupportFace",
    "SupportFaceOptions",
    "SurfaceReport",
    "TimedPath",
    "TimingOptions",
    "Torus",
    "TriangleMesh",
    "WalledOff",
    "WristRange",
    "arm_plane",
    "beyond_reach",
    "body_poses",
    "boundary_distance",
    "bump_lines",
    "centre_of_mass",
    "certify_edge",
    "certify_path",
    "clearance_path",
    "clears_plane",
    "connected_components",
    "connected_parts",
    "contains_point",
    "convex_hull",
    "cover_depths",
    "cover_heights",
    "cross_section",
    "describe_scene",
    "diagnose_grasps",
    "exhaust_grasps",
    "explained_pixels",
    "find_compatible_grasps",
    "find_enclosing",
    "find_feature_pairs",
    "find_hits_along",
    "find_legal_grasps",
    "find_overlaps",
    "find_standing_places",
    "fingertip_targets",
    "follow_hand_path",
    "forbidden_angles",
    "gripper_outline",
    "hand_in_plane",
    "hand_in_world",
    "hand_pose",
    "hull_points",
    "inspect_surface",
    "intersect",
    "is_convex",
    "join_destination",
    "largest_inscribed_circle",
    "limit_violation",
    "load_mesh",
    "load_robot",
    "make_arm_table",
    "make_collision_model",
    "make_lattice",
    "motion_bound",
    "nearby_bodies",
    "offset",
    "pad_contact_area",
    "plan_approach",
    "plan_by_sampling",
    "plan_departure",
    "plan_gross_motion",
    "plan_retreat",
    "planar_faces",
    "planar_slice",
    "pose_from_xyz_quat",
    "pose_from_xyz_rpy",
    "prove_apart",
    "prove_layer",
    "prove_shut_in",
    "prove_walled_off",
    "quaternion_xyzw",
    "rank_grasps",
    "rank_part_alone",
    "reach_ball",
    "reach_margins",
    "resting_pose",
    "resting_poses",
    "robot_overlaps",
    "run_within",
    "sample_part_grasps",
    "search_free_space",
    "shorten_path",
    "slab_projection",
    "slide_along",
    "slide_to_target",
    "subtract",
    "support_faces",
    "tessellate",
    "test_grasp_pose",
    "throw_if_stopped",
    "time_path",
    "torus_of",
    "touching_bodies",
    "travel_time",
    "unfilter_png16",
    "unite",
]

class CancelToken:
    """
    Asks planning to stop, from any thread. Given to `handey.plan`.
    """
    @staticmethod
    def after(seconds: typing.SupportsFloat | typing.SupportsIndex) -> CancelToken:
        """
        A token that also stops by itself.

        Args:
            seconds: from now, finite, 0 or more.

        Raises:
            InvalidInput: E_RANGE.
        """
    def __init__(self) -> None:
        """
        Stops when cancelled.
        """
    def cancel(self) -> None:
        """
        Ask for a stop; there is no way back.
        """
    @property
    def cancelled(self) -> bool:
        """
        Was `cancel` called?
        """
    @property
    def remaining(self) -> float | None:
        """
        Until the deadline, negative after it; None without one [s].
        """
    @property
    def stop_requested(self) -> bool:
        """
        Cancelled, or past the deadline.
        """

class Exhaustion:
    """
    Is no hand pose legal? True if that is so.
    """
    def __bool__(self) -> bool: ...
    @property
    def causes(self) -> list[IllegalCause]:
        """
        Greatest share first.
        """
    @property
    def cells_looked_at(self) -> int: ...
    @property
    def exhausted(self) -> bool:
        """
        No hand pose is legal at the resolution told.
        """
    @property
    def pairs(self) -> int:
        """
        Of features that the jaws span.
        """
    @property
    def reason(self) -> str:
        """
        Why it is not exhausted.
        """
    @property
    def spacing(self) -> float:
        """
        Widest cells judged by their centres [m]; 0: none, all is proved.
        """
    @property
    def turn(self) -> float:
        """
        The same of directions [rad].
        """

class ExhaustionOptions:
    """
    Options of exhaust_grasps.
    """
    def __init__(
        self,
        *,
        spacing: typing.Any = 0.006,
        turn: typing.Any = 0.08726646,
        most_cells: typing.SupportsInt | typing.SupportsIndex = 40000,
        most_pairs: typing.SupportsInt | typing.SupportsIndex = 400,
    ) -> None: ...
    @property
    def most_cells(self) -> int:
        """
        Looked at before it is given up.
        """
    @most_cells.setter
    def most_cells(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def most_pairs(self) -> int:
        """
        With edges or vertices; a part with more is given up.
        """
    @most_pairs.setter
    def most_pairs(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def spacing(self) -> float:
        """
        Of cells that may be judged by their centres [m].
        """
    @spacing.setter
    def spacing(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def turn(self) -> float:
        """
        The same of directions [rad].
        """
    @turn.setter
    def turn(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class IllegalCause:
    """
    What makes hand poses illegal.
    """
    @property
    def joint(self) -> int:
        """
        Of joint limits: its index; else -1.
        """
    @property
    def kind(self) -> IllegalKind: ...
    @property
    def least(self) -> float:
        """
        The least met: out of reach [m], past a limit [rad]; 0 for collisions.
        """
    @property
    def mover(self) -> str:
        """
        Of collisions: a link.
        """
    @property
    def other(self) -> str:
        """
        Of collisions: what it meets.
        """
    @property
    def share(self) -> float:
        """
        Of all that is illegal, 0..1.
        """

class IllegalKind:
    """
    Members:

      OutOfReach

      JointLimit

      Collision
    """

    Collision: typing.ClassVar[IllegalKind]
    JointLimit: typing.ClassVar[IllegalKind]
    OutOfReach: typing.ClassVar[IllegalKind]
    __members__: typing.ClassVar[dict[str, IllegalKind]]
    @typing.overload
    def __eq__(self, other: IllegalKind) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: IllegalKind) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Region:
    """
    A plane region: outer loops counter-clockwise, holes clockwise [m].
    """
    def __init__(self, loops: typing.Any = []) -> None:
        """
        Args:
            loops: closed polygons, each (n, 2) [m]; counter-clockwise outside, clockwise holes.
        """
    def __repr__(self) -> str: ...
    def contains(self, point: typing.Any) -> bool:
        """
        True if the point (2,) lies inside.
        """
    def empty(self) -> bool:
        """
        True if there is no loop.
        """
    @property
    def area(self) -> float:
        """
        Holes taken off [m2].
        """
    @property
    def loops(self) -> list[numpy.ndarray]:
        """
        The loops, each (n, 2) [m].
        """

class InscribedCircle:
    """
    A circle inside a region.
    """
    @property
    def centre(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        (2,) [m]
        """
    @property
    def radius(self) -> float:
        """
        [m]; 0 for an empty region
        """

class TriangleMesh:
    """
    Triangles counter-clockwise seen from outside.
    """
    def __init__(self, vertices: typing.Any, triangles: typing.Any) -> None:
        """
        A mesh from arrays, which are copied.

        Args:
            vertices: (n, 3) [m].
            triangles: (m, 3) integers, indices of vertices.

        Raises:
            InvalidInput: E_NUMBER, E_SHAPE, E_INDEX.
            TypeError: for strings, booleans, complex numbers.
        """
    def __repr__(self) -> str: ...
    @property
    def triangles(self) -> typing.Annotated[numpy.typing.NDArray[numpy.int32], "[m, 3]"]:
        """
        (m, 3) indices, a copy.
        """
    @property
    def vertices(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        (n, 3) [m], a copy.
        """

class SurfaceReport:
    """
    What a surface is.
    """
    @property
    def centroid(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Of the solid, uniform density (3,) [m].
        """
    @property
    def closed(self) -> bool:
        """
        Every edge is shared by an even number of triangles.
        """
    @property
    def components(self) -> int:
        """
        Pieces not connected by an edge.
        """
    @property
    def consistently_oriented(self) -> bool:
        """
        Neighbours run along their common edge in opposite directions.
        """
    @property
    def lower(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Bounding box (3,) [m].
        """
    @property
    def manifold(self) -> bool:
        """
        No edge is shared by more than two triangles.
        """
    @property
    def open_edges(self) -> int: ...
    @property
    def overfull_edges(self) -> int: ...
    @property
    def upper(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Bounding box (3,) [m].
        """
    @property
    def volume(self) -> float:
        """
        Signed [m3]; negative: inside out.
        """

class PlanarFace:
    """
    A planar face of a solid with its own plane coordinates.
    """
    def __repr__(self) -> str: ...
    @property
    def area(self) -> float:
        """
        [m2]
        """
    @property
    def normal(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Outward (3,).
        """
    @property
    def origin(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        A point of the plane (3,) [m].
        """
    @property
    def region(self) -> Region:
        """
        The face in (u, v) about origin.
        """
    @property
    def triangles(self) -> list[int]:
        """
        Indices of the triangles merged.
        """
    @property
    def u(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        In-plane axis (3,); u x v = normal.
        """
    @property
    def v(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        In-plane axis (3,).
        """

class Box:
    """
    A box about the origin.
    """
    def __init__(self, size: typing.Any) -> None:
        """
        Args:
            size: full edge lengths (3,) [m].
        """
    @property
    def size(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Full edge lengths (3,) [m].
        """

class Cylinder:
    """
    A cylinder along z about the origin.
    """
    def __init__(
        self,
        radius: typing.SupportsFloat | typing.SupportsIndex,
        length: typing.SupportsFloat | typing.SupportsIndex,
    ) -> None:
        """
        Args:
            radius: [m].
            length: along z [m].
        """
    @property
    def length(self) -> float:
        """
        [m]
        """
    @property
    def radius(self) -> float:
        """
        [m]
        """

class Sphere:
    """
    A sphere about the origin.
    """
    def __init__(self, radius: typing.SupportsFloat | typing.SupportsIndex) -> None:
        """
        Args:
            radius: [m].
        """
    @property
    def radius(self) -> float:
        """
        [m]
        """

class MeshShape:
    """
    A mesh as a solid or, for fixtures, an open skin.
    """
    def __init__(self, mesh: TriangleMesh, solid: bool = True) -> None:
        """
        Args:
            mesh: copied.
            solid: closed, what is inside collides; False: an open skin.
        """
    @property
    def mesh(self) -> TriangleMesh: ...
    @property
    def solid(self) -> bool: ...

class Shape:
    """
    A geometry at its pose in the body that has it.
    """
    def __init__(
        self, geometry: Box | Cylinder | Sphere | MeshShape, X_BS: typing.Any = None
    ) -> None:
        """
        A shape.

        Args:
            geometry: Box, Cylinder, Sphere or MeshShape.
            X_BS: the shape in its body, 4 x 4; default identity.

        Raises:
            InvalidInput: E_GEOMETRY, E_NUMBER for sizes that are not finite and positive.
        """
    @property
    def X_BS(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        4 x 4
        """
    @property
    def geometry(self) -> Box | Cylinder | Sphere | MeshShape: ...

class LoadedMesh:
    """
    A mesh from a file and what was found out about it.
    """
    @property
    def mesh(self) -> TriangleMesh: ...
    @property
    def surface(self) -> SurfaceReport: ...
    @property
    def warnings(self) -> list[str]:
        """
        What was mended or looks wrong.
        """

class Configuration:
    """
    What is to be driven.

    Args:
        q: arm joints, shape (n,) [rad].
        opening: distance between the pads [m].
    """
    def __init__(self, q: typing.Any, opening: typing.Any = 0.0) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def opening(self) -> float:
        """
        Distance between the pads [m].
        """
    @opening.setter
    def opening(self, arg1: typing.Any) -> None: ...
    @property
    def q(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        Arm joints, shape (n,) [rad]; a copy.
        """
    @q.setter
    def q(self, arg1: typing.Any) -> None: ...

class JointLimit:
    """
    Limits of an arm joint; infinite for a continuous one.
    """
    @property
    def acceleration(self) -> float:
        """
        [rad/s2]
        """
    @property
    def lower(self) -> float:
        """
        [rad]
        """
    @property
    def upper(self) -> float:
        """
        [rad]
        """
    @property
    def velocity(self) -> float:
        """
        [rad/s]
        """

class ArmJoint:
    """
    A revolute joint: child = parent * X_PJ * Rot(axis, q).
    """
    @property
    def X_PJ(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        Joint frame in the parent, (4, 4).
        """
    @property
    def axis(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Unit vector, (3,).
        """
    @property
    def child(self) -> int:
        """
        Index of the body that it moves.
        """
    @property
    def limit(self) -> JointLimit: ...
    @property
    def name(self) -> str: ...
    @property
    def parent(self) -> int:
        """
        Index of the body that carries it.
        """

class RobotBody:
    """
    Links joined by fixed joints: one rigid body.
    """
    @property
    def links(self) -> list[str]: ...
    @property
    def name(self) -> str:
        """
        Of its first link.
        """
    @property
    def shapes(self) -> list[Shape]:
        """
        Collision geometry in the body's frame.
        """

class FingerJoint:
    """
    child = parent * X_PJ * Translate(axis * opening / 2).
    """
    @property
    def X_PJ(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]: ...
    @property
    def axis(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]: ...
    @property
    def child(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def parent(self) -> int: ...
    @property
    def velocity(self) -> float:
        """
        Limit of one finger [m/s].
        """

class Gripper:
    """
    A parallel jaw. Grasp frame H: origin midway between the pads,
    +z out past the finger tips, +y the closing axis.
    """
    @property
    def X_BH(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        H in that body, (4, 4).
        """
    @property
    def acceleration(self) -> float:
        """
        Of one finger [m/s2].
        """
    @property
    def body(self) -> int:
        """
        Index of the body that carries H.
        """
    @property
    def fingers(self) -> tuple[FingerJoint, FingerJoint]: ...
    @property
    def max_opening(self) -> float:
        """
        [m]
        """
    @property
    def min_opening(self) -> float:
        """
        [m]
        """
    @property
    def pad_length(self) -> float:
        """
        Along z of H [m].
        """
    @property
    def pad_width(self) -> float:
        """
        Along x of H [m].
        """

class Robot:
    """
    A robot as URDF and robot file describe it.
    """
    def __repr__(self) -> str: ...
    def with_jaws(self, max_opening: typing.Any, min_opening: typing.Any = None) -> Robot:
        """
        The same robot, whose jaws open or close to other distances; whether its fingers can is not asked.

        Args:
            max_opening: greatest distance between the pads [m].
            min_opening: least distance between the pads [m]; None for that of this robot.
        """
    def with_limit(self, joint: int, lower: typing.Any, upper: typing.Any) -> Robot:
        """
        The same robot with other limits of an arm joint.

        Args:
            joint: its index, from the base.
            lower, upper: of the joint [rad].
        """
    @property
    def bodies(self) -> list[RobotBody]:
        """
        Body 0 is the base; parents come before children.
        """
    @property
    def dof(self) -> int: ...
    @property
    def gripper(self) -> Gripper: ...
    @property
    def home(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) [rad]; a copy.
        """
    @property
    def ignored_pairs(self) -> list[tuple[int, int]]:
        """
        Body indices never checked against each other, from the robot file.
        """
    @property
    def joint_names(self) -> list[str]: ...
    @property
    def joints(self) -> list[ArmJoint]:
        """
        Arm joints, base to flange.
        """
    @property
    def name(self) -> str: ...

class RobotDescription:
    """
    What a URDF does not say: the robot file.

    Args:
        name: of the robot; "" takes the URDF's.
        arm: revolute joints, base to flange.
        home: (n,) [rad].
        acceleration: (n,) [rad/s2]; empty for 5 at every joint.
        gripper_link: the link that carries the grasp frame.
        X_LH: grasp frame in that link, (4, 4).
        fingers: two prismatic joints.
        min_opening, max_opening: between the pads [m].
        pad_width, pad_length: of the flat inner face of a finger [m].
        ignore_collisions: pairs of link names.
        packages: folders by package name, for package:// paths.
    """
    def __init__(
        self,
        *,
        name: str = "",
        arm: collections.abc.Sequence[str],
        home: typing.Any,
        acceleration: typing.Any = [],
        gripper_link: str,
        X_LH: typing.Any = None,
        fingers: typing.Annotated[collections.abc.Sequence[str], "FixedSize(2)"],
        min_opening: typing.Any = 0.0,
        max_opening: typing.Any = 0.1,
        pad_width: typing.Any = 0.02,
        pad_length: typing.Any = 0.03,
        ignore_collisions: collections.abc.Sequence[tuple[str, str]] = [],
        packages: collections.abc.Mapping[str, str] = {},
    ) -> None: ...
    @property
    def X_LH(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]: ...
    @property
    def acceleration(self) -> list[float]:
        """
        [rad/s2]
        """
    @property
    def arm(self) -> list[str]: ...
    @property
    def fingers(self) -> typing.Annotated[list[str], "FixedSize(2)"]: ...
    @property
    def gripper_link(self) -> str: ...
    @property
    def home(self) -> list[float]:
        """
        [rad]
        """
    @property
    def ignore_collisions(self) -> list[tuple[str, str]]: ...
    @property
    def max_opening(self) -> float:
        """
        [m]
        """
    @property
    def min_opening(self) -> float:
        """
        [m]
        """
    @property
    def name(self) -> str: ...
    @property
    def packages(self) -> dict[str, str]: ...
    @property
    def pad_length(self) -> float:
        """
        [m]
        """
    @property
    def pad_width(self) -> float:
        """
        [m]
        """

class LoadedRobot:
    """
    A robot as it was read, with what is odd about its file.
    """
    @property
    def robot(self) -> Robot:
        """
        A copy.
        """
    @property
    def warnings(self) -> list[str]:
        """
        What was taken otherwise than written.
        """

class InverseStatus:
    """
    Members:

      Solved

      InsideShoulderCylinder

      TooFar

      TooClose

      OutsideLimits
    """

    InsideShoulderCylinder: typing.ClassVar[InverseStatus]
    OutsideLimits: typing.ClassVar[InverseStatus]
    Solved: typing.ClassVar[InverseStatus]
    TooClose: typing.ClassVar[InverseStatus]
    TooFar: typing.ClassVar[InverseStatus]
    __members__: typing.ClassVar[dict[str, InverseStatus]]
    @typing.overload
    def __eq__(self, other: InverseStatus) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: InverseStatus) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class SingularityMargin:
    """
    How far from a singularity: 0 at it, at most 1.
    """
    @property
    def elbow(self) -> float: ...
    @property
    def shoulder(self) -> float: ...
    @property
    def wrist(self) -> float: ...

class InverseSolution:
    """
    One configuration that puts the hand where it was asked to be.
    """
    @property
    def branch(self) -> int:
        """
        0..7: shoulder + 2 * elbow + 4 * wrist.
        """
    @property
    def margin(self) -> SingularityMargin: ...
    @property
    def q(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        Arm joints within their limits, (6,) [rad]; a copy.
        """

class InverseResult:
    """
    All solutions, or why there is none.
    """
    @property
    def excess(self) -> float:
        """
        Out of reach [m], or past a limit [rad].
        """
    @property
    def joint(self) -> int:
        """
        Index of the joint past its limit, or -1.
        """
    @property
    def reason(self) -> str:
        """
        For people; empty when solved.
        """
    @property
    def solutions(self) -> list[InverseSolution]:
        """
        Ordered by branch, then wraps ascending.
        """
    @property
    def status(self) -> InverseStatus: ...

class SphericalWristSolver:
    """
    Closed-form inverse kinematics of six-joint arms with parallel
    axes 2 and 3 and a spherical wrist.

    Raises:
        InvalidInput: E_KINEMATICS if the arm is of another kind.
    """
    @staticmethod
    def is_supported(robot: Robot) -> bool: ...
    def __init__(self, robot: Robot) -> None: ...
    def solve(self, X_RH: typing.Any, reference: typing.Any = None) -> InverseResult:
        """
        All configurations that put the grasp frame at X_RH.

        Args:
            X_RH: hand pose in the robot frame, (4, 4).
            reference: (6,) [rad]; gives joint 4 at a wrist singularity and the turn of continuous joints.
        """

class HandPathOptions:
    """
    Options of follow_hand_path.
    """
    def __init__(self, *, largest_jump: typing.Any = 0.15) -> None: ...
    @property
    def largest_jump(self) -> float:
        """
        Most a joint may turn from one pose to the next [rad].
        """
    @largest_jump.setter
    def largest_jump(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class HandPathResult:
    """
    Configurations along a path of hand poses, as far as they go.
    """
    @property
    def complete(self) -> bool: ...
    @property
    def path(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        One configuration per pose, as far as it went, (n, 6) [rad]; a copy.
        """
    @property
    def reason(self) -> str:
        """
        Why it stopped.
        """

class BodyRef:
    """
    A fixture or a part of a cell, by kind and index.
    """
    class Kind:
        """
        Members:

          Fixture

          Part
        """

        Fixture: typing.ClassVar[BodyRef.Kind]
        Part: typing.ClassVar[BodyRef.Kind]
        __members__: typing.ClassVar[dict[str, BodyRef.Kind]]
        @typing.overload
        def __eq__(self, other: BodyRef.Kind) -> bool: ...
        @typing.overload
        def __eq__(self, other: typing.Any) -> bool: ...
        def __getstate__(self) -> int: ...
        def __hash__(self) -> int: ...
        def __index__(self) -> int: ...
        def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
        def __int__(self) -> int: ...
        @typing.overload
        def __ne__(self, other: BodyRef.Kind) -> bool: ...
        @typing.overload
        def __ne__(self, other: typing.Any) -> bool: ...
        def __repr__(self) -> str: ...
        def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
        def __str__(self) -> str: ...
        @property
        def name(self) -> str: ...
        @property
        def value(self) -> int: ...

    def __eq__(self, arg0: typing.Any) -> bool: ...
    def __hash__(self) -> int: ...
    def __init__(
        self, kind: BodyRef.Kind, index: typing.SupportsInt | typing.SupportsIndex
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def index(self) -> int: ...
    @property
    def kind(self) -> BodyRef.Kind: ...

class HeldPart:
    """
    What is in the hand.

    Args:
        part: index in Cell.parts.
        X_HP: the part in the grasp frame, (4, 4).
    """
    def __init__(
        self, *, part: typing.SupportsInt | typing.SupportsIndex, X_HP: typing.Any = None
    ) -> None: ...
    @property
    def X_HP(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4)
        """
    @property
    def part(self) -> int: ...

class Body:
    """
    A fixture or a part: shapes in one rigid body.

    Args:
        name: unique in its cell.
        shapes: list of Shape.
        X_WB: pose in the world, (4, 4); identity by default.
        support: parts may be put down on its upward faces between regrasps.
        friction: with the pads (parts).
        mass: [kg], or None.
        density: [kg/m3], or None.
        may_move: may be moved although no goal names it (parts).
    """
    def __init__(
        self,
        *,
        name: str,
        shapes: collections.abc.Sequence[Shape],
        X_WB: typing.Any = None,
        support: bool = False,
        friction: typing.Any = 0.4,
        mass: typing.Any = None,
        density: typing.Any = None,
        may_move: bool = False,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def X_WB(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        In the world, (4, 4).
        """
    @property
    def density(self) -> float | None:
        """
        [kg/m3] or None.
        """
    @property
    def friction(self) -> float: ...
    @property
    def mass(self) -> float | None:
        """
        [kg] or None.
        """
    @property
    def may_move(self) -> bool: ...
    @property
    def name(self) -> str: ...
    @property
    def shapes(self) -> list[Shape]: ...
    @property
    def support(self) -> bool: ...

class Cell:
    """
    Robot, fixtures, parts, and which part is in the hand. A value: an edit returns a new cell.

    Args:
        robot: Robot.
        start: Configuration of the robot at the start.
        name: of the cell.
        fixtures: list of Body; they never move.
        parts: list of Body that can be picked up; their meshes must be closed.
        X_WR: the URDF's root link in the world, (4, 4); identity by default.
        held: HeldPart or None.

    Raises:
        InvalidInput: with every body, pose or number that is wrong.
    """
    def __init__(
        self,
        *,
        name: str = "cell",
        robot: Robot,
        start: Configuration,
        fixtures: collections.abc.Sequence[Body] = [],
        parts: collections.abc.Sequence[Body] = [],
        X_WR: typing.Any = None,
        held: HeldPart | None = None,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def body(self, ref: BodyRef) -> Body: ...
    def part_index(self, name: str) -> int:
        """
        Index of the part of this name. Raises InvalidInput with the legal names.
        """
    def with_held(self, part: typing.SupportsInt | typing.SupportsIndex, X_HP: typing.Any) -> Cell:
        """
        The same cell with the part in the hand.
        """
    def with_part_at(
        self, part: typing.SupportsInt | typing.SupportsIndex, X_WP: typing.Any
    ) -> Cell:
        """
        The same cell with a part at another pose.
        """
    def with_released(self, X_WP: typing.Any) -> Cell:
        """
        The held part stands at X_WP, nothing is held.
        """
    @property
    def X_WR(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4)
        """
    @property
    def fixtures(self) -> list[Body]:
        """
        List of Body; a copy.
        """
    @property
    def held(self) -> HeldPart | None:
        """
        HeldPart or None.
        """
    @property
    def name(self) -> str: ...
    @property
    def parts(self) -> list[Body]:
        """
        List of Body; a held part's X_WB is not used. A copy.
        """
    @property
    def robot(self) -> Robot: ...
    @property
    def start(self) -> Configuration: ...

class HeightMap:
    """
    Heights over a plane: an obstacle known by measurement.

    Args:
        heights: (rows, columns) [m], rows along +y, columns along +x; each stands for a square column
            about it, solid from z = 0 up to the height. NaN: not measured, as high as the highest.
        cell: side of a column [m].
        X_WD: the map in the world, (4, 4); identity by default.
    """
    def __init__(
        self, heights: typing.Any, *, cell: typing.Any, X_WD: typing.Any = None
    ) -> None: ...
    @property
    def X_WD(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4)
        """
    @property
    def cell(self) -> float:
        """
        [m]
        """
    @property
    def heights(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (rows, columns) [m]; a copy.
        """

class DepthImage:
    """
    What a depth camera saw: an obstacle known by measurement.

    Args:
        depths: (rows, columns), times `scale` the depth along the optical axis [m]; 0 or NaN: not
            measured, as near as the nearest measured pixel on the border of its hole.
        fx, fy, cx, cy: pixel (row v, column u) looks along ((u - cx) / fx, (v - cy) / fy, 1).
        scale: metres per unit of the depths.
        X_WD: the camera in the world, (4, 4): z forward, x right, y down; identity by default.
        explained: a pixel this near to a known surface belongs to it [m].
        far: space is solid this far behind a pixel, over its whole cone [m].
    """
    def __init__(
        self,
        depths: typing.Any,
        *,
        fx: typing.Any,
        fy: typing.Any,
        cx: typing.Any,
        cy: typing.Any,
        scale: typing.Any = 1.0,
        X_WD: typing.Any = None,
        explained: typing.Any = 0.005,
        far: typing.Any = 0.3,
    ) -> None: ...
    @property
    def X_WD(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4)
        """
    @property
    def cx(self) -> float: ...
    @property
    def cy(self) -> float: ...
    @property
    def depths(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        (rows, columns) [m]; a copy.
        """
    @property
    def explained(self) -> float:
        """
        [m]
        """
    @property
    def far(self) -> float:
        """
        [m]
        """
    @property
    def fx(self) -> float: ...
    @property
    def fy(self) -> float: ...

class DepthMapOptions:
    """
    How closely solids follow what was measured.

    Args:
        excess: they may stand out by this much near the places [m].
        growth: and this much more per metre of distance from them.
        most_excess: but no more than this far from them [m].
        most_solids: beyond this number the tolerance gives way.
        places: list of Body: where parts stand, now or in the end.
        exact_within: this near to the places nothing stands out [m].
        reach_centre: (3,) in the world.
        reach: nothing beyond the ball of this radius is kept; None: all is [m].
    """
    def __init__(
        self,
        *,
        excess: typing.SupportsFloat | typing.SupportsIndex = 0.003,
        growth: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        most_excess: typing.SupportsFloat | typing.SupportsIndex = 0.03,
        most_solids: typing.SupportsInt | typing.SupportsIndex = 160,
        places: collections.abc.Sequence[Body] = [],
        exact_within: typing.SupportsFloat | typing.SupportsIndex = 0.002,
        reach_centre: typing.Any = None,
        reach: typing.Any = None,
    ) -> None: ...
    @property
    def exact_within(self) -> float: ...
    @exact_within.setter
    def exact_within(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def excess(self) -> float: ...
    @excess.setter
    def excess(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def growth(self) -> float: ...
    @growth.setter
    def growth(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def most_excess(self) -> float: ...
    @most_excess.setter
    def most_excess(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def most_solids(self) -> int: ...
    @most_solids.setter
    def most_solids(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def places(self) -> list[Body]: ...
    @places.setter
    def places(self, arg0: collections.abc.Sequence[Body]) -> None: ...
    @property
    def reach(self) -> float | None: ...
    @reach.setter
    def reach(self, arg0: typing.SupportsFloat | typing.SupportsIndex | None) -> None: ...
    @property
    def reach_centre(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]: ...
    @reach_centre.setter
    def reach_centre(
        self, arg0: typing.Annotated[numpy.typing.ArrayLike, numpy.float64, "[3, 1]"]
    ) -> None: ...

class MeasuredBody:
    """
    A depth map as a fixture.
    """
    @property
    def body(self) -> Body:
        """
        Body; without shapes if there is nothing solid within reach.
        """
    @property
    def exact_at_places(self) -> bool:
        """
        False if that would have taken too many solids.
        """
    @property
    def excess(self) -> float:
        """
        No point of a solid is farther than this from what was measured [m].
        """

class ReachBall:
    """
    A ball that holds all that the arm can come to.
    """
    @property
    def centre(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        (3,) in the world [m]
        """
    @property
    def radius(self) -> float:
        """
        [m]
        """

class CollisionModel:
    """
    Collision geometry of a cell's robot, fixtures and parts. Immutable; shared by checkers.
    """

class Allowance:
    """
    Contacts that are part of the work.

    Args:
        closed_on: index of the part that the fingers close on without it being held yet, or None.
        held_touches: list of BodyRef that the held part may touch where it stands.
    """
    def __init__(
        self,
        *,
        closed_on: typing.SupportsInt | typing.SupportsIndex | None = None,
        held_touches: collections.abc.Sequence[BodyRef] = [],
    ) -> None: ...
    @property
    def closed_on(self) -> int | None: ...
    @closed_on.setter
    def closed_on(self, arg0: typing.SupportsInt | typing.SupportsIndex | None) -> None: ...
    @property
    def held_touches(self) -> list[BodyRef]: ...
    @held_touches.setter
    def held_touches(self, arg0: collections.abc.Sequence[BodyRef]) -> None: ...

class Hit:
    """
    The pair that is in the way; distance [m] is 0 or less where they overlap.
    """
    def __repr__(self) -> str: ...
    @property
    def a(self) -> str: ...
    @property
    def b(self) -> str: ...
    @property
    def distance(self) -> float: ...

class ClearancePath:
    """
    The way of greatest clearance to a target; true if there is one.
    """
    def __bool__(self) -> bool: ...
    @property
    def clearance(self) -> float:
        """
        The least on the way, but for its last three cells [m].
        """
    @property
    def points(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]:
        """
        (n, 2) from the border to the target [m].
        """
    @property
    def whole_hand(self) -> bool:
        """
        False: found for the finger tips alone.
        """

class CollisionChecker:
    """
    Is the robot free of the cell and of itself?

    One worker: not to be shared between threads.

    Args:
        model: of the same robot, fixtures and parts.
        cell: where the parts are and what is held now.
        allowance: contacts that are part of the work.
    """
    def __init__(self, model: CollisionModel, cell: Cell, allowance: Allowance = ...) -> None: ...
    def closest(
        self,
        configuration: Configuration,
        horizon: typing.SupportsFloat | typing.SupportsIndex = 0.1,
    ) -> Hit:
        """
        The closest checked pair within the horizon [m]; names are empty if there is none.
        """
    def find_hit(
        self,
        configuration: Configuration,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.0001,
    ) -> Hit | None:
        """
        The first pair found not farther apart than clearance [m], or None.
        """
    def is_free(
        self,
        configuration: Configuration,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.0001,
    ) -> bool: ...
    @property
    def cell(self) -> Cell: ...

class CertificateOptions:
    """
    Options of certify_edge.
    """
    def __init__(
        self,
        *,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.0001,
        resolution: typing.SupportsFloat | typing.SupportsIndex = 0.0002,
    ) -> None: ...
    @property
    def clearance(self) -> float:
        """
        Least distance proved along the edge [m].
        """
    @clearance.setter
    def clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def resolution(self) -> float:
        """
        A stretch that moves no point farther and is not proved is given up [m].
        """
    @resolution.setter
    def resolution(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class EdgeStatus:
    """
    Members:

      Free

      Colliding

      GivenUp
    """

    Colliding: typing.ClassVar[EdgeStatus]
    Free: typing.ClassVar[EdgeStatus]
    GivenUp: typing.ClassVar[EdgeStatus]
    __members__: typing.ClassVar[dict[str, EdgeStatus]]
    @typing.overload
    def __eq__(self, other: EdgeStatus) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: EdgeStatus) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class EdgeResult:
    """
    Whether an edge is proved free, and what is in the way.
    """
    @property
    def at(self) -> float:
        """
        Where along the edge, 0 to 1; on a path it counts edges.
        """
    @property
    def evaluations(self) -> int:
        """
        Configurations looked at.
        """
    @property
    def hit(self) -> Hit:
        """
        The pair in the way, unless free.
        """
    @property
    def is_free(self) -> bool: ...
    @property
    def status(self) -> EdgeStatus: ...

class Overlap:
    """
    Two resting bodies that overlap.
    """
    @property
    def a(self) -> BodyRef: ...
    @property
    def b(self) -> BodyRef: ...
    @property
    def depth(self) -> float:
        """
        How far one must be moved to part them, at least [m].
        """
    @property
    def name_a(self) -> str: ...
    @property
    def name_b(self) -> str: ...

class PlanarPose:
    """
    Position and direction of the hand in the grasp plane.

    Args:
        x, y: finger grasp point in G [m].
        theta: direction of the hand's approach axis, from x of G [rad].
    """
    def __init__(
        self, x: typing.Any = 0.0, y: typing.Any = 0.0, theta: typing.Any = 0.0
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def theta(self) -> float:
        """
        [rad]
        """
    @property
    def x(self) -> float:
        """
        [m]
        """
    @property
    def y(self) -> float:
        """
        [m]
        """

class FeatureKind:
    """
    What a pad rests on.

    Members:

      Face

      Edge

      Vertex
    """

    Edge: typing.ClassVar[FeatureKind]
    Face: typing.ClassVar[FeatureKind]
    Vertex: typing.ClassVar[FeatureKind]
    __members__: typing.ClassVar[dict[str, FeatureKind]]
    @typing.overload
    def __eq__(self, other: FeatureKind) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: FeatureKind) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Feature:
    """
    One of a part's features.
    """
    def __str__(self) -> str: ...
    @property
    def index(self) -> int:
        """
        Into FeaturePairs.faces, edges or vertices.
        """
    @property
    def kind(self) -> FeatureKind: ...

class PairKind:
    """
    How jaws can hold two features, best first.

    Members:

      FaceFace

      FaceEdge

      ParallelEdges

      FaceVertex

      CrossedEdges
    """

    CrossedEdges: typing.ClassVar[PairKind]
    FaceEdge: typing.ClassVar[PairKind]
    FaceFace: typing.ClassVar[PairKind]
    FaceVertex: typing.ClassVar[PairKind]
    ParallelEdges: typing.ClassVar[PairKind]
    __members__: typing.ClassVar[dict[str, PairKind]]
    @typing.overload
    def __eq__(self, other: PairKind) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: PairKind) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class PartEdge:
    """
    A convex edge, straight.
    """
    @property
    def ends(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        In the part, (2, 3) [m].
        """
    @property
    def face_a(self) -> bool:
        """
        The first of them can be held itself.
        """
    @property
    def face_b(self) -> bool:
        """
        The second of them can be held itself.
        """
    @property
    def normals(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        Outward, of the faces that meet in it, (2, 3).
        """

class PartVertex:
    """
    A convex corner.
    """
    @property
    def position(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        In the part, (3,) [m].
        """
    @property
    def rays(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        Unit vectors along the edges that leave it, (n, 3).
        """

class FeaturePair:
    """
    Two features that the jaws can hold.
    """
    def __str__(self) -> str: ...
    def width_at(self, point: typing.Any) -> float:
        """
        Distance between the features at a point (2,) of G [m].
        """
    @property
    def X_PG(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        Grasp plane in the part, (4, 4): midway between the features, z the closing axis.
        """
    @property
    def a(self) -> Feature:
        """
        Feature; a face comes before an edge or a vertex.
        """
    @property
    def area(self) -> float:
        """
        Of the overlap [m2].
        """
    @property
    def b(self) -> Feature:
        """
        Feature.
        """
    @property
    def contact_a(self) -> Region:
        """
        What the pad on a touches, in (x, y) of G; empty for two faces.
        """
    @property
    def contact_b(self) -> Region:
        """
        What the pad on b touches, in (x, y) of G; empty for two faces.
        """
    @property
    def kind(self) -> PairKind:
        """
        PairKind.
        """
    @property
    def overlap(self) -> Region:
        """
        Common area of two faces, else the strip or square that stands for an edge or a vertex, in (x, y) of G [m].
        """
    @property
    def strip(self) -> float:
        """
        Width of the strip; 0 for two faces [m].
        """
    @property
    def taper(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        How the width grows with x and y of G, (2,) [m/m].
        """
    @property
    def width(self) -> float:
        """
        Distance between the features at the origin of G [m].
        """

class Rejection:
    """
    Why the jaws cannot take a pair.

    Members:

      TooWide

      TooThin

      LittleOverlap
    """

    LittleOverlap: typing.ClassVar[Rejection]
    TooThin: typing.ClassVar[Rejection]
    TooWide: typing.ClassVar[Rejection]
    __members__: typing.ClassVar[dict[str, Rejection]]
    @typing.overload
    def __eq__(self, other: Rejection) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: Rejection) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class RejectedPair:
    """
    A pair that the jaws cannot take, and why.
    """
    def __str__(self) -> str: ...
    @property
    def a(self) -> Feature:
        """
        Feature.
        """
    @property
    def b(self) -> Feature:
        """
        Feature.
        """
    @property
    def by(self) -> float:
        """
        How much is lacking [m]; of an overlap [m2].
        """
    @property
    def kind(self) -> Rejection: ...
    @property
    def reason(self) -> str:
        """
        For people, with numbers.
        """
    @property
    def width(self) -> float:
        """
        [m]
        """

class FeatureOptions:
    """
    Options of find_feature_pairs.
    """
    def __init__(
        self,
        *,
        angle: typing.SupportsFloat | typing.SupportsIndex = 0.0087,
        least_face_area: typing.SupportsFloat | typing.SupportsIndex = 2.5e-05,
        least_overlap: typing.SupportsFloat | typing.SupportsIndex = 2.5e-05,
        jaw_clearance: typing.SupportsFloat | typing.SupportsIndex = 0.002,
        beyond_faces: bool = True,
        least_edge: typing.SupportsFloat | typing.SupportsIndex = 0.002,
        sharp_edge: typing.SupportsFloat | typing.SupportsIndex = 0.035,
        friction_use: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        most_edges: typing.SupportsInt | typing.SupportsIndex = 512,
        most_beyond_faces: typing.SupportsInt | typing.SupportsIndex = 48,
    ) -> None: ...
    @property
    def angle(self) -> float:
        """
        Most the normals leave antiparallel [rad].
        """
    @angle.setter
    def angle(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def beyond_faces(self) -> bool:
        """
        Look for pairs with edges and vertices too.
        """
    @beyond_faces.setter
    def beyond_faces(self, arg0: bool) -> None: ...
    @property
    def friction_use(self) -> float:
        """
        Share of the friction angle that the line between the contacts of two edges may lean from the closing axis.
        """
    @friction_use.setter
    def friction_use(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def jaw_clearance(self) -> float:
        """
        The jaws open at least this much wider than the part, each side [m].
        """
    @jaw_clearance.setter
    def jaw_clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def least_edge(self) -> float:
        """
        Shorter edges are left out [m].
        """
    @least_edge.setter
    def least_edge(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def least_face_area(self) -> float:
        """
        [m2]
        """
    @least_face_area.setter
    def least_face_area(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def least_overlap(self) -> float:
        """
        Of two faces [m2].
        """
    @least_overlap.setter
    def least_overlap(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def most_beyond_faces(self) -> int:
        """
        Pairs with edges or vertices that are kept, the best.
        """
    @most_beyond_faces.setter
    def most_beyond_faces(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def most_edges(self) -> int:
        """
        The longest are paired with each other.
        """
    @most_edges.setter
    def most_edges(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def sharp_edge(self) -> float:
        """
        Edges between faces at a smaller angle are left out [rad].
        """
    @sharp_edge.setter
    def sharp_edge(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class FeaturePairs:
    """
    A part's features and the pairs of them.
    """
    @property
    def beyond_faces(self) -> int:
        """
        Pairs with edges or vertices that the jaws can span, kept or not.
        """
    @property
    def edges(self) -> list[PartEdge]:
        """
        PartEdge, longest first.
        """
    @property
    def faces(self) -> list[PlanarFace]:
        """
        PlanarFace of all shapes, in the part frame.
        """
    @property
    def pairs(self) -> list[FeaturePair]:
        """
        FeaturePair: two faces, largest overlap first; then the others.
        """
    @property
    def rejected(self) -> list[RejectedPair]:
        """
        RejectedPair.
        """
    @property
    def vertices(self) -> list[PartVertex]:
        """
        PartVertex.
        """

class NearbyBody:
    """
    A body seen from the part.
    """
    @property
    def X_PB(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        The body in the part frame, (4, 4).
        """
    @property
    def at_destination(self) -> bool:
        """
        Moved by the inverse of T.
        """
    @property
    def body(self) -> BodyRef:
        """
        BodyRef.
        """
    @property
    def name(self) -> str: ...

class PairChoice:
    """
    Which feature pairs are ranked.

    Members:

      All

      TwoFaces

      BeyondFaces
    """

    All: typing.ClassVar[PairChoice]
    BeyondFaces: typing.ClassVar[PairChoice]
    TwoFaces: typing.ClassVar[PairChoice]
    __members__: typing.ClassVar[dict[str, PairChoice]]
    @typing.overload
    def __eq__(self, other: PairChoice) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: PairChoice) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class RankingOptions:
    """
    Options of rank_grasps.
    """

    features: FeatureOptions
    def __init__(
        self,
        *,
        features: FeatureOptions = ...,
        finger_clearance: typing.SupportsFloat | typing.SupportsIndex = 0.002,
        open_clearance: typing.SupportsFloat | typing.SupportsIndex = 0.008,
        use_destination: bool = True,
        least_share: typing.SupportsFloat | typing.SupportsIndex = 0.02,
        most_targets: typing.SupportsInt | typing.SupportsIndex = 5,
        pairs: PairChoice = ...,
    ) -> None: ...
    @property
    def finger_clearance(self) -> float:
        """
        Obstacles this near the finger's layer obstruct it [m].
        """
    @finger_clearance.setter
    def finger_clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def least_share(self) -> float:
        """
        Pairs with less unobstructed are dropped.
        """
    @least_share.setter
    def least_share(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def most_targets(self) -> int: ...
    @most_targets.setter
    def most_targets(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def open_clearance(self) -> float:
        """
        The open pads stand this far from the faces [m].
        """
    @open_clearance.setter
    def open_clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def pairs(self) -> PairChoice:
        """
        PairChoice: which pairs are ranked.
        """
    @pairs.setter
    def pairs(self, arg0: PairChoice) -> None: ...
    @property
    def use_destination(self) -> bool:
        """
        False: look at the origin only.
        """
    @use_destination.setter
    def use_destination(self, arg0: bool) -> None: ...

class RankedPair:
    """
    A feature pair and what of it stays unobstructed.
    """
    @property
    def blocked(self) -> Region:
        """
        What obstructs the fingers' layers on and around the overlap, Region.
        """
    @property
    def centre_of_mass(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        Of the part, in (x, y) of G, (2,) [m].
        """
    @property
    def contact_a(self) -> Region:
        """
        FeaturePair's, unobstructed.
        """
    @property
    def contact_b(self) -> Region:
        """
        FeaturePair's, unobstructed.
        """
    @property
    def obstructing(self) -> list[str]:
        """
        Names of what obstructs.
        """
    @property
    def obstructing_at_destination(self) -> list[str]:
        """
        Names of bodies that do there.
        """
    @property
    def obstructing_at_origin(self) -> list[str]:
        """
        Names of bodies that do there.
        """
    @property
    def pair(self) -> FeaturePair:
        """
        FeaturePair.
        """
    @property
    def score(self) -> float:
        """
        share * min(1, unobstructed area / area of a pad) for two faces; others a tenth of that or less.
        """
    @property
    def share(self) -> float:
        """
        Unobstructed / overlap area.
        """
    @property
    def share_at_origin(self) -> float: ...
    @property
    def targets(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]:
        """
        Fingertip targets in G, best first, (n, 2) [m].
        """
    @property
    def unobstructed(self) -> Region:
        """
        Region in (x, y) of G.
        """

class Ranking:
    """
    A part's feature pairs in the order to try them.
    """
    @property
    def beyond_faces(self) -> int:
        """
        Pairs with edges or vertices, ranked or not.
        """
    @property
    def edges(self) -> int:
        """
        How many edges, if asked for.
        """
    @property
    def faces(self) -> int:
        """
        How many faces the part has.
        """
    @property
    def obstructed(self) -> list[RankedPair]:
        """
        Dropped for want of unobstructed area.
        """
    @property
    def ranked(self) -> list[RankedPair]:
        """
        RankedPair, best first.
        """
    @property
    def rejected(self) -> list[RejectedPair]:
        """
        RejectedPair.
        """
    @property
    def vertices(self) -> int:
        """
        How many vertices, if asked for.
        """

class GraspScene:
    """
    A pick-and-place to plan.

    Args:
        model: CollisionModel of the cell.
        cell: Cell with the part at its origin and an empty hand.
        part: index in cell.parts.
        X_WP_goal: the part at its destination, (4, 4).
    """
    def __init__(
        self,
        *,
        model: CollisionModel,
        cell: Cell,
        part: typing.SupportsInt | typing.SupportsIndex,
        X_WP_goal: typing.Any,
    ) -> None: ...
    @property
    def X_WP_goal(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4)
        """
    @property
    def cell(self) -> Cell: ...
    @property
    def part(self) -> int: ...

class LegalityOptions:
    """
    Options of find_legal_grasps.
    """
    def __init__(
        self,
        *,
        directions: typing.SupportsInt | typing.SupportsIndex = 24,
        spacing: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        open_clearance: typing.SupportsFloat | typing.SupportsIndex = 0.008,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.0003,
        least_contact_share: typing.SupportsFloat | typing.SupportsIndex = 0.3,
        grip_force: typing.SupportsFloat | typing.SupportsIndex = 70.0,
        grip_ratio: typing.SupportsFloat | typing.SupportsIndex = 20.0,
        most_poses: typing.SupportsInt | typing.SupportsIndex = 16,
        spread: bool = False,
    ) -> None: ...
    @property
    def clearance(self) -> float:
        """
        Of the whole robot [m].
        """
    @clearance.setter
    def clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def directions(self) -> int:
        """
        Approach directions per target; those along edges come on top.
        """
    @directions.setter
    def directions(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def grip_force(self) -> float:
        """
        Of the jaws, for parts whose mass or density is known [N].
        """
    @grip_force.setter
    def grip_force(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def grip_ratio(self) -> float:
        """
        Friction of both pads over the part's weight where its mass is not known.
        """
    @grip_ratio.setter
    def grip_ratio(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def least_contact_share(self) -> float:
        """
        Of the pad on the unobstructed features.
        """
    @least_contact_share.setter
    def least_contact_share(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def most_poses(self) -> int:
        """
        Returned per pair.
        """
    @most_poses.setter
    def most_poses(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def open_clearance(self) -> float:
        """
        The open pads stand this far from the faces, where there is room [m].
        """
    @open_clearance.setter
    def open_clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def spacing(self) -> float:
        """
        Of a lattice of points tried beside the targets; 0: none [m].
        """
    @spacing.setter
    def spacing(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def spread(self) -> bool:
        """
        Candidates in an order spread over all of them, not the best first.
        """
    @spread.setter
    def spread(self, arg0: bool) -> None: ...

class GraspPose:
    """
    A grasp with all configurations that are legal for it.
    """
    @property
    def X_PH(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        Grasp frame in the part, (4, 4).
        """
    @property
    def contact_area(self) -> float:
        """
        Of a pad [m2].
        """
    @property
    def flipped(self) -> bool:
        """
        The hand is turned half round.
        """
    @property
    def in_plane(self) -> PlanarPose:
        """
        PlanarPose.
        """
    @property
    def merit(self) -> float:
        """
        Larger is better, 0..1.
        """
    @property
    def opening(self) -> float:
        """
        Opening while approaching [m].
        """
    @property
    def q_pick(self) -> list[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]]:
        """
        Legal at the origin: list of (dof,) [rad].
        """
    @property
    def q_place(self) -> list[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]]:
        """
        Legal at the destination.
        """
    @property
    def width(self) -> float:
        """
        Opening when closed on the part [m].
        """

class FallKind:
    """
    The test at which hand poses fell.

    Members:

      LittleContact

      Slips

      Turns

      OutOfReach

      JointLimit

      Collision
    """

    Collision: typing.ClassVar[FallKind]
    JointLimit: typing.ClassVar[FallKind]
    LittleContact: typing.ClassVar[FallKind]
    OutOfReach: typing.ClassVar[FallKind]
    Slips: typing.ClassVar[FallKind]
    TooWide: typing.ClassVar[FallKind]
    Turns: typing.ClassVar[FallKind]
    __members__: typing.ClassVar[dict[str, FallKind]]
    @typing.overload
    def __eq__(self, other: FallKind) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: FallKind) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class GraspEnd:
    """
    Where the part stands meanwhile.

    Members:

      Both

      Origin

      Destination
    """

    Both: typing.ClassVar[GraspEnd]
    Destination: typing.ClassVar[GraspEnd]
    Origin: typing.ClassVar[GraspEnd]
    __members__: typing.ClassVar[dict[str, GraspEnd]]
    @typing.overload
    def __eq__(self, other: GraspEnd) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: GraspEnd) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class Fallen:
    """
    Hand poses that fell alike, with the nearest of them.
    """
    @property
    def X_PH(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        Grasp frame of the nearest in the part, (4, 4).
        """
    @property
    def body(self) -> str:
        """
        That it met.
        """
    @property
    def count(self) -> int: ...
    @property
    def end(self) -> GraspEnd: ...
    @property
    def joint(self) -> int:
        """
        Index of the joint past its limit; -1: none.
        """
    @property
    def kind(self) -> FallKind: ...
    @property
    def least(self) -> float | None:
        """
        By which the nearest missed [m], of a joint [rad]; None: not known.
        """
    @property
    def mover(self) -> str:
        """
        Of a collision: link of the robot, or 'hand'.
        """
    @property
    def opening(self) -> float:
        """
        As that hand comes [m]; 0: not looked at.
        """
    @property
    def text(self) -> str:
        """
        Of the nearest, without its end.
        """
    @property
    def width(self) -> float:
        """
        Of that hand, closed on the part [m].
        """

class LegalGrasps:
    """
    Legal grasps of a pair, and why others are not.
    """
    @property
    def collides_at_destination(self) -> int: ...
    @property
    def collides_at_origin(self) -> int: ...
    @property
    def fallen(self) -> list[Fallen]:
        """
        Fallen, most frequent first.
        """
    @property
    def poses(self) -> list[GraspPose]:
        """
        GraspPose, best merit first.
        """
    @property
    def too_little_contact(self) -> int: ...
    @property
    def tried(self) -> int:
        """
        Candidates looked at.
        """
    @property
    def unreachable_at_destination(self) -> int: ...
    @property
    def unreachable_at_origin(self) -> int: ...
    @property
    def worst_reason(self) -> str:
        """
        The reason met most often.
        """
    @property
    def would_turn(self) -> int:
        """
        Where the part's weight would turn it in the jaws.
        """

class PoseBlock:
    """
    What blocks hand poses.
    """
    @property
    def body(self) -> str:
        """
        That it is in.
        """
    @property
    def end(self) -> GraspEnd:
        """
        GraspEnd.
        """
    @property
    def mover(self) -> str:
        """
        Body of the hand.
        """

class BlockedPoses:
    """
    Hand poses that are certainly illegal, for the searches of one scene.

    Not to be used by several threads at once.

    Args:
        scene: GraspScene.

    Raises:
        InvalidInput: for a scene with a part in the hand.
    """
    def __init__(self, scene: GraspScene) -> None: ...
    def find(
        self,
        pair: RankedPair,
        middle: PlanarPose,
        flipped: bool,
        *,
        shift: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        half_turn: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> PoseBlock | None:
        """
        What blocks all hand poses about one.

        Args:
            pair: RankedPair.
            middle: PlanarPose.
            flipped: the hand is turned half round.
            shift: that the poses are from the middle at most [m].
            half_turn: that they are turned at most [rad].

        Returns:
            PoseBlock, or None where that is not proved.

        Raises:
            InvalidInput: E_RANGE, E_NUMBER.
        """

class LegalGraspSearch:
    """
    find_legal_grasps in portions, for pairs looked at by turns.

    Args:
        scene: GraspScene.
        solver: SphericalWristSolver of the scene's robot.
        pair: RankedPair.
        options: LegalityOptions.
        blocked: BlockedPoses of the scene: what it proves to be illegal is not looked at further.

    Raises:
        InvalidInput: as find_legal_grasps.
    """
    def __init__(
        self,
        scene: GraspScene,
        solver: SphericalWristSolver,
        pair: RankedPair,
        options: LegalityOptions = ...,
        blocked: BlockedPoses | None = None,
    ) -> None: ...
    def next(self, candidates: typing.SupportsInt | typing.SupportsIndex) -> list[GraspPose]:
        """
        Look at so many candidates more, at most, each with both half-turns of the hand.

        Args:
            candidates: at least 1.

        Returns:
            The GraspPoses of these that are legal, best merit first.
        """
    def result(self) -> LegalGrasps:
        """
        LegalGrasps of all candidates so far.
        """
    @property
    def is_done(self) -> bool:
        """
        No candidate is left, or enough are legal.
        """

class GraspObstacle:
    """
    Something that stands in the way of hand poses.
    """
    @property
    def X_PH(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        Grasp frame in the part for which it is so, (4, 4).
        """
    @property
    def alone(self) -> int:
        """
        Of these those that are legal without it.
        """
    @property
    def body(self) -> str:
        """
        Of a collision: what was met.
        """
    @property
    def carries(self) -> bool:
        """
        The part stands on the body at that end.
        """
    @property
    def end(self) -> GraspEnd:
        """
        GraspEnd.
        """
    @property
    def in_fewest(self) -> int:
        """
        Hand poses of fewest obstacles that have it among them.
        """
    @property
    def joint(self) -> int:
        """
        Index of the joint past its limit; -1: none.
        """
    @property
    def kind(self) -> FallKind:
        """
        FallKind.
        """
    @property
    def least(self) -> float:
        """
        By how much it is in the way at least [m], of a joint [rad]; -1: not known.
        """
    @property
    def met(self) -> int:
        """
        Hand poses in whose way it is.
        """
    @property
    def mover(self) -> str:
        """
        Link that met it first, or 'hand'.
        """
    @property
    def opening(self) -> float:
        """
        As that hand comes [m].
        """
    @property
    def width(self) -> float:
        """
        Of that hand, closed on the part [m].
        """

class Diagnosis:
    """
    What keeps hand poses from being legal at both ends.
    """
    @property
    def fewest(self) -> int:
        """
        Obstacles of the hand poses that have fewest.
        """
    @property
    def free_at_destination(self) -> int:
        """
        Hand poses legal there.
        """
    @property
    def free_at_origin(self) -> int:
        """
        Hand poses legal there.
        """
    @property
    def legal(self) -> int:
        """
        Hand poses, at both ends.
        """
    @property
    def looked_at(self) -> int:
        """
        Hand poses that fit the part itself.
        """
    @property
    def misfits(self) -> int:
        """
        Hand poses at which the hand meets the part.
        """
    @property
    def obstacles(self) -> list[GraspObstacle]:
        """
        GraspObstacle, those first that alone are in the way of most.
        """

class PartGrasps:
    """
    Grasps of a part, wherever it stands.

    Args:
        rows: as the property, (n, 10).
        X_PH: as the property, (n, 4, 4).
    """
    def __init__(self, *, rows: typing.Any, X_PH: typing.Any) -> None: ...
    def __len__(self) -> int: ...
    @property
    def X_PH(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Grasp frames in the part, (n, 4, 4).
        """
    @property
    def rows(self) -> numpy.typing.NDArray[numpy.float64]:
        """
        Kind and index of the features a and b, x, y [m], theta [rad] in the grasp plane, flipped (0 or 1), width [m], merit (0..0.7): (n, 10).
        """

class CompatibleGrasp:
    """
    A grasp that is legal at a place.
    """
    @property
    def grasp(self) -> int:
        """
        Index.
        """
    @property
    def margin(self) -> float:
        """
        From joint limits and singularities, best configuration, 0..1.
        """
    @property
    def opening(self) -> float:
        """
        The widest of those tried at which it is legal [m].
        """
    @property
    def q(self) -> list[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]]:
        """
        Legal configurations, best margin first: list of (dof,) [rad].
        """

class CompatibleGrasps:
    """
    The grasps that are legal at a place.
    """
    @property
    def collides(self) -> int: ...
    @property
    def legal(self) -> list[CompatibleGrasp]:
        """
        CompatibleGrasp, by index.
        """
    @property
    def tried(self) -> int: ...
    @property
    def unreachable(self) -> int: ...
    @property
    def worst_reason(self) -> str:
        """
        What was met most often: 'hand hits table: 14 of 48'; empty if nothing.
        """

class MotionGrid:
    """
    Filled cells of the grasp plane, one layer a gripper piece.

    A cell that an obstacle touches is filled; outside the grid all is free.

    Args:
        centre: (2,) centre of the square in the grasp plane [m].
        half_size: the grid covers |x|, |y| <= half_size about it [m].
        cell: side of a cell [m].
        layers: number of layers, 1 to 256.

    Raises:
        InvalidInput: for sizes that are not positive or more than 4096 cells a side.
    """
    def __init__(
        self,
        centre: typing.Any,
        half_size: typing.SupportsFloat | typing.SupportsIndex,
        cell: typing.SupportsFloat | typing.SupportsIndex,
        layers: typing.SupportsInt | typing.SupportsIndex,
    ) -> None: ...
    def fill(self, layer: typing.SupportsInt | typing.SupportsIndex, region: Region) -> None:
        """
        Fill every cell of a layer that a region touches.

        Args:
            layer: index of the layer.
            region: Region in the grasp plane [m].
        """
    def filled(
        self, layer: typing.SupportsInt | typing.SupportsIndex
    ) -> numpy.typing.NDArray[numpy.bool]:
        """
        Cells of a layer as (side, side) bools, row along y, column along x.
        """
    def is_inside(self, point: typing.Any) -> bool:
        """
        Whether the point (2,) [m] lies on the grid.
        """
    def touches(
        self, layer: typing.SupportsInt | typing.SupportsIndex, a: typing.Any, b: typing.Any
    ) -> bool:
        """
        Whether the segment from a (2,) to b (2,) [m] touches a filled cell of the layer.
        """
    @property
    def cell(self) -> float:
        """
        Side of a cell [m].
        """
    @property
    def centre(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        (2,) [m].
        """
    @property
    def half_size(self) -> float:
        """
        [m]
        """
    @property
    def layers(self) -> int: ...
    @property
    def side(self) -> int:
        """
        Cells a side.
        """

class OutlinePiece:
    """
    A convex piece of the gripper seen in the grasp plane.

    Args:
        polygon: (n, 2) convex, counter-clockwise, in hand coordinates: along z of H, along x of H
            (of a hand that is not flipped) [m].
        lower, upper: extent along the closing axis, from the grasp plane [m].
    """
    def __init__(
        self,
        polygon: typing.Any,
        *,
        lower: typing.SupportsFloat | typing.SupportsIndex = 0.0,
        upper: typing.SupportsFloat | typing.SupportsIndex = 0.0,
    ) -> None: ...
    @property
    def lower(self) -> float:
        """
        [m]
        """
    @property
    def polygon(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]:
        """
        (n, 2) [m].
        """
    @property
    def upper(self) -> float:
        """
        [m]
        """

class GripperOutline:
    """
    The gripper at one opening: its pieces.
    """
    def __init__(self, pieces: collections.abc.Sequence[OutlinePiece]) -> None: ...
    @property
    def pieces(self) -> list[OutlinePiece]: ...
    @property
    def radius(self) -> float:
        """
        Farthest point from the finger grasp point [m].
        """

class BumpLine:
    """
    A segment off the gripper; its outward normal is its bump vector.
    """
    @property
    def a(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        (2,) in the hand [m].
        """
    @property
    def b(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        (2,) in the hand [m].
        """
    @property
    def layer(self) -> int:
        """
        Index of its piece.
        """
    @property
    def normal(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        (2,) unit.
        """

class QuasipotentialOptions:
    """
    Options of slide_to_target.
    """
    def __init__(
        self,
        *,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.006,
        max_iterations: typing.SupportsInt | typing.SupportsIndex = 2000,
        progress_interval: typing.SupportsInt | typing.SupportsIndex = 20,
        torque_gain: typing.SupportsFloat | typing.SupportsIndex = 0.5,
        lead: typing.SupportsFloat | typing.SupportsIndex = 0.02,
    ) -> None: ...
    @property
    def clearance(self) -> float:
        """
        Bump-line distance from the gripper, at least 1.5 cells [m].
        """
    @clearance.setter
    def clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def lead(self) -> float:
        """
        The attraction point of slide_along moves so far ahead [m].
        """
    @lead.setter
    def lead(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_iterations(self) -> int: ...
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def progress_interval(self) -> int:
        """
        Iterations between two looks at the progress.
        """
    @progress_interval.setter
    def progress_interval(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def torque_gain(self) -> float:
        """
        Turn per torque, before the one-cell limit [rad/m].
        """
    @torque_gain.setter
    def torque_gain(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class SlideStatus:
    """
    How a slide ended.

    Members:

      Reached

      Stalled

      IterationLimit

      StartBlocked
    """

    IterationLimit: typing.ClassVar[SlideStatus]
    Reached: typing.ClassVar[SlideStatus]
    Stalled: typing.ClassVar[SlideStatus]
    StartBlocked: typing.ClassVar[SlideStatus]
    __members__: typing.ClassVar[dict[str, SlideStatus]]
    @typing.overload
    def __eq__(self, other: SlideStatus) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: SlideStatus) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class SlideResult:
    """
    The way of the hand in the grasp plane.
    """
    @property
    def iterations(self) -> int: ...
    @property
    def path(self) -> list[PlanarPose]:
        """
        List of PlanarPose; ends on the target, or where it came nearest.
        """
    @property
    def refusals(self) -> int:
        """
        Steps that the reach test refused.
        """
    @property
    def status(self) -> SlideStatus: ...

class PlaneSearchOptions:
    """
    Options of the complete search in the grasp plane.
    """
    def __init__(
        self,
        *,
        directions: typing.SupportsInt | typing.SupportsIndex = 72,
        close_cost: typing.SupportsFloat | typing.SupportsIndex = 4.0,
        most_tests: typing.SupportsInt | typing.SupportsIndex = 2000,
    ) -> None: ...
    @property
    def close_cost(self) -> float:
        """
        A step to a point where the hand shares a cell with an obstacle costs so much more; 1 to 20.
        """
    @close_cost.setter
    def close_cost(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def directions(self) -> int:
        """
        Of the hand, evenly spaced; 4 to 3600.
        """
    @directions.setter
    def directions(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def most_tests(self) -> int:
        """
        Poses of the arm tried in one search.
        """
    @most_tests.setter
    def most_tests(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class ApproachOptions:
    """
    Options of plan_approach.
    """

    certificate: CertificateOptions
    legality: LegalityOptions
    search: PlaneSearchOptions
    slide: QuasipotentialOptions
    def __init__(
        self,
        *,
        cell: typing.SupportsFloat | typing.SupportsIndex = 0.004,
        run_in: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        least_run_in: typing.SupportsFloat | typing.SupportsIndex = 0.04,
        most_slides: typing.SupportsInt | typing.SupportsIndex = 8,
        slide: QuasipotentialOptions = ...,
        legality: LegalityOptions = ...,
        certificate: CertificateOptions = ...,
        contact_share: typing.SupportsFloat | typing.SupportsIndex = 0.3,
        destination_obstacles_join: bool = False,
        search: PlaneSearchOptions = ...,
        search_levels: typing.SupportsInt | typing.SupportsIndex = 1,
    ) -> None: ...
    @property
    def cell(self) -> float:
        """
        Of the motion grid [m].
        """
    @cell.setter
    def cell(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def contact_share(self) -> float:
        """
        Accepted overlap of the pad with the unobstructed faces.
        """
    @contact_share.setter
    def contact_share(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def destination_obstacles_join(self) -> bool:
        """
        As the article: obstacles moved by T^-1 stand in the way of the approaching hand too.
        """
    @destination_obstacles_join.setter
    def destination_obstacles_join(self, arg0: bool) -> None: ...
    @property
    def least_run_in(self) -> float:
        """
        The shortest one tried [m].
        """
    @least_run_in.setter
    def least_run_in(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def most_slides(self) -> int: ...
    @most_slides.setter
    def most_slides(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def run_in(self) -> float:
        """
        Distance of the start from the grasp [m].
        """
    @run_in.setter
    def run_in(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def search_levels(self) -> int:
        """
        Lattices searched where the slides stall, each half as wide; 0: no search.
        """
    @search_levels.setter
    def search_levels(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class ApproachPlanner:
    """
    Which planner found the way in, in the order they are asked.

    Members:

      Straight

      Quasipotential

      PlaneSearch

      Arm
    """

    Arm: typing.ClassVar[ApproachPlanner]
    PlaneSearch: typing.ClassVar[ApproachPlanner]
    Quasipotential: typing.ClassVar[ApproachPlanner]
    Straight: typing.ClassVar[ApproachPlanner]
    __members__: typing.ClassVar[dict[str, ApproachPlanner]]
    @typing.overload
    def __eq__(self, other: ApproachPlanner) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: ApproachPlanner) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class ApproachStatus:
    """
    How an approach ended.

    Members:

      Found

      StartBlocked

      Stalled

      PoorOverlap

      IllegalAtDestination

      NotCertified
    """

    Found: typing.ClassVar[ApproachStatus]
    IllegalAtDestination: typing.ClassVar[ApproachStatus]
    NotCertified: typing.ClassVar[ApproachStatus]
    PoorOverlap: typing.ClassVar[ApproachStatus]
    Stalled: typing.ClassVar[ApproachStatus]
    StartBlocked: typing.ClassVar[ApproachStatus]
    __members__: typing.ClassVar[dict[str, ApproachStatus]]
    @typing.overload
    def __eq__(self, other: ApproachStatus) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: ApproachStatus) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class ApproachResult:
    """
    An approach, or why there is none; true if found.
    """
    def __bool__(self) -> bool: ...
    @property
    def found(self) -> bool: ...
    @property
    def grasp(self) -> GraspPose:
        """
        GraspPose where the slide ended; its q_pick is the path's end alone.
        """
    @property
    def path(self) -> list[Configuration]:
        """
        Configurations from the start to the grasp, hand open; every edge certified.
        """
    @property
    def planner(self) -> ApproachPlanner:
        """
        ApproachPlanner that found it; the last one asked, if none did.
        """
    @property
    def reason(self) -> str:
        """
        Why not found, with names and numbers.
        """
    @property
    def slide(self) -> SlideResult:
        """
        SlideResult in the grasp plane.
        """
    @property
    def status(self) -> ApproachStatus: ...

class JoinedScene:
    """
    The origin with copies of what is near the part at its destination.
    """
    def checker(self) -> CollisionChecker:
        """
        A CollisionChecker of that cell in which the hand alone is kept apart from the copies.
        """
    @property
    def cell(self) -> Cell:
        """
        The copies are fixtures: 'wall (destination)'.
        """
    @property
    def copies(self) -> list[BodyRef]:
        """
        BodyRefs of the copies.
        """
    @property
    def model(self) -> CollisionModel: ...

class DepartureOptions:
    """
    Options of plan_departure.
    """

    certificate: CertificateOptions
    search: PlaneSearchOptions
    slide: QuasipotentialOptions
    def __init__(
        self,
        *,
        cell: typing.SupportsFloat | typing.SupportsIndex = 0.004,
        least: typing.SupportsFloat | typing.SupportsIndex = 0.02,
        most: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.0002,
        room: typing.SupportsFloat | typing.SupportsIndex = 0.0175,
        most_slides: typing.SupportsInt | typing.SupportsIndex = 3,
        slide: QuasipotentialOptions = ...,
        search: PlaneSearchOptions = ...,
        search_levels: typing.SupportsInt | typing.SupportsIndex = 1,
        certificate: CertificateOptions = ...,
    ) -> None: ...
    @property
    def cell(self) -> float:
        """
        Of grid and lattice [m].
        """
    @cell.setter
    def cell(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def clearance(self) -> float:
        """
        Of the whole robot at the poses tried [m].
        """
    @clearance.setter
    def clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def least(self) -> float:
        """
        It ends no nearer to its start [m].
        """
    @least.setter
    def least(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def most(self) -> float:
        """
        Out is that far from the start; it may then end before [m].
        """
    @most.setter
    def most(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def most_slides(self) -> int:
        """
        0: none.
        """
    @most_slides.setter
    def most_slides(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def room(self) -> float:
        """
        Ends at the last pose where the first three joints are free by so much [rad]; 0: not asked.
        """
    @room.setter
    def room(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def search_levels(self) -> int:
        """
        Lattices searched where no slide comes in, each half as wide; 0: no search.
        """
    @search_levels.setter
    def search_levels(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class DepartureResult:
    """
    A way out in the grasp plane, or why there is none; true if found.
    """
    def __bool__(self) -> bool: ...
    @property
    def found(self) -> bool: ...
    @property
    def has_room(self) -> bool:
        """
        It ends where DepartureOptions.room is free; false if that was not asked.
        """
    @property
    def path(self) -> list[Configuration]:
        """
        Configurations from the start outwards; every edge certified.
        """
    @property
    def planner(self) -> ApproachPlanner:
        """
        ApproachPlanner that found it, or was asked last.
        """
    @property
    def poses(self) -> list[PlanarPose]:
        """
        PlanarPose of the hand before the path was shortened; the start is (0, 0, 0).
        """
    @property
    def reason(self) -> str:
        """
        Why not found, with names and numbers.
        """

class RetreatOptions:
    """
    Options of plan_retreat.
    """

    certificate: CertificateOptions
    def __init__(
        self,
        *,
        least: typing.SupportsFloat | typing.SupportsIndex = 0.02,
        most: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        step: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        contact_travel: typing.SupportsFloat | typing.SupportsIndex = 0.0015,
        room: typing.SupportsFloat | typing.SupportsIndex = 0.0175,
        certificate: CertificateOptions = ...,
    ) -> None: ...
    @property
    def contact_travel(self) -> float:
        """
        First step, with contacts allowed [m].
        """
    @contact_travel.setter
    def contact_travel(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def least(self) -> float:
        """
        A shorter retreat is a failure [m].
        """
    @least.setter
    def least(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def most(self) -> float:
        """
        Where it stops [m].
        """
    @most.setter
    def most(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def room(self) -> float:
        """
        Ends at the farthest point where the first three joints are free by so much [rad]; 0: not asked.
        """
    @room.setter
    def room(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def step(self) -> float:
        """
        Between two hand poses [m].
        """
    @step.setter
    def step(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class RetreatResult:
    """
    A retreat, or why there is none; true if found.
    """
    def __bool__(self) -> bool: ...
    @property
    def found(self) -> bool: ...
    @property
    def has_room(self) -> bool:
        """
        It ends where RetreatOptions.room is free; false if that was not asked.
        """
    @property
    def path(self) -> list[Configuration]:
        """
        Configurations from the contact outwards; every edge certified.
        """
    @property
    def reason(self) -> str:
        """
        What stopped it, with names and numbers.
        """
    @property
    def travelled(self) -> float:
        """
        [m]
        """

class SceneHull:
    """
    A convex polyhedron.

    Args:
        points: vertices (n, 3) [m].
        edges: pairs of indices of points; more than the polyhedron's edges are allowed. None: all
            pairs.
    """
    def __init__(
        self, points: typing.Any, edges: collections.abc.Sequence[tuple[int, int]] | None = None
    ) -> None: ...
    @property
    def edges(self) -> list[tuple[int, int]]:
        """
        Pairs of indices of points.
        """
    @property
    def points(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
        """
        Vertices (n, 3) [m].
        """

class SceneMover:
    """
    A body that moves: of the robot, or what it holds.
    """
    @property
    def X_BM(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        Its frame in that body, (4, 4).
        """
    @property
    def body(self) -> int:
        """
        Robot body that it is or is held by.
        """
    @property
    def depth(self) -> int:
        """
        Number of arm joints that move it.
        """
    @property
    def finger(self) -> bool:
        """
        Is it moved by the opening besides?
        """
    @property
    def hulls(self) -> list[SceneHull]:
        """
        In its frame.
        """
    @property
    def name(self) -> str: ...

class SceneObstacle:
    """
    A body that stands: a fixture or a part.
    """
    @property
    def checked(self) -> list[bool]:
        """
        Per mover: is it kept apart from this?
        """
    @property
    def hulls(self) -> list[SceneHull]:
        """
        In the robot frame.
        """
    @property
    def name(self) -> str: ...

class Scene:
    """
    What a checker keeps apart, as convex hulls.
    """
    @property
    def mover_pairs(self) -> list[tuple[int, int]]:
        """
        Indices of movers that are kept apart from each other.
        """
    @property
    def movers(self) -> list[SceneMover]:
        """
        Robot bodies, base first, then what is held.
        """
    @property
    def obstacles(self) -> list[SceneObstacle]: ...

class SceneOptions:
    """
    Options of describe_scene.
    """
    def __init__(self, *, patch_triangles: int = 24, patch_excess: float = 0.005) -> None: ...
    @property
    def patch_excess(self) -> float:
        """
        How far a patch's hull may stand out of the solid [m].
        """
    @patch_excess.setter
    def patch_excess(self, arg0: float) -> None: ...
    @property
    def patch_triangles(self) -> int:
        """
        Most triangles of a surface patch's hull.
        """
    @patch_triangles.setter
    def patch_triangles(self, arg0: int) -> None: ...

class RestingOptions:
    """
    Options of resting_poses.
    """
    def __init__(
        self,
        *,
        segments: typing.SupportsInt | typing.SupportsIndex = 64,
        least_tip_angle: typing.SupportsFloat | typing.SupportsIndex = 0.01,
        contact_gap: typing.SupportsFloat | typing.SupportsIndex = 0.0006,
        least_width: typing.SupportsFloat | typing.SupportsIndex = 0.002,
        rolling: typing.SupportsFloat | typing.SupportsIndex = 0.1,
        rolling_step: typing.SupportsFloat | typing.SupportsIndex = 0.4,
    ) -> None: ...
    @property
    def contact_gap(self) -> float:
        """
        What lies this near above the table stands on it [m].
        """
    @contact_gap.setter
    def contact_gap(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def least_tip_angle(self) -> float:
        """
        Poses that a smaller turn would tip over are left out [rad].
        """
    @least_tip_angle.setter
    def least_tip_angle(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def least_width(self) -> float:
        """
        Of the region that it stands on [m].
        """
    @least_width.setter
    def least_width(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def rolling(self) -> float:
        """
        A pose that a smaller turn tips over is one of a round side [rad].
        """
    @rolling.setter
    def rolling(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def rolling_step(self) -> float:
        """
        Poses of a round side are kept this far apart, or more [rad].
        """
    @rolling_step.setter
    def rolling_step(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def segments(self) -> int:
        """
        Sides of a round shape.
        """
    @segments.setter
    def segments(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class RestingPose:
    """
    A part standing on the plane z = 0 of a support frame S.
    """
    def __repr__(self) -> str: ...
    @property
    def X_SP(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        The part in S, (4, 4): lowest point at z = 0, centre of mass over the origin.
        """
    @property
    def contact(self) -> Region:
        """
        What it stands on, in x, y of S.
        """
    @property
    def footprint(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]:
        """
        Convex hull of what it stands on, in x, y of S, (n, 2) [m].
        """
    @property
    def height(self) -> float:
        """
        Of the centre of mass over the plane [m].
        """
    @property
    def margin(self) -> float:
        """
        Of the centre of mass from the nearest edge of the footprint [m].
        """
    @property
    def probability(self) -> float:
        """
        Of coming to rest so.
        """
    @property
    def shadow(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]:
        """
        Convex hull of the whole part seen from above, in x, y of S, (n, 2) [m].
        """
    @property
    def tip_angle(self) -> float:
        """
        The least turn that tips it over [rad].
        """
    @property
    def top(self) -> float:
        """
        Height of its highest point [m].
        """
    @property
    def width(self) -> float:
        """
        Least width of what it stands on [m].
        """

class SupportFace:
    """
    An upward horizontal face of a body, in a frame S.
    """
    def __repr__(self) -> str: ...
    @property
    def X_WS(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        S in the world, (4, 4): z along the outward normal.
        """
    @property
    def area(self) -> float:
        """
        [m2]
        """
    @property
    def enclosed(self) -> Region:
        """
        What the body's walls enclose, in S.
        """
    @property
    def outline(self) -> Region:
        """
        Of the body seen from above, in S.
        """
    @property
    def region(self) -> Region:
        """
        In x, y of S.
        """

class SupportFaceOptions:
    """
    Options of support_faces.
    """
    def __init__(
        self,
        *,
        level: typing.SupportsFloat | typing.SupportsIndex = 0.0174533,
        least_area: typing.SupportsFloat | typing.SupportsIndex = 4e-06,
        least_wall: typing.SupportsFloat | typing.SupportsIndex = 0.002,
    ) -> None: ...
    @property
    def least_area(self) -> float:
        """
        Smaller faces are left out [m2].
        """
    @least_area.setter
    def least_area(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def least_wall(self) -> float:
        """
        A wall rises at least so far over the face [m].
        """
    @least_wall.setter
    def least_wall(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def level(self) -> float:
        """
        A normal leaves the vertical by no more [rad].
        """
    @level.setter
    def level(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class StandingPlace:
    """
    Where a part can be put down.
    """
    @property
    def X_WP(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        (4, 4)
        """
    @property
    def margin(self) -> float:
        """
        Of the centre of mass within what it stands on [m].
        """
    @property
    def room(self) -> float:
        """
        It is at least so far from all that is not under it [m].
        """

class StandingPlaceOptions:
    """
    Options of find_standing_places.

    Args:
        first, count: which samples of the sequence.
        seed: of the sequence.
        near_point: every second sample is around this point of the world, (2,), or None.
        within: up to so far from it [m].
        region: box of the world that all that it stands on lies in, (2, 2), or None.
        inside: within the walls of the face's body.
        least_margin: of the centre of mass within what it stands on [m].
        clearance: to all that is not under it [m].
        rooms: greater distances, ascending; a place's room is the greatest that it has [m].
        robot: Configuration in which the robot stands and is kept clear of, or None.
    """
    def __init__(
        self,
        *,
        first: typing.SupportsInt | typing.SupportsIndex = 0,
        count: typing.SupportsInt | typing.SupportsIndex = 32,
        seed: typing.SupportsInt | typing.SupportsIndex = 0,
        near_point: typing.Any = None,
        within: typing.SupportsFloat | typing.SupportsIndex = 0.2,
        region: typing.Any = None,
        inside: bool = False,
        least_margin: typing.SupportsFloat | typing.SupportsIndex = 0.002,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.001,
        rooms: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = [
            0.003,
            0.01,
            0.03,
            0.06,
        ],
        robot: Configuration | None = None,
    ) -> None: ...

class StandingPlaces:
    """
    Places, and why the other samples fell.
    """
    @property
    def in_the_way(self) -> str:
        """
        What was met most often by those that were not clear.
        """
    @property
    def not_clear(self) -> int: ...
    @property
    def off_the_face(self) -> int: ...
    @property
    def outside_the_region(self) -> int: ...
    @property
    def outside_the_walls(self) -> int: ...
    @property
    def places(self) -> list[StandingPlace]:
        """
        In the order of the sequence.
        """
    @property
    def tried(self) -> int: ...

class Lattice:
    """
    The cells of a slice over the first three joints.
    """
    def cell_width(self, level: int, joint: int) -> float:
        """
        Width of a cell [rad].
        """
    def cells(self, level: int, joint: int) -> int:
        """
        Number of cells.
        """
    def centre(self, level: int, joint: int, index: int) -> float:
        """
        Middle of a cell [rad].
        """
    def index_of(self, level: int, joint: int, angle: float) -> int:
        """
        The cell that holds an angle [rad]; -1 if it is out of the joint's range.
        """
    @property
    def count(self) -> list[int]:
        """
        Cells of level 0.
        """
    @property
    def lower(self) -> list[float]:
        """
        Of the joints' ranges [rad].
        """
    @property
    def width(self) -> list[float]:
        """
        Of a cell of level 0 [rad].
        """
    @property
    def wraps(self) -> list[bool]:
        """
        Has the joint no limits?
        """

class ArmPlane:
    """
    The plane in which joints 2 and 3 move the arm.

    Frame E turns with the waist: origin on axis 2, z along it, x and y in the plane.
    """
    def X_RE(self, q1: float) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
        """
        E in the robot frame at a waist angle [rad], (4, 4).
        """
    @property
    def elbow(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]:
        """
        Axis 3 in (x, y) of E where joint 2 is 0, (2,) [m].
        """
    @property
    def elbow_sense(self) -> float:
        """
        1: joint 3 turns as joint 2 does; -1: the other way.
        """
    @property
    def waist_axis(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        Axis 1 in E, (3,), unit.
        """
    @property
    def waist_point(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
        """
        A point of axis 1 in E, (3,) [m].
        """

class ArmTable:
    """
    What each piece of an arm's plane blocks. Made once per robot; shared.
    """
    @property
    def lattice(self) -> Lattice: ...
    @property
    def level(self) -> int:
        """
        Of the lattice.
        """

class ArmTableOptions:
    """
    Options of make_arm_table.
    """
    def __init__(
        self,
        *,
        level: typing.SupportsInt | typing.SupportsIndex = 0,
        square: typing.SupportsFloat | typing.SupportsIndex = 0.02,
        directory: str = "",
    ) -> None: ...
    @property
    def directory(self) -> str:
        """
        Where tables are kept; empty: in memory only.
        """
    @directory.setter
    def directory(self, arg0: str) -> None: ...
    @property
    def level(self) -> int:
        """
        Of the lattice: 0 is 8 degrees, 1 is 4, 2 is 2, 3 is 1.
        """
    @level.setter
    def level(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def square(self) -> float:
        """
        Width of a ring of the arm's plane at level 0 [m].
        """
    @square.setter
    def square(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class Slab:
    """
    Lateral extent, along z of E.

    Args:
        lower: [m].
        upper: [m].
    """
    def __init__(self, lower: float, upper: float) -> None: ...
    @property
    def lower(self) -> float:
        """
        [m]
        """
    @lower.setter
    def lower(self, arg0: float) -> None: ...
    @property
    def upper(self) -> float:
        """
        [m]
        """
    @upper.setter
    def upper(self, arg0: float) -> None: ...

class Torus:
    """
    One section of an obstacle for a window of waist angles.
    """
    @property
    def lower(self) -> float:
        """
        [rad], in -pi to pi.
        """
    @property
    def section(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]:
        """
        A convex polygon (n, 2) in (x, y) of E [m].
        """
    @property
    def upper(self) -> float:
        """
        [rad]; may pass pi: the window goes on round.
        """

class PlanarArm:
    """
    Two links in a plane.

    Args:
        upper: convex polygons (n, 2) where theta2 is 0, from the shoulder [m].
        lower: convex polygons (n, 2) where both angles are 0, from the elbow [m].
        elbow: where theta2 is 0, from the shoulder (2,) [m].
    """
    def __init__(
        self,
        *,
        upper: collections.abc.Iterable[typing.Any],
        lower: collections.abc.Iterable[typing.Any],
        elbow: typing.Any,
    ) -> None: ...
    @property
    def elbow(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[2, 1]"]: ...
    @property
    def lower(self) -> list[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]]: ...
    @property
    def upper(self) -> list[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]]: ...

class TimingOptions:
    """
    Options of time_path.
    """
    def __init__(
        self,
        *,
        interval: typing.SupportsFloat | typing.SupportsIndex = 0.008,
        speed_scale: typing.SupportsFloat | typing.SupportsIndex = 1.0,
    ) -> None: ...
    @property
    def interval(self) -> float:
        """
        Longest time between rows while the speed changes, 1e-4 to 1 [s].
        """
    @interval.setter
    def interval(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def speed_scale(self) -> float:
        """
        Of the velocity limits, in (0, 1].
        """
    @speed_scale.setter
    def speed_scale(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class TimedPath:
    """
    Rows of a timed path; straight lines between them.
    """
    def __len__(self) -> int: ...
    @property
    def configurations(self) -> list[Configuration]:
        """
        One Configuration per time.
        """
    @property
    def duration(self) -> float:
        """
        Time of the last row [s].
        """
    @property
    def opening(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) distance between the pads [m].
        """
    @property
    def positions(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, n]"]:
        """
        (n, joints) arm joint values [rad].
        """
    @property
    def time(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]:
        """
        (n,) from 0, strictly increasing [s].
        """

class SamplingOptions:
    """
    Options of plan_by_sampling.
    """

    certificate: CertificateOptions
    def __init__(
        self,
        *,
        seed: typing.SupportsInt | typing.SupportsIndex = 0,
        max_iterations: typing.SupportsInt | typing.SupportsIndex = 20000,
        range: typing.SupportsFloat | typing.SupportsIndex = 0.6,
        certificate: CertificateOptions = ...,
    ) -> None: ...
    @property
    def max_iterations(self) -> int:
        """
        States sampled, or boxes of the slices looked at.
        """
    @max_iterations.setter
    def max_iterations(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def range(self) -> float:
        """
        Longest tree edge, in the weighted metric [rad].
        """
    @range.setter
    def range(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def seed(self) -> int:
        """
        Fixes every random choice.
        """
    @seed.setter
    def seed(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class MotionStatus:
    """
    How a motion planner ended.

    Members:

      Found

      StartBlocked

      GoalsBlocked

      IterationLimit

      Infeasible : Proved: no path leads to any free goal.
    """

    Found: typing.ClassVar[MotionStatus]
    GoalsBlocked: typing.ClassVar[MotionStatus]
    Infeasible: typing.ClassVar[MotionStatus]
    IterationLimit: typing.ClassVar[MotionStatus]
    StartBlocked: typing.ClassVar[MotionStatus]
    __members__: typing.ClassVar[dict[str, MotionStatus]]
    @typing.overload
    def __eq__(self, other: MotionStatus) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: MotionStatus) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class MotionResult:
    """
    A motion, or why there is none; true if found.
    """
    def __bool__(self) -> bool: ...
    @property
    def found(self) -> bool: ...
    @property
    def goal(self) -> int:
        """
        Which goal was reached, -1 for none.
        """
    @property
    def iterations(self) -> int:
        """
        States sampled, or boxes of the slices looked at.
        """
    @property
    def path(self) -> list[Configuration]:
        """
        Configurations from the start to goals[goal]; every edge certified.
        """
    @property
    def planner(self) -> str:
        """
        'straight', 'slices' or 'RRT-Connect'.
        """
    @property
    def reason(self) -> str:
        """
        Why not found, with names and numbers.
        """
    @property
    def slices_reason(self) -> str:
        """
        Why the slices gave no way, where they were searched in vain.
        """
    @property
    def status(self) -> MotionStatus: ...

class ShortcutOptions:
    """
    Options of shorten_path.
    """

    certificate: CertificateOptions
    def __init__(
        self,
        *,
        seed: typing.SupportsInt | typing.SupportsIndex = 0,
        attempts: typing.SupportsInt | typing.SupportsIndex = 60,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.005,
        certificate: CertificateOptions = ...,
    ) -> None: ...
    @property
    def attempts(self) -> int:
        """
        Most moves of corners tried.
        """
    @attempts.setter
    def attempts(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def clearance(self) -> float:
        """
        Kept where the path has it [m]; 0: no more than the certificate's.
        """
    @clearance.setter
    def clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def seed(self) -> int:
        """
        Fixes every random choice.
        """
    @seed.setter
    def seed(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class FreeSpaceOptions:
    """
    The slices of one gross motion.
    """
    def __init__(
        self,
        *,
        window_level: typing.SupportsInt | typing.SupportsIndex = 3,
        outer_level: typing.SupportsInt | typing.SupportsIndex = 1,
        range_level: typing.SupportsInt | typing.SupportsIndex = 1,
        home_level: typing.SupportsInt | typing.SupportsIndex = 1,
        wrist_splits: typing.SupportsInt | typing.SupportsIndex = 3,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.0001,
        table: ArmTable | None = None,
    ) -> None: ...
    @property
    def clearance(self) -> float:
        """
        Least distance proved [m].
        """
    @clearance.setter
    def clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def home_level(self) -> int:
        """
        Finest level of the slice with the wrist as at home.
        """
    @home_level.setter
    def home_level(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def outer_level(self) -> int:
        """
        Finest level of the ends' slices outside their windows.
        """
    @outer_level.setter
    def outer_level(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def range_level(self) -> int:
        """
        Finest level of the slices over the wrist's range.
        """
    @range_level.setter
    def range_level(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def table(self) -> ArmTable | None:
        """
        ArmTable of level 0 for this robot, or None: by proofs alone.
        """
    @table.setter
    def table(self, arg1: ArmTable | None) -> None: ...
    @property
    def window_level(self) -> int:
        """
        Finest level within the windows round the ends: 0 is 8 degrees, 3 is 1.
        """
    @window_level.setter
    def window_level(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def wrist_splits(self) -> int:
        """
        The wrist's range is halved at most so often.
        """
    @wrist_splits.setter
    def wrist_splits(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class SearchOptions:
    """
    The search through the slices.
    """
    def __init__(
        self,
        *,
        windows: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex] = [0.6, 1.2],
        max_proofs: typing.SupportsInt | typing.SupportsIndex = 8000,
        detour: typing.SupportsFloat | typing.SupportsIndex = 2.0,
    ) -> None: ...
    @property
    def detour(self) -> float:
        """
        Weight of the estimate, 1 or more.
        """
    @detour.setter
    def detour(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def max_proofs(self) -> int:
        """
        Boxes proved at most; 0: the slices are not searched.
        """
    @max_proofs.setter
    def max_proofs(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def windows(self) -> list[float]:
        """
        Half widths of the windows of finest cells, one after the other [rad].
        """
    @windows.setter
    def windows(
        self, arg0: collections.abc.Sequence[typing.SupportsFloat | typing.SupportsIndex]
    ) -> None: ...

class SearchResult:
    """
    A way through the slices, or why there is none.
    """
    def __bool__(self) -> bool: ...
    @property
    def found(self) -> bool: ...
    @property
    def goal(self) -> int:
        """
        Which goal was reached, -1 for none.
        """
    @property
    def path(self) -> list[Configuration]:
        """
        Configurations from start to goal.
        """
    @property
    def proofs(self) -> int:
        """
        Boxes looked at.
        """
    @property
    def reason(self) -> str: ...
    @property
    def stances(self) -> int:
        """
        Other stances of the wrist that the way goes through.
        """
    @property
    def window(self) -> float:
        """
        Half width that sufficed [rad].
        """

class GrossOptions:
    """
    Options of plan_gross_motion.
    """

    free_space: FreeSpaceOptions
    sampling: SamplingOptions
    separation: SeparationOptions
    shortcut: ShortcutOptions
    def __init__(
        self,
        *,
        free_space: FreeSpaceOptions = ...,
        search: SearchOptions = ...,
        separation: SeparationOptions = ...,
        sampling: SamplingOptions = ...,
        shortcut: ShortcutOptions = ...,
    ) -> None: ...
    @property
    def search(self) -> SearchOptions:
        """
        max_proofs = 0: sampling at once where no straight edge is free.
        """
    @search.setter
    def search(self, arg0: SearchOptions) -> None: ...

class BlockedProof:
    """
    The bodies that collide everywhere in a cell.
    """
    def __bool__(self) -> bool: ...
    @property
    def blocked(self) -> bool:
        """
        Is the cell proved blocked?
        """
    @property
    def mover(self) -> str:
        """
        A robot body, or 'held ...'.
        """
    @property
    def other(self) -> str:
        """
        What it collides with.
        """

class BlockedCells:
    """
    Proves cells blocked, for one opening and what is held.

    A blocked cell has no free configuration, whatever the joints after the third do.

    Args:
        checker: CollisionChecker of the cell, with what is held; it is not kept.
        opening: between the pads [m].

    Raises:
        InvalidInput: for arms of fewer than three joints, joints of too wide ranges, or an opening
            that is not finite.
    """
    def __init__(
        self, checker: CollisionChecker, opening: typing.SupportsFloat | typing.SupportsIndex
    ) -> None: ...
    def prove(
        self,
        level: typing.SupportsInt | typing.SupportsIndex,
        cell: typing.Annotated[
            collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], "FixedSize(3)"
        ],
    ) -> BlockedProof:
        """
        Is a cell proved blocked, and by which bodies?

        Args:
            level: of the lattice.
            cell: indices along the first three joints.

        Returns:
            BlockedProof, true if it is.
        """
    @property
    def lattice(self) -> Lattice: ...

class SeparationOptions:
    """
    Options of prove_apart.
    """
    def __init__(
        self,
        *,
        finest_level: typing.SupportsInt | typing.SupportsIndex = 2,
        most_cells: typing.SupportsInt | typing.SupportsIndex = 100000,
    ) -> None: ...
    @property
    def finest_level(self) -> int:
        """
        Of the lattice: 0 is 8 degrees, 1 is 4, 2 is 2, 3 is 1.
        """
    @finest_level.setter
    def finest_level(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def most_cells(self) -> int:
        """
        Cells looked at before it is given up.
        """
    @most_cells.setter
    def most_cells(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class Separation:
    """
    Is there no way at all? True if that is proved.
    """
    def __bool__(self) -> bool: ...
    @property
    def apart(self) -> bool:
        """
        No path leads to any of the goals.
        """
    @property
    def cells_looked_at(self) -> int: ...
    @property
    def goal_apart(self) -> list[bool]:
        """
        Per goal: is it proved that no path leads to it?
        """
    @property
    def reason(self) -> str:
        """
        What walls the goals off, or why they are not called apart.
        """
    @property
    def resolution(self) -> float:
        """
        Widest edge of the finest cells looked at [rad].
        """

class Slice:
    """
    Cells of the first three joints, free for a range of the wrist.

    A cell called free is free for every configuration in it and every wrist value of the range. Layers
    of the waist angle are built when asked for. One worker: not to be shared between threads.

    Args:
        checker: CollisionChecker of the cell, with what is held.
        table: ArmTable of its robot.
        wrist: WristRange.
        opening: between the pads [m].
        options: SliceOptions.

    Raises:
        InvalidInput: for a wrist range of the wrong length or not in order, an opening that is not the
            gripper's, or a table of another robot.
    """
    def __init__(
        self,
        checker: CollisionChecker,
        table: ArmTable,
        wrist: WristRange,
        opening: typing.SupportsFloat | typing.SupportsIndex,
        options: SliceOptions = ...,
    ) -> None: ...
    def blocked(
        self, waist_cell: typing.SupportsInt | typing.SupportsIndex
    ) -> numpy.typing.NDArray[numpy.bool]:
        """
        One layer of the waist angle: (cells of theta2, cells of theta3), true if blocked.
        """
    def is_free(
        self,
        cell: typing.Annotated[
            collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex], "FixedSize(3)"
        ],
    ) -> bool:
        """
        Is a cell free? Given by its indices along the first three joints.
        """
    @property
    def lattice(self) -> Lattice: ...
    @property
    def layers_built(self) -> int: ...
    @property
    def level(self) -> int:
        """
        Of the lattice.
        """
    @property
    def reason(self) -> str:
        """
        Why no cell can be free at all; empty if there is no such reason.
        """

class SliceMode:
    """
    How obstacles are taken to the arm's plane.

    Members:

      Cells : a cross section for every cell of the waist angle

      Article : tori: one cross section for all waist angles
    """

    Article: typing.ClassVar[SliceMode]
    Cells: typing.ClassVar[SliceMode]
    __members__: typing.ClassVar[dict[str, SliceMode]]
    @typing.overload
    def __eq__(self, other: SliceMode) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: SliceMode) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class SliceOptions:
    """
    Options of Slice.
    """

    mode: SliceMode
    def __init__(
        self,
        *,
        mode: SliceMode = ...,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.0001,
    ) -> None: ...
    @property
    def clearance(self) -> float:
        """
        Least distance of free configurations from everything [m].
        """
    @clearance.setter
    def clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...

class ShutInOptions:
    """
    Options of prove_shut_in.
    """
    def __init__(
        self,
        *,
        finest: typing.Any = 0.001,
        most_cubes: typing.SupportsInt | typing.SupportsIndex = 30000,
        most_steps: typing.SupportsInt | typing.SupportsIndex = 1000000,
    ) -> None: ...
    @property
    def finest(self) -> float:
        """
        Edge of the smallest cubes [m].
        """
    @finest.setter
    def finest(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def most_cubes(self) -> int:
        """
        Looked at before it is given up.
        """
    @most_cubes.setter
    def most_cubes(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    @property
    def most_steps(self) -> int:
        """
        From cube to cube before it is given up.
        """
    @most_steps.setter
    def most_steps(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

class ShutIn:
    """
    Can a part not come to its goal at all? True if that is proved.
    """
    def __bool__(self) -> bool: ...
    @property
    def bodies(self) -> list[str]:
        """
        Round the end, those that block most cubes first.
        """
    @property
    def cubes_looked_at(self) -> int: ...
    @property
    def end(self) -> int:
        """
        0: it does not come away from the first place; 1: to the second.
        """
    @property
    def radius(self) -> float:
        """
        Of the ball that the part holds [m].
        """
    @property
    def reason(self) -> str:
        """
        Why it is not proved.
        """
    @property
    def resolution(self) -> float:
        """
        Edge of the smallest cubes that took part [m].
        """
    @property
    def shut_in(self) -> bool: ...

class WalledOff:
    """
    Is the arm shut out from a part? True if that is proved.
    """
    def __bool__(self) -> bool: ...
    @property
    def bodies(self) -> list[str]:
        """
        What is met at the border, those with most cells first.
        """
    @property
    def cells_looked_at(self) -> int: ...
    @property
    def movers(self) -> list[str]:
        """
        What of the robot meets them, likewise.
        """
    @property
    def reason(self) -> str:
        """
        Why it is not proved.
        """
    @property
    def resolution(self) -> float:
        """
        Widest edge of the finest cells looked at [rad].
        """
    @property
    def walled_off(self) -> bool: ...
    @property
    def within_limits(self) -> bool:
        """
        Some configuration within the joints' limits comes so near.
        """

class WristRange:
    """
    Values of the joints after the third.

    Args:
        lower: (n - 3,) [rad].
        upper: (n - 3,) [rad].
    """
    def __init__(self, lower: typing.Any, upper: typing.Any) -> None: ...
    @property
    def lower(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...
    @property
    def upper(self) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 1]"]: ...

class CellKind:
    """
    What is known of a cell.

    Members:

      Free

      NotProved

      Collides
    """

    Collides: typing.ClassVar[CellKind]
    Free: typing.ClassVar[CellKind]
    NotProved: typing.ClassVar[CellKind]
    __members__: typing.ClassVar[dict[str, CellKind]]
    @typing.overload
    def __eq__(self, other: CellKind) -> bool: ...
    @typing.overload
    def __eq__(self, other: typing.Any) -> bool: ...
    def __getstate__(self) -> int: ...
    def __hash__(self) -> int: ...
    def __index__(self) -> int: ...
    def __init__(self, value: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __int__(self) -> int: ...
    @typing.overload
    def __ne__(self, other: CellKind) -> bool: ...
    @typing.overload
    def __ne__(self, other: typing.Any) -> bool: ...
    def __repr__(self) -> str: ...
    def __setstate__(self, state: typing.SupportsInt | typing.SupportsIndex) -> None: ...
    def __str__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...

class SliceLayer:
    """
    The cells of a slice at one waist angle.
    """
    @property
    def kinds(self) -> numpy.typing.NDArray[numpy.uint8]:
        """
        (cells of theta3, cells of theta2) of the values of CellKind.
        """
    @property
    def theta1(self) -> float:
        """
        Middle of the layer [rad].
        """

class LayerOptions:
    """
    Options of prove_layer.
    """
    def __init__(
        self,
        *,
        level: typing.SupportsInt | typing.SupportsIndex = 3,
        clearance: typing.SupportsFloat | typing.SupportsIndex = 0.0001,
    ) -> None: ...
    @property
    def clearance(self) -> float:
        """
        Least distance proved [m].
        """
    @clearance.setter
    def clearance(self, arg0: typing.SupportsFloat | typing.SupportsIndex) -> None: ...
    @property
    def level(self) -> int:
        """
        Of the lattice: 3 is 1 degree.
        """
    @level.setter
    def level(self, arg0: typing.SupportsInt | typing.SupportsIndex) -> None: ...

def arm_plane(robot: Robot) -> tuple[ArmPlane | None, str]:
    """
    The arm's plane, if its second and third axes are parallel.

    Returns:
        The plane and "", or None and why there is none.
    """

def beyond_reach(
    solver: SphericalWristSolver, gripper: Gripper, part: Body, X_RP: typing.Any
) -> float:
    """
    By how much a part is farther away than the arm reaches, whatever the grasp.

    Args:
        solver: SphericalWristSolver of the robot.
        gripper: of the robot.
        part: Body; its own pose does not count.
        X_RP: the part in the robot frame, (4, 4).

    Returns:
        At least so much [m]; zero or less where it is not proved to be out of reach.

    Raises:
        InvalidInput: for a pose that is not rigid, a part without shapes.
    """

def body_poses(robot: Robot, configuration: Configuration) -> numpy.typing.NDArray[numpy.float64]:
    """
    Pose of every body in the robot frame.

    Returns:
        Array of shape (bodies, 4, 4).
    """

def boundary_distance(region: Region, point: typing.Any) -> float:
    """
    Distance of a point (2,) to the nearest edge [m].
    """

def bump_lines(
    outline: GripperOutline, clearance: typing.SupportsFloat | typing.SupportsIndex
) -> list[BumpLine]:
    """
    The edges of each piece grown by the clearance.

    Args:
        outline: GripperOutline.
        clearance: distance from the gripper [m].

    Returns:
        List of BumpLine, counter-clockwise round each piece.

    Raises:
        InvalidInput: for a clearance that is not positive, a piece that is not convex.
    """

def centre_of_mass(body: Body) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[3, 1]"]:
    """
    Centre of mass in the body frame, uniform density, (3,) [m].
    """

def clearance_path(
    grid: MotionGrid,
    outline: GripperOutline,
    target: PlanarPose,
    exit: typing.SupportsFloat | typing.SupportsIndex,
    enough: typing.SupportsFloat | typing.SupportsIndex = 0.02,
) -> ClearancePath:
    """
    The way of greatest clearance for the hand that keeps its direction.

    Args:
        grid: MotionGrid with one layer for each piece of the outline.
        outline: GripperOutline.
        target: PlanarPose.
        exit: the way begins that far from the target [m].
        enough: more clearance is worth nothing [m].

    Returns:
        ClearancePath; where the whole hand has none, that of its finger tips.

    Raises:
        InvalidInput: for layers and pieces that differ in number, a target off the grid, lengths that
            are not positive or more than 2 m.
    """

def certify_edge(
    checker: CollisionChecker, a: Configuration, b: Configuration, options: CertificateOptions = ...
) -> EdgeResult:
    """
    Prove that the straight joint-space edge from a to b is free.

    An edge that is not proved is never called free.

    Raises:
        InvalidInput: for wrong lengths or numbers that are not finite.
    """

def certify_path(
    checker: CollisionChecker,
    path: collections.abc.Sequence[Configuration],
    options: CertificateOptions = ...,
) -> EdgeResult:
    """
    All edges of a path; the result is of the first that is not free.
    """

def connected_components(mesh: TriangleMesh) -> list[TriangleMesh]:
    """
    The pieces of a mesh that share no edge.
    """

def connected_parts(region: Region) -> list[Region]:
    """
    One region per connected piece, with its holes, largest first.
    """

def contains_point(mesh: TriangleMesh, point: typing.Any) -> bool:
    """
    True if the point (3,) [m] is inside the solid.
    """

def convex_hull(points: typing.Any) -> TriangleMesh:
    """
    The convex hull of points (n, 3) [m] as a mesh.

    Raises:
        InvalidInput: E_MESH_DEGENERATE for fewer than four points or points in one plane.
    """

def cross_section(
    plane: ArmPlane, hull: SceneHull, slab: Slab, q1: float, half_width: float
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]:
    """
    What of an obstacle is in the slab at any waist angle in q1 +- half_width.

    Contains the true section.

    Args:
        plane: of the arm.
        hull: in the robot frame.
        slab: of the link.
        q1: waist angle [rad].
        half_width: 0 to pi [rad].

    Returns:
        A convex polygon (n, 2) in (x, y) of E, counter-clockwise [m]; n is 0 if the hull never reaches
        the slab.
    """

def describe_scene(checker: CollisionChecker, options: SceneOptions = ...) -> Scene:
    """
    What a checker keeps apart, as convex hulls.

    A hull contains its piece. A mesh that is not convex is given by hulls of patches of its surface.

    Raises:
        InvalidInput: for options that are not positive.
    """

def exhaust_grasps(
    model: CollisionModel,
    cell: Cell,
    part: typing.SupportsInt | typing.SupportsIndex,
    places: collections.abc.Sequence[typing.Any],
    solver: SphericalWristSolver,
    options: ExhaustionOptions = ...,
) -> Exhaustion:
    """
    Is no hand pose legal at which the jaws could hold a part where it stands?

    Hand poses on all feature pairs are cut into cells until each is proved illegal, or its centre is
    illegal with a margin. Ends at the first pose that is legal.

    Args:
        model: CollisionModel of the cell.
        cell: Cell with an empty hand.
        part: index of the part.
        places: the part in the world, (n, 4, 4); a pose must be legal at all of them.
        solver: SphericalWristSolver of the cell's robot.
        options: ExhaustionOptions.

    Returns:
        Exhaustion.

    Raises:
        InvalidInput: for no place, poses that are not rigid, an unknown part, a part in the hand, bad
            options.
    """

def diagnose_grasps(
    scene: GraspScene,
    *,
    ranking: RankingOptions = ...,
    legality: LegalityOptions = ...,
    most_poses: typing.SupportsInt | typing.SupportsIndex = 2000,
    most_pairs: typing.SupportsInt | typing.SupportsIndex = 24,
    wider: typing.SupportsFloat | typing.SupportsIndex = 0.05,
) -> Diagnosis:
    """
    What alone keeps most hand poses from being legal at both ends.

    Args:
        scene: GraspScene.
        ranking: RankingOptions.
        legality: LegalityOptions.
        most_poses: hand poses looked at.
        most_pairs: pairs of features that they are spread over, the best.
        wider: pairs are looked at that the jaws miss by so much [m].

    Returns:
        Diagnosis.

    Raises:
        InvalidInput: for a scene with a part in the hand, an unknown part, bad options.
    """

def find_feature_pairs(part: Body, gripper: Gripper, options: FeatureOptions = ...) -> FeaturePairs:
    """
    Pairs of faces, edges and vertices that a parallel jaw can hold (article, step 1).

    Args:
        part: Body.
        gripper: Gripper.
        options: FeatureOptions.

    Returns:
        FeaturePairs.

    Raises:
        InvalidInput: for a part without shapes, bad shapes or options.
    """

def find_legal_grasps(
    scene: GraspScene,
    solver: SphericalWristSolver,
    pair: RankedPair,
    options: LegalityOptions = ...,
) -> LegalGrasps:
    """
    Hand poses on a feature pair at which hand and arm are legal at both ends.

    Args:
        scene: GraspScene.
        solver: SphericalWristSolver of the scene's robot.
        pair: RankedPair.
        options: LegalityOptions.

    Returns:
        LegalGrasps.

    Raises:
        InvalidInput: for a scene with a part in the hand, an unknown part, bad options.
    """

def clears_plane(
    robot: Robot, grasps: PartGrasps, X_SP: typing.Any, options: LegalityOptions = ...
) -> numpy.typing.NDArray[numpy.bool]:
    """
    Which grasps keep the hand above the plane z = 0, with the part at X_SP.

    Args:
        robot: Robot.
        grasps: PartGrasps.
        X_SP: the part on the plane, (4, 4).
        options: LegalityOptions.

    Returns:
        Array (n,) of bool.

    Raises:
        InvalidInput: for a bad pose.
    """

def find_compatible_grasps(
    model: CollisionModel,
    cell: Cell,
    part: typing.SupportsInt | typing.SupportsIndex,
    solver: SphericalWristSolver,
    grasps: PartGrasps,
    groups: collections.abc.Sequence[
        collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]
    ],
    places: typing.Any,
    *,
    open_clearance: typing.SupportsFloat | typing.SupportsIndex = 0.008,
    clearance: typing.SupportsFloat | typing.SupportsIndex = 0.0003,
    configurations: typing.SupportsInt | typing.SupportsIndex = 2,
    most: typing.SupportsInt | typing.SupportsIndex = 0,
) -> list[CompatibleGrasps]:
    """
    Which grasps are legal with the part at some places: hand open and closing, arm, reach.

    Args:
        model: CollisionModel of the cell.
        cell: Cell with an empty hand.
        part: index in cell.parts.
        solver: SphericalWristSolver of the cell's robot.
        grasps: PartGrasps.
        groups: lists of indices, each looked at in its order until `most` of it are legal.
        places: the part in the world, (n, 4, 4).
        open_clearance: of the open pads from the faces, each side; also half and a quarter of it [m].
        clearance: of the whole robot [m].
        configurations: of the arm, per grasp: the legal ones of best margin.
        most: legal grasps per group at a place; 0 for all.

    Returns:
        List of CompatibleGrasps, one per place.

    Raises:
        InvalidInput: for a part in the hand, unknown indices, bad poses or numbers.
    """

def prove_shut_in(
    checker: CollisionChecker, X_RP: typing.Any, X_RP_goal: typing.Any, options: ShutInOptions = ...
) -> ShutIn:
    """
    Prove that a part does not come from one place to another, whoever carries it.

    A ball that the part holds would have to. What is called shut in is, with any grasp and any regrasp.
    What is not may be so all the same.

    Args:
        checker: CollisionChecker of the cell with the part held; what stands there never moves.
        X_RP: the part in the robot frame where it stands, (4, 4).
        X_RP_goal: the same where it is to stand.
        options: ShutInOptions.

    Returns:
        ShutIn.

    Raises:
        InvalidInput: for an empty hand, poses that are not rigid, options out of range.
    """

def prove_walled_off(
    checker: CollisionChecker,
    start: Configuration,
    solver: SphericalWristSolver,
    part: Body,
    X_RP: typing.Any,
    options: SeparationOptions = ...,
) -> WalledOff:
    """
    Prove that the arm does not come to where a hand that holds a part must be.

    What is called walled off is, whatever the grasp, the opening and the joints after the third do.
    What is not may be so all the same.

    Args:
        checker: CollisionChecker of the cell with an empty hand, without the part.
        start: Configuration.
        solver: SphericalWristSolver of the robot.
        part: Body; its own pose does not count.
        X_RP: the part in the robot frame, (4, 4).
        options: SeparationOptions.

    Returns:
        WalledOff.

    Raises:
        InvalidInput: for a start outside the limits, a pose that is not rigid, a part without shapes.
    """

def rank_part_alone(part: Body, robot: Robot, options: RankingOptions = ...) -> Ranking:
    """
    The feature pairs of a part that stands alone: obstructed by its own protrusions only.

    Args:
        part: Body.
        robot: Robot.
        options: RankingOptions.

    Returns:
        Ranking.

    Raises:
        InvalidInput: for a part without shapes, bad options.
    """

def reach_margins(
    cell: Cell,
    solver: SphericalWristSolver,
    grasps: PartGrasps,
    groups: collections.abc.Sequence[
        collections.abc.Sequence[typing.SupportsInt | typing.SupportsIndex]
    ],
    places: typing.Any,
) -> numpy.typing.NDArray[numpy.float64]:
    """
    How well the arm reaches the best grasp of each group with the part at some places.

    Args:
        cell: Cell.
        solver: SphericalWristSolver of the cell's robot.
        grasps: PartGrasps.
        groups: lists of indices.
        places: the part in the world, (n, 4, 4).

    Returns:
        Joint margin 0..1, -1 where none is reached: (n, groups). Collision is not looked at.

    Raises:
        InvalidInput: for unknown indices or bad poses.
    """

def sample_part_grasps(
    part: Body,
    robot: Robot,
    *,
    ranking: RankingOptions = ...,
    legality: LegalityOptions = ...,
    most: typing.SupportsInt | typing.SupportsIndex = 6000,
) -> PartGrasps:
    """
    Hand poses in the part frame that hold the part, with an eye on nothing but the part.

    Args:
        part: Body.
        robot: Robot.
        ranking: RankingOptions of its feature pairs.
        legality: LegalityOptions; directions, spacing, contact, hold and clearances count.
        most: grasps, shared evenly by pairs and directions; more where one would have none.

    Returns:
        PartGrasps.

    Raises:
        InvalidInput: for a part without shapes, bad options.
    """

def find_overlaps(
    model: CollisionModel,
    cell: Cell,
    tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.0005,
) -> list[Overlap]:
    """
    Pairs of fixtures and parts, a part among them, that overlap deeper than tolerance [m].
    """

def resting_pose(part: Body, up: typing.Any, options: RestingOptions = ...) -> RestingPose:
    """
    The part standing with `up` (3,), a direction of its own frame, upwards, stably or not.
    """

def resting_poses(part: Body, options: RestingOptions = ...) -> list[RestingPose]:
    """
    All stable resting poses of a part on a plane, the steadiest first.

    Args:
        part: Body; round shapes are polyhedra that contain them.
        options: RestingOptions.

    Returns:
        List of RestingPose; their probabilities sum up to 1.
    """

def support_faces(body: Body, options: SupportFaceOptions = ...) -> list[SupportFace]:
    """
    The upward horizontal faces of a body where it is, as SupportFace, highest first.
    """

def find_standing_places(
    model: CollisionModel,
    cell: Cell,
    part: typing.SupportsInt | typing.SupportsIndex,
    rest: RestingPose,
    face: SupportFace,
    options: StandingPlaceOptions = ...,
) -> StandingPlaces:
    """
    Where on a face can a part be put down, standing stably and clear of everything?

    Args:
        model: collision geometry of the cell.
        cell: where the other bodies are.
        part: index of the part.
        rest: RestingPose of the part.
        face: SupportFace of a body where it is.
        options: StandingPlaceOptions.

    Raises:
        InvalidInput: for options out of range, or a model of another cell.
    """

def fingertip_targets(
    unobstructed: Region,
    centre_of_mass: typing.Any,
    gripper: Gripper,
    most: typing.SupportsInt | typing.SupportsIndex = 5,
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]:
    """
    At most `most` fingertip targets in a region, best first, (n, 2) [m].
    """

def follow_hand_path(
    solver: SphericalWristSolver,
    X_RH_path: collections.abc.Sequence[typing.Any],
    q_start: typing.Any,
    options: HandPathOptions = ...,
) -> HandPathResult:
    """
    Joint configurations along hand poses, each nearest to the one before.

    Args:
        X_RH_path: poses in the robot frame, (n, 4, 4).
        q_start: (6,) [rad].
    """

def forbidden_angles(
    links: collections.abc.Iterable[typing.Any], obstacles: collections.abc.Iterable[typing.Any]
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]:
    """
    The angles at which convex polygons turned about the origin meet others. Exact.

    Args:
        links: polygons (n, 2) at angle 0 [m].
        obstacles: polygons (n, 2) [m].

    Returns:
        Rows of lower and upper limit within 0 to 2 pi, sorted (k, 2) [rad]; touching counts.

    Raises:
        InvalidInput: for polygons of fewer than three points, or numbers that are not finite.
    """

def gripper_outline(
    robot: Robot,
    opening: typing.SupportsFloat | typing.SupportsIndex,
    flipped: bool,
    depth: typing.SupportsFloat | typing.SupportsIndex = 0.25,
) -> GripperOutline:
    """
    Pieces of the fingers and of the hand's body in the grasp plane.

    Args:
        robot: Robot.
        opening: distance between the pads [m].
        flipped: the hand turned half round about its approach axis.
        depth: what lies farther behind the finger grasp point is left out [m].

    Returns:
        GripperOutline.

    Raises:
        InvalidInput: for an opening outside the gripper's, a depth that is not positive.
    """

def hand_in_plane(
    pose: PlanarPose, flipped: bool
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    The grasp frame in the plane frame, (4, 4): z_H = (cos, sin, 0), y_H = +z_G, or -z_G if flipped.
    """

def hand_in_world(
    cell: Cell, q: typing.Any
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    Grasp frame in the world, (4, 4).
    """

def cover_heights(name: str, map: HeightMap, options: DepthMapOptions = ...) -> MeasuredBody:
    """
    A height map as a fixture of few convex solids that contain it.

    Args:
        name: of the fixture.
        map: HeightMap.
        options: DepthMapOptions.

    Returns:
        MeasuredBody.
    """

def cover_depths(
    name: str, image: DepthImage, explained: typing.Any = None, options: DepthMapOptions = ...
) -> MeasuredBody:
    """
    What a depth camera saw as a fixture of few convex solids that contain it.

    Args:
        name: of the fixture.
        image: DepthImage.
        explained: (rows, columns) of booleans: taken out; None: no pixel is.
        options: DepthMapOptions.

    Returns:
        MeasuredBody.
    """

def explained_pixels(image: DepthImage, cell: Cell) -> numpy.typing.NDArray[numpy.bool]:
    """
    Which pixels are measured and lie within `explained` of a known surface?

    Args:
        image: DepthImage.
        cell: its fixtures, its parts and the robot at its start are known.

    Returns:
        (rows, columns) of booleans. Points within 1e-6 m of that limit count as farther.
    """

def reach_ball(cell: Cell) -> ReachBall:
    """
    ReachBall of the arm and what it may hold, whatever its joints do.
    """

def unfilter_png16(
    content: bytes,
    *,
    rows: typing.SupportsInt | typing.SupportsIndex,
    columns: typing.SupportsInt | typing.SupportsIndex,
) -> numpy.typing.NDArray[numpy.uint16]:
    """
    The grey values of a 16-bit PNG from its unpacked, still filtered rows: (rows, columns).
    """

def hand_pose(
    robot: Robot, q: typing.Any
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    Grasp frame in the robot frame, X_RH, shape (4, 4).

    Args:
        q: arm joints, shape (n,) [rad].
    """

def hull_points(shape: Shape) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 3]"]:
    """
    Points (n, 3) [m] in the body frame whose convex hull contains the shape.
    """

def inspect_surface(mesh: TriangleMesh) -> SurfaceReport:
    """
    What a mesh's surface is: closed, volume, box.
    """

def intersect(a: Region, b: Region) -> Region:
    """
    What two regions have in common.
    """

def is_convex(
    mesh: TriangleMesh, tolerance: typing.SupportsFloat | typing.SupportsIndex = 1e-06
) -> bool:
    """
    True if a mesh is a closed convex solid to `tolerance` [m].
    """

def largest_inscribed_circle(
    region: Region, precision: typing.SupportsFloat | typing.SupportsIndex = 0.0001
) -> InscribedCircle:
    """
    The largest circle inside a region, to `precision` [m].
    """

def limit_violation(robot: Robot, q: typing.Any) -> str:
    """
    Empty if q (n,) [rad] is within the limits (to 1e-9), else what is wrong.
    """

def load_mesh(
    path: os.PathLike[str] | str | bytes,
    *,
    scale: typing.Any = 1.0,
    must_be_closed: bool = False,
    greatest_size: typing.SupportsFloat | typing.SupportsIndex = 20.0,
) -> LoadedMesh:
    """
    Reads an STL, OBJ or PLY mesh strictly.

    Args:
        path: a regular file; what it holds decides its format.
        scale: file unit to metres, one number or one per axis.
        must_be_closed: an open surface is an error, as for parts.
        greatest_size: a larger bounding box is taken for a wrong unit [m].

    Raises:
        InvalidInput: E_PATH, E_MESH_EMPTY, E_MESH_TRUNCATED, E_MESH_FORMAT, E_NUMBER, E_RANGE, E_MESH_DEGENERATE,
            E_NOT_CLOSED, E_NOT_MANIFOLD, E_INDEX, E_TOO_BIG, E_UNITS, E_UNSUPPORTED, E_SCALE.
    """

def load_robot(urdf_path: str, description: RobotDescription) -> LoadedRobot:
    """
    Reads a URDF strictly.

    Raises:
        InvalidInput: with every fault of the file and of the description's names and numbers.
    """

def make_arm_table(robot: Robot, options: ArmTableOptions = ...) -> tuple[ArmTable | None, str]:
    """
    Read a robot's table from the directory if it is kept there, else make and keep it.

    Args:
        robot: the arm.
        options: ArmTableOptions.

    Returns:
        The table and "", or None and why the arm has none.

    Raises:
        InvalidInput: for options out of range.
    """

def make_collision_model(cell: Cell, known: CollisionModel | None = None) -> CollisionModel:
    """
    Prepare a cell's shapes for collision checking.

    Args:
        cell: the cell.
        known: a model of any cell, or None; the robot, if it is this very one, and bodies of the same
            name and shapes are taken from it.

    Raises:
        InvalidInput: for invalid cells.
    """

def make_lattice(robot: Robot, coarse: float = 0.13962634015954636) -> Lattice:
    """
    Cut the ranges of the first three joints into cells of 8, 4, 2 and 1 degree, or less.

    Args:
        robot: of three joints or more.
        coarse: widest cell of level 0 [rad].

    Raises:
        InvalidInput: for fewer joints, or a width outside 1e-4 to pi.
    """

def motion_bound(checker: CollisionChecker, a: Configuration, b: Configuration) -> float:
    """
    Upper bound on how far any point of robot and held part travels along the edge [m].
    """

def nearby_bodies(
    cell: Cell,
    part: typing.SupportsInt | typing.SupportsIndex,
    X_WP_goal: typing.Any,
    radius: typing.SupportsFloat | typing.SupportsIndex = 0.25,
) -> list[NearbyBody]:
    """
    What is near a part at its origin and at its destination, seen from the part (Figure 4).

    Args:
        cell: Cell.
        part: index in cell.parts.
        X_WP_goal: the part at its destination, (4, 4).
        radius: between bounding boxes [m].

    Returns:
        List of NearbyBody, those at the origin first.

    Raises:
        InvalidInput: for an unknown part, a bad pose or radius.
    """

def offset(region: Region, delta: typing.SupportsFloat | typing.SupportsIndex) -> Region:
    """
    A region grown (delta > 0) or shrunk by delta [m], corners mitred: grown, it contains the true offset.
    """

def pad_contact_area(region: Region, pose: PlanarPose, gripper: Gripper) -> float:
    """
    Area of one pad on a region of the grasp plane, the hand at a PlanarPose [m2].
    """

def plan_approach(
    scene: GraspScene,
    solver: SphericalWristSolver,
    pair: RankedPair,
    aim: GraspPose,
    q_pick: typing.Any,
    options: ApproachOptions = ...,
) -> ApproachResult:
    """
    Plan how the open hand comes to a grasp: step 4 of the article.

    The hand slides in the grasp plane from a start off the part to the fingertip target, the arm follows.
    Incomplete: a slide may stall; then other starts are taken.

    Args:
        scene: GraspScene.
        solver: SphericalWristSolver of the scene's robot.
        pair: RankedPair whose grasp plane is slid in.
        aim: GraspPose to reach; where the slide stops short of it, the stop is tested as a grasp.
        q_pick: (joints,) one of aim.q_pick; the arm stays in its branch [rad].
        options: ApproachOptions.

    Returns:
        ApproachResult.

    Raises:
        InvalidInput: for options out of range, a hand that is not empty, a q_pick not at the aim.
    """

def plan_by_sampling(
    checker: CollisionChecker,
    start: Configuration,
    goals: collections.abc.Sequence[Configuration],
    options: SamplingOptions = ...,
) -> MotionResult:
    """
    Plan a motion by RRT-Connect over all joints, every edge certified.

    Args:
        checker: CollisionChecker of the cell, with what is held.
        start: Configuration.
        goals: list of Configuration with the start's opening; any of them will do.
        options: SamplingOptions; the same seed gives the same path.

    Returns:
        MotionResult.

    Raises:
        InvalidInput: for no goal, wrong lengths, numbers or options, configurations outside the limits.
    """

def join_destination(
    scene: GraspScene, radius: typing.SupportsFloat | typing.SupportsIndex = 0.4
) -> JoinedScene:
    """
    The article's obstacles: those near the destination, moved by T^-1, join the origin's.

    Args:
        scene: GraspScene.
        radius: of bodies within that distance of the part's bounding box copies are made [m].

    Returns:
        JoinedScene.

    Raises:
        InvalidInput: for a part that the scene does not have, a radius out of range.
    """

def plan_departure(
    checker: CollisionChecker,
    solver: SphericalWristSolver,
    start: Configuration,
    options: DepartureOptions = ...,
) -> DepartureResult:
    """
    The way out in the grasp plane, for a hand that holds a part or is open round one.

    The planners of the approach with the held part as part of the hand: the slide in from where there is room,
    driven backwards; then the complete search in (x, y, theta). A way out of the plane is not looked for.

    Args:
        checker: CollisionChecker of the cell with what is held.
        solver: SphericalWristSolver of the robot.
        start: Configuration, free; its hand's x and z axes span the plane.
        options: DepartureOptions.

    Returns:
        DepartureResult.

    Raises:
        InvalidInput: for wrong lengths, numbers or options, a start that is not free.
    """

def plan_gross_motion(
    checker: CollisionChecker,
    start: Configuration,
    goals: collections.abc.Sequence[Configuration],
    options: GrossOptions = ...,
) -> MotionResult:
    """
    Plan a gross motion: straight if free, else through slices, else by sampling; then shortened.

    Where sampling gives no way either, a proof that there is none is tried.

    The goal nearest by travel time is tried first; goals in collision are left out.

    Args:
        checker: CollisionChecker of the cell, with what is held.
        start: Configuration.
        goals: list of Configuration with the start's opening; any of them will do.
        options: GrossOptions.

    Returns:
        MotionResult.

    Raises:
        InvalidInput: for no goal, wrong lengths, numbers or options, configurations outside the limits.
    """

def plan_retreat(
    in_contact: CollisionChecker,
    clear: CollisionChecker,
    solver: SphericalWristSolver,
    start: Configuration,
    direction: typing.Any,
    options: RetreatOptions = ...,
) -> RetreatResult:
    """
    Move the hand straight out of contact, with what it holds.

    The first short step may touch what was touched before, if no contact deepens; from there on every edge is
    certified against everything. Reversed it is a deposit.

    Args:
        in_contact: CollisionChecker with the contacts allowed; may be the same as clear.
        clear: CollisionChecker without them.
        solver: SphericalWristSolver of the robot.
        start: Configuration in contact.
        direction: (3,) unit vector of the hand's motion in the world.
        options: RetreatOptions.

    Returns:
        RetreatResult.

    Raises:
        InvalidInput: for wrong lengths, numbers or options.
    """

def planar_faces(
    mesh: TriangleMesh,
    *,
    angle: typing.SupportsFloat | typing.SupportsIndex = 0.001,
    distance: typing.SupportsFloat | typing.SupportsIndex = 1e-05,
    least_area: typing.SupportsFloat | typing.SupportsIndex = 0.0,
) -> list[PlanarFace]:
    """
    The planar faces of a solid, largest first.

    Args:
        mesh: a welded mesh.
        angle: most a triangle's normal leaves the face's [rad].
        distance: most a vertex leaves the face's plane [m].
        least_area: smaller faces are left out [m2].

    Raises:
        InvalidInput: E_RANGE for negative or non-finite options.
    """

def planar_slice(
    arm: PlanarArm, obstacles: collections.abc.Iterable[typing.Any], theta2: typing.Any
) -> list[typing.Annotated[numpy.typing.NDArray[numpy.float64], "[m, 2]"]]:
    """
    The forbidden angles of the lower link, column by column of the upper's. Exact.

    Args:
        arm: two links.
        obstacles: convex polygons (n, 2), from the shoulder [m].
        theta2: angles of the upper link (m,) [rad].

    Returns:
        Per angle rows of lower and upper limit of theta3 within 0 to 2 pi, (k, 2) [rad]; the whole
        circle where the upper link itself meets an obstacle.
    """

def pose_from_xyz_quat(
    xyz: typing.Any, quat_xyzw: typing.Any
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    A pose from a position and a unit quaternion.

    Args:
        xyz: position (3,) [m].
        quat_xyzw: quaternion x, y, z, w, of norm 1 within 1e-3.

    Returns:
        4 x 4 matrix.

    Raises:
        InvalidInput: E_NUMBER, E_QUATERNION.
    """

def pose_from_xyz_rpy(
    xyz: typing.Any, rpy: typing.Any
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 4]"]:
    """
    A pose from a position and roll, pitch, yaw about the fixed axes.

    Args:
        xyz: position (3,) [m].
        rpy: roll, pitch, yaw (3,) [rad]; R = Rz(yaw) Ry(pitch) Rx(roll).

    Returns:
        4 x 4 matrix.

    Raises:
        InvalidInput: E_NUMBER if a number is not finite.
    """

def prove_apart(
    checker: CollisionChecker,
    start: Configuration,
    goals: collections.abc.Sequence[Configuration],
    options: SeparationOptions = ...,
) -> Separation:
    """
    Prove that no path leads from start to goal, whatever the joints after the third do.

    What is called apart is apart. What is not may be so all the same.

    Args:
        checker: CollisionChecker of the cell, with what is held.
        start: Configuration.
        goals: list of Configuration with the start's opening.
        options: SeparationOptions.

    Returns:
        Separation.

    Raises:
        InvalidInput: for no goal, wrong lengths, numbers or options, configurations outside the limits.
    """

def quaternion_xyzw(
    pose: typing.Any,
) -> typing.Annotated[numpy.typing.NDArray[numpy.float64], "[4, 1]"]:
    """
    The rotation of a 4 x 4 pose as a unit quaternion (x, y, z, w), w >= 0.
    """

def rank_grasps(
    cell: Cell,
    part: typing.SupportsInt | typing.SupportsIndex,
    X_WP_goal: typing.Any,
    options: RankingOptions = ...,
    *,
    features: FeaturePairs | None = None,
) -> Ranking:
    """
    Rank a part's feature pairs by what stays unobstructed at both ends (article, steps 1-3).

    Args:
        cell: Cell.
        part: index in cell.parts.
        X_WP_goal: the part at its destination, (4, 4).
        options: RankingOptions.
        features: FeaturePairs of the part found before, or None; then options.features is not used.

    Returns:
        Ranking.

    Raises:
        InvalidInput: for an unknown part, a bad pose or bad options.
    """

def robot_overlaps(
    checker: CollisionChecker,
    configuration: Configuration,
    tolerance: typing.SupportsFloat | typing.SupportsIndex = 0.0005,
) -> list[Hit]:
    """
    Pairs of robot or held part and others that overlap deeper than tolerance [m].
    """

def run_within(
    function: collections.abc.Callable[[], typing.Any],
    *,
    cancel: CancelToken | None = None,
    deadline: typing.SupportsFloat | typing.SupportsIndex | None = None,
    progress: collections.abc.Callable[[str], typing.Any] | None = None,
) -> typing.Any:
    """
    Calls a function; the stages that it calls in this thread can be stopped.

    Args:
        function: without arguments.
        cancel: a token that another thread may cancel.
        deadline: seconds from now after which all stops.
        progress: told how far a long stage is, as text: "window 2 of 5".

    Returns:
        What the function returns.

    Raises:
        Stopped: out of the stage that was stopped, through the function.
    """

def search_free_space(
    checker: CollisionChecker,
    start: Configuration,
    goals: collections.abc.Sequence[Configuration],
    slices: FreeSpaceOptions = ...,
    options: SearchOptions = ...,
) -> SearchResult:
    """
    Search the slices of a gross motion for a way: not shortened yet.

    Args:
        checker: CollisionChecker of the cell, with what is held.
        start: Configuration.
        goals: list of Configuration with the start's opening; any of them will do.
        slices: FreeSpaceOptions.
        options: SearchOptions.

    Returns:
        SearchResult.

    Raises:
        InvalidInput: for arms of fewer than three joints, wrong lengths or options.
    """

def shorten_path(
    checker: CollisionChecker,
    path: collections.abc.Sequence[Configuration],
    options: ShortcutOptions = ...,
) -> list[Configuration]:
    """
    Shorten a certified path; same ends, never longer, every new edge certified.

    A new edge keeps options.clearance from everything, except where the path itself is nearer, at its
    ends or in a passage: there it stays at least half as far away as the path does.

    Args:
        checker: CollisionChecker of the cell, with what is held.
        path: list of Configuration.
        options: ShortcutOptions; the same seed gives the same result.

    Returns:
        List of Configuration.

    Raises:
        InvalidInput: for an empty path, wrong lengths, numbers or options, waypoints outside the limits.
    """

def slab_projection(
    shape: Shape,
    X_GB: typing.Any,
    lower: typing.SupportsFloat | typing.SupportsIndex,
    upper: typing.SupportsFloat | typing.SupportsIndex,
) -> Region:
    """
    What of a shape lies between two planes, seen along their normal.

    Args:
        shape: the shape; a solid's inside counts.
        X_GB: the shape's body in the frame whose z is the normal, 4 x 4.
        lower: [m]
        upper: [m]

    Returns:
        Region in x, y of G; contains the true projection to 1e-6 m.
    """

def slide_along(
    grid: MotionGrid,
    outline: GripperOutline,
    start: PlanarPose,
    route: typing.Any,
    reachable: typing.Any = None,
    options: QuasipotentialOptions = ...,
) -> SlideResult:
    """
    Slide the gripper with an attraction point that moves along a route.

    As slide_to_target; clearance_path gives good routes.

    Args:
        grid: MotionGrid with one layer for each piece of the outline.
        outline: GripperOutline.
        start: PlanarPose.
        route: (n, 2) points on the grid, the last one the target [m].
        reachable: as of slide_to_target.
        options: QuasipotentialOptions; `lead` tells how far ahead the attraction point is.

    Returns:
        SlideResult.

    Raises:
        InvalidInput: as slide_to_target.
    """

def slide_to_target(
    grid: MotionGrid,
    outline: GripperOutline,
    start: PlanarPose,
    target: typing.Any,
    reachable: typing.Any = None,
    options: QuasipotentialOptions = ...,
) -> SlideResult:
    """
    Slide the gripper from a start toward a target: the article's quasipotential method.

    Bump lines that touch filled cells forbid motion their way and turn the gripper. May stall in a local
    minimum, and says so. No pose of the path has a piece of the gripper on a filled cell.

    Args:
        grid: MotionGrid with one layer for each piece of the outline.
        outline: GripperOutline.
        start: PlanarPose.
        target: (2,) where the finger grasp point is to go [m].
        reachable: called with each PlanarPose before it is taken; on False another direction is tried. What
            it raises is raised here. None: everything is reachable.
        options: QuasipotentialOptions.

    Returns:
        SlideResult.

    Raises:
        InvalidInput: if start or target lie outside the grid, layers and pieces differ in number, or an
            option is out of range.
    """

def subtract(a: Region, b: Region) -> Region:
    """
    Region a without region b.
    """

def tessellate(
    shape: Shape, segments: typing.SupportsInt | typing.SupportsIndex = 32, outer: bool = True
) -> TriangleMesh:
    """
    A shape as a closed triangle mesh in the body frame.

    Args:
        shape: the shape.
        segments: sides of cylinders and spheres.
        outer: True: the polyhedron contains the round shape; False: it is contained in it.
    """

def test_grasp_pose(
    scene: GraspScene,
    solver: SphericalWristSolver,
    pair: RankedPair,
    pose: PlanarPose,
    flipped: bool,
    options: LegalityOptions = ...,
) -> LegalGrasps:
    """
    Is one hand pose of a pair legal at both ends?

    Args:
        scene: GraspScene.
        solver: SphericalWristSolver of the scene's robot.
        pair: RankedPair.
        pose: PlanarPose.
        flipped: the hand is turned half round.
        options: LegalityOptions.

    Returns:
        LegalGrasps with at most one pose.

    Raises:
        InvalidInput: as find_legal_grasps.
    """

def throw_if_stopped() -> None:
    """
    Raise `Stopped` if what this thread runs within is to stop.
    """

def time_path(
    robot: Robot, path: collections.abc.Sequence[Configuration], options: TimingOptions = ...
) -> TimedPath:
    """
    Time a path: the shortest time along the polyline within the limits.

    The rows lie exactly on the polyline, every corner is a row, the motion starts and ends at rest.

    Args:
        robot: whose velocity and acceleration limits hold.
        path: list of Configuration; waypoints that repeat the one before are dropped.
        options: TimingOptions.

    Returns:
        TimedPath.

    Raises:
        InvalidInput: for an empty path, wrong lengths, numbers or options, or a path outside the limits.
    """

def torus_of(plane: ArmPlane, hull: SceneHull, slab: Slab) -> list[Torus]:
    """
    The article's obstacles: for each window of waist angles at which a hull can reach the
    slab, one section that contains those of all its angles.
    """

def touching_bodies(
    model: CollisionModel,
    cell: Cell,
    part: typing.SupportsInt | typing.SupportsIndex,
    gap: typing.SupportsFloat | typing.SupportsIndex = 0.0006,
) -> list[BodyRef]:
    """
    The bodies that a part touches where it stands, or nearly: within gap [m].
    """

def travel_time(robot: Robot, path: collections.abc.Sequence[Configuration]) -> float:
    """
    Least time along a path at the velocity limits alone, sum of max_j |dq_j| / v_j [s].

    Args:
        robot: whose velocity limits hold.
        path: list of Configuration.

    Returns:
        Seconds; never more than time_path takes.
    """

def unite(regions: collections.abc.Sequence[Region]) -> Region:
    """
    The union of regions.
    """

__version__: str = "0.1.0"

def prove_layer(
    checker: CollisionChecker,
    theta1: typing.SupportsFloat | typing.SupportsIndex,
    wrist: WristRange,
    opening: typing.SupportsFloat | typing.SupportsIndex,
    options: LayerOptions = ...,
) -> SliceLayer:
    """
    Look at one layer of a slice: which cells are proved free, and which collide.

    A cell called free is free for every configuration in it and every wrist value of the range.

    Args:
        checker: of the cell, with what is held.
        theta1: any waist angle of the layer [rad].
        wrist: WristRange.
        opening: distance between the pads [m].
        options: LayerOptions.

    Returns:
        SliceLayer.

    Raises:
        InvalidInput: for a waist angle outside its limits, a wrist range of the wrong length or not in
            order, an opening that is not the gripper's, or options out of range.
    """

def find_enclosing(
    checker: CollisionChecker,
    solver: SphericalWristSolver,
    start: Configuration,
    distance: typing.SupportsFloat | typing.SupportsIndex = 0.1,
) -> list[Hit]:
    """
    What stands round the hand where it is: what it meets that leaves along straight lines.

    Args:
        checker: CollisionChecker of the cell, with what is held.
        solver: SphericalWristSolver of the cell's robot.
        start: Configuration.
        distance: length of the lines [m].

    Returns:
        Hits, those first that end most of the lines.

    Raises:
        InvalidInput: for wrong lengths or numbers out of range.
    """

def find_hits_along(
    checker: CollisionChecker,
    a: Configuration,
    b: Configuration,
    samples: typing.SupportsInt | typing.SupportsIndex = 64,
) -> list[Hit]:
    """
    What is met on the straight joint edge between two configurations.

    Args:
        checker: CollisionChecker of the cell, with what is held.
        a: Configuration.
        b: Configuration.
        samples: configurations looked at.

    Returns:
        Hits, those first that are met at most of them.

    Raises:
        InvalidInput: for wrong lengths or numbers out of range.
    """
