# SPDX-License-Identifier: Apache-2.0
"""What a URDF says about the looks and the outlines of links."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Union

from urdf.joint import Origin, Vector

__all__ = ['Box', 'Capsule', 'Color', 'Cylinder', 'Geometry', 'Mesh', 'Shape', 'Sphere']

Color = tuple[float, float, float, float]
"""Red, green, blue and opacity, each from 0 to 1."""


@dataclass(frozen=True)
class Box:
    """A box about its origin: lengths along x, y and z in metres."""

    size: Vector


@dataclass(frozen=True)
class Cylinder:
    """A cylinder about its origin, along z; in metres."""

    radius: float
    length: float


@dataclass(frozen=True)
class Capsule:
    """A cylinder of a length along z between two half spheres; in metres."""

    radius: float
    length: float


@dataclass(frozen=True)
class Sphere:
    """A sphere about its origin; in metres."""

    radius: float


@dataclass(frozen=True)
class Mesh:
    """A file, as the URDF names it (`package://...`), and how it is scaled along x, y and z."""

    file: str
    scale: Vector = (1.0, 1.0, 1.0)


Geometry = Union[Box, Capsule, Cylinder, Mesh, Sphere]


@dataclass(frozen=True)
class Shape:
    """One of the bodies of a link; without a colour, whoever shows it chooses."""

    geometry: Geometry
    origin: Origin = field(default_factory=Origin)
    color: Color | None = None
