# SPDX-License-Identifier: Apache-2.0
"""The layer for sonars and infrared sensors, which measure in a cone instead of along a ray."""

from __future__ import annotations

from dataclasses import dataclass
import math
from typing import TYPE_CHECKING

from nav2_costmap_2d.costs import FREE_SPACE, LETHAL_OBSTACLE, NO_INFORMATION
from nav2_costmap_2d.grid import CellArray, Costmap2D, shift_cells
from nav2_costmap_2d.layers import Layer
from nav2_costmap_2d.regions import Region, write_maximum
from nav2_costmap_2d.sensor_messages import rotation_of
from nav2_util.geometry import Pose2D
from nav2_util.parameters import parameter, Unsupported
from nav2_util.timing import now_s
import numpy as np
import numpy.typing as npt
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import Range
from tf2_ros import TransformException

if TYPE_CHECKING:
    from nav2_costmap_2d.costmap_node import Costmap2DROS

__all__ = ['RangeParameters', 'RangeSensorLayer', 'cone_probabilities']

_UNKNOWN = 0.5
_CERTAINTY = 0.45
_KEPT_MESSAGES = 20
_QUIET_S = 5.0


@dataclass(frozen=True)
class RangeParameters:
    """The parameters of `nav2_costmap_2d::RangeSensorLayer`."""

    enabled: bool = parameter(True, 'Whether the layer takes part.')
    topics: list[str] = parameter([''], 'The topics of the sensors.')
    inflate_cone: float = parameter(
        1.0, 'The part of the cone that counts, around its axis.', low=0.0, high=1.0
    )
    no_readings_timeout: float = parameter(
        0.0, 'After how many s without a message the costmap is not current; never at 0.', low=0.0
    )
    clear_threshold: float = parameter(
        0.2, 'Cells are free below this probability.', low=0.0, high=1.0
    )
    mark_threshold: float = parameter(
        0.8, 'Cells are obstacles above this probability.', low=0.0, high=1.0
    )
    clear_on_max_reading: bool = parameter(
        False, 'Whether the cone is free when the range is the highest.'
    )
    input_sensor_type: str = parameter(
        'ALL',
        'Whether sensors tell distances (VARIABLE), or only that something is near (FIXED).',
        choices=('ALL', 'VARIABLE', 'FIXED'),
    )


def cone_probabilities(
    grid: Costmap2D, sensor: Pose2D, range_m: float, half_angle_rad: float, is_hit: bool
) -> npt.NDArray[np.float64]:
    """
    Compute the obstacle probabilities given one sensor reading.

    Cells closer than the range are free, those at it occupied, the rest undecided; the certainty
    decreases from the axis of the cone to its edge.

    Parameters
    ----------
    grid
        The grid, for its size and origin.
    sensor
        The pose of the sensor, x along the axis of the cone.
    range_m
        The measured range.
    half_angle_rad
        The angle from the axis to the edge.
    is_hit
        Whether there is an obstacle at `range_m`; otherwise the cone is free up to it.

    Returns
    -------
    Probabilities of the shape of the grid.

    """
    x = grid.origin_x + (np.arange(grid.size_x) + 0.5) * grid.resolution - sensor.x
    y = (grid.origin_y + (np.arange(grid.size_y) + 0.5) * grid.resolution - sensor.y)[:, None]
    cos, sin = math.cos(sensor.yaw), math.sin(sensor.yaw)
    angles = np.abs(np.arctan2(-sin * x + cos * y, cos * x + sin * y))
    distances = np.hypot(x, y)
    certainty = _CERTAINTY * np.clip(1.0 - (angles / max(half_angle_rad, 1e-6)) ** 2, 0.0, 1.0)
    is_before = distances < range_m - grid.resolution
    is_at = ~is_before & (distances <= range_m + grid.resolution) & is_hit
    return _UNKNOWN + np.where(is_at, certainty, np.where(is_before, -certainty, 0.0))


