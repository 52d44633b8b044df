# SPDX-License-Identifier: Apache-2.0
"""The actions of a launch description."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .._lazy import lazy_exports

if TYPE_CHECKING:
    from .append_environment_variable import (
        AppendEnvironmentVariable as AppendEnvironmentVariable,
    )
    from .declare_launch_argument import DeclareLaunchArgument as DeclareLaunchArgument
    from .emit_event import EmitEvent as EmitEvent
    from .execute_local import ExecuteLocal as ExecuteLocal
    from .execute_process import ExecuteProcess as ExecuteProcess
    from .group_action import GroupAction as GroupAction
    from .include_launch_description import IncludeLaunchDescription as IncludeLaunchDescription
    from .log_info import LogInfo as LogInfo
    from .opaque_coroutine import OpaqueCoroutine as OpaqueCoroutine
    from .opaque_function import OpaqueFunction as OpaqueFunction
    from .pop_environment import PopEnvironment as PopEnvironment
    from .pop_launch_configurations import PopLaunchConfigurations as PopLaunchConfigurations
    from .push_environment import PushEnvironment as PushEnvironment
    from .push_launch_configurations import PushLaunchConfigurations as PushLaunchConfigurations
    from .register_event_handler import RegisterEventHandler as RegisterEventHandler
    from .reset_environment import ResetEnvironment as ResetEnvironment
    from .reset_launch_configurations import (
        ResetLaunchConfigurations as ResetLaunchConfigurations,
    )
    from .set_environment_variable import SetEnvironmentVariable as SetEnvironmentVariable
    from .set_launch_configuration import SetLaunchConfiguration as SetLaunchConfiguration
    from .shutdown_action import Shutdown as Shutdown
    from .timer_action import TimerAction as TimerAction
    from .unregister_event_handler import UnregisterEventHandler as UnregisterEventHandler
    from .unset_environment_variable import UnsetEnvironmentVariable as UnsetEnvironmentVariable
    from .unset_launch_configuration import UnsetLaunchConfiguration as UnsetLaunchConfiguration

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

_ELSEWHERE = {
    'Shutdown': 'shutdown_action',
}

__getattr__, __dir__ = lazy_exports(__name__, __all__, _ELSEWHERE)
