# SPDX-License-Identifier: Apache-2.0
"""The navigator with servers that do what a test says."""

from __future__ import annotations

from collections.abc import Iterator
import glob
import os
from pathlib import Path
import sys
from typing import Any

from action_msgs.msg import GoalStatus
from builtin_interfaces.msg import Time
from geometry_msgs.msg import PoseStamped
from nav2_behavior_tree import BehaviorTree
from nav2_behavior_tree.ros_interface import OdometrySmoother, RosInterface
from nav2_behavior_tree.tree_xml import read_tree_file
from nav2_bt_navigator import BtNavigator, TREE_FOLDER
from nav2_msgs.action import NavigateThroughPoses, NavigateToPose
from nav2_msgs.msg import BehaviorTreeLog
from nav2_util import LifecycleNode
import pytest
from rosgraph_msgs.msg import Clock

sys.path.insert(0, str(Path(__file__).parent))
from navigation_servers import Client, pose, Servers  # noqa: E402, I100

SUCCEEDED = GoalStatus.STATUS_SUCCEEDED
ABORTED = GoalStatus.STATUS_ABORTED
CANCELED = GoalStatus.STATUS_CANCELED
NO_VALID_PATH = 208
GOAL_OCCUPIED = 206


class Stack:
    """A navigator, its servers and a client."""

    def __init__(self, ros: Any, parameters: dict[str, Any], missing: tuple[str, ...] = ()):
        self.ros, self._clock = ros, None
        self.node = ros.node('servers')
        self.servers = Servers(self.node, missing)
        self.navigator = ros.make(BtNavigator, parameters)
        self.navigator.trigger_configure()
        for each in self.navigator.companions:
            if each.executor is None:
                ros.executor.add_node(each)
        self.navigator.trigger_activate()
        self.client = Client(ros, ros.node('client'), NavigateToPose, 'navigate_to_pose')
        ros.wait_until(
            lambda: self.navigator.ros.can_transform('map', 'base_link'), what='the transform'
        )

    def set_clock(self, time_s: int) -> None:
        """Set simulated time, which stands until it is set again."""
        if self._clock is None:
            self._clock = self.node.create_publisher(Clock, '/clock', 1)
            self.ros.wait_until(self._clock.get_subscription_count)
        self._clock.publish(Clock(clock=Time(sec=time_s)))
        self.ros.wait_until(lambda: self.navigator.ros.now_s() == time_s)

    def close(self) -> None:
        self.client.close()
        self.servers.close()


@pytest.fixture
def make_stack(ros: Any) -> Iterator[Any]:
    """Return a function that makes a stack."""
    made: list[Stack] = []

    def make(missing: tuple[str, ...] = (), **parameters: Any) -> Stack:
        made.append(Stack(ros, parameters, missing))
        return made[-1]

    yield make
    for each in made:
        each.close()


@pytest.fixture
def stack(make_stack: Any) -> Stack:
    """Return a stack with its defaults."""
    return make_stack()


def test_a_goal_is_reached(stack: Stack) -> None:
    """Plan, follow, succeed; feedback tells how far it is."""
    stack.servers.scripts['follow_path'] = [lambda: len(stack.client.feedback) >= 12]
    handle = stack.client.send(pose=pose(3.0, 4.0))
    status, result = stack.client.wait(handle)
    assert (status, result.error_code, result.error_msg) == (SUCCEEDED, 0, '')
    feedback = stack.client.feedback[-1]
    assert feedback.distance_remaining == pytest.approx(5.0)
    took_s = feedback.navigation_time.sec + 1e-9 * feedback.navigation_time.nanosec
    assert took_s > 0.5
    assert feedback.current_pose.header.frame_id == 'map'
    assert 12 <= len(stack.client.feedback) <= 10.0 * took_s + 7.0  # ten times a second at most


def test_it_plans_once_a_second_and_updates_the_path(stack: Stack) -> None:
    """A newer path is given to the controller while it drives."""
    stack.servers.scripts['follow_path'] = ['hang', 'hang', None]
    status, _ = stack.client.wait(stack.client.send(pose=pose(1.0)))
    assert status == SUCCEEDED
    assert len(stack.servers.goals['compute_path_to_pose']) == 3
    assert len(stack.servers.goals['follow_path']) == 3


