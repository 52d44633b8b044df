# SPDX-License-Identifier: Apache-2.0
"""What a launch says of the robot: that it has started, with its page, and how it has ended."""

from __future__ import annotations

from collections.abc import Mapping
import re
from typing import Optional

from humanoid_bringup.start_box import is_shared, qr_code, start_box, Terminal
from launch import Action, LaunchContext
from launch.actions import LogInfo, OpaqueFunction, Shutdown, TimerAction
from launch.event_handlers import OnProcessExit, OnProcessIO
from launch.events.process import ProcessExited, ProcessIO
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ROBOTS = ('simulator', 'mock_robot')
"""The executables that act as the robot for all other nodes."""
ADDRESS = re.compile(r'RViz is at (http\S+)\s')
STARTED = re.compile(r'(Simulator|Mock robot) started')
SETTLE_S = 2.0
"""Delay after which other nodes have logged their startup messages."""
_LONGEST = 4096

BRING = 'bring me the red mug from the kitchen'
TURN = 'turn around'
_NEEDED_TO_BRING = ('navigation', 'perception', 'hands', 'manipulation')


class Startup:
    """
    Detects in the output of processes that the robot and its page have started.

    Parameters
    ----------
    has_page
        Whether there is a page to wait for.

    """

    def __init__(self, has_page: bool = True) -> None:
        self._written: dict[str, str] = {}
        self._url: str | None = None if has_page else ''
        self._has_robot = self._is_over = False

    def hear(self, process: str, text: str) -> Optional[str]:
        """
        Search the output of a process, in pieces of any size.

        Parameters
        ----------
        process
            The name of the process.
        text
            Its output since the last call.

        Returns
        -------
        Optional[str]
            The address of the page, once, when the robot has started as well; '' without a page.
            Otherwise None.

        """
        if self._is_over:
            return None
        written = self._written[process] = (self._written.get(process, '') + text)[-_LONGEST:]
        found = ADDRESS.search(written)
        self._url = found[1] if found else self._url
        self._has_robot |= STARTED.search(written) is not None
        self._is_over = self._has_robot and self._url is not None
        return self._url if self._is_over else None


def announce_start(has_page: bool) -> OnProcessIO:
    """
    Build the event handler that logs the start box once the robot and its page have started.

    Parameters
    ----------
    has_page
        Whether the launch starts a page; without one, the box has no address.

    """
    startup = Startup(has_page)

    def hear(event: ProcessIO) -> Optional[list[Action]]:
        url = startup.hear(event.process_name, event.text.decode(errors='replace'))
        if url is None:
            return None
        return [TimerAction(period=SETTLE_S, actions=[OpaqueFunction(function=_log, args=[url])])]

    return OnProcessIO(on_stdout=hear, on_stderr=hear)


def _log(context: LaunchContext, url: str) -> list[Action]:
    """Return the action that logs the start box."""
    arguments = context.launch_configurations
    return [LogInfo(msg=announcement(url, arguments, Terminal.of_output()))]


def announcement(url: str, arguments: Mapping[str, str], terminal: Terminal) -> str:
    """
    Format the lines that are shown once the robot has started.

    Parameters
    ----------
    url
        The address of the page; '' without a page.
    arguments
        The launch arguments by name. `planner` and what else the full system starts decide what
        the robot can be told, and `qr_code` whether a QR code of the address is shown, if other
        machines can reach it.
    terminal
        Where they are shown.

    """
    asked = arguments.get('qr_code', 'auto')
    wants_code = asked == 'true' or (asked == 'auto' and terminal.has_colors)
    code = qr_code(url, terminal) if wants_code and is_shared(url) else ''
    box = start_box(url, _example(arguments), bool(code), terminal)
    return '\n'.join(['', box, *filter(None, [code])])


def _example(arguments: Mapping[str, str]) -> str:
    """Return what the robot can be told to do; '' without a planner."""
    if arguments.get('planner') != 'true':
        return ''
    can_bring = all(arguments.get(name) == 'true' for name in _NEEDED_TO_BRING)
    return BRING if can_bring and arguments.get('scene') == 'apartment' else TURN


def watch_robot(argument: str) -> OnProcessExit:
    """
    Build the event handler that reports the exit of the robot's process.

    Parameters
    ----------
    argument
        The name of a launch argument; if its value is `shutdown`, the launch is shut down as well.

    """

    def react(event: ProcessExited, context: LaunchContext) -> Optional[list[Action]]:
        if context.is_shutdown:
            return None
        ends_all = LaunchConfiguration(argument).perform(context) == 'shutdown'
        sentence = exit_report(event.process_name, event.returncode, ends_all, argument)
        said = LogInfo(msg=sentence)
        return [said, Shutdown(reason=f'{event.process_name} has exited')] if ends_all else [said]

    return OnProcessExit(target_action=_is_robot, on_exit=react)


def exit_report(process: str, status: int, ends_all: bool, argument: str) -> str:
    """
    Format the exit report of the robot's process.

    Parameters
    ----------
    process, status
        Its name, and its exit status; negative for a signal.
    ends_all, argument
        Whether the launch is shut down, and the launch argument that decides that.

    """
    cause = f'was killed by signal {-status}' if status < 0 else f'has exited with status {status}'
    follows = (
        f"everything else shuts down, too. To keep it running, pass '{argument}:=stay'."
        if ends_all
        else 'the other nodes continue without it, until Ctrl-C.'
    )
    return f'The robot is gone: {process} {cause}, and {follows}'


def _is_robot(action: Action) -> bool:
    """Check whether an action is the robot's process."""
    return isinstance(action, Node) and action.node_executable in ROBOTS
