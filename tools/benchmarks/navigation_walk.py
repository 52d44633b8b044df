# SPDX-License-Identifier: Apache-2.0
"""Guide a robot of the loopback simulator through the apartment, and measure each part."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from statistics import median
import time
from typing import Any

from ament_index_python import get_package_share_directory
from domain_coordinator import domain_id
from geometry_msgs.msg import PoseStamped, PoseWithCovarianceStamped
from nav2_behavior_tree.tree import BehaviorTree
from nav2_behaviors.behavior_server import BehaviorServer
from nav2_bt_navigator.bt_navigator import BtNavigator
from nav2_collision_monitor.collision_monitor_node import CollisionMonitor
from nav2_controller.controller_server import ControllerServer
from nav2_controller.follow_path import PathFollower
from nav2_costmap_2d.costmap_node import Costmap2DROS
from nav2_loopback_sim.loopback_simulator import LoopbackSimulator
from nav2_map_server.map_server import MapServer
from nav2_msgs.action import NavigateToPose
from nav2_planner.planner_server import PlannerServer
from nav2_util.geometry import make_pose, make_pose_stamped, Pose2D
from nav2_velocity_smoother.velocity_smoother import VelocitySmoother
from navigation_parts import PARAMETERS
import rclpy
from rclpy.action import ActionClient
from rclpy.context import Context
from rclpy.node import Node
from tf2_ros.executing import make_executor

__all__ = ['walk_costs']

GOAL = Pose2D(5.5, 0.5, 0.0)
TIMEOUT_S = 30.0
SIMULATED = ('base_frame_id:=base_footprint', 'scan_frame_id:=base_footprint')
MOVED = {
    ControllerServer: ('cmd_vel:=cmd_vel_nav',),
    BehaviorServer: ('cmd_vel:=cmd_vel_nav',),
    VelocitySmoother: ('cmd_vel:=cmd_vel_nav',),
}
KINDS = (PlannerServer, ControllerServer, BehaviorServer, VelocitySmoother, CollisionMonitor)


class _Timed:
    """Replaces a method by one that records the CPU time of its calls."""

    def __init__(self, kind: Any, method: str, what: Callable[[Any], str]) -> None:
        self.costs_ms: dict[str, list[float]] = {}
        self._kind, self._method, self._whole = kind, method, getattr(kind, method)
        whole, costs_ms = self._whole, self.costs_ms

        def timed(own: Any, *arguments: Any) -> Any:
            begin_s = time.thread_time()
            try:
                return whole(own, *arguments)
            finally:
                spent_ms = (time.thread_time() - begin_s) * 1e3
                costs_ms.setdefault(what(own), []).append(spent_ms)

        setattr(kind, method, timed)

    def restore(self) -> None:
        setattr(self._kind, self._method, self._whole)


def walk_costs(seconds: float) -> Iterator[tuple[str, float, int]]:
    """
    Measure the parts of navigation while the robot walks.

    Parameters
    ----------
    seconds
        The duration.

    Yields
    ------
    The name of an operation, its median CPU time in ms, and its number of calls.

    """
    watched = [
        _Timed(Costmap2DROS, 'update', _size_of),
        _Timed(PathFollower, '_step', lambda _: 'controller: a step with its topics'),
        _Timed(BehaviorTree, 'tick', lambda _: 'tick of the behavior tree'),
        _Timed(VelocitySmoother, '_step', lambda _: 'velocity smoother: a step'),
        _Timed(CollisionMonitor, '_on_command', lambda _: 'collision monitor: a command'),
    ]
    with domain_id() as domain:
        context = Context()
        rclpy.init(context=context, domain_id=domain)
        walk = _Walk(context)
        try:
            walk.begin()
            for each in watched:
                each.costs_ms.clear()
            walk.spin(lambda: walk.is_there, seconds)
        finally:
            for each in watched:
                each.restore()
            walk.close()
    for each in watched:
        for what, costs_ms in each.costs_ms.items():
            yield what, median(costs_ms), len(costs_ms)


class _Walk:
    """All servers that guide the robot, in one executor."""

    def __init__(self, context: Context) -> None:
        self._context, self._executor = context, make_executor(context)
        self._nodes: list[Node] = [Node('walker', context=context)]
        self._end: Any = None
        self._executor.add_node(self._nodes[0])

    @property
    def is_there(self) -> bool:
        """Whether the goal was reached or aborted."""
        return bool(self._end is not None and self._end.done())

    def begin(self) -> None:
        """Start everything, and send the goal."""
        self._make(LoopbackSimulator, *SIMULATED)
        share = get_package_share_directory('humanoid_navigation')
        servers = [
            self._make(MapServer, f'yaml_filename:={Path(share, "maps", "apartment.yaml")}'),
            *(self._make(kind) for kind in KINDS),
            self._make(BtNavigator),
        ]
        for server in servers:
            server.trigger_configure()
            for each in server.companions:
                if each.executor is None:
                    self._executor.add_node(each)
        for server in servers:
            server.trigger_activate()
        client = ActionClient(self._nodes[0], NavigateToPose, 'navigate_to_pose')
        self._wait(client.server_is_ready, 'navigate_to_pose')
        self._place()
        self._wait(lambda: servers[1].costmap.is_current, 'the global costmap')
        goal = make_pose_stamped(GOAL, 'map', PoseStamped().header.stamp)
        sent = client.send_goal_async(NavigateToPose.Goal(pose=goal))
        self._wait(sent.done, 'an answer to the goal')
        self._end = sent.result().get_result_async()
        self.spin(lambda: self.is_there, 2.0)

    def spin(self, is_enough: Callable[[], object], seconds: float) -> bool:
        """Spin until a condition holds or the time is over; return whether it holds."""
        end_s = time.monotonic() + seconds
        while time.monotonic() < end_s and not is_enough():
            self._executor.spin_once(timeout_sec=0.05)
        return bool(is_enough())

    def close(self) -> None:
        """Destroy all nodes, and shut down."""
        for node in reversed(self._nodes):
            node.destroy_node()
        self._executor.shutdown()
        rclpy.shutdown(context=self._context)

    def _place(self) -> None:
        """Publish the initial pose of the robot."""
        start = PoseWithCovarianceStamped()
        start.header.frame_id = 'map'
        start.pose.pose = make_pose(Pose2D(0.0, 0.0, 0.0))
        publisher = self._nodes[0].create_publisher(PoseWithCovarianceStamped, 'initialpose', 1)
        self._wait(publisher.get_subscription_count, 'somebody to hear where the robot is')
        publisher.publish(start)

    def _wait(self, is_enough: Callable[[], object], what: str) -> None:
        if not self.spin(is_enough, TIMEOUT_S):
            raise SystemExit(f'Waited {TIMEOUT_S:g} s for {what}.')

    def _make(self, kind: Any, *parameters: str) -> Any:
        words = ['--ros-args', '--params-file', PARAMETERS]
        is_simulator = kind is LoopbackSimulator
        for each in (*parameters, *(() if is_simulator else ('use_sim_time:=true',))):
            words += ['-p', each]
        for each in MOVED.get(kind, ()):
            words += ['-r', each]
        node = kind(context=self._context, cli_args=words)
        self._nodes.append(node)
        for each in (node, *getattr(node, 'companions', ())):
            if each.executor is None:
                self._executor.add_node(each)
        return node


def _size_of(costmap: Any) -> str:
    grid = costmap.grid
    return f'update of {costmap.get_name()}, {grid.size_x} x {grid.size_y} cells'
