# SPDX-License-Identifier: Apache-2.0
"""The node as a process: what it publishes, accepts, refuses and says."""

from __future__ import annotations

from itertools import count
from pathlib import Path
import signal
import time

from geometry_msgs.msg import TransformStamped
from publisher_probe import LATCHED, Probe, Program, Programs
import pytest
from rosgraph_msgs.msg import Clock
from sensor_msgs.msg import JointState
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage

MODULE = 'robot_state_publisher.program'
ARM = """<robot name="arm">
  <link name="base"/> <link name="upper"/> <link name="lower"/> <link name="tool"/>
  <joint name="shoulder" type="continuous">
    <parent link="base"/> <child link="upper"/> <origin xyz="0 0 1"/> <axis xyz="0 0 1"/>
  </joint>
  <joint name="elbow" type="prismatic">
    <parent link="upper"/> <child link="lower"/> <axis xyz="0 2 0"/> <limit lower="0" upper="1"/>
  </joint>
  <joint name="wrist" type="fixed">
    <parent link="lower"/> <child link="tool"/> <origin xyz="0.5 0 0"/>
  </joint>
</robot>
"""
LEG = ARM.replace('"tool"', '"foot"').replace('"wrist"', '"ankle"')
BROKEN = ARM.replace('<child link="upper"/>', '<child link="uper"/>')


@pytest.fixture
def arm(tmp_path: Path) -> str:
    """Return the file of the arm."""
    file = tmp_path / 'arm.urdf'
    file.write_text(ARM)
    return str(file)


def started(probe: Probe, program: Program) -> Program:
    """Return a program when its robot is there."""
    probe.until(lambda: 'links below' in program.output, 'the robot was not loaded')
    return program


def frames(messages: list[TFMessage]) -> dict[str, TransformStamped]:
    """Return the newest transform of each child frame."""
    return {each.child_frame_id: each for message in messages for each in message.transforms}


def test_publishes_description_and_all_transforms(
    probe: Probe, programs: Programs, arm: str
) -> None:
    """The description, the fixed and the moving transforms are there, also for latecomers."""
    started(probe, programs.start(MODULE, arm))
    descriptions = probe.listen(String, '/robot_description', LATCHED)
    fixed = probe.listen(TFMessage, '/tf_static', LATCHED)
    moving = probe.listen(TFMessage, '/tf')
    sender = probe.sender(JointState, '/joint_states')
    stamps_s = count(100.5)
    probe.send_until(
        lambda: sender.publish(probe.state(next(stamps_s), elbow=0.25, shoulder=3.0)),
        lambda: moving and fixed and descriptions,
        'no transforms',
    )
    assert descriptions[0].data == ARM
    tool = frames(fixed)['tool']
    assert (tool.header.frame_id, tool.transform.translation.x) == ('lower', 0.5)
    upper, lower = frames(moving)['upper'], frames(moving)['lower']
    assert upper.header.stamp.sec >= 100 and upper.header.stamp.nanosec == 500_000_000
    assert upper.header.frame_id == 'base'
    assert upper.transform.translation.z == 1.0
    assert upper.transform.rotation.w == pytest.approx(0.0707372016677029)
    assert lower.transform.translation.y == 0.25


def test_two_robots_have_names_of_their_own(probe: Probe, programs: Programs, arm: str) -> None:
    """Namespaces separate topics, and prefixes the frames of the tf topic that all share."""
    for name in ('robot1', 'robot2'):
        words = arm, '--ros-args', '-r', f'__ns:=/{name}', '-p', f'frame_prefix:={name}/'
        started(probe, programs.start(MODULE, *words))
    fixed = probe.listen(TFMessage, '/tf_static', LATCHED)
    moving = probe.listen(TFMessage, '/tf')
    sender = probe.sender(JointState, '/robot2/joint_states')
    probe.send_until(
        lambda: sender.publish(probe.state(shoulder=0.5)),
        lambda: moving and len(fixed) == 2,
        'no transforms',
    )
    assert {name: each.header.frame_id for name, each in frames(fixed).items()} == {
        'robot1/tool': 'robot1/lower',
        'robot2/tool': 'robot2/lower',
    }
    assert set(frames(moving)) == {'robot2/upper'}


def test_frequency_limits_what_is_published(probe: Probe, programs: Programs, arm: str) -> None:
    """States whose stamps are closer than the frequency allows are left out."""
    started(probe, programs.start(MODULE, arm, publish_frequency='10.0'))
    moving = probe.listen(TFMessage, '/tf')
    sender = probe.sender(JointState, '/joint_states')
    stamps_s = count(1.0)

    def newest_is_from(stamp_s: float) -> bool:
        stamp = moving[-1].transforms[0].header.stamp if moving else None
        return stamp is not None and stamp.sec + stamp.nanosec * 1e-9 == pytest.approx(stamp_s)

    probe.send_until(
        lambda: sender.publish(probe.state(next(stamps_s), shoulder=0.0)),
        lambda: moving,
        'no transforms',
    )
    sender.publish(probe.state(4000.0, shoulder=0.0))
    probe.until(lambda: newest_is_from(4000.0), 'no transforms before the test')
    moving.clear()
    # No more at once than the node keeps until it gets to them.
    for stamps in ((5000.0,), (5000.02, 5000.04, 5000.06, 5000.11), (5000.13, 5000.25)):
        for stamp_s in stamps:
            sender.publish(probe.state(stamp_s, shoulder=0.0))
        probe.until(lambda last_s=stamps[-1]: newest_is_from(last_s), f'nothing from {stamps}')
    stamps_ns = [message.transforms[0].header.stamp.nanosec for message in moving]
    assert stamps_ns == [0, 110_000_000, 250_000_000]


