# SPDX-License-Identifier: Apache-2.0
"""A robot that walks in a world of its own, in lockstep and without ROS: deterministic."""

from __future__ import annotations

from collections.abc import Callable

from humanoid_control.dynamics.rotations import from_quaternion, yaw_of
from humanoid_control.hosting.walking_robot import WalkingRobotControl
from humanoid_control.walking import PlanarPose, VelocityCommand
from humanoid_description.loading import load_robot
from humanoid_simulation.backend import BackendSettings, EntityState, MujocoBackend
from humanoid_simulation.examples.fall_watch import FallWatch, tilt_rad
from humanoid_simulation.model import humanoid
from humanoid_simulation.scene import Scene

PUSH_S = 0.1
"""Duration of a push."""


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
    ) -> None:
        description = humanoid(hands=hands)
        self.backend = MujocoBackend(description, scene, settings=settings)
        robot = load_robot(description.urdf, 'the humanoid')
        self.walking = WalkingRobotControl.of(
            robot, description.drives, imu=settings.noise.imu(settings.period_s)
        )
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
