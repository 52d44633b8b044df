# SPDX-License-Identifier: Apache-2.0
"""Complete run of `ros2 bag play` and `burst`: each message is published when it is due."""

from __future__ import annotations

import argparse
from collections.abc import Iterable, Iterator
from itertools import islice, takewhile
import time
from typing import Any

from ros2bag.api.control import DOWN, Keyboard, offer_pause_services, PauseSwitch, RIGHT, SPACE, UP
from ros2bag.api.outlets import Outlets
from ros2bag.api.pacing import CLOCK_TOPIC, ClockOutlet, Pacing
from ros2bag.api.play_arguments import filter_of, remaps
from ros2bag.api.qos_profiles import read_overrides
from ros2bag.storage import BagError
from ros2bag.storage.bag_reader import BagReader
from ros2bag.storage.latched import RecordedMessage
from ros2bag.storage.metadata import Topic
from ros2cli.node.direct import DirectNode
from ros_environment.suggestions import did_you_mean

__all__ = ['play']

NODE_NAME = 'rosbag2_player'
NS_PER_S = 1_000_000_000
FOR_EVER_NS = 2**63 - 1
STEP_NS = 50_000_000
# The executor is not spun shortly before a message is due: a plain sleep ends on time.
EXACT_NS = 3_000_000
FASTER = 1.1


def play(args: argparse.Namespace) -> None:
    """
    Play a bag with the options of `ros2 bag play` or `burst`.

    Parameters
    ----------
    args : argparse.Namespace
        The options of the verb.

    Raises
    ------
    BagError
        The bag cannot be read, has no selected messages, or the QoS overrides are malformed.
    RuntimeError
        The name of a topic in the options is not valid.

    """
    reader = BagReader(args.bag_path)
    reader.check()
    topics = _chosen_topics(reader, args)
    names, overrides = remaps(args), read_overrides(args.qos_profile_overrides_path)
    with (
        DirectNode(args, node_name=NODE_NAME) as node,
        Keyboard(enabled=not args.disable_keyboard_controls) as keyboard,
    ):
        _warn_of_unknown_topics(reader, args, node.get_logger())
        outlets = Outlets(node, topics, names, overrides)
        clock_topic = names.get(CLOCK_TOPIC, CLOCK_TOPIC)
        clock = ClockOutlet(node, clock_topic, args.clock) if args.clock else None
        switch = PauseSwitch(args.start_paused, node.get_logger().info)
        offer_pause_services(node, switch)
        outlets.wait_for_subscribers(*([clock.publisher] if clock else []))
        if args.start_paused:
            node.get_logger().info('Paused: press SPACE or call the service ~/resume to start.')
        player = Player(node, outlets, clock, switch, keyboard)
        _play_all(player, reader, outlets, node, args)
        outlets.wait_until_acked(args.wait_for_all_acked)


def _chosen_topics(reader: BagReader, args: argparse.Namespace) -> list[Topic]:
    """Return the topics to play; raise RuntimeError for one that was not recorded."""
    known = [each.topic for each in reader.metadata.topics]
    chosen = filter_of(args)
    names = [topic.name for topic in known]
    for name in sorted(chosen.topics.difference(names)):
        raise BagError(
            f"'{args.bag_path}' has no topic '{name}'. {did_you_mean(name, names)}".rstrip()
        )
    return [
        topic
        for topic in known
        if chosen.wants(topic.name, topic.type_name)
        and not (args.clock and topic.name == CLOCK_TOPIC)
    ]


def _warn_of_unknown_topics(reader: BagReader, args: argparse.Namespace, logger: Any) -> None:
    """Warn of topics to remap or exclude that are not in the bag."""
    recorded = [each.topic.name for each in reader.metadata.topics]
    there = [*recorded, CLOCK_TOPIC] if args.clock else recorded
    for name in sorted({*remaps(args), *filter_of(args).excluded_topics}.difference(there)):
        logger.warning(
            f"'{args.bag_path}' has no topic '{name}' to remap or to exclude. "
            f'{did_you_mean(name, recorded)}'.rstrip()
        )


def _play_all(
    player: Player, reader: BagReader, outlets: Outlets, node: Any, args: argparse.Namespace
) -> None:
    start_ns = reader.metadata.span.start_ns + int(args.start_offset * NS_PER_S)
    limited = args.playback_duration >= 0
    end_ns = start_ns + int(args.playback_duration * NS_PER_S) if limited else FOR_EVER_NS
    pacing = Pacing(start_ns - int(args.delay * NS_PER_S), 1.0)
    player.rest_until(start_ns, pacing)
    pacing.set_rate(args.rate)
    while True:
        messages = _messages(reader, outlets.topics, start_ns, end_ns)
        count = player.play(islice(messages, args.num_messages), pacing)
        if not count:
            raise BagError(f"'{args.bag_path}' has no messages in this selection")
        if not args.loop:
            node.get_logger().info(f'Played {count} messages.')
            return
        pacing.jump_to(start_ns)


