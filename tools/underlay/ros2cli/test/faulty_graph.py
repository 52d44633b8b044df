# SPDX-License-Identifier: Apache-2.0
"""A process with nodes that do not understand each other."""

from geometry_msgs.msg import TransformStamped
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from spinning import run_until_signal
from std_msgs.msg import String
from tf2_msgs.msg import TFMessage


def transform(parent: str, child: str) -> TFMessage:
    """Return a message with one transform."""
    edge = TransformStamped(child_frame_id=child)
    edge.header.frame_id = parent
    return TFMessage(transforms=[edge])


def main() -> None:
    """Publish until a signal comes."""
    rclpy.init()
    camera = rclpy.create_node('camera')
    simulated = Parameter('use_sim_time', value=True)
    walker = rclpy.create_node('walker', parameter_overrides=[simulated])
    viewers = [rclpy.create_node('viewer'), rclpy.create_node('viewer')]
    best_effort = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
    latched = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    camera.create_publisher(String, 'image', best_effort)
    viewers[0].create_subscription(String, 'image', lambda message: None, 10)
    camera.create_publisher(TFMessage, '/tf_static', latched).publish(
        transform('base_link', 'torso')
    )
    moving = camera.create_publisher(TFMessage, '/tf', 10)
    camera.create_timer(0.05, lambda: moving.publish(transform('map', 'odom')))
    executor = SingleThreadedExecutor()
    for node in (camera, walker, *viewers):
        executor.add_node(node)
    print('ready', flush=True)
    executor.spin()


if __name__ == '__main__':
    run_until_signal(main)
