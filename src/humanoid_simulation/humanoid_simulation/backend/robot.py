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
    """Its drives and its sensors."""

    def __init__(
        self,
        model: Any,
        data: Any,
        description: RobotDescription,
        place: Placement,
        settings: BackendSettings,
        random: np.random.Generator,
    ) -> None:
        """Find the robot in the world."""
        self._description, self._place = description, place
        self._joints, self._prefix = tuple(description.drives), description.prefix
        drives = description.drives.values()
        self._servos = Servos(drives, settings.period_s, settings.extrapolation_s)
        slides = [drive.kind == PRISMATIC for drive in drives]
        self._noise = NoiseSource(settings.noise, len(self._joints), random, slides)
        self._measured: deque[Observation] = deque(maxlen=settings.latency_periods + 1)
        self.enter(model, data)

    def enter(self, model: Any, data: Any) -> None:
        """Go on in a world in which the robot may have other numbers, as it is."""
        self._model, self._data = model, data
        self._layout = layout_of(model, self._description, self._place.robot)
        self._sensors = Sensors(model, data, self._layout, self._noise)
        data.ctrl[self._layout.servos] = self._servos.inputs

    def check(self, targets: JointTargets) -> None:
        """Refuse targets that the robot cannot be given."""
        check_targets(self._place.robot, self._joints, targets)

    def command(self, targets: JointTargets | None) -> None:
        """Tell the drives what to do in the coming period; None is nothing new."""
        if targets is None:
            self._servos.go_on()
        else:
            self._servos.take(targets)
        self._data.ctrl[self._layout.servos] = self._servos.inputs

    def posture(self, keyframe: Keyframe) -> Array:
        """Return the positions of the joints in a keyframe."""
        return keyframe.positions_rad(self._joints, self._prefix)

    @property
    def base(self) -> int:
        """Return the number of the link that floats."""
        return self._layout.base

    def put(self, keyframe: Keyframe, positions_rad: Array) -> None:
        """Put the robot where it began, into a posture, at rest, and hold it."""
        layout, data = self._layout, self._data
        pose(self._model, data, layout, self._place, keyframe, positions_rad)
        data.qvel[layout.floating.linear] = data.qvel[layout.floating.angular] = 0.0
        data.qvel[layout.velocities] = data.qvel[layout.follower_velocities] = 0.0
        self._servos.reset(positions_rad)
        data.ctrl[layout.servos] = self._servos.inputs

    def forget(self) -> None:
        """Drop the observations of the past: they tell of another place."""
        self._measured.clear()

    def measure(self, time_s: float) -> None:
        """Read the sensors."""
        self._measured.append(self._sensors.measure(time_s))

    def observe(self) -> Observation:
        """Return what the sensors said, as long ago as the latency is."""
        return self._measured[0]
