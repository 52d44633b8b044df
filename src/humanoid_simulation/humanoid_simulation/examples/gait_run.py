# SPDX-License-Identifier: Apache-2.0
"""Simulate a walk without ROS, as fast as possible."""

from __future__ import annotations

from dataclasses import dataclass

from humanoid_control.hosting.control_loop import ControlLoop
from humanoid_control.hosting.walking_robot import WalkingRobotControl
from humanoid_control.walking import VelocityCommand
from humanoid_control.walking.velocity_command import STANDING
from humanoid_description.loading import load_robot
from humanoid_simulation.backend import MujocoBackend
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.examples.fall_watch import FallWatch, tilt_rad
from humanoid_simulation.examples.gait_recording import GaitRecorder, GaitRecording
from humanoid_simulation.model import humanoid
from humanoid_simulation.scene import Scene

STANDING_S = 1.0
STOPPING_S = 3.0
LONGEST_S = 600.0


@dataclass(frozen=True)
class GaitPlan:
    """A walk at a constant velocity command, with standing before and after."""

    velocity: VelocityCommand
    walking_s: float

    def __post_init__(self) -> None:
        """Validate the duration of the walk."""
        if not 0.0 < self.walking_s <= LONGEST_S:
            raise SimulationError(
                f'A walk of {self.walking_s:g} s cannot be recorded. '
                f'Give more than 0 and at most {LONGEST_S:g} s.'
            )

    @property
    def duration_s(self) -> float:
        """Return the total duration, including standing before and after."""
        return STANDING_S + self.walking_s + STOPPING_S

    def velocity_at(self, time_s: float) -> VelocityCommand:
        """
        Look up the velocity command at a time; it is zero before and after the walk.

        Parameters
        ----------
        time_s
            Time since the start.

        """
        is_walking = STANDING_S <= time_s < STANDING_S + self.walking_s
        return self.velocity if is_walking else STANDING


def record_walk(plan: GaitPlan, scene: Scene = Scene()) -> GaitRecording:
    """
    Simulate a walk of the humanoid without ROS, and record it.

    Parameters
    ----------
    plan
        The velocity command, and its duration.
    scene
        The world that it walks in.

    Returns
    -------
    GaitRecording
        One row for each control period, standing before and after included.

    Raises
    ------
    SimulationError
        The robot falls, or the world cannot be simulated.

    """
    description = humanoid()
    backend = MujocoBackend(description, scene)
    robot = load_robot(description.urdf, 'the URDF of the humanoid')
    control = WalkingRobotControl.of(robot, description.drives).control
    loop = ControlLoop(backend, {'': control})
    recorder, watch = GaitRecorder(backend.model, backend.joints), FallWatch()
    while backend.time_s < plan.duration_s:
        control.walk(plan.velocity_at(backend.time_s))
        snapshot = backend.snapshot()
        recorder.note(loop.tick()[''], snapshot)
        _check(backend, watch)
    return recorder.recording()


def _check(backend: MujocoBackend, watch: FallWatch) -> None:
    """Raise SimulationError if the robot has fallen."""
    base = backend.ground_truth()
    w, x, y, z = base.orientation.tolist()
    if not watch.stands(float(base.position_m[2]), tilt_rad(x, y, z, w)):
        raise SimulationError(
            f'The robot fell after {backend.time_s:.2f} s, so that there is no gait to show. '
            'Let it walk slower.'
        )
