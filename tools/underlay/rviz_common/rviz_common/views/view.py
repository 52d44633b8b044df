# SPDX-License-Identifier: Apache-2.0
"""How the page looks at the scene."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rviz_common.properties import Values
from rviz_common.views.camera_pose import CameraPose
from rviz_common.views.fps import Fps
from rviz_common.views.orbit import Orbit, ThirdPersonFollower, XYOrbit
from rviz_common.views.top_down import TopDown
from rviz_common.views.view_kind import ViewKind

__all__ = ['KINDS', 'View']

KINDS: dict[str, ViewKind] = {
    kind.CLASS: kind for kind in (Orbit(), XYOrbit(), TopDown(), Fps(), ThirdPersonFollower())
}


class View:
    """How the page looks at the scene, as an entry of a file says it."""

    def __init__(self, given: Mapping[str, Any] | None = None) -> None:
        """Take what a file gives; an unknown class is taken for an orbit."""
        self._given = dict(given or {})
        self.class_name = str(self._given.get('Class') or Orbit.CLASS)
        self.is_known = self.class_name in KINDS
        self.kind = KINDS.get(self.class_name, KINDS[Orbit.CLASS])
        self._first_name = self.name = str(self._given.get('Name') or 'Current View')
        self.values = Values(self.kind.PROPERTIES, self._given)
        self._is_default = not self._given

    @property
    def target(self) -> str:
        """Return the frame that the camera follows."""
        return str(self.values['Target Frame'])

    def camera(self) -> CameraPose:
        """Return where the camera is, from the target frame on."""
        return self.kind.camera(self.values)

    def like(self, kind: ViewKind, camera: CameraPose | None = None) -> View:
        """Return a view of another kind that shows about the same."""
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
        """Look from where a camera looks."""
        self._is_default = False
        for path, value in self.kind.properties(camera).items():
            self.values[path] = value

    def change(self, path: str, value: Any) -> None:
        """Set a property, or raise ValueError with the reason."""
        self.values[path] = value
        self._is_default = False

    def copy(self, name: str) -> View:
        """Return the same view under another name."""
        return View({**self.to_file(), 'Name': name})

    def to_file(self) -> dict[str, Any]:
        """Return what the file is to have: nothing if it had nothing."""
        if self._is_default:
            return {}
        written = self.values.to_file()
        if not self._given:
            written['Class'] = self.class_name
            written['Value'] = f'{self.kind.NAME} (rviz_default_plugins)'
        if not self._given or self.name != self._first_name:
            written['Name'] = self.name
        return written
