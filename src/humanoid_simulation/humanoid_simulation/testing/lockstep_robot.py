# SPDX-License-Identifier: Apache-2.0
"""A robot that walks in a world of its own, in lockstep and without ROS, and may miss ticks."""

from __future__ import annotations

import cmath
from collections.abc import Callable, Mapping, Sequence
import math

from humanoid_control.hosting.walking_robot import WalkingRobotControl
from humanoid_control.walking import PlanarPose, VelocityCommand, WalkParameters
from humanoid_description.loading import load_robot
from humanoid_description.rotations import from_quaternion, yaw_of
from humanoid_simulation.backend.mujoco_backend import MujocoBackend
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.backend.state import EntityState
from humanoid_simulation.examples.fall_watch import FallWatch, tilt_rad
from humanoid_simulation.keyframes import Keyframe, load_keyframes
from humanoid_simulation.model import humanoid
from humanoid_simulation.scene.scene import Scene
import numpy as np

DEFAULT_WALK = WalkParameters()
PUSH_S = 0.1
"""Duration of a push."""

NEAR_M = 0.15
ROUTES = {
    'hall': [(-2.0, 0.0)],
    'kitchen': [(1.3, 0.0), (1.3, 1.7)],
    'bedroom': [(2.4, 0.0), (4.35, 0.0), (4.4, 1.6)],
    'living_room': [(2.7, 0.0), (2.7, -1.5)],
}
FROM_HALL = [(-1.6, -0.3), (-1.6, -1.5), (0.2, -1.6)]


def never() -> bool:
    """Return False: the controller misses no tick."""
    return False


class LockstepRobot:
    """
    Backend and controller in lockstep; at a missed tick, the joints keep their last targets.

    Parameters
    ----------
    settings, scene
        The settings of the simulation, and the scene.
    misses
        Called at each tick; returns whether the controller misses it.
    hands
        Whether the robot has wrists and grippers.
    walk
        Parameters of the walk; others than the defaults also change the initial posture.
    keyframes
        Further postures for `reset`, by name.

    Attributes
    ----------
    backend, walking
        The world, and the walking controller of the robot.

    Raises
    ------
    SimulationError
        Such a world cannot be built.

    """

    def __init__(
        self,
        settings: BackendSettings = BackendSettings(),
        scene: Scene = Scene(),
        misses: Callable[[], bool] = never,
        hands: bool = False,
        walk: WalkParameters = DEFAULT_WALK,
        keyframes: Mapping[str, Keyframe] = {},
    ) -> None:
        description = humanoid(hands=hands)
        robot = load_robot(description.urdf, 'the humanoid')
        self.walking = WalkingRobotControl.of(
            robot, description.drives, walk, imu=settings.noise.imu(settings.period_s)
        )
        known = {**load_keyframes(), **keyframes}
        if walk != DEFAULT_WALK:
            known['home'] = Keyframe(self.walking.home_rad)
        self.backend = MujocoBackend(description, scene, settings=settings, keyframes=known)
        self._velocity = VelocityCommand()
        self._misses = misses
        self._fall_watch = FallWatch()

    @property
    def truth(self) -> EntityState:
        """Return the true pose and velocity of the base."""
        return self.backend.ground_truth()

    @property
    def pose(self) -> PlanarPose:
        """Return the true pose of the base on the ground."""
        truth = self.truth
        x, y, _ = truth.position_m.tolist()
        return PlanarPose(complex(x, y), yaw_of(from_quaternion(truth.orientation)))

    @property
    def tilt_rad(self) -> float:
        """Return the true angle between the vertical and the z axis of the base."""
        w, x, y, z = self.truth.orientation.tolist()
        return tilt_rad(x, y, z, w)

    @property
    def stands(self) -> bool:
        """Whether the robot has not fallen; the first access, while it stands, sets the height."""
        return self._fall_watch.stands(float(self.truth.position_m[2]), self.tilt_rad)

    def drive(self, forward: float = 0.0, left: float = 0.0, turn: float = 0.0) -> None:
        """
        Command a velocity from now on; without arguments, stand.

        Parameters
        ----------
        forward, left
            Linear velocity in the axes of the robot, in m/s.
        turn
            Yaw rate, anticlockwise, in rad/s.

        """
        self._velocity = VelocityCommand(forward, left, turn)

    def push(self, direction: complex, impulse_ns: float) -> None:
        """
        Push the base from the next control period on, for `PUSH_S`.

        Parameters
        ----------
        direction
            Unit vector x + iy of the ground plane, in the world frame.
        impulse_ns
            Force times duration, in N s.

        """
        force_n = direction * impulse_ns / PUSH_S
        self.backend.apply_wrench(
            'base_link', (force_n.real, force_n.imag, 0.0), duration_s=PUSH_S
        )

    def wait(self, duration_s: float) -> bool:
        """
        Advance the simulation for a duration, or until the robot falls.

        Parameters
        ----------
        duration_s
            The duration, in s of simulated time.

        Returns
        -------
        bool
            Whether the robot is still on its feet.

        """
        for _ in range(round(duration_s / self.backend.period_s)):
            self.tick()
            if not self.stands:
                return False
        return True

    def tick(self) -> None:
        """Advance the simulation by one control period."""
        if self._misses():
            self.backend.step({})
        else:
            control = self.walking.control
            control.walk(self._velocity)
            self.backend.step({'': control.update(self.backend.observe()[''])})

    def reset(self, keyframe: str = 'home') -> None:
        """
        Reset the robot and the scene to their initial state, but not the time.

        Parameters
        ----------
        keyframe
            The name of the keyframe of the robot.

        """
        self.backend.reset(keyframe)
        self.walking.control.reset()