class RangeSensorLayer(Layer):
    """
    Layer with an obstacle probability for each cell, updated by Bayes' rule.

    Parameters
    ----------
    node
        The costmap's node.
    name
        The name of the layer.

    """

    is_clearable = True

    def __init__(self, node: Costmap2DROS, name: str) -> None:
        super().__init__(name)
        self._node = node
        self._settings = node.parameters.declare(RangeParameters, name)
        self._settings.on_change = lambda _: node.touch()
        node.parameters.declare_unsupported(
            {
                'phi': Unsupported(
                    'the certainty falls with the square of the angle to the axis of the cone',
                    (1.2,),
                )
            },
            name,
        )
        self._grid = node.grid
        self._odds = np.zeros(self._grid.cells.shape)
        self._waiting: list[Range] = []
        self._last_s = now_s(node)
        for topic in self._settings.current.topics:
            if topic:
                node.create_subscription(
                    Range, node.resolve_beside(topic), self._take, qos_profile_sensor_data
                )

    @property
    def is_enabled(self) -> bool:
        """Whether the layer is enabled."""
        return self._settings.current.enabled

    @property
    def is_current(self) -> bool:
        """Whether messages arrive at the expected rate."""
        limit_s = self._settings.current.no_readings_timeout
        return limit_s <= 0.0 or now_s(self._node) - self._last_s <= limit_s

    def match(self, grid: Costmap2D) -> None:
        """
        Shift the probabilities with the costmap; a costmap of another size starts undecided.

        Parameters
        ----------
        grid
            As for `Layer.match`.

        """
        old, self._grid = self._grid, grid.with_cells(np.zeros_like(grid.cells))
        odds = np.zeros(grid.cells.shape)
        if old.cells.shape == grid.cells.shape and old.resolution == grid.resolution:
            dx = round((grid.origin_x - old.origin_x) / grid.resolution)
            dy = round((grid.origin_y - old.origin_y) / grid.resolution)
            odds = shift_cells(self._odds, dx, dy, 0.0)
        self._odds = odds

    def clear(self, region: Region | None, *, is_inverted: bool = False) -> None:
        """
        Reset probabilities to undecided.

        Parameters
        ----------
        region, is_inverted
            As for `Layer.clear`.

        """
        kept = Region.whole(self._grid) if region is None else region.clipped(self._grid)
        left = None if kept is None else self._odds[kept.slices].copy()
        if is_inverted:
            self._odds[...] = 0.0
        if kept is not None:
            self._odds[kept.slices] = left if is_inverted else 0.0

    def update(self, grid: Costmap2D, robot: Pose2D | None) -> Region | None:
        """
        Update the probabilities with the newest messages.

        Parameters
        ----------
        grid, robot
            As for `Layer.update`; neither is used.

        Returns
        -------
        Region or None
            The cells whose probability has changed; None if there are none.

        """
        region: Region | None = None
        waiting, self._waiting = self._waiting, []
        for message in waiting:
            found = self._observe(message)
            region = region if found is None else found.union(region)
        return region

    def apply(self, grid: Costmap2D, region: Region) -> None:
        """
        Raise the costs where cells are probably free or occupied, in place.

        Parameters
        ----------
        grid, region
            As for `Layer.apply`.

        """
        values = self._settings.current
        probabilities = 1.0 / (1.0 + np.exp(-self._odds[region.slices]))
        costs: CellArray = np.full(probabilities.shape, NO_INFORMATION, np.uint8)
        costs[probabilities < values.clear_threshold] = FREE_SPACE
        costs[probabilities > values.mark_threshold] = LETHAL_OBSTACLE
        write_maximum(grid.cells[region.slices], costs)

    def costs(self, grid: Costmap2D) -> Costmap2D:
        """
        Return the costs where probabilities are decided; the rest is NO_INFORMATION.

        Parameters
        ----------
        grid
            As for `Layer.costs`.

        """
        found = grid.with_cells(np.full_like(grid.cells, NO_INFORMATION))
        self.apply(found, Region.whole(found))
        return found

    def _take(self, message: Range) -> None:
        self._last_s = now_s(self._node)
        del self._waiting[: max(len(self._waiting) + 1 - _KEPT_MESSAGES, 0)]
        self._waiting.append(message)

    def _observe(self, message: Range) -> Region | None:
        """Process a message; return the region that it changes."""
        reading = self._reading(message)
        if reading is None:
            return None
        range_m, is_hit = reading
        try:
            transform = self._node.transforms.buffer.lookup_transform(
                self._node.global_frame,
                message.header.frame_id,
                Time.from_msg(message.header.stamp),
            ).transform
        except TransformException as error:
            self._node.get_logger().warning(
                f"Layer '{self.name}': ignored a message: {error}",
                throttle_duration_sec=_QUIET_S,
            )
            return None
        axis = rotation_of(transform)[:, 0]
        sensor = Pose2D(
            transform.translation.x, transform.translation.y, math.atan2(axis[1], axis[0])
        )
        half_angle = 0.5 * message.field_of_view * self._settings.current.inflate_cone
        found = cone_probabilities(self._grid, sensor, range_m, half_angle, is_hit)
        change = np.log(found / (1.0 - found))
        self._odds = np.clip(self._odds + change, -6.0, 6.0)
        return Region.of_mask(change != 0.0)

    def _reading(self, message: Range) -> tuple[float, bool] | None:
        """Evaluate a reading: the range up to which the cone is free, and whether it is a hit."""
        values = self._settings.current
        is_fixed = message.min_range == message.max_range
        if values.input_sensor_type != 'ALL' and is_fixed != (values.input_sensor_type == 'FIXED'):
            return None
        if is_fixed:
            # By REP 117, -inf means too close to measure, and inf no detection.
            if math.isfinite(message.range):
                return None
            return message.max_range, message.range < 0.0
        if math.isinf(message.range) and message.range > 0.0:
            return (message.max_range, False) if values.clear_on_max_reading else None
        if not message.min_range <= message.range <= message.max_range:
            return None
        is_hit = message.range < message.max_range or not values.clear_on_max_reading
        return message.range, is_hit
