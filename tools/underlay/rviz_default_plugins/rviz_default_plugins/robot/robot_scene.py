# SPDX-License-Identifier: Apache-2.0
"""The links of a robot in the scene."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Set
from dataclasses import dataclass, field
from typing import Optional, TYPE_CHECKING
from urllib.parse import quote

from rviz_common.frames import Pose
from rviz_default_plugins.bodies import HIGHLIGHT_COLOR
from rviz_default_plugins.parts import Parts
from rviz_default_plugins.robot.contact_shadow import ContactShadow
from rviz_default_plugins.robot.mesh_loading import DrawnMesh
from rviz_default_plugins.robot.shape_drawing import draw_bodies, draw_shape, inflated, SOLID
from urdf import Color, Joint, Link, Mesh, RobotModel, Shape

if TYPE_CHECKING:
    from viser import FrameHandle, SceneApi, SceneNodeHandle

__all__ = ['MAX_SHAPES', 'Look', 'PoseOf', 'RobotScene']

PoseOf = Callable[[Joint], Optional[Pose]]

MAX_SHAPES = 3000
AXES_M = 0.1

HIGHLIGHT = 'highlight'
HIGHLIGHT_MARGIN_M = 0.002


@dataclass(frozen=True)
class Look:
    """The look of a robot: the parts that are shown, and how."""

    visuals: bool = True
    collisions: bool = False
    alpha: float = 1.0
    color: Color | None = None
    """A colour for all bodies, or None for the colours of the description."""
    margin_m: float = 0.0
    """The inflation of all bodies, on each side."""
    links: Parts = field(default_factory=lambda: Parts(None))

    @property
    def has_shadow(self) -> bool:
        """Whether there is a shadow below the robot: not below what is hardly seen."""
        return self.alpha >= SOLID and (self.visuals or self.collisions)

    def shapes(self, link: Link) -> list[tuple[str, Shape]]:
        """
        Select the bodies of a link that are shown.

        Parameters
        ----------
        link
            The link.

        Returns
        -------
        list[tuple[str, Shape]]
            Names, such as `visual_0`, and bodies; none if the link is hidden.

        """
        if not self.links.is_shown(link.name):
            return []
        visuals = link.visuals if self.visuals else ()
        collisions = link.collisions if self.collisions else ()
        return [
            *((f'visual_{index}', each) for index, each in enumerate(visuals)),
            *((f'collision_{index}', each) for index, each in enumerate(collisions)),
        ]


class RobotScene:
    """
    The links of a robot as nodes of the scene, each below the node of its parent link.

    So the motion of a joint is sent as a single pose, however many links are below it. A link
    whose pose is unknown is hidden with all links below it. Nothing is visible before `place`.

    Parameters
    ----------
    scene
        The scene of the viser server.
    path
        The path of the scene below which the nodes are.
    model
        The robot.
    look
        The parts that are shown, and how.
    meshes
        The meshes, by the names in the URDF.

    Attributes
    ----------
    joints
        The joints that are connected to the root, each after its parent joint.
    left_out
        The number of bodies that are not drawn, since there are more than `MAX_SHAPES`.
    is_removed
        Whether the nodes have been removed.

    """

    def __init__(
        self,
        scene: SceneApi,
        path: str,
        model: RobotModel,
        look: Look,
        meshes: Mapping[str, DrawnMesh],
    ) -> None:
        self.model = model
        self.left_out = 0
        self.is_removed = False
        self._drawn = 0
        self._scene, self._look, self._meshes = scene, look, meshes
        self._top = scene.add_frame(path, show_axes=False)
        self._shadow = ContactShadow(scene, path) if look.has_shadow else None
        self._links = links = {link.name: link for link in model.links}
        self._paths = paths = {model.root: f'{path}/{_named(model.root)}'}
        self._hidden: Set[str] = frozenset()
        self._root = self._add(links[model.root], paths[model.root])
        self._nodes = {model.root: self._root}
        self.joints = list(_downwards(model))
        for joint in self.joints:
            node_path = paths[joint.child] = f'{paths[joint.parent]}/{_named(joint.child)}'
            self._nodes[joint.child] = self._add(links[joint.child], node_path)

    def place(self, root: Pose | None, pose_of: PoseOf) -> list[Joint]:
        """
        Move the links; hide those whose pose is unknown, with all links below them.

        Parameters
        ----------
        root
            The pose of the root link in the fixed frame, None if it is unknown.
        pose_of
            Returns for a joint the pose of its child link in its parent link, or None.

        Returns
        -------
        list[Joint]
            The joints whose pose is unknown.

        """
        self._root.place(root)
        if self._shadow is not None:
            self._shadow.place(root)
        unknown = []
        for joint in self.joints:
            pose = pose_of(joint)
            self._nodes[joint.child].place(pose)
            if pose is None:
                unknown.append(joint)
        return unknown

    def hide(self, links: Set[str]) -> None:
        """
        Hide the bodies of some links, not of the links below them; show those of all others.

        Parameters
        ----------
        links
            The names of the links.

        """
        for link in self._hidden ^ links:
            if link in self._nodes:
                self._nodes[link].show_bodies(link not in links)
        self._hidden = links

    def poses(self) -> dict[str, Pose]:
        """Compute the pose in the fixed frame of each link that is visible, by its name."""
        root = self._root.pose
        poses = {} if root is None else {self.model.root: root}
        for joint in self.joints:
            above, pose = poses.get(joint.parent), self._nodes[joint.child].pose
            if above is not None and pose is not None:
                poses[joint.child] = above.of(pose)
        return poses

    def bodies(self, link: str) -> list[tuple[Shape, DrawnMesh | None]]:
        """
        Return the bodies of a link that are shown, those of meshes with the mesh.

        Parameters
        ----------
        link
            The name of the link.

        """
        shapes = [shape for _, shape in self._look.shapes(self._links[link])]
        files = [each.geometry.file if isinstance(each.geometry, Mesh) else '' for each in shapes]
        return [(shape, self._meshes.get(file)) for shape, file in zip(shapes, files)]

    def highlight(self, link: str, is_highlighted: bool) -> None:
        """
        Cover a link with a translucent colour, or uncover it.

        Parameters
        ----------
        link
            The name of the link.
        is_highlighted
            Whether it is to be covered.

        """
        path = f'{self._paths[link]}/{HIGHLIGHT}'
        self._scene.remove_by_name(path)
        if not is_highlighted:
            return
        self._scene.add_frame(path, show_axes=False)
        for index, (shape, _) in enumerate(self.bodies(link)):
            body = inflated(shape, HIGHLIGHT_MARGIN_M)
            part = f'{path}/{index}'
            draw_shape(self._scene, part, body, 1.0, self._meshes, HIGHLIGHT_COLOR)

    def remove(self) -> None:
        """Remove the nodes."""
        self._top.remove()
        self.is_removed = True
        if self._shadow is not None:
            self._shadow.remove()

    def _add(self, link: Link, path: str) -> _LinkNode:
        has_axes = self._look.links.has_axes(link.name)
        handle = self._scene.add_frame(
            path,
            show_axes=has_axes,
            axes_length=AXES_M,
            axes_radius=AXES_M / 10.0,
            visible=False,
        )
        alpha = self._look.alpha * self._look.links.alpha(link.name)
        shapes = self._look.shapes(link)
        drawn = shapes[: MAX_SHAPES - self._drawn]
        self._drawn += len(drawn)
        self.left_out += len(shapes) - len(drawn)
        bodies = [(name, inflated(shape, self._look.margin_m)) for name, shape in drawn]
        nodes = draw_bodies(self._scene, path, bodies, alpha, self._meshes, self._look.color)
        return _LinkNode(handle, nodes)


def _downwards(model: RobotModel) -> Iterator[Joint]:
    """
    Iterate over the joints of a robot from the root, each after its parent joint.

    Parameters
    ----------
    model
        The robot.

    Yields
    ------
    Joint
        Each joint that is connected to the root.

    """
    below: dict[str, list[Joint]] = {}
    for joint in model.joints:
        below.setdefault(joint.parent, []).append(joint)
    waiting = [model.root]
    while waiting:
        for joint in below.get(waiting.pop(), []):
            yield joint
            waiting.append(joint.child)


def _named(link: str) -> str:
    """Escape the name of a link for a path of the scene, in which slashes are separators."""
    return quote(link, safe='')


class _LinkNode:
    """
    A node of the scene of which only changes are sent to browsers.

    Parameters
    ----------
    handle
        The handle of viser for an invisible node at the origin.
    bodies
        The handles of the visible bodies below it.

    """

    def __init__(self, handle: FrameHandle, bodies: Iterable[SceneNodeHandle]) -> None:
        self._handle, self._bodies = handle, bodies
        self._pose = Pose()
        self._is_visible = False

    @property
    def pose(self) -> Pose | None:
        """The pose relative to the parent node, None if it is unknown."""
        return self._pose if self._is_visible else None

    def place(self, pose: Pose | None) -> None:
        """
        Move the node, and show it; hide it and all nodes below it if its pose is unknown.

        Parameters
        ----------
        pose
            The pose relative to the parent node, None if it is unknown.

        """
        if (pose is not None) != self._is_visible:
            self._is_visible = pose is not None
            self._handle.visible = self._is_visible
        if pose is None or pose == self._pose:
            return
        if pose.position != self._pose.position:
            self._handle.position = pose.position
        if pose.wxyz != self._pose.wxyz:
            self._handle.wxyz = pose.wxyz
        self._pose = pose

    def show_bodies(self, are_shown: bool) -> None:
        """
        Show or hide the bodies of the link, not the links below it.

        Parameters
        ----------
        are_shown
            Whether they are shown.

        """
        for body in self._bodies:
            body.visible = are_shown
