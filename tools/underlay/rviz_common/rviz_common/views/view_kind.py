# SPDX-License-Identifier: Apache-2.0
"""The kinds of view, such as an orbit around a point."""

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
    """A kind of view: converts its properties to a camera, and back."""

    CLASS: ClassVar[str]
    NAME: ClassVar[str]
    PROPERTIES: ClassVar[tuple[Property, ...]]

    @abstractmethod
    def camera(self, values: Values) -> CameraPose:
        """
        Compute the camera from the properties of a view.

        Parameters
        ----------
        values
            The values of `PROPERTIES`.

        Returns
        -------
        CameraPose
            The camera, relative to the origin of the target frame, along the axes of the fixed
            frame.

        """

    @abstractmethod
    def properties(self, camera: CameraPose) -> Mapping[str, Any]:
        """
        Compute the properties of a view from a camera, as far as the kind can express it.

        Parameters
        ----------
        camera
            The camera, relative to the origin of the target frame, along the axes of the fixed
            frame.

        Returns
        -------
        Mapping[str, Any]
            Values by path, for those of `PROPERTIES` that the camera determines.

        """
