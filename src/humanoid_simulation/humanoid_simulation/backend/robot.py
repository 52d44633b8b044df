# SPDX-License-Identifier: Apache-2.0
"""One robot in a simulated world: its servos, its sensors, and its posture at a reset."""

from __future__ import annotations

from collections import deque
from typing import Any

from humanoid_control.backends import Array, JointTargets, Observation
from humanoid_description.drives import PRISMATIC
from humanoid_description.rotations import quaternion_from_rpy, quaternion_from_vector
from humanoid_simulation.backend.layout import Layout, layout_of
from humanoid_simulation.backend.noise import channels_of, NoiseSource
from humanoid_simulation.backend.servos import check_targets, Servos
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.keyframes import Keyframe
from humanoid_simulation.model.description import Placement, RobotDescription
from humanoid_simulation.model.robot_spec import COLLISION_GROUP
from humanoid_simulation.quaternions import inverse, product, rotated
import mujoco
import numpy as np

# Initial penetration of a standing robot into the ground, so that its soles bear load at once.
_SINK_M = 1e-4


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
            orientation = product(quaternion_from_vector(turn), orientation)
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


def pose(
    model: Any,
    data: Any,
    layout: Layout,
    place: Placement,
    keyframe: Keyframe,
    positions_rad: Array,
) -> None:
    """
    Set the base and the joints of a robot, with its lowest point on the ground.

    Of the state, only `qpos` is valid afterwards; derived quantities are not recomputed.

    Parameters
    ----------
    model, data
        The MuJoCo model, and the state that is set.
    layout
        Indices of the robot in them.
    place
        Its initial position on the ground, and its heading.
    keyframe
        Roll and pitch of the base; its joints are not used.
    positions_rad
        Positions of the driven joints (n,); mimic joints follow.

    """
    data.qpos[layout.positions] = positions_rad
    data.qpos[layout.followers] = data.qpos[layout.followed]
    data.qpos[layout.floating.orientation] = quaternion_from_rpy(
        keyframe.roll_rad, keyframe.pitch_rad, place.yaw_rad
    )
    data.qpos[layout.floating.position] = (place.x_m, place.y_m, 0.0)
    mujoco.mj_kinematics(model, data)
    height_m = place.z_m - _SINK_M - _lowest_m(model, data, layout.base)
    data.qpos[layout.floating.position] = (place.x_m, place.y_m, height_m)


def _lowest_m(model: Any, data: Any, base: int) -> float:
    """Compute the height of the lowest point of a robot."""
    root = model.body_rootid[base]
    return min(
        _lowest_of_geom(model, data, geom)
        for geom in range(model.ngeom)
        if model.geom_group[geom] == COLLISION_GROUP
        and model.body_rootid[model.geom_bodyid[geom]] == root
    )


def _lowest_of_geom(model: Any, data: Any, geom: int) -> float:
    """Compute the height of the lowest point of a geom; for a mesh, of its bounding box."""
    up: Array = data.geom_xmat[geom].reshape(3, 3)[2]
    size = model.geom_size[geom]
    height = float(data.geom_xpos[geom][2])
    kind = model.geom_type[geom]
    if kind == mujoco.mjtGeom.mjGEOM_SPHERE:
        return height - float(size[0])
    if kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
        slant = float(np.hypot(up[0], up[1]))
        return height - float(size[0]) * slant - float(size[1]) * abs(float(up[2]))
    centre, half = model.geom_aabb[geom][:3], model.geom_aabb[geom][3:]
    return height + float(up @ centre) - float(np.abs(up) @ half)