def test_a_goal_that_cannot_be_helped_ends_at_once(stack: Stack) -> None:
    """The planner's code and sentence are those of the result."""
    stack.servers.scripts['compute_path_to_pose'] = [(GOAL_OCCUPIED, 'A wall is there.')]
    status, result = stack.client.wait(stack.client.send(pose=pose(1.0)))
    assert (status, result.error_code) == (ABORTED, GOAL_OCCUPIED)
    assert result.error_msg == 'The planner found no way to the goal: A wall is there.'
    plan = 'compute_path_to_pose'
    assert stack.servers.calls == [plan, 'clear global', plan]  # no recovery that takes time


def test_an_unreachable_goal_ends_after_bounded_recoveries(stack: Stack) -> None:
    """Each recovery is tried once; then it aborts with the planner's reason."""
    stack.servers.scripts['compute_path_to_pose'] = [(NO_VALID_PATH, 'The door is closed.')]
    stack.servers.scripts['wait'] = [0.2]
    status, result = stack.client.wait(stack.client.send(pose=pose(1.0)))
    assert (status, result.error_code) == (ABORTED, NO_VALID_PATH)
    assert 'The door is closed.' in result.error_msg
    calls = stack.servers.calls
    assert [calls.count(each) for each in ('wait', 'spin', 'backup')] == [1, 1, 1]
    assert calls.count('compute_path_to_pose') == 10


def test_recoveries_that_fail_are_passed_over(stack: Stack) -> None:
    """A spin that hits something is followed by the next recovery, then driving succeeds."""
    stack.servers.scripts['follow_path'] = [(105, 'Stuck.')] * 5 + [None]
    stack.servers.scripts['spin'] = [(703, 'No room.')]
    status, _ = stack.client.wait(stack.client.send(pose=pose(1.0)))
    assert status == SUCCEEDED
    assert {'clear local', 'wait'} <= set(stack.servers.calls)
    recoveries = max(each.number_of_recoveries for each in stack.client.feedback)
    assert recoveries > 0


def test_a_missing_server_is_named(make_stack: Any) -> None:
    """Without a planner, the goal aborts and says so."""
    stack = make_stack(missing=('compute_path_to_pose',), wait_for_service_timeout=300)
    stack.servers.scripts['wait'] = [0.1]
    status, result = stack.client.wait(stack.client.send(pose=pose(1.0)))
    assert status == ABORTED
    assert "There is no server of 'compute_path_to_pose'" in result.error_msg
    assert result.error_code == 200


@pytest.mark.parametrize('phase', ['compute_path_to_pose', 'follow_path', 'wait'])
def test_canceling_stops_what_runs(make_stack: Any, phase: str) -> None:
    """In each phase the action that runs is canceled at once: simulated time stands meanwhile."""
    stack = make_stack(use_sim_time=True)
    stack.set_clock(100)
    scripts = stack.servers.scripts
    scripts[phase] = ['hang']
    if phase == 'wait':
        scripts['compute_path_to_pose'] = [(NO_VALID_PATH, 'No.')]
    handle = stack.client.send(pose=pose(1.0))
    stack.ros.wait_until(lambda: phase in stack.servers.calls)
    handle.cancel_goal_async()
    status, _ = stack.client.wait(handle)
    assert status == CANCELED
    stack.ros.wait_until(lambda: phase in stack.servers.canceled)
    calls = len(stack.servers.calls)
    stack.ros.spin(0.1)
    assert len(stack.servers.calls) == calls


def test_a_newer_goal_takes_over_without_a_stop(make_stack: Any) -> None:
    """The old goal ends, the controller gets a new path at once, and is not canceled."""
    stack = make_stack(use_sim_time=True)
    stack.set_clock(100)  # as it stands, nothing is planned because a second has passed
    stack.servers.scripts['follow_path'] = ['hang', 0.1]
    first = stack.client.send(pose=pose(1.0))
    stack.ros.wait_until(lambda: 'follow_path' in stack.servers.calls)
    second = stack.client.send(pose=pose(2.0))
    status, result = stack.client.wait(first)
    assert status == ABORTED and 'newer goal' in result.error_msg
    stack.ros.wait_until(lambda: len(stack.servers.goals['compute_path_to_pose']) == 2)
    assert stack.client.wait(second)[0] == SUCCEEDED
    assert stack.servers.canceled == []
    assert stack.servers.goals['follow_path'][-1].path.poses[-1].pose.position.x == 2.0


