# SPDX-License-Identifier: Apache-2.0
"""Complete run of `ros2 bag record`."""

from __future__ import annotations

import argparse
import os
import time
from typing import Any

from ament_index_python.packages import get_package_share_directory
from rclpy.logging import LoggingSeverity
from ros2bag.api.common_arguments import TopicFilter
from ros2bag.api.control import Keyboard, offer_pause_services, PauseSwitch, SPACE, StopSignals
from ros2bag.api.qos_profiles import read_overrides
from ros2bag.api.record_arguments import compression_of, filter_of, output_folder
from ros2bag.api.recorder import Recorder
from ros2bag.api.storage_config import read_storage_config
from ros2bag.storage.bag_writer import BagWriter, DEFAULT_DISTRO, WriterOptions
from ros2bag.storage.definitions import Definition, definition_of
from ros2bag.storage.service_events import EVENT_SUFFIX
from ros2bag.storage.snapshot import Snapshot
from ros2cli.node.direct import DirectNode
from ros2cli.waiting import Patience
from ros_environment.suggestions import did_you_mean
from rosbag2_interfaces.msg import WriteSplitEvent
from rosbag2_interfaces.srv import Snapshot as SnapshotService
from rosbag2_interfaces.srv import SplitBagfile

__all__ = ['record']

PERIOD_S = 0.02
SPLIT_TOPIC = 'events/write_split'
NS_PER_S = 1_000_000_000


def record(args: argparse.Namespace) -> None:
    """
    Record topics until a signal arrives, and complete the bag.

    Parameters
    ----------
    args : argparse.Namespace
        The options of `ros2 bag record`.

    Raises
    ------
    BagError
        The bag cannot be written, or the QoS overrides are malformed.
    RuntimeError
        The name of a topic in the options is not valid.
    KeyboardInterrupt, ExternalShutdownException
        A signal arrived before the recording started.

    """
    topic_filter = filter_of(args)
    overrides = read_overrides(args.qos_profile_overrides_path)
    stop = StopSignals()
    with DirectNode(args, node_name=args.node_name) as node, stop:
        level = 'warn' if args.quiet else args.log_level
        node.get_logger().set_level(LoggingSeverity[level.upper()])
        _wait_for_clock(node, args.use_sim_time, stop)
        stop.raise_if_any()
        _record(node, topic_filter, overrides, args, stop)


def _record(
    node: Any,
    topic_filter: TopicFilter,
    overrides: dict[str, Any],
    args: argparse.Namespace,
    stop: StopSignals,
) -> None:
    """Create the bag, record until a signal arrives, and finish the bag in any case."""
    folder = output_folder(args)
    events = node.create_publisher(WriteSplitEvent, SPLIT_TOPIC, 10)

    def tell_of_split(closed: str, opened: str) -> None:
        events.publish(WriteSplitEvent(closed_file=closed, opened_file=opened))

    writer = BagWriter(folder, _options(args), find_definition, tell_of_split)
    snapshot = Snapshot(writer, args.max_cache_size) if args.snapshot_mode else None
    switch = PauseSwitch(args.start_paused, node.get_logger().info)
    recorder = Recorder(
        node,
        snapshot or writer,
        topic_filter,
        switch,
        use_sim_time=args.use_sim_time,
        include_unpublished=args.include_unpublished_topics,
        ignore_leaves=args.ignore_leaf_topics,
        overrides=overrides,
    )
    offer_pause_services(node, switch)
    _offer_services(node, recorder, writer, snapshot)
    try:
        _run(node, recorder, writer, switch, args, stop)
    finally:
        writer.close()
    node.get_logger().info(f"Recorded {writer.message_count} messages to '{folder}'.")
    if recorder.missing:
        node.get_logger().warning(f'Not recorded: {", ".join(recorder.missing)} never appeared.')


def _offer_services(
    node: Any, recorder: Recorder, writer: BagWriter, snapshot: Snapshot | None
) -> None:
    """Offer to split the recording and, in snapshot mode, to write what is kept."""

    def split(_: Any, response: Any) -> Any:
        writer.split(recorder.now_ns())
        return response

    node.create_service(SplitBagfile, '~/split_bagfile', split)
    if snapshot is not None:
        _offer_snapshots(node, snapshot)


def _offer_snapshots(node: Any, snapshot: Snapshot) -> None:
    def take(_: Any, response: Any) -> Any:
        node.get_logger().info(f'Snapshot: {snapshot.take()} messages.')
        response.success = True
        return response

    node.create_service(SnapshotService, '~/snapshot', take)


def find_definition(type_name: str) -> Definition:
    """
    Return the definition of an installed message type.

    Parameters
    ----------
    type_name
        Such as `std_msgs/msg/String`.

    Returns
    -------
    Definition
        Empty if the package or a file is missing.

    """
    return definition_of(type_name, get_package_share_directory)


def _options(args: argparse.Namespace) -> WriterOptions:
    storage: dict[str, Any] = {'compression': compression_of(args)}
    storage |= read_storage_config(args.storage_config_file)
    return WriterOptions(
        **storage,
        max_bytes=args.max_bag_size,
        max_duration_ns=int(args.max_bag_duration * NS_PER_S),
        ros_distro=os.environ.get('ROS_DISTRO', DEFAULT_DISTRO),
        custom_data=dict(args.custom_data),
    )


def _wait_for_clock(node: Any, use_sim_time: bool, stop: StopSignals) -> None:
    """Wait for simulated time; earlier messages could not be stamped."""
    patience = Patience('the time on /clock')
    while use_sim_time and not stop and not node.get_clock().now().nanoseconds:
        node.spin_once(PERIOD_S)
        patience.check()


def _run(
    node: Any,
    recorder: Recorder,
    writer: BagWriter,
    switch: PauseSwitch,
    args: argparse.Namespace,
    stop: StopSignals,
) -> None:
    logger = node.get_logger()
    if args.start_paused:
        logger.info('Paused: press SPACE or call the service ~/resume to start.')
    elif args.snapshot_mode:
        logger.info('Waiting for the service ~/snapshot, to write the last messages.')
    else:
        logger.info('Recording...')
    patience = Patience('a topic to record', lambda: _missing_text(node, recorder))
    # Without discovery the topics are read once, when the graph is complete.
    period_s = float('inf') if args.no_discovery else args.polling_interval / 1e3
    node.watch.settled()
    next_look_s = 0.0
    with Keyboard(enabled=not args.disable_keyboard_controls) as keyboard:
        while not stop:
            if time.monotonic() >= next_look_s:
                recorder.discover()
                next_look_s = time.monotonic() + period_s
            node.spin_once(PERIOD_S)
            writer.flush_if_due()
            if SPACE in keyboard.pressed():
                switch.toggle()
            if not switch.is_paused:
                recorder.release_held()
            if recorder.missing or not recorder.topic_count:
                patience.check()
    recorder.take_rest()


def _missing_text(node: Any, recorder: Recorder) -> str:
    """Format the missing requested topics, with suggestions for misspelt names."""
    known = [name for name, _ in node.get_topic_names_and_types()]
    services = [name for name in recorder.missing if name.endswith(EVENT_SUFFIX)]
    if services:
        names = ', '.join(name.removesuffix(EVENT_SUFFIX) for name in services)
        return (
            f'No events yet of the service: {names}. Its server or a client has to turn its '
            'introspection on, with configure_introspection()'
        )
    missing = (f'{name}. {did_you_mean(name, known)}'.rstrip() for name in recorder.missing)
    return ' '.join(f'Not there yet: {text}' for text in missing)
