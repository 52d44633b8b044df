# SPDX-License-Identifier: Apache-2.0
"""Tests of the programs: what a controller manager is asked, and what users are told."""

from __future__ import annotations

import os
from pathlib import Path
import signal
import subprocess
import sys
import time
from typing import TYPE_CHECKING

from controller_manager import get_parameter_from_param_files
from controller_manager.hardware_spawner import main as hardware_spawner
from controller_manager.launch_utils import (
    generate_controllers_spawner_launch_description_from_dict,
)
from controller_manager.spawner import main as spawner
from controller_manager.unspawner import main as unspawner
from launch import LaunchContext
from launch.conditions import IfCondition
import pytest

if TYPE_CHECKING:
    from conftest import Manager

PARAMETERS = """
/**:
  ros__parameters:
    arm: {type: of another node}
arm:
  ros__parameters:
    type: trajectory/Arm
    gains:
      elbow.p: 5.0
/left/leg:
  ros__parameters: {type: Leg}
"""


@pytest.mark.parametrize(
    ('state', 'options', 'expected'),
    [
        (None, [], 'active'),
        (None, ['--inactive'], 'inactive'),
        (None, ['--load-only'], 'unconfigured'),
        ('unconfigured', [], 'active'),
        ('inactive', [], 'active'),
        ('active', [], 'active'),
        ('active', ['--inactive'], 'active'),
    ],
)
def test_a_controller_is_spawned(
    manager: Manager, state: str | None, options: list[str], expected: str
) -> None:
    """What is done already is not done again, and is no error."""
    if state:
        manager.states['arm'] = state
    words = ['spawner', 'arm', *options, '-c', '/controller_manager', '--ros-args', '-r', 'a:=b']
    assert spawner(words) == 0
    assert manager.states == {'arm': expected}
    assert len(manager.switches) == (expected == 'active' != state)


@pytest.mark.parametrize(
    ('options', 'switches'),
    [([], [(['arm'], []), (['leg'], [])]), (['--activate-as-group'], [(['arm', 'leg'], [])])],
)
def test_several(manager: Manager, options: list[str], switches: list[object]) -> None:
    """They are activated one after the other, or in one step."""
    assert spawner(['spawner', 'arm', 'leg', *options]) == 0
    assert manager.switches == switches


def test_parameters_are_told_before_loading(manager: Manager, tmp_path: Path) -> None:
    """The type, the files and the arguments of ROS are parameters of the manager."""
    path = tmp_path / 'with space.yaml'
    path.write_text(PARAMETERS)
    words = ['spawner', 'arm', '-p', str(path), '--controller-ros-args', '-r /a:=/b']
    assert spawner(words) == 0
    values = {name: manager.get_parameter(name).value for name in ('arm.type', 'arm.params_file')}
    assert values == {'arm.type': 'trajectory/Arm', 'arm.params_file': [str(path)]}
    assert manager.get_parameter('arm.node_options_args').value == ['-r', '/a:=/b']


@pytest.mark.parametrize(
    ('namespace', 'name', 'parameter', 'value'),
    [
        ('/', 'arm', 'gains.elbow.p', 5.0),
        ('/left', 'arm', 'type', 'trajectory/Arm'),
        ('/left', 'leg', 'type', 'Leg'),
        ('/right', 'leg', 'type', None),
        ('/', 'arm', 'gains.knee', None),
    ],
)
def test_parameters_are_found(
    tmp_path: Path, namespace: str, name: str, parameter: str, value: object
) -> None:
    """By the full name of the controller, as nodes find theirs."""
    path = tmp_path / 'p.yaml'
    path.write_text(PARAMETERS)
    found = get_parameter_from_param_files(None, name, namespace, [str(path)], parameter)  # type: ignore[arg-type]
    assert found == value


@pytest.mark.parametrize(
    ('words', 'reason'),
    [
        (['-p', '/no/where.yaml'], "'/no/where.yaml' cannot be read"),
        (['-p', os.devnull], "None of the parameter files has parameters of 'arm'"),
        (['-c', 'other', '--controller-manager-timeout', '0.3'], "no service '/other/list_contro"),
    ],
)
def test_what_is_missing_is_said(
    manager: Manager, capfd: pytest.CaptureFixture[str], words: list[str], reason: str
) -> None:
    """In a sentence; nothing is loaded."""
    assert spawner(['spawner', 'arm', *words]) == 1
    error = capfd.readouterr().err
    assert reason in error and 'Traceback' not in error
    assert not manager.states


@pytest.mark.parametrize(('state', 'reason'), [(None, 'loaded'), ('inactive', 'is claimed')])
def test_a_controller_that_fails(
    manager: Manager, capfd: pytest.CaptureFixture[str], state: str | None, reason: str
) -> None:
    """The status is 1, and the reason of the manager is logged."""
    manager.broken = 'arm'
    if state:
        manager.states['arm'] = state
    assert spawner(['spawner', 'arm']) == 1
    assert reason in capfd.readouterr().err


def test_unload(manager: Manager) -> None:
    """What is active is deactivated first; what is not there is no error."""
    manager.states |= {'arm': 'active', 'leg': 'inactive', 'head': 'active'}
    assert unspawner(['unspawner', 'arm', 'leg', 'tail']) == 0
    assert manager.states == {'head': 'active'}
    assert manager.switches == [([], ['arm'])]


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM])
def test_unload_when_it_ends(manager: Manager, number: int) -> None:
    """An interrupt unloads what was spawned."""
    command = [sys.executable, '-m', 'controller_manager.spawner', 'arm', '-u']
    with subprocess.Popen(command, stderr=subprocess.PIPE, text=True) as process:
        assert process.stderr is not None
        for line in process.stderr:
            if 'Waiting for an interrupt' in line:
                break
        assert manager.states == {'arm': 'active'}
        time.sleep(0.1)
        process.send_signal(number)
        assert process.wait(60) == 0
    assert not manager.states


@pytest.mark.parametrize(
    ('words', 'status', 'label'),
    [
        (['arm', '--activate'], 0, 'active'),
        (['arm', '--configure'], 0, 'inactive'),
        (['leg', '--activate'], 1, 'inactive'),
    ],
)
def test_hardware(manager: Manager, words: list[str], status: int, label: str) -> None:
    """A component is brought to the state; one that is not there is an error."""
    assert hardware_spawner(['hardware_spawner', *words]) == status
    assert manager.component.label == label


@pytest.mark.parametrize('unloads', ['true', 'false'])
def test_launch_description(unloads: str) -> None:
    """One spawner for all with the same files; the launch argument decides whether it unloads."""
    described = generate_controllers_spawner_launch_description_from_dict(
        {'arm': '/a b.yaml', 'leg': ['/a b.yaml'], 'head': None}, ['--inactive']
    )
    context = LaunchContext()
    context.launch_configurations['unload_on_kill'] = unloads
    spawners = [each for each in described.entities if hasattr(each, 'node_executable')]
    chosen = [each for each in spawners if each.condition.evaluate(context)]
    assert len(chosen) == 2
    assert {type(each.condition) is IfCondition for each in chosen} == {unloads == 'true'}
