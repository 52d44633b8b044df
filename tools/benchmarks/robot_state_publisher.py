# SPDX-License-Identifier: Apache-2.0
"""Measure `robot_state_publisher`: what it costs more than a node that only listens.

`make bench ARGS='--runs 5'`. A robot of 26 joints sends its states; each node hears them for some
seconds, and its CPU time is read before and after.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from contextlib import contextmanager
import os
from pathlib import Path
from statistics import median
import sys
import tempfile
import time
from typing import Any

from domain_coordinator import domain_id
from measuring import cpu_s, running
import rclpy
from sensor_msgs.msg import JointState
from tf2_msgs.msg import TFMessage

JOINTS = 26
RATES_HZ = (20, 100)
SECONDS = 10.0
SETTLE_S = 2.0
TIMEOUT_S = 60.0
NAMES = [f'joint_number_{index}' for index in range(JOINTS)]
LISTENER = """
import rclpy
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import JointState
rclpy.init()
node = rclpy.create_node('listener')
node.create_subscription(JointState, 'joint_states', lambda message: None, qos_profile_sensor_data)
rclpy.spin(node)
"""


def main() -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=3, help='runs of each row')
    runs = parser.parse_args().runs
    print(f'{"CPU %":>7} {"more":>7} {"tf 1/s":>7}  {JOINTS} joints, {runs} runs')
    with tempfile.TemporaryDirectory() as folder, domain_id() as domain:
        os.environ['ROS_DOMAIN_ID'] = str(domain)
        file = Path(folder) / 'robot.urdf'
        file.write_text(urdf())
        for rate_hz in RATES_HZ:
            print_rows(file, rate_hz, runs)


def print_rows(file: Path, rate_hz: int, runs: int) -> None:
    """
    Print the rows of one frequency; the two kinds of nodes alternate.

    Parameters
    ----------
    file
        The URDF file of the robot.
    rate_hz
        The number of joint states sent per second.
    runs
        The number of measurements of each node.

    """
    pairs = [
        (share_of(listener(), rate_hz), share_of(publisher(file, rate_hz), rate_hz))
        for _ in range(runs)
    ]
    alone = median(listening[0] for listening, _ in pairs)
    more = median(publishing[0] - listening[0] for listening, publishing in pairs)
    share, sent_hz = (median(each) for each in zip(*(publishing for _, publishing in pairs)))
    print(f'{alone:7.1%} {"":7} {"":7}  an empty subscriber, {rate_hz} joint states/s')
    print(f'{share:7.1%} {more:7.1%} {sent_hz:7.1f}  robot_state_publisher', flush=True)


def listener() -> list[str]:
    """Return the command of a node that ignores the joint states it receives."""
    return [sys.executable, '-c', LISTENER]


def publisher(file: Path, rate_hz: int) -> list[str]:
    """
    Return the command that runs `robot_state_publisher`.

    Parameters
    ----------
    file
        The URDF file of the robot.
    rate_hz
        The number of joint states sent per second: half of its maximum publish rate.

    """
    return [
        *(sys.executable, '-m', 'robot_state_publisher.program', str(file)),
        *('--ros-args', '-p', f'publish_frequency:={2 * rate_hz}.0'),
    ]


def share_of(command: list[str], rate_hz: int) -> tuple[float, float]:
    """
    Measure a node that subscribes to joint states.

    Parameters
    ----------
    command
        The command that runs the node.
    rate_hz
        The number of joint states sent per second.

    Returns
    -------
    float, float
        The share of a core that it uses, and the messages per second on `/tf`.

    """
    with running(command) as process, sender() as (node, states):
        send(node, states, rate_hz, SETTLE_S)
        begin_s, begin_cpu_s = time.monotonic(), cpu_s(process.pid)
        heard = send(node, states, rate_hz, SECONDS)
        wall_s = time.monotonic() - begin_s
        return (cpu_s(process.pid) - begin_cpu_s) / wall_s, heard / wall_s


@contextmanager
def sender() -> Iterator[tuple[Any, Any]]:
    """Create a node that publishes joint states; wait until it has a subscriber."""
    rclpy.init()
    node = rclpy.create_node('sender')
    states = node.create_publisher(JointState, 'joint_states', 10)
    try:
        end_s = time.monotonic() + TIMEOUT_S
        while not states.get_subscription_count():
            if time.monotonic() > end_s:
                raise TimeoutError('nobody subscribed')
            time.sleep(0.05)
        yield node, states
    finally:
        node.destroy_node()
        rclpy.shutdown()


def send(node: Any, states: Any, rate_hz: int, seconds: float) -> int:
    """
    Publish changing joint states; return the number of messages on `/tf` meanwhile.

    Parameters
    ----------
    node
        The node of rclpy, which is spun.
    states
        Its publisher of joint states.
    rate_hz
        The number of joint states sent per second.
    seconds
        The duration.

    """
    heard: list[bytes] = []
    tf = node.create_subscription(TFMessage, '/tf', heard.append, 100, raw=True)
    message = JointState(name=NAMES)
    begin_s = time.monotonic()
    for number in range(int(rate_hz * seconds)):
        while (left_s := begin_s + number / rate_hz - time.monotonic()) > 0:
            rclpy.spin_once(node, timeout_sec=left_s)
        message.header.stamp = node.get_clock().now().to_msg()
        message.position = [(number % 100 + index) / 100 for index in range(JOINTS)]
        states.publish(message)
    node.destroy_subscription(tf)
    return len(heard)


def urdf() -> str:
    """Return the URDF of a serial chain whose joints rotate about all three axes in turn."""
    links = ''.join(f'<link name="link_number_{index}"/>' for index in range(JOINTS + 1))
    joints = ''.join(
        f'<joint name="{name}" type="continuous"><parent link="link_number_{index}"/>'
        f'<child link="link_number_{index + 1}"/><origin xyz="0.1 0 0.2" rpy="0.1 0.2 0.3"/>'
        f'<axis xyz="{("1 0 0", "0 1 0", "0 0 1")[index % 3]}"/></joint>'
        for index, name in enumerate(NAMES)
    )
    return f'<robot name="many_joints">{links}{joints}</robot>'


if __name__ == '__main__':
    main()
