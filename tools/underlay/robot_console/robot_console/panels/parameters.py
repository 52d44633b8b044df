# SPDX-License-Identifier: Apache-2.0
"""Panel with the parameters of nodes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, TYPE_CHECKING

from rcl_interfaces.msg import ParameterEvent
from rclpy.qos import qos_profile_parameter_events
from robot_console.live import LivePanel, Viewer
from robot_console.parameters.remote_parameters import LIST_SERVICE, RemoteParameters
from robot_console.service_calls import ServiceCalls

if TYPE_CHECKING:
    from robot_console.live.channel import Action

__all__ = ['Parameters']

EVENTS = '/parameter_events'


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
            viewer.tell(
                node=node, problem=f"There is no node '{node}' with parameters any longer."
            )

    def _load(self, node: str) -> None:
        remote = self._known.setdefault(node, RemoteParameters(self._calls, node))

        def tell(problem: str) -> None:
            self._tell(node, problem=problem, parameters=remote.told())

        remote.load(tell)

    def _set(self, viewer: Viewer, message: Mapping[str, Any]) -> None:
        node, name, text = (str(message.get(key, '')) for key in ('node', 'name', 'text'))
        remote = self._known.get(node)
        if remote is None or not remote.knows(name):
            viewer.tell(node=node, name=name, refused='The parameter is not there any longer.')
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