def test_a_newer_goal_with_another_tree_begins_anew(stack: Stack) -> None:
    """The tree that runs is halted, and the new one is run."""
    stack.servers.scripts['follow_path'] = ['hang', None]
    first = stack.client.send(pose=pose(1.0))
    stack.ros.wait_until(lambda: 'follow_path' in stack.servers.calls)
    second = stack.client.send(pose=pose(2.0), behavior_tree='navigate_w_replanning_time.xml')
    assert stack.client.wait(first)[0] == ABORTED
    assert stack.client.wait(second)[0] == SUCCEEDED


def test_a_topic_starts_a_navigation(stack: Stack) -> None:
    """A pose on goal_pose is a goal."""
    publisher = stack.node.create_publisher(PoseStamped, 'goal_pose', 1)
    stack.ros.wait_until(publisher.get_subscription_count)
    publisher.publish(pose(5.0))
    stack.ros.wait_until(lambda: stack.servers.goals['compute_path_to_pose'])
    goal = stack.servers.goals['compute_path_to_pose'][0].goal
    assert goal.pose.position.x == 5.0


def test_goals_that_make_no_sense_are_aborted_with_a_sentence(stack: Stack) -> None:
    """Unknown frames and trees that cannot be read."""
    status, result = stack.client.wait(stack.client.send(pose=pose(1.0, frame='moon')))
    assert (status, result.error_code) == (ABORTED, 9002) and 'moon' in result.error_msg
    status, result = stack.client.wait(stack.client.send(pose=pose(1.0, frame='')))
    assert status == ABORTED and 'frame_id' in result.error_msg
    status, result = stack.client.wait(
        stack.client.send(pose=pose(1.0), behavior_tree='/nowhere.xml')
    )
    assert (status, result.error_code) == (ABORTED, 9001) and '/nowhere.xml' in result.error_msg


def test_a_tree_of_ones_own_is_run_and_its_errors_are_told(stack: Stack, tmp_path: Any) -> None:
    """A goal may bring its tree; a wrong one is told with file and line."""
    path = tmp_path / 'own.xml'
    text = '<root BTCPP_format="4">\n<BehaviorTree ID="A">\n<{} {}/></BehaviorTree></root>'
    path.write_text(text.format('Spin', 'spin_dist="0.5"'))
    status, _ = stack.client.wait(stack.client.send(pose=pose(1.0), behavior_tree=str(path)))
    assert status == SUCCEEDED and stack.servers.goals['spin'][0].target_yaw == 0.5
    path.write_text(text.format('Spin', 'spin_distance="0.5"'))
    os.utime(path, (1, 1))
    status, result = stack.client.wait(stack.client.send(pose=pose(1.0), behavior_tree=str(path)))
    assert status == ABORTED
    assert f"{path}:3: 'Spin' has no port 'spin_distance'. Did you mean 'spin_dist'?" in (
        result.error_msg
    )


def test_poses_on_the_way_are_left_out_when_passed(stack: Stack) -> None:
    """The planner gets the poses that are left; feedback counts them."""
    client = Client(stack.ros, stack.node, NavigateThroughPoses, 'navigate_through_poses')
    stack.servers.scripts['follow_path'] = ['hang']
    handle = client.send(poses=[pose(1.0), pose(2.0), pose(3.0)])
    stack.ros.wait_until(lambda: client.feedback and client.feedback[-1].distance_remaining > 2.9)
    assert client.feedback[-1].number_of_poses_remaining == 3
    stack.servers.move(1.0, 0.0)
    stack.ros.wait_until(lambda: client.feedback[-1].number_of_poses_remaining == 2)
    assert not stack.client.send(pose=pose(1.0)).accepted
    handle.cancel_goal_async()
    assert client.wait(handle)[0] == CANCELED
    status, result = client.wait(client.send(poses=[]))
    assert status == ABORTED and 'no poses' in result.error_msg
    client.close()


