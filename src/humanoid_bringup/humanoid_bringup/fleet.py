# SPDX-License-Identifier: Apache-2.0
"""The namespaces of a fleet of robots."""

from __future__ import annotations

MOST_ROBOTS = 50


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
