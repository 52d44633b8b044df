# SPDX-License-Identifier: Apache-2.0
"""Check that each mistake fails the one criterion that it breaks, from what is observed of it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from humanoid_course import exercise_1, exercise_2, exercise_3
from humanoid_course.grading import Exercise, grade, Outcome
from humanoid_course.observations import (
    Build,
    Endpoint,
    MODEL_MARK,
    Run,
    Stimulus,
    Submission,
)
from humanoid_course.testing import (
    Mistake,
    MODEL_AND_CONTROL,
    TEMPERATURE_MONITOR,
    THREE_ROBOTS,
    write_workspace,
)
from humanoid_course.workspace import Package
import pytest

FLOAT, JOINTS = 'std_msgs/msg/Float32', 'sensor_msgs/msg/JointState'
ROS = frozenset({'rclpy', 'std_msgs', 'sensor_msgs', 'robot_description'})


@dataclass
class FakeSubmission:
    """What the checks would have seen."""

    packages: Sequence[Package] = ()
    built: Build = field(default_factory=Build)
    publisher: Run = field(default_factory=lambda: Run('ros2 run'))
    listener: Stimulus = field(default_factory=lambda: Stimulus(Run('ros2 run')))
    launched: Run = field(default_factory=lambda: Run(''))
    known_packages: frozenset[str] = ROS

    def build(self) -> Build:
        """Return the build."""
        return self.built

    def run_publisher(self, executable: str, topic: str) -> Run:
        """Return the run."""
        return self.publisher

    def run_listener(self, executable: str, topic: str) -> Stimulus:
        """Return the run."""
        return self.listener

    def launch(self, is_enough: Callable[[Run], bool]) -> Run:
        """Return the run."""
        return self.launched


def not_passed(
    exercise: Exercise[Submission], submission: Submission
) -> tuple[list[str], list[str]]:
    """Return the names of the criteria that are not passed, and those not checked."""
    verdicts = [(each.name, verdict.outcome) for each, verdict in grade(exercise, submission)]
    return (
        [name for name, outcome in verdicts if outcome is Outcome.FAILED],
        [name for name, outcome in verdicts if outcome is Outcome.UNCHECKED],
    )


def packages_in(folder: Path, names: Sequence[str]) -> list[Package]:
    """Return the packages of a workspace in the order of an exercise."""
    return [Package(name, folder / 'src' / name) for name in names]


def at(topic: str, node: str, kind: str = FLOAT) -> dict[str, tuple[Endpoint, ...]]:
    """Return a graph with one endpoint."""
    return {topic: (Endpoint(node, kind),)}


TOPIC = '/temperature'
TRACEBACK = 'Traceback (most recent call last):\n  File "x.py"\n'
Change = Callable[[FakeSubmission], None]


def temperature_monitor(folder: Path, mistake: Mistake | None = None) -> FakeSubmission:
    """Return what is seen of a right solution of exercise 1."""
    write_workspace(folder, TEMPERATURE_MONITOR, mistake)
    sent, received = at(TOPIC, '/temp_publisher'), at(TOPIC, '/temp_analyzer')
    return FakeSubmission(
        packages_in(folder, ['temperature_monitor']),
        Build(executables={'temperature_monitor': ('temp_analyzer', 'temp_publisher')}),
        Run(
            'ros2 run',
            nodes=('/temp_publisher',),
            publishers=sent,
            values={TOPIC: (20.0, 21.5, 22.0, 29.0, 30.0)},
            counts={TOPIC: 5},
        ),
        Stimulus(
            Run('ros2 run', nodes=('/temp_analyzer',), subscriptions=received),
            FLOAT,
            24.5,
            25.5,
            ('[INFO] [temp_analyzer]: It is 24.5',),
            ('[INFO] [temp_analyzer]: It is 25.5', '[WARN] [temp_analyzer]: High: 25.5'),
        ),
        Run('ros2 launch', publishers=sent, subscriptions=received),
    )


def three_robots(folder: Path, mistake: Mistake | None = None) -> FakeSubmission:
    """Return what is seen of a right solution of exercise 2."""
    write_workspace(folder, THREE_ROBOTS, mistake)
    publishers = {
        f'/robot{n}/joint_commands': (Endpoint(f'/robot{n}/controller', JOINTS),)
        for n in (1, 2, 3)
    }
    launched = Run('ros2 launch', publishers=publishers, counts=dict.fromkeys(publishers, 5))
    return FakeSubmission(packages_in(folder, ['humanoid_control']), launched=launched)


def model_and_control(folder: Path, mistake: Mistake | None = None) -> FakeSubmission:
    """Return what is seen of a right solution of exercise 3."""
    write_workspace(folder, MODEL_AND_CONTROL, mistake)
    launched = Run(
        'ros2 launch',
        nodes=('/holder',),
        parameters={'robot_description of /holder': f'<robot name="arm{MODEL_MARK}"/>'},
    )
    built = Build(models={'robot_description': ('urdf/arm.urdf',)})
    names = ['robot_control', 'robot_description']
    return FakeSubmission(packages_in(folder, names), built, launched=launched)


RIGHT = {
    exercise_1.EXERCISE.name: (exercise_1.EXERCISE, temperature_monitor),
    exercise_2.EXERCISE.name: (exercise_2.EXERCISE, three_robots),
    exercise_3.EXERCISE.name: (exercise_3.EXERCISE, model_and_control),
}


def changed(what: str, **changes: Any) -> Change:
    """Return a change of what is seen in one run."""

    def change(submission: FakeSubmission) -> None:
        seen = getattr(submission, what)
        setattr(submission, what, replace(seen, **changes))

    return change


def listener_run(**changes: Any) -> Change:
    """Return a change of the run of the analyzer."""

    def change(submission: FakeSubmission) -> None:
        run = replace(submission.listener.run, **changes)
        submission.listener = replace(submission.listener, run=run)

    return change


def no_launch_file(submission: FakeSubmission) -> None:
    """Leave the launch file out."""
    submission.launched = Run('')


STRAY = Build(executables={}, stray_executables=('temp_publisher',))
CRASH = {'status': 1, 'output': 'SyntaxError: invalid syntax'}
SAME = {f'/robot{n}/joint_commands': (Endpoint('/controller', JOINTS),) for n in (1, 2, 3)}
ABSOLUTE = {'/joint_commands': tuple(Endpoint(f'/robot{n}/controller', JOINTS) for n in (1, 2, 3))}
OBSERVED = [
    ('exercise_1', changed('built', problem='SyntaxError'), 'build'),
    ('exercise_1', changed('built', unlisted=('temperature_monitor',)), 'build'),
    ('exercise_1', changed('built', executables={}), 'executables'),
    ('exercise_1', changed('built', **vars(STRAY)), 'executables'),
    ('exercise_1', changed('publisher', **CRASH), 'publisher'),
    ('exercise_1', changed('publisher', nodes=()), 'publisher'),
    ('exercise_1', changed('publisher', publishers=at('/temperatur', '/p')), 'data'),
    ('exercise_1', changed('publisher', counts={}), 'data'),
    ('exercise_1', changed('publisher', values={TOPIC: ('21.5',) * 5}), 'data'),
    ('exercise_1', changed('publisher', values={TOPIC: (20.0, 21.0, 22.0, 23.0, 31.0)}), 'range'),
    ('exercise_1', changed('publisher', values={TOPIC: (25.0,) * 5}), 'range'),
    ('exercise_1', listener_run(**CRASH), 'analyzer'),
    ('exercise_1', listener_run(subscriptions=at('/temp', '/temp_analyzer')), 'analyzer'),
    ('exercise_1', listener_run(subscriptions=at(TOPIC, '/a', 'std_msgs/msg/Int8')), 'analyzer'),
    ('exercise_1', changed('listener', lines_when_hot=()), 'alarm'),
    ('exercise_1', changed('listener', lines_when_hot=('High: 25.5',)), 'alarm'),
    ('exercise_1', changed('listener', lines_when_cold=('[WARN] [temp_analyzer]: High: 24.5',),
                           lines_when_hot=('[WARN] [temp_analyzer]: High: 25.5',)), 'alarm'),
    ('exercise_1', changed('publisher', left=('temp_publisher',)), 'interrupt'),
    ('exercise_1', listener_run(last_words=f'{TRACEBACK}KeyboardInterrupt\n'), 'interrupt'),
    ('exercise_1', changed('launched', **CRASH), 'launch'),
    ('exercise_1', changed('launched', subscriptions={}), 'launch'),
    ('exercise_1', no_launch_file, 'launch'),
    ('exercise_1', changed('launched', left=('sleep 60',)), 'launch_end'),
    ('exercise_2', no_launch_file, 'launch'),
    ('exercise_2', changed('launched', publishers=at('/robot1/joint_commands', '/a', JOINTS)),
     'launch'),
    ('exercise_2', changed('launched', publishers=ABSOLUTE), 'topics'),
    ('exercise_2', changed('launched', publishers={
        f'{name}_': ends for name, ends in ABSOLUTE.items()} | {
        f'/robot{n}/joint_commands': (Endpoint('/c', FLOAT),) for n in (1, 2, 3)}), 'topics'),
    ('exercise_2', changed('launched', publishers=SAME), 'independence'),
    ('exercise_2', changed('launched', counts={'/robot1/joint_commands': 99}), 'independence'),
    ('exercise_2', changed('launched', left=('joint_controller',)), 'launch_end'),
    ('exercise_3', changed('built', models={}), 'models'),
    ('exercise_3', changed('built', executables={'robot_description': ('node',)}), 'models'),
    ('exercise_3', no_launch_file, 'launch'),
    ('exercise_3', changed('launched', nodes=()), 'launch'),
    ('exercise_3', changed('launched', parameters={}), 'access'),
    ('exercise_3', changed('launched', parameters={'x of /holder': '<robot name="arm"/>'}),
     'access'),
    ('exercise_3', changed('launched', left=('holder',)), 'launch_end'),
]  # fmt: skip
WRITTEN = [
    ('exercise_1', Mistake('temperature_monitor/package.xml', '</license>', ''), 'manifest'),
    ('exercise_1', Mistake('temperature_monitor/package.xml', ' email="me@example.com"', ''),
     'manifest'),
    ('exercise_1', Mistake('temperature_monitor/package.xml', '0.0.0', '1'), 'manifest'),
    ('exercise_1', Mistake('temperature_monitor/package.xml', 'ament_python', 'python'),
     'manifest'),
    ('exercise_1', Mistake('temperature_monitor/package.xml', '<depend>std_msgs</depend>', ''),
     'dependencies'),
    ('exercise_2', Mistake('humanoid_control/package.xml', '<depend>rclpy</depend>', ''),
     'dependencies'),
    ('exercise_3', Mistake('robot_control/package.xml', '<depend>robot_description</depend>', ''),
     'dependency'),
]  # fmt: skip


@pytest.mark.parametrize('name', RIGHT)
def test_right_solution(name: str, tmp_path: Path) -> None:
    """A right solution passes every criterion."""
    exercise, seen = RIGHT[name]
    assert not_passed(exercise, seen(tmp_path)) == ([], [])


@pytest.mark.parametrize(('name', 'change', 'criterion'), OBSERVED)
def test_observed_mistake(name: str, change: Change, criterion: str, tmp_path: Path) -> None:
    """A mistake fails one criterion; others that build on it are not checked."""
    exercise, seen = RIGHT[name]
    submission = seen(tmp_path)
    change(submission)
    assert not_passed(exercise, submission)[0] == [criterion]


@pytest.mark.parametrize(('name', 'mistake', 'criterion'), WRITTEN)
def test_written_mistake(name: str, mistake: Mistake, criterion: str, tmp_path: Path) -> None:
    """So does a mistake in a file that is only read."""
    exercise, seen = RIGHT[name]
    assert not_passed(exercise, seen(tmp_path, mistake))[0] == [criterion]


@pytest.mark.parametrize('name', RIGHT)
def test_each_criterion_can_fail(name: str) -> None:
    """There is a mistake for every criterion."""
    broken = {each[2] for each in [*OBSERVED, *WRITTEN] if each[0] == name}
    exercise, _ = RIGHT[name]
    common = {'build', 'manifest', 'dependencies'}  # the same checks in each exercise
    assert {each.name for each in exercise.criteria} == broken | common


def test_too_few_readings(tmp_path: Path) -> None:
    """Whether readings are random cannot be told from two; that is no mistake."""
    submission = temperature_monitor(tmp_path)
    changed('publisher', values={TOPIC: (21.0, 22.0)})(submission)
    assert not_passed(exercise_1.EXERCISE, submission) == ([], ['range'])


def test_module_that_cannot_be_read(tmp_path: Path) -> None:
    """What a module with a syntax error imports is not known, and is no other mistake."""
    file = 'temperature_monitor/temperature_monitor/temp_publisher.py'
    submission = temperature_monitor(tmp_path, Mistake(file, 'class', 'clas'))
    assert not_passed(exercise_1.EXERCISE, submission) == ([], ['dependencies'])


def test_interrupted_rclpy_is_not_the_students_fault(tmp_path: Path) -> None:
    """A traceback of an exception that main() need not expect is no failure."""
    submission = temperature_monitor(tmp_path)
    listener_run(last_words=f'{TRACEBACK}RCLError: not valid\n')(submission)
    assert not_passed(exercise_1.EXERCISE, submission) == ([], [])
