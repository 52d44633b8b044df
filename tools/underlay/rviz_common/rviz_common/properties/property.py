# SPDX-License-Identifier: Apache-2.0
"""What can be set of a display, a tool or a view, as data."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Any

__all__ = [
    'Choice',
    'ColorOf',
    'Flag',
    'Frame',
    'Number',
    'Property',
    'Text',
    'Topic',
    'Vector',
    'Whole',
]


@dataclass(frozen=True)
class Property:
    """Something that can be set; a `/` in its path leads below another one, as in the file."""

    path: str
    default: Any
    description: str = ''

    def read(self, value: Any) -> Any:
        """Return the value that a file or a widget gives, or raise ValueError with the reason."""
        return value

    def write(self, value: Any) -> Any:
        """Return the value as the file has it."""
        return value


@dataclass(frozen=True)
class Flag(Property):
    """Yes or no."""

    def read(self, value: Any) -> bool:
        """Return the value, or raise ValueError."""
        if not isinstance(value, bool):
            raise ValueError(f"must be true or false, and not '{value}'")
        return value


@dataclass(frozen=True)
class Number(Property):
    """A number with limits."""

    minimum: float = -math.inf
    maximum: float = math.inf

    def read(self, value: Any) -> float:
        """Return the value, or raise ValueError."""
        if isinstance(value, bool) or not isinstance(value, (int, float)) or value != value:
            raise ValueError(f"must be a number, and not '{value}'")
        if not self.minimum <= value <= self.maximum:
            raise ValueError(f'must be from {self.minimum:g} to {self.maximum:g}, and not {value}')
        return float(value)

    def write(self, value: Any) -> Any:
        """Return a whole number without its point, as RViz writes it."""
        return int(value) if float(value).is_integer() else value


@dataclass(frozen=True)
class Whole(Number):
    """A whole number with limits."""

    def read(self, value: Any) -> int:
        """Return the value, or raise ValueError."""
        number = super().read(value)
        if not number.is_integer():
            raise ValueError(f'must be a whole number, and not {value}')
        return int(number)


@dataclass(frozen=True)
class Text(Property):
    """Any text."""

    def read(self, value: Any) -> str:
        """Return the value, which YAML may have taken for something else."""
        return '' if value is None else str(value)


@dataclass(frozen=True)
class Frame(Text):
    """The name of a frame, or `<Fixed Frame>`."""


@dataclass(frozen=True)
class Topic(Text):
    """The name of a topic of a type, such as `nav_msgs/msg/Path`."""

    type_name: str = ''


@dataclass(frozen=True)
class Choice(Text):
    """One of some texts."""

    choices: tuple[str, ...] = ()

    def read(self, value: Any) -> str:
        """Return the value, or raise ValueError."""
        if value not in self.choices:
            raise ValueError(f"must be one of {', '.join(self.choices)}, and not '{value}'")
        return str(value)


@dataclass(frozen=True)
class ColorOf(Property):
    """Red, green and blue, each from 0 to 255."""

    def read(self, value: Any) -> tuple[int, int, int]:
        """Return the value, which a file has as `255; 0; 0`, or raise ValueError."""
        words = value.split(';') if isinstance(value, str) else value
        try:
            red, green, blue = (int(word) for word in words)
        except (TypeError, ValueError):
            raise ValueError(f"must be like '255; 0; 0', and not '{value}'") from None
        if not all(0 <= part <= 255 for part in (red, green, blue)):
            raise ValueError(f"must have numbers from 0 to 255, and not '{value}'")
        return red, green, blue

    def write(self, value: Any) -> str:
        """Return the value as the file has it."""
        return '; '.join(str(part) for part in value)


@dataclass(frozen=True)
class Vector(Property):
    """Three numbers: x, y and z."""

    def read(self, value: Any) -> tuple[float, float, float]:
        """Return the value, which a file has as X, Y and Z, or raise ValueError."""
        parts = [value.get(axis, 0.0) for axis in 'XYZ'] if isinstance(value, dict) else value
        try:
            x, y, z = (float(part) for part in parts)
        except (TypeError, ValueError):
            raise ValueError(f"must be three numbers, and not '{value}'") from None
        if not all(map(math.isfinite, (x, y, z))):
            raise ValueError(f"must be three finite numbers, and not '{value}'")
        return x, y, z

    def write(self, value: Any) -> dict[str, Any]:
        """Return the value as the file has it."""
        number = Number('', 0.0)
        return {axis: number.write(part) for axis, part in zip('XYZ', value)}
