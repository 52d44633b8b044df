# SPDX-License-Identifier: Apache-2.0
"""Services that control a playback: its rate, its position, its next messages and its end."""

from __future__ import annotations

from typing import Any

from rclpy.time import Time
from ros2bag.api.control import offer_service
from ros2bag.api.player import Player
from ros2bag.storage.metadata import MessageSpan
from rosbag2_interfaces.srv import Burst, GetRate, Play, PlayNext, Seek, SetRate, Stop

__all__ = ['offer_player_services']


def offer_player_services(node: Any, player: Player, span: MessageSpan) -> None:
    """
    Create the services of a player, besides those to pause it.

    Parameters
    ----------
    node
        The node that offers them.
    player
        The player.
    span
        The time span of the bag, in which it can seek.

    """
    logger = node.get_logger()

    def get_rate(_: Any, response: Any) -> None:
        response.rate = player.pacing.rate

    def set_rate(request: Any, response: Any) -> None:
        response.success = 0.0 < request.rate < float('inf')
        if response.success:
            player.pacing.set_rate(request.rate)
            logger.info(f'Rate: {request.rate:.3g}')
        else:
            logger.warning(f'A rate of {request.rate:g} is rejected: it must be above zero.')

    def play(_: Any, response: Any) -> None:
        response.success = False
        logger.warning('It is playing already: `ros2 bag play` ends with its bag.')

    def play_next(_: Any, response: Any) -> None:
        response.success = bool(player.play_next())

    def burst(request: Any, response: Any) -> None:
        response.actually_burst = player.play_next(request.num_messages)

    def seek(request: Any, response: Any) -> None:
        time_ns = int(Time.from_msg(request.time).nanoseconds)
        response.success = span.start_ns <= time_ns <= span.end_ns
        if response.success:
            player.seek(time_ns)
        else:
            logger.warning(
                f'The bag has no time {time_ns / 1e9:.3f}: it lasts from '
                f'{span.start_ns / 1e9:.3f} to {span.end_ns / 1e9:.3f}.'
            )

    def stop(_: Any, response: Any) -> None:
        player.stop()

    offer_service(node, GetRate, 'get_rate', get_rate)
    offer_service(node, SetRate, 'set_rate', set_rate)
    offer_service(node, Play, 'play', play)
    offer_service(node, PlayNext, 'play_next', play_next)
    offer_service(node, Burst, 'burst', burst)
    offer_service(node, Seek, 'seek', seek)
    offer_service(node, Stop, 'stop', stop)
