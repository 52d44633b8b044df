# SPDX-License-Identifier: Apache-2.0
"""The smoother `nav2_constrained_smoother::ConstrainedSmoother`."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_constrained_smoother.optimization import CostField, minimize, Objective, Termination
from nav2_costmap_2d.grid import Costmap2D
from nav2_planner.path_shape import headings
from nav2_smoother.path_smoothing import keep_off_obstacles, segments
from nav2_smoother.smoothers import Smoother
from nav2_util.errors import ConfigurationError
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter, Unsupported
import numpy as np
import numpy.typing as npt
from scipy.interpolate import CubicHermiteSpline

__all__ = ['ConstrainedSmoother']

FloatArray = npt.NDArray[np.float64]

_SPARSE = 'the normal equations are sparse, and solved by their LU decomposition'


@dataclass(frozen=True)
class ConstrainedSmootherParameters:
    """The parameters of the smoother."""

    reversing_enabled: bool = parameter(True, 'Whether points where the path reverses stay.')
    path_downsampling_factor: int = parameter(
        1, 'Every how many poses one is moved by the optimizer.', low=1
    )
    path_upsampling_factor: int = parameter(
        1,
        'Into how many parts the way between poses of the original path is divided; 0: the path '
        'stays downsampled.',
        low=0,
    )
    keep_start_orientation: bool = parameter(True, 'Whether the first pose keeps its yaw.')
    keep_goal_orientation: bool = parameter(True, 'Whether the last pose keeps its yaw.')
    minimum_turning_radius: float = parameter(
        0.4, 'The radius in m that bends should not be tighter than; 0: no limit.', low=0.0
    )
    w_curve: float = parameter(
        30.0, 'The weight of the curvature beyond that of minimum_turning_radius.', low=0.0
    )
    w_dist: float = parameter(0.0, 'The weight of nearness to the original path.', low=0.0)
    w_smooth: float = parameter(2e6, 'The weight of smoothness.', low=0.0)
    w_cost: float = parameter(0.015, 'The weight of the costs of the costmap.', low=0.0)
    w_cost_cusp_multiplier: float = parameter(
        3.0, 'The factor of w_cost where the path reverses.', low=0.0
    )
    cusp_zone_length: float = parameter(
        2.5,
        'The length in m of the stretch around a reversal in which w_cost rises to its multiple.',
        low=0.0,
    )
    cost_check_points: list[float] = parameter(
        [],
        'Where on the robot costs are looked up: x and y in m in its frame, and a weight, for '
        'each point; empty: at the pose.',
    )
    max_iterations: int = parameter(
        100, 'The maximum number of iterations.', low=1, name='optimizer.max_iterations'
    )
    debug_optimizer: bool = parameter(
        False, 'Whether each optimization is logged.', name='optimizer.debug_optimizer'
    )
    fn_tol: float = parameter(
        1e-7,
        'The relative decrease of the objective at which the optimizer ends.',
        low=0.0,
        name='optimizer.fn_tol',
    )
    gradient_tol: float = parameter(
        1e-10,
        'The component of the gradient at which the optimizer ends.',
        low=0.0,
        name='optimizer.gradient_tol',
    )
    param_tol: float = parameter(
        1e-15,
        'The relative length of a step at which the optimizer ends.',
        low=0.0,
        name='optimizer.param_tol',
    )


class ConstrainedSmoother(Smoother):
    """
    Smoother that optimizes smoothness, curvature and costs together.

    Parameters
    ----------
    node, name
        As for `Smoother`.

    Raises
    ------
    ConfigurationError
        `cost_check_points` is not a list of points with weights.

    """

    def __init__(self, node: LifecycleNode, name: str) -> None:
        super().__init__(node, name)
        self._parameters = node.parameters.declare(ConstrainedSmootherParameters, prefix=name)
        self._parameters.on_change = self._check
        try:
            self._check(self._parameters.current)
        except ValueError as error:
            raise ConfigurationError(str(error)) from error
        node.parameters.declare_unsupported(
            {
                'optimizer.linear_solver_type': Unsupported(
                    _SPARSE, ('SPARSE_NORMAL_CHOLESKY', 'DENSE_QR')
                )
            },
            prefix=name,
        )

    def _check(self, values: ConstrainedSmootherParameters) -> None:
        """Raise ValueError for points that cannot be used."""
        checked, name = values.cost_check_points, f'{self.name}.cost_check_points'
        if len(checked) % 3:
            raise ValueError(
                f"The parameter '{name}' must have x, y and a weight for each point, but has "
                f'{len(checked)} numbers.'
            )
        if any(weight < 0.0 for weight in checked[2::3]):
            raise ValueError(f"The parameter '{name}' must not have negative weights.")

    def smooth(self, poses: FloatArray, costmap: Costmap2D | None) -> FloatArray:
        """
        Smooth a path, each stretch between cusps for itself.

        Parameters
        ----------
        poses, costmap
            As for `Smoother.smooth`.

        Returns
        -------
        numpy.ndarray
            Poses (M, 3): x, y (m) and yaw (rad) in the frame of the path. There are as many as
            given only if `path_upsampling_factor` is 1.

        """
        values = self._parameters.current
        if len(poses) < 3:
            return np.array(poses, float)
        costs = None if costmap is None or not costmap.cells.size else CostField(costmap)
        pieces: list[FloatArray] = []
        stretches = segments(poses) if values.reversing_enabled else [(0, len(poses))]
        for begin, end in stretches:
            cusps = (begin > 0, end < len(poses))
            piece = self._smooth_stretch(poses[begin:end], cusps, costmap, costs)
            pieces.append(piece if end == len(poses) else piece[:-1])
        result = np.concatenate(pieces)
        if values.keep_start_orientation:
            result[0, 2] = poses[0, 2]
        if values.keep_goal_orientation:
            result[-1, 2] = poses[-1, 2]
        result[:, 2] = np.arctan2(np.sin(result[:, 2]), np.cos(result[:, 2]))
        return result

    def _smooth_stretch(
        self,
        poses: FloatArray,
        cusps: tuple[bool, bool],
        costmap: Costmap2D | None,
        costs: CostField | None,
    ) -> FloatArray:
        """Smooth what is driven in one direction; `cusps` tells at which ends it changes."""
        values = self._parameters.current
        kept = np.arange(0, len(poses), values.path_downsampling_factor)
        kept = np.unique(np.append(kept, len(poses) - 1))
        points = poses[kept, :2]
        if len(points) < 3:
            return np.array(poses, float)
        apart = np.diff(poses[:, :2], axis=0)
        facing = np.cos(poses[:-1, 2]) * apart[:, 0] + np.sin(poses[:-1, 2]) * apart[:, 1]
        is_reversed = np.count_nonzero(facing < 0.0) > len(facing) / 2

        held = np.zeros(len(points), bool)
        # A point beside the end holds the direction of the path there.
        held[1] = not cusps[0] and values.keep_start_orientation and len(points) > 3
        held[-2] = not cusps[1] and values.keep_goal_orientation and len(points) > 4
        radius = values.minimum_turning_radius
        checked = values.cost_check_points or [0.0, 0.0, 1.0]
        objective = Objective(
            values.w_smooth,
            values.w_curve,
            values.w_dist,
            self._cost_weights(points, cusps),
            1.0 / radius if radius > 0.0 else np.inf,
            np.array(checked, float).reshape(-1, 3),
            bool(is_reversed),
        )
        termination = Termination(
            values.max_iterations, values.fn_tol, values.gradient_tol, values.param_tol
        )
        found = minimize(points, held, objective, costs, termination)
        if values.debug_optimizer:
            self.node.get_logger().info(
                f"'{self.name}' has moved {len(points)} points in {found.iterations} iterations: "
                f'the objective was {found.initial:.6g} and is {found.final:.6g}.'
            )
        moved = keep_off_obstacles(points, found.points, costmap)
        moved = _interpolated(moved, kept, values.path_upsampling_factor)
        yaws = headings(moved) + (np.pi if is_reversed else 0.0)
        return np.column_stack([moved, yaws])

    def _cost_weights(self, points: FloatArray, cusps: tuple[bool, bool]) -> FloatArray:
        """Compute the (N,) weights of costs, which rise towards cusps."""
        values = self._parameters.current
        way = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))])
        distance = np.full(len(points), np.inf)
        for is_cusp, from_end in zip(cusps, (way, way[-1] - way)):
            if is_cusp:
                distance = np.minimum(distance, from_end)
        half = max(0.5 * values.cusp_zone_length, 1e-9)
        nearness = np.clip(1.0 - distance / half, 0.0, 1.0)
        return values.w_cost * (1.0 + (values.w_cost_cusp_multiplier - 1.0) * nearness)


def _interpolated(points: FloatArray, kept: npt.NDArray[np.intp], factor: int) -> FloatArray:
    """
    Put points between those that were kept of a path, on cubic curves.

    Parameters
    ----------
    points
        (K, 2) x and y in m.
    kept
        (K,) their indices in the original path.
    factor
        Into how many parts the way between original points is divided; 0: none is added.

    """
    if factor == 0 or (factor == 1 and np.all(np.diff(kept) == 1)):
        return points
    slopes = np.gradient(points, kept.astype(float), axis=0)
    curve = CubicHermiteSpline(kept.astype(float), points, slopes)
    places = np.linspace(0.0, float(kept[-1]), int(kept[-1]) * factor + 1)
    return np.asarray(curve(places))
