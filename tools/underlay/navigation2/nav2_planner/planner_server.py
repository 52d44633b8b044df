# SPDX-License-Identifier: Apache-2.0
"""The node `planner_server`: owns the global costmap and offers the planning actions."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from dataclasses import dataclass
import time
from typing import Any

from builtin_interfaces.msg import Duration
from geometry_msgs.msg import PoseStamped
from nav2_costmap_2d.costmap_node import make_costmap
from nav2_costmap_2d.costs import (
    INSCRIBED_INFLATED_OBSTACLE,
    LETHAL_OBSTACLE,
    NO_INFORMATION,
)
from nav2_costmap_2d.footprint import FootprintCollisionChecker
from nav2_costmap_2d.grid import Costmap2D
from nav2_msgs.action import ComputePathThroughPoses, ComputePathToPose
from nav2_msgs.srv import IsPathValid
from nav2_planner.global_planner import GlobalPlanner, PLANNERS
from nav2_planner.route import PlanningError
from nav2_util.actions import ActionServer
from nav2_util.errors import ActionAborted, ConfigurationError
from nav2_util.geometry import make_path, path_poses, Pose2D
from nav2_util.lifecycle_node import LifecycleNode
from nav2_util.parameters import parameter, ParameterSet
from nav2_util.plugins import did_you_mean, find_plugin, plugin_type
from nav2_util.services import wait_for
from nav2_util.timing import give_way, now_s
from nav2_util.transforms import TransformError
from nav_msgs.msg import Path
import numpy as np
import numpy.typing as npt
from rclpy.lifecycle import TransitionCallbackReturn
from rclpy.task import Future

__all__ = ['PlannerServer', 'invalid_poses']

FloatArray = npt.NDArray[np.float64]

_LOOK_S = 0.02
_REPORT_S = 10.0
_DEFAULT_PLUGINS = {'GridBased': 'nav2_navfn_planner::NavfnPlanner'}


@dataclass(frozen=True)
class PlannerServerParameters:
    """The parameters of the planner server."""

    planner_plugins: list[str] = parameter(
        ['GridBased'], 'The names of the planners; each has a parameter plugin, its type.'
    )
    expected_planner_frequency: float = parameter(
        1.0, 'How often in Hz a path should be ready; slower planning is reported.', low=0.0
    )
    costmap_update_timeout: float = parameter(
        1.0, 'How long in s to wait for the costmap to be up to date.', low=0.0
    )


class PlannerServer(LifecycleNode):
    """
    Planner server, which plans global paths.

    Parameters
    ----------
    node_name
        Its name.
    options
        Further keyword arguments of `rclpy.node.Node`.

    """

    def __init__(self, node_name: str = 'planner_server', **options: Any) -> None:
        super().__init__(node_name, **options)
        self.costmap = make_costmap(self, 'global_costmap')
        self._planners: dict[str, GlobalPlanner] = {}
        self._settings = ParameterSet(PlannerServerParameters())

    def configure(self) -> None:
        """Create the costmap, the planners and the interfaces."""
        self._settings = self.parameters.declare(PlannerServerParameters)
        for each in self.companions:
            if each.executor is None and self.executor is not None:
                self.executor.add_node(each)
        if self.costmap.trigger_configure() is not TransitionCallbackReturn.SUCCESS:
            raise ConfigurationError(
                'The global costmap could not be configured; it has logged why.'
            )
        for name in self._settings.current.planner_plugins:
            self._planners[name] = self._make_planner(name)
        self._publisher = self.create_lifecycle_publisher(Path, 'plan', 1)
        self._to_pose = self.offer_action(
            ComputePathToPose, 'compute_path_to_pose', self._plan_to_pose
        )
        self._through_poses = self.offer_action(
            ComputePathThroughPoses, 'compute_path_through_poses', self._plan_through_poses
        )
        self.create_service(IsPathValid, 'is_path_valid', self._check_path)
        # The first message of a type loads its dependencies, which must not delay a goal.
        make_path([Pose2D(0.0, 0.0, 0.0)], '', self.get_clock().now().to_msg())

    def activate(self) -> None:
        """Activate the costmap."""
        if self.costmap.trigger_activate() is not TransitionCallbackReturn.SUCCESS:
            raise ConfigurationError(
                'The global costmap could not be activated; it has logged why.'
            )

    def deactivate(self) -> None:
        """Deactivate the costmap."""
        if self.costmap.state == 'active':
            self.costmap.trigger_deactivate()

    def cleanup(self) -> None:
        """Release the planners and the resources of the costmap."""
        self._planners.clear()
        # It may be in any state, for example after a parameter error.
        self.deactivate()
        if self.costmap.state == 'inactive':
            self.costmap.trigger_cleanup()

    def _make_planner(self, name: str) -> GlobalPlanner:
        kind = plugin_type(
            self.parameters, name, 'planner', _DEFAULT_PLUGINS.get(name, ''), PLANNERS
        )
        planner: GlobalPlanner = find_plugin(PLANNERS, kind, 'planner')(self, name, self.costmap)
        self.get_logger().info(f"Made the planner '{name}' of type {kind}.")
        return planner

    async def _plan_to_pose(self, goal: Any) -> None:
        await self._plan(self._to_pose, ComputePathToPose.Result, goal, [goal.goal])

    async def _plan_through_poses(self, goal: Any) -> None:
        codes = ComputePathThroughPoses.Result
        if not goal.goals:
            raise ActionAborted(
                codes.NO_VIAPOINTS_GIVEN, 'There are no goals. Give at least one pose.'
            )
        await self._plan(self._through_poses, codes, goal, goal.goals)

    async def _plan(
        self, server: ActionServer, codes: Any, goal: Any, stops: Sequence[PoseStamped]
    ) -> None:
        """Plan from the requested start, or the robot's pose, through all poses."""
        began = time.monotonic()
        planner = self._find_planner(goal.planner_id, codes)
        await self._wait_for_costmap(server, codes)
        frame = self.costmap.global_frame
        try:
            start = (
                self.transforms.pose_in(goal.start, frame)
                if goal.use_start
                else self.costmap.robot_pose()
            )
            poses = [self.transforms.pose_in(each, frame) for each in stops]
        except TransformError as error:
            raise ActionAborted(codes.TF_ERROR, str(error)) from error
        legs = []
        for index, pose in enumerate(poses):
            if index:
                await give_way(self)
            of_many = f'Goal {index + 1} of {len(poses)}: ' if len(poses) > 1 else ''
            try:
                leg = await self._plan_leg(server, planner.create_plan(start, pose))
            except PlanningError as error:
                code = getattr(codes, error.reason)
                raise ActionAborted(code, f'{of_many}{error}') from error
            legs.append(leg[1:] if index and len(leg) > 1 else leg)
            start = Pose2D(*leg[-1])
        server.check()
        path = make_path(np.concatenate(legs), frame, self.get_clock().now().to_msg())
        elapsed_s = time.monotonic() - began
        if self._publisher.get_subscription_count():
            self._publisher.publish(path)
        server.result.path = path
        server.result.planning_time = Duration(
            sec=int(elapsed_s), nanosec=int(elapsed_s % 1.0 * 1e9)
        )
        expected_hz = self._settings.current.expected_planner_frequency
        if expected_hz > 0.0 and elapsed_s > 1.0 / expected_hz:
            self.get_logger().warning(
                f'Planning took {elapsed_s:.2f} s; expected_planner_frequency asks for '
                f'{1.0 / expected_hz:.2f} s.',
                throttle_duration_sec=_REPORT_S,
            )

    async def _plan_leg(
        self, server: ActionServer, work: Generator[None, None, FloatArray]
    ) -> FloatArray:
        """Plan in steps; a goal that is canceled or preempted ends between them."""
        while True:
            server.check()
            try:
                next(work)
            except StopIteration as stop:
                leg: FloatArray = stop.value
                return leg
            await give_way(self)

    def _find_planner(self, name: str, codes: Any) -> GlobalPlanner:
        if name in self._planners:
            return self._planners[name]
        if not name and len(self._planners) == 1:
            return next(iter(self._planners.values()))
        known = ', '.join(f"'{each}'" for each in self._planners)
        asked = (
            f"There is no planner '{name}'.{did_you_mean(name, self._planners)}"
            if name
            else 'planner_id is empty, and there are several planners.'
        )
        raise ActionAborted(
            codes.INVALID_PLANNER, f'{asked} The parameter planner_plugins lists {known}.'
        )

    async def _wait_for_costmap(self, server: ActionServer, codes: Any) -> None:
        timeout_s = self._settings.current.costmap_update_timeout
        end_s = now_s(self) + timeout_s
        while not self.costmap.is_current:
            server.check()
            if now_s(self) > end_s:
                try:
                    self.costmap.robot_pose()
                except TransformError as error:
                    raise ActionAborted(codes.TF_ERROR, str(error)) from error
                raise ActionAborted(
                    codes.TIMEOUT,
                    f'The global costmap was not up to date within {timeout_s:g} s. Check that '
                    'its map and sensors are published.',
                )
            # A goal can be canceled even while a simulation is paused.
            await wait_for(self, Future(executor=self.executor), _LOOK_S)

    def _check_path(
        self, request: IsPathValid.Request, response: IsPathValid.Response
    ) -> IsPathValid.Response:
        response.is_valid = False
        if not request.path.poses or not self.is_active:
            return response
        poses = path_poses(request.path)
        frame = self.costmap.global_frame
        try:
            given = request.path.header.frame_id
            if given and given != frame:
                base = self.transforms.pose_of(given, frame)
                poses = np.array([base @ Pose2D(*pose) for pose in poses])
        except TransformError as error:
            self.get_logger().warning(f'The path cannot be checked. {error}')
            return response
        try:
            robot: Pose2D | None = self.costmap.robot_pose()
        except TransformError:
            robot = None
        found = invalid_poses(self.costmap.grid, poses, self.costmap.collision_footprint, robot)
        response.is_valid = not len(found)
        response.invalid_pose_indices = [int(each) for each in found]
        return response


def invalid_poses(
    costmap: Costmap2D,
    poses: npt.NDArray[np.float64],
    footprint: npt.NDArray[np.float64] | None,
    robot: Pose2D | None,
) -> npt.NDArray[np.intp]:
    """
    Find the poses of a path at which the robot is in collision.

    Parameters
    ----------
    costmap
        The costmap. Unknown space is free; space beyond the grid is an obstacle.
    poses
        (N, 3) x and y in m, yaw in rad.
    footprint
        (M, 2) corners of the robot in m; None for a circular one, of which the centre is checked.
    robot
        The pose of the robot: poses before the nearest one are behind it, and are ignored.

    Returns
    -------
    The indices of poses.

    """
    first = 0
    if robot is not None and len(poses):
        first = int(np.argmin(np.hypot(poses[:, 0] - robot.x, poses[:, 1] - robot.y)))
    costs = FootprintCollisionChecker(costmap).footprint_costs(poses[first:], footprint)
    limit = INSCRIBED_INFLATED_OBSTACLE if footprint is None else LETHAL_OBSTACLE
    return np.flatnonzero((costs >= limit) & (costs != NO_INFORMATION)) + first
