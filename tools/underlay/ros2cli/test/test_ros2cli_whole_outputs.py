# SPDX-License-Identifier: Apache-2.0
"""The whole output (stdout, stderr, status) of the verbs that ask nodes, and of wrong words."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
import re
import shlex
from subprocess import CompletedProcess
from typing import NamedTuple

import pytest

Ros2 = Callable[..., CompletedProcess[str]]

ACTION = 'tf2_msgs/action/LookupTransform'
SERVICE = 'std_srvs/srv/SetBool'
ARM = '/robot1/arm'
PARAMETER_SERVICES = (
    'describe_parameters',
    'get_parameter_types',
    'get_parameters',
    'get_type_description',
    'list_parameters',
    'set_parameters',
    'set_parameters_atomically',
)
STATE_SERVICES = (
    'change_state',
    'get_available_states',
    'get_available_transitions',
    'get_state',
    'get_transition_graph',
)
SERVICES = sorted(
    [
        '/fire',
        '/flip',
        *(f'{ARM}/{name}' for name in PARAMETER_SERVICES),
        *(f'/lamp/{name}' for name in (*PARAMETER_SERVICES, *STATE_SERVICES)),
    ]
)
TIME = '       sec: 0\n       nanosec: 0\n'
RESULT_TIME = '          sec: 0\n          nanosec: 0\n'
ZERO = '          x: 0.0\n          y: 0.0\n          z: 0.0\n'
GOAL = (
    'Waiting for an action server to become available...\n'
    'Sending goal:\n'
    "     target_frame: torso\n     source_frame: ''\n"
    f'     source_time:\n{TIME}     timeout:\n{TIME}     target_time:\n{TIME}'
    "     fixed_frame: ''\n     advanced: false\n\n"
    'Goal accepted with ID: ID\n\n'
    'Feedback:\n    {}\n\nFeedback:\n    {}\n\n'
    'Result:\n    transform:\n      header:\n'
    f"        stamp:\n{RESULT_TIME}        frame_id: ''\n"
    '      child_frame_id: torso\n'
    f'      transform:\n        translation:\n{ZERO}        rotation:\n{ZERO}          w: 1.0\n'
    "    error:\n      error: 0\n      error_string: ''\n\n"
    'Goal finished with status: SUCCEEDED\n'
)
NO_INTERFACE = 'Unknown package {!r}\nIt is not in any folder of AMENT_PREFIX_PATH'
UNKNOWN = f"The node '{ARM}' has no parameter 'sped'. Did you mean 'speed'?\n"
UNDECLARED = 'Invalid access to undeclared parameter(s): []\n'
NO_DAEMON = (
    'The daemon is not running\n'
    'There is none, and none is needed: each command discovers the graph itself, and answers '
    'as soon as it is complete\n'
)


class Row(NamedTuple):
    """A command with all that is to be seen of it."""

    words: str
    output: str = ''
    errors: str = ''
    status: int = 0


def service_types(name: str) -> str:
    """Return the lines of `service list -t` for the services that end with a name."""
    interface = ''.join(part.capitalize() for part in name.split('_'))
    package = 'lifecycle_msgs' if name in STATE_SERVICES else 'rcl_interfaces'
    return ''.join(f'{each} [{package}/srv/{interface}]\n' for each in SERVICES if name in each)


ROWS = [
    # 4.6 param
    Row(f'param get {ARM} speed', 'Double value is: 0.5\n'),
    Row('param get robot1/arm fingers.count', 'Integer value is: 4\n'),
    Row(f'param get {ARM} enabled', 'Boolean value is: True\n'),
    Row(f'param get {ARM} gains --hide-type', '[1.0, 2.5]\n'),
    Row(f'param get {ARM} sped', '', f'Parameter not set\n{UNKNOWN}', 1),
    Row('param get /nope x --timeout 0.1', '', 'Node not found\n', 1),
    Row(f'param set {ARM} speed 0.5', 'Set parameter successful\n'),
    Row(f'param set {ARM} label right', '', 'Setting parameter failed: this is the left arm\n'),
    Row(f'param set {ARM} sped 1.0', '', f'Setting parameter failed: {UNDECLARED}{UNKNOWN}'),
    Row(f'param delete {ARM} sped', '', f'Deleting parameter failed: {UNDECLARED}{UNKNOWN}'),
    Row(f'param list {ARM} --filter ^f', '  fingers.count\n  fingers.names\n'),
    Row(f'param list {ARM} --param-prefixes nope'),
    Row('param list /nope --timeout 0.1', '', 'Node not found\n', 1),
    Row(
        f'param describe {ARM} label sped',
        'Parameter name: label\n  Type: string\n  Constraints:\n',
        UNKNOWN,
    ),
    Row('param describe /nope x --timeout 0.1', '', 'Node not found\n', 1),
    Row('param dump /nope --timeout 0.1', '', 'Node not found\n', 1),
    Row(
        'param dump lamp',
        '/lamp:\n  ros__parameters:\n    start_type_description_service: true\n'
        '    use_sim_time: false\n\n',
    ),
    Row(
        f'param load {ARM} /nope.yaml',
        '',
        "The parameter file '/nope.yaml' cannot be read: No such file or directory\n",
        1,
    ),
    # 4.7 service
    Row('service list', ''.join(f'{name}\n' for name in SERVICES)),
    Row('service list --count-services', f'{len(SERVICES)}\n'),
    Row('service type /flip', f'{SERVICE}\n'),
    Row('service type flip', '', '', 1),
    Row(f'service find {SERVICE}', '/flip\n'),
    Row('service find std_srvs/srv/Empty'),
    Row('service find std_srvs/srv/Empty -c', '0\n'),
    Row('service info /flip', f'Type: {SERVICE}\nClients count: 0\nServices count: 1\n'),
    Row('service info /nope', '', "Unknown service '/nope'\n", 1),
    Row(
        f"service call /flip {SERVICE} '{{data: true}}'",
        'requester: making request: std_srvs.srv.SetBool_Request(data=True)\n\n'
        "response:\nstd_srvs.srv.SetBool_Response(success=True, message='hello')\n\n",
    ),
    Row(
        f"service call /flip {SERVICE} '{{nope: 1}}'",
        '',
        "Failed to populate field: 'SetBool_Request' object has no attribute 'nope'\n",
        1,
    ),
    Row(
        f"service call /flip {SERVICE} '{{data: [1]}}'",
        '',
        "Failed to populate field: 'data' needs true or false, but got [1]\n",
        1,
    ),
    Row(
        'service call /flip nope',
        '',
        "The passed service type is invalid\n'nope' is not of the form 'package/srv/Type', "
        "for example 'std_srvs/srv/Trigger'\n",
        1,
    ),
    Row(
        'service call /flip std_msgs/msg/String',
        '',
        "The passed type is not a service\n'std_msgs/msg/String' is not of the form "
        "'package/srv/Type', for example 'std_srvs/srv/Trigger'\n",
        1,
    ),
    Row(
        'service echo /nope',
        'WARNING: service [/nope] does not appear to be available yet\n',
        'Could not determine the type for the passed service\n',
        1,
    ),
    # 4.8 interface
    Row(
        'interface show std_srvs/srv/SetBool --no-comments',
        'bool data\n---\nbool success\nstring message\n',
    ),
    Row(
        'interface show std_msgs/Header',
        '',
        "Invalid name 'std_msgs/Header'. Expected three parts separated by '/'\n"
        "Did you mean 'std_msgs/msg/Header'?\n",
        1,
    ),
    Row('interface package std_srvs --only-msgs'),
    Row('interface proto geometry_msgs/msg/Point', '"x: 0.0\ny: 0.0\nz: 0.0\n"\n'),
    Row('interface proto geometry_msgs/msg/Point --no-quotes', 'x: 0.0\ny: 0.0\nz: 0.0\n\n'),
    # 4.9 action
    Row('action list', '/look\n'),
    Row('action list -t', f'/look [{ACTION}]\n'),
    Row('action list -c', '1\n'),
    Row('action type /look', f'{ACTION}\n'),
    Row('action type look', '', '', 1),
    Row(
        'action info /look -t',
        f'Action: /look\nAction clients: 0\nAction servers: 1\n    {ARM} [{ACTION}]\n',
    ),
    Row('action info /nope', 'Action: /nope\nAction clients: 0\nAction servers: 0\n'),
    Row(f"action send_goal -f /look {ACTION} '{{target_frame: torso}}'", GOAL),
    Row(
        f"action send_goal /look {ACTION} '{{nope: 1}}'",
        '',
        "Failed to populate message fields: AttributeError(\"'LookupTransform_Goal' object has "
        "no attribute 'nope'\")\n",
        1,
    ),
    Row(
        'action send_goal /look nope',
        '',
        "The passed action type is invalid\n'nope' is not of the form 'package/action/Type', "
        f"for example '{ACTION}'\n",
        1,
    ),
    Row(
        f'action send_goal /1 {ACTION}',
        '',
        "'/1' is not a valid action name: parts of letters, digits and underscores, none of which "
        "starts with a digit, joined by slashes, as in '/robot1/joint_commands'\n",
        1,
    ),
    # 4.10 daemon
    *(Row(f'daemon {verb}', NO_DAEMON) for verb in ('start', 'start --debug', 'status', 'stop')),
    # 4.11 lifecycle, component
    Row('lifecycle nodes', '/lamp\n'),
    Row('lifecycle nodes --all --count-nodes', '1\n'),
    Row('lifecycle get', '/lamp: unconfigured [1]\n'),
    Row('lifecycle get /lamp', 'unconfigured [1]\n'),
    Row('lifecycle get /nope', '', 'Node not found\n', 1),
    Row('lifecycle list /nope', '', 'Node not found\n', 1),
    Row('lifecycle set /nope configure', '', 'Node not found\n', 1),
    Row(
        'lifecycle list lamp',
        '- configure [1]\n\tStart: unconfigured\n\tGoal: configuring\n'
        '- shutdown [5]\n\tStart: unconfigured\n\tGoal: shuttingdown\n',
    ),
    Row(
        'lifecycle set lamp fly',
        '',
        'Unknown transition requested, available ones are:\n- configure [1]\n- shutdown [5]\n',
        1,
    ),
    Row('lifecycle set lamp configure', 'Transitioning successful\n'),
    Row('lifecycle set lamp cleanup', 'Transitioning successful\n'),
    Row('component list'),
    Row('component list /nope', '', "Unable to find container node '/nope'\n", 1),
    Row('component load /nope a b', '', "Unable to find container node '/nope'\n", 1),
    Row('component unload /nope 1', '', "Unable to find container node '/nope'\n", 1),
]


@pytest.mark.parametrize('row', ROWS, ids=lambda row: row.words)
def test_whole_output(row: Row, ros2_robot: Ros2) -> None:
    """The three of a command are as the contract has them."""
    result = ros2_robot(*shlex.split(row.words))
    output = re.sub('ID: [0-9a-f]{32}', 'ID: ID', result.stdout)
    assert (output, result.stderr, result.returncode) == row[1:]


def test_types_of_services(ros2_robot: Ros2) -> None:
    """Each service has its type in brackets; those of parameters and states are sorted in."""
    lines = ros2_robot('service', 'list', '--show-types').stdout.splitlines(keepends=True)
    assert [line.partition(' ')[0] for line in lines] == SERVICES
    typed = ''.join(lines)
    assert f'/flip [{SERVICE}]\n' in typed
    for name in ('get_parameters', 'change_state'):
        assert service_types(name) == ''.join(line for line in lines if f'/{name} ' in line)


USAGE_ERRORS = [
    *((f'param {verb}', 'node_name') for verb in ('get', 'set', 'describe', 'dump', 'load')),
    ('param delete', 'node_name, parameter_name'),
    ('param get /a', 'parameter_name'),
    ('param set /a b', 'value'),
    ('param describe /a', 'parameter_names'),
    ('param load /a', 'parameter_file'),
    ('service type', 'service_name'),
    ('service find', 'service_type'),
    ('service info', 'service_name'),
    ('service call /a', 'service_type'),
    ('service echo', 'service_name'),
    ('interface show', 'type'),
    ('interface proto', 'type'),
    ('interface package', 'package_name'),
    ('action type', 'action_name'),
    ('action info', 'action_name'),
    ('action send_goal /a', 'action_type'),
    ('lifecycle list', 'node_name'),
    ('lifecycle set /a', 'transition'),
    ('component load', 'container_node_name'),
    ('component unload /a', 'component_uid'),
    ('component standalone', 'package_name'),
]


@pytest.mark.parametrize(('words', 'missing'), USAGE_ERRORS)
def test_missing_word_is_a_usage_error(words: str, missing: str, ros2_here: Ros2) -> None:
    """A missing argument is named after the usage of the verb; the status is 2."""
    result = ros2_here(*words.split())
    command, verb = words.split()[:2]
    assert (result.returncode, result.stdout) == (2, '')
    assert result.stderr.startswith(f'usage: ros2 {command} {verb} [-h]')
    last = result.stderr.splitlines()[-1]
    text = f'ros2 {command} {verb}: error: the following arguments are required: {missing}'
    assert last.startswith(text)


@pytest.mark.parametrize(
    ('words', 'error'),
    [
        ('param list --filter [', "argument --filter: '[' is not a regular expression: "),
        ('param get /a b --timeout 0', "argument --timeout: '0' is not a number above zero"),
        ('service call /a b --rate x', "argument -r/--rate: 'x' is not a number above zero"),
        ('service echo /a --qos-reliability x', "argument --qos-reliability: invalid choice: 'x'"),
        ('service list --spin-time x', "argument --spin-time: 'x' is not a number above zero"),
        ('interface show --all-comments --no-comments a', 'argument --no-comments: not allowed'),
        ('component unload /a x', "argument component_uid: 'x' is not a whole number"),
        ('multicast send --port x', "argument -p/--port: 'x' is not a number from 1 to 65535"),
        ('multicast receive --group x', "argument -g/--group: 'x' is not an IPv4 address"),
        ('doctor --report --report-failed', 'argument -rf/--report-failed: not allowed with'),
        ('doctor hello --ttl x', "argument --ttl: 'x' is not a number from 0 to 255"),
    ],
)
def test_wrong_value_is_a_usage_error(words: str, error: str, ros2_here: Ros2) -> None:
    """A value that cannot be meant is named with its option; the status is 2."""
    result = ros2_here(*words.split())
    assert (result.returncode, result.stdout) == (2, '')
    assert f'error: {error}' in result.stderr


@pytest.mark.parametrize('words', ['service call', 'action send_goal'])
def test_values_from_two_sources(words: str, ros2_here: Ros2) -> None:
    """Values on the command line and on standard input exclude each other."""
    result = ros2_here(*words.split(), '/a', 'b', '{}', '--stdin')
    assert (result.returncode, result.stdout) == (2, '')
    assert ': not allowed with argument ' in result.stderr.splitlines()[-1]


@pytest.mark.parametrize(
    'words',
    [
        'param nope',
        'service nope',
        'interface nope',
        'action nope',
        'daemon nope',
        'doctor nope',
        'lifecycle nope',
        'component nope',
        'multicast nope',
    ],
)
def test_unknown_verb_is_a_usage_error(words: str, ros2_here: Ros2) -> None:
    """The error has the form of argparse and lists the verbs."""
    result = ros2_here(*words.split())
    command = words.split()[0]
    assert (result.returncode, result.stdout) == (2, '')
    assert (
        f'ros2 {command}: error: argument Call `ros2 {command} <verb> -h` for more detailed '
        "usage.: invalid choice: 'nope' (choose from '"
    ) in result.stderr


def test_unknown_package_of_interfaces(ros2_here: Ros2) -> None:
    """All verbs that take a package say the same of one that is not there."""
    for words in ('package nope', 'show nope/msg/X', 'proto nope/msg/X'):
        result = ros2_here('interface', *words.split())
        assert (result.returncode, result.stdout) == (1, '')
        assert result.stderr.startswith(NO_INTERFACE.format('nope'))


def test_load_of_a_file(tmp_path: Path, ros2_robot: Ros2) -> None:
    """What was set is on stdout, what was refused on stderr; the status is that of success."""
    path = tmp_path / 'arm.yaml'
    path.write_text('/**:\n  ros__parameters: {speed: 0.5, label: right}\n')
    result = ros2_robot('param', 'load', ARM, str(path))
    assert (result.stdout, result.stderr, result.returncode) == (
        'Set parameter speed successful\n',
        'Set parameter label failed: this is the left arm\n',
        0,
    )
    result = ros2_robot('param', 'load', ARM, str(path), '--no-use-wildcard')
    assert (result.stdout, result.stderr, result.returncode) == (
        '',
        f"The parameter file '{path}' does not contain parameters for {ARM}, only for nodes: "
        "['/**']\n",
        1,
    )
