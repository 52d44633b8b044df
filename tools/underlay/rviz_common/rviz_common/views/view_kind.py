# SPDX-License-Identifier: Apache-2.0
"""A way to look at things, such as from around a point."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, ClassVar

from rviz_common.frames import FIXED_FRAME
from rviz_common.properties import Frame, Number, Property, Values
from rviz_common.views.camera_pose import CameraPose

__all__ = ['COMMON', 'ViewKind']

COMMON: tuple[Property, ...] = (
    Frame('Target Frame', FIXED_FRAME, 'The frame that the camera follows.'),
    Number('Near Clip Distance', 0.01, 'What is nearer, in metres, is not drawn.', 0.001, 1000.0),
)


class ViewKind(ABC):
    """A way to look at things: from properties to a camera, and back."""

    CLASS: ClassVar[str]
    NAME: ClassVar[str]
    PROPERTIES: ClassVar[tuple[Property, ...]]

    @abstractmethod
    def camera(self, values: Values) -> CameraPose:
        """Return where the camera is."""

    @abstractmethod
    def properties(self, camera: CameraPose) -> Mapping[str, Any]:
        """Return the properties of a camera, as well as it can be said."""
