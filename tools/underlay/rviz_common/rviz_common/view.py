# SPDX-License-Identifier: Apache-2.0
"""A view of the scene: its kind and properties, as in a file, and the cameras of browsers."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rviz_common.context import Context
from rviz_common.frames import FrameError, Pose, WORLD
from rviz_common.properties import Values
from rviz_common.view_kinds import (
    CameraPose,
    Fps,
    Orbit,
    Point,
    ThirdPersonFollower,
    TopDown,
    ViewKind,
    XYOrbit,
)

__all__ = ['KINDS', 'Cameras', 'View']

KINDS: dict[str, ViewKind] = {
    kind.CLASS: kind for kind in (Orbit(), XYOrbit(), TopDown(), Fps(), ThirdPersonFollower())
}


class View:
    """
    A view of the scene: its kind, such as an orbit, and its properties.

    Parameters
    ----------
    given
        Its entry in the .rviz file, None or empty for the default. An unknown class is replaced
        by an orbit.

    Attributes
    ----------
    kind, is_known
        The kind of view, and whether it is the one in the file.
    name
        Its name in the file.
    values
        The properties.

    """

    def __init__(self, given: Mapping[str, Any] | None = None) -> None:
        self._given = dict(given or {})
        self.class_name = str(self._given.get('Class') or Orbit.CLASS)
        self.is_known = self.class_name in KINDS
        self.kind = KINDS.get(self.class_name, KINDS[Orbit.CLASS])
        self._first_name = self.name = str(self._given.get('Name') or 'Current View')
        self.values = Values(self.kind.PROPERTIES, self._given)
        self._is_default = not self._given

    @property
    def target(self) -> str:
        """The frame that the camera follows."""
        return str(self.values['Target Frame'])

    def camera(self) -> CameraPose:
        """Compute the camera, relative to the origin of the target frame."""
        return self.kind.camera(self.values)

    def like(self, kind: ViewKind, camera: CameraPose | None = None) -> View:
        """
        Make a view of another kind that shows approximately the same.

        Parameters
        ----------
        kind
            The kind of the new view.
        camera
            The camera to match, relative to the origin of the target frame; by default that of
            this view.

        """
        given = {
            'Class': kind.CLASS,
            'Name': self.name,
            'Target Frame': self.target,
            'Value': f'{kind.NAME} (rviz_default_plugins)',
        }
        view = View(given)
        view.take(camera or self.camera())
        return view

    def take(self, camera: CameraPose) -> None:
        """
        Set the properties so that the view matches a camera.

        Parameters
        ----------
        camera
            The camera, relative to the origin of the target frame.

        """
        self._is_default = False
        for path, value in self.kind.properties(camera).items():
            self.values[path] = value

    def change(self, path: str, value: Any) -> None:
        """
        Set a property.

        Parameters
        ----------
        path, value
            The path of the property, such as `Distance`, and its new value.

        Raises
        ------
        ValueError
            The value is invalid; the message is that of `Property.read`.

        """
        self.values[path] = value
        self._is_default = False

    def copy(self, name: str) -> View:
        """
        Copy the view under another name.

        Parameters
        ----------
        name
            The name of the copy.

        """
        return View({**self.to_file(), 'Name': name})

    def to_file(self) -> dict[str, Any]:
        """Return the entry for the .rviz file: empty if it had none."""
        if self._is_default:
            return {}
        written = self.values.to_file()
        if not self._given:
            written['Class'] = self.class_name
            written['Value'] = f'{self.kind.NAME} (rviz_default_plugins)'
        if not self._given or self.name != self._first_name:
            written['Name'] = self.name
        return written


class Cameras:
    """
    Set the cameras of all browsers to a view.

    To follow a frame, the world is moved instead of the camera, so that users can turn the scene
    meanwhile without interference.

    Parameters
    ----------
    context
        The page, and the transforms.
    view
        The first view; browsers that connect later start with the latest one.

    Attributes
    ----------
    view
        The view that is shown.
    reason
        Why the target frame cannot be followed, '' if it can.

    """

    def __init__(self, context: Context, view: View) -> None:
        self._context = context
        self._world = context.scene.add_frame(WORLD, show_axes=False)
        self._at = Pose().position
        self.reason = ''
        self.show(view)

    @property
    def origin(self) -> Point:
        """Return the position of the target frame in the fixed frame."""
        return self._at

    def show(self, view: View) -> None:
        """
        Set the cameras of all browsers, and of those that connect later, to a view.

        Parameters
        ----------
        view
            The view.

        """
        self.view = view
        pose = view.camera()
        initial = self._context.server.initial_camera
        initial.up = pose.up
        _apply(initial, pose)
        for client in self._context.server.get_clients().values():
            client.camera.up_direction = pose.up
            _apply(client.camera, pose)

    def update(self) -> None:
        """Follow the target frame."""
        try:
            at = self._context.frames.pose(self.view.target).position
        except FrameError as error:
            self.reason = str(error)
            return
        self.reason = ''
        if at != self._at:
            self._at = at
            x, y, z = at
            self._world.position = (-x, -y, -z)

    def seen_by(self, client_id: int | None) -> CameraPose | None:
        """
        Read the camera of a browser, which its user may have moved.

        Parameters
        ----------
        client_id
            The browser; if it is None or gone, the first one that is connected.

        Returns
        -------
        CameraPose | None
            Relative to the origin of the target frame; None if no browser is connected.

        """
        clients = self._context.server.get_clients()
        client = clients.get(client_id) if client_id is not None else None
        client = client or next(iter(clients.values()), None)
        return None if client is None else _pose(client.camera)


def _apply(camera: Any, pose: CameraPose) -> None:
    """Set the camera of a browser, or the initial camera of new browsers."""
    camera.position = pose.position
    camera.look_at = pose.look_at
    camera.fov, camera.near, camera.far = pose.fov, pose.near, pose.far


def _pose(camera: Any) -> CameraPose:
    """Return the camera pose of a browser."""
    return CameraPose(
        _point(camera.position),
        _point(camera.look_at),
        _point(camera.up_direction),
        camera.fov,
        camera.near,
        camera.far,
    )


def _point(vector: Any) -> Point:
    x, y, z = (float(part) for part in vector)
    return x, y, z
