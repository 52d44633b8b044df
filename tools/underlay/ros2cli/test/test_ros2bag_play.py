# SPDX-License-Identifier: Apache-2.0
"""Tests of `ros2 bag play` with real subscribers."""

from collections.abc import Callable, Iterator
from pathlib import Path
import signal
from subprocess import CompletedProcess
import time
from typing import Any

from bag_samples import LATCHED, MS, start_bag, START_NS, string, topic, write_bag
from builtin_interfaces.msg import Time
import pytest
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile
from ros2bag.storage.metadata import Topic
from ros2bag.storage.offered_qos import OfferedQos
from rosbag2_interfaces.msg import ReadSplitEvent
from rosbag2_interfaces.srv import (
    Burst,
    GetRate,
    IsPaused,
    Pause,
    Play,
    PlayNext,
    Resume,
    Seek,
    SetRate,
    Stop,
    TogglePaused,
)
from rosgraph_msgs.msg import Clock
from std_msgs.msg import String

Start = Callable[..., Any]
Ros2 = Callable[..., CompletedProcess[str]]

TIMEOUT_S = 100.0
ATTEMPTS = 5
PERIOD_MS = 20.0


class Ear:
    """A node that keeps what it hears and when."""

    def __init__(self, node: Any, executor: Any) -> None:
        self._node = node
        self._executor = executor
        self._clients: dict[str, Any] = {}
        self.heard: list[tuple[str, Any, float]] = []

    def listen(self, name: str, message_type: Any = String, *, latched: bool = False) -> None:
        """Subscribe to a topic."""
        durability = DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE
        self._node.create_subscription(
            message_type,
            name,
            lambda message: self.heard.append((name, message, time.monotonic())),
            QoSProfile(depth=1000, durability=durability),
        )

    def client(self, name: str, kind: Any) -> Any:
        """Return the client of a service of the player, which has had time to know it."""
        if name not in self._clients:
            self._clients[name] = self._node.create_client(kind, f'/rosbag2_player/{name}')
            self.spin_until(self._clients[name].service_is_ready)
            settled = time.monotonic() + 0.5  # until then a server may drop its response
            self.spin_until(lambda: time.monotonic() > settled)
        return self._clients[name]

    def call(self, name: str, kind: Any, **fields: Any) -> Any:
        """Call a service of the player, and return its response."""
        future = self.client(name, kind).call_async(kind.Request(**fields))
        self.spin_until(future.done)
        return future.result()

    def texts(self, name: str) -> list[str]:
        """Return the texts heard on a topic."""
        return [message.data for heard, message, _ in self.heard if heard == name]

    def times_s(self, name: str) -> list[float]:
        """Return when messages of a topic were heard."""
        return [at_s for heard, _, at_s in self.heard if heard == name]

    def spin_until(self, is_done: Callable[[], object]) -> None:
        """Hear until there is enough."""
        end = time.monotonic() + TIMEOUT_S
        while not is_done():
            assert time.monotonic() < end, f'heard only {len(self.heard)} messages'
            self._executor.spin_once(timeout_sec=0.05)

    def spin_with(self, process: Any) -> str:
        """Hear until a process ends well, and return what it wrote on stderr."""
        self.spin_until(lambda: process.poll() is not None)
        self._executor.spin_once(timeout_sec=0.05)
        errors = process.communicate()[1]
        assert process.returncode == 0, errors
        return str(errors)


