# SPDX-License-Identifier: Apache-2.0
"""The environment `humanoid_gym/Reach-v0`: bring a gripper to a place."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from humanoid_control.backends import Array, Observation
from humanoid_description.drives import SIDES
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.kinematics import chain, pose_along
from humanoid_description.loading import load_robot
from humanoid_gym.actions import ArmActions
from humanoid_gym.environment import HumanoidEnv
from humanoid_gym.observing import Part
from humanoid_gym.rewards import effort, kernel, Motion
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import numpy as np

NEAR_M = 0.05
"""Within this distance, the target is reached."""
_LOWER_RAD, _UPPER_RAD = (-1.6, 0.1, -0.5, -1.8), (0.3, 1.0, 0.5, -0.2)
"""
Postures of the left arm from which targets are drawn, in which it is before or beside the body.

Shoulder pitch, roll and yaw, and elbow; on the right, roll and yaw turn the other way.
"""
_MIRRORED = np.array([1.0, -1.0, -1.0, 1.0])


class ReachEnv(HumanoidEnv):
    """
    Bring a gripper to a target with the four joints of the arm; the robot's own walk balances.

    Parameters
    ----------
    side
        The arm: `left` or `right`.
    **options
        As for `HumanoidEnv`: scene, noise, render_mode, width, height.

    Raises
    ------
    SimulationError
        There is no such scene, or it has a mistake.
    ValueError
        There is no such arm, or the render mode or the noise is not possible.

    """

    reset_options = ('target_m',)

    def __init__(self, side: str = 'left', **options: Any) -> None:
        if side not in SIDES:
            raise ValueError(f"There is no arm '{side}'. Give {' or '.join(SIDES)}.")
        self._side = side
        names = ('shoulder', 'shoulder_roll', 'shoulder_yaw', 'elbow')
        self._arm = tuple(f'{side}_{name}' for name in names)
        description = load_robot(humanoid_urdf(), 'the humanoid')
        self._chain = chain(description, f'{side[0]}_gripper', 'base_link')
        self._target_m = np.zeros(3)
        super().__init__(
            self._arm_actions, [Part('gripper', 3, 2.0), Part('target', 3, 2.0)], **options
        )

    def _arm_actions(self, robot: LockstepRobot) -> ArmActions:
        """Make actions that move the arm."""
        return ArmActions(robot, self._arm)

    def begin(self, options: Mapping[str, Any]) -> None:
        """
        Draw a target that the arm can reach.

        Parameters
        ----------
        options
            `target_m` fixes it: x, y and z in m in `base_link`.

        """
        arm_rad = self.np_random.uniform(_LOWER_RAD, _UPPER_RAD)
        if self._side != SIDES[0]:
            arm_rad = arm_rad * _MIRRORED
        drawn_m = self.gripper_m(dict(zip(self._arm, arm_rad.tolist(), strict=True)))
        target_m = np.asarray(options.get('target_m', drawn_m), dtype=np.float64)
        if target_m.shape != (3,) or not np.isfinite(target_m).all():
            raise ValueError(f'The target {target_m} is not a position: give x, y and z in m.')
        self._target_m = target_m

    def gripper_m(self, positions_rad: Mapping[str, float]) -> Array:
        """
        Compute where the gripper is, (3,) in m in `base_link`.

        Parameters
        ----------
        positions_rad
            Joint positions by name; those that are missing are at zero.

        """
        place: Array = pose_along(self._chain, positions_rad)[:3, 3]
        return place

    def task_values(self, sensed: Observation) -> dict[str, Array]:
        """
        Return where the gripper and the target are, in m in `base_link`.

        Parameters
        ----------
        sensed
            What the sensors measure, without noise.

        """
        return {'gripper': self._gripper_in(sensed), 'target': self._target_m}

    def rewards(self, motion: Motion) -> dict[str, float]:
        """
        Reward a gripper at the target, at little effort.

        The distance as a negative reward is the dense one of Plappert et al., "Multi-Goal
        Reinforcement Learning: Challenging Robotics Environments and Request for Research" (2018);
        the term `near`, which keeps the last centimetres worth while, and both weights are our
        own; the others are in `rewards`.

        Parameters
        ----------
        motion
            The motion of the robot in the last step.

        """
        distance_m = self._distance_m(motion.sensed)
        return {
            'distance': -2.0 * distance_m,
            'near': 1.0 * kernel(distance_m, NEAR_M),
            **effort(motion),
        }

    def details(self) -> dict[str, Any]:
        """Return the distance to the target, and whether it is reached."""
        distance_m = self._distance_m(self.robot.backend.observe()[''])
        return {'distance_m': distance_m, 'is_success': distance_m < NEAR_M}

    def _gripper_in(self, sensed: Observation) -> Array:
        """Compute where the gripper is."""
        positions = zip(self.robot.backend.joints, sensed.positions_rad.tolist(), strict=True)
        return self.gripper_m(dict(positions))

    def _distance_m(self, sensed: Observation) -> float:
        """Compute the distance of the gripper to the target."""
        return float(np.linalg.norm(self._gripper_in(sensed) - self._target_m))
