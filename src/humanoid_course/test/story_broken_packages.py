# SPDX-License-Identifier: Apache-2.0
"""Check many broken packages, each built and run: each fails the one criterion that it breaks."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from humanoid_course.grading import Outcome
from humanoid_course.testing import (
    criteria_in,
    LAUNCH,
    Mistake,
    MODEL_AND_CONTROL,
    run_check,
    TEMPERATURE_MONITOR,
    THREE_ROBOTS,
    TWO_NODES,
    write_workspace,
)
import pytest

SOLUTIONS = Path(__file__).resolve().parents[2]
MANIFEST, SETUP, SETUP_CFG = (f'temperature_monitor/{name}' for name in (
    'package.xml', 'setup.py', 'setup.cfg'))  # fmt: skip
ENTRY_POINT = "'temp_publisher = temperature_monitor.temp_publisher:main', "
PUBLISHER, ANALYZER = (
    f'temperature_monitor/temperature_monitor/temp_{name}.py' for name in ('publisher', 'analyzer')
)
BOTH = 'temperature_monitor/launch/both.launch.py'
ONE_NODE = TWO_NODES.splitlines(keepends=True)[0]
INIT = 'rclpy.init()'
CAUGHT = '(KeyboardInterrupt, rclpy.executors.ExternalShutdownException)'
IGNORE = f'{INIT}\n    import signal\n    signal.signal(signal.SIGINT, signal.SIG_IGN)'
SLEEP = 'import time\n    time.sleep(600)'
PUBLISH = 'self.publisher.publish'
FLOOD = f"print('x' * 100_000, flush=True)\n        {PUBLISH}"
THREE = 'humanoid_control/launch/three.launch.py'
MODEL = 'robot_control/launch/model.launch.py'
URDF = 'robot_description/urdf/arm.urdf'
COPY = '\'<robot name="arm"><link name="base"/></robot>\''
TEMPERATURE: dict[str, tuple[str, str, str | None, str]] = {
    'right': (SETUP, '', '', ''),
    'flood': (PUBLISHER, PUBLISH, FLOOD, ''),
    'no_licence': (MANIFEST, '<license>Apache-2.0</license>', '', 'manifest'),
    'cut_manifest': (MANIFEST, '</package>', '', 'manifest'),
    'undeclared': (MANIFEST, '<depend>std_msgs</depend>', '', 'dependencies'),
    'setup_syntax': (SETUP, 'setup(', 'setup((', 'build'),
    'no_entry_point': (SETUP, ENTRY_POINT, '', 'executables'),
    'no_setup_cfg': (SETUP_CFG, '', None, 'executables'),
    'crash': (PUBLISHER, 'self.create_timer', 'self.no_timer', 'publisher'),
    'hang': (PUBLISHER, INIT, SLEEP, 'publisher'),
    'topic': (PUBLISHER, "'/temperature'", "'/temperatur'", 'data'),
    'silent': (PUBLISHER, '0.1, self.tick', '900.0, self.tick', 'data'),
    'hot': (PUBLISHER, '30.0', '9000.0', 'range'),
    'constant': (PUBLISHER, 'random.uniform(20.0, 30.0)', '25.0', 'range'),
    'other_topic': (ANALYZER, "'/temperature'", "'/temp'", 'analyzer'),
    'threshold': (ANALYZER, '> 25.0', '> 28.0', 'alarm'),
    'print': (ANALYZER, 'self.get_logger().warning', 'print', 'alarm'),
    'uncaught': (ANALYZER, CAUGHT, 'ValueError', 'interrupt'),
    'syntax': (PUBLISHER, INIT, 'rclpy.init((', 'publisher'),
    'ignored': (PUBLISHER, INIT, IGNORE, 'interrupt'),
    'one_node': (BOTH, TWO_NODES, ONE_NODE, 'launch'),
    'not_installed': (SETUP, "glob('launch/*')", '[]', 'launch'),
    'launch_syntax': (BOTH, LAUNCH.format(nodes=TWO_NODES), 'x = (', 'launch'),
}
OTHERS: dict[str, tuple[str, str, str | None, str]] = {
    'three_robots': (THREE, '', '', ''),
    'two_robots': (THREE, "namespace='robot3'", "namespace='robot2'", 'topics'),
    'model': (MODEL, '', '', ''),
    'no_urdf': (URDF, '', None, 'models'),
    'copy': (MODEL, 'file.read()', COPY, 'access'),
}


def cases() -> Iterator[Any]:
    """Yield the exercise, its packages, the mistake, and the criterion that it breaks."""
    for name, (file, old, new, criterion) in {**TEMPERATURE, **OTHERS}.items():
        packages, exercise = (
            (TEMPERATURE_MONITOR, 'exercise_1')
            if name in TEMPERATURE
            else (THREE_ROBOTS, 'exercise_2')
            if file == THREE
            else (MODEL_AND_CONTROL, 'exercise_3')
        )
        mistake = Mistake(file, old, new) if old or new is None else None
        yield pytest.param(exercise, packages, mistake, criterion, id=name)


@pytest.mark.parametrize(('exercise', 'packages', 'mistake', 'criterion'), cases())
def test_one_mistake(
    exercise: str, packages: Any, mistake: Mistake | None, criterion: str, tmp_path: Path
) -> None:
    """A package with one mistake fails one criterion, a right one none."""
    write_workspace(tmp_path, packages, mistake)
    status, output = run_check(exercise, '--workspace', str(tmp_path))
    assert criteria_in(output, Outcome.FAILED) == ([criterion] if criterion else []), output
    assert status == (1 if criterion else 0), output


@pytest.mark.parametrize(
    'arguments',
    [
        ('exercise_1',),
        ('exercise_2', '--package', 'humanoid_bringup', '--launch-file', 'multi_robot.launch.py'),
    ],
)
def test_our_solutions(arguments: tuple[str, ...]) -> None:
    """The solutions in this workspace pass."""
    status, output = run_check(*arguments, '--workspace', str(SOLUTIONS))
    assert status == 0, output
