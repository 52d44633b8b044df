# SPDX-License-Identifier: Apache-2.0
"""What launch arguments mean: which time nodes have, and the namespaces of a fleet of robots."""

from __future__ import annotations

from launch import Substitution
from launch.substitutions import EqualsSubstitution, IfElseSubstitution, LaunchConfiguration

__all__ = ['is_simulated', 'robot_namespaces', 'robot_time']

MOST_ROBOTS = 50


def is_simulated() -> Substitution:
    """Build the substitution `true` if the argument `backend` is the simulator, else `false`."""
    return EqualsSubstitution(LaunchConfiguration('backend'), 'mujoco')


def robot_time() -> Substitution:
    """Build the substitution for `use_sim_time`: the argument, or, if `auto`, by the backend."""
    given = LaunchConfiguration('use_sim_time')
    return IfElseSubstitution(EqualsSubstitution(given, 'auto'), is_simulated(), given)


def robot_namespaces(count: str) -> list[str]:
    """
    List the namespaces of a fleet: robot1, robot2 and so on.

    Parameters
    ----------
    count
        How many robots, as the text of the launch argument: 1 to 50.

    Raises
    ------
    ValueError
        The text is not an integer within that range.

    """
    is_number = count.isascii() and count.isdigit()
    if not is_number or not 1 <= int(count) <= MOST_ROBOTS:
        raise ValueError(_refusal(count))
    return [f'robot{index}' for index in range(1, int(count) + 1)]


def _refusal(count: str) -> str:
    """Build the error message for an invalid count."""
    return (
        f"Launch argument 'robots' is '{count}', but must be a whole number "
        f"from 1 to {MOST_ROBOTS}. Pass for example 'robots:=3'."
    )
