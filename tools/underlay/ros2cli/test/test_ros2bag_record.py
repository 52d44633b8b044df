# SPDX-License-Identifier: Apache-2.0
"""Tests of `ros2 bag record` with real nodes."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
import os
from pathlib import Path
import signal
import subprocess
from subprocess import CompletedProcess
import sys
import time
from typing import Any

from bag_samples import MS, START_NS, texts, write_bag
import pytest
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.salvage import Salvage
from rosbag2_interfaces.srv import IsPaused, Resume, Snapshot, SplitBagfile
from rosbags.highlevel import AnyReader

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]

TIMEOUT_S = 100.0
RATE_HZ = 200
ATTEMPTS = 5


@pytest.fixture
def start_talker(ros_environment_variables: dict[str, str]) -> Iterator[Callable[[], None]]:
    """Return a function that starts the talker and waits until it is there."""
    started = []

    def start() -> None:
        path = str(Path(__file__).with_name('bag_talker.py'))
        process = subprocess.Popen(
            [sys.executable, path, str(RATE_HZ)],
            env=ros_environment_variables,
            stdout=subprocess.PIPE,
            text=True,
        )
        started.append(process)
        assert process.stdout is not None
        assert process.stdout.readline() == 'ready\n'

    yield start
    for process in started:
        process.kill()
        process.communicate()


def _wait_for_messages(path: Path, count: int, start: int = 0) -> int:
    """Wait until so many messages are on the disk, and return how many there are."""
    end = time.monotonic() + TIMEOUT_S
    found = 0
    while found < start + count:
        assert time.monotonic() < end, f'only {found} messages in {path}'
        time.sleep(0.2)  # each look reads the whole file
        if path.exists() and path.stat().st_size > 8:
            found = sum(hasattr(each, 'sequence') for each in Salvage(str(path)).records())
    return found


def _stop(process: Any, number: signal.Signals = signal.SIGINT) -> tuple[int, str]:
    process.send_signal(number)
    _, errors = process.communicate(timeout=TIMEOUT_S)
    return process.returncode, errors


def _numbers(folder: Path, topic: str = '/ticks') -> list[int]:
    found = texts(BagReader(str(folder)).messages([topic]), topic)
    return [int(text.split()[0]) for text in found]


@pytest.mark.parametrize('number', [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_record_all(
    start_talker: Callable[[], None],
    start_ros2: Start,
    tmp_path: Path,
    number: signal.Signals,
) -> None:
    """All topics are recorded with what publishers offer, until a signal ends it properly."""
    folder = tmp_path / 'bag'
    process = start_ros2('bag', 'record', '-a', '-o', str(folder))
    start_talker()
    _wait_for_messages(folder / 'bag_0.mcap', 200)
    returned, errors = _stop(process, number)
    assert returned == 0, errors
    for topic in ('/ticks', '/sensor', '/description', '/later'):
        assert f"Subscribed to topic '{topic}'" in errors
    assert 'Traceback' not in errors
    assert sorted(os.listdir(folder)) == ['bag_0.mcap', 'metadata.yaml']
    numbers = _numbers(folder)
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))
    assert len(_numbers(folder, '/sensor')) > len(numbers) / 2
    for topic, text in (('/description', '<robot/>'), ('/later', 'late')):
        assert texts(BagReader(str(folder)).messages([topic]), topic) == [text]
    with AnyReader([folder]) as reader:
        qos = {c.topic: c.ext.offered_qos_profiles[0] for c in reader.connections}
        found = [(c.topic, bytes(raw), at) for c, at, raw in reader.messages()]
        first = next(raw for c, _, raw in reader.messages() if c.topic == '/ticks')
        assert reader.deserialize(first, 'std_msgs/msg/String').data.startswith(f'{numbers[0]} ')
    ours = [(each.topic, each.data, each.log_ns) for each in BagReader(str(folder)).messages()]
    assert sorted(found) == sorted(ours)
    assert qos['/description'].durability.name == 'TRANSIENT_LOCAL'
    assert qos['/sensor'].reliability.name == 'BEST_EFFORT'


def test_topic_that_does_not_appear_is_named(
    start_talker: Callable[[], None], start_ros2: Start, tmp_path: Path
) -> None:
    """Who misspells one of the topics is told so after a while, and again at the end."""
    start_talker()
    words = ['bag', 'record', '--topics', '/ticks', '/sensr', '-o', str(tmp_path / 'bag')]
    process = start_ros2(*words)
    _expect_line(process, "Not there yet: /sensr. Did you mean '/sensor'?")
    returned, errors = _stop(process)
    assert returned == 0
    assert 'Not recorded: /sensr never appeared.' in errors
    assert len(_numbers(tmp_path / 'bag')) > 0


def test_second_type_of_a_topic_is_left_out(start_ros2: Start, tmp_path: Path) -> None:
    """When others start to publish another type on a topic, the recording says so and goes on."""
    folder = tmp_path / 'bag'
    process = start_ros2('bag', 'record', '--topics', '/mixed', '-o', str(folder))
    _publish(start_ros2, 'text', 'reliable')
    _wait_for_messages(folder / 'bag_0.mcap', 20)
    start_ros2('topic', 'pub', '/mixed', 'std_msgs/msg/Int32', '{data: 1}', '-r', '50')
    _expect_line(process, "Only std_msgs/msg/String is recorded on topic '/mixed'")
    _wait_for_messages(folder / 'bag_0.mcap', 20, _size_of_messages(folder))
    assert _stop(process)[0] == 0
    assert set(texts(BagReader(str(folder)).messages(), '/mixed')) == {'text'}


def test_type_that_is_not_installed_is_left_out(
    start_talker: Callable[[], None],
    start_ros2: Start,
    tmp_path: Path,
    ros_environment_variables: dict[str, str],
) -> None:
    """A topic whose package is missing is named, and the others are recorded."""
    (tmp_path / 'shadow' / 'sensor_msgs').mkdir(parents=True)
    (tmp_path / 'shadow' / 'sensor_msgs' / '__init__.py').touch()
    path = f'{tmp_path}/shadow:{ros_environment_variables["PYTHONPATH"]}'
    start_talker()
    start_ros2('topic', 'pub', '/heat', 'sensor_msgs/msg/Temperature', '{}', '-r', '50')
    folder = tmp_path / 'bag'
    words = ['bag', 'record', '-a', '-o', str(folder)]
    process = start_ros2(*words, extra={'PYTHONPATH': path})
    _expect_line(process, "Topic '/heat' is not recorded: the package 'sensor_msgs'")
    _wait_for_messages(folder / 'bag_0.mcap', 20)
    assert _stop(process)[0] == 0
    assert '/heat' not in [each.topic.name for each in BagReader(str(folder)).metadata.topics]


def test_what_arrived_before_the_signal_is_recorded(
    start_ros2: Start,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    ros_environment_variables: dict[str, str],
) -> None:
    """A burst that is followed by Ctrl-C at once is in the bag to the last message."""
    from rclpy.duration import Duration
    from std_msgs.msg import String

    process = start_ros2('bag', 'record', '--topics', '/ticks', '-o', str(tmp_path / 'bag'))
    with _node(ros_environment_variables, monkeypatch) as (node, _):
        publisher = node.create_publisher(String, '/ticks', 1000)
        _expect_line(process, "Subscribed to topic '/ticks'")
        end = time.monotonic() + TIMEOUT_S
        while not publisher.get_subscription_count():
            assert time.monotonic() < end
            time.sleep(0.01)
        for number in range(300):
            publisher.publish(String(data=str(number)))
        assert publisher.wait_for_all_acked(Duration(seconds=TIMEOUT_S))
        assert _stop(process)[0] == 0
    assert _numbers(tmp_path / 'bag') == list(range(300))


def test_times_are_those_of_arrival_and_of_sending(
    start_talker: Callable[[], None], start_ros2: Start, tmp_path: Path
) -> None:
    """Both times are on the clock of the machine, and close to what the message says."""
    folder = tmp_path / 'bag'
    process = start_ros2('bag', 'record', '--topics', 'ticks', '-o', str(folder), '-q')
    start_talker()
    _wait_for_messages(folder / 'bag_0.mcap', 100)
    assert _stop(process) == (0, '')
    messages = list(BagReader(str(folder)).messages())
    said_ns = [int(text.split()[1]) for text in texts(messages, '/ticks')]
    assert all(each.log_ns >= each.publish_ns for each in messages)
    delays_ns = [each.publish_ns - said for each, said in zip(messages, said_ns)]
    assert sum(delays_ns) / len(delays_ns) < 20_000_000


def test_killed_recorder_loses_little(
    start_talker: Callable[[], None], start_ros2: Start, ros2_here: Ros2, tmp_path: Path
) -> None:
    """After kill -9 everything but the last 0.2 s is there; on a busy machine in one of some."""
    start_talker()
    lost_s = []
    for attempt in range(ATTEMPTS):
        folder = tmp_path / f'bag{attempt}'
        process = start_ros2('bag', 'record', '--topics', '/ticks', '-o', str(folder), '-q')
        _wait_for_messages(folder / f'{folder.name}_0.mcap', 200)
        killed_ns = time.time_ns()
        process.kill()
        process.wait(timeout=TIMEOUT_S)
        assert ros2_here('bag', 'recover', str(folder)).returncode == 0
        numbers = _numbers(folder)
        assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))
        lost_s.append((killed_ns - BagReader(str(folder)).metadata.span.end_ns) / 1e9)
        if lost_s[-1] <= 0.2:
            return
    pytest.fail(f'lost in each attempt: {lost_s} s')


def test_paused_recorder_waits_for_its_service(
    start_talker: Callable[[], None],
    start_ros2: Start,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    ros_environment_variables: dict[str, str],
) -> None:
    """Nothing is recorded before the service says so, but the latched messages are not lost."""
    folder = tmp_path / 'bag'
    process = start_ros2('bag', 'record', '-a', '-o', str(folder), '--start-paused')
    start_talker()
    _expect_line(process, "Subscribed to topic '/later'")
    assert _size_of_messages(folder) == 0
    assert _call('is_paused', IsPaused, ros_environment_variables, monkeypatch).paused
    _call('resume', Resume, ros_environment_variables, monkeypatch)
    _wait_for_messages(folder / 'bag_0.mcap', 50)
    assert _stop(process)[0] == 0
    assert texts(BagReader(str(folder)).messages(), '/description') == ['<robot/>']


def test_split_repeats_latched_messages(
    start_talker: Callable[[], None], start_ros2: Start, tmp_path: Path
) -> None:
    """Each file of a split recording has the description."""
    folder = tmp_path / 'bag'
    process = start_ros2('bag', 'record', '-a', '-o', str(folder), '-d', '0.5', '-q')
    start_talker()
    _wait_for_messages(folder / 'bag_2.mcap', 20)
    assert _stop(process) == (0, '')
    files = BagReader(str(folder)).metadata.files
    assert len(files) >= 3
    for file in files:
        part = BagReader(str(folder / file.path))
        assert texts(part.messages(['/description']), '/description') == ['<robot/>']
    numbers = _numbers(folder)
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))


def test_service_splits_the_recording(
    start_talker: Callable[[], None],
    start_ros2: Start,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    ros_environment_variables: dict[str, str],
) -> None:
    """The next file begins with the latched messages, and a topic tells of it."""
    folder = tmp_path / 'bag'
    start_talker()
    process = start_ros2('bag', 'record', '-a', '-o', str(folder))
    told = start_ros2(
        'topic', 'echo', '--once', '/events/write_split', 'rosbag2_interfaces/msg/WriteSplitEvent'
    )
    _wait_for_messages(folder / 'bag_0.mcap', 20)
    _wait_for_subscriber('/events/write_split', ros_environment_variables, monkeypatch)
    _call('split_bagfile', SplitBagfile, ros_environment_variables, monkeypatch)
    _wait_for_messages(folder / 'bag_1.mcap', 20)
    assert _stop(process)[0] == 0
    part = BagReader(str(folder / 'bag_1.mcap'))
    assert texts(part.messages(['/description']), '/description') == ['<robot/>']
    output, _ = told.communicate(timeout=TIMEOUT_S)
    assert output.splitlines()[:2] == [
        f'closed_file: {folder}/bag_0.mcap',
        f'opened_file: {folder}/bag_1.mcap',
    ]


def _wait_for_subscriber(
    topic: str, variables: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    with _node(variables, monkeypatch) as (node, _):
        end = time.monotonic() + TIMEOUT_S
        while not (node.count_subscribers(topic) and node.count_publishers(topic)):
            assert time.monotonic() < end
            time.sleep(0.05)
        time.sleep(0.5)


def test_snapshot(
    start_talker: Callable[[], None],
    start_ros2: Start,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    ros_environment_variables: dict[str, str],
) -> None:
    """Nothing is written until the service is called: then the last messages, and latched ones."""
    folder = tmp_path / 'bag'
    words = ['-a', '-o', str(folder), '--snapshot-mode', '--max-cache-size', '4000']
    process = start_ros2('bag', 'record', *words)
    start_talker()
    _expect_line(process, "Subscribed to topic '/later'")
    time.sleep(1.0)
    assert _size_of_messages(folder) == 0
    assert _call('snapshot', Snapshot, ros_environment_variables, monkeypatch).success
    assert _stop(process)[0] == 0
    numbers = _numbers(folder)
    assert numbers == list(range(numbers[0], numbers[0] + len(numbers)))
    assert numbers[0] > 0 and 10 < len(numbers) < 130
    messages = list(BagReader(str(folder)).messages())
    assert texts(messages, '/description') == ['<robot/>']
    assert {each.topic for each in messages[:2]} >= {'/description'}


def test_topics_without_subscribers_are_ignored(
    start_talker: Callable[[], None], start_ros2: Start, tmp_path: Path
) -> None:
    """With --ignore-leaf-topics a topic is recorded once somebody else subscribes to it."""
    folder = tmp_path / 'bag'
    start_talker()
    start_ros2('topic', 'echo', '/sensor', 'std_msgs/msg/String')
    process = start_ros2('bag', 'record', '-a', '-o', str(folder), '--ignore-leaf-topics')
    _wait_for_messages(folder / 'bag_0.mcap', 20)
    start_ros2('topic', 'echo', '/ticks', 'std_msgs/msg/String')
    _expect_line(process, "Subscribed to topic '/ticks'")
    assert _stop(process)[0] == 0
    names = {each.topic.name for each in BagReader(str(folder)).metadata.topics}
    assert {'/sensor', '/ticks'} <= names
    assert '/description' not in names


def test_simulated_time_is_recorded(start_ros2: Start, tmp_path: Path) -> None:
    """With --use-sim-time the messages have the time of /clock; without a clock it waits."""
    write_bag(tmp_path / 'old', count=6000)
    folder = tmp_path / 'new'
    process = start_ros2(
        'bag', 'record', '--topics', '/ticks', '-o', str(folder), '--use-sim-time'
    )
    _expect_line(process, 'Still waiting for the time on /clock')
    assert not folder.exists()
    start_ros2('bag', 'play', str(tmp_path / 'old'), '--clock', '100')
    _wait_for_messages(folder / 'new_0.mcap', 50)
    assert _stop(process)[0] == 0
    messages = list(BagReader(str(folder)).messages())
    numbers = [int(text) for text in texts(messages, '/ticks')]
    late_ns = [
        each.log_ns - START_NS - number * 10 * MS for each, number in zip(messages, numbers)
    ]
    assert abs(sum(late_ns) / len(late_ns)) < 200 * MS


def test_weaker_publisher_is_heard_as_well(start_ros2: Start, tmp_path: Path) -> None:
    """A best-effort publisher that comes later is recorded together with the reliable one."""
    folder = tmp_path / 'bag'
    process = start_ros2('bag', 'record', '--topics', '/mixed', '-o', str(folder), '-q')
    _publish(start_ros2, 'strong', 'reliable')
    _wait_for_messages(folder / 'bag_0.mcap', 20)
    _publish(start_ros2, 'weak', 'best_effort')
    end = time.monotonic() + TIMEOUT_S
    while b'weak' not in (folder / 'bag_0.mcap').read_bytes():
        assert time.monotonic() < end
        time.sleep(0.05)
    _wait_for_messages(folder / 'bag_0.mcap', 20, _size_of_messages(folder))
    assert _stop(process) == (0, '')
    with AnyReader([folder]) as reader:
        assert len(list(reader.messages())) == reader.message_count
    heard = texts(BagReader(str(folder)).messages(), '/mixed')
    assert set(heard[-20:]) == {'strong', 'weak'}


def test_without_discovery_later_topics_are_left_out(
    start_talker: Callable[[], None], start_ros2: Start, tmp_path: Path
) -> None:
    """With --no-discovery only the topics that are there at the start are recorded."""
    start_talker()
    folder = tmp_path / 'bag'
    process = start_ros2('bag', 'record', '-a', '-o', str(folder), '--no-discovery')
    _wait_for_messages(folder / 'bag_0.mcap', 100)
    _, errors = _stop(process)
    assert "'/ticks'" in errors
    assert "'/later'" not in errors


def test_existing_folder_is_refused(ros2_here: Ros2, tmp_path: Path) -> None:
    """A folder that exists is left alone."""
    result = ros2_here('bag', 'record', '-a', '-o', str(tmp_path))
    assert result.returncode == 1
    assert result.stderr == (
        f"Output folder '{tmp_path}' already exists: name another one with -o, or delete it\n"
    )


def _publish(start_ros2: Start, text: str, reliability: str) -> None:
    words = ['topic', 'pub', '/mixed', 'std_msgs/msg/String', f'{{data: {text}}}', '-r', '50']
    start_ros2(*words, '--qos-reliability', reliability, '-n', text)


def _expect_line(process: Any, text: str) -> None:
    for line in process.stderr:
        if text in line:
            return
    pytest.fail(f'no line with {text!r}')


def _size_of_messages(folder: Path) -> int:
    path = folder / 'bag_0.mcap'
    return sum(hasattr(each, 'sequence') for each in Salvage(str(path)).records())


def _call(name: str, kind: Any, variables: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> Any:
    """Call a service of the recorder once it is there, and return its response."""
    from rclpy.executors import SingleThreadedExecutor

    with _node(variables, monkeypatch) as (node, context):
        executor = SingleThreadedExecutor(context=context)
        executor.add_node(node)
        client = node.create_client(kind, f'/rosbag2_recorder/{name}')
        assert client.wait_for_service(timeout_sec=TIMEOUT_S)
        end = time.monotonic() + TIMEOUT_S
        answer = None
        while answer is None:  # a server drops its response to a client not discovered yet
            assert time.monotonic() < end, f'no answer of {name}'
            future = client.call_async(kind.Request())
            executor.spin_until_future_complete(future, timeout_sec=5.0)
            answer = future.result()
        executor.shutdown()
    return answer


@contextmanager
def _node(variables: dict[str, str], monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[Any, Any]]:
    """Run a node in the domain of the tests; yield it and its context."""
    import rclpy

    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=int(variables['ROS_DOMAIN_ID']))
    node = rclpy.create_node('tester', context=context)
    try:
        yield node, context
    finally:
        node.destroy_node()
        rclpy.shutdown(context=context)
