# SPDX-License-Identifier: Apache-2.0
"""The launch's own ROS node."""

from __future__ import annotations

from typing import Any, Optional, TYPE_CHECKING

if TYPE_CHECKING:
    from launch.launch_context import LaunchContext
    from launch_ros._ros_adapter import ROSAdapter

__all__ = ['get_ros_adapter', 'get_ros_node']

_KEY = 'ros_adapter'


def get_ros_adapter(context: LaunchContext) -> ROSAdapter:
    """
    Return the adapter of the launch's own node; it is created on the first call.

    Parameters
    ----------
    context
        The launch context, which stores the adapter.

    Raises
    ------
    RuntimeError
        The launch is shutting down and the node has been destroyed.

    """
    adapter = find_ros_adapter(context)
    if adapter is None:
        if context.is_shutdown:
            raise RuntimeError('the launch is ending: its own ROS node no longer exists')
        adapter = _make_adapter(context)
    return adapter


def get_ros_node(context: LaunchContext) -> Any:
    """
    Return the launch's own rclpy node, which is spun by its own thread.

    Parameters
    ----------
    context
        As for `get_ros_adapter`, whose exceptions propagate.

    """
    return get_ros_adapter(context).ros_node


def find_ros_adapter(context: LaunchContext) -> Optional[ROSAdapter]:
    """
    Return the adapter of the launch's own node; None if it has not been created.

    An adapter that is shutting down is not returned.

    Parameters
    ----------
    context
        The context of the launch.

    """
    adapter: Optional[ROSAdapter] = context.get_locals_as_dict().get(_KEY)
    return adapter if adapter is not None and adapter.is_running else None


def _make_adapter(context: LaunchContext) -> ROSAdapter:
    from launch.event_handlers.on_shutdown import OnShutdown
    from launch_ros._ros_adapter import ROSAdapter

    use_sim_time = bool(context.get_locals_as_dict().get('launch_use_sim_time'))
    adapter = ROSAdapter(use_sim_time=use_sim_time, loop=context.asyncio_loop)
    context.extend_globals({_KEY: adapter})
    context.register_event_handler(
        OnShutdown(on_shutdown=lambda *_: adapter.end_within(context), handle_once=True)
    )
    return adapter
