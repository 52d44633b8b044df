# SPDX-License-Identifier: Apache-2.0
"""The mode `policy`: it runs a policy, watches for a fall, and holds the pose on a fault."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

from humanoid_control.backends import JointTargets, Observation
from humanoid_control.controllers.modes import DOWN, Hold, Mode, POLICY
from humanoid_control.policy.policy import Policy, PolicyRobot
from humanoid_control.policy.policy_file import PolicyError
from humanoid_control.walking.commands import STANDING, VelocityCommand
import numpy as np

FAILED = 'the policy has failed; set the mode again, or another one'
NO_POLICY = "no policy is loaded; set the parameter 'policy'"
_EARLY_S = 1e-6
"""A decision may come earlier by this time, as sums of periods are rounded."""


class FallWatch(Protocol):
    """What notices a fall, and then moves the robot until it stands again."""

    @property
    def has_fallen(self) -> bool:
        """Whether the robot is falling, lies on the ground or is standing up."""

    def watch(self, observation: Observation) -> JointTargets | None:
        """
        Look at the robot once in a control period.

        Parameters
        ----------
        observation
            Sensor values of the current period.

        Returns
        -------
        JointTargets or None
            Targets of all joints while the robot is down; None while it stands.

        """


class PolicyController:
    """
    Controller of all joints that runs a policy at its own rate.

    Joints that the policy does not move are held. When the policy fails, all joints are held as
    they are until the mode is entered again.

    Parameters
    ----------
    robot
        The robot.
    fall_watch
        Notices a fall.
    say
        Receives a message when the policy fails.

    Attributes
    ----------
    robot, policy
        The robot, and its policy; without one, all joints are held.

    """

    name = POLICY

    def __init__(
        self, robot: PolicyRobot, fall_watch: FallWatch, say: Callable[[str], None]
    ) -> None:
        self.robot, self.joints = robot, robot.joints
        self._fall_watch, self._say = fall_watch, say
        self.policy: Policy | None = None
        self._hold = Hold(self.joints, POLICY)
        self._velocity = STANDING
        self.forget()

    def mode(self) -> Mode:
        """Build the mode, which leaves the joints that the policy does not move to others."""
        moved = range(len(self.joints)) if self.policy is None else self.policy.indices
        return Mode(
            POLICY,
            self,
            tuple(joint for index, joint in enumerate(self.joints) if index not in moved),
            take_back=self._hold.take_back,
            needs_all_because=self.needs_all_because,
            forget=self.forget,
        )

    def walk(self, velocity: VelocityCommand) -> None:
        """
        Set the velocity that the policy observes as its command.

        Parameters
        ----------
        velocity
            Velocity in the axes of the robot.

        """
        self._velocity = velocity

    def forget(self) -> None:
        """Begin anew with the next observation: the robot was put somewhere."""
        self._fault, self._due_s = '', -np.inf
        if self.policy is not None:
            self.policy.reset()

    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Begin to run the policy; until it decides, all joints are held.

        Parameters
        ----------
        observation, held
            As for `Controller.start`.

        """
        self.forget()
        self._hold.start(observation, held)

    def update(self, observation: Observation) -> JointTargets:
        """
        Compute the targets of all joints, as for `Controller.update`.

        Parameters
        ----------
        observation
            Sensor values of the current period.

        Returns
        -------
        JointTargets
            Those of the policy; or of the fall, or of the pose that is held on a fault.

        """
        down = self._fall_watch.watch(observation)
        if down is not None:
            self.forget()
            self._hold.start(observation, down)
            return down
        held = self._hold.update(observation)
        if self.policy is None or self._fault:
            return held
        try:
            self._decide(self.policy, observation)
        except PolicyError as error:
            self._fail(str(error))
            return held
        targets = _moved(held, self.policy, observation)
        self._hold.start(observation, targets)
        return targets

    def needs_all_because(self) -> str:
        """Return the reason for keeping all joints at the moment; empty if there is none."""
        if self._fall_watch.has_fallen:
            return DOWN
        return NO_POLICY if self.policy is None else self._fault

    def _decide(self, policy: Policy, observation: Observation) -> None:
        """Let the policy decide, if it is time to."""
        now_s, period_s = observation.time_s, 1.0 / policy.file.rate_hz
        if now_s < self._due_s - _EARLY_S:
            return
        velocity = self._velocity
        policy.decide(
            observation,
            np.array([velocity.forward_m_s, velocity.left_m_s, velocity.turn_rad_s]),
        )
        is_late = now_s > self._due_s + period_s
        self._due_s = (now_s if is_late else self._due_s) + period_s

    def _fail(self, sentence: str) -> None:
        """Hold all joints from now on, and say why."""
        self._fault = FAILED
        self._say(f'{sentence} The robot holds its pose.')


def _moved(held: JointTargets, policy: Policy, observation: Observation) -> JointTargets:
    """Replace the targets of the joints that a policy moves."""
    positions_rad, efforts_nm = held.positions_rad.copy(), held.efforts_nm.copy()
    positions_rad[policy.indices] = policy.targets_rad(observation)
    efforts_nm[policy.indices] = 0.0
    return replace(held, positions_rad=positions_rad, efforts_nm=efforts_nm)
