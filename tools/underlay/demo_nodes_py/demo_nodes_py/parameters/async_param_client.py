# SPDX-License-Identifier: Apache-2.0
"""A node that sets, lists, gets, loads and deletes the parameters of another node."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
import sys
from typing import Any

from demo_nodes_py.services.waiting import wait_for_service
from rclpy.node import Node
from rclpy.parameter import Parameter, parameter_dict_from_yaml_file, parameter_value_to_python
from rclpy.parameter_client import AsyncParameterClient
from tf2_ros.executing import response_of
from tf2_ros.program import run_node

__all__ = ['AsyncParamClient', 'main']

FILE = Path(__file__).parent / 'params.yaml'
PARAMETERS = {'int_parameter': 10, 'bool_parameter': False, 'string_parameter': 'Fee Fi Fo Fum'}
DELETED = ['other_int_parameter', 'other_string_parameter', 'string_parameter']


class AsyncParamClient(Node):
    """
    Changes the parameters of the node `parameter_blackboard`, which accepts any.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('async_param_client', **options)
        self._client = AsyncParameterClient(self, 'parameter_blackboard')

    async def change(self) -> None:
        """Do one after the other once the node is there, and log the results."""
        await wait_for_service(self, self._client.services_are_ready)
        await self._set()
        await self._list()
        await self._get()
        await self._load()
        await self._delete()

    async def _set(self) -> None:
        self._log('Setting parameters:')
        parameters = [Parameter(name, value=value) for name, value in PARAMETERS.items()]
        response = await response_of(self, lambda: self._client.set_parameters(parameters))
        for name, result in zip(PARAMETERS, response.results):
            self._log(f'    {name}:')
            self._log(f'        successful: {result.successful}')

    async def _list(self) -> None:
        self._log('Listing Parameters:')
        response = await response_of(self, lambda: self._client.list_parameters([*PARAMETERS], 10))
        for name in sorted(response.result.names):
            self._log(f'    - {name}')

    async def _get(self) -> None:
        self._log('Getting parameters:')
        response = await response_of(self, lambda: self._client.get_parameters([*PARAMETERS]))
        for name, value in zip(PARAMETERS, response.values):
            self._log(f'    - {name}: {parameter_value_to_python(value)}')

    async def _load(self) -> None:
        self._log('Loading parameters:')
        loaded = parameter_dict_from_yaml_file(str(FILE))
        response = await response_of(self, lambda: self._client.load_parameter_file(str(FILE)))
        for message, result in zip(loaded.values(), response.results):
            self._log(f'    {message.name}:')
            self._log(f'        successful: {result.successful}')
            self._log(f'        value: {parameter_value_to_python(message.value)}')

    async def _delete(self) -> None:
        self._log('Deleting parameters:')
        response = await response_of(self, lambda: self._client.delete_parameters(DELETED))
        for name, result in zip(DELETED, response.results):
            self._log(f'    {name}:')
            self._log(f'        successful: {result.successful}')
            self._log(f'        reason: {result.reason}')

    def _log(self, text: str) -> None:
        self.get_logger().info(text)


def main(args: Sequence[str] | None = None) -> int:
    """
    Run the node; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(lambda _: AsyncParamClient(), args, AsyncParamClient.change)


if __name__ == '__main__':
    sys.exit(main())