@pytest.fixture
def ear(
    ros_environment_variables: dict[str, str], monkeypatch: pytest.MonkeyPatch
) -> Iterator[Ear]:
    """Return a listener in the domain of the tests."""
    monkeypatch.setenv('ROS_AUTOMATIC_DISCOVERY_RANGE', 'LOCALHOST')
    context = rclpy.Context()
    rclpy.init(context=context, domain_id=int(ros_environment_variables['ROS_DOMAIN_ID']))
    node = rclpy.create_node('ear', context=context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    yield Ear(node, executor)
    executor.shutdown()
    node.destroy_node()
    rclpy.shutdown(context=context)


def test_play_is_complete_and_in_order(ear: Ear, start_ros2: Start, tmp_path: Path) -> None:
    """A subscriber that is there gets all messages, from the first on, and the latched one."""
    write_bag(tmp_path / 'bag', count=50)
    ear.listen('/ticks')
    ear.listen('/description', latched=True)
    errors = ear.spin_with(start_ros2('bag', 'play', str(tmp_path / 'bag')))
    assert ear.texts('/ticks') == [str(number) for number in range(50)]
    assert ear.texts('/description') == ['<robot/>']
    assert 'Played 51 messages.' in errors


def test_next_files_are_announced(ear: Ear, start_ros2: Start, tmp_path: Path) -> None:
    """When messages come from another file of the bag, a topic names both."""
    folder = tmp_path / 'bag'
    write_bag(folder, count=90, max_duration_ns=250 * MS)
    ear.listen('/ticks')
    ear.listen('/events/read_split', ReadSplitEvent)
    ear.spin_with(start_ros2('bag', 'play', str(folder)))
    assert ear.texts('/ticks') == [str(number) for number in range(90)]
    told = [each for name, each, _ in ear.heard if name == '/events/read_split']
    paths = [str(folder / f'bag_{number}.mcap') for number in range(len(told) + 1)]
    assert [each.closed_file for each in told] == paths[:-1]
    assert [each.opened_file for each in told] == paths[1:]
    assert len(told) >= 2 and not (folder / f'bag_{len(paths)}.mcap').exists()


@pytest.mark.parametrize('rate', [1.0, 2.0])
def test_times_between_messages(ear: Ear, start_ros2: Start, tmp_path: Path, rate: float) -> None:
    """The mean time between messages is right, however late a busy machine plays each of them."""
    write_bag(tmp_path / 'bag', count=100, period_ns=int(PERIOD_MS * MS))
    ear.listen('/ticks')
    means_ms = []
    for _ in range(ATTEMPTS):
        ear.heard.clear()
        ear.spin_with(start_ros2('bag', 'play', str(tmp_path / 'bag'), '-r', str(rate)))
        times_s = ear.times_s('/ticks')
        assert len(times_s) == 100
        means_ms.append((times_s[-1] - times_s[0]) / 99 * 1e3)
        if means_ms[-1] == pytest.approx(PERIOD_MS / rate, rel=0.1):
            return
    pytest.fail(f'mean times of {means_ms} ms')


def test_part_of_the_topics_and_of_the_time(ear: Ear, start_ros2: Start, tmp_path: Path) -> None:
    """Offset, duration, choice and new names of topics."""
    write_bag(tmp_path / 'bag', count=100)
    ear.listen('/copy')
    ear.listen('/ticks')
    ear.listen('/description', latched=True)
    process = start_ros2(
        'bag', 'play', str(tmp_path / 'bag'), '--topics', 'ticks', '--remap', 'ticks:=copy',
        '--start-offset', '0.5', '--playback-duration', '0.2',
    )  # fmt: skip
    ear.spin_with(process)
    assert ear.texts('/copy') == [str(number) for number in range(50, 71)]
    assert len(ear.heard) == 21


def test_loop_until_interrupted(ear: Ear, start_ros2: Start, tmp_path: Path) -> None:
    """The end is followed by the beginning, until Ctrl-C ends it."""
    write_bag(tmp_path / 'bag', count=10)
    ear.listen('/ticks')
    process = start_ros2('bag', 'play', str(tmp_path / 'bag'), '--loop')
    ear.spin_until(lambda: len(ear.heard) >= 25)
    assert ear.texts('/ticks')[:25] == [str(number % 10) for number in range(25)]
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=TIMEOUT_S)
    assert (process.returncode, 'Traceback' in errors) == (2, False)


def test_clock_shows_recorded_time(ear: Ear, start_ros2: Start, tmp_path: Path) -> None:
    """With --clock the recorded time is published, at about the wanted rate, and only that."""
    writer = start_bag(tmp_path / 'bag', topic('/ticks'))
    for number in range(100):
        writer.write(string('/ticks', str(number), number * 10 * MS))
    writer.close()
    ear.listen('/clock', Clock)
    ear.spin_with(start_ros2('bag', 'play', str(tmp_path / 'bag'), '--clock', '50'))
    stamps = [m.clock.sec * 10**9 + m.clock.nanosec - START_NS for _, m, _ in ear.heard]
    assert stamps == sorted(stamps)
    assert 0 <= stamps[0] < 200 * MS
    assert 700 * MS < stamps[-1] <= 1000 * MS
    assert 20 < len(stamps) < 60


def test_paused_player_waits_for_its_service(ear: Ear, start_ros2: Start, tmp_path: Path) -> None:
    """Nothing is played before the service says so."""
    write_bag(tmp_path / 'bag', count=10)
    ear.listen('/ticks')
    process = start_ros2('bag', 'play', str(tmp_path / 'bag'), '--start-paused')
    assert ear.call('resume', Resume) == Resume.Response()
    ear.spin_with(process)
    assert len(ear.heard) == 10


