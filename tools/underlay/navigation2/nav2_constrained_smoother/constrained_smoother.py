# SPDX-License-Identifier: Apache-2.0
"""The smoother `nav2_constrained_smoother::ConstrainedSmoother`, without an optimizer."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_costmap_2d.grid import Costmap2D
from nav2_planner.path_shape import smoothed
from nav2_smoother.path_smoothing import smooth_path
from nav2_smoother.smoothers import Smoother
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter
import numpy as np
import numpy.typing as npt

__all__ = ['ConstrainedSmoother']

FloatArray = npt.NDArray[np.float64]

_NO_OPTIMIZER = 'the path is smoothed by solving linear equations, not by an optimizer'


@dataclass(frozen=True)
class ConstrainedSmootherParameters:
    """The supported parameters of the smoother."""

    reversing_enabled: bool = parameter(True, 'Whether points where the path reverses stay.')
    keep_start_orientation: bool = parameter(True, 'Whether the first pose keeps its yaw.')
    keep_goal_orientation: bool = parameter(True, 'Whether the last pose keeps its yaw.')
    minimum_turning_radius: float = parameter(
        0.4, 'The radius in m with which corners are rounded, roughly.', low=0.0
    )


class ConstrainedSmoother(Smoother):
    """
    Smoother that rounds corners to about the turning radius, and avoids obstacles.

    Genuine Nav2 minimizes length, curvature and cost with the solver Ceres. Here straightness is
    balanced against the deviation from the path, which takes a millisecond; the weights of the
    optimizer have no effect.

    Parameters
    ----------
    node, name
        As for `Smoother`.

    """

    def __init__(self, node: LifecycleNode, name: str) -> None:
        super().__init__(node, name)
        self._parameters = node.parameters.declare(ConstrainedSmootherParameters, prefix=name)
        ignored = [
            'path_downsampling_factor',
            'path_upsampling_factor',
            'w_curve',
            'w_dist',
            'w_smooth',
            'w_cost',
            'w_cost_cusp_multiplier',
            'cusp_zone_length',
            'cost_check_points',
            'optimizer.max_iterations',
            'optimizer.debug_optimizer',
            'optimizer.linear_solver_type',
            'optimizer.param_tol',
            'optimizer.fn_tol',
            'optimizer.gradient_tol',
        ]
        node.parameters.declare_unsupported(dict.fromkeys(ignored, _NO_OPTIMIZER), prefix=name)
        node.get_logger().warning(
            f"'{name}' is a nav2_constrained_smoother::ConstrainedSmoother: {_NO_OPTIMIZER}. "
            'Corners are rounded with about minimum_turning_radius.'
        )

    def smooth(self, poses: FloatArray, costmap: Costmap2D | None) -> FloatArray:
        """
        Smooth a path.

        Parameters
        ----------
        poses, costmap
            As for `Smoother.smooth`.

        Returns
        -------
        numpy.ndarray
            As many poses (N, 3): x, y (m) and yaw (rad) in the frame of the path.

        """
        values = self._parameters.current

        def work(points: FloatArray) -> FloatArray:
            lengths = np.hypot(*np.diff(points, axis=0).T)
            spacing = max(float(lengths.mean()), 1e-6)
            reach = values.minimum_turning_radius / spacing
            for _ in range(2):
                points = smoothed(points, reach**2, 1.0)
            return points

        result = smooth_path(poses, work, costmap, enforce_path_inversion=values.reversing_enabled)
        if values.keep_start_orientation and len(poses):
            result[0, 2] = poses[0, 2]
        if not values.keep_goal_orientation and len(poses) > 1:
            result[-1, 2] = result[-2, 2]
        return result
