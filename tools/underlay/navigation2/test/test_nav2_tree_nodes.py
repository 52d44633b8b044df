# SPDX-License-Identifier: Apache-2.0
"""Nodes of trees that talk to others, and those that work on paths and goals."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
import sys
from typing import Any

from geometry_msgs.msg import PoseStamped
from nav2_behavior_tree import action_node, BehaviorTree, NodeStatus
from nav2_behavior_tree.ros_interface import LATCHED, OdometrySmoother, RosInterface
from nav2_msgs.srv import GetCost
from nav2_util import LifecycleNode, Pose2D
from nav2_util.geometry import make_path
from nav_msgs.msg import Path as NavPath
import pytest
from rclpy.action.client import ClientGoalHandle
from rclpy.task import Future
from sensor_msgs.msg import BatteryState
from std_msgs.msg import String

sys.path.insert(0, str(Path(__file__).parent))
from navigation_servers import pose, Servers  # noqa: E402, I100

RUNNING, SUCCESS, FAILURE = NodeStatus.RUNNING, NodeStatus.SUCCESS, NodeStatus.FAILURE


def straight(length: int) -> Any:
    """Return a path along x with a pose a metre."""
    points = [Pose2D(float(x), 0.0, 0.0) for x in range(length + 1)]
    return make_path(points, 'map', PoseStamped().header.stamp)


class Lab:
    """Servers, and trees to tick."""

    def __init__(self, ros: Any) -> None:
        self.ros, self.node = ros, ros.node('servers')
        self.servers = Servers(self.node)
        self.owner = ros.make(LifecycleNode, node_name='owner')
        self.odometry = OdometrySmoother(0.3)
        self.interface = RosInterface(self.owner, self.odometry, wait_for_service_timeout_s=0.3)
        _ = self.owner.transforms
        self.now_s = 0.0
        ros.wait_until(lambda: self.interface.can_transform('map', 'base_link'), what='tf')

    def tree(self, body: str, **values: Any) -> BehaviorTree:
        """Make a tree, with values on its blackboard."""
        text = f'<root BTCPP_format="4"><BehaviorTree ID="A">{body}</BehaviorTree></root>'
        tree = BehaviorTree.from_text(text, lambda: self.now_s, self.interface)
        for key, value in values.items():
            tree.blackboard.set(key, value)
        return tree

    def run(self, tree: BehaviorTree) -> NodeStatus:
        """Tick until the end."""
        ends: list[NodeStatus] = []

        def tick() -> bool:
            ends.append(tree.tick())
            return ends[-1] is not RUNNING

        self.ros.wait_until(tick, what='the end of the tree')
        return ends[-1]

    def move(self, x: float) -> None:
        """Put the robot somewhere, and wait until that is known."""
        self.servers.move(x, 0.0)
        self.ros.wait_until(lambda: abs(self.interface.robot_pose().x - x) < 1e-6)

    def close(self) -> None:
        self.interface.close()
        self.servers.close()


@pytest.fixture
def lab(ros: Any) -> Iterator[Lab]:
    """Return a lab."""
    made = Lab(ros)
    yield made
    made.close()


def test_paths_are_cut_and_measured(lab: Lab) -> None:
    """At their end, around the robot, and pose by pose."""
    tree = lab.tree('<TruncatePath input_path="{path}" output_path="{out}"/>', path=straight(5))
    assert tree.tick() is SUCCESS
    assert [each.pose.position.x for each in tree.blackboard.get('out').poses] == [0, 1, 2, 3, 4]
    lab.move(3.2)
    body = (
        '<TruncatePathLocal input_path="{path}" output_path="{out}" distance_forward="2" '
        'distance_backward="1"/>'
    )
    tree = lab.tree(body, path=straight(9))
    assert tree.tick() is SUCCESS
    assert [each.pose.position.x for each in tree.blackboard.get('out').poses] == [2, 3, 4, 5]
    tree = lab.tree('<GetPoseFromPath path="{path}" index="-1" pose="{out}"/>', path=straight(4))
    assert tree.tick() is SUCCESS and tree.blackboard.get('out').pose.position.x == 4.0
    tree = lab.tree('<GetPoseFromPath path="{path}" index="9" pose="{out}"/>', path=straight(4))
    assert tree.tick() is FAILURE and 'none with index 9' in str(tree.failure)


def test_paths_are_joined(lab: Lab) -> None:
    """One after the other, in one frame; one of them may be missing."""
    join = '<ConcatenatePaths input_path1="{a}" input_path2="{b}" output_path="{out}"/>'
    tree = lab.tree(join, a=straight(2), b=straight(1))
    assert tree.tick() is SUCCESS
    assert [each.pose.position.x for each in tree.blackboard.get('out').poses] == [0, 1, 2, 0, 1]
    assert tree.blackboard.get('out').header.frame_id == 'map'
    tree = lab.tree(join.replace(' input_path1="{a}"', ''), b=straight(1))
    assert tree.tick() is SUCCESS and len(tree.blackboard.get('out').poses) == 2
    tree = lab.tree(join, a=NavPath(), b=NavPath())
    assert tree.tick() is FAILURE and 'Both paths are empty' in str(tree.failure)
    elsewhere = straight(1)
    elsewhere.header.frame_id = 'odom'
    tree = lab.tree(join, a=straight(1), b=elsewhere)
    assert tree.tick() is FAILURE and "frames, 'map' and 'odom'" in str(tree.failure)


def test_poses_are_compared_with_that_of_the_robot(lab: Lab) -> None:
    """GetCurrentPose writes the robot's pose; ArePosesNear compares two."""
    lab.move(1.5)
    body = (
        '<Sequence><GetCurrentPose current_pose="{here}"/>'
        '<ArePosesNear ref_pose="{here}" target_pose="{goal}" tolerance="0.10"/></Sequence>'
    )
    assert lab.tree(body, goal=pose(1.55)).tick() is SUCCESS
    tree = lab.tree(body, goal=pose(1.7))
    assert tree.tick() is FAILURE
    here = tree.blackboard.get('here')
    assert (here.header.frame_id, here.pose.position.x) == ('map', pytest.approx(1.5))
    in_robot = pose(0.05)
    in_robot.header.frame_id = 'base_link'
    assert lab.tree(body, goal=in_robot).tick() is SUCCESS


