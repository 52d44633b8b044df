# SPDX-License-Identifier: Apache-2.0
"""Play a recording like `ros2 bag play`, controlled by the console."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from itertools import takewhile
import sys
import time
from typing import Any

from robot_console.recordings.child import Lifeline, tell
from robot_console.recordings.programs.playback import Playback
from ros2bag.api.control import StopSignals
from ros2bag.api.outlets import Outlets
from ros2bag.api.play_arguments import (
    add_bag_argument,
    add_choice_arguments,
    filter_of,
    remaps,
    request_source,
)
from ros2bag.storage import BagError
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.latched import RecordedMessage
from ros2cli.node.direct import DirectNode

__all__ = ['main']

NODE_NAME = 'rosbag2_player'
REPORT_S = 0.1


class BagSource:
    """
    The selected topics of a bag, as a `Source` for playback.

    Parameters
    ----------
    reader
        Reads the bag.
    topics
        The names of the topics to play.

    Attributes
    ----------
    start_ns, end_ns
        The recorded times at which the whole bag starts and ends, in ns.

    """

    def __init__(self, reader: BagReader, topics: list[str]) -> None:
        self._reader = reader
        self._topics = topics
        self._latched = [
            each.topic.name
            for each in reader.metadata.topics
            if each.topic.is_latched and each.topic.name in topics
        ]
        self.start_ns = reader.metadata.span.start_ns
        self.end_ns = reader.metadata.span.end_ns

    def messages(self, start_ns: int) -> Iterator[RecordedMessage]:
        """
        Iterate over the messages to play, in order of time.

        Parameters
        ----------
        start_ns
            As for `Source.messages`.

        """
        return self._reader.messages(self._topics, max(0, start_ns))

    def latched(self, start_ns: int, end_ns: int) -> Iterator[RecordedMessage]:
        """
        Iterate over the latched messages in a time span.

        Parameters
        ----------
        start_ns, end_ns
            As for `Source.latched`.

        """
        if not self._latched:
            return iter(())
        messages = self._reader.messages(self._latched, start_ns)
        return takewhile(lambda message: message.log_ns < end_ns, messages)


def main() -> None:
    """Run the program, with some of the options of `ros2 bag play`."""
    lifeline = Lifeline()
    parser = argparse.ArgumentParser()
    add_bag_argument(parser)
    add_choice_arguments(parser)
    parser.add_argument('--rate', type=float, default=1.0)
    parser.add_argument('--loop', action='store_true')
    stop = StopSignals()
    args = parser.parse_args()
    try:
        reader = BagReader(args.bag_path)
        reader.check()
        if not reader.metadata.span.message_count:
            raise BagError(f"'{args.bag_path}' has no messages.")
        with DirectNode(args, node_name=NODE_NAME) as node, stop:
            playback, source = _prepare(node, reader, args)
            while not (stop or lifeline.is_cut):
                _go_on(playback, source, lifeline)
    except RuntimeError as failure:
        sys.exit(str(failure))


def _prepare(node: Any, reader: BagReader, args: argparse.Namespace) -> tuple[Playback, BagSource]:
    """Create the publishers, the playback and its source."""
    chosen = filter_of(args)
    topics = [each.topic for each in reader.metadata.topics]
    wanted = [topic for topic in topics if chosen.wants(topic.name, topic.type_name)]
    outlets = Outlets(node, wanted, remaps(args), {}, request_source(args))
    if not outlets.topics:
        raise BagError(f"Nothing of '{args.bag_path}' can be played.")
    outlets.wait_for_subscribers()
    source = BagSource(reader, outlets.topics)
    playback = Playback(source, lambda message: outlets.publish(message.topic, message.data))
    playback.set_rate(args.rate)
    playback.is_looping = args.loop
    return playback, source


def _go_on(playback: Playback, source: BagSource, lifeline: Lifeline) -> None:
    """Play for a short time, execute commands of the console, and report the state."""
    end_s = time.monotonic() + REPORT_S
    commands: list[dict[str, Any]] = []
    _report(playback, source)
    while not commands and not lifeline.is_cut and time.monotonic() < end_s:
        commands = lifeline.commands(playback.step() / 1e9)
    for command in commands:
        _obey(playback, source, command)


def _report(playback: Playback, source: BagSource) -> None:
    tell(
        position_s=(playback.position_ns - source.start_ns) / 1e9,
        is_paused=playback.is_paused,
        is_ended=playback.is_ended,
        jumps=playback.jumps,
        rate=playback.rate,
    )


def _obey(playback: Playback, source: BagSource, command: dict[str, Any]) -> None:
    if 'paused' in command:
        (playback.pause if command['paused'] else playback.go_on)()
    if 'rate' in command:
        playback.set_rate(command['rate'])
    if 'loop' in command:
        playback.is_looping = command['loop']
    if 'position_s' in command:
        playback.jump_to(source.start_ns + int(command['position_s'] * 1e9))


if __name__ == '__main__':
    main()
