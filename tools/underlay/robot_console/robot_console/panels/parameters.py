# SPDX-License-Identifier: Apache-2.0
"""Panel with the parameters of nodes, which are read and set through their services."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from rcl_interfaces.msg import Parameter, ParameterDescriptor, ParameterEvent, ParameterValue
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters, SetParameters
from rclpy.qos import qos_profile_parameter_events
from robot_console.live_panel import LivePanel
from robot_console.parameter_values import described, parameter_value
from robot_console.service_calls import ServiceCalls
from ros2param.api import LIST_SERVICE
from ros2param.api.values import to_plain_value
from rviz_common.page.channel import Action, Viewer

__all__ = ['Parameters', 'RemoteParameters']

Tell = Callable[[str], None]
"""Called with '' on success, or with an error message."""

EVENTS = '/parameter_events'


class RemoteParameters:
    """
    A cache of the parameters of a node, loaded and changed through its parameter services.

    All calls return immediately; their results are delivered by `ServiceCalls.update`.

    Parameters
    ----------
    calls
        The pending service calls.
    node_name
        The fully qualified name of the node.

    """

    def __init__(self, calls: ServiceCalls, node_name: str) -> None:
        self._calls = calls
        self._node_name = node_name
        self._values: dict[str, ParameterValue] = {}
        self._descriptors: dict[str, ParameterDescriptor] = {}

    def load(self, tell: Tell) -> None:
        """
        Request all names, values and descriptors from the node.

        Parameters
        ----------
        tell
            Called with '' once they are loaded, otherwise with an error message.

        """

        def take_names(response: Any, reason: str) -> None:
            if response is None:
                tell(reason)
                return
            self._load_values(sorted(response.result.names), tell)

        self._call(ListParameters, LIST_SERVICE, ListParameters.Request(), take_names)

    def take(self, name: str, value: ParameterValue) -> None:
        """
        Update a value that the node has published in a parameter event.

        Parameters
        ----------
        name, value
            The parameter and its new value.

        """
        self._values[name] = value

    def plain_values(self) -> dict[str, Any]:
        """Return the values as plain Python values, by name; None for those that are not set."""
        return {name: to_plain_value(value) for name, value in self._values.items()}

    def told(self) -> dict[str, dict[str, Any]]:
        """Describe all parameters for the page."""
        return {name: self.told_of(name) for name in sorted(self._values)}

    def told_of(self, name: str) -> dict[str, Any]:
        """
        Describe one parameter for the page, as `described` does.

        Parameters
        ----------
        name
            A known parameter.

        """
        return described(self._values[name], self._descriptors.get(name))

    def knows(self, name: str) -> bool:
        """
        Check whether the node has a parameter, according to the cache.

        Parameters
        ----------
        name
            The name of the parameter.

        """
        return name in self._values

    def change(self, name: str, text: str, tell: Tell) -> None:
        """
        Request a parameter change from the node.

        Parameters
        ----------
        name
            A known parameter.
        text
            The new value, as typed by the user.
        tell
            Called with '' once the node has set it, otherwise with an error message.

        Raises
        ------
        ValueError
            The value is invalid for the parameter; the request is not sent.

        """
        descriptor = self._descriptors.get(name) or ParameterDescriptor()
        value = parameter_value(text, self._values[name], descriptor)

        def take_result(response: Any, reason: str) -> None:
            result = response.results[0] if response and response.results else None
            if result is None:
                tell(reason or 'The node did not report whether it set the value.')
            elif not result.successful:
                tell(f'Rejected: {result.reason or "the node gives no reason"}')
            else:
                self._values[name] = value
                tell('')

        request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
        self._call(SetParameters, '/set_parameters', request, take_result)

    def _load_values(self, names: list[str], tell: Tell) -> None:
        def take_values(response: Any, reason: str) -> None:
            if response is None or len(response.values) != len(names):
                tell(reason or 'The node did not return the values of its parameters.')
                return
            self._values = dict(zip(names, response.values))
            self._load_descriptions(names, tell)

        request = GetParameters.Request(names=names)
        self._call(GetParameters, '/get_parameters', request, take_values)

    def _load_descriptions(self, names: list[str], tell: Tell) -> None:
        def take_descriptions(response: Any, reason: str) -> None:
            if response is not None:
                self._descriptors = {each.name: each for each in response.descriptors}
            tell('')

        request = DescribeParameters.Request(names=names)
        self._call(DescribeParameters, '/describe_parameters', request, take_descriptions)

    def _call(self, kind: Any, service: str, request: Any, answer: Any) -> None:
        self._calls.call(kind, f'{self._node_name}{service}', request, answer)


class Parameters(LivePanel):
    """The parameters of one node at a time, which can be changed; the node may refuse."""

    CLASS = 'robot_console/Parameters'
    PAGE = 'parameters'
    PERIOD_S = 1.0

    def actions(self) -> Mapping[str, Action]:
        """Return the actions that the page may request."""
        return {'choose': self._choose, 'set': self._set}

    def begin(self) -> None:
        """Initialise the service calls and caches."""
        self._calls = ServiceCalls(self.context.node)
        self._nodes: list[str] = []
        self._known: dict[str, RemoteParameters] = {}
        self._ear: Any = None

    def greet(self, viewer: Viewer) -> None:
        """
        Send the list of nodes with parameters to a new viewer.

        Parameters
        ----------
        viewer
            As for `LivePanel.greet`.

        """
        self._nodes = self._found()
        viewer.tell(nodes=self._nodes)

    def update(self) -> None:
        """Process pending service calls, and send updates."""
        self._calls.update()
        super().update()

    def refresh(self) -> None:
        """Send the list of nodes if it has changed, and drop nodes without viewers."""
        viewers = self.channel.viewers
        wanted = {viewer.wish for viewer in viewers}
        self._known = {name: each for name, each in self._known.items() if name in wanted}
        self._listen(bool(self._known))
        if not viewers:
            return
        nodes = self._found()
        if nodes != self._nodes:
            self._nodes = nodes
            self.channel.tell(nodes=nodes)

    def end(self) -> None:
        """Cancel service calls, and destroy the subscription."""
        self._calls.close()
        self._listen(False)

    def _found(self) -> list[str]:
        """Return the nodes that have parameter services."""
        namespace = self.values['Namespace']
        space = f'/{namespace}/' if namespace else '/'
        names = [name for name, _ in self.context.node.get_service_names_and_types()]
        owners = [name.removesuffix(LIST_SERVICE) for name in names if name.endswith(LIST_SERVICE)]
        return sorted(owner for owner in owners if owner.startswith(space))

    def _choose(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        node = message.get('node')
        viewer.wish = node if isinstance(node, str) and node in self._found() else None
        if viewer.wish:
            self._listen(True)
            self._load(viewer.wish)
        elif node:
            viewer.tell(node=node, problem=f"There is no longer a node '{node}' with parameters.")

    def _load(self, node: str) -> None:
        remote = self._known.setdefault(node, RemoteParameters(self._calls, node))

        def tell(problem: str) -> None:
            self._tell(node, problem=problem, parameters=remote.told())

        remote.load(tell)

    def _set(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        node, name, text = (str(message.get(key, '')) for key in ('node', 'name', 'text'))
        remote = self._known.get(node)
        if remote is None or not remote.knows(name):
            viewer.tell(node=node, name=name, refused='The parameter no longer exists.')
            return

        def tell(reason: str) -> None:
            viewer.tell(node=node, name=name, refused=reason)
            if not reason:
                self._tell(node, changed={name: remote.told_of(name)})

        try:
            remote.change(name, text, tell)
        except ValueError as error:
            tell(str(error))

    def _tell(self, node: str, **values: Any) -> None:
        for viewer in self.channel.viewers:
            if viewer.wish == node:
                viewer.tell(node=node, **values)

    def _listen(self, is_wanted: bool) -> None:
        """Subscribe to parameter events while a viewer has selected a node."""
        node = self.context.node
        if is_wanted and self._ear is None:
            self._ear = node.create_subscription(
                ParameterEvent, EVENTS, self._hear, qos_profile_parameter_events
            )
        elif not is_wanted and self._ear is not None:
            node.destroy_subscription(self._ear)
            self._ear = None

    def _hear(self, event: Any) -> None:
        remote = self._known.get(event.node)
        if remote is None:
            return
        if event.new_parameters or event.deleted_parameters:
            self._load(event.node)
            return
        changed = [each for each in event.changed_parameters if remote.knows(each.name)]
        for each in changed:
            remote.take(each.name, each.value)
        if changed:
            self._tell(
                event.node, changed={each.name: remote.told_of(each.name) for each in changed}
            )
