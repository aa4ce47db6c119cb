"""Reads single values of the files: numbers, vectors, poses; and the strict mapping they come in.

Every reader takes the place of its value in the file, so that a fault names it. Method: PyYAML's
safe loader without aliases and duplicate keys; numbers written 1e-3 (a string in YAML 1.1) are
numbers.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
import yaml

from handey.errors import Fault, InvalidInput

__all__ = [
    "Array", "fault", "keys", "load_yaml", "number", "pose", "positive", "rpy_matrix", "text",
    "vector",
]  # fmt: skip

Array = npt.NDArray[np.float64]
MAX_BYTES = 16 * 2**20
_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")


def fault(code: str, file: str, place: str, message: str) -> InvalidInput:
    """The exception for one fault."""
    return InvalidInput(Fault(code, place, message, file))


class _Loader(yaml.SafeLoader):
    """Safe, and without the surprises: no aliases, no duplicate keys."""

    def compose_node(self, parent: Any, index: Any) -> Any:
        if self.check_event(yaml.events.AliasEvent):
            raise yaml.YAMLError("aliases are not allowed")
        return super().compose_node(parent, index)

    def construct_mapping(self, node: Any, deep: bool = False) -> Any:
        seen = set()
        for key, _ in node.value:
            if key.value in seen:
                raise yaml.YAMLError(
                    f"duplicate key '{key.value}' (line {key.start_mark.line + 1})"
                )
            seen.add(key.value)
        return super().construct_mapping(node, deep)


# `on`, `off`, `yes` and `no` are words: `on` is a key of a goal. Only true and false are not.
_Loader.yaml_implicit_resolvers = {
    letter: [rule for rule in rules if rule[0] != "tag:yaml.org,2002:bool" or letter in "tTfF"]
    for letter, rules in yaml.SafeLoader.yaml_implicit_resolvers.items()
}


def load_yaml(path: Path) -> dict[str, Any]:
    """The mapping in a YAML file.

    Raises:
        InvalidInput: if it cannot be read or is no mapping.
    """
    try:
        if path.stat().st_size > MAX_BYTES:
            raise fault("E_TOO_BIG", str(path), "", f"larger than {MAX_BYTES} bytes")
        content = yaml.load(path.read_text(encoding="utf-8"), Loader=_Loader)
    except (OSError, UnicodeDecodeError) as error:
        raise fault("E_PATH", str(path), "", f"cannot be read: {error}") from error
    except (yaml.YAMLError, RecursionError) as error:
        raise fault("E_YAML", str(path), "", " ".join(str(error).split())) from error
    if not isinstance(content, dict):
        raise fault("E_YAML", str(path), "", "expected a mapping")
    return content


def keys(
    value: Any, file: str, place: str, required: Iterable[str] = (), optional: Iterable[str] = ()
) -> dict[str, Any]:
    """`value` as a mapping with these keys and no others."""
    if not isinstance(value, Mapping):
        raise fault("E_TYPE", file, place, f"expected a mapping, found {value!r:.60}")
    required, optional = list(required), list(optional)
    for key in required:
        if key not in value:
            raise fault("E_MISSING", file, f"{place}.{key}".lstrip("."), "required, but missing")
    for key in value:
        if key not in required and key not in optional:
            legal = ", ".join([*required, *optional])
            raise fault(
                "E_UNKNOWN_KEY", file, f"{place}.{key}".lstrip("."), f"unknown key; legal: {legal}"
            )
    return dict(value)


def text(value: Any, file: str, place: str) -> str:
    """A string that is not empty."""
    if not isinstance(value, str) or not value:
        raise fault("E_TYPE", file, place, f"expected a name, found {value!r:.60}")
    return value


def number(value: Any, file: str, place: str) -> float:
    """A finite number."""
    if isinstance(value, str) and _NUMBER.fullmatch(value.strip()):
        value = float(value)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise fault("E_TYPE", file, place, f"expected a number, found {value!r:.60}")
    if not math.isfinite(value):
        raise fault("E_NUMBER", file, place, f"expected a finite number, found {value}")
    return float(value)


def positive(value: Any, file: str, place: str) -> float:
    """A number above zero."""
    result = number(value, file, place)
    if result <= 0:
        raise fault("E_RANGE", file, place, f"expected a number above 0, found {result}")
    return result


def vector(value: Any, length: int, file: str, place: str) -> Array:
    """A list of `length` finite numbers."""
    if not isinstance(value, (list, tuple)) or len(value) != length:
        raise fault("E_TYPE", file, place, f"expected {length} numbers, found {value!r:.60}")
    return np.array([number(x, file, f"{place}[{i}]") for i, x in enumerate(value)])


def rpy_matrix(roll: float, pitch: float, yaw: float) -> Array:
    """Rotation by roll, pitch, yaw about the fixed x, y, z axes, in that order (3, 3)."""
    (cr, cp, cy), (sr, sp, sy) = np.cos([roll, pitch, yaw]), np.sin([roll, pitch, yaw])
    return np.array(
        [
            [cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
            [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr],
            [-sp, cp * sr, cp * cr],
        ]
    )


def _quaternion_matrix(q: Array) -> Array:
    x, y, z, w = q
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
    )


def pose(value: Any, file: str, place: str) -> Array:
    """A pose as a homogeneous matrix (4, 4)."""
    result = np.eye(4)
    if value is None:
        return result
    value = keys(value, file, place, optional=("xyz", "rpy", "quat_xyzw"))
    if "rpy" in value and "quat_xyzw" in value:
        raise fault("E_TYPE", file, place, "expected rpy or quat_xyzw, found both")
    if "xyz" in value:
        result[:3, 3] = vector(value["xyz"], 3, file, f"{place}.xyz")
    if "rpy" in value:
        result[:3, :3] = rpy_matrix(*vector(value["rpy"], 3, file, f"{place}.rpy"))
    if "quat_xyzw" in value:
        q = vector(value["quat_xyzw"], 4, file, f"{place}.quat_xyzw")
        norm = float(np.linalg.norm(q))
        if abs(norm - 1) > 1e-3:
            raise fault(
                "E_QUATERNION", file, f"{place}.quat_xyzw", f"expected norm 1, found {norm:.6g}"
            )
        result[:3, :3] = _quaternion_matrix(q / norm)
    return result
