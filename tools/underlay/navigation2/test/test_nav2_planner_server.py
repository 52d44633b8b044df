# SPDX-License-Identifier: Apache-2.0
"""The planner server, in process: a latched map, static transforms, and clients."""

from __future__ import annotations

from typing import Any

from action_msgs.msg import GoalStatus
from geometry_msgs.msg import PoseStamped, TransformStamped
from nav2_msgs.action import ComputePathThroughPoses, ComputePathToPose
from nav2_msgs.srv import IsPathValid
from nav2_planner.planner_server import PlannerServer
from nav2_util.geometry import make_path, make_pose_stamped, path_poses, Pose2D
from nav_msgs.msg import OccupancyGrid, Path
import numpy as np
import pytest
from rcl_interfaces.srv import SetParameters
from rclpy.action import ActionClient
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile
from tf2_ros import StaticTransformBroadcaster

TO_POSE, THROUGH = ComputePathToPose.Result, ComputePathThroughPoses.Result
COSTMAP = {
    'plugins': ['static_layer', 'inflation_layer'],
    'static_layer.plugin': 'nav2_costmap_2d::StaticLayer',
    'static_layer.map_subscribe_transient_local': True,
    'inflation_layer.plugin': 'nav2_costmap_2d::InflationLayer',
    'inflation_layer.inflation_radius': 0.5,
    'inflation_layer.cost_scaling_factor': 3.0,
    'robot_radius': 0.2,
    'track_unknown_space': True,
    'update_frequency': 20.0,
    'robot_base_frame': 'base_link',
    'global_frame': 'map',
}


def walls() -> np.ndarray:
    """Return a map of 6 x 4 m: two rooms with a door, and a closed one."""
    cells = np.zeros((80, 120), np.int8)
    cells[[0, -1]] = 100
    cells[:, [0, -1]] = 100
    cells[:, 60] = 100
    cells[50:70, 60] = 0
    cells[20, :40] = 100
    cells[:20, 40] = 100
    return cells


class Navigation:
    """A planner server with what it needs."""

    def __init__(self, ros: Any, parameters: dict[str, Any] | None = None, **options: Any) -> None:
        self.ros = ros
        self.node = ros.node('tester')
        self.map_publisher = self.node.create_publisher(
            OccupancyGrid, 'map', QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
        )
        self.broadcaster = StaticTransformBroadcaster(self.node)
        self.place_robot(1.0, 3.0)
        self.publish_map(walls())
        self.plans: list[Path] = []
        self.node.create_subscription(Path, 'plan', self.plans.append, 1)
        given = {f'global_costmap.global_costmap.{k}': v for k, v in COSTMAP.items()}
        self.server = ros.make(PlannerServer, {**given, **(parameters or {})}, **options)

    def place_robot(self, x: float, y: float) -> None:
        """Say where the robot is."""
        transforms = []
        for parent, child, place in (('map', 'odom', (0.0, 0.0)), ('odom', 'base_link', (x, y))):
            each = TransformStamped()
            each.header.frame_id, each.child_frame_id = parent, child
            each.transform.translation.x, each.transform.translation.y = place
            each.transform.rotation.w = 1.0
            transforms.append(each)
        self.broadcaster.sendTransform(transforms)

    def publish_map(self, cells: np.ndarray) -> None:
        """Publish a map of 0.05 m a cell."""
        message = OccupancyGrid()
        message.header.frame_id = 'map'
        message.info.resolution = 0.05
        message.info.height, message.info.width = cells.shape
        message.info.origin.orientation.w = 1.0
        message.data = cells.astype(np.int8).ravel().tolist()
        self.map_publisher.publish(message)

    def start(self) -> Navigation:
        """Configure and activate the server."""
        assert self.server.trigger_configure().name == 'SUCCESS'
        assert self.server.trigger_activate().name == 'SUCCESS'
        grid = self.server.costmap
        self.ros.wait_until(lambda: grid.grid.size_x == 120, what='the map')
        self.ros.wait_until(lambda: grid.is_current, what='an update, for which it needs tf')
        return self

    def send(self, kind: Any, goal: Any) -> Any:
        """Send a goal; return its handle."""
        names = {
            ComputePathToPose: 'compute_path_to_pose',
            ComputePathThroughPoses: 'compute_path_through_poses',
        }
        client = ActionClient(self.node, kind, names[kind])
        self.ros.wait_until(client.server_is_ready, what='the action')
        sent = client.send_goal_async(goal)
        self.ros.wait_until(sent.done, what='the goal')
        return sent.result()

    def result(self, handle: Any) -> Any:
        """Return status and result of a goal."""
        future = handle.get_result_async()
        self.ros.wait_until(future.done, what='the result')
        return future.result()

    def plan(self, x: float, y: float, yaw: float = 0.0, **more: Any) -> Any:
        """Plan to a pose; return status and result."""
        frame = more.pop('frame', 'map')
        goal = ComputePathToPose.Goal(goal=stamped(x, y, yaw, frame), **more)
        return self.result(self.send(ComputePathToPose, goal))


