# SPDX-License-Identifier: Apache-2.0
"""Measure `ros2 bag`: what recording costs and loses, and how exactly a bag is played.

`make bench ARGS='--runs 10'`. Messages are joint states of 1 kB. A recording is compared with what
was sent, byte for byte, as `rosbags` and as `mcap` read it. An error of playing is the difference
between two messages' distance in time as it arrives and as it was recorded.
"""

from __future__ import annotations

import argparse
import os
from pathlib import Path
import random
import signal
from statistics import mean
import subprocess
import tempfile
import time

from bag_traffic import Traffic, traffic
from domain_coordinator import domain_id
from mcap.reader import make_reader
from measuring import Cost, running
from rosbags.highlevel import AnyReader

RECORD_S = 5.0
KILL_HZ = 200
MS = 1_000_000
LOADS = ((200, 1), (200, 5), (1000, 1), (1000, 5))
RATES = (1.0, 2.0, 0.5)
Messages = list[tuple[str, bytes, int]]


def main() -> None:
    """Measure and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=5, help='how often a recorder is killed')
    runs = parser.parse_args().runs
    with tempfile.TemporaryDirectory() as name, domain_id() as domain:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        folder = Path(name)
        print_recordings(folder)
        print_playing(folder)
        print_kills(folder, runs)


def print_recordings(folder: Path) -> None:
    """
    Record each of `LOADS`, and print the cost and whether other libraries read the same data.

    Parameters
    ----------
    folder
        The folder of the bags, which are kept for `print_playing`.

    """
    print(f'{"CPU %":>7} {"MB":>6} {"lost":>6} {"mcap":>6} {"rosbags":>8}  recorded')
    for rate_hz, topic_count in LOADS:
        bag = folder / bag_name(rate_hz, topic_count)
        with traffic(topics(topic_count)) as sender:
            cost = record(bag, sender, rate_hz)
            sent = [(topic, data) for topic, data, _ in sender.sent]
        found = read_by_mcap(bag)
        read_by = {
            'mcap': sorted(sent) == sorted(each[:2] for each in found),
            'rosbags': sorted(found) == sorted(read_by_rosbags(bag)),
        }
        print(
            f'{cost.cpu_s / cost.wall_s:7.1%} {cost.memory_mb:6.1f} {len(sent) - len(found):6} '
            f'{read_by["mcap"]!s:>6} {read_by["rosbags"]!s:>8}  '
            f'{rate_hz} messages/s on {topic_count} topics',
            flush=True,
        )


def print_playing(folder: Path) -> None:
    """
    Play the recordings, and print the errors of the intervals between messages.

    Parameters
    ----------
    folder
        The folder in which `print_recordings` has stored the bags.

    """
    print(f'\n{"mean ms":>8} {"max ms":>8} {"lost":>6}  played')
    for rate_hz, topic_count in LOADS:
        bag = folder / bag_name(rate_hz, topic_count)
        recorded = read_by_mcap(bag)
        for rate in RATES:
            with traffic(topics(topic_count)) as listener:
                listener.listen()
                command = ['ros2', 'bag', 'play', str(bag), '-r', str(rate)]
                with running(command, signal.SIGKILL) as process:
                    listener.hear(process)
                errors = errors_ms(recorded, listener.received, rate)
            print(
                f'{mean(errors):8.3f} {max(errors):8.3f} '
                f'{len(recorded) - len(listener.received):6}  '
                f'{rate_hz} messages/s on {topic_count} topics, --rate {rate:g}',
                flush=True,
            )


def print_kills(folder: Path, runs: int) -> None:
    """
    Kill recorders, and print the age of the oldest lost messages.

    Parameters
    ----------
    folder
        The folder of the bags.
    runs
        The number of recorders to kill.

    """
    lost_s = []
    for run in range(runs):
        bag = folder / f'killed_{run}'
        with traffic(topics(1)) as sender, running(recorder(bag), signal.SIGKILL) as process:
            sender.connect()
            sender.send(KILL_HZ, random.uniform(1.0, 2.0))
            process.kill()
            killed_ns = time.time_ns()
            process.wait()
        subprocess.run(['ros2', 'bag', 'recover', str(bag)], check=True, capture_output=True)
        saved = {data for _, data, _ in read_by_mcap(bag)}
        lost_ns = [time_ns for _, data, time_ns in sender.sent if data not in saved]
        lost_s.append((killed_ns - min(lost_ns, default=killed_ns)) / 1e9)
    print(f'\n{"worst s":>8} {"mean s":>8}  lost by kill -9, {KILL_HZ} messages/s, {runs} runs')
    print(f'{max(lost_s):8.3f} {mean(lost_s):8.3f}')


def record(bag: Path, sender: Traffic, rate_hz: float) -> Cost:
    """
    Record for `RECORD_S` seconds and measure the cost, including the start of the recorder.

    Parameters
    ----------
    bag
        The folder of the bag, which does not exist yet.
    sender
        Sends the messages.
    rate_hz
        The number of messages that it sends per second, on all topics together.

    Returns
    -------
    Cost
        CPU time, wall time and peak RSS of the recorder.

    """
    begin_s = time.monotonic()
    with running(recorder(bag), signal.SIGKILL) as process:
        sender.connect()
        sender.send(rate_hz, RECORD_S)
        process.send_signal(signal.SIGINT)
        _, _, usage = os.wait4(process.pid, 0)
    wall_s = time.monotonic() - begin_s
    return Cost(usage.ru_utime + usage.ru_stime, wall_s, usage.ru_maxrss / 1000)


def recorder(bag: Path) -> list[str]:
    """
    Return the command that records the topics of the benchmark.

    Parameters
    ----------
    bag
        The folder that it writes.

    """
    return ['ros2', 'bag', 'record', '-e', '^/bag_bench', '-o', str(bag)]


def topics(count: int) -> list[str]:
    """
    Return the names of the topics of the benchmark.

    Parameters
    ----------
    count
        The number of topics.

    """
    return [f'/bag_bench_{index}' for index in range(count)]


def bag_name(rate_hz: int, topic_count: int) -> str:
    """
    Return the name of the recording of a load.

    Parameters
    ----------
    rate_hz
        The number of messages sent per second, on all topics together.
    topic_count
        The number of topics.

    """
    return f'{rate_hz}_hz_{topic_count}_topics'


def read_by_mcap(bag: Path) -> Messages:
    """
    Read the messages of a bag with the library `mcap`.

    Parameters
    ----------
    bag
        The folder of the bag.

    Returns
    -------
    list of (str, bytes, int)
        Topic, serialized message and time in ns of each, file by file.

    """
    found = []
    for path in sorted(bag.glob('*.mcap')):
        with path.open('rb') as stream:
            found += [
                (channel.topic, bytes(message.data), message.log_time)
                for _, channel, message in make_reader(stream).iter_messages()
            ]
    return found


def read_by_rosbags(bag: Path) -> Messages:
    """
    Read the messages of a bag with the library `rosbags`.

    Parameters
    ----------
    bag
        The folder of the bag.

    Returns
    -------
    list of (str, bytes, int)
        Topic, serialized message and time in ns of each.

    """
    with AnyReader([bag]) as reader:
        return [
            (connection.topic, bytes(data), time_ns)
            for connection, time_ns, data in reader.messages()
        ]


def errors_ms(recorded: Messages, received: Messages, rate: float) -> list[float]:
    """
    Compute the errors of the intervals between consecutive messages of a played bag.

    Parameters
    ----------
    recorded, received
        Topic, serialized message and time in ns, as recorded and as they arrived; lost ones are
        skipped.
    rate
        The factor of the playback speed.

    Returns
    -------
    list of float
        Absolute errors in ms, in the order of the recording.

    """
    arrived_ns = {(topic, data): time_ns for topic, data, time_ns in received}
    pairs = [
        (at, arrived_ns[topic, data])
        for topic, data, at in recorded
        if (topic, data) in arrived_ns
    ]
    return [
        abs((after[1] - before[1]) - (after[0] - before[0]) / rate) / MS
        for before, after in zip(pairs, pairs[1:])
    ]


if __name__ == '__main__':
    main()