def _messages(
    reader: BagReader, topics: list[str], start_ns: int, end_ns: int
) -> Iterator[RecordedMessage]:
    return takewhile(lambda message: message.log_ns <= end_ns, reader.messages(topics, start_ns))


class Player:
    """
    Publisher of recorded messages at their due times; serves keyboard and services meanwhile.

    Parameters
    ----------
    node
        The node to spin.
    outlets
        The publishers.
    clock
        The publisher of the recorded time, or None.
    switch
        The paused state, which SPACE toggles.
    keyboard
        The source of keys: RIGHT plays the next message while paused, UP and DOWN change the rate.

    """

    def __init__(
        self,
        node: Any,
        outlets: Outlets,
        clock: ClockOutlet | None,
        switch: PauseSwitch,
        keyboard: Keyboard,
    ) -> None:
        self._node = node
        self._outlets = outlets
        self._clock = clock
        self._switch = switch
        self._keyboard = keyboard
        self._next_is_wanted = False
        self._served_ns = 0

    def play(self, messages: Iterable[RecordedMessage], pacing: Pacing) -> int:
        """
        Publish messages, each when it is due.

        Parameters
        ----------
        messages
            In publication order; all of their topics must be among the outlets.
        pacing
            The due times of recorded messages; pausing and keys change them.

        Returns
        -------
        int
            The number of published messages.

        """
        count = 0
        for message in messages:
            self._wait_until(message.log_ns, pacing)
            self._outlets.publish(message.topic, message.data)
            count += 1
        return count

    def rest_until(self, recorded_ns: int, pacing: Pacing) -> None:
        """
        Wait for a recorded time without publishing a message.

        Parameters
        ----------
        recorded_ns
            In ns since the epoch.
        pacing
            The due times, as for `play`.

        """
        self._wait_until(recorded_ns, pacing)

    def _wait_until(self, recorded_ns: int, pacing: Pacing) -> None:
        while True:
            left_ns = min(pacing.wait_ns(recorded_ns), STEP_NS)
            if left_ns > 0 or self._switch.is_paused or self._is_service_due():
                self._serve_others(recorded_ns, pacing)
            if self._switch.is_paused:
                pacing.hold()
                if self._take_next_wish():
                    pacing.jump_to(recorded_ns)
                    return
                left_ns = STEP_NS
            else:
                pacing.release()
                left_ns = min(pacing.wait_ns(recorded_ns), STEP_NS)
                if left_ns <= 0:
                    return
            self._idle(left_ns, recorded_ns, pacing)

    def _idle(self, left_ns: int, next_ns: int, pacing: Pacing) -> None:
        """Spin or sleep for the remaining time, at most until the clock is due."""
        if self._clock is not None:
            left_ns = min(left_ns, self._clock.tick(pacing, next_ns))
        if left_ns > EXACT_NS:
            self._node.spin_once((left_ns - EXACT_NS) / 1e9)
        elif left_ns > 0:
            time.sleep(left_ns / 1e9)

    def _is_service_due(self) -> bool:
        """Whether the keyboard and services are overdue because messages are dense."""
        return time.monotonic_ns() - self._served_ns > STEP_NS

    def _serve_others(self, next_ns: int, pacing: Pacing) -> None:
        now_ns = time.monotonic_ns()
        if now_ns - self._served_ns < STEP_NS / 2:
            return
        self._served_ns = now_ns
        self._node.spin_once(0.0)
        if self._clock is not None:
            self._clock.tick(pacing, next_ns)
        self._obey(self._keyboard.pressed(), pacing)

    def _obey(self, keys: str, pacing: Pacing) -> None:
        if SPACE in keys:
            self._switch.toggle()
        if RIGHT in keys:
            self._next_is_wanted = True
        steps = keys.count(UP) - keys.count(DOWN)
        if steps:
            pacing.set_rate(pacing.rate * FASTER**steps)
            self._node.get_logger().info(f'Rate: {pacing.rate:.3g}')

    def _take_next_wish(self) -> bool:
        wish, self._next_is_wanted = self._next_is_wanted, False
        return wish
