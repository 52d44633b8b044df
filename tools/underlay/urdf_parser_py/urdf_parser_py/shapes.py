# SPDX-License-Identifier: Apache-2.0
"""What links consist of: poses, masses, shapes and materials."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from urdf_parser_py.reading import add, Element, number, numbers, text

__all__ = [
    'Box',
    'Collision',
    'Color',
    'Cylinder',
    'Geometry',
    'Inertia',
    'Inertial',
    'Material',
    'Mesh',
    'Pose',
    'Sphere',
    'Texture',
    'Visual',
    'read_origin',
    'write_origin',
]


def _zeros() -> list[float]:
    return [0.0, 0.0, 0.0]


@dataclass
class Pose:
    """A place `xyz`, in m, and the angles `rpy` about the static axes x, y and z, in rad."""

    xyz: list[float] = field(default_factory=_zeros)
    rpy: list[float] = field(default_factory=_zeros)

    @property
    def position(self) -> list[float]:
        """The place."""
        return self.xyz

    @position.setter
    def position(self, value: list[float]) -> None:
        """
        Set the place.

        Parameters
        ----------
        value
            The place, in m.

        """
        self.xyz = value

    @property
    def rotation(self) -> list[float]:
        """The angles."""
        return self.rpy

    @rotation.setter
    def rotation(self, value: list[float]) -> None:
        """
        Set the angles.

        Parameters
        ----------
        value
            The angles, in rad.

        """
        self.rpy = value


def read_origin(element: Any) -> Pose | None:
    """
    Read the origin of an element.

    Parameters
    ----------
    element
        The element.

    Returns
    -------
    Pose or None
        None if it has no origin, which is then that of the frame.

    """
    found = element.find('origin')
    if found is None:
        return None
    return Pose(numbers(found, 'xyz', _zeros()), numbers(found, 'rpy', _zeros()))


def write_origin(parent: Element, origin: Pose | None) -> None:
    """
    Write an origin.

    Parameters
    ----------
    parent
        The element that gets it.
    origin
        The origin, if there is one.

    """
    if origin is not None:
        add(parent, 'origin', xyz=origin.xyz, rpy=origin.rpy)


@dataclass
class Color:
    """Red, green, blue and alpha, from 0 to 1."""

    rgba: list[float]


@dataclass
class Texture:
    """An image on a surface."""

    filename: str


@dataclass
class Material:
    """A name, with a colour or a texture if it is defined here."""

    name: str | None = None
    color: Color | None = None
    texture: Texture | None = None

    @classmethod
    def from_xml(cls, element: Any) -> Material:
        """
        Read a material.

        Parameters
        ----------
        element
            The element `material`.

        """
        color, texture = element.find('color'), element.find('texture')
        return cls(
            element.get('name'),
            None if color is None else Color(numbers(color, 'rgba', count=4)),
            None if texture is None else Texture(text(texture, 'filename')),
        )

    def to_xml(self, parent: Element) -> None:
        """
        Write the material.

        Parameters
        ----------
        parent
            The element that gets it.

        """
        element = add(parent, 'material', name=self.name)
        if self.color is not None:
            add(element, 'color', rgba=self.color.rgba)
        if self.texture is not None:
            add(element, 'texture', filename=self.texture.filename)


@dataclass
class Box:
    """A box with the lengths of its edges, in m."""

    size: list[float]


@dataclass
class Cylinder:
    """A cylinder along z, in m."""

    radius: float
    length: float


@dataclass
class Sphere:
    """A sphere, in m."""

    radius: float


@dataclass
class Mesh:
    """A file with a mesh, and by what it is scaled."""

    filename: str
    scale: list[float] | None = None


Geometry = Box | Cylinder | Sphere | Mesh

_GEOMETRIES: dict[str, tuple[type, Callable[[Any], Geometry]]] = {
    'box': (Box, lambda body: Box(numbers(body, 'size'))),
    'cylinder': (Cylinder, lambda body: Cylinder(number(body, 'radius'), number(body, 'length'))),
    'sphere': (Sphere, lambda body: Sphere(number(body, 'radius'))),
    'mesh': (
        Mesh,
        lambda body: Mesh(
            text(body, 'filename'), numbers(body, 'scale') if body.get('scale') else None
        ),
    ),
}


def _read_geometry(element: Any) -> Geometry | None:
    found = element.find('geometry')
    if found is None:
        return None
    for tag, (_, read) in _GEOMETRIES.items():
        body = found.find(tag)
        if body is not None:
            return read(body)
    raise ValueError(f'The URDF has a <geometry> that has none of {", ".join(_GEOMETRIES)}')


def _write_geometry(parent: Element, geometry: Geometry | None) -> None:
    for tag, (kind, _) in _GEOMETRIES.items():
        if isinstance(geometry, kind):
            add(add(parent, 'geometry'), tag, **vars(geometry))


@dataclass
class Collision:
    """A shape of a link that touches others."""

    geometry: Geometry | None = None
    origin: Pose | None = None
    name: str | None = None

    @classmethod
    def from_xml(cls, element: Any) -> Collision:
        """
        Read a collision.

        Parameters
        ----------
        element
            The element `collision`.

        """
        return cls(_read_geometry(element), read_origin(element), element.get('name'))

    def to_xml(self, parent: Element) -> None:
        """
        Write the collision.

        Parameters
        ----------
        parent
            The element that gets it.

        """
        element = add(parent, 'collision', name=self.name)
        write_origin(element, self.origin)
        _write_geometry(element, self.geometry)


@dataclass
class Visual:
    """A shape of a link that is seen."""

    geometry: Geometry | None = None
    material: Material | None = None
    origin: Pose | None = None
    name: str | None = None

    @classmethod
    def from_xml(cls, element: Any) -> Visual:
        """
        Read a visual.

        Parameters
        ----------
        element
            The element `visual`.

        """
        material = element.find('material')
        return cls(
            _read_geometry(element),
            None if material is None else Material.from_xml(material),
            read_origin(element),
            element.get('name'),
        )

    def to_xml(self, parent: Element) -> None:
        """
        Write the visual.

        Parameters
        ----------
        parent
            The element that gets it.

        """
        element = add(parent, 'visual', name=self.name)
        write_origin(element, self.origin)
        _write_geometry(element, self.geometry)
        if self.material is not None:
            self.material.to_xml(element)


@dataclass
class Inertia:
    """Moments and products of inertia, in kg m²."""

    ixx: float = 0.0
    ixy: float = 0.0
    ixz: float = 0.0
    iyy: float = 0.0
    iyz: float = 0.0
    izz: float = 0.0

    def to_matrix(self) -> list[list[float]]:
        """The inertia as a matrix (3, 3)."""
        return [
            [self.ixx, self.ixy, self.ixz],
            [self.ixy, self.iyy, self.iyz],
            [self.ixz, self.iyz, self.izz],
        ]


@dataclass
class Inertial:
    """The mass of a link, in kg, its inertia, and the pose of both."""

    mass: float = 0.0
    inertia: Inertia | None = None
    origin: Pose | None = None

    @classmethod
    def from_xml(cls, element: Any) -> Inertial:
        """
        Read the inertia of a link.

        Parameters
        ----------
        element
            The element `inertial`.

        """
        mass, inertia = element.find('mass'), element.find('inertia')
        return cls(
            0.0 if mass is None else number(mass, 'value'),
            None
            if inertia is None
            else Inertia(*(number(inertia, name, 0.0) for name in vars(Inertia()))),
            read_origin(element),
        )

    def to_xml(self, parent: Element) -> None:
        """
        Write the inertia.

        Parameters
        ----------
        parent
            The element that gets it.

        """
        element = add(parent, 'inertial')
        write_origin(element, self.origin)
        add(element, 'mass', value=self.mass)
        if self.inertia is not None:
            add(element, 'inertia', **vars(self.inertia))
