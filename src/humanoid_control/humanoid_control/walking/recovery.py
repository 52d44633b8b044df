# SPDX-License-Identifier: Apache-2.0
"""Fall recovery: from a fall until the robot stands again."""

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
    Fall recovery: takes control when the robot falls, and returns it when the robot stands.

    The robot cannot get up from the ground by itself. When it is held upright above its feet, by
    hand or by a hoist, or is placed there, it moves to the standing posture; when its feet then
    carry it, it is ready to walk.

    Parameters
    ----------
    robot
        The robot.
    home
        Standing posture, and the height of the base in it.
    parameters : WalkParameters
        Gait parameters, with the thresholds of fall detection and the durations.

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
            Time of the observation.
        stance
            Tilt and height of the base, and the load on the feet.
        positions_rad
            Measured joint positions (n,).

        Returns
        -------
        JointTargets or None
            Targets of the joints (n,); None if the robot stands by itself.

        """
        self._action = self._next(time_s, stance, positions_rad)
        if isinstance(self._action, Collapse):
            return self._action.targets(time_s, positions_rad)
        return self._action.targets(time_s) if self._action else None

    def _next(
        self, time_s: float, stance: Stance, positions_rad: Array
    ) -> Collapse | Rising | None:
        """Select the next action from the stance of the robot."""
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
        """Check whether the robot is in the standing posture and its feet carry it."""
        return rising.is_done(time_s) and stance.load > self._parameters.fall.standing_load
