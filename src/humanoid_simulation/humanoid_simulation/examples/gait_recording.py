# SPDX-License-Identifier: Apache-2.0
"""Simulate and record a walk without ROS: CoM, ZMP, feet and joint torques."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from humanoid_control.backends import Array, Observation
from humanoid_control.hosting.control_loop import ControlLoop
from humanoid_control.hosting.walking_robot import WalkingRobotControl
from humanoid_control.walking import VelocityCommand
from humanoid_control.walking.commands import STANDING
from humanoid_description.loading import load_robot
from humanoid_simulation.backend import MujocoBackend, Snapshot
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.examples.fall_watch import FallWatch, tilt_rad
from humanoid_simulation.model import humanoid, in_world
from humanoid_simulation.scene import Scene
import mujoco
import numpy as np

STANDING_S = 1.0
STOPPING_S = 3.0
LONGEST_S = 600.0
SOLES = ('l_sole', 'r_sole')
_LEAST_LOAD_N = 20.0


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
            f'The robot fell after {backend.time_s:.2f} s, so there is no gait to plot. Reduce '
            'the speed.'
        )


@dataclass(frozen=True, eq=False)
class GaitRecording:
    """
    A recorded walk of n samples of the true state, not the estimated one; feet are left, right.

    Positions are in the world frame. While no foot carries load, the zero-moment point is NaN.
    """

    times_s: Array
    """(n,)"""
    com_m: Array
    """(n, 3) centre of mass"""
    zmp_m: Array
    """(n, 2) zero-moment point"""
    soles_m: Array
    """(n, 2, 3)"""
    loads_n: Array
    """(n, 2) vertical load of each foot"""
    efforts_nm: Array
    """(n, j) joint torques"""
    joints: tuple[str, ...]
    """(j,)"""


class GaitRecorder:
    """
    Recorder of the CoM, the ZMP and the feet of a robot that is alone in its world.

    Parameters
    ----------
    model
        The compiled MuJoCo model; its kinematics are recomputed from snapshots.
    joints
        Names of the driven joints, in the order of the observations.
    base
        Name of the base link of the robot, whose soles are `SOLES`.

    Raises
    ------
    KeyError
        The model has no robot with these links.

    """

    def __init__(self, model: Any, joints: tuple[str, ...], base: str = 'base_link') -> None:
        self._model, self._data, self._joints = model, mujoco.MjData(model), joints
        self._base = model.body(in_world('', base)).id
        self._soles = [model.body(in_world('', sole)).id for sole in SOLES]
        self._rows: list[tuple[Any, ...]] = []

    def note(self, observation: Observation, snapshot: Snapshot) -> None:
        """
        Record one control period.

        Parameters
        ----------
        observation
            The sensor readings in that state.
        snapshot
            The true state at the same time.

        """
        model, data = self._model, self._data
        data.qpos[:] = snapshot.qpos
        mujoco.mj_kinematics(model, data)
        mujoco.mj_comPos(model, data)
        soles_m = data.xpos[self._soles]
        turns = data.xmat[self._soles].reshape(-1, 3, 3)
        forces_n = np.einsum('fij,fj->fi', turns, observation.foot_forces_n)
        torques_nm = np.einsum('fij,fj->fi', turns, observation.foot_torques_nm)
        self._rows.append(
            (
                observation.time_s,
                data.subtree_com[self._base].copy(),
                zero_moment_point(soles_m, forces_n, torques_nm),
                soles_m,
                forces_n[:, 2],
                observation.efforts_nm,
            )
        )

    def recording(self) -> GaitRecording:
        """Return the recorded walk."""
        columns = [np.array(column, dtype=np.float64) for column in zip(*self._rows)]
        times_s, com_m, zmp_m, soles_m, loads_n, efforts_nm = columns
        return GaitRecording(times_s, com_m, zmp_m, soles_m, loads_n, efforts_nm, self._joints)


def zero_moment_point(soles_m: Array, forces_n: Array, torques_nm: Array) -> Array:
    """
    Compute the zero-moment point on the ground, at height 0, from the wrenches on the feet.

    Vukobratovic and Borovac, "Zero-moment point: thirty five years of its life", 2004.

    Parameters
    ----------
    soles_m
        Reference points of the torques (feet, 3), in the world frame like all arguments.
    forces_n, torques_nm
        Forces and torques of the ground on each foot (feet, 3).

    Returns
    -------
    Array
        x and y (2,) in m; NaN if the feet carry less than 20 N.

    """
    load_n = forces_n[:, 2].sum()
    if load_n < _LEAST_LOAD_N:
        return np.full(2, np.nan)
    moment_nm = (torques_nm + np.cross(soles_m, forces_n)).sum(axis=0)
    return np.array([-moment_nm[1] / load_n, moment_nm[0] / load_n])
