# SPDX-License-Identifier: Apache-2.0
"""Buffer the messages of the last seconds, and save them on command of the console."""

from __future__ import annotations

import argparse
from collections.abc import Callable
import os
import sys
import threading
import time
from typing import Any, cast

from robot_console.recordings.child import Lifeline, tell
from ros2bag.api.common_arguments import TopicFilter
from ros2bag.api.control import PauseSwitch, StopSignals
from ros2bag.api.recorder import Recorder
from ros2bag.api.recording import find_definition
from ros2bag.storage import BagError
from ros2bag.storage.bag_writer import BagWriter, DEFAULT_DISTRO, WriterOptions
from ros2bag.storage.definitions import Definition
from ros2bag.storage.snapshot import Kept, MessageMemory
from ros2cli.arguments import regular_expression
from ros2cli.node.direct import DirectNode

__all__ = ['main', 'write_bag']

NODE_NAME = 'rosbag2_memory'
SPIN_S = 0.05
LOOK_S = 0.5
MIB = 1024 * 1024


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
