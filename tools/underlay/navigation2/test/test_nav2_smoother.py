# SPDX-License-Identifier: Apache-2.0
"""The smoothers, without ROS and in their server."""

from __future__ import annotations

import math
from typing import Any

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Duration
from geometry_msgs.msg import PolygonStamped, PoseStamped, TransformStamped
from nav2_costmap_2d.costmap_messages import make_costmap_message, make_polygon
from nav2_costmap_2d.grid import Costmap2D
from nav2_msgs.action import SmoothPath
from nav2_msgs.msg import Costmap, CostmapUpdate
from nav2_planner.path_shape import smoothed
from nav2_smoother.path_smoothing import (
    keep_off_obstacles,
    savitzky_golay,
    segments,
    smooth_path,
)
from nav2_smoother.smoother_server import SmootherServer
from nav2_util.geometry import make_path, path_poses
from nav_msgs.msg import Path
import numpy as np
import pytest
from rclpy.action import ActionClient
from rclpy.qos import DurabilityPolicy, QoSProfile
from rclpy.time import Time
from tf2_ros import StaticTransformBroadcaster

CODES = SmoothPath.Result


def zigzag(count: int = 61) -> np.ndarray:
    """Return poses along x that jump to the left and right, with a corner in the middle."""
    half = count // 2
    x = np.minimum(np.arange(count), half) * 0.05
    y = np.maximum(np.arange(count) - half, 0) * 0.05
    noise = 0.01 * (-1.0) ** np.arange(count)
    noise[[0, -1]] = 0.0
    return np.column_stack([x + 1.0, y + 1.0 + noise, np.zeros(count)])


def roughness(poses: np.ndarray) -> float:
    """Return the sum of squares of second differences."""
    return float((np.diff(poses[:, :2], n=2, axis=0) ** 2).sum())


def soften(points: np.ndarray) -> np.ndarray:
    """Smooth as the simple smoother does by default."""
    for _ in range(3):
        points = smoothed(points, 0.3, 0.2)
    return points


def test_savitzky_golay_keeps_polynomials():
    """A cubic passes the filter unchanged, but near its ends; noise does not pass."""
    x = np.linspace(-1.0, 1.0, 41)
    points = np.column_stack([x, x**3 - x])
    assert savitzky_golay(points, 7, 3)[3:-3] == pytest.approx(points[3:-3], abs=1e-12)
    noisy = zigzag()[:, :2]
    found = savitzky_golay(noisy, 7, 3)
    assert roughness(found) < 0.5 * roughness(noisy)
    assert found[[0, -1]] == pytest.approx(noisy[[0, -1]])


def test_smooth_path_keeps_ends_and_faces_along_itself():
    """Ends stay, noise goes, and poses face along the path."""
    poses = zigzag()
    poses[-1, 2] = 2.5
    found = smooth_path(poses, soften, None)
    assert roughness(found) < 0.1 * roughness(poses)
    assert found[[0, -1], :2] == pytest.approx(poses[[0, -1], :2]) and found[-1, 2] == 2.5
    steps = np.diff(found[:, :2], axis=0)
    assert found[:-1, 2] == pytest.approx(np.arctan2(steps[:, 1], steps[:, 0]))


def test_cusps_stay_and_backward_stretches_face_backwards():
    """Where a path reverses it is divided; what is driven backwards keeps facing so."""
    out = np.linspace(0.0, 1.0, 21)
    poses = np.zeros((41, 3))
    poses[:21, 0], poses[21:, 0] = out, out[::-1][1:]
    poses[:, 1] = 0.02 * np.sin(np.arange(41))
    assert segments(poses) == [(0, 21), (20, 41)]
    found = smooth_path(poses, soften, None)
    assert found[20, :2] == pytest.approx(poses[20, :2])
    assert (np.cos(found[:, 2]) > 0.5).all()
    loose = smooth_path(poses, soften, None, enforce_path_inversion=False)
    assert loose[20, 0] < 0.97


def test_turn_on_the_spot_stays():
    """Poses at one place with several yaws divide a path."""
    poses = np.zeros((30, 3))
    poses[:15, 0] = np.arange(15) * 0.1
    poses[15:, 0], poses[15:, 1] = 1.4, np.arange(15) * 0.1
    poses[15:, 2] = math.pi / 2
    assert (14, 16) in segments(poses)