def stamped(x: float, y: float, yaw: float = 0.0, frame: str = 'map') -> PoseStamped:
    """Return a pose in a frame."""
    return make_pose_stamped(Pose2D(x, y, yaw), frame, PoseStamped().header.stamp)


PLANNERS = [
    'nav2_navfn_planner::NavfnPlanner',
    'nav2_navfn_planner/NavfnPlanner',
    'nav2_smac_planner::SmacPlanner2D',
    'nav2_smac_planner/SmacPlannerHybrid',
    'nav2_smac_planner::SmacPlannerLattice',
    'nav2_theta_star_planner::ThetaStarPlanner',
]


@pytest.mark.parametrize('kind', PLANNERS)
def test_each_planner_plans_through_the_door(ros, kind):
    """The path begins at the robot, ends at the goal, and keeps off obstacles."""
    told = {'planner_plugins': ['Mine'], 'Mine.plugin': kind}
    if 'Hybrid' in kind:  # beside the wall a car cannot turn without reversing
        told['Mine.motion_model_for_search'] = 'REEDS_SHEPP'
    nav = Navigation(ros, told).start()
    answer = nav.plan(5.0, 0.52, 1.2)
    assert answer.status == GoalStatus.STATUS_SUCCEEDED, answer.result.error_msg
    assert answer.result.error_code == TO_POSE.NONE and answer.result.path.header.frame_id == 'map'
    poses = path_poses(answer.result.path)
    assert poses[0, :2] == pytest.approx([1.0, 3.0])
    assert poses[-1] == pytest.approx([5.0, 0.52, 1.2])
    assert np.hypot(*np.diff(poses[:, :2], axis=0).T).max() < 0.0501
    assert (nav.server.costmap.grid.costs_at(poses[:, :2]) < 253).all()
    steps = np.diff(poses[:, :2], axis=0)
    if 'Hybrid' not in kind and 'Lattice' not in kind:
        assert np.cos(poses[:-1, 2] - np.arctan2(*steps.T[::-1])) == pytest.approx(1.0, abs=1e-6)
    else:
        assert poses[0, 2] == pytest.approx(0.0)
    assert 0 < answer.result.planning_time.sec + answer.result.planning_time.nanosec < 1e9
    ros.wait_until(lambda: nav.plans, what='the plan')
    assert len(nav.plans[-1].poses) == len(poses)


def test_goals_that_cannot_be_reached(ros):
    """Each has its code, and a sentence that helps."""
    nav = Navigation(ros).start()
    for (x, y), code, words in [
        ((1.0, 0.5), TO_POSE.NO_VALID_PATH, 'There is no path'),
        ((9.0, 0.5), TO_POSE.GOAL_OUTSIDE_MAP, 'outside the global costmap'),
    ]:
        answer = nav.plan(x, y)
        assert answer.status == GoalStatus.STATUS_ABORTED
        assert answer.result.error_code == code and words in answer.result.error_msg
    answer = nav.plan(3.02, 1.0, planner_id='GridBased')
    assert answer.status == GoalStatus.STATUS_SUCCEEDED
    end = answer.result.path.poses[-1].pose.position
    assert 0.1 < np.hypot(end.x - 3.02, end.y - 1.0) < 0.5
    ros.call(
        SetParameters,
        'planner_server/set_parameters',
        SetParameters.Request(
            parameters=[Parameter('GridBased.tolerance', value=0.05).to_parameter_msg()]
        ),
    )
    answer = nav.plan(3.02, 1.0)
    assert answer.result.error_code == TO_POSE.GOAL_OCCUPIED
    assert 'in an obstacle' in answer.result.error_msg
    starts = [((-2.0, 1.0), TO_POSE.START_OUTSIDE_MAP), ((3.02, 1.0), TO_POSE.START_OCCUPIED)]
    for (x, y), code in starts:
        answer = nav.plan(5.0, 1.0, start=stamped(x, y), use_start=True)
        assert answer.result.error_code == code and answer.result.error_msg


