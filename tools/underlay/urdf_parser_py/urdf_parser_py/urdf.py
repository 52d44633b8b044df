# SPDX-License-Identifier: Apache-2.0
"""Robots, with their links and joints as a tree."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any
from xml.etree import ElementTree

from urdf_parser_py.joints import (
    Joint,
    JointCalibration,
    JointDynamics,
    JointLimit,
    JointMimic,
    SafetyController,
)
from urdf_parser_py.reading import add, Element, text
from urdf_parser_py.shapes import (
    Box,
    Collision,
    Color,
    Cylinder,
    Geometry,
    Inertia,
    Inertial,
    Material,
    Mesh,
    Pose,
    read_origin,
    Sphere,
    Texture,
    Visual,
    write_origin,
)

__all__ = [
    'URDF',
    'Box',
    'Collision',
    'Color',
    'Cylinder',
    'Geometry',
    'Inertia',
    'Inertial',
    'Joint',
    'JointCalibration',
    'JointDynamics',
    'JointLimit',
    'JointMimic',
    'Link',
    'Material',
    'Mesh',
    'Pose',
    'Robot',
    'SafetyController',
    'Sphere',
    'Texture',
    'Visual',
]


class Link:
    """
    A link, with its shapes and its mass.

    Parameters
    ----------
    name
        Its name.
    visual, collision
        Its first shapes; `visuals` and `collisions` have all.
    inertial
        Its mass and inertia.
    origin
        Its pose, which URDF does not use.

    """

    def __init__(
        self,
        name: str | None = None,
        visual: Visual | None = None,
        inertial: Inertial | None = None,
        collision: Collision | None = None,
        origin: Pose | None = None,
    ) -> None:
        self.name = name
        self.visuals = [] if visual is None else [visual]
        self.collisions = [] if collision is None else [collision]
        self.inertial = inertial
        self.origin = origin

    @property
    def visual(self) -> Visual | None:
        """The first shape that is seen."""
        return self.visuals[0] if self.visuals else None

    @visual.setter
    def visual(self, value: Visual | None) -> None:
        """
        Set the first shape that is seen.

        Parameters
        ----------
        value
            The shape; None to remove it.

        """
        self.visuals[:1] = [] if value is None else [value]

    @property
    def collision(self) -> Collision | None:
        """The first shape that touches others."""
        return self.collisions[0] if self.collisions else None

    @collision.setter
    def collision(self, value: Collision | None) -> None:
        """
        Set the first shape that touches others.

        Parameters
        ----------
        value
            The shape; None to remove it.

        """
        self.collisions[:1] = [] if value is None else [value]

    @classmethod
    def from_xml(cls, element: Any) -> Link:
        """
        Read a link.

        Parameters
        ----------
        element
            The element `link`.

        """
        inertial = element.find('inertial')
        link = cls(
            text(element, 'name'),
            inertial=None if inertial is None else Inertial.from_xml(inertial),
            origin=read_origin(element),
        )
        link.visuals = [Visual.from_xml(each) for each in element.findall('visual')]
        link.collisions = [Collision.from_xml(each) for each in element.findall('collision')]
        return link

    def to_xml(self, parent: Element) -> None:
        """
        Write the link.

        Parameters
        ----------
        parent
            The element that gets it.

        """
        element = add(parent, 'link', name=self.name)
        write_origin(element, self.origin)
        for each in (self.inertial, *self.visuals, *self.collisions):
            if each is not None:
                each.to_xml(element)


class Robot:
    """
    A robot: its links, joints and materials, and how they are connected.

    `joint_map` and `link_map` have joints and links by name, `parent_map` the joint and the parent
    of each child, `child_map` the joints and children of each parent, all by name. `others` has
    the elements of other kinds, such as transmissions, as they were read.

    Parameters
    ----------
    name
        The name of the robot.
    version
        The version of the format.

    """

    def __init__(self, name: str | None = None, version: str = '1.0') -> None:
        self.name = name
        self.version = version
        self.links: list[Link] = []
        self.joints: list[Joint] = []
        self.materials: list[Material] = []
        self.link_map: dict[str | None, Link] = {}
        self.joint_map: dict[str | None, Joint] = {}
        self.parent_map: dict[str | None, tuple[str | None, str | None]] = {}
        self.child_map: dict[str | None, list[tuple[str | None, str | None]]] = {}
        self.others: list[Element] = []

    @classmethod
    def from_xml_string(cls, xml_string: str | bytes) -> Robot:
        """
        Read a robot from a text.

        Parameters
        ----------
        xml_string
            The robot description.

        Raises
        ------
        ValueError
            It is no XML, or no URDF.

        """
        try:
            element = ElementTree.fromstring(xml_string)
        except ElementTree.ParseError as error:
            raise ValueError(f'The robot description is not XML: {error}') from None
        return cls.from_xml(element)

    @classmethod
    def from_xml_file(cls, file_path: str) -> Robot:
        """
        Read a robot from a file.

        Parameters
        ----------
        file_path
            The file with the robot description; xacro files must be expanded first.

        Raises
        ------
        OSError
            The file cannot be read.
        ValueError
            It is no XML, or no URDF.

        """
        with open(file_path, 'rb') as file:
            return cls.from_xml_string(file.read())

    load_xml_file = from_xml_file

    @classmethod
    def from_xml(cls, element: Any) -> Robot:
        """
        Read a robot from an element.

        Parameters
        ----------
        element
            The element `robot`, of xml.etree or lxml.

        Raises
        ------
        ValueError
            It is no URDF.

        """
        if element.tag != 'robot':
            raise ValueError(f'A URDF begins with <robot>, but this one with <{element.tag}>')
        robot = cls(element.get('name'), element.get('version', '1.0'))
        for each in element:
            if each.tag == 'link':
                robot.add_link(Link.from_xml(each))
            elif each.tag == 'joint':
                robot.add_joint(Joint.from_xml(each))
            elif each.tag == 'material':
                robot.materials.append(Material.from_xml(each))
            elif isinstance(each.tag, str):
                robot.others.append(each)
        return robot

    def add_link(self, link: Link) -> None:
        """
        Add a link.

        Parameters
        ----------
        link
            The link.

        """
        self.links.append(link)
        self.link_map[link.name] = link

    def add_joint(self, joint: Joint) -> None:
        """
        Add a joint.

        Parameters
        ----------
        joint
            The joint, whose links may be added later.

        """
        self.joints.append(joint)
        self.joint_map[joint.name] = joint
        self.parent_map[joint.child] = (joint.name, joint.parent)
        self.child_map.setdefault(joint.parent, []).append((joint.name, joint.child))

    def get_root(self) -> str | None:
        """
        The name of the link that has no parent.

        Raises
        ------
        ValueError
            There is not exactly one.

        """
        roots = [link.name for link in self.links if link.name not in self.parent_map]
        if len(roots) != 1:
            raise ValueError(
                'A robot has one link without a parent; this one has '
                f'{", ".join(map(repr, roots)) or "none"}'
            )
        return roots[0]

    def get_chain(
        self, root: str, tip: str, joints: bool = True, links: bool = True, fixed: bool = True
    ) -> list[str]:
        """
        List what is between two links.

        Parameters
        ----------
        root, tip
            The names of the links. The first one is an ancestor of the second one.
        joints, links
            Whether joints and links are listed.
        fixed
            Whether fixed joints are listed, if joints are.

        Returns
        -------
        list of str
            The names, from the root to the tip, with both of them.

        Raises
        ------
        ValueError
            The root is no ancestor of the tip.

        """
        chain = [tip] if links else []
        for joint, parent in self._upwards(root, tip):
            if joints and (fixed or self.joint_map[joint].joint_type != 'fixed'):
                chain.append(joint)
            if links:
                chain.append(parent)
        return chain[::-1]

    def _upwards(self, root: str, tip: str) -> Iterator[tuple[str, str]]:
        """Yield the joints from a tip to a root, each with its parent."""
        here = tip
        while here != root:
            if here not in self.parent_map:
                raise ValueError(
                    f'There is no chain from link {root!r} to {tip!r}: above {tip!r} is nothing '
                    f'but links up to {here!r}'
                )
            joint, parent = self.parent_map[here]
            yield str(joint), str(parent)
            here = str(parent)

    def to_xml(self) -> Element:
        """
        Write the robot to an element.

        Returns
        -------
        xml.etree.ElementTree.Element
            The element `robot`. It also has what was read and has no meaning here, such as
            `ros2_control` and `gazebo`.

        """
        element = add(None, 'robot', name=self.name)
        if self.version != '1.0':
            element.set('version', self.version)
        parts: list[Material | Link | Joint] = [*self.materials, *self.links, *self.joints]
        for each in parts:
            each.to_xml(element)
        element.extend(self.others)
        return element

    def to_xml_string(self, addHeader: bool = True) -> str:  # noqa: N803
        """
        Write the robot to a text.

        Parameters
        ----------
        addHeader
            Whether it begins with an XML declaration.

        """
        element = self.to_xml()
        ElementTree.indent(element)
        body = ElementTree.tostring(element, encoding='unicode')
        return f'<?xml version="1.0"?>\n{body}\n' if addHeader else f'{body}\n'


URDF = Robot
