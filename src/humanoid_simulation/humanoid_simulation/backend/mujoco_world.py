# SPDX-License-Identifier: Apache-2.0
"""The MuJoCo world of a scene with robots: its names, true states, contacts, and its advance."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from humanoid_control.backends import Array
from humanoid_simulation.backend.entities import Entities, Names
from humanoid_simulation.backend.forces import Contact, contacts_in, Wrench, Wrenches
from humanoid_simulation.backend.hoist import Hoists
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.backend.state import carry_over, EntityState, LastSound, numbers_in
from humanoid_simulation.model.description import CAMERA, in_world, Placement, RobotDescription
from humanoid_simulation.model.world import build_world
from humanoid_simulation.scene.scene import Scene
import mujoco
import numpy as np


class MujocoWorld:
    """
    The compiled world of a scene with robots: what is in it, its true state, and wrenches on it.

    Parameters
    ----------
    description
        Description shared by all robots.
    scene
        Floor and objects.
    placements
        The name of each robot, and its initial pose on the ground.
    settings
        Settings of the physics, and the length of a control period.

    Raises
    ------
    SimulationError
        The world cannot be built.

    """

    def __init__(
        self,
        description: RobotDescription,
        scene: Scene,
        placements: Sequence[Placement],
        settings: BackendSettings,
    ) -> None:
        self._description, self._settings = description, settings
        self._placements = tuple(placements)
        self._model = build_world(description, scene, placements, settings.physics)
        self._data = mujoco.MjData(self._model)
        self._physics = PhysicsStepper(self._model, self._data, settings)
        self._index(scene)

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

    def contacts(self) -> Iterator[Contact]:
        """Iterate over the contacts of the last physics step."""
        return contacts_in(self._model, self._data, self._names.bodies)

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
        self._physics.wrenches.add(
            Wrench(
                self._names.number(body),
                np.array(force_n, dtype=np.float64),
                np.array(torque_nm, dtype=np.float64),
                np.array(point_m, dtype=np.float64),
                duration_s,
            )
        )

    def _switch(self, scene: Scene) -> None:
        """Switch to another scene, or raise SimulationError and change nothing."""
        model = build_world(self._description, scene, self._placements, self._settings.physics)
        data = mujoco.MjData(model)
        self._physics.enter(model, data)
        self._model, self._data = model, data
        self._index(scene)

    def _index(self, scene: Scene) -> None:
        """Set the scene, and index its bodies and entities in the model."""
        robots = [place.robot for place in self._placements]
        self._scene = scene
        self._names = Names(self._model, scene, robots, self._description.base)
        self._entities = Entities(self._model, self._data, self._names)


class PhysicsStepper:
    """
    Advances the state of a world by control periods, and undoes a period in which it diverges.

    Parameters
    ----------
    model, data
        The compiled MuJoCo world, and its state.
    settings
        Length of a control period, and the number of physics steps in it.

    Attributes
    ----------
    wrenches, hoists
        The external forces that act on the world in each period.

    """

    def __init__(self, model: Any, data: Any, settings: BackendSettings) -> None:
        self._model, self._data, self._settings = model, data, settings
        self._sound = LastSound(data)
        self.wrenches = Wrenches(data)
        self.hoists = Hoists(model, data, self.wrenches)

    def enter(self, model: Any, data: Any) -> None:
        """
        Switch to another model; what both have in common keeps its state and the forces on it.

        Parameters
        ----------
        model, data
            The new MuJoCo model and its state, whose derived quantities are not recomputed.

        """
        carry_over(self._model, self._data, model, data)
        numbers = numbers_in(self._model, model)
        self.wrenches.enter(data, numbers)
        self.hoists.enter(model, data, numbers)
        self._model, self._data = model, data
        self._sound = LastSound(data)

    def advance(self) -> bool:
        """
        Advance by one control period; if the physics becomes unstable, undo it.

        Returns
        -------
        bool
            Whether the period has passed. If not, the state before it is restored without
            external forces, and derived quantities are not recomputed.

        """
        settings = self._settings
        period_s = settings.period_s
        self.hoists.act(period_s)
        self.wrenches.act(period_s)
        self._sound.keep()
        mujoco.mj_step(self._model, self._data, settings.steps_per_period)
        if not self._sound.is_lost:
            return True
        self._sound.restore()
        self._end_forces()
        return False

    def reset(self) -> None:
        """Set the initial state of the model, and end all external forces."""
        mujoco.mj_resetData(self._model, self._data)
        self._end_forces()

    def _end_forces(self) -> None:
        """End all wrenches, and release all robots from their hoists."""
        self.wrenches.clear()
        self.hoists.clear()