@pytest.mark.parametrize('count', [0, 1, 2, 3])
def test_short_paths(count):
    """Paths of a few poses come through."""
    poses = zigzag()[:count]
    assert smooth_path(poses, soften, None).shape == (count, 3)


def test_points_keep_off_obstacles():
    """A corner around an obstacle is not cut through it; unknown space is no obstacle."""
    cells = np.zeros((80, 80), np.uint8)
    cells[21:60, 20:49] = 254
    grid = Costmap2D(80, 80, 0.05, 0.0, 0.0, cells=cells)
    poses = zigzag()
    poses[:, 1] -= 0.0
    wanted = smoothed(poses[:, :2], 400.0, 1.0)
    assert (grid.costs_at(wanted) == 254).any()
    found = keep_off_obstacles(poses[:, :2], wanted, grid)
    was = grid.costs_at(poses[:, :2]) == 254
    assert not (grid.costs_at(found)[~was] == 254).any()
    cells[cells == 254] = 255
    assert keep_off_obstacles(poses[:, :2], wanted, grid) == pytest.approx(wanted)


class Smoothing:
    """A smoother server with a costmap and a footprint."""

    def __init__(self, ros: Any, parameters: dict[str, Any] | None = None) -> None:
        self.ros = ros
        self.node = ros.node('tester')
        latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        self.costmaps = self.node.create_publisher(Costmap, 'global_costmap/costmap_raw', latched)
        self.updates = self.node.create_publisher(
            CostmapUpdate, 'global_costmap/costmap_raw_updates', 10
        )
        self.footprints = self.node.create_publisher(
            PolygonStamped, 'global_costmap/published_footprint', 1
        )
        self.smooth_plans: list[Path] = []
        self.node.create_subscription(Path, 'plan_smoothed', self.smooth_plans.append, 1)
        transform = TransformStamped()
        transform.header.frame_id, transform.child_frame_id = 'map', 'base_link'
        transform.transform.translation.x, transform.transform.rotation.w = 2.0, 1.0
        self.broadcaster = StaticTransformBroadcaster(self.node)
        self.broadcaster.sendTransform(transform)
        self.server = ros.make(SmootherServer, parameters)

    def start(self) -> Smoothing:
        """Configure and activate the server."""
        assert self.server.trigger_configure().name == 'SUCCESS'
        assert self.server.trigger_activate().name == 'SUCCESS'
        return self

    def publish(self, cells: np.ndarray) -> None:
        """Publish a costmap, and the footprint of the robot at (2, 0)."""
        grid = Costmap2D(cells.shape[1], cells.shape[0], 0.05, 0.0, 0.0, cells=cells)
        self.costmaps.publish(make_costmap_message(grid, 'map', PoseStamped().header.stamp))
        square = np.array([[2.1, 0.1], [2.1, -0.1], [1.9, -0.1], [1.9, 0.1]])
        message = PolygonStamped(polygon=make_polygon(square))
        message.header.frame_id = 'map'
        self.ros.wait_until(self.footprints.get_subscription_count, what='the subscription')
        self.footprints.publish(message)
        around = self.server._surroundings
        can_look = self.server.transforms.buffer.can_transform
        self.ros.wait_until(lambda: can_look('map', 'base_link', Time()), what='the transform')
        self.ros.wait_until(lambda: around.frame and around._footprint, what='the costmap')

    def smooth(self, poses: np.ndarray, frame: str = 'map', **more: Any) -> Any:
        """Smooth a path; return status and result."""
        client = ActionClient(self.node, SmoothPath, 'smooth_path')
        self.ros.wait_until(client.server_is_ready, what='the action')
        path = make_path(poses, frame, PoseStamped().header.stamp)
        limit = more.pop('limit', Duration(sec=3))
        sent = client.send_goal_async(
            SmoothPath.Goal(path=path, max_smoothing_duration=limit, **more)
        )
        self.ros.wait_until(sent.done, what='the goal')
        future = sent.result().get_result_async()
        self.ros.wait_until(future.done, what='the result')
        return future.result()


