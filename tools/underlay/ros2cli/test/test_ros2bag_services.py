# SPDX-License-Identifier: Apache-2.0
"""Tests of services in bags: recorded by their events, listed, played, and their requests sent."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
import signal
import subprocess
from subprocess import CompletedProcess
import sys
import time
from typing import Any

from example_interfaces.srv import AddTwoInts
import pytest
from rclpy.serialization import deserialize_message
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.definitions import definition_of
from ros2bag.storage.service_events import CallCounts, count_calls, Service, service_of

Start = Callable[..., Any]
Ros2 = Callable[..., CompletedProcess[str]]

TIMEOUT_S = 100.0
EVENTS = '/add/_service_event'
TYPE = 'example_interfaces/srv/AddTwoInts'


@pytest.fixture
def adder(ros_environment_variables: dict[str, str]) -> Iterator[None]:
    """Run a server with introspection, and a client of it that calls it all the time."""
    with _adder(ros_environment_variables):
        yield


@contextmanager
def _adder(variables: dict[str, str], *words: str) -> Iterator[subprocess.Popen[str]]:
    """Run a server with a client, or one alone that prints the sums; wait until it is ready."""
    process = subprocess.Popen(
        [sys.executable, str(Path(__file__).with_name('bag_adder.py')), *words],
        env=variables,
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stdout is not None and process.stdout.readline() == 'ready\n'
        yield process
    finally:
        process.kill()
        process.communicate()


def _record(start_ros2: Start, folder: Path, *words: str) -> None:
    process = start_ros2('bag', 'record', '-o', str(folder), *words)
    path = folder / f'{folder.name}_0.mcap'
    end = time.monotonic() + TIMEOUT_S
    while not path.exists() or path.stat().st_size < 6000:
        assert time.monotonic() < end
        time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=TIMEOUT_S)
    assert process.returncode == 0, errors


@pytest.mark.parametrize('words', [['--services', 'add'], ['--all-services'], ['-e', 'add$']])
def test_record_and_list(
    adder: None, start_ros2: Start, ros2_here: Ros2, tmp_path: Path, words: list[str]
) -> None:
    """The events have the requests, and `info` counts them as calls."""
    folder = tmp_path / 'bag'
    _record(start_ros2, folder, *words)
    assert [each.topic.name for each in BagReader(str(folder)).metadata.topics] == [EVENTS]
    recorded = BagReader(str(folder)).messages()
    events = [deserialize_message(message.data, AddTwoInts.Event) for message in recorded]
    requests = [event.request[0] for event in events if len(event.request)]
    assert requests and all((each.a, each.b) == (2, 3) for each in requests)
    info = ros2_here('bag', 'info', str(folder)).stdout
    count = len(events)
    assert 'Topic information:\nService:           1\n' in info
    assert (
        f'Service information: Service: /add | Type: {TYPE} | Event Count: {count} | '
        'Serialization Format: cdr\n'
    ) in info
    counts = count_calls(message.data for message in BagReader(str(folder)).messages())
    details = ros2_here('bag', 'info', '-v', str(folder)).stdout
    text = f'Request Count: {counts.requests} | Response Count: {counts.responses} |'
    assert text in details
    # Both the server and the client tell of a call.
    assert abs(4 * counts.requests - count) <= 4


def test_all_and_excluded(adder: None, start_ros2: Start, tmp_path: Path) -> None:
    """`-a` records services as well, except those that are left out."""
    _record(start_ros2, tmp_path / 'all', '-a')
    names = {each.topic.name for each in BagReader(str(tmp_path / 'all')).metadata.topics}
    assert {EVENTS, '/sums'} <= names
    _record(start_ros2, tmp_path / 'but', '-a', '--exclude-services', '/add')
    names = {each.topic.name for each in BagReader(str(tmp_path / 'but')).metadata.topics}
    assert '/sums' in names and EVENTS not in names


@pytest.mark.parametrize('source', ['service_introspection', 'client_introspection'])
def test_requests_are_sent_again(
    start_ros2: Start,
    ros_environment_variables: dict[str, str],
    tmp_path: Path,
    source: str,
) -> None:
    """A server gets the recorded requests, each once, and the events are not published."""
    folder = tmp_path / 'bag'
    with _adder(ros_environment_variables):
        _record(start_ros2, folder, '--services', '/add')
    count = count_calls(message.data for message in BagReader(str(folder)).messages()).requests
    with _adder(ros_environment_variables, 'server') as process:
        player = start_ros2(
            'bag', 'play', str(folder), '--publish-service-requests',
            '--service-requests-source', source, '-r', '10',
        )  # fmt: skip
        _, errors = player.communicate(timeout=TIMEOUT_S)
        assert player.returncode == 0, errors
        process.send_signal(signal.SIGINT)
        output, _ = process.communicate(timeout=TIMEOUT_S)
    received = output.split()
    assert set(received) == {'5'}
    assert abs(len(received) - count) <= 1  # the recording may have begun within a call


def test_requests_without_a_server(adder: None, start_ros2: Start, tmp_path: Path) -> None:
    """That nobody offers the service is said once; a misspelt one is an error."""
    folder = tmp_path / 'bag'
    _record(start_ros2, folder, '--services', '/add')
    words = ['bag', 'burst', str(folder), '--publish-service-requests']
    process = start_ros2(*words, '--remap', f'{EVENTS}:=/sub/_service_event')
    _, errors = process.communicate(timeout=TIMEOUT_S)
    text = "Requests of the service '/sub' are not sent: no server offers it now"
    assert (process.returncode, errors.count(text)) == (0, 1), errors
    process = start_ros2(*words, '--services', '/ad')
    _, errors = process.communicate(timeout=TIMEOUT_S)
    assert f"'{folder}' has no service '/ad'. Did you mean '/add'?" in errors


def test_service_of() -> None:
    """Both the name and the type of a topic have to be those of events."""
    assert service_of(EVENTS, f'{TYPE}_Event') == Service('/add', TYPE)
    assert service_of('/add', f'{TYPE}_Event') is None
    assert service_of(EVENTS, 'std_msgs/msg/Big_Event') is None


def test_counts_of_calls() -> None:
    """What client and server tell of is one call; bytes that are no events are left out."""
    from rclpy.serialization import serialize_message
    from service_msgs.msg import ServiceEventInfo

    def event(kind: int, number: int) -> bytes:
        info = ServiceEventInfo(event_type=kind, sequence_number=number)
        return bytes(serialize_message(AddTwoInts.Event(info=info)))

    events = [event(kind, number) for kind in range(4) for number in (1, 2)]
    assert count_calls([*events, event(0, 3), b'']) == CallCounts(3, 2)


def test_definition_of_events() -> None:
    """It has the request, the response and what is told of a call, with nested types."""
    from ament_index_python.packages import get_package_share_directory

    text = definition_of(f'{TYPE}_Event', get_package_share_directory).text
    assert text.startswith('service_msgs/ServiceEventInfo info\n')
    for section in (
        'MSG: service_msgs/ServiceEventInfo\n',
        f'MSG: {TYPE}_Request\n',
        f'MSG: {TYPE}_Response\n',
        'MSG: builtin_interfaces/Time\n',
    ):
        assert section in text
    assert 'int64 sum' in text.partition(f'MSG: {TYPE}_Response\n')[2]
