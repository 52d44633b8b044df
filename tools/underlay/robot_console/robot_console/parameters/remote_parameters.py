# SPDX-License-Identifier: Apache-2.0
"""Access to the parameters of a node through its services."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from rcl_interfaces.msg import Parameter, ParameterDescriptor, ParameterValue
from rcl_interfaces.srv import DescribeParameters, GetParameters, ListParameters, SetParameters
from robot_console.parameters.conversions import described, parameter_value
from robot_console.service_calls import ServiceCalls
from ros2param.api import LIST_SERVICE

__all__ = ['LIST_SERVICE', 'RemoteParameters']

Tell = Callable[[str], None]
"""Called with '' on success, or with an error message."""


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
                tell(reason or 'The node did not say whether it took the value.')
            elif not result.successful:
                tell(f'Refused: {result.reason or "the node gives no reason"}')
            else:
                self._values[name] = value
                tell('')

        request = SetParameters.Request(parameters=[Parameter(name=name, value=value)])
        self._call(SetParameters, '/set_parameters', request, take_result)

    def _load_values(self, names: list[str], tell: Tell) -> None:
        def take_values(response: Any, reason: str) -> None:
            if response is None or len(response.values) != len(names):
                tell(reason or 'The node does not tell the values of its parameters.')
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
