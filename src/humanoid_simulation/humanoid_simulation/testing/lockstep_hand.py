# SPDX-License-Identifier: Apache-2.0
"""The left hand of a robot in lockstep: it takes a bottle that is held out, and carries it."""

from __future__ import annotations

from collections.abc import Callable

from humanoid_control.controllers import GripResult, TrajectoryPoint, TrajectoryRequest
from humanoid_description.robot import Array
from humanoid_simulation.backend import EntityState
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.scene import Scene
from humanoid_simulation.scene.scene import Thing
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import mujoco
import numpy as np

__all__ = ['BOTTLE', 'LEVEL_RAD', 'LockstepHand']

BOTTLE = Thing('bottle', 'cylinder', (0.033, 0.22), (0.0, 3.0, 0.11), mass_kg=0.5)
LEVEL_RAD = (0.2, 0.15, 0.0, -1.77, 0.0, 0.0)
"""The upper arm hangs, and the forearm is level, so that what is held stands upright."""
_WIDER_M = 0.006
"""How much wider than the bottle the hand is opened."""
_ARM, _GRIPPER = 'left_arm_controller', 'left_gripper_controller'
_UPRIGHT = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
"""The rotation of an upright object in the gripper of a level forearm."""


def _ignore() -> None:
    """Do nothing after a control period."""


class LockstepHand:
    """
    The left hand of a robot that stands in an empty world, opened to take a bottle.

    Parameters
    ----------
    bottle
        The object that it takes: a cylinder.
    seed
        The seed of the sensors' noise.

    Attributes
    ----------
    robot
        The robot, with its forearm level.
    bottle
        The object.

    Raises
    ------
    AssertionError
        The robot falls.

    """

    def __init__(self, bottle: Thing = BOTTLE, seed: int = 3) -> None:
        settings = BackendSettings(noise=REALISTIC, seed=seed)
        self.bottle = bottle
        self.robot = LockstepRobot(settings, Scene(things=(bottle,)), hands=True)
        self._control = self.robot.walking.control
        self.move_arm(LEVEL_RAD)
        self.grip(self.width_m + _WIDER_M)
        assert self.robot.wait(2.0), 'the robot has fallen'

    @property
    def width_m(self) -> float:
        """Return the diameter of the bottle."""
        return 2.0 * self.bottle.size_m[0]

    @property
    def gap_m(self) -> float:
        """Return the measured gap between the fingers."""
        return self._control.goals.grippers[_GRIPPER].state.gap_m

    @property
    def true_gap_m(self) -> float:
        """Return the true gap between the fingers."""
        fingers = (f'robot/left_gripper{part}' for part in ('', '_thumb'))
        return sum(float(self.robot.backend.data.joint(name).qpos[0]) for name in fingers)

    @property
    def bottle_m(self) -> Array:
        """Return the true position (3,) of the bottle in the gripper, whose z points back."""
        position, rotation = self._frame()
        state = self.robot.backend.entity_state(self.bottle.name)
        return np.asarray(rotation.T @ (state.position_m - position))

    @property
    def arm_rad(self) -> Array:
        """Return the measured positions (6,) of the joints of the arm."""
        own = self._control.goals.limbs[_ARM].indices
        return self.robot.backend.observe()[''].positions_rad[own]

    def move_arm(self, posture_rad: tuple[float, ...]) -> None:
        """
        Start to move the arm to a posture within a second.

        Parameters
        ----------
        posture_rad
            The positions of its six joints, from the shoulder down.

        """
        arm = self._control.goals.limbs[_ARM]
        request = TrajectoryRequest(arm.own, [TrajectoryPoint(1.0, posture_rad)])
        arm.accept(self._control.goals.checked_goal(_ARM, request), lambda end: None)

    def grip(self, gap_m: float, most_n: float = 0.0) -> list[GripResult]:
        """
        Start to open or close the gripper.

        Parameters
        ----------
        gap_m, most_n
            The gap between the fingers, and the maximum force; 0 is that of the actuator.

        Returns
        -------
        list of GripResult
            Empty; the result is appended when the grip ends.

        """
        results = list[GripResult]()
        grip = self._control.goals.checked_grip(_GRIPPER, gap_m, most_n)
        self._control.goals.grippers[_GRIPPER].accept(grip, results.append)
        return results

    def take_bottle(self, most_n: float = 0.0, watch: Callable[[], None] = _ignore) -> GripResult:
        """
        Close the fingers around the bottle, which is held in their middle meanwhile.

        Parameters
        ----------
        most_n
            The maximum force; 0 is that of the actuator.
        watch
            Called after each control period.

        """
        results = self.grip(0.0, most_n)
        while not results:
            position, rotation = self._frame()
            turned = np.zeros(4)
            mujoco.mju_mat2Quat(turned, (rotation @ _UPRIGHT).ravel())
            held = EntityState(position, turned)
            self.robot.backend.set_entity_state(self.bottle.name, held)
            self.robot.tick()
            watch()
        return results[0]

    def _frame(self) -> tuple[Array, Array]:
        """Return the true position (3,) and rotation (3, 3) of the gripper."""
        body = self.robot.backend.data.body('robot/l_gripper')
        return body.xpos.copy(), body.xmat.reshape(3, 3).copy()
