# SPDX-License-Identifier: Apache-2.0
"""The commander, as programs use it, with servers that run in a thread beside it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
import sys
import threading
import time
from typing import Any

from geometry_msgs.msg import Point32, Polygon, PoseWithCovarianceStamped
from nav2_bt_navigator import BtNavigator
from nav2_msgs import srv
from nav2_simple_commander.costmap_2d import PyCostmap2D
from nav2_simple_commander.footprint_collision_checker import FootprintCollisionChecker
from nav2_simple_commander.line_iterator import LineIterator
from nav2_simple_commander.robot_navigator import BasicNavigator, TaskResult
from nav2_util import LifecycleNode
from nav2_waypoint_follower import WaypointFollower
from nav_msgs.msg import OccupancyGrid
from nav_msgs.msg import Path as PathMessage
import pytest
from rclpy.qos import DurabilityPolicy, QoSProfile

sys.path.insert(0, str(Path(__file__).parent))
from navigation_servers import pose, Servers  # noqa: E402, I100

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Stack:
    """A navigator, a follower and servers in a thread, and the commander in this one."""

    def __init__(self, ros: Any) -> None:
        self.ros, self.node = ros, ros.node('servers')
        self.servers = Servers(self.node)
        self.calls: list[Any] = []
        self.nodes = [ros.make(BtNavigator), ros.make(WaypointFollower)]
        self.nodes.append(ros.make(LifecycleNode, node_name='amcl'))
        for node in self.nodes:
            node.trigger_configure()
            for each in node.companions:
                if each.executor is None:
                    ros.executor.add_node(each)
            node.trigger_activate()
        self._offer()
        self.commander = BasicNavigator(context=ros.context)
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run)
        self._thread.start()

    def _offer(self) -> None:
        offer = self.node.create_service
        offer(srv.LoadMap, 'map_server/load_map', self._load)
        offer(srv.ManageLifecycleNodes, 'lifecycle_manager/manage_nodes', self._manage)
        offer(srv.GetCostmap, 'global_costmap/get_costmap', self._costmap)
        offer(srv.GetCostmap, 'local_costmap/get_costmap', self._costmap)
        self._poses = self.node.create_publisher(PoseWithCovarianceStamped, 'amcl_pose', LATCHED)
        self.node.create_subscription(
            PoseWithCovarianceStamped, 'initialpose', self._poses.publish, 10
        )

    def _load(self, request: Any, response: Any) -> Any:
        response.result = 0 if request.map_url == 'good.yaml' else 1
        return response

    def _manage(self, request: Any, response: Any) -> Any:
        self.calls.append(request.command)
        response.success = True
        return response

    def _costmap(self, request: Any, response: Any) -> Any:
        about = response.map.metadata
        about.size_x, about.size_y, about.resolution = 3, 2, 0.5
        response.map.header.frame_id = 'map'
        response.map.data = [0, 1, 2, 3, 254, 5]
        return response

    def _run(self) -> None:
        while not self._stop.is_set():
            self.ros.executor.spin_once(timeout_sec=0.01)

    def close(self) -> None:
        self._stop.set()
        self._thread.join()
        self.commander.destroyNode()
        self.servers.close()

    def finish(self) -> TaskResult:
        """Wait for the end of the task."""
        end_s = time.monotonic() + 20.0
        while not self.commander.isTaskComplete():
            assert time.monotonic() < end_s
        return self.commander.getResult()


@pytest.fixture
def stack(ros: Any) -> Iterator[Stack]:
    """Return a stack."""
    made = Stack(ros)
    yield made
    made.close()


def test_a_program_drives_to_poses(stack: Stack) -> None:
    """It waits for navigation, starts goals, reads feedback, and learns why one failed."""
    commander = stack.commander
    commander.setInitialPose(pose(0.0))
    commander.waitUntilNav2Active()
    stack.servers.scripts['follow_path'] = [0.5]
    assert commander.goToPose(pose(3.0, 4.0))
    assert not commander.isTaskComplete()
    assert stack.finish() is TaskResult.SUCCEEDED
    assert commander.getFeedback().distance_remaining == pytest.approx(5.0)
    assert commander.getTaskError() == (0, '')
    assert commander.goThroughPoses([pose(1.0), pose(2.0)])
    assert stack.finish() is TaskResult.SUCCEEDED
    stack.servers.scripts['compute_path_to_pose'] = [(206, 'A wall.')]
    assert commander.goToPose(pose(1.0))
    assert stack.finish() is TaskResult.FAILED
    assert commander.getTaskError() == (206, 'The planner found no way to the goal: A wall.')


def test_a_task_can_be_canceled_and_replaced(stack: Stack) -> None:
    """A newer goal of the same kind takes over."""
    commander = stack.commander
    stack.servers.scripts['follow_path'] = ['hang']
    assert commander.goToPose(pose(1.0))
    assert not commander.isTaskComplete()
    assert commander.goToPose(pose(2.0))
    assert not commander.isTaskComplete()
    commander.cancelTask()
    assert stack.finish() is TaskResult.CANCELED


def test_waypoints_behaviors_and_paths(stack: Stack) -> None:
    """Each is a task."""
    commander = stack.commander
    assert commander.followWaypoints([pose(1.0), pose(2.0)])
    assert stack.finish() is TaskResult.SUCCEEDED
    path = commander.getPath(pose(0.0), pose(1.0), use_start=True)
    assert path.poses[-1].pose.position.x == 1.0
    assert stack.servers.goals['compute_path_to_pose'][-1].use_start
    through = commander.getPathThroughPoses(pose(0.0), [pose(1.0), pose(2.0)])
    assert len(through.poses) == 3
    assert isinstance(commander.smoothPath(path), PathMessage)
    for start in (
        lambda: commander.followPath(path),
        commander.spin,
        lambda: commander.backup(backup_dist=0.2, backup_speed=0.1),
        lambda: commander.driveOnHeading(dist=0.3),
        commander.assistedTeleop,
    ):
        assert start()
        assert stack.finish() is TaskResult.SUCCEEDED
    assert stack.servers.goals['backup'][0].target.x == pytest.approx(0.2)
    assert not commander.followGpsWaypoints([])
    assert 'rejected' in commander.getTaskError()[1]


def test_a_path_that_cannot_be_found_is_none(stack: Stack) -> None:
    """With the reason to ask for."""
    stack.servers.scripts['compute_path_to_pose'] = [(208, 'Closed.')]
    assert stack.commander.getPath(pose(0.0), pose(1.0)) is None
    assert stack.commander.getTaskError() == (208, 'Closed.')


def test_maps_costmaps_and_lifecycle(stack: Stack) -> None:
    """Services are asked, and answers returned."""
    commander = stack.commander
    assert commander.changeMap('good.yaml')
    assert not commander.changeMap('bad.yaml')
    assert 'does not exist' in commander.getTaskError()[1]
    commander.clearAllCostmaps()
    assert stack.servers.calls == ['clear local', 'clear global']
    costmap = PyCostmap2D(commander.getGlobalCostmap())
    assert costmap.getCostXY(1, 1) == 254 and costmap.getGlobalFrameID() == 'map'
    assert commander.getLocalCostmap().metadata.size_x == 3
    commander.lifecycleShutdown()
    commander.lifecycleStartup()
    assert stack.calls == [4, 0]


def test_a_costmap_knows_its_cells() -> None:
    """Indices, coordinates, costs."""
    grid = OccupancyGrid(data=[0] * 6)
    grid.info.width, grid.info.height, grid.info.resolution = 3, 2, 0.5
    grid.info.origin.position.x = -1.0
    costmap = PyCostmap2D(grid)
    assert (costmap.getSizeInCellsX(), costmap.getSizeInCellsY()) == (3, 2)
    assert costmap.worldToMapValidated(-0.9, 0.6) == (0, 1)
    assert costmap.worldToMapValidated(-1.1, 0.6) == (None, None)
    assert costmap.mapToWorld(0, 1) == (-0.75, 0.75)
    costmap.setCost(2, 1, 100)
    assert costmap.getCostIdx(5) == 100 == costmap.getCostXY(2, 1)


def test_footprints_are_checked_along_their_outline() -> None:
    """The highest cost on it counts; outside is lethal."""
    grid = OccupancyGrid(data=[0] * 100)
    grid.info.width = grid.info.height = 10
    grid.info.resolution = 1.0
    costmap = PyCostmap2D(grid)
    costmap.setCost(5, 3, 200)
    checker = FootprintCollisionChecker()
    with pytest.raises(ValueError, match='no costmap'):
        checker.pointCost(1, 1)
    checker.setCostmap(costmap)
    corners = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)]
    square = Polygon(points=[Point32(x=x, y=y) for x, y in corners])
    assert checker.footprintCostAtPose(2.5, 2.5, 0.0, square) == 0
    assert checker.footprintCostAtPose(4.5, 3.5, 0.0, square) == 200
    assert checker.footprintCostAtPose(5.5, 3.5, 0.0, square) == 0
    assert checker.footprintCostAtPose(0.5, 3.5, 0.0, square) == 254


@pytest.mark.parametrize(
    'line, points',
    [
        ((0, 0, 3, 0), [(0, 0), (1, 0), (2, 0), (3, 0)]),
        ((0, 2, 0, 0), [(0, 2), (0, 1), (0, 0)]),
        ((0, 0, 2, 4), [(0, 0), (1, 2), (2, 4)]),
        ((1, 1, 0, 0, 0.5), [(1, 1), (0.5, 0.5), (0, 0)]),
        ((1, 1, 1, 1), [(1, 1)]),
    ],
)
def test_lines_are_walked(line: tuple[float, ...], points: list[tuple[float, float]]) -> None:
    """From one end to the other."""
    iterator, found = LineIterator(*line), []
    while iterator.isValid():
        found.append((iterator.getX(), iterator.getY()))
        iterator.advance()
    assert found == points


def test_lines_need_a_step() -> None:
    """A positive number."""
    with pytest.raises(TypeError):
        LineIterator(0, 0, 10, 10, '10')
    with pytest.raises(ValueError):
        LineIterator(0, 0, 10, 10, -2)
    assert LineIterator(0, 0, 3, 4).get_line_length() == 5.0
