# SPDX-License-Identifier: Apache-2.0
"""Parameters of the node `gaze`."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_common.parameters import parameter

__all__ = ['GazeParameters']


@dataclass(frozen=True)
class GazeParameters:
    """The parameters of the node."""

    joints: tuple[str, ...] = parameter(
        ('head_yaw', 'head_pitch'), 'The neck joints, from the body to the head.', read_only=True
    )
    controller: str = parameter(
        'head_controller', 'The trajectory controller of the neck joints.', read_only=True
    )
    odom_frame: str = parameter('odom', 'The frame in which the body turns.')
    camera_frame: str = parameter(
        'camera_optical_frame', 'The frame to point with if a goal names none.'
    )
    max_velocity: float = parameter(
        1.5, 'Speed limit of the neck joints (rad/s).', at_least=0.05, at_most=12.0
    )
    tolerance_rad: float = parameter(
        0.05, 'Pointing tolerance (rad).', at_least=0.001, at_most=1.0
    )
    scan_up_rad: float = parameter(
        0.15, 'Highest elevation of a room scan (rad).', at_least=-1.0, at_most=1.5
    )
    scan_down_rad: float = parameter(
        0.85, 'Largest depression angle of a room scan (rad).', at_least=-1.0, at_most=1.5
    )
    looks_per_view: int = parameter(
        4, 'Images to wait for at each stop of a scan.', at_least=1, at_most=100
    )
    turn_rate_rad_s: float = parameter(
        0.5, 'Turn rate of the body during a scan (rad/s).', at_least=0.05, at_most=2.0
    )
    turn_with: str = parameter(
        'auto',
        'What turns the body: spin of Nav2, which checks for collisions, or cmd_vel.',
        choices=('auto', 'spin', 'cmd_vel'),
    )
