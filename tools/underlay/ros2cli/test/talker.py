# SPDX-License-Identifier: Apache-2.0
"""A process with two nodes that publish what the tests look at."""

import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState, Temperature
from spinning import run_until_signal
from std_msgs.msg import String


def main() -> None:
    """Publish until a signal comes."""
    rclpy.init()
    node = rclpy.create_node('talker')
    hidden = rclpy.create_node('_helper', namespace='/robot1')
    joints = node.create_publisher(JointState, 'joint_commands', 10)
    best_effort = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)
    temperature = node.create_publisher(Temperature, 'temperature', best_effort)
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    description = node.create_publisher(String, 'robot_description', latched)
    node.create_publisher(String, 'mixed', latched)
    hidden.create_publisher(String, '/mixed', best_effort)
    hidden.create_publisher(String, '_secret', 10)
    node.create_subscription(String, 'orders', lambda message: None, 10)
    description.publish(String(data='<robot/>' * 40))
    node.create_timer(
        0.02, lambda: joints.publish(JointState(name=['left', 'right'], position=[0.25, -0.5]))
    )
    node.create_timer(0.1, lambda: temperature.publish(Temperature(temperature=21.5)))
    executor = SingleThreadedExecutor()
    executor.add_node(node)
    executor.add_node(hidden)
    print('ready', flush=True)
    executor.spin()


if __name__ == '__main__':
    run_until_signal(main)
