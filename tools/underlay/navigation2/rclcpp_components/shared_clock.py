# SPDX-License-Identifier: Apache-2.0
"""Simulated time for many nodes of a process, from one subscription to /clock."""

from __future__ import annotations

from rclpy.clock import ROSClock
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.time_source import TimeSource

__all__ = ['SharedClock']


class _SharedSource(TimeSource):
    """Time source whose clocks change while another thread sets them: in a new set each time."""

    _associated_clocks: set[ROSClock]

    def attach_clock(self, clock: ROSClock) -> None:
        """
        Set a clock from now on.

        Parameters
        ----------
        clock
            The clock.

        """
        clock.set_ros_time_override(self._last_time_set)
        clock._set_ros_time_is_active(True)
        self._associated_clocks = self._associated_clocks | {clock}

    def detach_clock(self, clock: ROSClock) -> None:
        """
        Set a clock no longer.

        Parameters
        ----------
        clock
            The clock; nothing happens if it was not attached.

        """
        self._associated_clocks = self._associated_clocks - {clock}


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
        self._listener: Node | None = None
        self._source = _SharedSource()

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
        if not _source_of(node).ros_time_is_active:
            return None
        made = None
        if self._listener is None:
            made = self._listener = Node(
                'clock_listener',
                namespace=node.get_namespace(),
                context=self._context,
                use_global_arguments=False,
                enable_rosout=False,
                start_parameter_services=False,
                parameter_overrides=[Parameter('use_sim_time', value=True)],
            )
            self._share_with(made)
            self._source.attach_node(made)
        self._share_with(node)
        return made

    def release(self, node: Node) -> None:
        """
        Remove the clocks of a node that is destroyed.

        Parameters
        ----------
        node
            A node that was passed to `take`.

        """
        self._source.detach_clock(node.get_clock())

    def _share_with(self, node: Node) -> None:
        """Set the clock of a node from the shared source instead of its own."""
        _source_of(node).detach_node()
        self._source.attach_clock(node.get_clock())


def _source_of(node: Node) -> TimeSource:
    """Return what sets the clock of a node; rclpy has no public name for it."""
    source: TimeSource = node._time_source
    return source