def test_changes_of_the_tree_are_published(stack: Stack) -> None:
    """behavior_tree_log tells names, numbers and states."""
    logs: list[BehaviorTreeLog] = []
    stack.node.create_subscription(BehaviorTreeLog, 'behavior_tree_log', logs.append, 10)
    stack.ros.wait_until(lambda: stack.node.count_subscribers('behavior_tree_log'))
    stack.ros.spin(0.2)
    stack.client.wait(stack.client.send(pose=pose(1.0)))
    stack.ros.wait_until(lambda: logs)
    event = logs[0].event_log[0]
    assert (event.node_name, event.previous_status) == ('NavigateWithRecovery', 'IDLE')
    assert event.current_status == 'RUNNING' and event.uid == 1


def test_deactivating_ends_the_goal(stack: Stack) -> None:
    """The goal aborts with a sentence, and what runs is canceled."""
    stack.servers.scripts['follow_path'] = ['hang']
    handle = stack.client.send(pose=pose(1.0))
    stack.ros.wait_until(lambda: 'follow_path' in stack.servers.calls)
    stack.navigator.trigger_deactivate()
    status, result = stack.client.wait(handle)
    assert status == ABORTED and 'deactivated' in result.error_msg
    stack.ros.wait_until(lambda: 'follow_path' in stack.servers.canceled)
    assert not stack.client.send(pose=pose(1.0)).accepted
    stack.navigator.trigger_activate()
    stack.servers.scripts['follow_path'] = [None]
    assert stack.client.wait(stack.client.send(pose=pose(1.0)))[0] == SUCCEEDED
    stack.navigator.trigger_deactivate()
    stack.navigator.trigger_cleanup()


@pytest.mark.parametrize(
    'parameters, words',
    [
        ({'default_nav_to_pose_bt_xml': '/missing.xml'}, '/missing.xml'),
        ({'navigators': ['dance']}, 'dance.plugin'),
        (
            {'navigate_to_pose.plugin': 'nav2_bt_navigator::NavigateToPosesNavigator'},
            'Did you mean',
        ),
    ],
)
def test_wrong_parameters_are_told(
    ros: Any, capfd: pytest.CaptureFixture[str], parameters: dict[str, Any], words: str
) -> None:
    """Configuring fails with a sentence."""
    navigator = ros.make(BtNavigator, parameters)
    navigator.trigger_configure()
    assert words in capfd.readouterr().err
    assert navigator.navigators == []


def test_all_trees_of_the_package_can_be_read(ros: Any) -> None:
    """Under their official names."""
    node = ros.make(LifecycleNode, node_name='reader')
    interface = RosInterface(node, OdometrySmoother(0.3))
    files = glob.glob(os.path.join(TREE_FOLDER, '*.xml'))
    assert len(files) >= 10
    for file in files:
        BehaviorTree(read_tree_file(file), interface.now_s, interface)
    interface.close()


@pytest.mark.parametrize(
    'tree',
    [
        'navigate_w_replanning_only_if_path_becomes_invalid.xml',
        'nav_to_pose_with_consistent_replanning_and_if_path_becomes_invalid.xml',
    ],
)
def test_a_path_that_stays_free_is_kept(stack: Stack, tree: str) -> None:
    """It plans once, and again when the path is no longer free."""
    stack.servers.scripts['follow_path'] = ['hang']
    handle = stack.client.send(pose=pose(1.0), behavior_tree=tree)
    stack.ros.wait_until(lambda: stack.servers.calls.count('is valid') >= 2)
    assert stack.servers.calls.count('compute_path_to_pose') == 1
    stack.servers.path_is_valid = False
    stack.ros.wait_until(lambda: stack.servers.calls.count('compute_path_to_pose') == 2)
    handle.cancel_goal_async()
    assert stack.client.wait(handle)[0] == CANCELED


def test_a_newer_goal_ends_a_recovery(stack: Stack) -> None:
    """What helps the old goal is canceled, and the new one is planned at once."""
    stack.servers.scripts['compute_path_to_pose'] = [(NO_VALID_PATH, 'No.')] * 4 + [None]
    stack.servers.scripts['wait'] = ['hang']
    first = stack.client.send(pose=pose(1.0))
    stack.ros.wait_until(lambda: 'wait' in stack.servers.calls)
    second = stack.client.send(pose=pose(2.0))
    assert stack.client.wait(second)[0] == SUCCEEDED
    assert stack.client.wait(first)[0] == ABORTED
    assert stack.servers.canceled == ['wait']