def test_services_control_the_player(ear: Ear, start_ros2: Start, tmp_path: Path) -> None:
    """Messages one by one, several at once, another position, another rate, and the end."""
    write_bag(tmp_path / 'bag', count=100)
    ear.listen('/ticks')
    topics = ['--topics', '/ticks', '--start-paused']
    process = start_ros2('bag', 'play', str(tmp_path / 'bag'), *topics)
    assert ear.call('is_paused', IsPaused).paused
    assert not ear.call('play', Play).success
    assert ear.call('play_next', PlayNext).success
    assert ear.call('burst', Burst, num_messages=3).actually_burst == 3
    ear.spin_until(lambda: len(ear.heard) == 4)
    assert not ear.call('seek', Seek, time=_stamp(-1)).success
    assert ear.call('seek', Seek, time=_stamp(500 * MS)).success
    assert ear.call('play_next', PlayNext).success
    ear.spin_until(lambda: len(ear.heard) == 5)
    assert not ear.call('set_rate', SetRate, rate=-1.0).success
    assert ear.call('set_rate', SetRate, rate=0.01).success
    assert ear.call('get_rate', GetRate).rate == 0.01
    ear.call('toggle_paused', TogglePaused)
    assert not ear.call('is_paused', IsPaused).paused
    assert not ear.call('play_next', PlayNext).success
    assert ear.call('burst', Burst).actually_burst == 0
    ear.call('pause', Pause)
    assert ear.call('seek', Seek, time=_stamp(980 * MS)).success
    assert ear.call('burst', Burst, num_messages=1).actually_burst == 1
    assert ear.call('seek', Seek, time=_stamp(0)).success
    ear.client('stop', Stop).call_async(Stop.Request())
    errors = ear.spin_with(process)
    assert ear.texts('/ticks') == ['0', '1', '2', '3', '50', '98']
    assert 'Played 6 messages.' in errors


def _stamp(time_ns: int) -> Time:
    return rclpy.time.Time(nanoseconds=START_NS + time_ns).to_msg()


def test_several_bags_are_merged(ear: Ear, start_ros2: Start, tmp_path: Path) -> None:
    """Messages of all bags are played in the order of their times."""
    for name, offset in (('a', 0), ('b', 5)):
        writer = start_bag(tmp_path / name, topic('/ticks'))
        for number in range(10):
            writer.write(string('/ticks', f'{name}{number}', (10 * number + offset) * MS))
        writer.close()
    ear.listen('/ticks')
    bags = ['-i', str(tmp_path / 'a'), '-i', str(tmp_path / 'b'), 'mcap']
    ear.spin_with(start_ros2('bag', 'burst', *bags))
    assert ear.texts('/ticks') == [f'{name}{number}' for number in range(10) for name in 'ab']


@pytest.mark.parametrize(
    ('words', 'last'),
    [
        (['--playback-until-nsec', str(START_NS + 55 * MS)], 5),
        (['--playback-until-sec', '1700000000.2'], 20),
        (['--playback-until-nsec', str(START_NS), '--playback-duration', '0.1'], 10),
    ],
)
def test_end_of_playback(
    ear: Ear, start_ros2: Start, tmp_path: Path, words: list[str], last: int
) -> None:
    """A recorded time or a duration ends it; of both, the later end."""
    write_bag(tmp_path / 'bag', count=50)
    ear.listen('/ticks')
    ear.spin_with(start_ros2('bag', 'burst', str(tmp_path / 'bag'), *words))
    assert ear.texts('/ticks') == [str(number) for number in range(last + 1)]


@pytest.mark.parametrize('words', [['--clock-topics', '/ticks'], ['--clock-topics-all']])
def test_clock_before_messages(
    ear: Ear, start_ros2: Start, tmp_path: Path, words: list[str]
) -> None:
    """The time of each message is published when it is played."""
    writer = start_bag(tmp_path / 'bag', topic('/ticks'), topic('/other'))
    for number in range(5):
        writer.write(string('/ticks', str(number), number * 20 * MS))
        writer.write(string('/other', str(number), (number * 20 + 10) * MS))
    writer.close()
    ear.listen('/clock', Clock)
    ear.spin_with(start_ros2('bag', 'play', str(tmp_path / 'bag'), *words))
    stamps = [m.clock.sec * 10**9 + m.clock.nanosec - START_NS for _, m, _ in ear.heard]
    step = 20 if len(words) == 2 else 10
    assert stamps == [time_ms * MS for time_ms in range(0, 100, step)]


