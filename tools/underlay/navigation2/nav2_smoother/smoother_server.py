# SPDX-License-Identifier: Apache-2.0
"""The node `smoother_server`, which offers the action `smooth_path`."""

from __future__ import annotations

from dataclasses import dataclass
import time
from typing import Any

from builtin_interfaces.msg import Duration
from nav2_msgs.action import SmoothPath
from nav2_smoother.smoothers import Smoother, SMOOTHERS
from nav2_smoother.surroundings import Surroundings
from nav2_util.errors import ActionAborted
from nav2_util.geometry import make_path, path_poses, Pose2D
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter, ParameterSet
from nav2_util.plugins import did_you_mean, find_plugin, plugin_type
from nav2_util.transforms import TransformError
from nav_msgs.msg import Path
import numpy as np
import numpy.typing as npt

__all__ = ['SmootherServer']

FloatArray = npt.NDArray[np.float64]

_DEFAULT_PLUGINS = {'simple_smoother': 'nav2_smoother::SimpleSmoother'}


@dataclass(frozen=True)
class SmootherServerParameters:
    """The parameters of the smoother server."""

    costmap_topic: str = parameter(
        'global_costmap/costmap_raw', 'Where the costmap comes from that paths are checked with.'
    )
    footprint_topic: str = parameter(
        'global_costmap/published_footprint', "Where the robot's footprint comes from."
    )
    transform_tolerance: float = parameter(
        0.1, 'By how many s a transform may be late; the newest is taken.', low=0.0
    )
    robot_base_frame: str = parameter('base_link', 'The frame of the robot.')
    smoother_plugins: list[str] = parameter(
        ['simple_smoother'], 'The names of the smoothers; each has a parameter plugin, its type.'
    )


class SmootherServer(LifecycleNode):
    """
    Smoother server, which smooths paths.

    Parameters
    ----------
    node_name
        Its name.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str = 'smoother_server', **options: Any) -> None:
        super().__init__(node_name, **options)
        self._smoothers: dict[str, Smoother] = {}
        self._settings = ParameterSet(SmootherServerParameters())

    def configure(self) -> None:
        """Create the smoothers and the interfaces."""
        self._settings = self.parameters.declare(SmootherServerParameters)
        values = self._settings.current
        for name in values.smoother_plugins:
            self._smoothers[name] = self._make_smoother(name)
        self._surroundings = Surroundings(
            self, values.costmap_topic, values.footprint_topic, values.robot_base_frame
        )
        self._publisher = self.create_lifecycle_publisher(Path, 'plan_smoothed', 1)
        self._server = self.offer_action(SmoothPath, 'smooth_path', self._smooth)
        # Start filling the transform buffer now, not with the first path.
        assert self.transforms

    def cleanup(self) -> None:
        """Release the smoothers."""
        self._smoothers.clear()

    def _make_smoother(self, name: str) -> Smoother:
        kind = plugin_type(
            self.parameters, name, 'smoother', _DEFAULT_PLUGINS.get(name, ''), SMOOTHERS
        )
        smoother: Smoother = find_plugin(SMOOTHERS, kind, 'smoother')(self, name)
        self.get_logger().info(f"Made the smoother '{name}' of type {kind}.")
        return smoother

    async def _smooth(self, goal: Any) -> None:
        codes = SmoothPath.Result
        began = time.monotonic()
        smoother = self._find_smoother(goal.smoother_id)
        poses = self._checked_poses(goal.path)
        frame = goal.path.header.frame_id or goal.path.poses[0].header.frame_id
        base = self._base_of(frame)
        costmap = self._surroundings.grid() if base == Pose2D(0.0, 0.0, 0.0) else None
        self._server.check()
        try:
            found = smoother.smooth(poses, costmap)
        except (ValueError, np.linalg.LinAlgError) as error:
            raise ActionAborted(
                codes.FAILED_TO_SMOOTH_PATH,
                f"The smoother '{smoother.name}' could not smooth the path: {error}",
            ) from error
        if not np.isfinite(found).all():
            raise ActionAborted(
                codes.FAILED_TO_SMOOTH_PATH,
                f"The smoother '{smoother.name}' gave poses that are not numbers. Check its "
                'weights.',
            )
        elapsed_s = time.monotonic() - began
        limit = goal.max_smoothing_duration
        limit_s = limit.sec + limit.nanosec * 1e-9
        if 0.0 < limit_s < elapsed_s:
            raise ActionAborted(
                codes.TIMEOUT,
                f'Smoothing took {elapsed_s:.3f} s; max_smoothing_duration allows {limit_s:.3f} '
                's. Allow more time, or smooth a shorter path.',
            )
        path = make_path(found, frame, self.get_clock().now().to_msg())
        if goal.check_for_collisions:
            self._check_collisions(found, base)
        self._server.check()
        result = self._server.result
        result.path, result.was_completed = path, True
        result.smoothing_duration = Duration(
            sec=int(elapsed_s), nanosec=int(elapsed_s % 1.0 * 1e9)
        )
        if self._publisher.get_subscription_count():
            self._publisher.publish(path)

    def _find_smoother(self, name: str) -> Smoother:
        if name in self._smoothers:
            return self._smoothers[name]
        if not name and len(self._smoothers) == 1:
            return next(iter(self._smoothers.values()))
        known = ', '.join(f"'{each}'" for each in self._smoothers)
        asked = (
            f"There is no smoother '{name}'.{did_you_mean(name, self._smoothers)}"
            if name
            else 'smoother_id is empty, and there are several smoothers.'
        )
        raise ActionAborted(
            SmoothPath.Result.INVALID_SMOOTHER,
            f'{asked} The parameter smoother_plugins lists {known}.',
        )

    def _checked_poses(self, path: Path) -> FloatArray:
        code = SmoothPath.Result.INVALID_PATH
        if not path.poses:
            raise ActionAborted(code, 'The path has no poses. Plan a path before smoothing it.')
        poses = path_poses(path)
        if not np.isfinite(poses).all():
            index = int(np.flatnonzero(~np.isfinite(poses).all(axis=1))[0])
            raise ActionAborted(
                code, f'Pose {index} of the path has a coordinate that is not a number.'
            )
        return poses

    def _base_of(self, frame: str) -> Pose2D | None:
        """Look up the frame of a path in that of the costmap; None if unavailable."""
        target = self._surroundings.frame
        if not frame or not target or frame == target:
            return Pose2D(0.0, 0.0, 0.0)
        try:
            return self.transforms.pose_of(frame, target)
        except TransformError as error:
            self.get_logger().warning(f'Obstacles are not considered in smoothing. {error}')
            return None

    def _check_collisions(self, poses: FloatArray, base: Pose2D | None) -> None:
        codes = SmoothPath.Result
        hits = None
        if base is not None:
            there = np.array([base @ Pose2D(*pose) for pose in poses])
            hits = self._surroundings.colliding(there)
        if hits is None:
            raise ActionAborted(
                codes.FAILED_TO_SMOOTH_PATH,
                'The smooth path could not be checked for collisions: no costmap on '
                f"'{self._surroundings.costmap_topic}', no footprint on "
                f"'{self._surroundings.footprint_topic}', or no transform to them has been "
                'received yet. Activate the costmap, or set check_for_collisions to false.',
            )
        if len(hits):
            x, y, _ = poses[hits[0]]
            raise ActionAborted(
                codes.SMOOTHED_PATH_IN_COLLISION,
                f'The smooth path hits an obstacle at ({x:.2f}, {y:.2f}), pose {hits[0]} of '
                f'{len(poses)}. Plan again, or smooth less.',
            )
