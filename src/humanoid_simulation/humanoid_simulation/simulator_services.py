# SPDX-License-Identifier: Apache-2.0
"""The services by which one controls a world and its time."""

from __future__ import annotations

from collections.abc import Awaitable, Callable
from functools import partial
import math
from typing import Any

from humanoid_control.hosting.host import Host
from humanoid_control.hosting.topics.filling import topic
from humanoid_interfaces.srv import (
    ApplyWrench,
    ResetSimulation,
    SetEntityState,
    StepSimulation,
)
from humanoid_simulation.backend import MujocoBackend
from humanoid_simulation.conversions import entity_state, seconds, vector
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.guarded_loop import GuardedLoop
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup
from rclpy.node import Node
from rclpy.task import Future
from std_srvs.srv import SetBool, Trigger

MOST_STEPS = 100_000
"""Of one call: whoever mistypes a number should not have to wait for hours."""


class SimulatorServices:
    """Pause, step, reset, put somewhere, push, and help up."""

    def __init__(
        self,
        node: Node,
        backend: MujocoBackend,
        loop: GuardedLoop,
        host: Host,
        steps_per_period: int,
    ) -> None:
        """Offer the services."""
        self._backend, self._loop, self._host = backend, loop, host
        self._steps_per_period = steps_per_period
        self._pause_is_wanted = host.paused
        for kind, name, do in (
            (SetBool, '~/set_pause', self._set_pause),
            (ResetSimulation, '~/reset_simulation', self._reset),
            (SetEntityState, '~/set_entity_state', self._put),
            (ApplyWrench, '~/apply_wrench', self._push),
        ):
            node.create_service(kind, name, partial(_answer, do))
        # In a group of its own: while it waits for its steps, all else is heard.
        node.create_service(
            StepSimulation,
            '~/step_simulation',
            partial(_answer_later, self._step),
            callback_group=MutuallyExclusiveCallbackGroup(),
        )
        for robot in backend.robots:
            stand_up = partial(_answer, partial(self._stand_up, robot))
            node.create_service(Trigger, topic(robot, 'stand_up'), stand_up)

    def _set_pause(self, request: SetBool.Request) -> str:
        """Stop the time, or let it go on."""
        if not request.data:
            self._refuse_after_failure()
        self._pause_is_wanted = request.data
        self._host.pause(request.data)
        return 'The simulation is paused.' if request.data else 'The simulation runs.'

    async def _step(self, request: StepSimulation.Request) -> str:
        """Let a paused simulation go on by whole control periods."""
        if not self._host.paused:
            raise SimulationError('The simulation runs. Pause it before you step it.')
        if not 1 <= request.steps <= MOST_STEPS:
            raise SimulationError(
                f'A call cannot do {request.steps} steps. Give 1 to {MOST_STEPS}.'
            )
        periods = math.ceil(request.steps / self._steps_per_period)
        end_s = self._backend.time_s + (periods - 0.5) * self._backend.period_s
        done: Future = Future()
        self._host.tick_in_pause(periods, lambda: done.set_result(None))
        await done
        if self._loop.has_failed:
            raise SimulationError('The physics has failed meanwhile; see the log.')
        if self._backend.time_s < end_s:
            raise SimulationError('The steps were ended by set_pause.')
        return f'{periods * self._steps_per_period} steps of physics: {periods} control periods.'

    def _reset(self, request: ResetSimulation.Request) -> str:
        """Put all where it began; what had failed runs again, unless a pause was wanted."""
        had_failed = self._loop.has_failed
        keyframe = request.keyframe or 'home'
        self._host.reset(keyframe)
        if had_failed:
            self._host.pause(self._pause_is_wanted)
        return f"Robots and things are where they began; the keyframe is '{keyframe}'."

    def _put(self, request: SetEntityState.Request) -> str:
        """Put a robot or a thing somewhere."""
        self._refuse_after_failure()
        self._backend.set_entity_state(request.entity, entity_state(request))
        return 'Done.'

    def _push(self, request: ApplyWrench.Request) -> str:
        """Push a robot or a thing."""
        self._refuse_after_failure()
        self._backend.apply_wrench(
            self._backend.body(request.entity, request.body),
            vector(request.wrench.force),
            vector(request.wrench.torque),
            seconds(request.duration),
            vector(request.point),
        )
        return 'The push begins.'

    def _stand_up(self, robot: str, request: Trigger.Request) -> str:
        """Lift a robot onto its feet; its walker takes over when it stands."""
        self._refuse_after_failure()
        self._backend.hoist(robot)
        return 'The robot is being put onto its feet.'

    def _refuse_after_failure(self) -> None:
        """Refuse what has no effect before a reset."""
        if self._loop.has_failed:
            raise SimulationError('The physics has failed; reset the simulation first.')


def _answer(do: Callable[[Any], str], request: Any, response: Any) -> Any:
    """Answer a request: whether it was done, and if not, why."""
    try:
        response.message, response.success = do(request), True
    except SimulationError as error:
        response.message, response.success = str(error), False
    return response


async def _answer_later(do: Callable[[Any], Awaitable[str]], request: Any, response: Any) -> Any:
    """Answer a request when it has been done, or refused."""
    try:
        response.message, response.success = await do(request), True
    except SimulationError as error:
        response.message, response.success = str(error), False
    return response
