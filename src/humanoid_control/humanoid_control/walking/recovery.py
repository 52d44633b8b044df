# SPDX-License-Identifier: Apache-2.0
"""What the robot does from a fall until it stands again."""

from __future__ import annotations

from humanoid_control.backends import Array, JointTargets
from humanoid_control.walking.collapse import Collapse
from humanoid_control.walking.fall_detector import FallDetector, Stance
from humanoid_control.walking.home_posture import HomePosture
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.rising import Rising
from humanoid_control.walking.walking_robot import WalkingRobot


class Recovery:
    """
    Fall recovery: takes over when the robot falls, and gives the robot back when it stands.

    It cannot get up from the ground by itself. Whoever holds it upright above its feet, by hand,
    by a hoist or by putting it there, makes it take the posture of standing; when its feet then
    carry it, it is ready to walk.

    Parameters
    ----------
    robot
        The robot.
    home
        The posture of standing, and the height of the base in it.
    parameters : WalkParameters
        The gait, which has the limits by which a fall is detected and the durations.

    """

    def __init__(self, robot: WalkingRobot, home: HomePosture, parameters: WalkParameters) -> None:
        self._robot, self._home, self._parameters = robot, home, parameters
        self._detector = FallDetector(parameters, home.base_height_m)
        self._action: Collapse | Rising | None = None

    @property
    def phase(self) -> str | None:
        """Return 'fallen' or 'stand_up', or None as long as the robot stands by itself."""
        return self._action.name if self._action else None

    def update(self, time_s: float, stance: Stance, positions_rad: Array) -> JointTargets | None:
        """
        Advance the recovery from a fall by one control period.

        Parameters
        ----------
        time_s
            The time of the robot's clock.
        stance
            How upright the robot is, and what its feet carry.
        positions_rad
            Of the joints (n,), as measured.

        Returns
        -------
        JointTargets or None
            What the joints (n,) are to do; None if the robot stands by itself.

        """
        self._action = self._next(time_s, stance, positions_rad)
        if isinstance(self._action, Collapse):
            return self._action.targets(time_s, positions_rad)
        return self._action.targets(time_s) if self._action else None

    def _next(
        self, time_s: float, stance: Stance, positions_rad: Array
    ) -> Collapse | Rising | None:
        """Return what follows from how upright the robot is."""
        action = self._action
        if isinstance(action, Collapse):
            if self._detector.can_stand(stance):
                return Rising(positions_rad, self._home.positions_rad, self._parameters, time_s)
            return action
        if self._detector.is_falling(stance):
            return Collapse(self._robot, self._parameters, time_s)
        if isinstance(action, Rising) and self._carries_itself(time_s, action, stance):
            return None
        return action

    def _carries_itself(self, time_s: float, rising: Rising, stance: Stance) -> bool:
        """Tell whether the robot is ready and its feet carry it."""
        return rising.is_done(time_s) and stance.load > self._parameters.fall.standing_load
