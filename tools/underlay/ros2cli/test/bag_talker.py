# SPDX-License-Identifier: Apache-2.0
"""A process that publishes numbered texts at a rate, and a latched one."""

import signal
import sys
import time

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from std_msgs.msg import String


def main(rate_hz: float) -> None:
    """Publish the number and the time until a signal comes; one topic appears later."""
    rclpy.init()
    node = rclpy.create_node('bag_talker')
    best_effort = QoSProfile(depth=50, reliability=ReliabilityPolicy.BEST_EFFORT)
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    ticks = node.create_publisher(String, 'ticks', 100)
    sensor = node.create_publisher(String, 'sensor', best_effort)
    node.create_publisher(String, 'description', latched).publish(String(data='<robot/>'))
    later = None
    print('ready', flush=True)
    start_s = time.monotonic()
    number = 0
    while rclpy.ok():
        ticks.publish(String(data=f'{number} {time.time_ns()}'))
        sensor.publish(String(data=str(number)))
        if later is None and ticks.get_subscription_count():
            later = node.create_publisher(String, 'later', latched)
            later.publish(String(data='late'))
        number += 1
        time.sleep(max(0.0, start_s + number / rate_hz - time.monotonic()))


if __name__ == '__main__':
    try:
        main(float(sys.argv[1]))
    except (KeyboardInterrupt, ExternalShutdownException):
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        rclpy.try_shutdown()
