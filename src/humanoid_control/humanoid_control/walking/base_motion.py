# SPDX-License-Identifier: Apache-2.0
"""How the pelvis moves."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics.frames import Frame, Twist


@dataclass(frozen=True, eq=False)
class BaseMotion:
    """Where the base is in the odometry's frame and how it moves, measured or wanted."""

    frame: Frame
    twist: Twist
