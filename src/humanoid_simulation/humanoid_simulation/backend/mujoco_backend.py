# SPDX-License-Identifier: Apache-2.0
"""Backend that simulates robots in MuJoCo."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from humanoid_control.backends import Array, JointTargets, Observation
from humanoid_simulation.backend.entities import Entities, Names
from humanoid_simulation.backend.forces import Contact, contacts_in, Wrench, Wrenches
from humanoid_simulation.backend.hoist import Hoists
from humanoid_simulation.backend.robot import SimulatedRobot
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.backend.state import (
    carry_over,
    EntityState,
    LastSound,
    numbers_in,
    Snapshot,
)
from humanoid_simulation.errors import named, SimulationError
from humanoid_simulation.keyframes import Keyframe, load_keyframes
from humanoid_simulation.model.description import (
    ALONE,
    CAMERA,
    humanoid,
    in_world,
    Placement,
    RobotDescription,
)
from humanoid_simulation.model.world import build_world
from humanoid_simulation.scene.scene import Scene
import mujoco
import numpy as np


class MujocoBackend:
    """
    Implementation of `humanoid_control.backends.Backend` by a MuJoCo simulation.

    The robots start in the keyframe `home`. MuJoCo's warning handler is replaced for the whole
    process: an unstable state is detected by a check after each step instead.

    Parameters
    ----------
    description
        Description shared by all robots; None is the humanoid in its original size, without hands.
    scene
        Floor and objects; by default a flat floor.
    placements
        The name of each robot, and its initial pose on the ground.
    settings
        Physics steps, sensor noise with its seed, latency, and extrapolation of targets.
    keyframes
        The postures for `reset`, including `home`; None loads the installed ones.

    Raises
    ------
    SimulationError
        The world cannot be built, or `home` is missing or sets a joint that no robot has.

    """

    def __init__(
        self,
        description: RobotDescription | None = None,
        scene: Scene = Scene(),
        placements: Sequence[Placement] = (Placement(),),
        settings: BackendSettings = BackendSettings(),
        keyframes: Mapping[str, Keyframe] | None = None,
    ) -> None:
        self._description = description = description or humanoid()
        self._placements, self._settings = tuple(placements), settings
        self._keyframes = load_keyframes() if keyframes is None else keyframes
        self._joints = tuple(description.drives)
        mujoco.set_mju_user_warning(_ignore)
        self._model = build_world(description, scene, placements, settings.physics)
        self._data = mujoco.MjData(self._model)
        seeds = np.random.SeedSequence(settings.seed).spawn(len(placements))
        self._robots = {
            place.robot: SimulatedRobot(
                self._model, self._data, description, place, settings, np.random.default_rng(seed)
            )
            for place, seed in zip(placements, seeds)
        }
        self._wrenches = Wrenches(self._data)
        self._hoists = Hoists(self._model, self._data, self._wrenches)
        self._name(scene)
        self._periods = 0
        self.reset()
        self._standing_m = {
            place.robot: float(self.ground_truth(place.robot).position_m[2]) - place.z_m
            for place in placements
        }

    @property
    def robots(self) -> tuple[str, ...]:
        """Return the names of the robots."""
        return tuple(self._robots)

    @property
    def joints(self) -> tuple[str, ...]:
        """Return the names of the driven joints, the same for all robots."""
        return self._joints

    @property
    def period_s(self) -> float:
        """Return the control period: the simulated time of a step."""
        return self._settings.period_s

    @property
    def time_s(self) -> float:
        """Return the simulated time since the start."""
        return self._periods * self.period_s

    @property
    def model(self) -> Any:
        """Return the compiled MuJoCo model, for rendering."""
        return self._model

    @property
    def data(self) -> Any:
        """Return the MuJoCo state, for rendering; treat it as read-only."""
        return self._data

    @property
    def scene(self) -> Scene:
        """Return the current scene, with objects at their initial poses."""
        return self._scene

    @property
    def entities(self) -> tuple[str, ...]:
        """Return the names of the robots and of all objects."""
        return self._entities.names

    def observe(self) -> Mapping[str, Observation]:
        """Return the measurements of every robot; they stay the same until time passes."""
        return {name: robot.observe() for name, robot in self._robots.items()}

    def step(self, targets: Mapping[str, JointTargets]) -> None:
        """
        Advance the simulation by one control period, see `Backend.step`.

        Targets are validated first: if any is invalid, none is applied and no time passes. If
        the physics becomes unstable, the last stable state is restored.

        Parameters
        ----------
        targets
            Joint targets by robot name; a robot without any continues with its last ones.

        Raises
        ------
        SimulationError
            There is no such robot, its targets are invalid, or the physics has become unstable.

        """
        for name, wanted in targets.items():
            named('robot', name, self._robots).check(wanted)
        for name, robot in self._robots.items():
            robot.command(targets.get(name))
        self._hoists.act(self.period_s)
        self._wrenches.act(self.period_s)
        self._sound.keep()
        mujoco.mj_step(self._model, self._data, self._settings.steps_per_period)
        self._refuse_explosion()
        self._periods += 1
        self._measure()

    def reset(self, keyframe: str = 'home') -> None:
        """
        Reset robots and objects to their initial poses, at rest; time continues.

        Parameters
        ----------
        keyframe
            Name of the posture in which the robots start again.

        Raises
        ------
        SimulationError
            There is no such keyframe; nothing is changed then.

        """
        posture = named('keyframe', keyframe, self._keyframes)
        positions = {name: robot.posture(posture) for name, robot in self._robots.items()}
        mujoco.mj_resetData(self._model, self._data)
        self._wrenches.clear()
        self._hoists.clear()
        for name, robot in self._robots.items():
            robot.put(posture, positions[name])
        self._look_again()

    def change_scene(self, scene: Scene) -> None:
        """
        Switch to another scene; robots, and objects that are in both scenes, keep their states.

        Parameters
        ----------
        scene
            The new scene. An object is in both if it has the same name, and can be moved.

        Raises
        ------
        SimulationError
            The world cannot be built; nothing is changed then.

        """
        before = self._model, self._data
        model = build_world(self._description, scene, self._placements, self._settings.physics)
        data = mujoco.MjData(model)
        carry_over(*before, model, data)
        self._model, self._data = model, data
        for robot in self._robots.values():
            robot.enter(model, data)
        numbers = numbers_in(before[0], model)
        self._wrenches.enter(data, numbers)
        self._hoists.enter(model, data, numbers)
        self._name(scene)
        self._look_again()

    def close(self) -> None:
        """Release all resources; the backend cannot be used afterwards."""
        self._robots = {}

    def entity(self, name: str) -> str:
        """
        Resolve the name of an entity.

        Parameters
        ----------
        name
            Name of a robot or an object; '' is the robot without a name.

        Raises
        ------
        SimulationError
            There is no such entity.

        """
        return self._entities.named(name)

    def entity_state(self, entity: str) -> EntityState:
        """
        Read the true pose, velocity and acceleration of an entity, in the world frame.

        Parameters
        ----------
        entity
            A name, as for `entity`.

        Raises
        ------
        SimulationError
            There is no such entity.

        """
        return self._entities.state(self.entity(entity))

    def entity_box(self, entity: str) -> tuple[Array, Array]:
        """
        Compute the bounding box of an entity, along its own axes.

        For a robot it includes all links, so it changes with the posture.

        Parameters
        ----------
        entity
            A name, as for `entity`.

        Returns
        -------
        tuple[Array, Array]
            Lower and upper corner (3,) in m; for a robot in the frame base_link.

        Raises
        ------
        SimulationError
            There is no such entity.

        """
        return self._entities.box(self.entity(entity))

    def ground_truth(self, robot: str = '') -> EntityState:
        """
        Read the true state of the base of a robot, in the world frame.

        Parameters
        ----------
        robot
            Name of the robot; '' if it has none.

        Raises
        ------
        SimulationError
            There is no such robot.

        """
        named('robot', robot, self._robots)
        return self._entities.state(robot or ALONE)

    def set_entity_state(self, entity: str, state: EntityState) -> None:
        """
        Set the pose and velocity of a robot or an object; the joints of a robot keep their state.

        Parameters
        ----------
        entity
            A name, as for `entity`.
        state
            Pose and velocity in the world frame; accelerations are ignored.

        Raises
        ------
        SimulationError
            There is no such entity, it is fixed, or the state is out of bounds.

        """
        self._entities.put(self.entity(entity), state)
        self._look_again()

    def apply_wrench(
        self,
        body: str,
        force_n: Sequence[float] | Array,
        torque_nm: Sequence[float] | Array = (0.0, 0.0, 0.0),
        duration_s: float = 0.1,
        point_m: Sequence[float] | Array = (0.0, 0.0, 0.0),
    ) -> None:
        """
        Apply a wrench to a body from the next period on; wrenches on the same body add up.

        Parameters
        ----------
        body
            Name of an object or of a link, the latter as `robot/link` if robots have names.
        force_n, torque_nm
            Force, and torque about its point of application, (3,) each, in world axes.
        duration_s
            How long they act, in simulated time.
        point_m
            The point at which the force acts (3,), from the origin of the body in its axes.

        Raises
        ------
        SimulationError
            There is no such body, a number is out of range, or too many wrenches act already.

        """
        self._wrenches.add(
            Wrench(
                self._names.number(body),
                np.array(force_n, dtype=np.float64),
                np.array(torque_nm, dtype=np.float64),
                np.array(point_m, dtype=np.float64),
                duration_s,
            )
        )

    def hoist(self, robot: str = '') -> None:
        """
        Start lifting a robot onto its feet where it is, as if by a rope and by hand.

        Parameters
        ----------
        robot
            Name of the robot; '' if it has none.

        Raises
        ------
        SimulationError
            There is no such robot.

        """
        fallen = named('robot', robot, self._robots)
        self._hoists.begin(fallen.base, self._standing_m[robot], lambda: self.ground_truth(robot))

    def is_hoisted(self, robot: str = '') -> bool:
        """
        Check whether a robot is still being lifted onto its feet.

        Parameters
        ----------
        robot
            Name of the robot; '' if it has none.

        Raises
        ------
        SimulationError
            There is no such robot.

        """
        return self._hoists.is_lifting(named('robot', robot, self._robots).base)

    def contacts(self) -> Iterator[Contact]:
        """Iterate over the contacts of the last physics step."""
        return contacts_in(self._model, self._data, self._names.bodies)

    def snapshot(self) -> Snapshot:
        """Copy the current state."""
        return Snapshot(self.time_s, self._data.qpos.copy(), self._data.qvel.copy())

    def body(self, entity: str, link: str = '') -> str:
        """
        Look up the name of a body, as `apply_wrench` accepts it.

        Parameters
        ----------
        entity
            Name of a robot or of an object that can be moved; '' is the robot without a name.
        link
            A link of the robot, which is not checked; '' is its base, or the object.

        Raises
        ------
        SimulationError
            There is no such entity, or it is fixed.

        """
        return self._names.body(entity, link)

    def links(self, robot: str = '') -> list[str]:
        """
        List the names of the bodies of a robot, as they appear in contacts.

        Parameters
        ----------
        robot
            Name of the robot; '' if it has none.

        Raises
        ------
        SimulationError
            There is no such robot.

        """
        return self._names.links(robot)

    def camera(self, robot: str = '') -> str:
        """
        Look up the name of a robot's camera in the MuJoCo model.

        Parameters
        ----------
        robot
            Name of the robot; '' if it has none.

        """
        return in_world(robot, CAMERA)

    def _name(self, scene: Scene) -> None:
        """Set the scene, and index its bodies and entities in the model."""
        self._scene = scene
        self._names = Names(self._model, scene, self.robots, self._description.base)
        self._entities = Entities(self._model, self._data, self._names)
        self._sound = LastSound(self._data)

    def _look_again(self) -> None:
        """Recompute derived quantities after the state was set, and measure again."""
        self._data.time = self.time_s
        mujoco.mj_forward(self._model, self._data)
        for robot in self._robots.values():
            robot.forget()
        self._measure()

    def _measure(self) -> None:
        """Read the sensors of every robot."""
        for robot in self._robots.values():
            robot.measure(self.time_s)

    def _refuse_explosion(self) -> None:
        """Restore the last stable state and raise SimulationError if the physics diverged."""
        if self._sound.is_lost:
            self._sound.restore()
            self._wrenches.clear()
            self._hoists.clear()
            self._look_again()
            raise SimulationError(
                f'The physics has become unstable at {self.time_s:.3f} s: velocities are beyond '
                'all bounds. Reset the simulation. If it happens again, look for huge forces, for '
                'bodies that are put into each other, and for a physics period that is too long.'
            )


def _ignore(message: str) -> None:
    """Ignore a MuJoCo warning, which would go to a log file; the state is checked instead."""