def test_unknown_type_is_left_out(ear: Ear, start_ros2: Start, tmp_path: Path) -> None:
    """A topic whose package is missing is named, and the rest is played."""
    nope = Topic('/nope', 'nope_msgs/msg/Nope', '', (OfferedQos(),))
    writer = start_bag(tmp_path / 'bag', topic('/ticks'), nope)
    writer.write(string('/nope', 'x', 0))
    writer.write(string('/ticks', '0', 0))
    writer.close()
    ear.listen('/ticks')
    errors = ear.spin_with(start_ros2('bag', 'play', str(tmp_path / 'bag')))
    assert ear.texts('/ticks') == ['0']
    assert "Topic '/nope' is not played: the package 'nope_msgs'" in errors


def test_type_that_has_changed_is_left_out(ear: Ear, start_ros2: Start, tmp_path: Path) -> None:
    """Bytes of an older definition are not published as if they were of the present one."""
    old = Topic('/old', 'std_msgs/msg/String', f'RIHS01_{"0" * 64}', (OfferedQos(),))
    writer = start_bag(tmp_path / 'bag', topic('/ticks'), old)
    writer.write(string('/old', 'x', 0))
    writer.write(string('/ticks', '0', 0))
    writer.close()
    ear.listen('/ticks')
    ear.listen('/old')
    errors = ear.spin_with(start_ros2('bag', 'play', str(tmp_path / 'bag')))
    assert (ear.texts('/ticks'), ear.texts('/old')) == (['0'], [])
    assert "Topic '/old' is not played: the definition of 'std_msgs/msg/String'" in errors


def test_late_subscriber_gets_the_latched_message(
    ear: Ear, start_ros2: Start, tmp_path: Path
) -> None:
    """The publishers latch as those that were recorded."""
    writer = start_bag(tmp_path / 'bag', topic('/ticks'), topic('/description', qos=LATCHED))
    writer.write(string('/description', '<robot/>', 0))
    for number in range(2000):
        writer.write(string('/ticks', str(number), number * 10 * MS))
    writer.close()
    ear.listen('/ticks')
    process = start_ros2('bag', 'play', str(tmp_path / 'bag'))
    ear.spin_until(lambda: len(ear.heard) > 20)
    ear.listen('/description', latched=True)
    ear.spin_until(lambda: ear.texts('/description'))
    process.send_signal(signal.SIGTERM)
    assert process.wait(timeout=TIMEOUT_S) == 15


def test_burst_does_not_wait(ear: Ear, start_ros2: Start, tmp_path: Path) -> None:
    """An hour of recording is published at once, as far as it is asked for."""
    write_bag(tmp_path / 'bag', count=20, period_ns=180_000 * MS)
    ear.listen('/ticks')
    ear.spin_with(start_ros2('bag', 'burst', str(tmp_path / 'bag'), '-n', '11'))
    assert ear.texts('/ticks') == [str(number) for number in range(10)]


def test_topic_that_was_not_recorded_is_named(ros2_here: Ros2, tmp_path: Path) -> None:
    """A misspelt topic is an error, and so is a choice without messages."""
    write_bag(tmp_path / 'bag')
    path = str(tmp_path / 'bag')
    result = ros2_here('bag', 'play', path, '--topics', '/tick')
    expected = f"'{path}' has no topic '/tick'. Did you mean '/ticks'?\n"
    assert (result.returncode, result.stderr) == (1, expected)
    result = ros2_here('bag', 'play', path, '--start-offset', '99')
    assert (result.returncode, 'has no messages in this selection' in result.stderr) == (1, True)


def test_unknown_topic_to_rename_or_leave_out_is_warned_of(
    start_ros2: Start, ear: Ear, tmp_path: Path
) -> None:
    """Who misspells a topic learns that it keeps its name; a bag without it is no mistake."""
    write_bag(tmp_path / 'bag', count=2)
    path = str(tmp_path / 'bag')
    words = ['--remap', '/tick:=/copy', '--exclude-topics', '/description', '/image']
    errors = ear.spin_with(start_ros2('bag', 'play', path, *words))
    text = f"'{path}' has no topic '{{}}' to remap or to exclude."
    assert f"{text.format('/tick')} Did you mean '/ticks'?\n" in errors
    assert f'{text.format("/image")}\n' in errors
    assert text.format('/description') not in errors


def test_clock_can_be_renamed(ear: Ear, start_ros2: Start, tmp_path: Path) -> None:
    """The recorded time goes where --remap sends it, and nodes on /clock do not notice."""
    write_bag(tmp_path / 'bag', count=20)
    ear.listen('/clock', Clock)
    ear.listen('/bag_clock', Clock)
    words = ['--clock', '--remap', '/clock:=/bag_clock']
    errors = ear.spin_with(start_ros2('bag', 'play', str(tmp_path / 'bag'), *words))
    assert {name for name, _, _ in ear.heard} == {'/bag_clock'}
    assert 'has no topic' not in errors
