# SPDX-License-Identifier: Apache-2.0
"""A view of the scene: its kind and its properties, as in a file."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rviz_common.properties import Values
from rviz_common.view_kinds import (
    CameraPose,
    Fps,
    Orbit,
    ThirdPersonFollower,
    TopDown,
    ViewKind,
    XYOrbit,
)

__all__ = ['KINDS', 'View']

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
