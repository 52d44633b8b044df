# SPDX-License-Identifier: Apache-2.0
"""What launch arguments mean: which time nodes have, and the namespaces of a fleet of robots."""

from __future__ import annotations

from humanoid_common.naming import shortened
from launch import LaunchContext, Substitution
from launch.substitutions import EqualsSubstitution, IfElseSubstitution, LaunchConfiguration

__all__ = ['WholeNumber', 'is_simulated', 'robot_namespaces', 'robot_time', 'whole_number']

MOST_ROBOTS = 50
_DIGITS = 9
"""Whole numbers have no more digits than this."""


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
    robots = whole_number('robots', count, range(1, MOST_ROBOTS + 1), 3)
    return [f'robot{index}' for index in range(1, robots + 1)]


class WholeNumber(Substitution):
    """
    Substitution by a launch argument, which has to be a whole number.

    Parameters
    ----------
    name
        The argument.
    allowed, example
        As for `whole_number`.

    """

    def __init__(self, name: str, allowed: range, example: int) -> None:
        super().__init__()
        self._name, self._allowed, self._example = name, allowed, example

    def describe(self) -> str:
        """Return a human-readable description."""
        return f'WholeNumber({self._name})'

    def perform(self, context: LaunchContext) -> str:
        """
        Return the text of the argument.

        Parameters
        ----------
        context
            The launch context.

        Raises
        ------
        ValueError
            It is no such number.

        """
        text = LaunchConfiguration(self._name).perform(context)
        return str(whole_number(self._name, text, self._allowed, self._example))


def whole_number(name: str, text: str, allowed: range, example: int) -> int:
    """
    Read a launch argument that is a whole number.

    Parameters
    ----------
    name, text
        The argument, and its text.
    allowed
        The numbers that it may be.
    example
        One of them, for the message.

    Raises
    ------
    ValueError
        The text is none of them.

    """
    is_number = text.isascii() and text.isdigit() and len(text) <= _DIGITS
    if not is_number or int(text) not in allowed:
        raise ValueError(
            f"Launch argument '{name}' is '{shortened(text)}', but must be a whole number from "
            f"{allowed[0]} to {allowed[-1]}. Pass for example '{name}:={example}'."
        )
    return int(text)
