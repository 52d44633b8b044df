# SPDX-License-Identifier: Apache-2.0
"""A robot as a URDF describes it: links, and the joints between them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
DRIVEN_KINDS = ('revolute', 'continuous', 'prismatic')


@dataclass(frozen=True, eq=False)
class Body:
    """Inertial parameters: mass, pose of the CoM in the link, inertia in the axes of that pose."""

    mass_kg: float
    pose: Array
    inertia_kgm2: Array


@dataclass(frozen=True, eq=False)
class Shape:
    """A box (three edges), cylinder (radius, length), sphere (radius) or mesh (scale; a file)."""

    kind: str
    size_m: tuple[float, ...]
    pose: Array
    file: str = ''


@dataclass(frozen=True, eq=False)
class Link:
    """A rigid link; without a body it is a mere frame."""

    name: str
    body: Body | None = None
    visuals: tuple[Shape, ...] = ()
    collisions: tuple[Shape, ...] = ()
    line: int | None = None


@dataclass(frozen=True)
class Limits:
    """Position limits of a joint in rad or m, effort and velocity limits; None if not given."""

    lower: float
    upper: float
    effort: float | None
    velocity: float | None


@dataclass(frozen=True)
class Mimic:
    """How a joint mimics another: by a multiplier of its position, and an offset in rad or m."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, eq=False)
class Joint:
    """A joint; its pose is that of the child link in the parent link at position zero."""

    name: str
    kind: str
    parent: str
    child: str
    pose: Array
    axis: Array
    limits: Limits | None = None
    mimics: Mimic | None = None
    line: int | None = None

    @property
    def is_driven(self) -> bool:
        """Whether the joint is revolute, continuous or prismatic."""
        return self.kind in DRIVEN_KINDS


@dataclass(frozen=True)
class Robot:
    """Links and joints, in the order of the file; they are not validated."""

    name: str
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    folder: Path = Path()

    @cached_property
    def link(self) -> dict[str, Link]:
        """Return the links by name."""
        return {link.name: link for link in self.links}

    @cached_property
    def joint(self) -> dict[str, Joint]:
        """Return the joints by name."""
        return {joint.name: joint for joint in self.joints}

    @cached_property
    def joint_above(self) -> dict[str, Joint]:
        """Return the parent joint of each link but the root, by the name of the link."""
        return {joint.child: joint for joint in self.joints}

    @cached_property
    def roots(self) -> tuple[str, ...]:
        """Return the names of the links without a parent joint."""
        return tuple(link.name for link in self.links if link.name not in self.joint_above)

    @cached_property
    def prefix(self) -> str:
        """Return the prefix of all names, if the root is a `base_link`; otherwise empty."""
        root = self.roots[0] if self.roots else ''
        return root.removesuffix('base_link') if root.endswith('base_link') else ''

    @cached_property
    def mass_kg(self) -> float:
        """Return the total mass of all links."""
        return sum(link.body.mass_kg for link in self.links if link.body)


def line_of(part: Link | Joint) -> str:
    """
    Format the line number of a link or joint, as the prefix of messages about it.

    Parameters
    ----------
    part
        The link or joint.

    Returns
    -------
    str
        Such as 'line 12: '; empty if the line is not known.

    """
    return '' if part.line is None else f'line {part.line}: '


def named(part: Link | Joint) -> str:
    """
    Format a link or joint as the subject of a message, with its line.

    Parameters
    ----------
    part
        The link or joint.

    Returns
    -------
    str
        Such as "line 12: Link 'torso'".

    """
    return f"{line_of(part)}{type(part).__name__} '{part.name}'"


def repeated(names: Iterable[str]) -> list[str]:
    """
    Return the names that occur more than once.

    Parameters
    ----------
    names
        The names of links or joints, in any order.

    """
    return [name for name, times in Counter(names).items() if times > 1]
