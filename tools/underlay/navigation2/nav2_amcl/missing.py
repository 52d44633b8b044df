# SPDX-License-Identifier: Apache-2.0
"""Missing inputs of AMCL: why there is no pose, and how to fix it."""

from __future__ import annotations

from dataclasses import dataclass

__all__ = ['Inputs', 'Reminder', 'describe_missing']

_SCAN_LATE_S = 3.0


@dataclass(frozen=True)
class Inputs:
    """The inputs received so far, and where they are expected."""

    has_map: bool
    is_started: bool
    scan_age_s: float
    transform_problem: str
    map_topic: str
    scan_topic: str


def describe_missing(inputs: Inputs) -> list[str]:
    """
    Describe each missing input, and how to fix it.

    Parameters
    ----------
    inputs
        The inputs received so far.

    Returns
    -------
    list of str
        One message for each missing input; empty if nothing is missing.

    """
    found = []
    if not inputs.has_map:
        found.append(
            f"No map was received on '{inputs.map_topic}'. Start map_server with a map and "
            'activate it, or set map_topic.'
        )
    if not inputs.is_started:
        found.append(
            "The pose of the robot is unknown. Set it with '2D Pose Estimate' in RViz, on "
            'initialpose, or with set_initial_pose and initial_pose; or call '
            'reinitialize_global_localization.'
        )
    if inputs.scan_age_s > _SCAN_LATE_S:
        found.append(
            f"No scan was received on '{inputs.scan_topic}' for {inputs.scan_age_s:.0f} s. Check "
            'that the laser is running, and that scan_topic is right.'
        )
    elif inputs.transform_problem:
        found.append(
            f'Scans wait for a transform: {inputs.transform_problem.rstrip(".")}. Check that '
            'odometry and robot_state_publisher are running, that clocks agree (use_sim_time), '
            'and that odom_frame_id and base_frame_id are right.'
        )
    return found


class Reminder:
    """
    Rate-limited warning about missing inputs: first at the second check, then repeated.

    Parameters
    ----------
    again_after_s
        The time in s after which the same warning is repeated.

    """

    def __init__(self, again_after_s: float = 30.0) -> None:
        self._again_after_s = again_after_s
        self._last: list[str] = []
        self._said: dict[str, float] = {}

    def text_for(self, missing: list[str], now_s: float) -> str:
        """
        Return the text to log now, or an empty text.

        Parameters
        ----------
        missing
            Messages; only inputs that were also missing at the last check are reported. Messages
            with the same start count as the same.
        now_s
            The time in s.

        """
        keys = [_key(each) for each in missing]
        self._said = {key: said for key, said in self._said.items() if key in keys}
        due = [
            text
            for key, text in zip(keys, missing)
            if key in self._last and now_s - self._said.get(key, -1e9) >= self._again_after_s
        ]
        self._last = keys
        self._said.update({_key(text): now_s for text in due})
        return ' '.join(due)


def _key(text: str) -> str:
    return text[:20]
