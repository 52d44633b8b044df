# SPDX-License-Identifier: Apache-2.0
"""The actions of a launch description; those that begin and end a scope are here."""

from __future__ import annotations

from typing import TYPE_CHECKING

from launch.action import Action
from ros_environment.lazy import also_found_at, lazy_exports

if TYPE_CHECKING:
    from launch.actions.declare_launch_argument import DeclareLaunchArgument
    from launch.actions.environment_variables import (
        AppendEnvironmentVariable,
        SetEnvironmentVariable,
        UnsetEnvironmentVariable,
    )
    from launch.actions.event_actions import (
        EmitEvent,
        RegisterEventHandler,
        Shutdown,
        UnregisterEventHandler,
    )
    from launch.actions.execute_local import ExecuteLocal
    from launch.actions.execute_process import ExecuteProcess
    from launch.actions.group_action import GroupAction
    from launch.actions.include_launch_description import IncludeLaunchDescription
    from launch.actions.launch_configurations import (
        ResetLaunchConfigurations,
        SetLaunchConfiguration,
        UnsetLaunchConfiguration,
    )
    from launch.actions.log_info import LogInfo
    from launch.actions.opaque_function import OpaqueCoroutine, OpaqueFunction
    from launch.actions.timer_action import TimerAction
    from launch.launch_context import LaunchContext

__all__ = [
    'AppendEnvironmentVariable',
    'DeclareLaunchArgument',
    'EmitEvent',
    'ExecuteLocal',
    'ExecuteProcess',
    'GroupAction',
    'IncludeLaunchDescription',
    'LogInfo',
    'OpaqueCoroutine',
    'OpaqueFunction',
    'PopEnvironment',
    'PopLaunchConfigurations',
    'PushEnvironment',
    'PushLaunchConfigurations',
    'RegisterEventHandler',
    'ResetEnvironment',
    'ResetLaunchConfigurations',
    'SetEnvironmentVariable',
    'SetLaunchConfiguration',
    'Shutdown',
    'TimerAction',
    'UnregisterEventHandler',
    'UnsetEnvironmentVariable',
    'UnsetLaunchConfiguration',
]


class PushLaunchConfigurations(Action):
    """Keeps the launch configurations until PopLaunchConfigurations restores them."""

    def execute(self, context: LaunchContext) -> None:
        """
        Save a copy of the launch configurations.

        Parameters
        ----------
        context
            The launch context.

        """
        context.launch_configurations.push_scope()


class PopLaunchConfigurations(Action):
    """Restores the launch configurations that PushLaunchConfigurations kept."""

    def execute(self, context: LaunchContext) -> None:
        """
        Restore the launch configurations of the last `PushLaunchConfigurations`.

        Parameters
        ----------
        context
            The launch context.

        Raises
        ------
        RuntimeError
            Nothing has been pushed.

        """
        context.launch_configurations.pop_scope()


class PushEnvironment(Action):
    """Keeps the environment until PopEnvironment restores it."""

    def execute(self, context: LaunchContext) -> None:
        """
        Save a copy of the environment.

        Parameters
        ----------
        context
            The launch context.

        """
        context.run.environment.push()


class PopEnvironment(Action):
    """Restores the environment that PushEnvironment kept."""

    def execute(self, context: LaunchContext) -> None:
        """
        Restore the environment of the last `PushEnvironment`.

        Parameters
        ----------
        context
            The launch context.

        Raises
        ------
        RuntimeError
            Nothing has been pushed.

        """
        context.run.environment.pop()


class ResetEnvironment(Action):
    """Restores the environment that the launch was started with."""

    def execute(self, context: LaunchContext) -> None:
        """
        Restore the environment that the launch was started with.

        Parameters
        ----------
        context
            The launch context.

        """
        context.run.environment.reset()


# ROS 2 Jazzy has a module for each of them; launch files import from those, too.
also_found_at(
    __name__,
    'append_environment_variable',
    'emit_event',
    'opaque_coroutine',
    'pop_environment',
    'pop_launch_configurations',
    'push_environment',
    'push_launch_configurations',
    'register_event_handler',
    'reset_environment',
    'reset_launch_configurations',
    'set_environment_variable',
    'set_launch_configuration',
    'shutdown_action',
    'unregister_event_handler',
    'unset_environment_variable',
    'unset_launch_configuration',
)

_ELSEWHERE = {
    'AppendEnvironmentVariable': 'environment_variables',
    'EmitEvent': 'event_actions',
    'OpaqueCoroutine': 'opaque_function',
    'RegisterEventHandler': 'event_actions',
    'ResetLaunchConfigurations': 'launch_configurations',
    'SetEnvironmentVariable': 'environment_variables',
    'SetLaunchConfiguration': 'launch_configurations',
    'Shutdown': 'event_actions',
    'UnregisterEventHandler': 'event_actions',
    'UnsetEnvironmentVariable': 'environment_variables',
    'UnsetLaunchConfiguration': 'launch_configurations',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
