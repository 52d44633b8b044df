# SPDX-License-Identifier: Apache-2.0
"""Model Context Protocol (MCP) server for the robot: the node `robot_mcp`."""

from __future__ import annotations

from dataclasses import dataclass
import os
import re
import secrets
import sys
import time
from typing import Any

from humanoid_common.errors import UserError
from humanoid_common.node_parameters import NodeParameters
from humanoid_common.parameters import parameter
from humanoid_common.paths import expanded_path
from humanoid_common.running import run_node
from llm_planner.actions import Actions
from llm_planner.knowledge import begin_watch, KnowledgeParameters
from rclpy.node import Node
from robot_mcp.audit import AuditLog, default_path
from robot_mcp.calls import Calls
from robot_mcp.robot_link import RobotLink
from robot_mcp.server import make_server, require_sdk
from robot_mcp.transports import (
    listen,
    PATH,
    serve_http,
    serve_stdio,
    ServerThread,
    take_stdout,
)

__all__ = ['McpParameters', 'RobotMcp', 'main']

TOKEN_VARIABLE = 'ROBOT_MCP_TOKEN'
_SHORTEST_TOKEN = 16
_OPTION = re.compile(r'[a-z_]+:=.*')
_SENT_S = 0.2
_START_S = 10.0


@dataclass(frozen=True)
class McpParameters(KnowledgeParameters):
    """The parameters of the node."""

    transport: str = parameter(
        'stdio',
        'How clients connect: stdio, for those that start the server, or http on 127.0.0.1.',
        choices=('stdio', 'http'),
        read_only=True,
    )
    port: int = parameter(
        8765, 'The HTTP port; 0 for any free port.', at_least=0, at_most=65535, read_only=True
    )
    allow_motion: bool = parameter(
        False,
        'Whether assistants may make the robot act; looking and stopping are always allowed.',
        read_only=True,
    )
    confirm: bool = parameter(
        False, 'Whether a person has to confirm each action of the robot.', read_only=True
    )
    audit_log: str = parameter(
        '',
        'The file in which each call is logged; empty for robot_mcp/audit.jsonl in ROS_HOME or '
        '~/.ros.',
        read_only=True,
    )


class RobotMcp(Node):
    """
    Node that serves assistants over the Model Context Protocol.

    The bearer token for HTTP is read from the environment variable ROBOT_MCP_TOKEN; without it, a
    random one is generated.

    Parameters
    ----------
    wire
        The file descriptor of the output to clients, or to those who start them.
    options
        Keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, wire: int = 1, **options: Any) -> None:
        super().__init__('robot_mcp', **options)
        told = NodeParameters(self, McpParameters).current
        require_sdk()
        planner, watch = begin_watch(self, told, Actions.IMPLEMENTED)
        path = expanded_path(told.audit_log) if told.audit_log else default_path(os.environ)
        self._link = RobotLink(self, may_move=told.allow_motion)
        logger = self.get_logger()
        calls = Calls(
            self._link,
            planner,
            watch,
            AuditLog(path, lambda text: logger.warning(text)),
            lambda text: logger.warning(text),
            allow_motion=told.allow_motion,
            confirm=told.confirm,
        )
        server = make_server(calls)
        self.url = self.token = ''
        if told.transport == 'http':
            self.token = _token()
            listener = listen(told.port)
            self.url = f'http://127.0.0.1:{listener.getsockname()[1]}{PATH}'
            self._server = ServerThread(
                lambda: serve_http(server, listener, self.token), self._end
            )
            # Whoever chose the token knows it, and others may see what is printed.
            shown = f'${TOKEN_VARIABLE}' if os.environ.get(TOKEN_VARIABLE) else self.token
            os.write(wire, f'{self.url}\nAuthorization: Bearer {shown}\n'.encode())
        else:
            self._server = ServerThread(lambda: serve_stdio(server, 0, wire), self._end)
        may = 'may move the robot' if told.allow_motion else 'may only look and stop'
        logger.info(f'Assistants {may}; their calls are logged in {path}')

    def destroy_node(self) -> None:
        """Stop the server, and cancel the plans of its clients."""
        if self._link.close():
            time.sleep(_SENT_S)  # let the cancel requests be sent
        self._server.close()
        super().destroy_node()

    def _end(self, error: BaseException | None) -> None:
        """Shut down when the server has ended, for example as its only client disconnects."""
        if error is not None:
            self.get_logger().error(f'The server failed: {type(error).__name__}: {error}')
        deadline_s = time.monotonic() + _START_S
        while self.executor is None and time.monotonic() < deadline_s:  # still starting
            time.sleep(0.01)
        if self.executor is not None:
            self.executor.create_task(self.context.try_shutdown)


def _token() -> str:
    """Return the token from the environment, or a random one."""
    token = os.environ.get(TOKEN_VARIABLE, '')
    if not token:
        return secrets.token_urlsafe(24)
    if len(token) < _SHORTEST_TOKEN or not token.isascii() or not token.isprintable():
        raise UserError(
            f'{TOKEN_VARIABLE} must have at least {_SHORTEST_TOKEN} letters or digits. Unset it '
            'for a random token.'
        )
    return token


def arguments_of(given: list[str]) -> list[str]:
    """
    Convert `name:=value` on a command line to ROS parameter assignments.

    Parameters
    ----------
    given
        The command line. Anything after `--ros-args` is left unchanged.

    Returns
    -------
    list of str
        The command line for ROS, with `--ros-args -p name:=value`.

    """
    cut = given.index('--ros-args') if '--ros-args' in given else len(given)
    plain, options = [], ['--ros-args']
    for each in given[:cut]:
        if _OPTION.fullmatch(each):
            options += ['-p', each]
        else:
            plain.append(each)
    after = cut + 1
    return [*plain, *options, *given[after:]]


def main(args: list[str] | None = None) -> int:
    """
    Run the node `robot_mcp`.

    Parameters
    ----------
    args : list[str] | None
        The command line with its ROS arguments; None for that of the process.

    Returns
    -------
    int
        The exit status: 1 if the node cannot start, else 0.

    """
    given = arguments_of(sys.argv if args is None else args)
    wire = take_stdout()
    return run_node(lambda: RobotMcp(wire), given)


if __name__ == '__main__':
    sys.exit(main())