def test_states_without_stamp_are_reported(probe: Probe, programs: Programs, arm: str) -> None:
    """A state without a stamp is left out, which the log says, until stamps are ignored."""
    program = started(probe, programs.start(MODULE, arm, publish_frequency='50'))
    moving = probe.listen(TFMessage, '/tf')
    sender = probe.sender(JointState, '/joint_states')
    state = probe.state(0.0, shoulder=0.0, elbow=0.0)
    for text in ('joints have had no state so far', 'A joint state without a stamp is ignored.'):
        probe.send_until(
            lambda: sender.publish(state), lambda text=text: text in program.output, 'no warning'
        )
    assert moving == []
    assert 'a state now' not in program.output
    probe.set_parameters('/robot_state_publisher', ignore_timestamp=True)
    probe.send_until(lambda: sender.publish(state), lambda: moving, 'no transforms')


def test_new_description_takes_over_whole_or_not_at_all(
    probe: Probe, programs: Programs, arm: str
) -> None:
    """A broken description is refused with its reason; a good one is published at once."""
    program = started(probe, programs.start(MODULE, arm, frame_prefx='a/'))
    complaint = 'joints have had no state so far'
    assert "There is no parameter 'frame_prefx'. Did you mean 'frame_prefix'?" in program.output
    descriptions = probe.listen(String, '/robot_description', LATCHED)
    fixed = probe.listen(TFMessage, '/tf_static', LATCHED)
    probe.until(lambda: descriptions and fixed, 'nothing published')
    probe.until(lambda: complaint in program.output, 'no complaint')
    (refusal,) = probe.set_parameters('/robot_state_publisher', robot_description=BROKEN)
    assert not refusal.successful
    assert refusal.reason == (
        "robot_description:3: The child of joint 'shoulder' is link 'uper', which does not "
        "exist. Did you mean 'upper'?"
    )
    (refusal,) = probe.set_parameters('/robot_state_publisher', publish_frequency=0.0)
    assert 'publish_frequency must be a number, more than 0' in refusal.reason
    (result,) = probe.set_parameters('/robot_state_publisher', robot_description=LEG)
    assert result.successful
    probe.until(lambda: len(descriptions) == 2 and len(fixed) == 2, 'nothing new')
    assert descriptions[1].data == LEG
    assert set(frames(fixed[1:])) == {'foot'}
    probe.until(lambda: program.output.count(complaint) == 2, 'no complaint about the new robot')


def test_joints_without_a_state_are_named(probe: Probe, programs: Programs, arm: str) -> None:
    """After two seconds the log names the joints without a state, once; then that all have one."""
    program = started(probe, programs.start(MODULE, arm))
    sender = probe.sender(JointState, '/joint_states')
    complaint = "so tf does not know where the links below them are: 'elbow'."
    probe.send_until(
        lambda: sender.publish(probe.state(shoulder=0.0, elbwo=0.0)),
        lambda: complaint in program.output,
        'no complaint',
    )
    assert "name 'elbwo', but the robot has no such joint. Did you mean 'elbow'?" in program.output
    assert '/joint_states has one publisher.' in program.output
    probe.send_until(
        lambda: sender.publish(probe.state(elbow=0.0)),
        lambda: 'All 2 joints have a state now.' in program.output,
        'no relief',
    )
    assert program.output.count(complaint) == program.output.count('elbwo') == 1


def test_unusable_states_are_left_out(probe: Probe, programs: Programs, arm: str) -> None:
    """States without positions are reported, and values that are no number do not count."""
    program = started(probe, programs.start(MODULE, arm))
    moving = probe.listen(TFMessage, '/tf')
    sender = probe.sender(JointState, '/joint_states')
    state = JointState(name=['shoulder'], velocity=[1.0])
    probe.send_until(
        lambda: sender.publish(state),
        lambda: "about 'shoulder' has no positions" in program.output,
        'no warning',
    )
    probe.send_until(
        lambda: sender.publish(probe.state(shoulder=float('nan'), elbow=0.5)),
        lambda: moving,
        'no transforms',
    )
    assert set(frames(moving)) == {'lower'}
    assert program.output.count("The position of joint 'shoulder' in a joint state is not") == 1


