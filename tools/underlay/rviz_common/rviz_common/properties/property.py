# SPDX-License-Identifier: Apache-2.0
"""The properties of displays, tools and views, as data."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import Any

__all__ = [
    'Choice',
    'ColorOf',
    'Flag',
    'Flags',
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
    """A property; a `/` in its path nests it below another one, as in the file."""

    path: str
    default: Any
    description: str = ''

    def read(self, value: Any) -> Any:
        """
        Validate a value from a file or a widget, and convert it.

        Parameters
        ----------
        value
            The value, as read from YAML or from a widget of the page.

        Raises
        ------
        ValueError
            The value is invalid. The message continues after the name of the property, such as
            "must be a number, not 'x'".

        """
        return value

    def write(self, value: Any) -> Any:
        """
        Convert a value to the form that it has in a .rviz file.

        Parameters
        ----------
        value
            The value of the property, as `read` returns it.

        """
        return value


@dataclass(frozen=True)
class Flag(Property):
    """A boolean property."""

    def read(self, value: Any) -> bool:
        """
        Validate a boolean.

        Parameters
        ----------
        value
            True or False; no other value is accepted.

        Raises
        ------
        ValueError
            As for `Property.read`.

        """
        if not isinstance(value, bool):
            raise ValueError(f"must be true or false, not '{value}'")
        return value


@dataclass(frozen=True)
class Flags(Property):
    """A boolean for each of some names discovered at run time, such as namespaces."""

    def read(self, value: Any) -> dict[str, bool]:
        """
        Validate booleans by name.

        Parameters
        ----------
        value
            A dict of names to True or False.

        Raises
        ------
        ValueError
            As for `Property.read`.

        """
        if not isinstance(value, dict):
            raise ValueError(f"must be true or false for each of some names, not '{value}'")
        flag = Flag('', True)
        return {str(name): flag.read(each) for name, each in value.items()}


@dataclass(frozen=True)
class Number(Property):
    """A number with limits."""

    minimum: float = -math.inf
    maximum: float = math.inf

    def read(self, value: Any) -> float:
        """
        Validate a number.

        Parameters
        ----------
        value
            An int or float from `minimum` to `maximum`; bool and NaN are rejected.

        Raises
        ------
        ValueError
            As for `Property.read`.

        """
        if isinstance(value, bool) or not isinstance(value, (int, float)) or value != value:
            raise ValueError(f"must be a number, not '{value}'")
        if not self.minimum <= value <= self.maximum:
            raise ValueError(f'must be from {self.minimum:g} to {self.maximum:g}, not {value}')
        return float(value)

    def write(self, value: Any) -> Any:
        """
        Convert a whole number to int, since RViz writes those without a decimal point.

        Parameters
        ----------
        value
            As for `Property.write`.

        """
        return int(value) if float(value).is_integer() else value


@dataclass(frozen=True)
class Whole(Number):
    """A whole number with limits."""

    def read(self, value: Any) -> int:
        """
        Validate a whole number.

        Parameters
        ----------
        value
            An int, or a float without a fraction, from `minimum` to `maximum`.

        Raises
        ------
        ValueError
            As for `Property.read`.

        """
        number = super().read(value)
        if not number.is_integer():
            raise ValueError(f'must be a whole number, not {value}')
        return int(number)


@dataclass(frozen=True)
class Text(Property):
    """Any text."""

    def read(self, value: Any) -> str:
        """
        Convert a value to text, as YAML may have parsed it as a number, a boolean or null.

        Parameters
        ----------
        value
            Anything; None becomes ''.

        """
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
        """
        Validate a text as one of the choices.

        Parameters
        ----------
        value
            The text, exactly as in `choices`.

        Raises
        ------
        ValueError
            As for `Property.read`.

        """
        if value not in self.choices:
            raise ValueError(f"must be one of {', '.join(self.choices)}, not '{value}'")
        return str(value)


@dataclass(frozen=True)
class ColorOf(Property):
    """Red, green and blue, each from 0 to 255."""

    def read(self, value: Any) -> tuple[int, int, int]:
        """
        Validate a colour.

        Parameters
        ----------
        value
            A text such as `255; 0; 0`, as in .rviz files, or three numbers.

        Returns
        -------
        tuple[int, int, int]
            Red, green and blue, each from 0 to 255.

        Raises
        ------
        ValueError
            As for `Property.read`.

        """
        try:
            words = value.split(';') if isinstance(value, str) else value
            red, green, blue = (int(word) for word in words)
        except (TypeError, ValueError):
            raise ValueError(f"must be like '255; 0; 0', not '{value}'") from None
        if not all(0 <= part <= 255 for part in (red, green, blue)):
            raise ValueError(f"must have numbers from 0 to 255, not '{value}'")
        return red, green, blue

    def write(self, value: Any) -> str:
        """
        Format a colour as in .rviz files, such as `255; 0; 0`.

        Parameters
        ----------
        value
            Red, green and blue, each from 0 to 255.

        """
        return '; '.join(str(part) for part in value)


@dataclass(frozen=True)
class Vector(Property):
    """Three numbers: x, y and z."""

    def read(self, value: Any) -> tuple[float, float, float]:
        """
        Validate a vector.

        Parameters
        ----------
        value
            A dict with X, Y and Z, as in .rviz files, each 0 if missing; or three numbers.

        Returns
        -------
        tuple[float, float, float]
            x, y and z, all finite.

        Raises
        ------
        ValueError
            As for `Property.read`.

        """
        parts = [value.get(axis, 0.0) for axis in 'XYZ'] if isinstance(value, dict) else value
        try:
            x, y, z = (float(part) for part in parts)
        except (TypeError, ValueError):
            raise ValueError(f"must be three numbers, not '{value}'") from None
        if not all(map(math.isfinite, (x, y, z))):
            raise ValueError(f"must be three finite numbers, not '{value}'")
        return x, y, z

    def write(self, value: Any) -> dict[str, Any]:
        """
        Convert a vector to a dict with X, Y and Z, as in .rviz files.

        Parameters
        ----------
        value
            x, y and z.

        """
        number = Number('', 0.0)
        return {axis: number.write(part) for axis, part in zip('XYZ', value)}
