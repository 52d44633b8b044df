# SPDX-License-Identifier: Apache-2.0
"""Simulated time for many nodes of a process, from one subscription to /clock."""

from __future__ import annotations

from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.time_source import TimeSource

__all__ = ['SharedClock']


class SharedClock:
    """
    Shared clock: one subscription to /clock, which sets the clocks of all added nodes.

    Otherwise each node receives every message itself, which is most of the load of an idle node.

    Parameters
    ----------
    context
        The context of the nodes.

    """

    def __init__(self, context: Context) -> None:
        self._context = context
        self._node: Node | None = None

    def take(self, node: Node) -> Node | None:
        """
        Share the clock with a node that uses simulated time.

        Parameters
        ----------
        node
            The node; one that does not use simulated time is unchanged.

        Returns
        -------
        Node or None
            The node with the subscription, if it was just created; spin it with the others.

        """
        source: TimeSource = node._time_source
        if not source.ros_time_is_active:
            return None
        made = None
        if self._node is None:
            made = self._node = Node(
                'clock_listener',
                namespace=node.get_namespace(),
                context=self._context,
                use_global_arguments=False,
                enable_rosout=False,
                start_parameter_services=False,
                parameter_overrides=[Parameter('use_sim_time', value=True)],
            )
        source.detach_node()
        shared: TimeSource = self._node._time_source
        for clock in source._associated_clocks:
            clock.set_ros_time_override(shared._last_time_set)
            clock._set_ros_time_is_active(True)
        # A new set: another thread may be iterating over the old one.
        shared._associated_clocks = shared._associated_clocks | source._associated_clocks
        return made

    def release(self, node: Node) -> None:
        """
        Remove the clocks of a node that is destroyed.

        Parameters
        ----------
        node
            A node that was passed to `take`.

        """
        if self._node is not None:
            shared: TimeSource = self._node._time_source
            ended = node._time_source._associated_clocks
            shared._associated_clocks = shared._associated_clocks - ended
