# SPDX-License-Identifier: Apache-2.0
"""Panel to call the services of a robot, with requests and responses as YAML."""

from __future__ import annotations

from collections.abc import Mapping
import time
from typing import Any

from robot_console.live_panel import LivePanel
from robot_console.namespaces import NAMESPACE
from robot_console.service_calls import ServiceCalls
from ros2cli.messages.lookup import get_passed_type
from ros2cli.messages.outgoing import OutgoingMessage
from ros2cli.messages.text import IDL_NAMES, Shortening, to_yaml
from rviz_common.page.channel import Action, Viewer
from rviz_common.properties import Number

__all__ = ['Services', 'fields_text', 'filled', 'response_text', 'service_class', 'template']

SHORT = Shortening(length=500)
LONGEST = 50_000
UNDERSTOOD = (RuntimeError, AssertionError, AttributeError, TypeError)


def service_class(type_name: str) -> Any:
    """
    Import the class of a service type.

    Parameters
    ----------
    type_name
        For example `std_srvs/srv/Trigger`.

    Raises
    ------
    ValueError
        The type is not installed or not a service type.

    """
    try:
        return get_passed_type(type_name, 'srv')
    except RuntimeError as error:
        raise ValueError(str(error)) from error


def template(kind: Any) -> str:
    """
    Format the default request of a service as YAML, for a user to edit.

    Parameters
    ----------
    kind
        The class of the service type.

    Returns
    -------
    str
        The YAML; '' if the request has no fields.

    """
    request = kind.Request()
    return to_yaml(request) if request.get_fields_and_field_types() else ''


def fields_text(kind: Any, part: str = 'Request') -> str:
    """
    List the fields of a request or response with their types, on one line.

    Parameters
    ----------
    kind
        The class of the service type.
    part
        `Request` or `Response`.

    """
    fields = getattr(kind, part).get_fields_and_field_types()
    return ', '.join(f'{name}: {IDL_NAMES.get(each, each)}' for name, each in fields.items())


def filled(kind: Any, text: str, now: Any) -> Any:
    """
    Parse a service request from YAML.

    Parameters
    ----------
    kind
        The class of the service type.
    text
        The YAML that the user has edited.
    now
        The current time, as a `builtin_interfaces/msg/Time`, for fields with an automatic stamp.

    Returns
    -------
    Any
        The request.

    Raises
    ------
    ValueError
        The text does not match the fields.

    """
    try:
        return OutgoingMessage(kind.Request(), text).stamped(now)
    except UNDERSTOOD as error:
        raise ValueError(str(error)) from error


def response_text(response: Any) -> str:
    """
    Format a service response as YAML, truncated if it is long.

    Parameters
    ----------
    response
        The response; without fields, a message is returned instead.

    """
    if not response.get_fields_and_field_types():
        return 'Done. The response has no fields.'
    text = to_yaml(response, SHORT)
    if len(text) <= LONGEST:
        return text
    return f'{text[:LONGEST]}\n... ({len(text) - LONGEST} characters more)'


class Services(LivePanel):
    """All services; a request of one as a text to fill, and what comes back."""

    CLASS = 'robot_console/Services'
    PAGE = 'services'
    PERIOD_S = 1.0
    PROPERTIES = (
        NAMESPACE,
        Number('Timeout', 5.0, 'Seconds to wait for a response.', 0.1, 3600.0),
    )

    def settings(self) -> dict[str, Any]:
        """Return the initial settings of the page."""
        return {'timeout': self.values['Timeout'], 'space': self._space()}

    def actions(self) -> Mapping[str, Action]:
        """Return the actions that the page may request."""
        return {'choose': self._choose, 'call': self._call}

    def begin(self) -> None:
        """Initialise the service calls."""
        self._calls = ServiceCalls(self.context.node)
        self._rows: list[tuple[str, str, bool]] = []

    def greet(self, viewer: Viewer) -> None:
        """
        Send the list of services to a new viewer.

        Parameters
        ----------
        viewer
            As for `LivePanel.greet`.

        """
        self._rows = self._found()
        viewer.tell(rows=self._rows)

    def update(self) -> None:
        """Process pending service calls, and send updates."""
        self._calls.update()
        super().update()

    def refresh(self) -> None:
        """Send the list of services if it has changed."""
        if not self.channel.viewers:
            return
        rows = self._found()
        if rows != self._rows:
            self._rows = rows
            self.channel.tell(rows=rows)

    def end(self) -> None:
        """Cancel pending service calls."""
        self._calls.close()

    def _space(self) -> str:
        namespace = self.values['Namespace']
        return f'/{namespace}/' if namespace else '/'

    def _found(self) -> list[tuple[str, str, bool]]:
        """Return the name and type of each service, and whether a node offers it."""
        node, space = self.context.node, self._space()
        return [
            (name, ', '.join(types), node.count_services(name) > 0)
            for name, types in sorted(node.get_service_names_and_types())
            if name.startswith(space)
        ]

    def _type_of(self, service: str) -> str:
        """Return the type of a service, or raise ValueError."""
        types = dict(self.context.node.get_service_names_and_types()).get(service, [])
        if len(types) != 1:
            has = f'has several types: {", ".join(types)}' if types else 'no longer exists'
            raise ValueError(f"'{service}' {has}.")
        return str(types[0])

    def _choose(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        service = str(message.get('service', ''))
        try:
            kind = service_class(self._type_of(service))
        except ValueError as error:
            viewer.tell(service=service, problem=str(error))
            return
        viewer.tell(
            service=service,
            template=template(kind),
            fields=fields_text(kind),
            answers=fields_text(kind, 'Response'),
            offered_by=self._owners(service),
        )

    def _owners(self, service: str) -> list[str]:
        """Return the names of the nodes that offer a service."""
        node, owners = self.context.node, []
        for name, namespace in node.get_node_names_and_namespaces():
            try:
                offered = node.get_service_names_and_types_by_node(name, namespace)
            except Exception:  # noqa: S112 (rclpy has its own; a node may end just now)
                continue
            if any(each == service for each, _ in offered):
                owners.append(f'{namespace.rstrip("/")}/{name}')
        return sorted(owners)

    def _call(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        service, number = str(message.get('service', '')), message.get('number')
        now = self.context.node.get_clock().now().to_msg()
        begun_s = time.monotonic()

        def answer(response: Any, reason: str) -> None:
            took_s = time.monotonic() - begun_s
            text = response_text(response) if response is not None else ''
            viewer.tell(service=service, number=number, text=text, failed=reason, took=took_s)

        try:
            kind = service_class(self._type_of(service))
            request = filled(kind, str(message.get('text', '')), now)
        except ValueError as error:
            answer(None, str(error))
            return
        self._calls.call(kind, service, request, answer, self.values['Timeout'])