def test_it_can_be_brought_up_and_down_many_times(stack: Stack) -> None:
    """A goal works each time, and nothing is left behind."""
    navigator = stack.navigator
    counts = []
    for _ in range(10):
        stack.ros.wait_until(stack.client._client.server_is_ready)
        assert stack.client.wait(stack.client.send(pose=pose(1.0)))[0] == SUCCEEDED
        counts.append((len(list(navigator.waitables)), len(list(navigator.subscriptions))))
        assert navigator.trigger_deactivate().name == 'SUCCESS'
        assert navigator.trigger_cleanup().name == 'SUCCESS'
        assert navigator.trigger_configure().name == 'SUCCESS'
        assert navigator.trigger_activate().name == 'SUCCESS'
        ready = navigator.ros
        stack.ros.wait_until(lambda ready=ready: ready.can_transform('map', 'base_link'))
    assert counts[0] == counts[-1]


def test_it_works_in_simulated_time(make_stack: Any) -> None:
    """Also while that stands: goals can be canceled; paths are planned by that clock."""
    stack = make_stack(use_sim_time=True)
    stack.set_clock(100)
    stack.servers.scripts['follow_path'] = ['hang']
    handle = stack.client.send(pose=pose(1.0))
    stack.ros.wait_until(lambda: 'follow_path' in stack.servers.calls)
    stack.ros.spin(1.3)
    assert stack.servers.calls.count('compute_path_to_pose') == 1
    stack.set_clock(102)
    stack.ros.wait_until(lambda: stack.servers.calls.count('compute_path_to_pose') == 2)
    stack.ros.wait_until(lambda: stack.client.feedback[-1].navigation_time.sec == 2)
    handle.cancel_goal_async()
    assert stack.client.wait(handle, 2.0)[0] == CANCELED


def test_a_point_that_moves_is_followed(stack: Stack) -> None:
    """Newer poses on a topic take the place of the goal; the path ends before it."""
    stack.servers.scripts['follow_path'] = ['hang']
    handle = stack.client.send(pose=pose(4.0), behavior_tree='follow_point.xml')
    stack.ros.wait_until(lambda: 'follow_path' in stack.servers.calls)
    publisher = stack.node.create_publisher(PoseStamped, 'goal_update', 1)
    stack.ros.wait_until(publisher.get_subscription_count)
    publisher.publish(pose(8.0))
    goals = stack.servers.goals['compute_path_to_pose']
    stack.ros.wait_until(lambda: goals[-1].goal.pose.position.x == 8.0)
    handle.cancel_goal_async()
    assert stack.client.wait(handle)[0] == CANCELED


def test_odometry_can_be_calibrated(stack: Stack) -> None:
    """Three squares."""
    handle = stack.client.send(pose=pose(0.0), behavior_tree='odometry_calibration.xml')
    assert stack.client.wait(handle)[0] == SUCCEEDED
    calls = stack.servers.calls
    assert calls == ['drive_on_heading', 'spin'] * 12


@pytest.mark.parametrize(
    'tree',
    [
        'navigate_w_replanning_distance.xml',
        'navigate_w_replanning_only_if_goal_is_updated.xml',
        'navigate_w_replanning_speed.xml',
        'navigate_w_replanning_time.xml',
    ],
)
def test_each_tree_reaches_a_goal(stack: Stack, tree: str) -> None:
    """Plan once, follow, succeed; a newer goal is planned for at once."""
    stack.servers.scripts['follow_path'] = ['hang', 0.05]
    stack.client.send(pose=pose(1.0), behavior_tree=tree)
    stack.ros.wait_until(lambda: 'follow_path' in stack.servers.calls)
    handle = stack.client.send(pose=pose(2.0), behavior_tree=tree)
    if tree == 'navigate_w_replanning_distance.xml':
        stack.servers.move(
            1.1, 0.0
        )  # only then, for the goal before must not be planned for again
    assert stack.client.wait(handle)[0] == SUCCEEDED
    assert stack.servers.goals['compute_path_to_pose'][-1].goal.pose.position.x == 2.0