def steer(pose: PlanarPose, goal_m: tuple[float, float]) -> tuple[float, float]:
    """
    Compute the velocity command towards a point: turn first, then walk.

    Parameters
    ----------
    pose
        The pose of the robot.
    goal_m
        The point, in m, in the frame of the pose.

    Returns
    -------
    float, float
        Forward velocity in m/s, and yaw rate in rad/s, positive to the left.

    """
    way = complex(*goal_m) - pose.position_m
    off_rad = math.remainder(cmath.phase(way) - pose.yaw_rad, math.tau)
    turn_rad_s = max(-0.6, min(0.6, 1.5 * off_rad))
    return (0.0, turn_rad_s) if abs(off_rad) > 0.35 else (0.3, turn_rad_s)


def distance_m(pose: PlanarPose, goal_m: tuple[float, float]) -> float:
    """
    Compute the distance from a pose to a point, in m.

    Parameters
    ----------
    pose
        The pose of the robot.
    goal_m
        The point (x, y), in the frame of the pose.

    """
    return abs(complex(*goal_m) - pose.position_m)


def walk(robot: LockstepRobot, route: Sequence[tuple[float, float]]) -> None:
    """
    Walk along waypoints.

    Parameters
    ----------
    robot
        A robot in lockstep with its simulator.
    route
        The waypoints (x, y) in order, in m in the world frame.

    Raises
    ------
    AssertionError
        The robot falls, is blocked, or does not reach a waypoint within a minute.

    """
    for goal_m in route:
        for _ in range(600):
            if distance_m(robot.pose, goal_m) < NEAR_M:
                break
            forward, turn = steer(robot.pose, goal_m)
            robot.drive(forward, turn=turn)
            assert robot.wait(0.1), f'it fell at {robot.pose} on its way to {goal_m}'
            assert not robot.walking.walker.is_blocked, f'something is in its way at {robot.pose}'
        assert distance_m(robot.pose, goal_m) < NEAR_M, f'it is at {robot.pose}, not {goal_m}'


class DropOuts:
    """
    Random drop-outs of control: ticks that are missed because the computer is overloaded.

    Parameters
    ----------
    random
        Source of random numbers.
    chance
        Probability that a drop-out starts at a tick, unless one is in progress.
    longest_ticks
        Maximum length of a drop-out; lengths from 1 tick are uniformly distributed.

    """

    def __init__(self, random: np.random.Generator, chance: float, longest_ticks: int) -> None:
        self._random = random
        self._chance = chance
        self._longest_ticks = longest_ticks
        self._left = 0

    def misses(self) -> bool:
        """Decide whether the controller misses this tick; call once per tick."""
        if self._left == 0 and self._random.random() < self._chance:
            self._left = int(self._random.integers(1, self._longest_ticks + 1))
        missed = self._left > 0
        self._left -= missed
        return missed
