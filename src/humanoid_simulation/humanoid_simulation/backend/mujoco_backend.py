# SPDX-License-Identifier: Apache-2.0
"""Backend that simulates robots in MuJoCo."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from humanoid_control.backends import JointTargets, Observation
from humanoid_simulation.backend.mujoco_world import MujocoWorld
from humanoid_simulation.backend.robot import SimulatedRobot
from humanoid_simulation.backend.settings import BackendSettings
from humanoid_simulation.backend.state import EntityState, Snapshot
from humanoid_simulation.errors import named, SimulationError
from humanoid_simulation.keyframes import Keyframe, load_keyframes
from humanoid_simulation.model.description import ALONE, humanoid, Placement, RobotDescription
from humanoid_simulation.scene.scene import Scene
import mujoco
import numpy as np


class MujocoBackend(MujocoWorld):
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
        description = description or humanoid()
        self._keyframes = load_keyframes() if keyframes is None else keyframes
        self._joints = tuple(description.drives)
        mujoco.set_mju_user_warning(_ignore)
        super().__init__(description, scene, placements, settings)
        seeds = np.random.SeedSequence(settings.seed).spawn(len(placements))
        self._robots = {
            place.robot: SimulatedRobot(
                self._model, self._data, description, place, settings, np.random.default_rng(seed)
            )
            for place, seed in zip(placements, seeds)
        }
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
        if not self._physics.advance():
            self._look_again()
            raise _unstable(self.time_s)
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
        self._physics.reset()
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
        self._switch(scene)
        for robot in self._robots.values():
            robot.enter(self._model, self._data)
        self._look_again()

    def close(self) -> None:
        """Release all resources; the backend cannot be used afterwards."""
        self._robots = {}

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
        Set the pose and velocity of a robot or an object, which moves as one rigid body.

        The joints of a robot keep their positions, and rest.

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
        self._physics.hoists.begin(
            fallen.base, self._standing_m[robot], lambda: self.ground_truth(robot)
        )

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
        return self._physics.hoists.is_lifting(named('robot', robot, self._robots).base)

    def snapshot(self) -> Snapshot:
        """Copy the current state."""
        return Snapshot(self.time_s, self._data.qpos.copy(), self._data.qvel.copy())

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


def _ignore(message: str) -> None:
    """Ignore a MuJoCo warning, which would go to a log file; the state is checked instead."""


def _unstable(time_s: float) -> SimulationError:
    """Return the error of a physics that has diverged."""
    return SimulationError(
        f'The physics became unstable at {time_s:.3f} s: velocities have diverged. Reset the '
        'simulation. If it happens again, look for excessive forces, for bodies that penetrate '
        'each other, and for a physics period that is too long.'
    )
