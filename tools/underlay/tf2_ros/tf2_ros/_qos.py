# SPDX-License-Identifier: Apache-2.0
"""QoS profiles of the topics `/tf` and `/tf_static`."""

from rclpy.qos import DurabilityPolicy, QoSProfile

# A robot has many broadcasters; a slow listener must not lose their messages.
DYNAMIC = QoSProfile(depth=100)
# Late joiners receive the last message of each publisher.
STATIC_LISTENER = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)
# Each message holds all static transforms of its publisher.
STATIC_BROADCASTER = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
