# SPDX-License-Identifier: Apache-2.0
"""Tests of `ros2 topic pub` with real processes."""

from collections.abc import Callable
import io
import re
import signal
from subprocess import CompletedProcess
from typing import Any

import pytest

Ros2 = Callable[..., CompletedProcess[str]]
Start = Callable[..., Any]


def test_once_reaches_a_subscription(ros2_here: Ros2, start_ros2: Start) -> None:
    """A single message waits for a subscription and arrives there."""
    latched = ['--qos-durability', 'transient_local', '--qos-reliability', 'reliable']
    echo = start_ros2('topic', 'echo', '--once', '/chatter', 'std_msgs/msg/String', *latched)
    result = ros2_here(
        'topic',
        'pub',
        '--once',
        '/chatter',
        'std_msgs/String',
        'data: hi',
        *latched,
        '--keep-alive',
        '2',
    )
    assert result.stdout.endswith(
        "publisher: beginning loop\npublishing #1: std_msgs.msg.String(data='hi')\n\n"
    )
    waiting = "Still waiting for subscriptions of '/chatter' (Ctrl-C to stop)\n"
    assert (result.returncode, result.stderr.replace(waiting, '')) == (0, '')
    assert echo.communicate(timeout=100)[0] == 'data: hi\n---\n'


POINT = 'geometry_msgs/msg/PointStamped'
TIME = r'builtin_interfaces\.msg\.Time\(sec=\d{10}, nanosec=\d+\)'
STAMPED = (
    rf'geometry_msgs\.msg\.PointStamped\(header=std_msgs\.msg\.Header\(stamp={TIME}, '
    r"frame_id=''\), point=geometry_msgs\.msg\.Point\(x=0\.0, y=-1000\.0, z=0\.0\)\)"
)
STRING = r"std_msgs\.msg\.String\(data='{}'\)"


@pytest.mark.parametrize(
    ('words', 'shown'),
    [
        (
            ['std_msgs/msg/String', '-t', '4', '-p', '2'],
            {2: STRING.format(''), 4: STRING.format('')},
        ),
        (['std_msgs/String', '{data: 1}', '--times', '1'], {1: STRING.format(1)}),
        (['std_msgs/msg/String', '-t', '1', 'data: a b'], {1: STRING.format('a b')}),
        (['std_msgs/msg/String', '-1', '-p', '0'], {}),
        ([POINT, '{header: auto, point: {y: -1e3}}', '-1'], {1: STAMPED}),
        ([POINT, '--once', '{header: {stamp: now}, point: {y: -1e3}}'], {1: STAMPED}),
    ],
)
def test_output(words: list[str], shown: dict[int, str], ros2_here: Ros2) -> None:
    """The loop is announced, and each message that is to be shown is shown with its number."""
    rest = ['-r', '100', '-w', '0', '--keep-alive', '0.01', '--node-name', 'my_publisher']
    result = ros2_here('topic', 'pub', '/chatter', *words, *rest)
    pattern = 'publisher: beginning loop\n' + ''.join(
        rf'publishing #{number}: {message}\n\n' for number, message in shown.items()
    )
    assert re.fullmatch(pattern, result.stdout), result.stdout
    assert (result.stderr, result.returncode) == ('', 0)


def test_message_comes_from_stdin(ros2_here: Ros2, monkeypatch: pytest.MonkeyPatch) -> None:
    """The values can be read from standard input."""
    monkeypatch.setattr('sys.stdin', io.StringIO('{data: 5}'))
    result = ros2_here('topic', 'pub', '/x', 'std_msgs/msg/Int8', '--stdin', '-1', '-w', '0')
    assert (result.stdout, result.stderr, result.returncode) == (
        'publisher: beginning loop\npublishing #1: std_msgs.msg.Int8(data=5)\n\n',
        '',
        0,
    )


