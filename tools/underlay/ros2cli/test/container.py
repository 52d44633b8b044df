# SPDX-License-Identifier: Apache-2.0
"""A container of components that loads only names."""

import os
import sys

from composition_interfaces.srv import ListNodes, LoadNode, UnloadNode
import rclpy
from rclpy.node import Node
from rclpy.parameter import parameter_value_to_python
from spinning import run_until_signal


class Container(Node):
    """Keeps the names of what was loaded; the plugin `Nope` cannot be loaded."""

    def __init__(self) -> None:
        """Offer the services of a container."""
        super().__init__('container')
        self._names: dict[int, str] = {}
        self._next = 1
        self.create_service(LoadNode, '~/_container/load_node', self._load)
        self.create_service(UnloadNode, '~/_container/unload_node', self._unload)
        self.create_service(ListNodes, '~/_container/list_nodes', self._list)

    def _load(self, request: LoadNode.Request, response: LoadNode.Response) -> LoadNode.Response:
        if request.plugin_name == 'Nope':
            response.error_message = 'failed to find class with the requested plugin name.'
            return response
        values = [parameter_value_to_python(each.value) for each in request.parameters]
        self.get_logger().info(f'{request.remap_rules} {values} {request.log_level}')
        name = f'{request.node_namespace}/{request.node_name or request.plugin_name.lower()}'
        self._names[self._next] = name
        response.success, response.full_node_name, response.unique_id = True, name, self._next
        self._next += 1
        return response

    def _unload(
        self, request: UnloadNode.Request, response: UnloadNode.Response
    ) -> UnloadNode.Response:
        response.success = self._names.pop(request.unique_id, None) is not None
        if not response.success:
            response.error_message = f'No node found with unique_id: {request.unique_id}'
        return response

    def _list(
        self, request: ListNodes.Request, response: ListNodes.Response
    ) -> ListNodes.Response:
        response.unique_ids = list(self._names)
        response.full_node_names = list(self._names.values())
        return response


def main() -> None:
    """Spin until a signal comes."""
    rclpy.init(args=sys.argv)
    node = Container()
    print('ready' if len(sys.argv) == 1 else f'container {os.getpid()}', flush=True)
    rclpy.spin(node)


if __name__ == '__main__':
    run_until_signal(main)
