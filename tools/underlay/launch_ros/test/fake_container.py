# SPDX-License-Identifier: Apache-2.0
"""A container that loads nothing, and prints what it is asked for."""

from __future__ import annotations

import json
from pathlib import Path
import sys
import time
from typing import Any

from composition_interfaces.srv import LoadNode
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python


def _named(parameters: Any) -> list[Any]:
    values = [(each.name, parameter_value_to_python(each.value)) for each in parameters]
    return [(name, list(v) if hasattr(v, 'typecode') else v) for name, v in values]


def _meet(folder: str, name: str) -> bool:
    """Wait until another container is asked for a node at the same time."""
    Path(folder, name).touch()
    until = time.monotonic() + 30.0
    while len(list(Path(folder).iterdir())) < 2 and time.monotonic() < until:
        time.sleep(0.01)
    return len(list(Path(folder).iterdir())) == 2


class FakeContainer(Node):
    """Answers as the name of the plugin says: Bad fails, Meet waits, Die ends the process."""

    def __init__(self) -> None:
        """Offer the service."""
        super().__init__('container')
        self._loaded = 0
        self.create_service(LoadNode, '~/_container/load_node', self._load)

    def _load(self, request: Any, response: Any) -> Any:
        told = json.dumps(self._told(request), default=lambda raw: raw.decode('latin-1'))
        print(told, flush=True)
        if request.plugin_name == 'Die':
            sys.exit(3)
        response.success = request.plugin_name != 'Bad'
        if request.plugin_name == 'Meet':
            response.success = _meet(request.package_name, self.get_name())
        if not response.success:
            response.error_message = 'no such class'
            return response
        self._loaded += 1
        response.unique_id = self._loaded
        response.full_node_name = f'{request.node_namespace}/{request.node_name or "inborn"}'
        return response

    def _told(self, request: Any) -> dict[str, Any]:
        return {
            'container': self.get_fully_qualified_name(),
            'package': request.package_name,
            'plugin': request.plugin_name,
            'name': request.node_name,
            'namespace': request.node_namespace,
            'remaps': list(request.remap_rules),
            'parameters': _named(request.parameters),
            'extra': _named(request.extra_arguments),
        }


def main() -> None:
    """Run the container until it is told to end."""
    rclpy.init()
    try:
        rclpy.spin(FakeContainer())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass


if __name__ == '__main__':
    main()
