# SPDX-License-Identifier: Apache-2.0
"""Whose time the nodes of a launch take."""

from __future__ import annotations

from launch import Substitution
from launch.substitutions import EqualsSubstitution, IfElseSubstitution, LaunchConfiguration

__all__ = ['is_simulated', 'robot_time']


def is_simulated() -> Substitution:
    """Return whether the argument `backend` is the simulator: `true` or `false`."""
    return EqualsSubstitution(LaunchConfiguration('backend'), 'mujoco')


def robot_time() -> Substitution:
    """Return `use_sim_time` for nodes: as it was given, or, if that is `auto`, by the backend."""
    given = LaunchConfiguration('use_sim_time')
    return IfElseSubstitution(EqualsSubstitution(given, 'auto'), is_simulated(), given)
