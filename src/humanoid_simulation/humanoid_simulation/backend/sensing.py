# SPDX-License-Identifier: Apache-2.0
"""Simulated sensors of a robot: encoders, inertial measurement unit and foot sensors."""

from __future__ import annotations

from typing import Any

from humanoid_control.backends import Array, Observation
from humanoid_simulation.backend.channels import channels_of
from humanoid_simulation.backend.layout import Layout
from humanoid_simulation.backend.noise import NoiseSource
from humanoid_simulation.rotations import from_vector, inverse, product, rotated
import mujoco
import numpy as np


class Sensors:
    """
    Joint encoders, inertial measurement unit and foot force sensors of a robot in a world.

    Joint positions and all velocities are current; forces and accelerations are those of the last
    physics step.

    Parameters
    ----------
    model, data
        The compiled MuJoCo world, and its state, whose arrays are read at each measurement.
    layout
        Indices of the robot in these arrays.
    noise
        Source of the measurement errors.

    """

    def __init__(self, model: Any, data: Any, layout: Layout, noise: NoiseSource) -> None:
        self._qpos, self._qvel = data.qpos, data.qvel
        self._actuator_force, self._sensordata = data.actuator_force, data.sensordata
        self._external = [data.cfrc_ext[foot] for foot in layout.feet]
        self._sole_positions = [data.xpos[sole] for sole in layout.soles]
        self._sole_turns = [data.xmat[sole] for sole in layout.soles]
        # The reference point of the external forces on bodies.
        self._centre = data.subtree_com[model.body_rootid[layout.base]]
        self._layout = layout
        self._mount, self._unmount = layout.imu_mount, inverse(layout.imu_mount)
        self._noise = noise
        self._channels = channels_of(len(layout.positions))

    def measure(self, time_s: float) -> Observation:
        """
        Measure joints, inertial sensor and forces on the feet, with noise.

        Parameters
        ----------
        time_s
            Current simulated time, for the stamp and the drift of the heading.

        """
        values = self._true_values()
        orientation = product(self._qpos[self._layout.floating.orientation], self._mount)
        if not self._noise.is_silent:
            errors, turn = self._noise.draw(orientation, time_s)
            values += errors
            orientation = product(from_vector(turn), orientation)
        return self._observation(time_s, values, orientation)

    def _true_values(self) -> Array:
        """Read the noise-free values of all channels."""
        layout, channels = self._layout, self._channels
        values = np.empty(channels.size)
        values[channels.positions] = self._qpos[layout.positions]
        values[channels.velocities] = self._qvel[layout.velocities]
        values[channels.efforts] = self._actuator_force[layout.servos]
        rate = self._qvel[layout.floating.angular]
        values[channels.angular_velocity] = rotated(rate, self._unmount)
        values[channels.acceleration] = self._sensordata[layout.acceleration]
        left, right = self._wrench_about_sole(0), self._wrench_about_sole(1)
        values[channels.forces] = np.concatenate((left[3:], right[3:]))
        values[channels.torques] = np.concatenate((left[:3], right[:3]))
        return values

    def _wrench_about_sole(self, foot: int) -> Array:
        """Compute the external torque and force (6,) on a foot, about its sole and in its axes."""
        wrench = np.empty(6)
        mujoco.mju_transformSpatial(
            wrench,
            self._external[foot],
            1,
            self._sole_positions[foot],
            self._centre,
            self._sole_turns[foot],
        )
        return wrench

    def _observation(self, time_s: float, values: Array, orientation: Array) -> Observation:
        """Build an observation from the values of the channels."""
        channels = self._channels
        return Observation(
            time_s,
            values[channels.positions],
            values[channels.velocities],
            values[channels.efforts],
            orientation,
            values[channels.angular_velocity],
            values[channels.acceleration],
            values[channels.forces].reshape(2, 3),
            values[channels.torques].reshape(2, 3),
        )
