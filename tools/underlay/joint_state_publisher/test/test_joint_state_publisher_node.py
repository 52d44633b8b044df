# SPDX-License-Identifier: Apache-2.0
"""The node as a process: what it publishes, merges, refuses and says."""

from __future__ import annotations

import math
from pathlib import Path
import signal

from publisher_probe import LATCHED, Probe, Program, Programs
import pytest
from rclpy.qos import qos_profile_sensor_data
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String

MODULE = 'joint_state_publisher.program'
ARM = """<robot name="arm">
  <link name="base"/> <link name="upper"/> <link name="lower"/>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/></joint>
</robot>
"""


@pytest.fixture
def arm(tmp_path: Path) -> str:
    """Return the file of the arm."""
    file = tmp_path / 'arm.urdf'
    file.write_text(ARM)
    return str(file)


def says(probe: Probe, program: Program, text: str) -> None:
    """Wait until a program has written a text."""
    probe.until(lambda: text in program.output, f'it did not say {text!r}')


def test_merges_sources_of_any_reliability(probe: Probe, programs: Programs, arm: str) -> None:
    """What sources tell is published with the time of now, below the same names."""
    words = arm, '--ros-args', '-p', 'source_list:=[commands, measured]', '-r', '__ns:=/robot1'
    programs.start(MODULE, *words, '-p', 'rate:=20')
    heard = probe.listen(JointState, '/robot1/joint_states')
    probe.until(lambda: heard, 'no defaults')
    assert (list(heard[0].name), list(heard[0].position)) == (['shoulder', 'elbow'], [0.0, 0.0])
    commands = probe.sender(JointState, '/robot1/commands', 1)
    measured = probe.sender(JointState, '/robot1/measured', qos_profile_sensor_data)

    def send() -> None:
        commands.publish(probe.state(elbow=0.5))
        measured.publish(probe.state(shoulder=0.25))

    probe.send_until(send, lambda: list(heard[-1].position) == [0.25, 0.5], 'nothing was merged')
    age_s = probe.node.get_clock().now().nanoseconds / 1e9 - heard[-1].header.stamp.sec
    assert abs(age_s) < 30


def test_positions_that_are_no_number(probe: Probe, programs: Programs, arm: str) -> None:
    """A source that tells NaN is named; what else it tells counts."""
    program = programs.start(MODULE, arm, source_list='[commands]')
    heard = probe.listen(JointState, '/joint_states')
    sender = probe.sender(JointState, '/commands')
    probe.send_until(
        lambda: sender.publish(probe.state(elbow=math.nan, shoulder=0.5)),
        lambda: heard and list(heard[-1].position) == [0.5, 0.0],
        'nothing was merged',
    )
    says(probe, program, "/commands: the position of 'elbow' is not a number, and is ignored.")


def test_description_from_the_topic(probe: Probe, programs: Programs) -> None:
    """It waits for a description, refuses a broken one and takes a new one over."""
    program = programs.start(MODULE)
    says(probe, program, 'Waiting for robot_description to be published on the /robot_desc')
    says(probe, program, 'Nothing received on /robot_description so far: it has no publisher.')
    heard = probe.listen(JointState, '/joint_states')
    sender = probe.sender(String, '/robot_description', LATCHED)
    sender.publish(String(data=ARM))
    probe.until(lambda: heard, 'no joint states')
    sender.publish(String(data=ARM.replace('"upper"/><child', '"uper"/><child')))
    says(probe, program, 'A robot description is ignored. robot_description:4: The parent of')
    heard.clear()
    probe.until(lambda: heard, 'the broken description has ended it')
    assert list(heard[-1].name) == ['shoulder', 'elbow']
    sender.publish(String(data=ARM.replace('name="elbow"', 'name="hinge"')))
    probe.until(lambda: list(heard[-1].name) == ['shoulder', 'hinge'], 'nothing new')


def test_description_as_parameter(probe: Probe, programs: Programs) -> None:
    """A description may be a parameter, and be replaced; what cannot change is refused."""
    program = programs.start(MODULE, robot_description=repr(' '.join(ARM.split())))
    heard = probe.listen(JointState, '/joint_states')
    probe.until(lambda: heard, 'no joint states')
    name = '/joint_state_publisher'
    (result,) = probe.set_parameters(name, robot_description='<robot/>')
    assert "There is no attribute 'name' in <robot>" in result.reason
    (result,) = probe.set_parameters(name, rate=5)
    assert not result.successful
    (result,) = probe.set_parameters(name, delta=0.25)
    assert result.successful
    probe.until(lambda: heard[-1].position[0] > 0.5, 'nothing moves')
    new = ARM.replace('name="elbow"', 'name="hinge"')
    (result,) = probe.set_parameters(name, robot_description=new)
    assert result.successful
    probe.until(lambda: list(heard[-1].name) == ['shoulder', 'hinge'], 'nothing new')
    assert program.end() == 0


