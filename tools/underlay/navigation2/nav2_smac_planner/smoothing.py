# SPDX-License-Identifier: Apache-2.0
"""Shared by the Smac planners: the smoother's parameters, and the unsmoothed plan."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_planner.path_shape import headings, Rounding
from nav2_planner.route import Route
from nav2_util.geometry import make_path
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter
from nav_msgs.msg import Path
import numpy as np

__all__ = ['SmootherParameters', 'Smoothing', 'UnsmoothedPlan']


@dataclass(frozen=True)
class SmootherParameters:
    """The parameters of the smoother in the Smac planners."""

    max_iterations: int = parameter(
        1000, 'The smooth path is computed at once; 0 leaves the path as it was.', low=0
    )
    w_smooth: float = parameter(0.3, 'The weight of straightness.', low=0.0)
    w_data: float = parameter(0.2, 'The weight of nearness to the path planned.', low=0.0)
    tolerance: float = parameter(
        1e-10, 'The smooth path is exact to the precision of numbers.', low=0.0
    )
    do_refinement: bool = parameter(True, 'Whether to smooth the smooth path again.')
    refinement_num: int = parameter(2, 'How often to smooth it again.', low=0)


class Smoothing:
    """
    Path smoothing as configured by the parameters.

    Parameters
    ----------
    node
        The planner server.
    name
        The name of the planner.

    """

    def __init__(self, node: LifecycleNode, name: str) -> None:
        self._parameters = node.parameters.declare(SmootherParameters, prefix=f'{name}.smoother')

    @property
    def rounding(self) -> Rounding | None:
        """The current parameters of corner rounding."""
        values = self._parameters.current
        if not values.max_iterations:
            return None
        again = values.refinement_num if values.do_refinement else 0
        return Rounding(values.w_smooth, values.w_data, 1 + again)


class UnsmoothedPlan:
    """
    Publisher of the unsmoothed path on `unsmoothed_plan`, if it has subscribers.

    Parameters
    ----------
    node
        The planner server.

    """

    def __init__(self, node: LifecycleNode) -> None:
        self._node = node
        self._publisher = node.create_lifecycle_publisher(Path, 'unsmoothed_plan', 1)

    def publish(self, route: Route, frame: str) -> None:
        """
        Publish the corners of a path.

        Parameters
        ----------
        route
            The straight lines that were planned.
        frame
            The frame of the costmap.

        """
        if not self._publisher.get_subscription_count():
            return
        places = route.to_world(route.corners)
        poses = np.column_stack([places, headings(places)])
        self._publisher.publish(make_path(poses, frame, self._node.get_clock().now().to_msg()))