@pytest.mark.parametrize(
    ('stdin', 'error'),
    [
        (None, '--stdin reads values from standard input, which is closed\n'),
        (
            io.TextIOWrapper(io.BytesIO(b'\xff'), encoding='utf-8'),
            "--stdin reads text, but standard input is not text: 'utf-8' codec can't decode byte "
            '0xff in position 0: invalid start byte\n',
        ),
    ],
)
def test_stdin_without_text(
    stdin: Any, error: str, ros2_here: Ros2, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Standard input that is closed, or is no text, is an error of one sentence."""
    monkeypatch.setattr('sys.stdin', stdin)
    result = ros2_here('topic', 'pub', '/x', 'std_msgs/msg/Int8', '--stdin')
    assert (result.stdout, result.stderr, result.returncode) == ('', error, 1)


NO_DICTIONARY = 'The passed value needs to be a dictionary in YAML format\n'
FIELD = 'Failed to populate field: '


@pytest.mark.parametrize(
    ('words', 'errors'),
    [
        (
            ['nope/msg/X'],
            "The passed message type is invalid\nthe package 'nope' with its 'msg' folder cannot "
            'be imported: is it installed, or built and sourced?\n',
        ),
        (
            ['std_srvs/srv/Trigger'],
            "The passed message type is invalid\n'std_srvs/srv/Trigger' is not of the form "
            "'package/msg/Type', for example 'std_msgs/msg/String'\n",
        ),
        (['std_msgs/msg/String', '[1]'], NO_DICTIONARY),
        (['std_msgs/msg/Float64', '-1e3'], NO_DICTIONARY),
        (
            ['std_msgs/msg/String', '{nope: 1}'],
            f"{FIELD}'String' object has no attribute 'nope'\n",
        ),
        (
            ['sensor_msgs/msg/Temperature', '{temperatur: 1}'],
            f"{FIELD}'Temperature' object has no attribute 'temperatur'\n"
            "Did you mean 'temperature'?\n",
        ),
        (
            ['std_msgs/msg/Int8', '{data: 300}'],
            f"{FIELD}'data' needs a whole number from -128 to 127 (int8), but got 300\n",
        ),
        (
            ['std_msgs/msg/Float64', '{data: abc}'],
            f"{FIELD}'data' needs a number, but got 'abc'\n",
        ),
        (
            ['geometry_msgs/msg/Twist', '{linear: 1}'],
            f"{FIELD}'linear' needs a mapping, for example {{x: 1}}, but got 1\n",
        ),
    ],
)
def test_wrong_message_is_an_error(words: list[str], errors: str, ros2_here: Ros2) -> None:
    """A type or value that cannot be is told before anything is published."""
    result = ros2_here('topic', 'pub', '/chatter', *words)
    assert (result.stdout, result.stderr, result.returncode) == ('', errors, 1)


def test_no_subscription_in_time_is_an_error(ros2_here: Ros2) -> None:
    """The wait for a subscription is announced and has an end."""
    words = ('/chatter', 'std_msgs/msg/String', '--once', '--max-wait-time-secs', '0.2')
    result = ros2_here('topic', 'pub', *words)
    assert (result.stdout, result.stderr, result.returncode) == (
        'Waiting for at least 1 matching subscription(s)...\n',
        'Timed out waiting for subscribers: Expected 1 subcribers but only got 0 subscribers\n',
        1,
    )


@pytest.mark.parametrize(('sent', 'status'), [(signal.SIGINT, 2), (signal.SIGTERM, 15)])
def test_signal_ends_pub_quietly(sent: signal.Signals, status: int, start_ros2: Start) -> None:
    """A signal ends an endless publication without a traceback."""
    process = start_ros2('topic', 'pub', '/chatter', 'std_msgs/msg/String')
    assert process.stdout.readline() == 'publisher: beginning loop\n'
    process.send_signal(sent)
    assert process.wait(timeout=100) == status
    assert process.stderr.read() == ''


@pytest.mark.parametrize('name', ['/x/', '1x', '/a b', '~/1x', '~~', '{node}', ''])
def test_what_is_no_topic_is_refused(name: str, ros2_here: Ros2) -> None:
    """A name that no topic can have is an error of one sentence, before anything is published."""
    result = ros2_here('topic', 'pub', name, 'std_msgs/msg/String')
    assert (result.returncode, result.stdout) == (1, '')
    assert 'is not a valid topic name: parts of letters, digits and underscores' in result.stderr
