# SPDX-License-Identifier: Apache-2.0
"""The logger service: a node changes which log messages of another node are shown."""

from __future__ import annotations

from collections.abc import Sequence
import sys
from typing import Any

from demo_nodes_py.services.waiting import wait_for_service
from rcl_interfaces.msg import LoggerLevel
from rcl_interfaces.srv import GetLoggerLevels, SetLoggerLevels
from rclpy.logging import LoggingSeverity
from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import String
from tf2_ros.executing import response_of, sleep
from tf2_ros.program import run_node

__all__ = ['LoggerServiceNode', 'TestNode', 'main']

LEVELS = (LoggingSeverity.DEBUG, LoggingSeverity.WARN, LoggingSeverity.ERROR)
_LOOK_S = 0.05


class LoggerServiceNode(Node):
    """
    Logs each text of the topic `output` at each level, and offers the logger service.

    Parameters
    ----------
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, **options: Any) -> None:
        super().__init__('LoggerServiceNode', enable_logger_service=True, **options)
        self.heard: Future[None] = Future()
        self.create_subscription(String, 'output', self.callback, 10)

    def callback(self, msg: String) -> None:
        """
        Log a text at each level.

        Parameters
        ----------
        msg
            The text.

        """
        logger = self.get_logger()
        logger.debug(f'{msg.data} with DEBUG logger level.')
        logger.info(f'{msg.data} with INFO logger level.')
        logger.warning(f'{msg.data} with WARN logger level.')
        logger.error(f'{msg.data} with ERROR logger level.')
        self.heard.set_result(None)


class TestNode(Node):
    """
    Publishes texts, and reads and sets the logger level of another node.

    Parameters
    ----------
    remote_node_name
        The name of the other node.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, remote_node_name: str, **options: Any) -> None:
        super().__init__('TestNode', **options)
        self._remote_node_name = remote_node_name
        self.publisher = self.create_publisher(String, 'output', 10)
        self._getter = self.create_client(GetLoggerLevels, f'{remote_node_name}/get_logger_levels')
        self._setter = self.create_client(SetLoggerLevels, f'{remote_node_name}/set_logger_levels')

    async def get_logger_level_on_remote_node(self) -> int:
        """Ask for the level; 0 if none has been set."""
        await wait_for_service(self, self._getter.service_is_ready)
        request = GetLoggerLevels.Request(names=[self._remote_node_name])
        response = await response_of(self, lambda: self._getter.call_async(request))
        return int(response.levels[0].level)

    async def set_logger_level_on_remote_node(self, logger_level: LoggingSeverity) -> bool:
        """
        Set the level.

        Parameters
        ----------
        logger_level
            The least severe level that is shown.

        Returns
        -------
        bool
            Whether the other node has accepted it.

        """
        await wait_for_service(self, self._setter.service_is_ready)
        level = LoggerLevel(name=self._remote_node_name, level=int(logger_level))
        request = SetLoggerLevels.Request(levels=[level])
        response = await response_of(self, lambda: self._setter.call_async(request))
        result = response.results[0]
        if not result.successful:
            self.get_logger().error(f'The logger level was not set: {result.reason}')
        return bool(result.successful)


async def _publish(service: LoggerServiceNode, test: TestNode, text: str) -> None:
    """Publish a text, and wait until it has been logged."""
    while test.publisher.get_subscription_count() == 0:
        await sleep(test, _LOOK_S)
    service.heard = Future()
    test.publisher.publish(String(data=text))
    await service.heard


async def _work(test: TestNode) -> None:
    (service,) = test.companions
    logger = test.get_logger()
    logger.info('Output with default logger level:')
    await _publish(service, test, 'Output 1')
    logger.info(f'Current logger level: {await test.get_logger_level_on_remote_node()}')
    for number, level in enumerate(LEVELS, 2):
        logger.info(f'Output with {level.name.lower()} logger level:')
        if await test.set_logger_level_on_remote_node(level):
            await _publish(service, test, f'Output {number}')
            logger.info(f'Current logger level: {await test.get_logger_level_on_remote_node()}')


def _make_nodes(_: list[str]) -> TestNode:
    service = LoggerServiceNode()
    test = TestNode(service.get_name())
    test.companions = (service,)
    return test


def main(args: Sequence[str] | None = None) -> int:
    """
    Run both nodes until all levels have been shown; return the exit status.

    Parameters
    ----------
    args : Sequence[str] | None
        The command line including the program name; by default that of the process.

    """
    return run_node(_make_nodes, args, _work)


if __name__ == '__main__':
    sys.exit(main())
