"""Options of the compiled core with some fields changed: they are values, without `replace`."""

from __future__ import annotations

from typing import Any, TypeVar

__all__ = ["with_fields"]

Options = TypeVar("Options")


def with_fields(options: Options, **changes: Any) -> Options:
    """The same options but for some fields.

    Raises:
        TypeError: if they have no such field.
    """
    kind = type(options)
    names = [name for name, it in vars(kind).items() if isinstance(it, property)]
    return kind(**({name: getattr(options, name) for name in names} | changes))