def test_a_much_longer_path_near_the_goal_is_noticed(lab: Lab) -> None:
    """The first path is not, nor a new path to another goal."""
    tree = lab.tree('<PathLongerOnApproach><AlwaysFailure/></PathLongerOnApproach>')
    tree.blackboard.set('path', straight(2))
    assert tree.tick() is SUCCESS
    points = [Pose2D(0.0, 0.0, 0.0), Pose2D(0.0, 5.0, 0.0), Pose2D(2.0, 0.0, 0.0)]
    detour = make_path(points, 'map', PoseStamped().header.stamp)
    tree.blackboard.set('path', detour)
    assert tree.tick() is FAILURE
    assert tree.tick() is SUCCESS
    tree.blackboard.set('path', straight(9))
    assert tree.tick() is SUCCESS


def test_the_distance_controller_goes_by_the_way_of_the_robot(lab: Lab) -> None:
    """It runs its child at first and after each metre."""
    child = '<Script code="n += 1"/>'
    tree = lab.tree(
        f'<PipelineSequence><DistanceController distance="1.0">{child}</DistanceController>'
        '<KeepRunningUntilFailure><AlwaysSuccess/></KeepRunningUntilFailure></PipelineSequence>',
        n=0,
    )
    counts = []
    for x in (0.0, 0.5, 1.0, 1.5, 2.1):
        lab.move(x)
        assert tree.tick() is RUNNING
        counts.append(tree.blackboard.get('n'))
    assert counts == [1, 1, 2, 2, 3]


def test_the_speed_controller_goes_by_the_speed(lab: Lab) -> None:
    """Once a second at full speed, every ten seconds at rest."""
    child = '<SpeedController><Script code="n += 1"/></SpeedController>'
    tree = lab.tree(
        f'<PipelineSequence>{child}'
        '<KeepRunningUntilFailure><AlwaysSuccess/></KeepRunningUntilFailure></PipelineSequence>',
        n=0,
    )
    counts = []
    for now_s, speed in ((0.0, 0.0), (5.0, 0.0), (10.0, 0.5), (11.0, 0.5), (12.0, 0.5)):
        lab.now_s = now_s
        lab.odometry.add(now_s, speed, 0.0)
        tree.tick()
        counts.append(tree.blackboard.get('n'))
    assert counts == [1, 1, 2, 3, 4]


