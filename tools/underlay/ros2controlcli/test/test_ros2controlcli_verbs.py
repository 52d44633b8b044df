# SPDX-License-Identifier: Apache-2.0
"""Tests of the verbs of `ros2 control` with a process that answers."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from importlib.metadata import entry_points
import os
from pathlib import Path
import subprocess
import sys

from domain_coordinator import domain_id
import pytest
from ros2cli.cli import main
from ros2controlcli.command.control import ControlCommand
from ros2controlcli.verb import view_controller_chains

Ros2 = Callable[..., 'subprocess.CompletedProcess[str]']
PROCESS = Path(__file__).with_name('manager_process.py')
ACTIVE = (
    'arm_controller joint_trajectory_controller/JointTrajectoryController  active\n'
    'walk           w/Walk                                                 active\n'
)
INACTIVE = ACTIVE.replace('Controller  active', 'Controller  inactive')


@pytest.fixture(scope='module', name='domain')
def _domain() -> Iterator[str]:
    """Run a controller manager in a domain of its own."""
    with domain_id() as domain:
        variables = {**os.environ, 'ROS_DOMAIN_ID': str(domain)}
        variables['ROS_AUTOMATIC_DISCOVERY_RANGE'] = 'LOCALHOST'
        process = subprocess.Popen(
            [sys.executable, str(PROCESS)], env=variables, stdout=subprocess.PIPE, text=True
        )
        try:
            assert process.stdout is not None and process.stdout.readline() == 'ready\n'
            yield str(domain)
        finally:
            process.kill()
            process.communicate()


@pytest.fixture(name='control')
def _control(
    domain: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> Ros2:
    """Return what runs a verb where the manager is."""
    monkeypatch.setenv('ROS_DOMAIN_ID', domain)
    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')

    def run(*words: str) -> subprocess.CompletedProcess[str]:
        status = main(['control', *words])
        captured = capsys.readouterr()
        return subprocess.CompletedProcess(words, status, captured.out, captured.err)

    return run


def test_the_command_is_found() -> None:
    """The installed package offers the command, and all verbs of its table."""
    (command,) = entry_points(group='ros2cli.command', name='control')
    assert command.load() is ControlCommand
    verbs = {point.name: point.load() for point in entry_points(group='ros2controlcli.verb')}
    assert set(verbs) == set(ControlCommand.VERBS)
    assert all(verbs[name] is type(entry.create()) for name, entry in ControlCommand.VERBS.items())


def test_list_controllers(control: Ros2) -> None:
    """A controller a line, in columns."""
    done = control('list_controllers')
    assert (done.returncode, done.stdout, done.stderr) == (0, ACTIVE, '')


def test_list_controllers_with_their_interfaces(control: Ros2) -> None:
    """Below each controller, what is asked for."""
    assert (
        control('list_controllers', '--claimed-interfaces').stdout
        == ACTIVE.replace(
            'active\nwalk', 'active\n\tclaimed interfaces:\n\t\telbow/position\nwalk'
        )
        + '\tclaimed interfaces:\n'
    )
    all_of_it = control('list_controllers', '-v').stdout
    assert all_of_it.startswith(
        'arm_controller joint_trajectory_controller/JointTrajectoryController  active\n'
        '\tclaimed interfaces:\n\t\telbow/position\n'
        '\trequired state interfaces:\n\t\telbow/position\n\t\telbow/velocity\n'
        '\trequired command interfaces:\n\t\telbow/position\n'
        '\tchained interfaces:\n\t\tpid/elbow\n'
        '\treference interfaces:\n'
    )


def test_list_controller_types(control: Ros2) -> None:
    """A type a line, with its base class."""
    assert control('list_controller_types').stdout == (
        'joint_trajectory_controller/JointTrajectoryController base\n'
        'w/Walk                                                base\n'
    )


def test_list_hardware_interfaces(control: Ros2) -> None:
    """Commands say whether they are available and claimed; all are sorted."""
    done = control('list_hardware_interfaces')
    assert (done.returncode, done.stderr) == (0, '')
    assert done.stdout == (
        'command interfaces\n'
        '\telbow/position [available] [claimed]\n'
        '\tknee/position [available] [claimed]\n'
        '\twheel/velocity [unavailable] [unclaimed]\n'
        'state interfaces\n'
        '\telbow/position\n'
        '\tknee/position\n'
    )


def test_list_hardware_components(control: Ros2) -> None:
    """A component has its state, and its state interfaces when they are asked for."""
    text = (
        'Hardware Component 1\n'
        '\tname: robot\n'
        '\ttype: system\n'
        '\tplugin name: simulation/Backend\n'
        '\tstate: id=3 label=active\n'
        '\tread/write rate: 100 Hz\n'
        '\tis_async: False\n'
        '\tcommand interfaces\n'
        '\t\tknee/position [available] [claimed]\n'
        '\t\telbow/position [available] [claimed]\n'
        '\t\twheel/velocity [unavailable] [unclaimed]\n'
    )
    assert control('list_hardware_components').stdout == text
    states = '\tstate interfaces\n\t\tknee/position\n\t\telbow/position\n'
    assert control('list_hardware_components', '--verbose').stdout == text + states


def test_switch_controllers(control: Ros2) -> None:
    """A controller is deactivated and activated again; the list says so."""
    done = control('switch_controllers', '--deactivate', 'arm_controller')
    said = 'Successfully switched controllers\n'
    assert (done.returncode, done.stdout, done.stderr) == (0, said, '')
    assert control('list_controllers').stdout == INACTIVE
    assert control('switch_controllers', '--activate', 'arm_controller', '--strict').stdout == said
    assert control('list_controllers').stdout == ACTIVE


def test_switch_what_is_not_there(control: Ros2) -> None:
    """What the manager cannot switch is an error with its reason."""
    done = control('switch_controllers', '--activate', 'leg', '--strict')
    assert (done.returncode, done.stdout) == (1, '')
    assert done.stderr == "Error switching controllers. There is no 'leg'.\n"


def test_set_controller_state(control: Ros2) -> None:
    """A controller gets the state; that it has it already is no error."""
    done = control('set_controller_state', 'arm_controller', 'inactive')
    said = 'Successfully deactivated arm_controller\n'
    assert (done.returncode, done.stdout, done.stderr) == (0, said, '')
    assert control('list_controllers').stdout == INACTIVE
    again = control('set_controller_state', 'arm_controller', 'inactive')
    assert (again.returncode, again.stdout) == (0, 'arm_controller is inactive\n')
    done = control('set_controller_state', 'arm_controller', 'active')
    assert done.stdout == 'Successfully activated arm_controller\n'
    assert control('list_controllers').stdout == ACTIVE


def test_set_the_state_of_a_controller_that_is_not_configured(control: Ros2) -> None:
    """It is configured first."""
    done = control('set_controller_state', 'leg', 'inactive', '-c', 'legs/controller_manager')
    assert (done.returncode, done.stderr) == (0, '')
    assert done.stdout == 'Successfully configured leg\nleg is inactive\n'


def test_set_the_state_of_what_is_not_there(control: Ros2) -> None:
    """A controller that does not exist is an error with a similar name; others are refused."""
    done = control('set_controller_state', 'arm_controler', 'active')
    assert done.stderr == (
        "There is no controller 'arm_controler'\nDid you mean 'arm_controller'?\n"
        'To load one: ros2 control load_controller arm_controler\n'
    )
    done = control('set_controller_state', 'walk', 'inactive')
    assert (done.returncode, done.stdout) == (1, '')
    assert done.stderr == "Error deactivating controller 'walk'. There is no 'walk'.\n"


LEGS = ('-c', 'legs/controller_manager')


def test_load_and_unload(control: Ros2) -> None:
    """A controller is loaded and brought to a state; one that is active is not unloaded."""
    done = control('load_controller', 'foot', '--set-state', 'active', *LEGS)
    assert (done.returncode, done.stderr) == (0, '')
    assert done.stdout == (
        'Successfully loaded controller foot\n'
        'Successfully configured foot\n'
        'Successfully activated foot\n'
    )
    again = control('load_controller', 'foot', *LEGS)
    assert again.stderr == (
        "The controller 'foot' is loaded already, and active. To change that: "
        'ros2 control set_controller_state foot active\n'
    )
    done = control('unload_controller', 'foot', *LEGS)
    assert (done.returncode, done.stderr) == (
        1,
        "Error unloading controller 'foot'. It is active. Try first: "
        'ros2 control set_controller_state foot inactive\n',
    )
    assert control('set_controller_state', 'foot', 'inactive', *LEGS).returncode == 0
    done = control('unload_controller', 'foot', *LEGS)
    assert (done.returncode, done.stdout) == (0, 'Successfully unloaded controller foot\n')
    done = control('unload_controller', 'foot', *LEGS)
    assert done.stderr == "There is no controller 'foot'\nThere are: leg\n"


def test_load_with_a_parameter_file(control: Ros2, tmp_path: Path) -> None:
    """The manager refuses a controller without a type; the file tells it the type."""
    done = control('load_controller', 'tail', *LEGS)
    assert done.returncode == 1
    assert done.stderr == (
        "Error loading controller 'tail'. The log of the controller manager "
        "'/legs/controller_manager' says why. It has to know the type from its parameter "
        "'tail.type', which a parameter file can set. Types that it can load: l/Leg\n"
    )
    path = tmp_path / 'tail.yaml'
    path.write_text('tail: {ros__parameters: {type: l/Leg}}\n')
    done = control('load_controller', 'tail', str(path), *LEGS)
    assert (done.returncode, done.stdout) == (0, 'Successfully loaded controller tail\n')
    assert control('unload_controller', 'tail', *LEGS).returncode == 0
    done = control('load_controller', 'tail', 'no.yaml', *LEGS)
    assert done.returncode == 1 and "no.yaml' cannot be read" in done.stderr


def test_reload_controller_libraries(control: Ros2) -> None:
    """A manager with active controllers refuses; they are named. --force-kill stops them."""
    control('load_controller', 'foot', '--set-state', 'active', *LEGS)
    done = control('reload_controller_libraries', *LEGS)
    assert done.returncode == 1
    assert done.stderr.endswith('Active are: foot. Deactivate them, or try --force-kill\n')
    done = control('reload_controller_libraries', '--force-kill', *LEGS)
    assert (done.returncode, done.stdout) == (0, 'Successfully reloaded controller libraries\n')


def test_set_hardware_component_state(control: Ros2) -> None:
    """A component gets the state; a refusal says in which state it is."""
    done = control('set_hardware_component_state', 'motors', 'active', *LEGS)
    assert (done.returncode, done.stdout) == (0, 'Successfully set motors to active\n')
    done = control('set_hardware_component_state', 'motors', 'unconfigured', *LEGS)
    assert (done.returncode, done.stderr) == (
        1,
        "Error setting hardware component 'motors' to unconfigured: it is active. The log of the "
        "controller manager '/legs/controller_manager' says why\n",
    )
    done = control('set_hardware_component_state', 'motor', 'active', *LEGS)
    assert done.stderr == "There is no hardware component 'motor'\nDid you mean 'motors'?\n"


def test_arguments_of_ros(control: Ros2) -> None:
    """The namespace of the node is that of a manager without a leading slash."""
    done = control('list_controller_types', '--ros-args', '-r', '__ns:=/legs')
    assert (done.returncode, done.stdout) == (0, 'l/Leg base\n')
    done = control('list_controller_types', '--ros-args', '-r', 'nonsense')
    assert done.returncode == 1 and 'nonsense' in done.stderr


@pytest.mark.parametrize('has_graphviz', [False, True])
def test_view_controller_chains(
    control: Ros2, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, has_graphviz: bool
) -> None:
    """The arrows of the diagram are the interfaces; without Graphviz it is an SVG."""
    monkeypatch.setattr(view_controller_chains, 'SOURCE', tmp_path / 'd.gv')
    dot = tmp_path / 'dot'
    if has_graphviz:
        dot.write_text('#!/bin/sh\ncp "$2" "$4"\n')
        dot.chmod(0o755)
    monkeypatch.setenv('PATH', f'{tmp_path}:/bin' if has_graphviz else str(tmp_path))
    done = control('view_controller_chains')
    target = tmp_path / f'd.gv.{"pdf" if has_graphviz else "svg"}'
    assert done.returncode == 0 and done.stdout.startswith(f'Drawn: {target}')
    assert (
        '"arm_controller" -> "robot" [label="elbow/position" style=solid'
        in (tmp_path / 'd.gv').read_text()
    )
    assert 'arm_controller' in target.read_text()


def test_switch_nothing(control: Ros2) -> None:
    """To name no controller is a mistake."""
    done = control('switch_controllers')
    assert (done.returncode, done.stdout) == (1, '')
    assert done.stderr == 'Choose controllers: --activate NAME, --deactivate NAME, or both\n'


def test_another_manager(control: Ros2) -> None:
    """A manager that is not there is an error with one that is."""
    done = control('list_controllers', '-c', 'controller_manger', '--spin-time', '0.5')
    assert (done.returncode, done.stdout) == (1, '')
    assert done.stderr == (
        "There is no controller manager '/controller_manger'\n"
        "Did you mean '/controller_manager'?\n"
    )


def test_no_manager_at_all(control: Ros2, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where there is no manager, that is said with what to look at."""
    with domain_id() as domain:
        monkeypatch.setenv('ROS_DOMAIN_ID', str(domain))
        done = control('list_hardware_interfaces', '--spin-time', '0.5')
    assert (done.returncode, done.stdout) == (1, '')
    assert done.stderr == (
        "There is no controller manager '/controller_manager'\n"
        'No controller manager is running: start a robot, or check ROS_DOMAIN_ID\n'
    )
