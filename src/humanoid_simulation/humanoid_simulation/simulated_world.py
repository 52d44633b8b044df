# SPDX-License-Identifier: Apache-2.0
"""The world that services act on: its entities, and whether it is playing or has failed."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from enum import IntEnum
import math

from humanoid_control.backends import Backend, Observation
from humanoid_control.hosting.control_loop import Brain, ControlLoop
from humanoid_control.hosting.host import Host
from humanoid_simulation.backend.mujoco_backend import MujocoBackend
from humanoid_simulation.backend.state import EntityState
from humanoid_simulation.entity_catalogue import EntityCatalogue
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.model.description import ALONE
from humanoid_simulation.scene.scene import Scene
from rclpy.task import Future

MOST_STEPS = 100_000
"""Maximum of a call: a mistyped number should not take hours."""


class State(IntEnum):
    """State of the simulation, numbered as in simulation_interfaces/SimulationState."""

    STOPPED = 0
    PLAYING = 1
    PAUSED = 2


class SimulatedWorld:
    """
    The world on which services act: they change it between control periods, pause and step it.

    Parameters
    ----------
    backend, loop, host
        The backend, the control loop of its robots, and the host that ticks the loop.
    steps_per_period
        Physics steps in a control period.
    follow
        Called after a change of the scene.

    Attributes
    ----------
    catalogue
        Descriptions of the entities.

    """

    def __init__(
        self,
        backend: MujocoBackend,
        loop: GuardedLoop,
        host: Host,
        steps_per_period: int,
        follow: Callable[[], None],
    ) -> None:
        self.backend = backend
        self.catalogue = EntityCatalogue(backend)
        self._loop, self._host, self._follow = loop, host, follow
        self._steps_per_period = steps_per_period
        self._pause_is_wanted = host.paused
        self._is_stopped = False
        self._loaded = backend.scene

    @property
    def state(self) -> State:
        """Return the state of the simulation: stopped, playing or paused."""
        if not self._host.paused:
            return State.PLAYING
        return State.STOPPED if self._is_stopped else State.PAUSED

    @property
    def is_stepping(self) -> bool:
        """Whether steps are pending in a pause; another request ends them."""
        return self._host.is_stepping

    @property
    def has_failed(self) -> bool:
        """Whether the physics has failed, so that nothing moves before a reset."""
        return self._loop.has_failed

    def refuse_after_failure(self) -> None:
        """Raise SimulationError if the physics has failed and needs a reset."""
        if self.has_failed:
            raise SimulationError('The physics has failed; reset the simulation first.')

    def put(self, entity: str, state: EntityState) -> None:
        """
        Move an entity to a pose and a velocity; the controller of a robot is reset.

        Parameters
        ----------
        entity
            Name of an entity that can be moved; '' is the robot without a name.
        state
            Its new pose and velocity, in the world frame.

        Raises
        ------
        SimulationError
            There is no such entity, it is fixed, or the state is out of bounds.

        """
        self.backend.set_entity_state(entity, state)
        for robot in self.backend.robots:
            if (robot or ALONE) == (entity or ALONE):
                self._loop.begin_anew(robot)

    def pause(self, paused: bool) -> None:
        """
        Pause or resume the simulation; pending steps are dropped.

        Parameters
        ----------
        paused
            Whether to pause.

        Raises
        ------
        SimulationError
            It cannot resume: the physics has failed, and needs a reset.

        """
        if not paused:
            self.refuse_after_failure()
        self._is_stopped, self._pause_is_wanted = False, paused
        self._host.pause(paused)

    def stop(self, keyframe: str = 'home') -> None:
        """
        Reset the world and pause it, in the state `STOPPED`.

        Parameters
        ----------
        keyframe
            Name of the posture in which the robots start again.

        Raises
        ------
        SimulationError
            There is no keyframe of that name.

        """
        self.reset(keyframe=keyframe)
        self.pause(True)
        self._is_stopped = True

    def reset(self, state: bool = True, spawned: bool = True, keyframe: str = 'home') -> None:
        """
        Reset the state, the spawned objects, or both; time does not go back.

        Parameters
        ----------
        state
            Whether robots and objects return to their initial poses, with robots in the keyframe.
            This clears a failure of the physics; the simulation resumes unless it was paused.
        spawned
            Whether spawned objects are deleted, and deleted ones restored.
        keyframe
            Name of a posture.

        """
        had_failed = self.has_failed
        if spawned and self.backend.scene is not self._loaded:
            self.change_scene(self._loaded)
        if state:
            self._host.reset(keyframe)
            if had_failed:
                self._host.pause(self._pause_is_wanted)

    def load(self, scene: Scene, keyframe: str = 'home') -> None:
        """
        Replace the scene by another one, with robots at their initial poses, and stop the time.

        Parameters
        ----------
        scene
            The new scene, which later resets restore.
        keyframe
            Name of the posture in which the robots start.

        Raises
        ------
        SimulationError
            The world cannot be simulated, or there is no such keyframe.

        """
        self.change_scene(scene)
        self.catalogue.forget()
        self._loaded = scene
        self.stop(keyframe)

    def change_scene(self, scene: Scene) -> None:
        """
        Switch to a scene with other objects; robots and objects in both scenes keep their states.

        Parameters
        ----------
        scene
            The scene from now on, until a reset of spawned objects.

        Raises
        ------
        SimulationError
            The world cannot be simulated; the previous one continues.

        """
        self.backend.change_scene(scene)
        self._follow()

    def periods_of(self, steps: int) -> int:
        """
        Convert physics steps to control periods, rounded up.

        Parameters
        ----------
        steps
            Number of physics steps, from 1 to `MOST_STEPS`.

        Returns
        -------
        int
            Number of control periods, for `step`.

        Raises
        ------
        SimulationError
            The simulation is not paused, its physics has failed, or the number is out of range.

        """
        if not self._host.paused:
            raise SimulationError('The simulation is running. Pause it before stepping it.')
        self.refuse_after_failure()
        if not 1 <= steps <= MOST_STEPS:
            raise SimulationError(f'A call cannot do {steps} steps. Give 1 to {MOST_STEPS}.')
        return math.ceil(steps / self._steps_per_period)

    async def step(self, periods: int) -> None:
        """
        Advance the paused world by some control periods, and wait until they have passed.

        Parameters
        ----------
        periods
            Number of control periods, from `periods_of`.

        Raises
        ------
        SimulationError
            The physics failed meanwhile, or another request ended the steps.

        """
        end_s = self.backend.time_s + (periods - 0.5) * self.backend.period_s
        done: Future = Future()
        self._is_stopped = False
        self._host.tick_in_pause(periods, lambda: done.set_result(None))
        await done
        if self.has_failed:
            raise SimulationError('The physics failed during the steps; see the log.')
        if self.backend.time_s < end_s:
            raise SimulationError('The steps were ended by another request.')


class GuardedLoop(ControlLoop):
    """
    A control loop that halts after an error of the simulation, until it is reset.

    Parameters
    ----------
    backend
        The simulated world.
    brains
        Controllers by robot name; a robot without one gets no targets.
    say
        Called with the message of an error.

    Raises
    ------
    ValueError
        There is a controller for a robot that the backend does not have.

    """

    def __init__(
        self, backend: Backend, brains: Mapping[str, Brain], say: Callable[[str], None]
    ) -> None:
        super().__init__(backend, brains)
        self._say = say
        self._has_failed = False

    @property
    def has_failed(self) -> bool:
        """Whether the loop has halted after an error, until a reset."""
        return self._has_failed

    def tick(self) -> Mapping[str, Observation]:
        """Advance by a period unless halted; return the observations before it."""
        if not self._has_failed:
            try:
                return super().tick()
            except SimulationError as error:
                self._has_failed = True
                self._say(str(error))
        return self.backend.observe()

    def reset(self, keyframe: str = 'home') -> None:
        """
        Reset robots and controllers, and clear an error; time continues.

        Parameters
        ----------
        keyframe
            Name of the posture in which the robots start again.

        Raises
        ------
        SimulationError
            There is no keyframe of that name; an error is not cleared then.

        """
        super().reset(keyframe)
        self._has_failed = False
