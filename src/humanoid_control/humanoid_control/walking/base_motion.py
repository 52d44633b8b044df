# SPDX-License-Identifier: Apache-2.0
"""Motion of the base."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.dynamics.frames import Frame, Twist


@dataclass(frozen=True, eq=False)
class BaseMotion:
    """Pose and twist of the base in the odom frame, measured or wanted."""

    frame: Frame
    twist: Twist
