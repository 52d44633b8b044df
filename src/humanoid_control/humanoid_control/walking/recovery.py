# SPDX-License-Identifier: Apache-2.0
"""Fall recovery: detection of a fall, a compliant fall, getting up, and standing again."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
import math

from humanoid_control.backends import Array, JointTargets
from humanoid_control.walking.balance import Balance
from humanoid_control.walking.get_up import GetUp, Rising
from humanoid_control.walking.parameters import WalkParameters
from humanoid_control.walking.planar import NAMES, outwards, SIDES
from humanoid_control.walking.support_polygon import FootShape
from humanoid_control.walking.walking_robot import HomePosture, RobotState, WalkingRobot
import numpy as np

_CROUCHED_RAD = {'hip_pitch': -1.1, 'knee': 1.9, 'ankle_pitch': -0.8}
_ARMS_RAD = {'shoulder': -0.6, 'elbow': -1.2}
_ARM_ROLL_RAD = 0.4


class Recovery:
    """
    Fall recovery: takes control when the robot falls, and returns it when the robot stands.

    A robot that falls goes limp. When it has lain for a while, it gets up by itself, unless a stop
    forbids that, or it has given up. When it is upright above its feet, by itself, by hand or by a
    hoist, it moves to the standing posture; when its feet then carry it, it is ready to walk.

    Parameters
    ----------
    robot, shape
        The robot, and the supporting rectangle of its soles.
    home
        Standing posture, and the height of the base in it.
    parameters : WalkParameters
        Gait parameters, with the thresholds of fall detection and the durations.
    may_get_up
        Returns whether the robot may get up by itself now; a stop forbids it.

    Attributes
    ----------
    has_given_up
        Whether the robot has not managed to get up: it stays limp until it is helped up.

    """

    def __init__(
        self,
        robot: WalkingRobot,
        shape: FootShape,
        home: HomePosture,
        parameters: WalkParameters,
        may_get_up: Callable[[], bool] = lambda: True,
    ) -> None:
        self._robot, self._shape, self._home = robot, shape, home
        self._parameters = parameters
        self._detector = FallDetector(parameters, home.base_height_m)
        self._may_get_up = may_get_up
        self._action: Collapse | GetUp | Rising | None = None
        self.has_given_up = False

    @property
    def phase(self) -> str | None:
        """Return 'fallen' or 'stand_up', or None as long as the robot stands by itself."""
        return self._action.name if self._action else None

    @property
    def will_get_up(self) -> bool:
        """Whether the robot lies limp and is to get up by itself soon."""
        return isinstance(self._action, Collapse) and self._is_allowed_up()

    def update(self, sensed: RobotState, positions_rad: Array) -> JointTargets | None:
        """
        Advance the recovery from a fall by one control period.

        Parameters
        ----------
        sensed
            Estimated state of the robot.
        positions_rad
            Measured joint positions (n,).

        Returns
        -------
        JointTargets or None
            Targets of the joints (n,); None if the robot stands by itself.

        """
        time_s, stance = sensed.time_s, StandingState.of(self._robot, sensed)
        self._action = self._next(time_s, stance, positions_rad)
        if isinstance(self._action, Collapse):
            return self._action.targets(time_s, positions_rad)
        if isinstance(self._action, GetUp):
            return self._action.update(sensed, self._detector.can_stand(stance))
        return self._action.targets(time_s) if self._action else None

    def _next(
        self, time_s: float, stance: StandingState, positions_rad: Array
    ) -> Collapse | GetUp | Rising | None:
        """Select the next action from the stance of the robot."""
        action = self._action
        if isinstance(action, Collapse):
            return self._lying(time_s, action, stance, positions_rad)
        if isinstance(action, GetUp):
            return self._getting_up(time_s, action, stance, positions_rad)
        if self._detector.is_falling(stance):
            return Collapse(self._robot, self._parameters, time_s)
        if isinstance(action, Rising) and self._carries_itself(time_s, action, stance):
            self.has_given_up = False
            return None
        return action

    def _lying(
        self, time_s: float, action: Collapse, stance: StandingState, positions_rad: Array
    ) -> Collapse | GetUp | Rising:
        """Select the next action of a robot that is limp."""
        if self._detector.can_stand(stance):
            return Rising(positions_rad, self._home.positions_rad, self._parameters, time_s)
        if self._is_allowed_up() and action.has_lain(time_s):
            balance = Balance(self._robot, self._shape, self._parameters)
            return GetUp(self._robot, balance.efforts_nm, self._parameters, time_s, positions_rad)
        return action

    def _is_allowed_up(self) -> bool:
        return self._parameters.fall.get_up and not self.has_given_up and self._may_get_up()

    def _getting_up(
        self, time_s: float, action: GetUp, stance: StandingState, positions_rad: Array
    ) -> Collapse | GetUp | Rising | None:
        """Select the next action of a robot that gets up."""
        can_stand = self._detector.can_stand(stance)
        goes_on = self._may_get_up() and not action.is_over
        if goes_on and (action.is_rising or not can_stand):
            return action
        if not can_stand:
            self.has_given_up = action.is_over
            return Collapse(self._robot, self._parameters, time_s)
        if action.is_over and stance.load > self._parameters.fall.standing_load:
            return None
        return Rising(positions_rad, self._home.positions_rad, self._parameters, time_s)

    def _carries_itself(self, time_s: float, rising: Rising, stance: StandingState) -> bool:
        """Check whether the robot is in the standing posture and its feet carry it."""
        return rising.is_done(time_s) and stance.load > self._parameters.fall.standing_load


@dataclass(frozen=True)
class StandingState:
    """How the robot stands: tilt and height of the base, and the load on the soles."""

    tilt_rad: float
    """Angle between the z axis of the base and the vertical."""
    tilting_rad_s: float
    """Rate of the tilt; negative while the robot rights itself."""
    height_m: float
    """Height of the base above the lower one of the soles."""
    load: float
    """Normal force on the soles, as a fraction of the weight."""

    @classmethod
    def of(cls, robot: WalkingRobot, sensed: RobotState) -> StandingState:
        """
        Compute the stance from the estimated state of the robot.

        Parameters
        ----------
        robot
            The robot, with the sole links of its legs.
        sensed
            Estimated state of the robot.

        """
        _, _, z = sensed.state.base_rotation.T.tolist()
        sine = math.hypot(z[0], z[1])
        rates = sensed.state.base_angular_velocity_rad_s.tolist()
        # The tip of the z axis moves with the cross product of the rates and the axis.
        outwards = rates[1] * z[0] - rates[0] * z[1]
        soles = (sensed.state.position_m(robot.legs[side].sole)[2] for side in SIDES)
        return cls(
            math.atan2(sine, z[2]),
            outwards / sine if sine > 0.0 else math.hypot(rates[0], rates[1]),
            -float(min(soles)),
            sum(sensed.loads),
        )


@dataclass(frozen=True)
class FallDetector:
    """Fall detector by thresholds of the tilt and the height of the base."""

    parameters: WalkParameters
    standing_height_m: float

    def is_falling(self, stance: StandingState) -> bool:
        """
        Check whether the robot is falling: it leans too far, soon will, or its base is too low.

        The tilt rate of an upright robot is ignored, since the landing of a foot jerks it.

        Parameters
        ----------
        stance
            Tilt and height of the base.

        """
        p = self.parameters
        foresight_s = p.fall.foresight_s if stance.tilt_rad > p.fall.upright_tilt_rad else 0.0
        soon_rad = stance.tilt_rad + foresight_s * max(0.0, stance.tilting_rad_s)
        return (
            soon_rad > p.fall.tilt_rad or stance.height_m < p.fall.height * self.standing_height_m
        )

    def can_stand(self, stance: StandingState) -> bool:
        """
        Check whether the base is upright and high enough above the soles to stand up from there.

        Parameters
        ----------
        stance
            Tilt and height of the base.

        """
        p = self.parameters
        return (
            stance.tilt_rad < p.fall.upright_tilt_rad
            and stance.height_m > p.fall.height * self.standing_height_m
        )


class Collapse:
    """
    Compliant fall in progress, and the limp state after it.

    Targets near the measured positions reduce the stiffness of the servos to a fraction; their
    damping is unchanged. The knees yield, and the robot sinks. Later the fraction is zero: the
    robot lies still, and its joints can be moved by hand.

    Parameters
    ----------
    robot
        The robot, whose joints become compliant.
    parameters : WalkParameters
        Gait parameters, with the stiffness and the duration of a compliant fall.
    time_s
        Time of the observation at which the fall starts.

    Raises
    ------
    DynamicsError
        The robot lacks a joint of the protective posture.

    """

    name = 'fallen'

    def __init__(self, robot: WalkingRobot, parameters: WalkParameters, time_s: float) -> None:
        self._parameters = parameters
        self._start_s = time_s
        self._posture_rad = _protective_posture(robot)

    def has_lain(self, time_s: float) -> bool:
        """
        Check whether the robot has been limp for so long that it may get up.

        Parameters
        ----------
        time_s
            Present time, on the same clock as the start.

        """
        fall = self._parameters.fall
        return time_s - self._start_s >= fall.collapse_s + fall.lie_s

    def targets(self, time_s: float, positions_rad: Array) -> JointTargets:
        """
        Compute the joint targets of a compliant fall.

        Parameters
        ----------
        time_s
            Time of the observation, on the same clock as the start of the fall.
        positions_rad
            Measured joint positions (n,).

        Returns
        -------
        JointTargets
            Positions a fraction of the way from the measured ones to a protective posture, which
            acts as a lower stiffness (none after `collapse_s`); velocities and efforts are zero.

        """
        p, zeros = self._parameters, np.zeros(len(positions_rad))
        falls = time_s - self._start_s < p.fall.collapse_s
        share = p.fall.collapse_stiffness if falls else 0.0
        wanted = positions_rad + share * (self._posture_rad - positions_rad)
        return JointTargets(wanted, zeros, zeros.copy())


def _protective_posture(robot: WalkingRobot) -> Array:
    """Compute the protective posture (n,): crouched, with the arms in front of the body."""
    posture = np.zeros(len(robot.body.joints))
    for side in SIDES:
        for joint, angle_rad in {**_CROUCHED_RAD, **_ARMS_RAD}.items():
            posture[robot.index(f'{NAMES[side]}_{joint}')] = angle_rad
        roll = robot.index(f'{NAMES[side]}_shoulder_roll')
        posture[roll] = outwards(side) * _ARM_ROLL_RAD
    return posture