def test_conditions_about_the_robot(lab: Lab) -> None:
    """Goal, way, transforms, battery."""
    goal = pose(0.2)
    assert lab.tree('<GoalReached goal="{goal}"/>', goal=goal).tick() is SUCCESS
    assert lab.tree('<GoalReached goal="{goal}"/>', goal=pose(1.0)).tick() is FAILURE
    missing = lab.tree('<GoalReached goal="{gaol}"/>')
    assert missing.tick() is FAILURE and "nothing has set '{gaol}'" in str(missing.failure)
    known = '<TransformAvailable parent="map" child="base_link"/>'
    assert lab.tree(known).tick() is SUCCESS
    assert lab.tree(known.replace('map', 'moon')).tick() is FAILURE
    assert lab.tree('<IsStuck/>').tick() is FAILURE
    tree = lab.tree(
        '<ReactiveFallback><DistanceTraveled distance="1"/><Sleep msec="9"/></ReactiveFallback>'
    )
    assert tree.tick() is RUNNING
    lab.move(1.2)
    assert tree.tick() is SUCCESS
    low = lab.tree('<IsBatteryLow min_battery="0.3" battery_topic="battery"/>')
    charging = lab.tree('<IsBatteryCharging battery_topic="battery"/>')
    assert low.tick() is FAILURE and charging.tick() is FAILURE
    publisher = lab.node.create_publisher(BatteryState, 'battery', 1)
    lab.ros.wait_until(publisher.get_subscription_count)
    publisher.publish(BatteryState(percentage=0.2, power_supply_status=1))
    lab.ros.wait_until(lambda: low.tick() is SUCCESS)
    assert charging.tick() is SUCCESS


def test_standing_still_takes_a_while(lab: Lab) -> None:
    """In motion, also sideways or on the spot, the condition fails and starts anew."""
    tree = lab.tree('<IsStopped velocity_threshold="0.02" duration_stopped="500"/>')

    def after(duration_s: float, *velocity: float) -> NodeStatus:
        lab.now_s += duration_s
        lab.odometry.add(lab.now_s, *velocity)
        return tree.tick()

    assert after(1.0, 0.0, 0.0, 0.3) is FAILURE
    assert after(1.0, 0.0, 0.3) is FAILURE
    assert after(1.0, 0.01, 0.0) is RUNNING
    assert after(0.4, 0.0, 0.0) is RUNNING
    assert after(0.2, 0.0, 0.0) is SUCCESS
    assert after(1.0, -0.3, 0.0) is FAILURE
    assert after(1.0, 0.0, 0.0) is RUNNING


def test_topics_choose_planners_and_update_goals(lab: Lab) -> None:
    """A selector has a default; the goal updater takes newer goals."""
    tree = lab.tree('<PlannerSelector default_planner="A" selected_planner="{p}"/>')
    assert tree.tick() is SUCCESS and tree.blackboard.get('p') == 'A'
    lab.node.create_publisher(String, 'planner_selector', LATCHED).publish(String(data='B'))
    lab.ros.wait_until(lambda: tree.tick() and tree.blackboard.get('p') == 'B')
    empty = lab.tree('<GoalCheckerSelector selected_goal_checker="{g}"/>')
    assert empty.tick() is FAILURE and 'no default' in str(empty.failure)
    tree = lab.tree(
        '<GoalUpdater input_goal="{goal}" output_goal="{new}"><AlwaysSuccess/></GoalUpdater>',
        goal=pose(1.0),
    )
    assert tree.tick() is SUCCESS and tree.blackboard.get('new').pose.position.x == 1.0
    publisher = lab.node.create_publisher(PoseStamped, 'goal_update', 1)
    lab.ros.wait_until(publisher.get_subscription_count)
    publisher.publish(pose(2.0))
    lab.ros.wait_until(lambda: tree.tick() and tree.blackboard.get('new').pose.position.x == 2.0)


def test_occupied_goals_are_left_out(lab: Lab) -> None:
    """The costmap is asked for each; without any free one the node fails."""

    def cost(request: Any, response: Any) -> Any:
        response.cost = 254.0 if request.x > 1.5 else 10.0
        return response

    lab.node.create_service(GetCost, '/global_costmap/get_cost_global_costmap', cost)
    tree = lab.tree('<RemoveInCollisionGoals/>', goals=[pose(1.0), pose(2.0), pose(0.0)])
    assert lab.run(tree) is SUCCESS
    assert [each.pose.position.x for each in tree.blackboard.get('goals')] == [1.0, 0.0]
    tree = lab.tree('<RemoveInCollisionGoals/>', goals=[pose(2.0)])
    assert lab.run(tree) is FAILURE and 'All goals are occupied' in str(tree.failure)


