# SPDX-License-Identifier: Apache-2.0
"""Buffer the messages of the last seconds, and save them on command of the console."""

from __future__ import annotations

import argparse
from collections import deque
from collections.abc import Callable
import os
import sys
import threading
import time
from typing import Any, cast, NamedTuple

from robot_console.recordings.child import Lifeline, tell
from ros2bag.api.common_arguments import regular_expression, TopicFilter
from ros2bag.api.control import PauseSwitch, StopSignals
from ros2bag.api.recorder import Recorder
from ros2bag.api.recording import find_definition
from ros2bag.storage import BagError
from ros2bag.storage.bag_writer import BagWriter, DEFAULT_DISTRO, WriterOptions
from ros2bag.storage.definitions import Definition
from ros2bag.storage.latched import LatchedMessages, RecordedMessage
from ros2bag.storage.metadata import Topic
from ros2cli.node.direct import DirectNode

__all__ = ['Kept', 'MessageMemory', 'main', 'write_bag']

OVERHEAD_BYTES = 300
"""Estimated memory overhead per message."""

NODE_NAME = 'rosbag2_memory'
SPIN_S = 0.05
LOOK_S = 0.5
MIB = 1024 * 1024


class Kept(NamedTuple):
    """Snapshot of the buffered topics and messages."""

    topics: tuple[Topic, ...]
    messages: tuple[RecordedMessage, ...]


class MessageMemory:
    """
    Ring buffer of the latest messages, with the methods of `BagWriter` that a recorder calls.

    Latched messages that were dropped are still included at the start of a snapshot.

    Parameters
    ----------
    span_ns
        The duration for which messages are kept, in ns.
    max_bytes
        The maximum memory, in bytes, including an estimate of the overhead.

    Attributes
    ----------
    size_bytes
        The memory used, in bytes.

    """

    def __init__(self, span_ns: int, max_bytes: int) -> None:
        self._span_ns = span_ns
        self._max_bytes = max_bytes
        self._topics: dict[str, Topic] = {}
        self._messages: deque[RecordedMessage] = deque()
        self._latched = LatchedMessages()
        self.size_bytes = 0
        self.is_short = False
        """Whether messages had to be dropped early."""

    @property
    def message_count(self) -> int:
        """Return the number of buffered messages."""
        return len(self._messages)

    def age_ns(self, now_ns: int) -> int:
        """
        Return the age of the oldest message.

        Parameters
        ----------
        now_ns
            The current time, from `time.time_ns`.

        Returns
        -------
        int
            In ns; 0 if there is no message.

        """
        return now_ns - self._messages[0].log_ns if self._messages else 0

    def set_topic(self, topic: Topic) -> None:
        """
        Add a topic, or update the offered QoS of its publishers.

        Parameters
        ----------
        topic
            The topic; set before its first message is written.

        """
        self._topics[topic.name] = topic

    def write(self, message: RecordedMessage) -> None:
        """
        Store a message; the oldest messages are dropped if the memory limit is exceeded.

        Parameters
        ----------
        message
            A message of a topic that was set before.

        """
        self._messages.append(message)
        self.size_bytes += len(message.data) + OVERHEAD_BYTES
        while self.size_bytes > self._max_bytes and self._messages:
            self.is_short = True
            self._forget_oldest()

    def forget_old(self, now_ns: int) -> None:
        """
        Drop the messages that are older than the time span.

        Parameters
        ----------
        now_ns
            The current time, from `time.time_ns`.

        """
        while self._messages and self._messages[0].log_ns < now_ns - self._span_ns:
            self._forget_oldest()
            self.is_short = False

    def kept(self, now_ns: int) -> Kept:
        """
        Take a snapshot of the messages, for a recording.

        Parameters
        ----------
        now_ns
            The current time, from `time.time_ns`.

        Returns
        -------
        Kept
            The topics and messages; dropped latched messages come first, with the start time.

        """
        self.forget_old(now_ns)
        start_ns = self._messages[0].log_ns if self._messages else now_ns
        head = (
            RecordedMessage(each.topic, each.data, start_ns, each.publish_ns, each.sequence)
            for each in self._latched.alive(now_ns)
        )
        return Kept(tuple(self._topics.values()), (*head, *self._messages))

    def _forget_oldest(self) -> None:
        message = self._messages.popleft()
        self.size_bytes -= len(message.data) + OVERHEAD_BYTES
        topic = self._topics[message.topic]
        if topic.is_latched:
            self._latched.add(message, topic)


def write_bag(
    kept: Kept, folder: str, options: WriterOptions, find_definition: Callable[[str], Definition]
) -> int:
    """
    Write messages from memory to a new recording.

    Parameters
    ----------
    kept
        The snapshot to write.
    folder
        The path of the recording, which must not exist.
    options
        Compression and size limits.
    find_definition
        Returns the definition of a message type.

    Returns
    -------
    int
        The number of messages written.

    Raises
    ------
    BagError
        The recording cannot be written.

    """
    writer = BagWriter(folder, options, find_definition)
    try:
        for topic in kept.topics:
            writer.set_topic(topic)
        for message in kept.messages:
            writer.write(message)
    finally:
        writer.close()
    return writer.message_count


def main() -> None:
    """Run the program."""
    lifeline = Lifeline()
    parser = argparse.ArgumentParser()
    parser.add_argument('--seconds', type=float, default=30.0)
    parser.add_argument('--max-mib', type=float, default=200.0)
    parser.add_argument('--regex', type=regular_expression)
    args = parser.parse_args()
    memory = MessageMemory(int(args.seconds * 1e9), int(args.max_mib * MIB))
    stop = StopSignals()
    try:
        with DirectNode(args, node_name=NODE_NAME) as node, stop:
            chosen = TopicFilter(everything=not args.regex, regex=args.regex)
            _run(node, memory, chosen, lifeline, stop)
    except RuntimeError as failure:
        sys.exit(str(failure))


def _run(
    node: Any, memory: MessageMemory, chosen: TopicFilter, lifeline: Lifeline, stop: StopSignals
) -> None:
    # The recorder calls only methods of a writer that `MessageMemory` also has.
    writer = cast(BagWriter, memory)
    recorder = Recorder(node, writer, chosen, PauseSwitch(False, lambda text: None))
    next_look_s = 0.0
    while not (stop or lifeline.is_cut):
        if time.monotonic() >= next_look_s:
            recorder.discover()
            _report(memory, recorder.topic_count)
            next_look_s = time.monotonic() + LOOK_S
        node.spin_once(SPIN_S)
        for command in lifeline.commands():
            _save(memory.kept(time.time_ns()), command['save'])


def _report(memory: MessageMemory, topic_count: int) -> None:
    now_ns = time.time_ns()
    memory.forget_old(now_ns)
    tell(
        seconds=memory.age_ns(now_ns) / 1e9,
        size_bytes=memory.size_bytes,
        messages=memory.message_count,
        topics=topic_count,
        is_short=memory.is_short,
    )


def _save(kept: Kept, folder: str) -> None:
    """Write a recording in another thread, while messages continue to arrive."""
    threading.Thread(target=_write, args=(kept, folder)).start()


def _write(kept: Kept, folder: str) -> None:
    options = WriterOptions(ros_distro=os.environ.get('ROS_DISTRO', DEFAULT_DISTRO))
    try:
        count = write_bag(kept, folder, options, find_definition)
    except BagError as error:
        tell(saved={'folder': folder, 'failure': str(error)})
    else:
        tell(saved={'folder': folder, 'messages': count})


if __name__ == '__main__':
    main()
