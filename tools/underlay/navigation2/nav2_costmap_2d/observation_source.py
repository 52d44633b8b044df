# SPDX-License-Identifier: Apache-2.0
"""Sensor source of an obstacle layer; it buffers messages until their transform arrives."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from typing import Any, TYPE_CHECKING

from nav2_costmap_2d.raytracing import Observation
from nav2_costmap_2d.sensor_messages import cloud_points, observation_of, scan_points
from nav2_util.errors import ConfigurationError
from nav2_util.parameters import parameter, Unsupported
from nav2_util.timing import now_s
from rclpy.qos import qos_profile_sensor_data
from rclpy.time import Time
from sensor_msgs.msg import LaserScan, PointCloud2
from tf2_ros import TransformException

if TYPE_CHECKING:
    from nav2_costmap_2d.costmap_node import Costmap2DROS

__all__ = ['ObservationSource', 'SourceParameters']

_KEPT_MESSAGES = 10
_QUIET_S = 5.0


@dataclass(frozen=True)
class SourceParameters:
    """The parameters of an observation source."""

    topic: str = parameter('', 'The topic of the sensor; by default the name of the source.')
    sensor_frame: str = parameter(
        '', 'The frame from which rays start; by default that of the message.'
    )
    observation_persistence: float = parameter(
        0.0, 'For how long messages count, in s; at 0 only the newest.', low=0.0
    )
    expected_update_rate: float = parameter(
        0.0, 'After how many s without a message the costmap is not current; never at 0.', low=0.0
    )
    data_type: str = parameter(
        'LaserScan', 'The type of the messages.', choices=('LaserScan', 'PointCloud2')
    )
    min_obstacle_height: float = parameter(0.0, 'Lower points do not count, in m.')
    max_obstacle_height: float = parameter(0.0, 'Higher points do not count, in m.')
    inf_is_valid: bool = parameter(
        False, 'Whether infinite ranges of a LaserScan say that everything before is free.'
    )
    marking: bool = parameter(True, 'Whether its points are obstacles.')
    clearing: bool = parameter(False, 'Whether cells before its points are free.')
    obstacle_max_range: float = parameter(2.5, 'Up to which distance it marks, in m.')
    obstacle_min_range: float = parameter(0.0, 'From which distance it marks, in m.')
    raytrace_max_range: float = parameter(3.0, 'Up to which distance it clears, in m.')
    raytrace_min_range: float = parameter(0.0, 'From which distance it clears, in m.')


class ObservationSource:
    """
    Observation source: transforms the messages of a sensor to the frame of the costmap.

    Parameters
    ----------
    node
        The costmap's node.
    layer, name
        The names of the layer and of the source, which prefix its parameters.

    Raises
    ------
    ConfigurationError
        A parameter has an invalid value.

    """

    def __init__(self, node: Costmap2DROS, layer: str, name: str) -> None:
        self._node, self._name = node, name
        self._settings = node.parameters.declare(SourceParameters, f'{layer}.{name}')
        node.parameters.declare_unsupported(
            {'transport_type': Unsupported('point clouds are received as they are', ('raw',))},
            f'{layer}.{name}',
        )
        values = self._settings.current
        if values.min_obstacle_height > values.max_obstacle_height:
            raise ConfigurationError(
                f"The parameter '{layer}.{name}.min_obstacle_height' is more than "
                f"'max_obstacle_height': {values.min_obstacle_height:g} and "
                f'{values.max_obstacle_height:g} m.'
            )
        self._waiting: deque[Any] = deque(maxlen=_KEPT_MESSAGES)
        self._kept: deque[tuple[float, Observation]] = deque()
        self._last_s: float | None = None
        self._started_s = now_s(node)
        kinds = {'LaserScan': LaserScan, 'PointCloud2': PointCloud2}
        topic = node.resolve_beside(values.topic or name)
        node.create_subscription(
            kinds[values.data_type], topic, self._take, qos_profile_sensor_data
        )

    @property
    def settings(self) -> SourceParameters:
        """Return the current parameters."""
        return self._settings.current

    @property
    def is_current(self) -> bool:
        """Whether messages arrive at the expected rate."""
        limit_s = self.settings.expected_update_rate
        if limit_s <= 0.0:
            return True
        since_s = self._started_s if self._last_s is None else self._last_s
        age_s = now_s(self._node) - since_s
        if age_s > limit_s:
            self._node.get_logger().warning(
                f"The observation source '{self._name}' has sent nothing for {age_s:.2f} s; "
                f'at most {limit_s:g} s are expected.',
                throttle_duration_sec=_QUIET_S,
            )
        return age_s <= limit_s and self._last_s is not None

    def refresh(self) -> bool:
        """
        Transform the messages whose transforms are available.

        Returns
        -------
        Whether `observations` has changed.

        """
        before = len(self._kept)
        is_changed = bool(self._waiting) and self._transform_waiting()
        now = now_s(self._node)
        limit_s = now - self.settings.observation_persistence
        # Simulated time may jump back.
        while len(self._kept) > 1 and not limit_s <= self._kept[0][0] <= now:
            self._kept.popleft()
        return is_changed or len(self._kept) < before

    @property
    def observations(self) -> list[Observation]:
        """Return the observations, the oldest first."""
        return [each for _, each in self._kept]

    def _take(self, message: Any) -> None:
        self._last_s = now_s(self._node)
        self._waiting.append(message)

    def _transform_waiting(self) -> bool:
        """Transform the newest possible message, or all possible ones if observations persist."""
        persists = self.settings.observation_persistence > 0.0
        done: list[tuple[float, Observation]] = []
        for index in reversed(range(len(self._waiting))):
            try:
                found = self._observation(self._waiting[index])
            except TransformException as error:
                if index == 0 and len(self._waiting) == _KEPT_MESSAGES:
                    self._warn(f'the pose of the sensor is unknown: {error}')
                continue
            except ValueError as error:
                self._warn(str(error))
                del self._waiting[index]
                continue
            done.append((now_s(self._node), found))
            if not persists:
                for _ in range(index + 1):
                    self._waiting.popleft()
                self._kept.clear()
                break
            del self._waiting[index]
        self._kept.extend(reversed(done))
        return bool(done)

    def _observation(self, message: Any) -> Observation:
        values = self.settings
        stamp = Time.from_msg(message.header.stamp)
        look_up = self._node.transforms.buffer.lookup_transform
        frame = message.header.frame_id.lstrip('/')
        transform = look_up(self._node.global_frame, frame, stamp).transform
        if isinstance(message, LaserScan):
            points, is_hit = scan_points(message, inf_is_valid=values.inf_is_valid)
        else:
            points, is_hit = cloud_points(message), None
        heights = (values.min_obstacle_height, values.max_obstacle_height)
        found = observation_of(points, is_hit, transform, heights)
        if values.sensor_frame and values.sensor_frame != frame:
            at = look_up(self._node.global_frame, values.sensor_frame, stamp)
            found.origin[:] = [getattr(at.transform.translation, axis) for axis in 'xyz']
        return found

    def _warn(self, reason: str) -> None:
        self._node.get_logger().warning(
            f"A message of the observation source '{self._name}' was ignored: {reason}",
            throttle_duration_sec=_QUIET_S,
        )
