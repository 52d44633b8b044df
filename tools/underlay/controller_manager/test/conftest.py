# SPDX-License-Identifier: Apache-2.0
"""A controller manager that remembers what it is asked."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
import sys
from threading import Thread
from typing import Any

from controller_manager_msgs.msg import ControllerState, HardwareComponentState
from controller_manager_msgs.srv import (
    ConfigureController,
    ListControllers,
    ListHardwareComponents,
    LoadController,
    SetHardwareComponentState,
    SwitchController,
    UnloadController,
)
from lifecycle_msgs.msg import State
import pytest
import rclpy
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node

TESTS = Path(__file__).parents[2]
sys.path[:0] = [str(TESTS / 'robot_state_publisher/test'), str(TESTS.parent / 'test')]

from publisher_fixtures import domain  # noqa: E402

__all__ = ['domain']


class Manager(Node):
    """A controller manager with one hardware component, which loads what has a known name."""

    def __init__(self, context: Context) -> None:
        """Offer the services."""
        super().__init__(
            'controller_manager',
            context=context,
            allow_undeclared_parameters=True,
            automatically_declare_parameters_from_overrides=True,
        )
        self.states: dict[str, str] = {}
        self.broken = ''
        self.switches: list[tuple[list[str], list[str]]] = []
        self.component = State(id=State.PRIMARY_STATE_INACTIVE, label='inactive')
        for kind, name, answer in (
            (ListControllers, 'list_controllers', self._list),
            (LoadController, 'load_controller', self._load),
            (ConfigureController, 'configure_controller', self._configure),
            (SwitchController, 'switch_controller', self._switch),
            (UnloadController, 'unload_controller', self._unload),
            (ListHardwareComponents, 'list_hardware_components', self._components),
            (SetHardwareComponentState, 'set_hardware_component_state', self._set_component),
        ):
            self.create_service(kind, f'~/{name}', answer)

    def _list(self, _: Any, response: Any) -> Any:
        response.controller = [
            ControllerState(name=name, state=state) for name, state in self.states.items()
        ]
        return response

    def _load(self, request: Any, response: Any) -> Any:
        response.ok = request.name not in self.states and request.name != self.broken
        if response.ok:
            self.states[request.name] = 'unconfigured'
        return response

    def _configure(self, request: Any, response: Any) -> Any:
        response.ok = self.states.get(request.name) in ('unconfigured', 'inactive')
        if response.ok:
            self.states[request.name] = 'inactive'
        return response

    def _switch(self, request: Any, response: Any) -> Any:
        on, off = list(request.activate_controllers), list(request.deactivate_controllers)
        self.switches.append((on, off))
        response.ok = self.broken not in on
        response.message = '' if response.ok else 'its joint is claimed'
        if response.ok:
            self.states |= dict.fromkeys(on, 'active') | dict.fromkeys(off, 'inactive')
        return response

    def _unload(self, request: Any, response: Any) -> Any:
        response.ok = self.states.get(request.name) in ('unconfigured', 'inactive')
        if response.ok:
            del self.states[request.name]
        return response

    def _components(self, _: Any, response: Any) -> Any:
        response.component = [HardwareComponentState(name='arm', state=self.component)]
        return response

    def _set_component(self, request: Any, response: Any) -> Any:
        response.ok = self.broken != 'arm'
        if response.ok:
            self.component = request.target_state
        response.state = self.component
        return response


@pytest.fixture
def manager(domain: int, monkeypatch: pytest.MonkeyPatch) -> Iterator[Manager]:
    """Run a controller manager without controllers, in the domain of the programs."""
    monkeypatch.setenv('ROS_DOMAIN_ID', str(domain))
    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    context = Context()
    rclpy.init(context=context, domain_id=domain)
    node = Manager(context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)

    def spin() -> None:
        try:
            executor.spin()
        except ExternalShutdownException:
            pass

    thread = Thread(target=spin)
    thread.start()
    yield node
    context.shutdown()
    thread.join()
    node.destroy_node()
