# SPDX-License-Identifier: Apache-2.0
"""One robot in a simulated world."""

from __future__ import annotations

from collections import deque
from typing import Any

from humanoid_control.backends import Array, JointTargets, Observation
from humanoid_description.drives import PRISMATIC
from humanoid_simulation.backend.layout import layout_of
from humanoid_simulation.backend.noise import NoiseSource
from humanoid_simulation.backend.posing import pose
from humanoid_simulation.backend.sensing import Sensors
from humanoid_simulation.backend.servos import check_targets, Servos
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.keyframes import Keyframe
from humanoid_simulation.model import Placement, RobotDescription
import numpy as np


class SimulatedRobot:
    """
    Servos and sensors of one robot in a simulated world.

    Parameters
    ----------
    model, data
        The compiled MuJoCo world, and its state, in which the inputs of the servos are set.
    description
        Description of the robot.
    place
        Its name, and its initial pose on the ground.
    settings
        Control period, sensor noise, latency, and extrapolation of targets.
    random
        Source of random numbers for the sensor noise.

    Raises
    ------
    SimulationError
        The inertial measurement unit is not fixed to the base.

    """

    def __init__(
        self,
        model: Any,
        data: Any,
        description: RobotDescription,
        place: Placement,
        settings: BackendSettings,
        random: np.random.Generator,
    ) -> None:
        self._description, self._place = description, place
        self._joints, self._prefix = tuple(description.drives), description.prefix
        drives = description.drives.values()
        self._servos = Servos(drives, settings.period_s, settings.extrapolation_s)
        slides = [drive.kind == PRISMATIC for drive in drives]
        self._noise = NoiseSource(settings.noise, len(self._joints), random, slides)
        self._measured: deque[Observation] = deque(maxlen=settings.latency_periods + 1)
        self.enter(model, data)

    def enter(self, model: Any, data: Any) -> None:
        """
        Switch to another model, in which the robot may have other indices.

        Parameters
        ----------
        model, data
            The new MuJoCo model and its state, in which the inputs of the servos are set again.

        """
        self._model, self._data = model, data
        self._layout = layout_of(model, self._description, self._place.robot)
        self._sensors = Sensors(model, data, self._layout, self._noise)
        data.ctrl[self._layout.servos] = self._servos.inputs

    def check(self, targets: JointTargets) -> None:
        """
        Check joint targets before they are commanded.

        Parameters
        ----------
        targets
            For all joints of the robot, in their order.

        Raises
        ------
        SimulationError
            Their number is wrong, or a value is not finite.

        """
        check_targets(self._place.robot, self._joints, targets)

    def command(self, targets: JointTargets | None) -> None:
        """
        Command the servos for the coming period.

        Parameters
        ----------
        targets
            New targets, already validated by `check`; None continues with the last ones.

        """
        if targets is None:
            self._servos.go_on()
        else:
            self._servos.take(targets)
        self._data.ctrl[self._layout.servos] = self._servos.inputs

    def posture(self, keyframe: Keyframe) -> Array:
        """
        Arrange the joint positions of a keyframe in the order of the robot's joints.

        Parameters
        ----------
        keyframe
            The posture.

        Returns
        -------
        Array
            Positions (n,) in rad, or in m for a prismatic joint.

        Raises
        ------
        SimulationError
            The keyframe sets a joint that the robot does not have.

        """
        return keyframe.positions_rad(self._joints, self._prefix)

    @property
    def base(self) -> int:
        """Return the body id of the floating base."""
        return self._layout.base

    def put(self, keyframe: Keyframe, positions_rad: Array) -> None:
        """
        Reset the robot to its initial place, at rest in a posture that its servos hold.

        Parameters
        ----------
        keyframe
            Roll and pitch of the base.
        positions_rad
            Positions of the joints (n,), from `posture`.

        """
        layout, data = self._layout, self._data
        pose(self._model, data, layout, self._place, keyframe, positions_rad)
        data.qvel[layout.floating.linear] = data.qvel[layout.floating.angular] = 0.0
        data.qvel[layout.velocities] = data.qvel[layout.follower_velocities] = 0.0
        self._servos.reset(positions_rad)
        data.ctrl[layout.servos] = self._servos.inputs

    def forget(self) -> None:
        """Clear the latency buffer: its observations predate a change of the state."""
        self._measured.clear()

    def measure(self, time_s: float) -> None:
        """
        Read the sensors; `observe` returns the result after the latency.

        Parameters
        ----------
        time_s
            Current simulated time.

        """
        self._measured.append(self._sensors.measure(time_s))

    def observe(self) -> Observation:
        """Return the measurement that is as old as the latency."""
        return self._measured[0]
