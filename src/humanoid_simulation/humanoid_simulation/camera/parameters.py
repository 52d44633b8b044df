# SPDX-License-Identifier: Apache-2.0
"""The parameters of the cameras, to be inherited by those of the simulator."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.parameters import parameter
from humanoid_simulation.camera.methods import AUTO, CHOICES


@dataclass(frozen=True)
class CameraParameters:
    """Rate, image size, frame and rendering method of the cameras of all robots."""

    camera_rate_hz: float = parameter(
        10.0,
        'How many pictures each camera takes in a second of simulated time; 0 for no cameras.',
        at_least=0.0,
        at_most=100.0,
        read_only=True,
    )
    camera_width_px: int = parameter(
        320, 'The width of the pictures.', at_least=16, at_most=1920, read_only=True
    )
    camera_height_px: int = parameter(
        240, 'The height of the pictures.', at_least=16, at_most=1920, read_only=True
    )
    camera_frame: str = parameter(
        'camera_optical_frame',
        'The frame of the pictures, without the prefix of the robot.',
        read_only=True,
    )
    camera_renderer: str = parameter(
        AUTO,
        'What draws: OpenGL by egl or osmesa, or rays, without OpenGL; auto tries all three.',
        choices=CHOICES,
        read_only=True,
    )