def test_frames_and_planners_that_nobody_knows(ros):
    """An unknown frame is TF_ERROR; an unknown planner is named with the one that was meant."""
    nav = Navigation(ros).start()
    answer = nav.plan(5.0, 1.0, frame='mars')
    assert answer.result.error_code == TO_POSE.TF_ERROR and 'mars' in answer.result.error_msg
    answer = nav.plan(5.0, 1.0, planner_id='gridbased')
    assert answer.result.error_code == TO_POSE.INVALID_PLANNER
    assert "Did you mean 'GridBased'?" in answer.result.error_msg
    answer = nav.plan(4.0, 0.0, frame='odom')
    assert answer.result.error_code == TO_POSE.NONE or answer.result.error_msg


def test_through_poses(ros):
    """The path passes each pose; without poses, or with one that is cut off, it is aborted."""
    nav = Navigation(ros).start()
    goals = [stamped(2.0, 1.5), stamped(4.0, 3.0), stamped(5.0, 1.0, -1.0)]
    answer = nav.result(
        nav.send(ComputePathThroughPoses, ComputePathThroughPoses.Goal(goals=goals))
    )
    assert answer.status == GoalStatus.STATUS_SUCCEEDED
    poses = path_poses(answer.result.path)
    for each in goals:
        at = each.pose.position
        assert np.hypot(poses[:, 0] - at.x, poses[:, 1] - at.y).min() < 1e-6
    assert poses[-1, 2] == pytest.approx(-1.0)
    assert np.hypot(*np.diff(poses[:, :2], axis=0).T).min() > 1e-6
    answer = nav.result(nav.send(ComputePathThroughPoses, ComputePathThroughPoses.Goal()))
    assert answer.result.error_code == THROUGH.NO_VIAPOINTS_GIVEN
    goals[1] = stamped(1.0, 0.5)
    answer = nav.result(
        nav.send(ComputePathThroughPoses, ComputePathThroughPoses.Goal(goals=goals))
    )
    assert answer.result.error_code == THROUGH.NO_VALID_PATH
    assert answer.result.error_msg.startswith('Goal 2 of 3: ')


def test_path_from_a_start(ros):
    """With use_start the path begins there, and not at the robot."""
    nav = Navigation(ros).start()
    answer = nav.plan(5.0, 1.0, start=stamped(4.0, 3.0), use_start=True)
    assert path_poses(answer.result.path)[0, :2] == pytest.approx([4.0, 3.0])


def test_cancel_and_preemption_while_the_costmap_is_late(ros):
    """A goal that waits for the costmap can be canceled; a newer one takes its place."""
    nav = Navigation(ros, {'costmap_update_timeout': 30.0}).start()
    costmap = nav.server.costmap
    costmap.trigger_deactivate()
    costmap.is_current = False
    goal = ComputePathToPose.Goal(goal=stamped(5.0, 1.0))
    first = nav.send(ComputePathToPose, goal)
    second = nav.send(ComputePathToPose, goal)
    answer = nav.result(first)
    assert answer.status == GoalStatus.STATUS_ABORTED
    assert 'newer goal' in answer.result.error_msg
    canceled = second.cancel_goal_async()
    ros.wait_until(canceled.done, what='the cancellation')
    assert nav.result(second).status == GoalStatus.STATUS_CANCELED
    costmap.trigger_activate()
    assert nav.plan(5.0, 1.0).status == GoalStatus.STATUS_SUCCEEDED


def test_costmap_that_does_not_come(ros):
    """Without a costmap in time the goal ends with TIMEOUT."""
    nav = Navigation(ros, {'costmap_update_timeout': 0.1}).start()
    nav.server.costmap.trigger_deactivate()
    nav.server.costmap.is_current = False
    answer = nav.plan(5.0, 1.0)
    assert answer.result.error_code == TO_POSE.TIMEOUT and 'up to date' in answer.result.error_msg


