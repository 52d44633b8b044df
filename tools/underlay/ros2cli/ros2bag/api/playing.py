# SPDX-License-Identifier: Apache-2.0
"""Complete run of `ros2 bag play` and `burst`: from the options to the last message."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from itertools import takewhile
from typing import Any

from rclpy.logging import LoggingSeverity
from ros2bag.api.control import Keyboard, offer_pause_services, PauseSwitch
from ros2bag.api.outlets import Outlets
from ros2bag.api.pacing import CLOCK_TOPIC, ClockOutlet, Pacing
from ros2bag.api.play_arguments import (
    bag_paths,
    end_of_playback_ns,
    filter_of,
    publishes_clock,
    remaps,
    request_source,
)
from ros2bag.api.player import Player, PlayHead
from ros2bag.api.player_services import offer_player_services
from ros2bag.api.qos_profiles import read_overrides
from ros2bag.storage import BagError
from ros2bag.storage.bags import Bags
from ros2bag.storage.latched import RecordedMessage
from ros2bag.storage.metadata import Topic
from ros2bag.storage.service_events import event_topic, service_of
from ros2cli.names import absolute
from ros2cli.node.direct import DirectNode
from ros_environment.suggestions import did_you_mean
from rosbag2_interfaces.msg import ReadSplitEvent

__all__ = ['play']

NODE_NAME = 'rosbag2_player'
SPLIT_TOPIC = 'events/read_split'
NS_PER_S = 1_000_000_000


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
    reader = Bags(bag_paths(args))
    reader.check()
    topics = _chosen_topics(reader, args)
    names, overrides = remaps(args), read_overrides(args.qos_profile_overrides_path)
    with (
        DirectNode(args, node_name=NODE_NAME) as node,
        Keyboard(enabled=not args.disable_keyboard_controls) as keyboard,
    ):
        node.get_logger().set_level(LoggingSeverity[args.log_level.upper()])
        _warn_of_unknown_topics(reader, args, node.get_logger())
        outlets = Outlets(node, topics, names, overrides, request_source(args))
        clock = _clock(node, names.get(CLOCK_TOPIC, CLOCK_TOPIC), outlets.topics, args)
        switch = PauseSwitch(args.start_paused, node.get_logger().info)
        start_ns = reader.metadata.span.start_ns + int(args.start_offset * NS_PER_S)
        events = node.create_publisher(ReadSplitEvent, SPLIT_TOPIC, 10)

        def tell_of_split(closed: str, opened: str) -> None:
            events.publish(ReadSplitEvent(closed_file=closed, opened_file=opened))

        head = _head(reader, outlets.topics, start_ns, args, tell_of_split)
        pacing = Pacing(start_ns, args.rate)
        player = Player(node, outlets, clock, switch, keyboard, head, pacing)
        offer_pause_services(node, switch)
        offer_player_services(node, player, reader.metadata.span)
        outlets.wait_for_subscribers(events, *([clock.publisher] if clock else []))
        if args.start_paused:
            node.get_logger().info('Paused: press SPACE or call the service ~/resume to start.')
        _play_all(player, reader, start_ns, node, args)
        outlets.wait_until_acked(args.wait_for_all_acked)


def _clock(
    node: Any, topic: str, topics: list[str], args: argparse.Namespace
) -> ClockOutlet | None:
    """Return the publisher of the recorded time, if it is wanted."""
    if args.clock:
        return ClockOutlet(node, topic, args.clock)
    if args.clock_topics_all:
        return ClockOutlet(node, topic, 0.0, topics)
    names = [absolute(name) for name in args.clock_topics]
    return ClockOutlet(node, topic, 0.0, names) if names else None


def _chosen_topics(reader: Bags, args: argparse.Namespace) -> list[Topic]:
    """Return the topics to play; raise RuntimeError for one that was not recorded."""
    known = [each.topic for each in reader.metadata.topics]
    chosen = filter_of(args)
    names = [topic.name for topic in known]
    for name in sorted(chosen.topics.difference(names)):
        raise BagError(
            f"'{reader.path}' has no topic '{name}'. {did_you_mean(name, names)}".rstrip()
        )
    services = [each.name for topic in known if (each := service_of(topic.name, topic.type_name))]
    for name in sorted(chosen.services.difference(services)):
        raise BagError(
            f"'{reader.path}' has no service '{name}'. {did_you_mean(name, services)}".rstrip()
        )
    return [
        topic
        for topic in known
        if chosen.wants(topic.name, topic.type_name)
        and not (publishes_clock(args) and topic.name == CLOCK_TOPIC)
    ]


def _warn_of_unknown_topics(reader: Bags, args: argparse.Namespace, logger: Any) -> None:
    """Warn of topics and services in options that are not in the bag."""
    recorded = [each.topic.name for each in reader.metadata.topics]
    there = [*recorded, CLOCK_TOPIC] if publishes_clock(args) else recorded
    chosen = filter_of(args)
    excluded = {*chosen.excluded_topics, *map(event_topic, chosen.excluded_services)}
    for name in sorted({*remaps(args), *excluded}.difference(there)):
        logger.warning(
            f"'{reader.path}' has no topic '{name}' to remap or to exclude. "
            f'{did_you_mean(name, recorded)}'.rstrip()
        )
    for name in sorted({absolute(name) for name in args.clock_topics}.difference(recorded)):
        logger.warning(
            f"'{reader.path}' has no topic '{name}', which therefore never sets the clock. "
            f'{did_you_mean(name, recorded)}'.rstrip()
        )


def _head(
    reader: Bags,
    topics: list[str],
    start_ns: int,
    args: argparse.Namespace,
    on_split: Callable[[str, str], None],
) -> PlayHead:
    end_ns = end_of_playback_ns(args, start_ns)

    def messages_from(time_ns: int) -> Iterator[RecordedMessage]:
        messages = reader.messages(topics, time_ns, on_split)
        return takewhile(lambda message: message.log_ns <= end_ns, messages)

    return PlayHead(messages_from, start_ns, args.num_messages)


def _play_all(
    player: Player, reader: Bags, start_ns: int, node: Any, args: argparse.Namespace
) -> None:
    player.pacing.start_in(int(args.delay * NS_PER_S))
    player.rest_until(start_ns)
    while player.play():
        if not player.count:
            raise BagError(f"'{reader.path}' has no messages in this selection")
        if not args.loop:
            break
        player.seek(start_ns)
    node.get_logger().info(f'Played {player.count} messages.')
