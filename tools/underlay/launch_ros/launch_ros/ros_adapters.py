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
    """Return what runs the launch's own node; it is made when it is first asked for."""
    adapter = find_ros_adapter(context)
    if adapter is None:
        if context.is_shutdown:
            raise RuntimeError('the launch is ending: its own ROS node is not there any more')
        adapter = _make_adapter(context)
    return adapter


def get_ros_node(context: LaunchContext) -> Any:
    """Return the launch's own node, an rclpy node whose callbacks run in a thread of their own."""
    return get_ros_adapter(context).ros_node


def find_ros_adapter(context: LaunchContext) -> Optional[ROSAdapter]:
    """Return what runs the launch's own node, None if nobody has asked for it by now."""
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
