# SPDX-License-Identifier: Apache-2.0
"""Tests of the verbs of `ros2 multicast`."""

from collections.abc import Callable
import os
import re
import signal
from subprocess import CompletedProcess
from typing import Any

import pytest

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]


def test_packet_is_received(start_ros2: Start, ros2_here: Ros2) -> None:
    """What one command sends, another receives and shows with its sender."""
    port = str(20000 + os.getpid() % 20000)
    receiver = start_ros2('multicast', 'receive', '--port', port)
    assert receiver.stdout.readline() == 'Waiting for UDP multicast datagram...\n'
    assert receiver.stderr.readline().startswith('Still waiting for a packet to 225.0.0.1:')
    sent = ros2_here('multicast', 'send', '--port', port, '--ttl', '1')
    if 'cannot be sent' in sent.stderr:
        pytest.skip(sent.stderr)
    assert (sent.returncode, sent.stdout) == (0, 'Sending one UDP multicast datagram...\n')
    output, _ = receiver.communicate(timeout=100)
    assert re.fullmatch(r"Received from [\d.]+:\d+: 'Hello World!'\n", output)
    assert receiver.returncode == 0


def test_interrupt_is_quiet(start_ros2: Start) -> None:
    """Ctrl-C ends the wait for a packet with the status of the signal."""
    receiver = start_ros2('multicast', 'receive', '--group', '225.0.0.9')
    assert receiver.stdout.readline() == 'Waiting for UDP multicast datagram...\n'
    receiver.send_signal(signal.SIGINT)
    _, errors = receiver.communicate(timeout=100)
    assert (receiver.returncode, errors) == (2, '')


@pytest.mark.parametrize(
    ('words', 'error'),
    [
        (['--group', '10.0.0.1'], "'10.0.0.1' is not a multicast address"),
        (['--group', 'all'], "'all' is not an IPv4 address"),
        (['--port', '70000'], "'70000' is not a number from 1 to 65535"),
        (['--ttl', '-1'], "'-1' is not a number from 0 to 255"),
    ],
)
def test_wrong_addresses_are_usage_errors(words: list[str], error: str, ros2_here: Ros2) -> None:
    """An address that cannot be is named with what it must be."""
    result = ros2_here('multicast', 'send', *words)
    assert result.returncode == 2
    assert error in result.stderr
