# SPDX-License-Identifier: Apache-2.0
"""What an agent observes: a vector of sensor values, its parts and their noise."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import gymnasium
from humanoid_control.backends import Array, Observation
from humanoid_simulation.backend.noise import REALISTIC
from humanoid_simulation.quaternions import inverse, rotated
import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float32]
_DOWN = np.array([0.0, 0.0, -1.0])


@dataclass(frozen=True)
class Part:
    """
    A part of the observation.

    Attributes
    ----------
    name, size
        Its name, and the number of its values.
    bound
        Largest magnitude of a value; larger ones are clipped.
    noise
        Standard deviation of the white noise on each value, at the factor 1.

    """

    name: str
    size: int
    bound: float
    noise: float = 0.0


def parts_of(joints: int, actions: int, task: Sequence[Part]) -> tuple[Part, ...]:
    """
    List the parts of the observation, in their order.

    Parameters
    ----------
    joints
        Number n of the robot's joints.
    actions
        Number of values in an action.
    task
        The parts that only this task has.

    """
    return (
        Part('gravity', 3, 1.0, REALISTIC.tilt_rad),
        Part('angular_velocity', 3, 20.0, REALISTIC.angular_velocity_rad_s),
        *task,
        Part('joint_positions', joints, 6.3, REALISTIC.position_rad),
        Part('joint_velocities', joints, 40.0, REALISTIC.velocity_rad_s),
        Part('foot_forces', 2, 5000.0, REALISTIC.foot_force_n),
        Part('last_action', actions, 1.0),
    )


def sensor_values(observation: Observation, home_rad: Array) -> dict[str, Array]:
    """
    Convert measurements to the parts that all tasks have.

    Parameters
    ----------
    observation
        What the sensors of the robot measure.
    home_rad
        The home posture (n,).

    Returns
    -------
    dict of Array
        Values by part: the unit vector of gravity and the angular velocity in rad/s, both in
        `imu_link`; joint positions from the home posture in rad, and joint velocities in rad/s;
        the forces along the normals of the left and the right sole, in N.

    """
    return {
        'gravity': rotated(_DOWN, inverse(observation.orientation)),
        'angular_velocity': observation.angular_velocity_rad_s,
        'joint_positions': observation.positions_rad - home_rad,
        'joint_velocities': observation.velocities_rad_s,
        'foot_forces': observation.foot_forces_n[:, 2],
    }


class ObservationVector:
    """
    Puts the parts of an observation into one vector, with noise.

    Parameters
    ----------
    parts
        The parts, in their order.
    noise
        Factor on the noise of all parts; 0 is none.

    Attributes
    ----------
    space
        The space of the vectors.
    slices
        Where each part is, by its name.

    """

    def __init__(self, parts: Sequence[Part], noise: float) -> None:
        sizes = [part.size for part in parts]
        self._bounds = np.repeat([part.bound for part in parts], sizes).astype(np.float32)
        self._noise = noise * np.repeat([part.noise for part in parts], sizes)
        self.space = gymnasium.spaces.Box(-self._bounds, self._bounds, dtype=np.float32)
        ends = np.cumsum(sizes).tolist()
        self.slices = {
            part.name: slice(end - part.size, end) for part, end in zip(parts, ends, strict=True)
        }

    def filled(self, values: Mapping[str, Array], random: np.random.Generator) -> Vector:
        """
        Make a vector.

        Parameters
        ----------
        values
            The true values of each part.
        random
            Source of the noise.

        """
        vector = np.concatenate([values[name] for name in self.slices])
        if self._noise.any():
            vector = vector + self._noise * random.standard_normal(len(vector))
        clipped: Vector = np.clip(vector.astype(np.float32), -self._bounds, self._bounds)
        return clipped