def test_behaviors_get_what_their_ports_say(lab: Lab) -> None:
    """And count as recoveries, if they do not say otherwise."""
    tree = lab.tree(
        '<Sequence><Spin spin_dist="-1.0" time_allowance="3.5"/><Spin is_recovery="false"/>'
        '<BackUp backup_dist="0.3" backup_speed="0.1"/><Wait wait_duration="0.5"/>'
        '<DriveOnHeading dist_to_travel="0.4" error_code_id="{e}"/><AssistedTeleop/></Sequence>'
    )
    assert lab.run(tree) is SUCCESS
    goals = lab.servers.goals
    assert goals['spin'][0].target_yaw == -1.0
    assert goals['spin'][0].time_allowance.sec == 3
    assert goals['backup'][0].speed == pytest.approx(0.1)
    assert goals['wait'][0].time.nanosec == 500_000_000
    assert goals['drive_on_heading'][0].target.x == pytest.approx(0.4)
    assert tree.blackboard.get('number_recoveries') == 3
    assert tree.blackboard.get('e') == 0


def test_failures_are_written_to_the_blackboard(lab: Lab) -> None:
    """Code and sentence; a success clears them."""
    lab.servers.scripts['smooth_path'] = [(504, 'Too sharp.'), None]
    body = (
        '<SmoothPath unsmoothed_path="{path}" smoothed_path="{smooth}" error_code_id="{code}" '
        'error_msg="{text}"/>'
    )
    tree = lab.tree(body, path=straight(2))
    assert lab.run(tree) is FAILURE
    assert tree.blackboard.get('code') == 504 and 'Too sharp.' in tree.blackboard.get('text')
    assert lab.run(tree) is SUCCESS
    assert (tree.blackboard.get('code'), tree.blackboard.get('text')) == (0, '')


def test_what_runs_can_be_canceled_from_a_tree(lab: Lab) -> None:
    """The cancel nodes end goals of others; none to end is no failure."""
    lab.servers.scripts['follow_path'] = ['hang']
    follow = lab.tree('<FollowPath/>', path=straight(2))
    assert follow.tick() is RUNNING
    lab.ros.wait_until(lambda: follow.tick() and 'follow_path' in lab.servers.calls)
    lab.ros.spin(0.1)
    assert lab.run(lab.tree('<CancelControl/>')) is SUCCESS
    lab.ros.wait_until(lambda: 'follow_path' in lab.servers.canceled)
    assert lab.run(follow) is SUCCESS
    assert lab.run(lab.tree('<CancelSpin/>')) is SUCCESS


def test_a_goal_that_is_halted_before_it_is_accepted_is_canceled(lab: Lab) -> None:
    """As soon as the server answers."""
    lab.servers.scripts['spin'] = ['hang']
    tree = lab.tree('<Spin/>')
    assert tree.tick() is RUNNING
    tree.halt()
    lab.ros.wait_until(lambda: 'spin' in lab.servers.canceled)


def test_a_result_that_is_lost_is_asked_for_again(
    lab: Lab, monkeypatch: pytest.MonkeyPatch
) -> None:
    """From time to time, until an answer comes."""
    requests: list[Any] = []
    ask = ClientGoalHandle.get_result_async

    def lose_the_first(handle: Any) -> Any:
        requests.append(handle)
        return Future() if len(requests) == 1 else ask(handle)

    monkeypatch.setattr(ClientGoalHandle, 'get_result_async', lose_the_first)
    monkeypatch.setattr(action_node, '_ASK_AGAIN_S', 0.1)
    assert lab.run(lab.tree('<Spin/>')) is SUCCESS
    assert len(requests) == 2


def test_missing_services_are_named(lab: Lab) -> None:
    """After the time that is given to them."""
    tree = lab.tree('<ClearCostmapAroundRobot service_name="nowhere" reset_distance="2"/>')
    assert lab.run(tree) is FAILURE and "There is no service 'nowhere'" in str(tree.failure)
    tree = lab.tree('<DockRobot dock_id="home"/>')
    assert lab.run(tree) is FAILURE
    assert "There is no server of 'dock_robot'" in str(tree.failure)