@pytest.mark.parametrize(
    'kind',
    [
        'nav2_smoother::SimpleSmoother',
        'nav2_smoother/SavitzkyGolaySmoother',
        'nav2_constrained_smoother/ConstrainedSmoother',
    ],
)
def test_each_smoother_smooths(ros, kind):
    """The path comes back smoother, with its ends, and is published."""
    smoothing = Smoothing(ros, {'smoother_plugins': ['mine'], 'mine.plugin': kind}).start()
    poses = zigzag()
    answer = smoothing.smooth(poses)
    assert answer.status == GoalStatus.STATUS_SUCCEEDED, answer.result.error_msg
    assert answer.result.was_completed and answer.result.error_code == CODES.NONE
    found = path_poses(answer.result.path)
    assert roughness(found) < 0.5 * roughness(poses)
    assert found[[0, -1], :2] == pytest.approx(poses[[0, -1], :2])
    assert answer.result.path.header.frame_id == 'map'
    ros.wait_until(lambda: smoothing.smooth_plans, what='the smooth plan')


def test_collisions_are_found_if_asked_for(ros):
    """With check_for_collisions a path through an obstacle is refused, also after an update."""
    smoothing = Smoothing(ros).start()
    answer = smoothing.smooth(zigzag(), check_for_collisions=True)
    assert answer.result.error_code == CODES.FAILED_TO_SMOOTH_PATH
    assert 'no costmap' in answer.result.error_msg
    smoothing.publish(np.zeros((80, 80), np.uint8))
    answer = smoothing.smooth(zigzag(), check_for_collisions=True)
    assert answer.status == GoalStatus.STATUS_SUCCEEDED
    update = CostmapUpdate(x=30, y=18, size_x=2, size_y=4, data=[254] * 8)
    smoothing.updates.publish(update)
    ros.wait_until(lambda: smoothing.server._surroundings._updates, what='the update')
    answer = smoothing.smooth(zigzag(), check_for_collisions=True)
    assert answer.result.error_code == CODES.SMOOTHED_PATH_IN_COLLISION
    assert 'hits an obstacle at' in answer.result.error_msg
    answer = smoothing.smooth(zigzag(), check_for_collisions=False)
    assert answer.status == GoalStatus.STATUS_SUCCEEDED
    answer = smoothing.smooth(zigzag() - (1.2, 0.0, 0.0), 'base_link', check_for_collisions=True)
    assert answer.status == GoalStatus.STATUS_SUCCEEDED


def test_paths_and_smoothers_that_cannot_be_used(ros):
    """Each has its code and a sentence."""
    smoothing = Smoothing(ros).start()
    answer = smoothing.smooth(zigzag()[:0])
    assert answer.result.error_code == CODES.INVALID_PATH and answer.result.error_msg
    broken = zigzag()
    broken[3, 0] = math.nan
    answer = smoothing.smooth(broken)
    assert answer.result.error_code == CODES.INVALID_PATH and 'Pose 3' in answer.result.error_msg
    answer = smoothing.smooth(zigzag(), smoother_id='simple_smother')
    assert answer.result.error_code == CODES.INVALID_SMOOTHER
    assert "Did you mean 'simple_smoother'?" in answer.result.error_msg
    answer = smoothing.smooth(zigzag(), limit=Duration(nanosec=1))
    assert answer.result.error_code == CODES.TIMEOUT and answer.result.error_msg


@pytest.mark.parametrize(
    ('parameters', 'words'),
    [
        ({'smoother_plugins': ['a']}, "'a.plugin'"),
        (
            {'smoother_plugins': ['a'], 'a.plugin': 'nav2_smoother::SimpelSmoother'},
            'nav2_smoother::SimpleSmoother',
        ),
        (
            {
                'smoother_plugins': ['a'],
                'a.plugin': 'nav2_smoother::SavitzkyGolaySmoother',
                'a.window_size': 4,
            },
            'must be odd',
        ),
    ],
)
def test_wrong_configurations(ros, capfd, parameters, words):
    """Configuring fails with a sentence."""
    smoothing = Smoothing(ros, parameters)
    assert smoothing.server.trigger_configure().name == 'FAILURE'
    assert words in capfd.readouterr().err
