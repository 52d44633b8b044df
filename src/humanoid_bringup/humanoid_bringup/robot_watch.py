# SPDX-License-Identifier: Apache-2.0
"""Report the exit of the robot's process: the simulator or the mock robot."""

from __future__ import annotations

from typing import Optional

from launch import Action, LaunchContext
from launch.actions import LogInfo, Shutdown
from launch.event_handlers import OnProcessExit
from launch.events.process import ProcessExited
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node

ROBOTS = ('simulator', 'mock_robot')
"""The executables that act as the robot for all other nodes."""


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
