# SPDX-License-Identifier: Apache-2.0
"""Tests of the verbs of `ros2 service` with real services."""

from collections.abc import Callable
import signal
from subprocess import CompletedProcess
from typing import Any

import pytest

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]

TYPE = 'std_srvs/srv/SetBool'


def test_list(ros2_robot: Ros2) -> None:
    """Services are sorted; hidden ones and types are shown on request."""
    names = ros2_robot('service', 'list').stdout.splitlines()
    assert names == sorted(names)
    assert {'/flip', '/robot1/arm/get_parameters', '/lamp/get_state'} <= set(names)
    assert not any('/_' in name for name in names)
    typed = ros2_robot('service', 'list', '-t', '--include-hidden-services').stdout.splitlines()
    assert f'/flip [{TYPE}]' in typed
    assert '/robot1/_secret [std_srvs/srv/Trigger]' in typed
    assert ros2_robot('service', 'list', '-c').stdout == f'{len(names)}\n'


def test_type_and_find(ros2_robot: Ros2) -> None:
    """A service has a type and a type has services; unknown ones print nothing."""
    assert ros2_robot('service', 'type', '/flip').stdout == f'{TYPE}\n'
    assert ros2_robot('service', 'find', TYPE).stdout == '/flip\n'
    assert ros2_robot('service', 'find', TYPE, '-c').stdout == '1\n'
    unknown = ros2_robot('service', 'type', '/nope')
    assert (unknown.returncode, unknown.stdout, unknown.stderr) == (1, '', '')
    none = ros2_robot('service', 'find', 'nope/srv/Nope')
    assert (none.returncode, none.stdout, none.stderr) == (0, '', '')


def test_info_counts(ros2_robot: Ros2) -> None:
    """The info has the type and the numbers of clients and servers."""
    assert ros2_robot('service', 'info', '/flip').stdout == (
        f'Type: {TYPE}\nClients count: 0\nServices count: 1\n'
    )
    assert ros2_robot('service', 'info', '/fire').stdout == (
        'Type: std_srvs/srv/Trigger\nClients count: 1\nServices count: 0\n'
    )


def test_info_of_unknown_service_suggests(ros2_robot: Ros2) -> None:
    """A name without its slash is unknown, and the error says so."""
    result = ros2_robot('service', 'info', 'flip')
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr == "Unknown service 'flip'\nDid you mean '/flip'?\n"


def test_call(ros2_robot: Ros2) -> None:
    """A call shows the request and the response, each followed by an empty line."""
    result = ros2_robot('service', 'call', '/flip', TYPE, '{data: true}')
    assert result.stdout == (
        'requester: making request: std_srvs.srv.SetBool_Request(data=True)\n\n'
        "response:\nstd_srvs.srv.SetBool_Response(success=True, message='hello')\n\n"
    )
    assert (result.returncode, result.stderr) == (0, '')


def test_call_at_a_rate(start_at_robot: Start) -> None:
    """A rate repeats the call until Ctrl-C, which is quiet."""
    process = start_at_robot('service', 'call', 'flip', TYPE, '-r', '20')
    calls = [process.stdout.readline() for _ in range(5 * 12)]
    assert sum(line.startswith('requester: making request:') for line in calls) == 12
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=100) == 2
    assert process.stderr.read() == ''


@pytest.mark.parametrize(
    ('words', 'error'),
    [
        (['std_srvs/srv/Nope'], 'The passed service type is invalid'),
        (['nope'], 'The passed service type is invalid'),
        (['std_msgs/msg/String'], 'The passed type is not a service'),
        (
            [TYPE, '{nope: 1}'],
            "Failed to populate field: 'SetBool_Request' object has no attribute 'nope'",
        ),
    ],
)
def test_wrong_calls(words: list[str], error: str, ros2_here: Ros2) -> None:
    """What cannot be called is an error before anything is waited for."""
    result = ros2_here('service', 'call', '/flip', *words)
    assert (result.returncode, result.stdout) == (1, '')
    assert result.stderr.splitlines()[0] == error


@pytest.mark.parametrize(
    ('words', 'hint'),
    [
        (['/flp', TYPE], "Did you mean '/flip'?"),
        (
            ['/flip', 'std_srvs/srv/Trigger'],
            f"'/flip' has the type '{TYPE}', not 'std_srvs/srv/Trigger'.",
        ),
    ],
)
def test_missing_service_is_waited_for(words: list[str], hint: str, start_at_robot: Start) -> None:
    """The wait is announced, and after a while with what may be wrong."""
    process = start_at_robot('service', 'call', *words)
    assert process.stdout.readline() == 'waiting for service to become available...\n'
    assert process.stderr.readline() == (
        f"Still waiting for the service '{words[0]}' (Ctrl-C to stop). {hint}\n"
    )
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=100) == 2
    assert process.stderr.read() == ''


def test_echo_shows_request_and_response(start_at_robot: Start, ros2_robot: Ros2) -> None:
    """The events of a call are printed as YAML with the names of their kinds."""
    process = start_at_robot('service', 'echo', '/flip', '--no-arr')
    assert process.stderr.readline().startswith("Still waiting for events of the service '/flip'")
    ros2_robot('service', 'call', '/flip', TYPE, '{data: true}')
    lines = [process.stdout.readline().rstrip() for _ in range(20)]
    assert lines[:3] == ['info:', '  event_type: REQUEST_RECEIVED', '  stamp:']
    assert lines.count('---') == 2
    assert '  event_type: RESPONSE_SENT' in lines
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=100) == 2


def test_echo_of_unknown_service(ros2_robot: Ros2) -> None:
    """A service whose type is unknown cannot be echoed."""
    result = ros2_robot('service', 'echo', '/flp')
    assert result.returncode == 1
    assert result.stdout == 'WARNING: service [/flp] does not appear to be available yet\n'
    assert result.stderr == (
        "Could not determine the type for the passed service\nDid you mean '/flip'?\n"
    )
