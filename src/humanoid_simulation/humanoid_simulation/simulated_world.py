# SPDX-License-Identifier: Apache-2.0
"""The world that services act on: what is in it, and whether its time passes."""

from __future__ import annotations

from collections.abc import Callable
from enum import IntEnum
import math

from humanoid_control.hosting.host import Host
from humanoid_simulation.backend import EntityState, MujocoBackend
from humanoid_simulation.backend.names import ALONE
from humanoid_simulation.entity_catalogue import EntityCatalogue
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.guarded_loop import GuardedLoop
from humanoid_simulation.scene import Scene
from rclpy.task import Future

MOST_STEPS = 100_000
"""Of one call: whoever mistypes a number should not have to wait for hours."""


class State(IntEnum):
    """Whether the world moves, numbered as in simulation_interfaces/SimulationState."""

    STOPPED = 0
    PLAYING = 1
    PAUSED = 2


class SimulatedWorld:
    """Changes a world between two periods, and tells those who show it."""

    def __init__(
        self,
        backend: MujocoBackend,
        loop: GuardedLoop,
        host: Host,
        steps_per_period: int,
        follow: Callable[[], None],
    ) -> None:
        """
        Take what runs the world.

        Parameters
        ----------
        backend, loop, host
            The world, what controls its robots, and what lets time pass.
        steps_per_period
            Physics steps in a control period.
        follow
            Is called after a change of the scene.

        """
        self.backend = backend
        self.catalogue = EntityCatalogue(backend)
        self._loop, self._host, self._follow = loop, host, follow
        self._steps_per_period = steps_per_period
        self._pause_is_wanted = host.paused
        self._is_stopped = False
        self._loaded = backend.scene

    @property
    def state(self) -> State:
        """Tell whether time passes."""
        if not self._host.paused:
            return State.PLAYING
        return State.STOPPED if self._is_stopped else State.PAUSED

    @property
    def is_stepping(self) -> bool:
        """Tell whether steps are still to be done, in a pause; another request ends them."""
        return self._host.is_stepping

    @property
    def has_failed(self) -> bool:
        """Tell whether the physics has failed, so that nothing moves before a reset."""
        return self._loop.has_failed

    def refuse_after_failure(self) -> None:
        """Refuse what has no effect before a reset."""
        if self.has_failed:
            raise SimulationError('The physics has failed; reset the simulation first.')

    def put(self, entity: str, state: EntityState) -> None:
        """Put an entity somewhere; a robot begins anew there."""
        self.backend.set_entity_state(entity, state)
        for robot in self.backend.robots:
            if (robot or ALONE) == (entity or ALONE):
                self._loop.begin_anew(robot)

    def pause(self, paused: bool) -> None:
        """Stop the time, or let it go on."""
        if not paused:
            self.refuse_after_failure()
        self._is_stopped, self._pause_is_wanted = False, paused
        self._host.pause(paused)

    def stop(self, keyframe: str = 'home') -> None:
        """Put all where it began, and stop the time."""
        self.reset(keyframe=keyframe)
        self.pause(True)
        self._is_stopped = True

    def reset(self, state: bool = True, spawned: bool = True, keyframe: str = 'home') -> None:
        """
        Put back what is wanted; time goes on. What had failed runs again, unless it was paused.

        Parameters
        ----------
        state
            Whether all is put where it began, robots into the posture of the keyframe.
        spawned
            Whether things that were made go, and those that were deleted come back.
        keyframe
            The name of a posture.

        """
        had_failed = self.has_failed
        if spawned and self.backend.scene is not self._loaded:
            self.change_scene(self._loaded)
        if state:
            self._host.reset(keyframe)
            if had_failed:
                self._host.pause(self._pause_is_wanted)

    def load(self, scene: Scene, keyframe: str = 'home') -> None:
        """Go on in another world, with all robots where they begin, and stop the time."""
        self.change_scene(scene)
        self.catalogue.forget()
        self._loaded = scene
        self.stop(keyframe)

    def change_scene(self, scene: Scene) -> None:
        """Go on in a scene with other things; robots, and things that stay, do not notice it."""
        self.backend.change_scene(scene)
        self._follow()

    def periods_of(self, steps: int) -> int:
        """Return how many control periods some steps of physics take; refuse what cannot be."""
        if not self._host.paused:
            raise SimulationError('The simulation runs. Pause it before you step it.')
        self.refuse_after_failure()
        if not 1 <= steps <= MOST_STEPS:
            raise SimulationError(f'A call cannot do {steps} steps. Give 1 to {MOST_STEPS}.')
        return math.ceil(steps / self._steps_per_period)

    async def step(self, periods: int) -> None:
        """Let a paused world go on by control periods, and wait for their end."""
        end_s = self.backend.time_s + (periods - 0.5) * self.backend.period_s
        done: Future = Future()
        self._is_stopped = False
        self._host.tick_in_pause(periods, lambda: done.set_result(None))
        await done
        if self.has_failed:
            raise SimulationError('The physics has failed meanwhile; see the log.')
        if self.backend.time_s < end_s:
            raise SimulationError('The steps were ended by another request.')
