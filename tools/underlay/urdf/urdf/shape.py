# SPDX-License-Identifier: Apache-2.0
"""Visual and collision shapes of links."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Union

from urdf.joint import Origin, Vector

__all__ = ['Box', 'Capsule', 'Color', 'Cylinder', 'Geometry', 'Mesh', 'Shape', 'Sphere']

Color = tuple[float, float, float, float]
"""Red, green, blue and opacity, each from 0 to 1."""


@dataclass(frozen=True)
class Box:
    """A box, centred at its origin: lengths along x, y and z in metres."""

    size: Vector


@dataclass(frozen=True)
class Cylinder:
    """A cylinder along z, centred at its origin; in metres."""

    radius: float
    length: float


@dataclass(frozen=True)
class Capsule:
    """A capsule: a cylinder of `length` along z between two hemispheres; in metres."""

    radius: float
    length: float


@dataclass(frozen=True)
class Sphere:
    """A sphere, centred at its origin; in metres."""

    radius: float


@dataclass(frozen=True)
class Mesh:
    """A mesh: the file as in the URDF (`package://...`), and the scale along x, y and z."""

    file: str
    scale: Vector = (1.0, 1.0, 1.0)


Geometry = Union[Box, Capsule, Cylinder, Mesh, Sphere]


@dataclass(frozen=True)
class Shape:
    """Visual or collision shape of a link; without a colour, the viewer chooses one."""

    geometry: Geometry
    origin: Origin = field(default_factory=Origin)
    color: Color | None = None