EXAMPLES = [
    '<RateController hz="1.0">{}</RateController>',
    '<DistanceController distance="0.5" global_frame="map" robot_base_frame="base_link">{}'
    '</DistanceController>',
    '<SpeedController min_rate="0.1" max_rate="1.0" min_speed="0.0" max_speed="0.5" '
    'filter_duration="0.3">{}</SpeedController>',
    '<GoalUpdater input_goal="{goal}" output_goal="{updated_goal}">{}</GoalUpdater>',
    '<GoalUpdatedController>{}</GoalUpdatedController>',
    '<SingleTrigger>{}</SingleTrigger>',
    '<PathLongerOnApproach path="{path}" prox_len="3.0" length_factor="2.0">{}'
    '</PathLongerOnApproach>',
    '<IsBatteryLow min_battery="0.5" battery_topic="/battery_status" is_voltage="false"/>',
    '<IsPathValid server_timeout="10" path="{path}"/>',
    '<DistanceTraveled distance="0.8" global_frame="map" robot_base_frame="base_link"/>',
    '<TransformAvailable parent="odom" child="base_link"/>',
    '<PathExpiringTimer seconds="15" path="{path}"/>',
    '<AreErrorCodesPresent error_code="{error_code}" error_codes_to_check="{codes}"/>',
    '<ComputePathToPose goal="{goal}" path="{path}" planner_id="GridBased" '
    'server_name="ComputePathToPose" server_timeout="10" error_code_id="{e}" error_msg="{m}"/>',
    '<ComputePathThroughPoses goals="{goals}" path="{path}" planner_id="GridBased"/>',
    '<SmoothPath unsmoothed_path="{path}" smoothed_path="{path}" max_smoothing_duration="3.0" '
    'smoother_id="simple_smoother" check_for_collisions="false" smoothing_duration="{d}" '
    'was_completed="{c}" error_code_id="{e}"/>',
    '<FollowPath path="{path}" controller_id="FollowPath" goal_checker_id="precise" '
    'progress_checker_id="checker" server_name="FollowPath" server_timeout="10"/>',
    '<NavigateToPose goal="{goal}" server_name="NavigateToPose" server_timeout="10" '
    'error_code_id="{e}" behavior_tree="some.xml"/>',
    '<ClearCostmapExceptRegion name="ClearLocal" reset_distance="1.0" '
    'service_name="local_costmap/clear_except_local_costmap"/>',
    '<ClearCostmapAroundRobot name="ClearLocal" reset_distance="1.0" '
    'service_name="local_costmap/clear_around_local_costmap"/>',
    '<ReinitializeGlobalLocalization service_name="reinitialize_global_localization"/>',
    '<RemovePassedGoals radius="0.6" input_goals="{goals}" output_goals="{goals}"/>',
    '<RemoveInCollisionGoals input_goals="{goals}" output_goals="{goals}" '
    'cost_threshold="254.0" use_footprint="true" '
    'service_name="/global_costmap/get_cost_global_costmap"/>',
    '<TruncatePathLocal input_path="{path}" output_path="{local}" distance_forward="3.5" '
    'distance_backward="2.0" robot_frame="base_link"/>',
    '<ProgressCheckerSelector selected_progress_checker="{s}" '
    'default_progress_checker="precise" topic_name="progress_checker_selector"/>',
    '<BackUp backup_dist="-0.2" backup_speed="0.05" server_name="backup_server" '
    'server_timeout="10" disable_collision_checks="false" error_code_id="{e}"/>',
    '<AssistedTeleop is_recovery="false" time_allowance="10.0" error_code_id="{e}"/>',
    '<CancelControl server_name="FollowPath" server_timeout="10"/>',
    '<DockRobot dock_id="{dock_id}" error_code_id="{e}"/>',
    '<UndockRobot dock_type="{dock_type}"/>',
    '<GetPoseFromPath path="{path}" pose="{p}" index="-1"/>',
    '<ConcatenatePaths input_path1="{main_path}" input_path2="{last_mile_path}" '
    'output_path="{path}"/>',
    '<GetCurrentPose current_pose="{current_pose}"/>',
    '<ArePosesNear ref_pose="{init_pose}" target_pose="{goal_pose}" tolerance="0.10"/>',
    '<GlobalUpdatedGoal/>',
    '<InitialPoseReceived/>',
    '<WouldASmootherRecoveryHelp error_code="{smoother_error_code}"/>',
]


def test_what_the_documentation_shows_can_be_read(lab: Lab) -> None:
    """Examples of the configuration guide, with their ports."""
    for body in EXAMPLES:
        tree = lab.tree(body.replace('{}', '<AlwaysSuccess/>'))
        assert len(list(tree.nodes())) in (1, 2)