def test_misspelt_names_are_reported(probe: Probe, programs: Programs, arm: str) -> None:
    """Parameters, zeros and joints of sources that are similar to known ones are named."""
    program = programs.start(
        MODULE, arm, **{'rat': '5', 'zeros.elbo': '1.0', 'source_list': '[commands, silent]'}
    )
    sender = probe.sender(JointState, '/commands')
    probe.send_until(
        lambda: sender.publish(probe.state(sholder=0.5)),
        lambda: 'sholder' in program.output,
        'no warning',
    )
    assert "There is no parameter 'rat'. Did you mean 'rate'?" in program.output
    assert "'elbo' is not a moving joint of this robot. Did you mean 'elbow'?" in program.output
    assert "/commands: The joint states name 'sholder'" in program.output
    says(probe, program, 'Nothing received on /silent so far: it has no publisher.')
    assert 'received on /commands' not in program.output


def test_time_of_the_simulator(probe: Probe, programs: Programs, arm: str) -> None:
    """Stamps and the rate follow the time of a simulator, also when it begins anew."""
    program = programs.start(MODULE, arm, use_sim_time='true')
    says(probe, program, 'use_sim_time is true, but there is no publisher on /clock: ')
    heard = probe.listen(JointState, '/joint_states')
    clock = probe.sender(Clock, '/clock')
    for begin_s in (500, 5):
        now = Clock()
        now.clock.sec = begin_s

        def pass_time(now: Clock = now) -> None:
            now.clock.nanosec = (now.clock.nanosec + 50_000_000) % 1_000_000_000
            clock.publish(now)

        probe.send_until(
            pass_time,
            lambda begin_s=begin_s: heard and heard[-1].header.stamp.sec == begin_s,
            f'no joint states at {begin_s}',
        )


def test_parameters_are_described_and_kept(probe: Probe, programs: Programs, arm: str) -> None:
    """An empty list of sources may be given; what cannot be changed is refused at run time."""
    programs.start(MODULE, arm, source_list='[]', **{'zeros.elbow': '0.25'})
    heard = probe.listen(JointState, '/joint_states')
    probe.until(lambda: heard, 'no joint states')
    assert 0.25 in heard[-1].position
    for change in ({'zeros.elbow': 0.5}, {'source_list': ['a']}, {'delta': float('nan')}):
        assert not probe.set_parameters('/joint_state_publisher', **change)[0].successful
    assert probe.set_parameters('/joint_state_publisher', delta=0.125)[0].successful


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_ends_well(probe: Probe, programs: Programs, arm: str, number: int) -> None:
    """Signals end the node with status 0 and without a traceback."""
    program = programs.start(MODULE, arm, rate='200')
    heard = probe.listen(JointState, '/joint_states')
    probe.until(lambda: heard, 'no joint states')
    assert program.end(number) == 0
    assert 'Traceback' not in program.output


@pytest.mark.parametrize(
    ('words', 'parameters', 'sentence'),
    [
        (['/no/arm.urdf'], {}, "The URDF '/no/arm.urdf' cannot be read: No such file"),
        ([], {'rate': '0'}, "The parameter 'rate' must be from 0.001"),
        (
            [],
            {'source_list': "['a b']"},
            "names 'a b', which is not a valid topic: topic name must",
        ),
        (
            [],
            {'source_list': "['{zz}']"},
            "names '{zz}', which is not a valid topic: unknown subst",
        ),
        ([], {'source_list': '[joint_states]'}, "'source_list' names /joint_states, which is"),
        ([], {'robot_description': '<robot/>'}, 'robot_description:1: There is no attribute'),
    ],
)
def test_cannot_start(programs: Programs, words, parameters, sentence) -> None:
    """What is missing or wrong at the start is a sentence and status 1."""
    program = programs.start(MODULE, *words, **parameters)
    assert program.process.wait(100) == 1
    assert sentence in program.output
    assert 'Traceback' not in program.output
