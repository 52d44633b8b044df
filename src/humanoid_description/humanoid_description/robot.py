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
    """Mass, centre of mass in the link, and inertia about it in the axes of pose."""

    mass_kg: float
    pose: Array
    inertia_kgm2: Array


@dataclass(frozen=True, eq=False)
class Shape:
    """A box (three edges), cylinder (radius, length), sphere (radius) or mesh (a file)."""

    kind: str
    size_m: tuple[float, ...]
    pose: Array
    file: str = ''


@dataclass(frozen=True, eq=False)
class Link:
    """A rigid part; without a body it is a mere frame."""

    name: str
    body: Body | None = None
    visuals: tuple[Shape, ...] = ()
    collisions: tuple[Shape, ...] = ()
    line: int | None = None


@dataclass(frozen=True)
class Limits:
    """The range of a joint in rad or m, and its strength; None is not given."""

    lower: float
    upper: float
    effort: float | None
    velocity: float | None


@dataclass(frozen=True)
class Mimic:
    """How a joint follows another: by a multiple of its position, and an offset in rad or m."""

    joint: str
    multiplier: float = 1.0
    offset: float = 0.0


@dataclass(frozen=True, eq=False)
class Joint:
    """A connection: pose says where the child sits in the parent while the joint is at zero."""

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
        """Tell whether the joint turns about its axis or slides along it."""
        return self.kind in DRIVEN_KINDS


@dataclass(frozen=True)
class Robot:
    """Links and joints, in the order of the file; nothing is known of their soundness."""

    name: str
    links: tuple[Link, ...]
    joints: tuple[Joint, ...]
    folder: Path = Path()

    @cached_property
    def link(self) -> dict[str, Link]:
        """Return the links by their names."""
        return {link.name: link for link in self.links}

    @cached_property
    def joint(self) -> dict[str, Joint]:
        """Return the joints by their names."""
        return {joint.name: joint for joint in self.joints}

    @cached_property
    def joint_above(self) -> dict[str, Joint]:
        """Return the joint that each link but the root hangs from."""
        return {joint.child: joint for joint in self.joints}

    @cached_property
    def roots(self) -> tuple[str, ...]:
        """Return the links that hang from no joint."""
        return tuple(link.name for link in self.links if link.name not in self.joint_above)

    @cached_property
    def prefix(self) -> str:
        """Return what the names begin with, if the root is a base_link."""
        root = self.roots[0] if self.roots else ''
        return root.removesuffix('base_link') if root.endswith('base_link') else ''

    @cached_property
    def mass_kg(self) -> float:
        """Return the mass of all links together."""
        return sum(link.body.mass_kg for link in self.links if link.body)


def line_of(part: Link | Joint) -> str:
    """
    Format the line of a link or joint in its file, with which messages about it begin.

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
        Those of links or joints, in any order.

    """
    return [name for name, times in Counter(names).items() if times > 1]
