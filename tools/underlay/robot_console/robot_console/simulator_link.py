# SPDX-License-Identifier: Apache-2.0
"""The simulator of a robot: which services it offers, its state, and its scenes."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
import time
from typing import Any, TYPE_CHECKING

from robot_console.service_calls import Answer, ServiceCalls
from rviz_common.pace import Pace
from simulation_interfaces.msg import Result, WorldResource
from simulation_interfaces.srv import (
    GetAvailableWorlds,
    GetCurrentWorld,
    GetSimulationState,
    LoadWorld,
    ResetSimulation,
    SetSimulationState,
    StepSimulation,
)

if TYPE_CHECKING:
    from rclpy.node import Node

__all__ = [
    'SERVICES',
    'SILENT',
    'SimulatorLink',
    'choose_simulator',
    'failure_of',
    'simulators_among',
]

SERVICES: dict[str, Any] = {
    'get_available_worlds': GetAvailableWorlds,
    'get_current_world': GetCurrentWorld,
    'get_simulation_state': GetSimulationState,
    'load_world': LoadWorld,
    'reset_simulation': ResetSimulation,
    'set_simulation_state': SetSimulationState,
    'step_simulation': StepSimulation,
}
"""The services of simulators that the console uses, by name, with their types."""

NO_SIMULATOR = 'No simulator is running: this works in simulation only.'
LOOK_S = 1.0
SILENCE_S = 3.0
"""A simulator that does not report its state within this time is asked again."""
SILENT = -1
"""The state of a simulator that does not report it in time."""


def simulators_among(services: Iterable[tuple[str, Sequence[str]]]) -> dict[str, set[str]]:
    """
    Find simulators in the ROS graph.

    Parameters
    ----------
    services
        The name and the types of each service.

    Returns
    -------
    dict of str to set of str
        For each simulator, by the name of its node, the services of `SERVICES` that it offers.

    """
    found: dict[str, set[str]] = {}
    for name, types in services:
        simulator, _, service = name.rpartition('/')
        kind = SERVICES.get(service)
        if kind is not None and f'simulation_interfaces/srv/{kind.__name__}' in types:
            found.setdefault(simulator, set()).add(service)
    return found


def choose_simulator(
    found: Collection[str],
    wanted: str,
    namespace: str,
    owner: str = "panel 'robot_console/Robot'",
) -> str:
    """
    Choose the simulator of a robot.

    Parameters
    ----------
    found
        The names of the simulators.
    wanted
        The name of the one that the user has chosen; '' for the only one that is running.
    namespace
        The namespace of the robot: one simulator below it has priority over others.
    owner
        What has the property `Simulator`, for the message.

    Raises
    ------
    ValueError
        There is no such simulator, or more than one; the message is a full sentence.

    """
    if wanted:
        if wanted not in found:
            raise ValueError(f"The simulator '{wanted}' is not running.")
        return wanted
    below = [each for each in found if namespace and each.startswith(f'/{namespace}/')]
    candidates = sorted(below or found)
    if not candidates:
        raise ValueError(NO_SIMULATOR)
    if len(candidates) > 1:
        raise ValueError(
            f'There are several simulators: {", ".join(candidates)}. Name one in the property '
            f"'Simulator' of the {owner}."
        )
    return candidates[0]


def failure_of(response: Any) -> str:
    """
    Return why a request was rejected; '' if it was granted.

    Parameters
    ----------
    response
        A response of `std_srvs/srv/Trigger`, or of a service in `SERVICES`.

    """
    if hasattr(response, 'success'):
        is_granted, reason = response.success, response.message
    else:
        is_granted = response.result.result == Result.RESULT_OK
        reason = response.result.error_message
    return '' if is_granted else reason or 'The request was rejected without a reason.'


class SimulatorLink:
    """
    The simulator of a robot, which may start and end at any time.

    Parameters
    ----------
    node
        The node that owns the clients. It is used in its own thread only.
    calls
        Makes the service calls.
    wanted
        As for `choose_simulator`.
    namespace
        The namespace of the robot, without leading and trailing slashes; '' for that of the node.

    Attributes
    ----------
    state
        The newest state, of `simulation_interfaces/msg/SimulationState`; `SILENT` if the simulator
        does not report it in time, None if it is unknown.
    worlds
        The scenes that it can load.
    world
        The URI of the scene that is loaded; '' if it is unknown.

    """

    def __init__(self, node: Node, calls: ServiceCalls, wanted: str, namespace: str) -> None:
        self._node, self._calls = node, calls
        self._wanted = wanted
        self._namespace = namespace or node.get_namespace().strip('/')
        self._place: str | None = None
        self._problem = NO_SIMULATOR
        self._offered: set[str] = set()
        self._look = Pace(LOOK_S)
        self._poll = Pace(LOOK_S)
        self._client: Any = None
        self._future: Any = None
        self._asked_s = 0.0
        self._forget()

    def why_not(self, service: str) -> str:
        """
        Return why a service cannot be called, as a sentence; '' if it can.

        Parameters
        ----------
        service
            One of `SERVICES`.

        """
        if self._place is None:
            return self._problem
        if service in self._offered:
            return ''
        return f"The simulator does not offer the service '{self._place}/{service}'."

    def call(self, service: str, request: Any, answer: Answer, timeout_s: float = 5.0) -> None:
        """
        Call a service of the simulator.

        Parameters
        ----------
        service
            One of `SERVICES`; `why_not` must have returned ''.
        request, answer, timeout_s
            As for `ServiceCalls.call`.

        """
        name = f'{self._place}/{service}'
        self._calls.call(SERVICES[service], name, request, answer, timeout_s)

    def update(self) -> None:
        """Look for the simulator, and ask for its state, about once a second."""
        if self._look.is_due():
            self._find()
        if self._client is not None:
            self._follow_state()

    def ask_for_worlds(self) -> None:
        """Ask which scene is loaded, and which others there are."""
        for service, take in (
            ('get_available_worlds', self._take_worlds),
            ('get_current_world', self._take_world),
        ):
            if not self.why_not(service):
                self.call(service, SERVICES[service].Request(), take)

    def hurry(self) -> None:
        """Ask for the state at once, after a request that may have changed it."""
        self._poll.hurry()

    def close(self) -> None:
        """Destroy the client."""
        self._forget()

    def _find(self) -> None:
        """Look for the simulator in the ROS graph."""
        node = self._node
        found = simulators_among(
            (name, types)
            for name, types in node.get_service_names_and_types()
            if name.rpartition('/')[2] in SERVICES and node.count_services(name)
        )
        try:
            place = choose_simulator(found, self._wanted, self._namespace)
        except ValueError as error:
            self._problem, place = str(error), None
        offered = set() if place is None else found[place]
        if place == self._place and offered == self._offered:
            return
        self._forget()
        self._place, self._offered = place, offered
        if 'get_simulation_state' in offered:
            name = f'{place}/get_simulation_state'
            self._client = node.create_client(GetSimulationState, name)
        self.ask_for_worlds()

    def _forget(self) -> None:
        """Forget what another simulator has reported."""
        if self._client is not None:
            self._node.destroy_client(self._client)
        self._client = self._future = None
        self.state: int | None = None
        self.worlds: list[WorldResource] = []
        self.world = ''

    def _follow_state(self) -> None:
        """Take the state that was asked for, and ask again when it is time."""
        now_s = time.monotonic()
        if self._future is not None and self._future.done():
            state = self._future.result().state.state
            self._future = None
            if state != self.state:
                self.state = state
                self.ask_for_worlds()
        elif self._future is not None and now_s - self._asked_s > SILENCE_S:
            self._client.remove_pending_request(self._future)
            self._future, self.state = None, SILENT
        if self._future is None and self._poll.is_due() and self._client.service_is_ready():
            self._asked_s = now_s
            self._future = self._client.call_async(GetSimulationState.Request())

    def _take_worlds(self, response: Any, failed: str) -> None:
        if not failed and not failure_of(response):
            self.worlds = sorted(response.worlds, key=lambda world: world.name)

    def _take_world(self, response: Any, failed: str) -> None:
        if not failed and not failure_of(response):
            self.world = response.world.world_resource.uri
