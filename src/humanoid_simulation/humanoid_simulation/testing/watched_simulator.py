# SPDX-License-Identifier: Apache-2.0
"""A simulator that runs in the process of a test."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from humanoid_common.qos import SENSOR
from humanoid_common.testing.ros import RosSandbox
from humanoid_simulation.examples.conversions import refusal, state_request
from humanoid_simulation.simulator import Simulator
from rosgraph_msgs.msg import Clock
from simulation_interfaces.msg import EntityState
from simulation_interfaces.srv import (
    ResetSimulation,
    SetEntityState,
    SetSimulationState,
    StepSimulation,
)

HEADLESS = {'camera_rate_hz': 0.0, 'real_time_factor': 0.0}


class WatchedSimulator:
    """
    In-process simulator, with subscribers to its topics and clients of its services.

    It runs as fast as possible and without cameras, unless the parameters say otherwise.

    Parameters
    ----------
    ros
        The sandbox in which the node of the simulator is started.
    **parameters
        Parameters of that node.

    Attributes
    ----------
    node
        The node that subscribes and calls services.
    last
        Newest message by topic, of the topics passed to `listen`.
    times_s
        All simulated times received on `/clock`.
    simulator
        The node of the simulator.

    Raises
    ------
    UserError
        The simulator cannot start with these parameters.

    """

    def __init__(self, ros: RosSandbox, **parameters: Any) -> None:
        self.ros, self.node = ros, ros.observer()
        self.last: dict[str, Any] = {}
        self.times_s: list[float] = []
        self.node.create_subscription(Clock, '/clock', self._hear_time, 10)
        self.simulator = ros.start(Simulator, {**HEADLESS, **parameters})

    def _hear_time(self, message: Clock) -> None:
        self.times_s.append(message.clock.sec + message.clock.nanosec * 1e-9)

    def listen(self, kind: Any, topic: str) -> None:
        """
        Subscribe to a topic, and keep its newest message in `last`.

        Parameters
        ----------
        kind
            The message type.
        topic
            The name of the topic, which is also the key in `last`.

        """

        def keep(message: Any) -> None:
            self.last[topic] = message

        self.node.create_subscription(kind, topic, keep, SENSOR)

    def wait(self, what: str, condition: Callable[[], bool]) -> None:
        """
        Spin until a condition holds.

        Parameters
        ----------
        what
            Description of the condition, for the error message.
        condition
            The condition.

        Raises
        ------
        WaitedInVainError
            The condition did not hold within 30 s of real time.

        """
        self.ros.wait_until(condition, 30.0, what)

    def wait_for(self, *topics: str) -> None:
        """
        Wait for a new message on each of some topics.

        Parameters
        ----------
        *topics
            Topics that were passed to `listen` before.

        """
        for topic in topics:
            self.last.pop(topic, None)
        self.wait(f'all of {topics}', lambda: set(topics) <= set(self.last))

    def run(self, seconds: float) -> None:
        """
        Wait for a duration in simulated time.

        Parameters
        ----------
        seconds
            The duration, in s of simulated time.

        """
        self.wait('a time', lambda: bool(self.times_s))
        end_s = self.times_s[-1] + seconds
        self.wait('the time to pass', lambda: self.times_s[-1] >= end_s)

    def ask(self, kind: Any, name: str, /, **request: Any) -> Any:
        """
        Call a service, and wait for the response.

        Parameters
        ----------
        kind, name
            Type and name of the service.
        **request
            The fields of the request.

        Returns
        -------
        Any
            The response, of the type of the service.

        """
        client = self.node.create_client(kind, name)
        self.wait(name, client.service_is_ready)
        future = client.call_async(kind.Request(**request))
        self.wait(f'an answer of {name}', future.done)
        self.node.destroy_client(client)
        return future.result()

    def pause(self, on: bool = True) -> str:
        """
        Pause or resume the simulation.

        Parameters
        ----------
        on
            Whether to pause it.

        Returns
        -------
        str
            Why the simulator rejected the request; empty if it did not.

        """
        state = state_request(on).state
        return refusal(self.ask(SetSimulationState, 'simulator/set_simulation_state', state=state))

    def step(self, steps: int) -> str:
        """
        Advance a paused simulation.

        Parameters
        ----------
        steps
            Number of physics steps.

        Returns
        -------
        str
            Why the simulator rejected the request; empty if it did not.

        """
        return refusal(self.ask(StepSimulation, 'simulator/step_simulation', steps=steps))

    def reset(self) -> str:
        """Reset the simulation; return why the simulator rejected that, empty if it did not."""
        return refusal(self.ask(ResetSimulation, 'simulator/reset_simulation'))

    def put(self, entity: str, x: float, y: float, z: float) -> str:
        """
        Move an entity, at rest, with the axes of the world.

        Parameters
        ----------
        entity
            The name of the object or robot.
        x, y, z
            The new position of its origin, in m in the world frame.

        Returns
        -------
        str
            Why the simulator rejected the request; empty if it did not.

        """
        state = EntityState()
        state.pose.position.x, state.pose.position.y, state.pose.position.z = x, y, z
        name = 'simulator/set_entity_state'
        return refusal(self.ask(SetEntityState, name, entity=entity, state=state))
