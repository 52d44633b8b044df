# SPDX-License-Identifier: Apache-2.0
"""How a policy decides: it observes the robot, and its action becomes targets of joints."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from humanoid_common.naming import did_you_mean
from humanoid_control.backends import Array, JointLimits, Observation
from humanoid_control.policy.network import Network, OnnxNetwork
from humanoid_control.policy.observation import ObservationHistory
from humanoid_control.policy.policy_file import PolicyFile, read_policy_file
from humanoid_description.rotations import from_quaternion
import numpy as np

DOWN = np.array([0.0, 0.0, -1.0])
Open = Callable[[PolicyFile], Network]


@dataclass(frozen=True, eq=False)
class PolicyRobot:
    """What a policy needs to know of a robot with n joints, in their order."""

    joints: tuple[str, ...]
    prefix: str
    limits: JointLimits
    kd_nm_s_rad: Array
    """Damping (n,) of its servos; their stiffness is in the limits."""
    imu_in_base: Array
    """(3, 3) rotation of `imu_link` in the base"""


class Policy:
    """
    A policy of m joints on a robot.

    Parameters
    ----------
    file
        The policy file.
    network
        Its network.
    robot
        The robot.

    Attributes
    ----------
    file
        The policy file.
    indices
        Indices (m,) of its joints among those of the robot.

    Raises
    ------
    PolicyError
        The robot has no such joint, or cannot take the default pose.

    """

    def __init__(self, file: PolicyFile, network: Network, robot: PolicyRobot) -> None:
        self.file, self._network, self._robot = file, network, robot
        known = [joint.removeprefix(robot.prefix) for joint in robot.joints]
        for joint in file.joints:
            if joint not in known:
                raise file.error(
                    f"The robot has no joint '{joint}'. {did_you_mean(joint, known)} It has: "
                    f'{", ".join(known)}.'
                )
        self.indices = np.array([known.index(joint) for joint in file.joints], dtype=np.intp)
        self._check_default()
        kp, kd = file.kp_nm_rad, file.kd_nm_s_rad
        own_kp, own_kd = robot.limits.kp_nm_rad[self.indices], robot.kd_nm_s_rad[self.indices]
        self._own_kp, self._own_kd = own_kp, own_kd
        self._kp, self._kd = own_kp if kp is None else kp, own_kd if kd is None else kd
        self._history = ObservationHistory(file)
        self.reset()

    @classmethod
    def load(cls, path: Path, robot: PolicyRobot, open_network: Open = OnnxNetwork) -> Policy:
        """
        Load a policy from its files.

        Parameters
        ----------
        path
            The YAML file, which names the network.
        robot
            The robot.
        open_network
            Opens the network.

        Raises
        ------
        UserError
            A file is missing or has a mistake, or does not fit to the robot.

        """
        file = read_policy_file(path)
        return cls(file, open_network(file), robot)

    def reset(self) -> None:
        """Forget the history and the last action, as at the start of an episode."""
        self._history.reset()
        self._action = np.zeros(len(self.indices))
        self._wanted_rad = self.file.default_rad

    def decide(self, observation: Observation, velocity: Array) -> None:
        """
        Decide where the joints are to be, until the next decision.

        Parameters
        ----------
        observation
            Sensor values of the robot.
        velocity
            Commanded velocity (3,): forward and to the left in m/s, anticlockwise in rad/s.

        Raises
        ------
        PolicyError
            The network cannot be run, or its action is not finite.

        """
        file = self.file
        to_base = self._robot.imu_in_base
        values = {
            'base_ang_vel': to_base @ observation.angular_velocity_rad_s,
            'projected_gravity': to_base @ from_quaternion(observation.orientation).T @ DOWN,
            'velocity_commands': velocity,
            'joint_pos_rel': observation.positions_rad[self.indices] - file.default_rad,
            'joint_vel_rel': observation.velocities_rad_s[self.indices],
            'last_action': self._action,
        }
        action = self._network.run(self._history.add(values))
        bad = np.flatnonzero(~np.isfinite(action))
        if len(bad):
            raise file.error(
                f"Its network returned {action[bad[0]]} for '{file.joints[bad[0]]}'. The network "
                'or the scales of the observation are wrong.'
            )
        self._action = np.clip(action, file.action_lower, file.action_upper)
        self._wanted_rad = file.default_rad + file.action_scale_rad * self._action

    def targets_rad(self, observation: Observation) -> Array:
        """
        Compute target positions (m,) that make the robot's servos act with the policy's gains.

        At the measured position and velocity, the servo exerts the torque that one with the gains
        of the policy would, within its torque limit.

        Parameters
        ----------
        observation
            Sensor values of the robot in the current control period.

        """
        positions_rad = observation.positions_rad[self.indices]
        speeds_rad_s = observation.velocities_rad_s[self.indices]
        lower, upper = self._range
        wanted_rad = np.minimum(np.maximum(self._wanted_rad, lower), upper)
        torques_nm = self._kp * (wanted_rad - positions_rad) - self._kd * speeds_rad_s
        limit_nm = self.file.torque_limit_nm
        torques_nm = np.minimum(np.maximum(torques_nm, -limit_nm), limit_nm)
        targets: Array = positions_rad + (torques_nm + self._own_kd * speeds_rad_s) / self._own_kp
        return targets

    @property
    def _range(self) -> tuple[Array, Array]:
        """Return the position limits of the joints (m,)."""
        limits = self._robot.limits
        return limits.lower_rad[self.indices], limits.upper_rad[self.indices]

    def _check_default(self) -> None:
        """Check that the joints can be where their actions count from."""
        lower, upper = self._range
        outside = (self.file.default_rad < lower) | (self.file.default_rad > upper)
        if outside.any():
            index = int(np.argmax(outside))
            raise self.file.error(
                f"Its default position of '{self.file.joints[index]}' is "
                f'{self.file.default_rad[index]:g} rad, but the joint moves from '
                f'{lower[index]:g} to {upper[index]:g} rad.'
            )
