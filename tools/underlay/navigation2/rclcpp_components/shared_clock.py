# SPDX-License-Identifier: Apache-2.0
"""Simulated time for many nodes of a process from one subscription to /clock."""

from __future__ import annotations

from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.time_source import TimeSource

__all__ = ['SharedClock']


class SharedClock:
    """
    Takes the time from /clock once, and sets the clocks of all nodes that were given to it.

    Otherwise each node takes every message itself, which is most of what an idle node costs.

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
        Let a node that uses simulated time share the clock.

        Parameters
        ----------
        node
            The node; one that does not use simulated time stays as it is.

        Returns
        -------
        Node or None
            The node that listens, if it was made now; whoever runs nodes runs it, too.

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
        # A new set: the other may be gone through in another thread.
        shared._associated_clocks = shared._associated_clocks | source._associated_clocks
        return made

    def release(self, node: Node) -> None:
        """
        Forget the clocks of a node that is destroyed.

        Parameters
        ----------
        node
            A node that `take` was given.

        """
        if self._node is not None:
            shared: TimeSource = self._node._time_source
            ended = node._time_source._associated_clocks
            shared._associated_clocks = shared._associated_clocks - ended
