# SPDX-License-Identifier: Apache-2.0
"""Ask the robot for its controllers and hardware, and switch controllers."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from controller_manager_msgs.srv import (
    CleanupController,
    ConfigureController,
    ListControllers,
    ListControllerTypes,
    ListHardwareComponents,
    ListHardwareInterfaces,
    LoadController,
    SetHardwareComponentState,
    SwitchController,
    UnloadController,
)
from humanoid_common.testing.ros import ros_sandbox, RosSandbox
from humanoid_control.controllers import (
    CommandError,
    follow_mode,
    hold_mode,
    TrajectoryPoint,
    TrajectoryRequest,
)
from humanoid_control.hosting.controller_switch import controllers_of, switch
from humanoid_control.hosting.robot_control import RobotControl
from humanoid_control.mock_robot import MockRobot
from humanoid_control.testing import JOINTS, LIMITS, observed
from lifecycle_msgs.msg import State
import pytest

LEFT, RIGHT = 'left_arm_controller', 'right_arm_controller'
BEST_EFFORT, STRICT = 1, 2


class Robot:
    """A robot of two elbows and a knee."""

    def __init__(self) -> None:
        """Hold all joints."""
        self.control = RobotControl(JOINTS, LIMITS, [follow_mode(JOINTS), hold_mode(JOINTS)])
        self._time_s = 0.0
        self.tick()

    def tick(self) -> None:
        """Let a period pass."""
        self._time_s += 0.01
        self.control.update(observed(self._time_s))

    def send(self, name: str = LEFT) -> list[Any]:
        """Send a goal; return where its end comes."""
        controller, ends = self.control.goals.by_name[name], []
        request = TrajectoryRequest(controller.own, [TrajectoryPoint(1.0, [0.5])])
        controller.accept(self.control.goals.checked_goal(name, request), ends.append)
        self.tick()
        return ends

    def states(self) -> dict[str, str]:
        """Return the states of all controllers."""
        return {each.name: each.state for each in controllers_of(self.control)}

    def claims(self) -> dict[str, tuple[str, ...]]:
        """Return the joints of those that own any."""
        return {each.name: each.claimed for each in controllers_of(self.control) if each.claimed}


def test_states() -> None:
    """Those are active that take commands; in a mode that keeps all joints, the mode alone."""
    robot = Robot()
    assert robot.states() == {
        LEFT: 'active',
        RIGHT: 'active',
        'follow': 'active',
        'hold': 'inactive',
        'stop': 'inactive',
        'joint_trajectory': 'active',
        'joint_commands': 'active',
        'joint_state_broadcaster': 'active',
    }
    robot.control.manager.switch('hold')
    robot.tick()
    active = [name for name, state in robot.states().items() if state == 'active']
    assert active == ['hold', 'joint_state_broadcaster']
    robot.control.manager.switch('follow')
    robot.control.hold_still(True)
    robot.tick()
    assert robot.states()['stop'] == 'active'
    assert robot.claims() == {'stop': JOINTS}


def test_claims() -> None:
    """Each joint is claimed by one controller at any time."""
    robot = Robot()
    assert robot.claims() == {'follow': JOINTS}
    robot.send()
    robot.control.follow(['right_elbow'], [0.1])
    robot.tick()
    assert robot.claims() == {
        LEFT: ('left_elbow',),
        'joint_commands': ('right_elbow',),
        'follow': ('left_knee',),
    }


def test_deactivate_and_activate() -> None:
    """A controller that is deactivated ends its goal, gives its joints back and takes no other."""
    robot = Robot()
    ends = robot.send()
    assert switch(robot.control, [], [LEFT], STRICT) == (True, '')
    robot.tick()
    assert ends[0].message == 'The controller was deactivated.'
    assert robot.states()[LEFT] == 'inactive' and robot.claims() == {'follow': JOINTS}
    with pytest.raises(CommandError, match="'left_arm_controller' is inactive. Activate it: ros2"):
        robot.send()
    assert switch(robot.control, [LEFT], [], STRICT) == (True, '')
    assert robot.states()[LEFT] == 'active'
    assert robot.send() == []


def test_restart() -> None:
    """A controller in both lists gives its joints back and stays active."""
    robot = Robot()
    robot.send()
    assert switch(robot.control, [LEFT], [LEFT], STRICT) == (True, '')
    robot.tick()
    assert robot.states()[LEFT] == 'active' and robot.claims() == {'follow': JOINTS}


@pytest.mark.parametrize(
    ('activate', 'deactivate', 'sentence'),
    [
        (['left_arm_controler'], [], "Did you mean 'left_arm_controller'?"),
        ([LEFT], [], "'left_arm_controller' is already active."),
        (['hold'], [], "Set the parameter 'mode' of the node"),
        ([], ['joint_commands'], 'is always active and listens to its topic'),
        ([], ['joint_state_broadcaster'], 'the robot publishes joint_states'),
    ],
)
def test_strict(activate: list[str], deactivate: list[str], sentence: str) -> None:
    """With STRICT a switch is done as a whole, or not at all and with the reason."""
    robot = Robot()
    ok, message = switch(robot.control, activate, [*deactivate, RIGHT], STRICT)
    assert not ok and sentence in message and message.endswith('Nothing was switched.')
    assert robot.states()[RIGHT] == 'active'


def test_best_effort() -> None:
    """With BEST_EFFORT what can be done is done, and it fails only if nothing can."""
    robot = Robot()
    ok, message = switch(robot.control, [LEFT], ['nobody', RIGHT], BEST_EFFORT)
    assert ok and "no controller 'nobody'" in message
    assert robot.states()[RIGHT] == 'inactive'
    ok, message = switch(robot.control, ['nobody'], [], BEST_EFFORT)
    assert not ok
    assert switch(robot.control, [], [], BEST_EFFORT) == (True, '')
    assert switch(robot.control, [LEFT], [], 7) == (
        False,
        'Unknown strictness 7. Give BEST_EFFORT (1) or STRICT (2).',
    )


def test_activate_where_nothing_can_be_claimed() -> None:
    """In a mode that keeps all joints, no controller can be activated."""
    robot = Robot()
    switch(robot.control, [], [LEFT], STRICT)
    robot.control.manager.switch('hold')
    robot.tick()
    ok, message = switch(robot.control, [LEFT], [], BEST_EFFORT)
    assert not ok and "the mode 'hold' lets no controller claim its joints" in message


class World:
    """A mock robot that is asked."""

    def __init__(self, ros: RosSandbox, **parameters: Any) -> None:
        """Start it."""
        self._ros, self._node = ros, ros.observer()
        ros.start(MockRobot, parameters)

    def ask(self, kind: Any, name: str, /, **request: Any) -> Any:
        """Call a service."""
        client = self._node.create_client(kind, name)
        self._ros.wait_until(client.service_is_ready, 60.0, name)
        future = client.call_async(kind.Request(**request))
        self._ros.wait_until(future.done, 60.0, f'an answer of {name}')
        return future.result()


@pytest.fixture(name='ros')
def _ros() -> Iterator[RosSandbox]:
    """Give a domain of its own."""
    with ros_sandbox() as sandbox:
        yield sandbox


def test_services(ros: RosSandbox) -> None:
    """The robot lists controllers and hardware, and switches."""
    world = World(ros)
    controllers = world.ask(ListControllers, 'controller_manager/list_controllers').controller
    by_name = {each.name: each for each in controllers}
    head = by_name['head_controller']
    assert head.type == 'joint_trajectory_controller/JointTrajectoryController'
    assert (head.state, head.update_rate, list(head.claimed_interfaces)) == ('active', 100, [])
    assert list(head.required_command_interfaces) == [
        f'head_{axis}/{quantity}'
        for axis in ('yaw', 'pitch')
        for quantity in ('position', 'velocity', 'effort')
    ]
    assert len(by_name['walking'].claimed_interfaces) == 3 * 23
    broadcaster = by_name['joint_state_broadcaster']
    assert broadcaster.type == 'joint_state_broadcaster/JointStateBroadcaster'
    assert len(broadcaster.required_state_interfaces) == 3 * 23
    assert not broadcaster.required_command_interfaces and not broadcaster.claimed_interfaces
    types = world.ask(ListControllerTypes, 'controller_manager/list_controller_types')
    assert {each.type for each in controllers} == set(types.types)
    assert set(types.base_classes) == {'controller_interface::ControllerInterface'}
    answer = world.ask(
        SwitchController,
        'controller_manager/switch_controller',
        deactivate_controllers=['head_controller'],
        strictness=STRICT,
    )
    assert (answer.ok, answer.message) == (True, '')
    controllers = world.ask(ListControllers, 'controller_manager/list_controllers').controller
    assert {each.name: each.state for each in controllers}['head_controller'] == 'inactive'


@pytest.mark.parametrize(
    ('kind', 'service', 'name', 'ok', 'told'),
    [
        (LoadController, 'load_controller', 'head_controller', False, 'are part of it'),
        (LoadController, 'load_controller', 'head_controler', False, "'head_controller'?"),
        (UnloadController, 'unload_controller', 'head_controller', False, 'are part of it'),
        (CleanupController, 'cleanup_controller', 'head_controller', False, 'are part of it'),
        (ConfigureController, 'configure_controller', 'head_controller', False, 'is active'),
        (ConfigureController, 'configure_controller', 'stop', True, ''),
        (ConfigureController, 'configure_controller', 'x', False, "no controller 'x'"),
    ],
)
def test_what_cannot_be_loaded_or_unloaded(
    ros: RosSandbox,
    capfd: pytest.CaptureFixture[str],
    kind: Any,
    service: str,
    name: str,
    ok: bool,
    told: str,
) -> None:
    """Spawners are answered, and the log says why nothing changes."""
    world = World(ros)
    assert world.ask(kind, f'controller_manager/{service}', name=name).ok == ok
    assert told in capfd.readouterr().err


@pytest.mark.parametrize(
    ('name', 'state', 'ok'),
    [
        ('humanoid', State(id=State.PRIMARY_STATE_ACTIVE), True),
        ('humanoid', State(label='active'), True),
        ('humanoid', State(id=State.PRIMARY_STATE_INACTIVE), False),
        ('other', State(label='active'), False),
    ],
)
def test_hardware_is_always_active(ros: RosSandbox, name: str, state: State, ok: bool) -> None:
    """It may be asked to be so."""
    answer = World(ros).ask(
        SetHardwareComponentState,
        'controller_manager/set_hardware_component_state',
        name=name,
        target_state=state,
    )
    assert (answer.ok, answer.state.label) == (ok, 'active')


def test_hardware(ros: RosSandbox) -> None:
    """Joints and sensors are named with the prefix; each joint is claimed."""
    world = World(ros, prefix='my_', robots=['one', 'two'])
    name = 'two/controller_manager'
    interfaces = world.ask(ListHardwareInterfaces, f'{name}/list_hardware_interfaces')
    commands = {each.name: each for each in interfaces.command_interfaces}
    assert len(commands) == 3 * 23 and 'my_left_elbow/effort' in commands
    assert all(each.is_available and each.is_claimed for each in commands.values())
    states = {each.name for each in interfaces.state_interfaces}
    assert {'my_left_elbow/velocity', 'my_imu_link/orientation.w', 'my_l_sole/force.z'} <= states
    (component,) = world.ask(ListHardwareComponents, f'{name}/list_hardware_components').component
    assert (component.name, component.type, component.rw_rate) == ('two', 'system', 100)
    assert component.plugin_name == 'humanoid_control/MockBackend'
    assert (component.state.id, component.state.label) == (3, 'active')
    assert len(component.command_interfaces) == 3 * 23
