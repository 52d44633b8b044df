# SPDX-License-Identifier: Apache-2.0
"""The time source of the nodes of a launch."""

from __future__ import annotations

from launch import Substitution
from launch.substitutions import EqualsSubstitution, IfElseSubstitution, LaunchConfiguration

__all__ = ['is_simulated', 'robot_time']


def is_simulated() -> Substitution:
    """Build the substitution `true` if the argument `backend` is the simulator, else `false`."""
    return EqualsSubstitution(LaunchConfiguration('backend'), 'mujoco')


def robot_time() -> Substitution:
    """Build the substitution for `use_sim_time`: the argument, or, if `auto`, by the backend."""
    given = LaunchConfiguration('use_sim_time')
    return IfElseSubstitution(EqualsSubstitution(given, 'auto'), is_simulated(), given)