def test_positions_beyond_all_numbers_are_left_out(
    probe: Probe, programs: Programs, tmp_path: Path
) -> None:
    """A follower that would be infinitely far is reported, and the node works on."""
    file = tmp_path / 'following.urdf'
    follower = '<mimic joint="shoulder" multiplier="1e300"/>'
    file.write_text(ARM.replace('<axis xyz="0 2 0"/>', follower))
    program = started(probe, programs.start(MODULE, str(file)))
    moving = probe.listen(TFMessage, '/tf')
    sender = probe.sender(JointState, '/joint_states')
    probe.send_until(
        lambda: sender.publish(probe.state(shoulder=1e300)),
        lambda: "positions of 'elbow' would not be finite" in program.output,
        'no warning',
    )
    assert not moving
    probe.send_until(
        lambda: sender.publish(probe.state(shoulder=0.5)), lambda: moving, 'no transforms'
    )


def test_time_that_jumps_back_begins_anew(probe: Probe, programs: Programs, arm: str) -> None:
    """When a simulation begins again, transforms are published at once."""
    program = started(probe, programs.start(MODULE, arm, use_sim_time='true'))
    moving = probe.listen(TFMessage, '/tf')
    sender = probe.sender(JointState, '/joint_states')
    clock = probe.sender(Clock, '/clock')
    jumped = 'Time has jumped back: all joints are published again. If this keeps'

    def live_at(seconds: int) -> None:
        message = Clock()
        message.clock.sec = seconds
        clock.publish(message)
        sender.publish(probe.state(float(seconds), shoulder=0.0))

    # Time goes on meanwhile: who begins to hear too late for the first transforms gets the next.
    def hear_from(begin: int, end: int) -> None:
        seconds = count(begin)
        probe.send_until(
            lambda: live_at(next(seconds)),
            lambda: moving and begin <= moving[-1].transforms[0].header.stamp.sec < end,
            f'no transforms from {begin} s on',
        )

    hear_from(500, 10_000)
    assert jumped not in program.output
    hear_from(5, 500)
    while jumped not in program.output:  # joint states may connect before the clock does
        hear_from(500, 10_000)
        hear_from(5, 500)
    assert program.output.count(jumped) == 1
    # Two simulators: the time goes to and fro, which is said once a minute at most.
    begin_s = time.monotonic()
    for _ in range(3):
        hear_from(1000, 10_000)
        hear_from(5, 500)
    assert program.output.count(jumped) <= 1 + (time.monotonic() - begin_s) / 60.0


def test_stamps_that_jump_back_begin_anew(probe: Probe, programs: Programs, arm: str) -> None:
    """A recording that is played again is published, without time of a simulator."""
    program = started(probe, programs.start(MODULE, arm))
    moving = probe.listen(TFMessage, '/tf')
    sender = probe.sender(JointState, '/joint_states')
    for stamps_s in (count(5000.0), count(5.0)):
        moving.clear()
        probe.send_until(
            lambda stamps_s=stamps_s: sender.publish(probe.state(next(stamps_s), shoulder=0.0)),
            lambda: moving,
            f'no transforms before {next(stamps_s)}',
        )
    assert 'The stamps of joint states have jumped back' in program.output


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_ends_well(probe: Probe, programs: Programs, arm: str, number: int) -> None:
    """Signals end the node with status 0, also while it is at work, and without a traceback."""
    program = started(probe, programs.start(MODULE, arm))
    sender = probe.sender(JointState, '/joint_states')
    for _ in range(50):
        sender.publish(probe.state(shoulder=0.0))
    assert program.end(number) == 0
    assert 'Traceback' not in program.output


def test_bad_file_ends_with_its_place(programs: Programs, tmp_path: Path) -> None:
    """A broken URDF in a file is refused with file, line and cause."""
    file = tmp_path / 'broken.urdf'
    file.write_text(BROKEN)
    program = programs.start(MODULE, str(file))
    assert program.process.wait(100) == 1
    assert program.output == (
        f"{file}:3: The child of joint 'shoulder' is link 'uper', which does not exist. "
        "Did you mean 'upper'?\n"
    )


@pytest.mark.parametrize(
    ('words', 'parameters', 'sentence'),
    [
        ([], {}, "Node 'robot_state_publisher' needs the parameter robot_description"),
        (['/no/arm.urdf'], {}, "The URDF '/no/arm.urdf' cannot be read: No such file"),
        (['a.urdf', 'b.urdf'], {}, 'takes at most one URDF file and no options, not'),
        (['-x'], {}, 'takes at most one URDF file and no options, not -x.'),
        ([], {'robot_description': '7'}, "Trying to set parameter 'robot_description'"),
        (['--ros-args', '--params-file', '/no/file'], {}, 'The ROS arguments cannot be used: '),
    ],
)
def test_cannot_start(programs: Programs, words, parameters, sentence) -> None:
    """What is missing or wrong at the start is a sentence and status 1."""
    program = programs.start(MODULE, *words, **parameters)
    assert program.process.wait(100) == 1
    assert sentence in program.output
    assert 'Traceback' not in program.output
