# SPDX-License-Identifier: Apache-2.0
"""The smoothers `nav2_smoother::SimpleSmoother` and `nav2_smoother::SavitzkyGolaySmoother`."""

from __future__ import annotations

from dataclasses import dataclass

from nav2_costmap_2d.grid import Costmap2D
from nav2_planner.path_shape import smoothed
from nav2_smoother.path_smoothing import savitzky_golay, smooth_path
from nav2_util.errors import ConfigurationError
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter
import numpy as np
import numpy.typing as npt

__all__ = ['SMOOTHERS', 'SavitzkyGolaySmoother', 'SimpleSmoother', 'Smoother']

FloatArray = npt.NDArray[np.float64]

SMOOTHERS = {
    'nav2_smoother::SimpleSmoother': 'nav2_smoother.smoothers:SimpleSmoother',
    'nav2_smoother::SavitzkyGolaySmoother': 'nav2_smoother.smoothers:SavitzkyGolaySmoother',
    'nav2_constrained_smoother::ConstrainedSmoother': (
        'nav2_constrained_smoother.constrained_smoother:ConstrainedSmoother'
    ),
}
"""The import paths of smoothers by their official names."""


class Smoother:
    """
    Base class of smoothers.

    Parameters
    ----------
    node
        The smoother server; parameters are declared with it.
    name
        The smoother's name, the prefix of its parameters.

    """

    def __init__(self, node: LifecycleNode, name: str) -> None:
        self.node, self.name = node, name

    def smooth(self, poses: FloatArray, costmap: Costmap2D | None) -> FloatArray:
        """
        Smooth a path.

        Parameters
        ----------
        poses
            (N, 3) x and y in m, yaw in rad.
        costmap
            The costmap in the frame of the path; None if unavailable.

        """
        raise NotImplementedError


@dataclass(frozen=True)
class SimpleSmootherParameters:
    """The parameters of the simple smoother."""

    tolerance: float = parameter(
        1e-10, 'The smooth path is exact to the precision of numbers.', low=0.0
    )
    max_its: int = parameter(
        1000, 'The smooth path is computed at once; 0 leaves the path as it was.', low=0
    )
    w_data: float = parameter(0.2, 'The weight of nearness to the path given.', low=0.0)
    w_smooth: float = parameter(0.3, 'The weight of straightness.', low=0.0)
    do_refinement: bool = parameter(True, 'Whether to smooth the smooth path again.')
    refinement_num: int = parameter(2, 'How often to smooth it again.', low=0)
    enforce_path_inversion: bool = parameter(
        True, 'Whether points where the path reverses, or turns on the spot, stay.'
    )


class SimpleSmoother(Smoother):
    """
    Smoother that balances straightness against the deviation from the original path.

    Parameters
    ----------
    node, name
        As for `Smoother`: the smoother server, and the smoother's name.

    """

    def __init__(self, node: LifecycleNode, name: str) -> None:
        super().__init__(node, name)
        self._parameters = node.parameters.declare(SimpleSmootherParameters, prefix=name)

    def smooth(self, poses: FloatArray, costmap: Costmap2D | None) -> FloatArray:
        """
        Smooth a path according to the weights.

        Parameters
        ----------
        poses
            (N, 3) x and y in m, yaw in rad.
        costmap
            The costmap in the frame of the path; None if unavailable.

        Returns
        -------
        FloatArray
            (N, 3) poses, kept off obstacles as in `smooth_path`.

        """
        values = self._parameters.current

        def work(points: FloatArray) -> FloatArray:
            if not values.max_its:
                return points
            for _ in range(1 + values.refinement_num * values.do_refinement):
                points = smoothed(points, values.w_smooth, values.w_data)
            return points

        return smooth_path(
            poses, work, costmap, enforce_path_inversion=values.enforce_path_inversion
        )


@dataclass(frozen=True)
class SavitzkyGolayParameters:
    """The parameters of the Savitzky-Golay smoother."""

    window_size: int = parameter(7, 'How many points are fitted, an odd number.', low=3, high=1001)
    poly_order: int = parameter(3, 'The order of the polynomial that is fitted.', low=1, high=20)
    do_refinement: bool = parameter(True, 'Whether to filter the filtered path again.')
    refinement_num: int = parameter(2, 'How often to filter it again.', low=0)
    enforce_path_inversion: bool = parameter(
        True, 'Whether points where the path reverses, or turns on the spot, stay.'
    )


class SavitzkyGolaySmoother(Smoother):
    """
    Smoother that applies a Savitzky-Golay filter.

    Parameters
    ----------
    node, name
        As for `Smoother`: the smoother server, and the smoother's name.

    Raises
    ------
    ConfigurationError
        `window_size` is even, or not more than `poly_order`.

    """

    def __init__(self, node: LifecycleNode, name: str) -> None:
        super().__init__(node, name)
        self._parameters = node.parameters.declare(SavitzkyGolayParameters, prefix=name)
        self._parameters.on_change = _check_window
        try:
            _check_window(self._parameters.current)
        except ValueError as error:
            raise ConfigurationError(f"The smoother '{name}' cannot be used: {error}") from error

    def smooth(self, poses: FloatArray, costmap: Costmap2D | None) -> FloatArray:
        """
        Smooth a path by a Savitzky-Golay filter.

        Parameters
        ----------
        poses
            (N, 3) x and y in m, yaw in rad.
        costmap
            The costmap in the frame of the path; None if unavailable.

        Returns
        -------
        FloatArray
            (N, 3) poses, kept off obstacles as in `smooth_path`.

        """
        values = self._parameters.current

        def work(points: FloatArray) -> FloatArray:
            for _ in range(1 + values.refinement_num * values.do_refinement):
                points = savitzky_golay(points, values.window_size, values.poly_order)
            return points

        return smooth_path(
            poses,
            work,
            costmap,
            enforce_path_inversion=values.enforce_path_inversion,
            shortest=values.window_size,
        )


def _check_window(values: SavitzkyGolayParameters) -> None:
    if values.window_size % 2 == 0 or values.poly_order >= values.window_size:
        raise ValueError(
            f'window_size must be odd and more than poly_order; they are {values.window_size} '
            f'and {values.poly_order}.'
        )
