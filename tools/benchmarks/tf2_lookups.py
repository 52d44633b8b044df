# SPDX-License-Identifier: Apache-2.0
"""Measure what transforms cost: to look them up across ten moving links, and to take them.

`make bench ARGS='--runs 10'`. The rows of tf2 must stay below 100 us, which is 10 % of a core for
1,000 look-ups a second. The last row chains the same links by scipy, for comparison.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from functools import partial, reduce
import time

from geometry_msgs.msg import TransformStamped
from measuring import median_of
import numpy as np
from rclpy.time import Time
from scipy.spatial.transform import Rotation
from tf2_ros import Buffer

LINKS = 10
RATE_HZ = 100
SECONDS = 5
REPETITIONS = 1000


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=5, help='counted runs of each row')
    runs = parser.parse_args().runs
    messages = chain_of_messages()
    buffer = Buffer()
    take_us = taking_us(buffer, messages)
    begin, end = 'link_0', f'link_{LINKS}'
    between = Time(seconds=3, nanoseconds=1_234_567)
    rows: dict[str, Callable[[], object]] = {
        'lookup_transform between two samples': lambda: buffer.lookup_transform(
            begin, end, between
        ),
        'lookup_transform of the latest': lambda: buffer.lookup_transform(begin, end, Time()),
        'can_transform': lambda: buffer.can_transform(begin, end, between),
        "the same links by scipy's Rotation": scipy_chain(messages),
    }
    print(f'\n{LINKS} links at {RATE_HZ} Hz, median of {runs} runs of {REPETITIONS}')
    print(f'{"CPU us":>7}  {"% of a core at 1,000/s":>22}  what')
    print_row(take_us, 'set_transform')
    for what, action in rows.items():
        print_row(median_of(partial(cost_us, action), runs), what)


def print_row(cost: float, what: str) -> None:
    """
    Print one row of the table.

    Parameters
    ----------
    cost
        The CPU time of one call in us.
    what
        The name of the row.

    """
    print(f'{cost:7.1f}  {cost / 10:22.1f}  {what}', flush=True)


def cost_us(action: Callable[[], object]) -> float:
    """
    Measure the mean CPU time in us of an action, over `REPETITIONS` calls.

    Parameters
    ----------
    action
        The action to measure.

    """
    begin_s = time.process_time()
    for _ in range(REPETITIONS):
        action()
    return (time.process_time() - begin_s) / REPETITIONS * 1e6


def taking_us(buffer: Buffer, messages: list[TransformStamped]) -> float:
    """
    Measure the mean CPU time in us of `set_transform`.

    Parameters
    ----------
    buffer
        The buffer, which contains the transforms afterwards.
    messages
        All transforms to set.

    """
    begin_s = time.process_time()
    for message in messages:
        buffer.set_transform(message, 'benchmark')
    return (time.process_time() - begin_s) / len(messages) * 1e6


def chain_of_messages() -> list[TransformStamped]:
    """Return random transforms of all links over some seconds, the latest ones last."""
    generator = np.random.default_rng(1)
    return [
        message_of(link, 1.0 + number / RATE_HZ, generator)
        for number in range(SECONDS * RATE_HZ)
        for link in range(LINKS)
    ]


def message_of(link: int, time_s: float, generator: np.random.Generator) -> TransformStamped:
    """
    Make a random transform of a link.

    Parameters
    ----------
    link
        The index of the parent; the child has the next one.
    time_s
        The stamp.
    generator
        The source of random numbers.

    """
    message = TransformStamped(child_frame_id=f'link_{link + 1}')
    message.header.frame_id = f'link_{link}'
    message.header.stamp = Time(nanoseconds=round(time_s * 1e9)).to_msg()
    place, turn = message.transform.translation, message.transform.rotation
    place.x, place.y, place.z = generator.uniform(-1, 1, 3).tolist()
    quaternion = generator.normal(size=4)
    turn.x, turn.y, turn.z, turn.w = (quaternion / np.linalg.norm(quaternion)).tolist()
    return message


def scipy_chain(messages: list[TransformStamped]) -> Callable[[], object]:
    """
    Prepare the same lookup with scipy: all links half-way between two samples, in batches.

    Parameters
    ----------
    messages
        Transforms of all links, sample after sample, of which the first two samples are used.

    Returns
    -------
    Callable
        Computes the translation (3,) and the quaternion (4,) x, y, z, w of the whole chain.

    """
    rows = [numbers(message) for message in messages[: 2 * LINKS]]
    places, turns = np.array(rows)[:, :3], np.array(rows)[:, 3:]

    def chain() -> object:
        first, last = Rotation.from_quat(turns[:LINKS]), Rotation.from_quat(turns[LINKS:])
        turned = first * Rotation.from_rotvec((first.inv() * last).as_rotvec() * 0.5)
        matrices = np.zeros((LINKS, 4, 4))
        matrices[:, 3, 3] = 1.0
        matrices[:, :3, :3] = turned.as_matrix()
        matrices[:, :3, 3] = (places[:LINKS] + places[LINKS:]) * 0.5
        whole = reduce(np.matmul, matrices)
        return whole[:3, 3], Rotation.from_matrix(whole[:3, :3]).as_quat()

    return chain


def numbers(message: TransformStamped) -> list[float]:
    """
    Return the components of a transform: the translation x, y, z and the quaternion x, y, z, w.

    Parameters
    ----------
    message
        The transform.

    """
    place, turn = message.transform.translation, message.transform.rotation
    return [place.x, place.y, place.z, turn.x, turn.y, turn.z, turn.w]


if __name__ == '__main__':
    main()