def test_robot_that_nobody_knows_the_place_of(ros):
    """Without a transform to the robot the goal ends with TF_ERROR."""
    nav = Navigation(
        ros,
        {
            'costmap_update_timeout': 0.1,
            'global_costmap.global_costmap.robot_base_frame': 'lost_link',
        },
    )
    assert nav.server.trigger_configure().name == 'SUCCESS'
    assert nav.server.trigger_activate().name == 'SUCCESS'
    answer = nav.plan(5.0, 1.0)
    assert answer.result.error_code == TO_POSE.TF_ERROR
    assert 'lost_link' in answer.result.error_msg


def test_is_path_valid(ros):
    """A path is valid until a door closes in front of the robot, or when it is behind it."""
    nav = Navigation(ros).start()

    def check(path: Path) -> Any:
        return ros.call(IsPathValid, 'is_path_valid', IsPathValid.Request(path=path))

    path = nav.plan(5.0, 3.0).result.path
    assert check(path).is_valid and not check(path).invalid_pose_indices
    assert not check(Path()).is_valid
    cells = walls()
    cells[:, 60] = 100
    nav.publish_map(cells)
    ros.wait_until(lambda: not check(path).is_valid, what='the closed door')
    crossing = path_poses(path)[check(path).invalid_pose_indices, 0]
    assert ((crossing > 2.7) & (crossing < 3.4)).all()
    nav.place_robot(5.0, 3.0)
    ros.wait_until(lambda: check(path).is_valid, what='the robot beyond the door')


def test_parameters_change_while_it_runs(ros):
    """What is set while the server runs holds for the next path; what is wrong is refused."""
    nav = Navigation(
        ros,
        {'planner_plugins': ['Theta'], 'Theta.plugin': PLANNERS[-1]},
    ).start()

    def put(name: str, value: Any) -> Any:
        request = SetParameters.Request(
            parameters=[Parameter(name, value=value).to_parameter_msg()]
        )
        return ros.call(SetParameters, 'planner_server/set_parameters', request).results[0]

    assert put('Theta.use_final_approach_orientation', True).successful
    poses = path_poses(nav.plan(5.0, 1.0, 3.0).result.path)
    assert poses[-1, 2] == pytest.approx(poses[-2, 2], abs=1e-6)
    refused = put('Theta.how_many_corners', 6)
    assert not refused.successful and '4' in refused.reason
    assert put('Theta.how_many_corners', 4).successful
    assert nav.plan(5.0, 1.0).status == GoalStatus.STATUS_SUCCEEDED


def test_planner_of_an_unknown_type(ros, capfd):
    """Configuring fails with the name that was meant."""
    given = {'planner_plugins': ['A'], 'A.plugin': 'nav2_navfn_planner::NavFnPlaner'}
    nav = Navigation(ros, given)
    assert nav.server.trigger_configure().name == 'FAILURE'
    assert "Did you mean 'nav2_navfn_planner::NavfnPlanner'?" in capfd.readouterr().err


def test_life_in_a_namespace(ros):
    """The server can be cleaned up and configured again, also in a namespace."""
    nav = Navigation(ros, namespace='robot1')
    for _ in range(2):
        assert nav.server.trigger_configure().name == 'SUCCESS'
        assert nav.server.trigger_activate().name == 'SUCCESS'
        assert nav.server.trigger_deactivate().name == 'SUCCESS'
        assert nav.server.trigger_cleanup().name == 'SUCCESS'


def test_start_at_the_goal(ros):
    """A path to where the robot is has its pose, with the goal's yaw."""
    nav = Navigation(ros).start()
    answer = nav.plan(1.0, 3.0, 0.7)
    assert answer.status == GoalStatus.STATUS_SUCCEEDED
    poses = path_poses(answer.result.path)
    assert poses[-1] == pytest.approx([1.0, 3.0, 0.7]) and len(poses) == 1
    assert make_path(poses, 'map', PoseStamped().header.stamp).poses


def test_costmap_that_cannot_be_configured(ros, capfd):
    """A fault in the costmap's parameters fails the server, once and with its reason."""
    wrong = {'global_costmap.global_costmap.static_layer.plugin': 'nav2_costmap_2d::StatcLayer'}
    nav = Navigation(ros, wrong)
    assert nav.server.trigger_configure().name == 'FAILURE'
    nav.server.destroy_node()
    ros.nodes.remove(nav.server)
    said = capfd.readouterr().err
    assert 'nav2_costmap_2d::StaticLayer' in said and 'could not be configured' in said
    assert 'Traceback' not in said and 'Error' not in said, said
